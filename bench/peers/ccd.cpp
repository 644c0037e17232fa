// SPDX-License-Identifier: MIT
#include <ccd/ccd.h>
#include <ccd/quat.h>

#include "contest.hpp"

namespace peers {

namespace {

using Shape = moreau::Polyhedron<double>;
using S = moreau::Space<3>;

/// World vertices around the centre, as this library has them too.
struct Object {
  std::vector<S::Vector> vertices;
  S::Vector center;
};

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* out) {
  const auto& o = *static_cast<const Object*>(object);
  const S::Vector d(direction->v[0], direction->v[1], direction->v[2]);
  const S::Vector* best = &o.vertices[0];
  double reach = d.dot(*best);
  for (const S::Vector& v : o.vertices)
    if (const double here = d.dot(v); here > reach) {
      reach = here;
      best = &v;
    }
  const S::Vector x = o.center + *best;
  ccdVec3Set(out, x.x(), x.y(), x.z());
}
void center(const void* object, ccd_vec3_t* out) {
  const auto& c = static_cast<const Object*>(object)->center;
  ccdVec3Set(out, c.x(), c.y(), c.z());
}

Object make(const Shape& shape, const moreau::Pose<S>& pose) {
  Object object{{}, pose.position};
  for (Eigen::Index i = 0; i < shape.vertices().rows(); ++i)
    object.vertices.push_back(pose.rotation * S::Vector(shape.vertices().row(i).transpose()));
  return object;
}

}  // namespace

void enter_ccd(Contest<Shape>& contest, const std::vector<Shape>& shapes, const std::string& kind) {
  std::vector<Object> a, b;
  for (const auto& c : contest.cases()) {
    a.push_back(make(shapes[c.a], c.pose_a));
    b.push_back(make(shapes[c.b], c.pose_b));
  }
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = support;
  ccd.center1 = ccd.center2 = center;
  ccd.max_iterations = 500;
  ccd.mpr_tolerance = ccd.epa_tolerance = 1e-12;
  if (kind == "overlap") {
    contest.enter("libccd GJK", kind, [&](std::size_t i) -> Answer<S> {
      return {ccdGJKIntersect(&a[i], &b[i], &ccd) != 0};
    });
    contest.enter("libccd MPR", kind, [&](std::size_t i) -> Answer<S> {
      return {ccdMPRIntersect(&a[i], &b[i], &ccd) != 0};
    });
  }
  if (kind == "distance")
    contest.enter("libccd MPR (overlap only)", kind, [&](std::size_t i) -> Answer<S> {
      ccd_real_t depth;
      ccd_vec3_t direction, position;
      if (ccdMPRPenetration(&a[i], &b[i], &ccd, &depth, &direction, &position) != 0) return {false};
      return {true, -depth, S::Vector(direction.v[0], direction.v[1], direction.v[2])};
    });
}

}  // namespace peers
