// SPDX-License-Identifier: MIT
#include "moreau/shape/capsule.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/polyhedron.hpp"

#include "conformance/matrix.hpp"
#include "world/assemblies.hpp"

TEST_CASE_TEMPLATE("spheres, polyhedra and capsules under every law", T, double, float) {
  using S = moreau::Space<3, T>;
  using Grain = moreau::OneOf<moreau::BallIn<S>, moreau::Polyhedron<T>, moreau::CapsuleIn<S>>;
  const std::vector<Grain> grains{
      moreau::BallIn<S>(T(0.005)),
      scenes::cuboid<moreau::Polyhedron<T>>({T(0.003), T(0.0025), T(0.002)}),
      moreau::CapsuleIn<S>(T(0.0025), T(0.0025))};
  conformance::all_laws(grains, T(0.01));
}
