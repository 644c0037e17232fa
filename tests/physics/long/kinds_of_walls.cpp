// SPDX-License-Identifier: MIT
// Steps of meshes in the plane: small scenes whose answer is known, each in many variants: height, overlap, push, in
// double and single precision, at default options.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <doctest/doctest.h>

#include "physics/kinds.hpp"
#include "sanitized.hpp"

using namespace kinds;

namespace {

/// A floor, a riser at x = 0 and a tread of a height.
template <class S>
FacetMesh<S> mesh_of_step(double height) {
  using T = typename S::Scalar;
  FacetMesh<S> mesh;
  const double xs[] = {0.1, 0, 0, -0.1}, zs[] = {0, 0, height, height};
  for (std::uint32_t k = 0; k < 4; ++k) {
    if constexpr (S::dim == 2) {
      mesh.vertices.push_back({T(xs[k]), T(zs[k])});
      if (k > 0) mesh.facets.push_back({k - 1, k});
    } else {
      for (const double y : {-0.1, 0.1}) mesh.vertices.push_back({T(xs[k]), T(y), T(zs[k])});
      if (k == 0) continue;
      const std::uint32_t i = 2 * (k - 1);
      mesh.facets.push_back({i, i + 1, i + 3});
      mesh.facets.push_back({i, i + 3, i + 2});
    }
  }
  return mesh;
}

}  // namespace

// A grain that flies against a step below its centre tips over it, so lower steps are touched from the start.
TEST_CASE_TEMPLATE("kinds: a grain that is pushed against a step of a mesh stays on the floor",
                   ShapeT, Polygon<>, Polygon<float>) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const Vector up = Vector::Unit(S::dim - 1);
  int variant = 0;
  for (const double height : {2e-3, 5e-3, 8e-3, 0.012, 0.015, 0.019})
    for (const double overlap : {-2e-3, 0.0, 1e-6})
      for (const double turn : {0.0, 0.2}) {
        if (turn > 0 && overlap > -1e-3) continue;
        if (overlap < 0 && height < 0.01) continue;
        for (const double push : {1.0, 3.0}) {
          ++variant;
          World<ShapeT> world = world_of<ShapeT>(0.02, 0, up);
          world.set_gravity(T(-weight) * up - T(push) * Vector::UnitX());
          world.add_mesh_wall(mesh_of_step<S>(height));
          const auto shape = world.add_shape(scenes::cuboid<ShapeT>(Vector::Constant(T(0.01))));
          Vector position = T(0.01) * up;
          position[0] = T(0.01 - overlap + 0.003 * (turn > 0));
          const auto grain = world.add_grain(shape, {position, S::exp(about_up<S>(turn))}, T(2700));
          double top = 0, over = 0;
          int unsolved = 0;
          for (int k = 0; k < rounds(1500); ++k) {
            const StepReport report = world.step(T(2e-4));
            unsolved += !report.solve.converged;
            top = std::max(top, double(world.pose(grain).position[S::dim - 1]));
            over = std::max(over, report.max_overlap);
          }
          CAPTURE(height);
          CAPTURE(overlap);
          CAPTURE(turn);
          CAPTURE(push);
          CHECK(unsolved == 0);
          CHECK(top < 0.01 + bound<ShapeT>(1e-6, 2e-6));
          CHECK(over < 2e-5);
          CHECK(double(world.pose(grain).position[0]) > 0.0099);
          CHECK(double(world.pose(grain).position[0]) < 0.0125);
        }
      }
}
