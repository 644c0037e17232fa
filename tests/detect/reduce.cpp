// SPDX-License-Identifier: MIT
#include "moreau/detect/reduce.hpp"

#include <algorithm>
#include <doctest/doctest.h>
#include <vector>

using namespace moreau;

namespace {

using S = Space<3>;

FeatureKey key(std::size_t i) {
  return FeatureKey(FeatureKey::Kind::vertex_face, i, 0);
}

Manifold<S> manifold_of(const std::vector<std::array<double, 3>>& points) {
  Manifold<S> manifold;
  manifold.normal = S::Vector::UnitZ();
  for (std::size_t i = 0; i < points.size(); ++i)
    manifold.points.push_back({{points[i][0], points[i][1], 0}, points[i][2], key(i)});
  manifold.contact_class = ContactClass::face_face;
  return manifold;
}

std::vector<std::size_t> kept(const Manifold<S>& manifold) {
  std::vector<std::size_t> ids;
  for (const auto& point : manifold.points) ids.push_back(point.feature.a());
  return ids;
}

const std::vector<std::array<double, 3>> hexagon = {{1, 0, -.1},   {.5, .9, -.2}, {-.5, .9, -.1},
                                                    {-1, 0, -.15}, {-.5, -.9, 0}, {.5, -.9, 0}};

}  // namespace

TEST_CASE("reduce: fewer points than asked for stay") {
  Manifold<S> manifold = manifold_of({{0, 0, 0}, {1, 0, 0}});
  reduce(manifold, 3);
  CHECK(kept(manifold) == std::vector<std::size_t>{0, 1});
}

TEST_CASE("reduce: the deepest, the farthest from it, the widest triangle with it") {
  Manifold<S> manifold = manifold_of(hexagon);
  reduce(manifold, 1);
  CHECK(kept(manifold) == std::vector<std::size_t>{1});
  manifold = manifold_of(hexagon);
  reduce(manifold, 2);
  CHECK(kept(manifold) == std::vector<std::size_t>{1, 4});
  manifold = manifold_of(hexagon);
  reduce(manifold, 3);
  CHECK(kept(manifold) == std::vector<std::size_t>{1, 3, 5});
  CHECK(manifold.contact_class == ContactClass::face_face);
}

TEST_CASE("reduce: rounding does not choose") {
  for (const double noise : {0., 1e-14, -1e-14}) {
    Manifold<S> manifold =
        manifold_of({{0, 0, 0}, {1, noise, -noise}, {1, 1, noise}, {noise, 1, 2 * noise}});
    reduce(manifold, 3);
    CHECK(kept(manifold) == std::vector<std::size_t>{0, 1, 2});
  }
}

TEST_CASE("reduce: the triangle of the step before stays while it is nearly as wide") {
  const std::vector<KeptPoint> previous = {{key(0)}, {key(1)}, {key(4)}};
  Manifold<S> manifold = manifold_of(hexagon);
  reduce(manifold, 3, previous);
  CHECK(kept(manifold) == std::vector<std::size_t>{1, 3, 5});  // the other triangles are too narrow
  const auto square =
      std::vector<std::array<double, 3>>{{0, 0, -1}, {1, 0, 0}, {1, 1.05, 0}, {0, 1, 0}};
  manifold = manifold_of(square);
  reduce(manifold, 3);
  const auto first = kept(manifold);
  manifold = manifold_of(square);
  reduce(manifold, 3, std::vector<KeptPoint>{{key(0)}, {key(1)}, {key(3)}});
  CHECK(kept(manifold) == std::vector<std::size_t>{0, 1, 3});
  CHECK(first != kept(manifold));
  manifold = manifold_of(square);
  // The previous points do not include the deepest point.
  reduce(manifold, 3, std::vector<KeptPoint>{{key(3)}, {key(1)}, {key(2)}});
  CHECK(kept(manifold) == first);
  manifold = manifold_of(square);
  // One previous point no longer exists.
  reduce(manifold, 3, std::vector<KeptPoint>{{key(0)}, {key(1)}, {key(9)}});
  CHECK(kept(manifold) == first);
}

TEST_CASE("reduce: points on a line are two") {
  Manifold<S> manifold = manifold_of({{0, 0, 0}, {1, 0, -1}, {2, 0, 0}, {4, 0, 0}});
  reduce(manifold, 3);
  CHECK(kept(manifold) == std::vector<std::size_t>{1, 3});
}

TEST_CASE("feature keys: parts and the other side") {
  using Kind = FeatureKey::Kind;
  const FeatureKey key(Kind::vertex_face, 123456, 7);
  CHECK(key.kind() == Kind::vertex_face);
  CHECK(key.a() == 123456);
  CHECK(key.b() == 7);
  CHECK(key.swapped() == FeatureKey(Kind::face_vertex, 7, 123456));
  for (const Kind kind : {Kind::vertex_face, Kind::face_vertex, Kind::edge_edge,
                          Kind::vertex_vertex, Kind::vertex_edge, Kind::edge_vertex})
    CHECK(FeatureKey(kind, 1, 2).swapped().swapped() == FeatureKey(kind, 1, 2));
}

TEST_CASE("reduce: points within the resolution are one, thin triangles two") {
  Reduction reduction;
  reduction.resolution = 0.1;
  const auto reduced = [&](const std::vector<std::array<double, 3>>& points) {
    Manifold<S> manifold = manifold_of(points);
    reduce(manifold, 3, {}, reduction);
    return kept(manifold);
  };
  CHECK(reduced({{0, 0, 0}, {0.09, 0, -.1}}) == std::vector<std::size_t>{1});
  CHECK(reduced({{0, 0, 0}, {0.11, 0, -.1}}) == std::vector<std::size_t>{0, 1});
  CHECK(reduced({{0, 0, -.1}, {1, 0, 0}, {0.5, 0.09, 0}}) == std::vector<std::size_t>{0, 1});
  CHECK(reduced({{0, 0, -.1}, {1, 0, 0}, {0.5, 0.11, 0}}) == std::vector<std::size_t>{0, 1, 2});
  CHECK(reduced({{0, 0, 0}}) == std::vector<std::size_t>{0});
}

TEST_CASE("reduce: a point that comes in keeps the side that the pressure was on") {
  // The points form a square. The load was on the side from point 0 to point 1. Now point 3 is the
  // deepest.
  const auto square =
      std::vector<std::array<double, 3>>{{0, 0, 0}, {1, 0, 0}, {1.5, 1, 0}, {0, 1, -1e-3}};
  Manifold<S> manifold = manifold_of(square);
  reduce(manifold, 3, std::vector<KeptPoint>{{key(0), 1}, {key(1), 1}, {key(2), 0}});
  CHECK(kept(manifold) == std::vector<std::size_t>{0, 1, 3});
  // A point that is only slightly deeper than the others does not change the choice.
  Reduction reduction;
  reduction.shallower = 1e-2;
  manifold = manifold_of(square);
  reduce(manifold, 3, std::vector<KeptPoint>{{key(0), 1}, {key(1), 1}, {key(2), 0}}, reduction);
  CHECK(kept(manifold) == std::vector<std::size_t>{0, 1, 2});
}

TEST_CASE("reduce: open points are not asked where three are closed") {
  Reduction reduction;
  reduction.near = 1e-3;
  Manifold<S> manifold = manifold_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 0, 0.1}, {0, 9, 0.1}});
  reduce(manifold, 3, {}, reduction);
  CHECK(kept(manifold) == std::vector<std::size_t>{0, 1, 2});
}
