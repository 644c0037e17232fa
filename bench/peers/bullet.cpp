// SPDX-License-Identifier: MIT
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <memory>

#include "contest.hpp"

namespace peers {

namespace {

using Shape = moreau::Polyhedron<double>;
using S = moreau::Space<3>;

btTransform transform(const moreau::Pose<S>& pose) {
  const auto& q = pose.rotation;
  const auto& x = pose.position;
  return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), btVector3(x.x(), x.y(), x.z()));
}

}  // namespace

void enter_bullet(Contest<Shape>& contest, const std::vector<Shape>& shapes) {
  std::vector<std::unique_ptr<btConvexHullShape>> hulls;
  for (const Shape& shape : shapes) {
    hulls.push_back(std::make_unique<btConvexHullShape>());
    for (Eigen::Index i = 0; i < shape.vertices().rows(); ++i)
      hulls.back()->addPoint(
          btVector3(shape.vertices()(i, 0), shape.vertices()(i, 1), shape.vertices()(i, 2)), false);
    hulls.back()->setMargin(0);
    hulls.back()->recalcLocalAabb();
  }
  std::vector<btGjkPairDetector::ClosestPointInput> inputs;
  for (const auto& c : contest.cases()) {
    inputs.emplace_back();
    inputs.back().m_transformA = transform(c.pose_a);
    inputs.back().m_transformB = transform(c.pose_b);
  }
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver epa;
  contest.enter("Bullet GJK and EPA", "distance", [&](std::size_t i) -> Answer<S> {
    const auto& c = contest.cases()[i];
    btGjkPairDetector detector(hulls[c.a].get(), hulls[c.b].get(), &simplex, &epa);
    btPointCollector found;
    detector.getClosestPoints(inputs[i], found, nullptr);
    if (!found.m_hasResult) return {false};
    const btVector3& n = found.m_normalOnBInWorld;  // from b to a
    return {found.m_distance <= 0, found.m_distance, -S::Vector(n.x(), n.y(), n.z())};
  });
}

}  // namespace peers
