// SPDX-License-Identifier: MIT
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/rounded.hpp"

#include "conformance/matrix.hpp"
#include "world/assemblies.hpp"

TEST_CASE_TEMPLATE("grains with sharp and with rounded corners", Sharp, moreau::Polygon<double>,
                   moreau::Polyhedron<double>, moreau::Polygon<float>, moreau::Polyhedron<float>) {
  using S = moreau::SpaceOf<Sharp>;
  using T = typename S::Scalar;
  using Grain = moreau::OneOf<Sharp, moreau::Rounded<Sharp>>;
  const typename S::Vector half = S::Vector::Constant(T(0.0025)) + T(0.0005) * S::Vector::UnitX();
  const typename S::Vector inner = half.array() - T(0.001);
  const std::vector<Grain> grains{scenes::cuboid<Sharp>(half),
                                  moreau::Rounded<Sharp>(scenes::cuboid<Sharp>(inner), T(0.001))};
  const moreau::SignoriniCoulomb<T> coulomb(T(0.4));
  const T mass = grains[1].mass_properties(T(1000)).mass;
  SUBCASE("SignoriniCoulomb") {
    conformance::world(grains, coulomb, T(0.01));
  }
  SUBCASE("LinearSpringDashpot") {
    conformance::world(grains, conformance::stiff_springs<T>(mass), T(0.01));
  }
}
