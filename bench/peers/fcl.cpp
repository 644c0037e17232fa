// SPDX-License-Identifier: MIT
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include <memory>

#include "contest.hpp"

namespace peers {

namespace {

using Shape = moreau::Polyhedron<double>;
using S = moreau::Space<3>;

std::shared_ptr<fcl::Convexd> make(const Shape& shape) {
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (Eigen::Index i = 0; i < shape.vertices().rows(); ++i)
    vertices->push_back(shape.vertices().row(i).transpose());
  auto faces = std::make_shared<std::vector<int>>();
  for (std::size_t f = 0; f < shape.face_count(); ++f) {
    faces->push_back(static_cast<int>(shape.face(f).size()));
    for (const std::uint32_t v : shape.face(f)) faces->push_back(static_cast<int>(v));
  }
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(shape.face_count()), faces);
}
fcl::Transform3d transform(const moreau::Pose<S>& pose) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.linear() = pose.rotation.toRotationMatrix();
  t.translation() = pose.position;
  return t;
}

}  // namespace

void enter_fcl(Contest<Shape>& contest, const std::vector<Shape>& shapes) {
  std::vector<std::shared_ptr<fcl::Convexd>> hulls;
  for (const Shape& shape : shapes) hulls.push_back(make(shape));
  std::vector<fcl::Transform3d> a, b;
  for (const auto& c : contest.cases()) {
    a.push_back(transform(c.pose_a));
    b.push_back(transform(c.pose_b));
  }
  fcl::DistanceRequestd request(true, true);
  request.distance_tolerance = 1e-9;
  contest.enter("FCL signed distance", "distance", [&](std::size_t i) -> Answer<S> {
    const auto& c = contest.cases()[i];
    fcl::DistanceResultd result;
    try {
      const double gap =
          fcl::distance(hulls[c.a].get(), a[i], hulls[c.b].get(), b[i], request, result);
      const S::Vector apart = result.nearest_points[1] - result.nearest_points[0];
      return {gap <= 0, gap, (gap < 0 ? -1 : 1) * apart.normalized()};
    } catch (const std::exception&) {
      return {false};  // it gives up on some
    }
  });
}

}  // namespace peers
