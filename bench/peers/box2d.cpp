// SPDX-License-Identifier: MIT
#include <box2d/b2_collision.h>
#include <box2d/b2_polygon_shape.h>

#include "contest.hpp"

namespace peers {

namespace {

using Shape = moreau::Polygon<double>;
using S = moreau::Space<2>;

b2Transform transform(const moreau::Pose<S>& pose) {
  return b2Transform(
      b2Vec2(static_cast<float>(pose.position.x()), static_cast<float>(pose.position.y())),
      b2Rot(static_cast<float>(pose.rotation.angle())));
}

}  // namespace

void enter_box2d(Contest<Shape>& contest, const std::vector<Shape>& shapes) {
  std::vector<b2PolygonShape> polygons(shapes.size());
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    std::vector<b2Vec2> points;
    for (Eigen::Index i = 0; i < shapes[k].vertices().rows(); ++i)
      points.emplace_back(static_cast<float>(shapes[k].vertices()(i, 0)),
                          static_cast<float>(shapes[k].vertices()(i, 1)));
    polygons[k].Set(points.data(), static_cast<int32>(points.size()));
  }
  std::vector<b2Transform> a, b;
  for (const auto& c : contest.cases()) {
    a.push_back(transform(c.pose_a));
    b.push_back(transform(c.pose_b));
  }
  // Its skins make contact at a gap of two radii; the world manifold says the gap without them.
  contest.enter("Box2D", "manifold", [&](std::size_t i) -> Answer<S> {
    const auto& c = contest.cases()[i];
    b2Manifold manifold;
    b2CollidePolygons(&manifold, &polygons[c.a], a[i], &polygons[c.b], b[i]);
    if (manifold.pointCount == 0) return {false};
    b2WorldManifold world;
    world.Initialize(&manifold, a[i], 0, b[i], 0);
    float gap = world.separations[0];
    if (manifold.pointCount == 2) gap = std::min(gap, world.separations[1]);
    const S::Vector normal(static_cast<double>(world.normal.x),
                           static_cast<double>(world.normal.y));
    return {gap <= 0, static_cast<double>(gap), normal};
  });
}

}  // namespace peers
