// SPDX-License-Identifier: MIT
// EPA, the expanding polytope algorithm: the penetration depth of two overlapping convex shapes
// that are given by their support functions. Source: G. van den Bergen, Proximity queries and
// penetration depth computation on 3D game objects, Game Developers Conference 2001.
//
// Let C = B - A be the set of all differences b - a. The depth is the distance of the origin from
// the surface of C. The algorithm expands a polytope that contains the origin and whose corners are
// points of C. In each iteration the support point of C in the direction of the polytope's nearest
// face becomes a corner. The algorithm ends when this support point is not farther out than the
// face. In the plane the polytope is a ring of points, in space a hull of triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "moreau/core/space.hpp"

namespace moreau::detail {

/// A support point of C, and the point of A from which it was formed, relative to the centre of a,
/// world axes [m].
template <class Vector>
struct ExtremePoint {
  Vector point, on_a;
};

/// A face of the polytope. For the nearest face, minus the offset approximates the signed gap of
/// the shapes.
template <class Vector>
struct NearestFace {
  Vector outward;                  ///< unit normal, pointing out of the polytope
  typename Vector::Scalar offset;  ///< distance of the face's plane from the origin [m]
  Vector on_a;  ///< point of A that belongs to the projection of the origin onto the face [m]
};

/// The largest number of corners of the polytope. Only curved surfaces, at the limit of rounding,
/// need more.
inline constexpr int most_points = 1000;

/// The polytope in the plane: a ring of points, counter-clockwise.
template <std::floating_point T, class Farthest>
class EpaPolygon {
 public:
  using Vector = typename Space<2, T>::Vector;
  using Face = NearestFace<Vector>;

  /// @param farthest    farthest(n) -> the ExtremePoint of C with the largest n . point
  /// @param precise  differences below this are ignored [m]
  EpaPolygon(const Farthest& farthest, T precise) : farthest_(farthest), precise_(precise) {}

  /// Starts with a triangle of three points of C. Adds support points of C until C extends at most
  /// `precise` beyond the line of the side nearest to the origin, or until the polygon has
  /// most_points points.
  void run() {
    for (int k = 0; k < 3; ++k) {
      const T angle = T(2.0943951) * static_cast<T>(k);
      ring_.push_back(farthest_(Vector(std::cos(angle), std::sin(angle))));
    }
    while (true) {
      const std::size_t at = nearest_side();
      const Face nearest = face(at);
      const auto next = farthest_(nearest.outward);
      if (!(nearest.outward.dot(next.point) - nearest.offset > precise_) ||
          ring_.size() >= most_points)
        return;
      ring_.insert(ring_.begin() + static_cast<std::ptrdiff_t>(at) + 1, next);
    }
  }
  Face nearest() const { return face(nearest_side()); }
  std::size_t size() const { return ring_.size(); }
  /// Side k of the ring. Its offset is infinite if the side is too short to have a normal.
  Face face(std::size_t k) const {
    const auto& p = ring_[k];
    const auto& q = ring_[(k + 1) % ring_.size()];
    const Vector along = q.point - p.point;
    const T length = along.norm();
    if (!(length > precise_))
      return {Vector::UnitX(), std::numeric_limits<T>::infinity(), Vector::Zero()};
    const Vector outward = Vector(along.y(), -along.x()) / length;
    const T t = std::clamp(-p.point.dot(along) / (length * length), T(0), T(1));
    return {outward, outward.dot(p.point), p.on_a + t * (q.on_a - p.on_a)};
  }

 private:
  std::size_t nearest_side() const {
    std::size_t best = 0;
    T least = std::numeric_limits<T>::infinity();
    for (std::size_t k = 0; k < ring_.size(); ++k)
      if (const T offset = face(k).offset; offset < least) {
        least = offset;
        best = k;
      }
    return best;
  }

  const Farthest& farthest_;
  const T precise_;
  std::vector<ExtremePoint<Vector>> ring_;
};

/// The polytope in space: a hull of triangles, counter-clockwise from outside.
template <std::floating_point T, class Farthest>
class EpaPolytope {
 public:
  using Vector = typename Space<3, T>::Vector;

  /// The arguments are the same as for EpaPolygon.
  EpaPolytope(const Farthest& farthest, T precise) : farthest_(farthest), precise_(precise) {}

  /// Starts with a tetrahedron of four points of C. Adds support points of C until C extends at most
  /// `precise` beyond the plane of the face nearest to the origin, or until the polytope has
  /// most_points points.
  void run() {
    start();
    while (grow()) {
    }
  }
  NearestFace<Vector> nearest() const { return face(nearest_face()); }
  std::size_t size() const { return faces_.size(); }
  /// Face f. Its offset is infinite if the face is too thin to have a normal.
  NearestFace<Vector> face(std::size_t f) const {
    const Face& face = faces_[f];
    if (!(face.offset < std::numeric_limits<T>::infinity()))
      return {face.outward, face.offset, points_[face.corner[0]].on_a};
    const auto& [i, j, k] = face.corner;
    const Vector origin_on_face = face.offset * face.outward;
    const Vector p = points_[i].point - origin_on_face, q = points_[j].point - origin_on_face;
    const Vector r = points_[k].point - origin_on_face;
    std::array<T, 3> weight{face.outward.dot(q.cross(r)), face.outward.dot(r.cross(p)),
                            face.outward.dot(p.cross(q))};
    T sum = 0;
    for (T& w : weight) sum += w = std::max(w, T(0));
    return {
        face.outward, face.offset,
        (weight[0] * points_[i].on_a + weight[1] * points_[j].on_a + weight[2] * points_[k].on_a) /
            sum};
  }

 private:
  struct Face {
    std::array<std::size_t, 3> corner;
    Vector outward;
    T offset;
  };

  /// Finds four points of C that do not lie in one plane, and their four faces.
  void start() {
    points_ = {farthest_(Vector::UnitX()), farthest_(Vector(-Vector::UnitX()))};
    const Vector along = points_[1].point - points_[0].point;
    const auto frame = Space<3, T>::contact_frame(along.normalized());
    Vector normal;
    for (const int axis : {1, 2}) {
      add_farther(frame.col(axis), points_[0].point);
      normal = along.cross(points_[2].point - points_[0].point);
      if (normal.squaredNorm() > T(0)) break;
      // C is flat along this axis, as for two cores without thickness in one plane.
      if (axis == 1) points_.pop_back();
    }
    normal = normal.squaredNorm() > T(0) ? Vector(normal.normalized()) : Vector(frame.col(1));
    add_farther(normal, points_[0].point);
    const bool is_above = normal.dot(points_[3].point - points_[0].point) > T(0);
    const std::array<std::size_t, 4> v =
        is_above ? std::array<std::size_t, 4>{0, 1, 2, 3} : std::array<std::size_t, 4>{0, 2, 1, 3};
    add_face(v[0], v[2], v[1]);
    add_face(v[0], v[1], v[3]);
    add_face(v[1], v[2], v[3]);
    add_face(v[2], v[0], v[3]);
  }
  /// Of the support points in `direction` and in the opposite direction, adds the one whose
  /// distance from the point `from`, measured along `direction`, is larger.
  void add_farther(const Vector& direction, const Vector& from) {
    const auto one = farthest_(direction), other = farthest_(Vector(-direction));
    const bool take_one = direction.dot(one.point - from) >= direction.dot(from - other.point);
    points_.push_back(take_one ? one : other);
  }
  void add_face(std::size_t i, std::size_t j, std::size_t k) {
    const Vector normal =
        (points_[j].point - points_[i].point).cross(points_[k].point - points_[i].point);
    const T length = normal.norm();
    // The offset of a sliver is set to infinity, so that it is never the nearest face and never
    // visible from a point.
    if (!(length > precise_ * precise_)) {
      faces_.push_back({{i, j, k}, Vector::Zero(), std::numeric_limits<T>::infinity()});
      return;
    }
    const Vector outward = normal / length;
    faces_.push_back({{i, j, k}, outward, outward.dot(points_[i].point)});
  }
  std::size_t nearest_face() const {
    std::size_t best = 0;
    for (std::size_t f = 1; f < faces_.size(); ++f)
      if (faces_[f].offset < faces_[best].offset) best = f;
    return best;
  }
  /// Adds the support point beyond the nearest face, and replaces the faces that are visible from
  /// it.
  /// @returns false if C extends no farther than the nearest face
  bool grow() {
    const std::size_t nearest = nearest_face();
    const Face& face = faces_[nearest];
    const auto next = farthest_(face.outward);
    if (!(face.outward.dot(next.point) - face.offset > precise_) || points_.size() >= most_points)
      return false;
    points_.push_back(next);
    mark_visible(nearest, next.point);
    rim_.clear();
    std::size_t kept = 0;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (!is_visible_[f]) {
        faces_[kept++] = faces_[f];
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k)
        toggle({faces_[f].corner[k], faces_[f].corner[(k + 1) % 3]});
    }
    faces_.resize(kept);
    for (const auto& [i, j] : rim_) add_face(i, j, points_.size() - 1);
    return true;
  }
  /// Marks the faces that are visible from a point. The search goes from each visible face to its
  /// neighbours, so that rounding errors cannot produce a second group of visible faces.
  void mark_visible(std::size_t from, const Vector& point) {
    is_visible_.assign(faces_.size(), false);
    is_visible_[from] = true;
    stack_ = {from};
    while (!stack_.empty()) {
      const auto corner = faces_[stack_.back()].corner;
      stack_.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t f = face_with(corner[(k + 1) % 3], corner[k]);
        if (f == faces_.size() || is_visible_[f]) continue;
        if (!(faces_[f].outward.dot(point) > faces_[f].offset)) continue;
        is_visible_[f] = true;
        stack_.push_back(f);
      }
    }
  }
  /// The face with the directed edge from corner i to corner j; the number of faces if there is no
  /// such face.
  std::size_t face_with(std::size_t i, std::size_t j) const {
    std::size_t f = 0;
    for (; f < faces_.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        if (faces_[f].corner[k] == i && faces_[f].corner[(k + 1) % 3] == j) return f;
    return f;
  }
  /// Adds an edge to the rim of the visible faces. If the reversed edge is in the rim, removes that
  /// edge instead, because an edge between two visible faces is not on the rim.
  void toggle(const std::array<std::size_t, 2>& edge) {
    const auto reverse =
        std::find(rim_.begin(), rim_.end(), std::array<std::size_t, 2>{edge[1], edge[0]});
    if (reverse == rim_.end())
      rim_.push_back(edge);
    else
      rim_.erase(reverse);
  }

  const Farthest& farthest_;
  const T precise_;
  std::vector<ExtremePoint<Vector>> points_;
  std::vector<Face> faces_;
  std::vector<std::array<std::size_t, 2>> rim_;
  std::vector<bool> is_visible_;
  std::vector<std::size_t> stack_;
};

/// Runs EPA: expands the polytope until C extends no more than `precise` [m] beyond the polytope's
/// nearest face. The polytope lies inside C. So a face of the polytope can lead to a smaller depth
/// than a known depth only if the face is nearer to the origin than that depth.
/// @param farthest  farthest(n) -> the ExtremePoint of C with the largest n . point; it must outlive the
///               result
template <std::floating_point T, class Farthest>
EpaPolygon<T, Farthest> epa(Space<2, T>, const Farthest& farthest, T precise) {
  EpaPolygon<T, Farthest> polytope(farthest, precise);
  polytope.run();
  return polytope;
}
template <std::floating_point T, class Farthest>
EpaPolytope<T, Farthest> epa(Space<3, T>, const Farthest& farthest, T precise) {
  EpaPolytope<T, Farthest> polytope(farthest, precise);
  polytope.run();
  return polytope;
}

}  // namespace moreau::detail
