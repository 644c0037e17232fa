// SPDX-License-Identifier: MIT
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/rounded.hpp"

#include "conformance/matrix.hpp"
#include "world/assemblies.hpp"

TEST_CASE_TEMPLATE("grains with sharp and with rounded corners under every law", Sharp,
                   moreau::Polygon<double>, moreau::Polyhedron<double>, moreau::Polygon<float>,
                   moreau::Polyhedron<float>) {
  using S = moreau::SpaceOf<Sharp>;
  using T = typename S::Scalar;
  using Grain = moreau::OneOf<Sharp, moreau::Rounded<Sharp>>;
  const typename S::Vector half = S::Vector::Constant(T(0.0025)) + T(0.0005) * S::Vector::UnitX();
  const typename S::Vector inner = half.array() - T(0.001);
  const std::vector<Grain> grains{scenes::cuboid<Sharp>(half),
                                  moreau::Rounded<Sharp>(scenes::cuboid<Sharp>(inner), T(0.001))};
  conformance::all_laws(grains, T(0.01));
}
