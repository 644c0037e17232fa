// SPDX-License-Identifier: MIT
// The solvers that the other files of the matrix do not test.
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/solve/proximal_fallback.hpp"

#include "conformance/matrix.hpp"
#include "world/assemblies.hpp"

TEST_CASE_TEMPLATE("every solver", Grain, moreau::Polygon<double>, moreau::Polyhedron<double>,
                   moreau::Polygon<float>, moreau::Polyhedron<float>) {
  using S = moreau::SpaceOf<Grain>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const Grain grain =
      scenes::cuboid<Grain>(Vector::Constant(T(0.0025)) + T(5e-4) * Vector::UnitX());
  const moreau::SignoriniCoulomb<T> coulomb(T(0.4));
  SUBCASE("ProximalFallback") {
    conformance::world<conformance::With<void, void, moreau::ProximalFallback<>>>(grain, coulomb,
                                                                                  T(0.01));
  }
}
