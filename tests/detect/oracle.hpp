// SPDX-License-Identifier: MIT
// The reference for the tests of the narrow phase: all axes and all pairs of features are compared,
// by brute force.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace oracle {

/// The exact result for a pair. The normal is unique if the separation along every axis that
/// differs from it by more than 0.01 degrees is smaller by more than 1e-9 of the size.
template <class S>
struct Truth {
  typename S::Scalar gap;
  typename S::Vector normal;
  bool is_unique;
};

/// Vertices and face normals of a shape in world axes, relative to a given origin.
template <class ShapeT>
struct World {
  using S = typename ShapeT::Space;
  using Vector = typename S::Vector;
  std::vector<Vector> vertices, normals;

  World(const ShapeT& shape, const moreau::Pose<S>& pose, const Vector& origin) {
    const Vector at = pose.position - origin;
    for (Eigen::Index i = 0; i < shape.vertices().rows(); ++i)
      vertices.push_back(pose.rotation * Vector(shape.vertices().row(i).transpose()) + at);
    for (Eigen::Index f = 0; f < shape.face_normals().rows(); ++f)
      normals.push_back(pose.rotation * Vector(shape.face_normals().row(f).transpose()));
  }
};

template <class W>
typename W::S::Scalar separation(const W& a, const W& b, const typename W::Vector& n) {
  using T = typename W::S::Scalar;
  T top = -std::numeric_limits<T>::infinity(), bottom = -top;
  for (const auto& x : a.vertices) top = std::max(top, n.dot(x));
  for (const auto& x : b.vertices) bottom = std::min(bottom, n.dot(x));
  return bottom - top;
}

/// The best axis so far, and the best axis with a different direction.
template <class S>
class Best {
 public:
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  void take(const Vector& n, T s) { all_.push_back({n, s}); }
  Truth<S> truth(T size) const {
    const auto best = std::max_element(all_.begin(), all_.end(),
                                       [](const auto& p, const auto& q) { return p.s < q.s; });
    bool is_unique = true;
    for (const Axis& axis : all_)
      if (axis.s > best->s - T(1e-9) * size && (axis.n - best->n).norm() > T(1e-4))
        is_unique = false;
    return {best->s, best->n, is_unique};
  }

 private:
  struct Axis {
    Vector n;
    T s;
  };
  std::vector<Axis> all_;
};

template <class Vector>
Vector nearest_on_segment(const Vector& p, const Vector& q, const Vector& x) {
  const Vector along = q - p;
  const auto t = std::clamp((x - p).dot(along) / along.squaredNorm(), typename Vector::Scalar(0),
                            typename Vector::Scalar(1));
  return p + t * along;
}

/// The vector from the nearest point of the first segment to the nearest point of the second
/// segment.
template <class Vector>
Vector segment_to_segment(const Vector& p, const Vector& p1, const Vector& q, const Vector& q1) {
  std::array<Vector, 4> ends = {
      q - nearest_on_segment(p, p1, q), q1 - nearest_on_segment(p, p1, q1),
      nearest_on_segment(q, q1, p) - p, nearest_on_segment(q, q1, p1) - p1};
  Vector best = *std::min_element(ends.begin(), ends.end(), [](const Vector& x, const Vector& y) {
    return x.squaredNorm() < y.squaredNorm();
  });
  const Vector u = p1 - p, v = q1 - q, w = p - q;
  const auto a = u.dot(u), b = u.dot(v), c = v.dot(v), d = u.dot(w), e = v.dot(w);
  const auto det = a * c - b * b;
  if (det > 1e-14 * a * c) {
    const auto s = (b * e - c * d) / det, t = (a * e - b * d) / det;
    if (s > 0 && s < 1 && t > 0 && t < 1) {
      const Vector inner = (q + t * v) - (p + s * u);
      if (inner.squaredNorm() < best.squaredNorm()) best = inner;
    }
  }
  return best;
}

/// The vector from a face of a polyhedron to a point above it, if the point projects onto the face.
template <class T>
bool face_to_point(const moreau::Polyhedron<T>& shape, const World<moreau::Polyhedron<T>>& world,
                   std::size_t f, const typename moreau::Space<3, T>::Vector& x,
                   typename moreau::Space<3, T>::Vector& difference) {
  using Vector = typename moreau::Space<3, T>::Vector;
  const auto loop = shape.face(f);
  const Vector n = world.normals[f];
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vector from = world.vertices[loop[k]];
    const Vector to = world.vertices[loop[(k + 1) % loop.size()]];
    if (n.cross(to - from).dot(x - from) < T(0)) return false;
  }
  difference = n.dot(x - world.vertices[loop[0]]) * n;
  return true;
}

/// Compares all features of two polyhedra that are apart.
template <class T>
typename moreau::Space<3, T>::Vector nearest_difference(
    const moreau::Polyhedron<T>& a, const World<moreau::Polyhedron<T>>& world_a,
    const moreau::Polyhedron<T>& b, const World<moreau::Polyhedron<T>>& world_b) {
  using Vector = typename moreau::Space<3, T>::Vector;
  Vector best = Vector::Constant(T(1e6)), difference;
  const auto take = [&](const Vector& d) {
    if (d.squaredNorm() < best.squaredNorm()) best = d;
  };
  for (const auto& e : a.edges())
    for (const auto& f : b.edges())
      take(segment_to_segment(world_a.vertices[e.vertex[0]], world_a.vertices[e.vertex[1]],
                              world_b.vertices[f.vertex[0]], world_b.vertices[f.vertex[1]]));
  for (std::size_t f = 0; f < a.face_count(); ++f)
    for (const Vector& x : world_b.vertices)
      if (face_to_point(a, world_a, f, x, difference)) take(difference);
  for (std::size_t f = 0; f < b.face_count(); ++f)
    for (const Vector& x : world_a.vertices)
      if (face_to_point(b, world_b, f, x, difference)) take(-difference);
  return best;
}

/// Compares all pairs of edges of two polygons that are apart.
template <class T>
typename moreau::Space<2, T>::Vector nearest_difference(const moreau::Polygon<T>&,
                                                        const World<moreau::Polygon<T>>& world_a,
                                                        const moreau::Polygon<T>&,
                                                        const World<moreau::Polygon<T>>& world_b) {
  using Vector = typename moreau::Space<2, T>::Vector;
  Vector best = Vector::Constant(T(1e6));
  const std::size_t n = world_a.vertices.size(), m = world_b.vertices.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < m; ++j) {
      const Vector d = segment_to_segment(world_a.vertices[i], world_a.vertices[(i + 1) % n],
                                          world_b.vertices[j], world_b.vertices[(j + 1) % m]);
      if (d.squaredNorm() < best.squaredNorm()) best = d;
    }
  return best;
}

/// Takes the normals of all pairs of edges of two polyhedra.
template <class T>
void take_edge_normals(const moreau::Polyhedron<T>& a, const World<moreau::Polyhedron<T>>& world_a,
                       const moreau::Polyhedron<T>& b, const World<moreau::Polyhedron<T>>& world_b,
                       Best<moreau::Space<3, T>>& best) {
  using Vector = typename moreau::Space<3, T>::Vector;
  for (const auto& e : a.edges())
    for (const auto& f : b.edges()) {
      const Vector u = world_a.vertices[e.vertex[1]] - world_a.vertices[e.vertex[0]];
      const Vector v = world_b.vertices[f.vertex[1]] - world_b.vertices[f.vertex[0]];
      Vector n = u.cross(v);
      if (n.norm() < T(1e-12) * u.norm() * v.norm()) continue;
      n.normalize();
      best.take(n, separation(world_a, world_b, n));
      best.take(-n, separation(world_a, world_b, Vector(-n)));
    }
}

template <class ShapeT>
Truth<moreau::SpaceOf<ShapeT>> signed_gap(const ShapeT& a,
                                          const moreau::Pose<moreau::SpaceOf<ShapeT>>& pose_a,
                                          const ShapeT& b,
                                          const moreau::Pose<moreau::SpaceOf<ShapeT>>& pose_b) {
  using S = moreau::SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const World<ShapeT> world_a(a, pose_a, pose_a.position);
  const World<ShapeT> world_b(b, pose_b, pose_a.position);
  Best<S> best;
  for (const Vector& n : world_a.normals) best.take(n, separation(world_a, world_b, n));
  for (const Vector& n : world_b.normals) best.take(-n, separation(world_a, world_b, Vector(-n)));
  if constexpr (S::dim == 3) take_edge_normals(a, world_a, b, world_b, best);
  const T size = a.circumradius() + b.circumradius();
  const Truth<S> truth = best.truth(size);
  if (truth.gap <= T(0)) return truth;
  const Vector apart = nearest_difference(a, world_a, b, world_b);
  const T gap = apart.norm();
  // A vector as short as a few rounding errors has no reliable direction. The best axis is used
  // instead.
  if (gap < T(1e-10) * size) return {gap, truth.normal, false};
  return {gap, apart / gap, true};
}

}  // namespace oracle
