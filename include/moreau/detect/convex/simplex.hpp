// SPDX-License-Identifier: MIT
// The simplex of GJK: at most four points of the set of differences B - A, and the point of their
// convex hull nearest to the origin. Source: Gilbert, Johnson and Keerthi 1988, see gjk.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "moreau/core/space.hpp"

namespace moreau::detail {

/// A point of B - A: vertex b of B minus vertex a of A, world axes [m].
template <class Vector>
struct DifferencePoint {
  Vector point;
  std::uint32_t a, b;
};

/// At most four points of B - A. `nearest()` is the point of their convex hull nearest to the
/// origin [m]. `direction()` is parallel to nearest() and of any length. It is computed from the
/// geometry of the points. So it is accurate even if the origin is so close to the hull that
/// nearest() consists of rounding errors.
template <std::floating_point T>
class Simplex {
 public:
  using Vector = typename Space<3, T>::Vector;
  using Point = DifferencePoint<Vector>;

  /// @param p     the first point
  /// @param size  order of magnitude of the size of the shapes [m]
  Simplex(const Point& p, T size)
      : points_{p, p, p, p},
        unit_(size > T(0) ? std::ldexp(T(1), -std::ilogb(size)) : T(1)),
        nearest_(p.point),
        direction_(p.point) {}

  int size() const { return size_; }
  const Point& operator[](int i) const { return points_[static_cast<std::size_t>(i)]; }
  const Vector& nearest() const { return nearest_; }
  const Vector& direction() const { return direction_; }
  T squared_distance() const { return nearest_.squaredNorm(); }
  /// A power of two, about 1 / size [1/m]. Products of four and more lengths are computed of lengths
  /// multiplied by it, which is exact, so that shapes of 1e-7 m and 1e7 m do not underflow or overflow
  /// in single precision.
  T unit() const { return unit_; }
  /// Whether the origin lies inside the hull, at least `depth` [m] from each face, and the hull is
  /// so thick that this result does not depend on rounding.
  bool holds_origin(T depth) const {
    if (size_ < 4) return false;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector& top = points_[k].point;
      const Vector& corner = points_[(k + 1) % 4].point;
      const Vector along = points_[(k + 2) % 4].point - corner;
      const Vector across = points_[(k + 3) % 4].point - corner;
      const Vector n = along.cross(across);
      const T length = n.norm(), above = n.dot(top - corner), height = n.dot(-corner);
      if (!(length > depth * std::max(along.norm(), across.norm())) ||
          !(std::abs(height) > depth * length) || (above > T(0)) != (height > T(0)))
        return false;
    }
    return true;
  }
  bool contains(const Point& p) const {
    for (int i = 0; i < size_; ++i)
      if ((*this)[i].a == p.a && (*this)[i].b == p.b) return true;
    return false;
  }

  enum class Step {
    nearer,    ///< the hull is now nearer to the origin; points that are not needed were removed
    stuck,     ///< the new point does not bring the hull nearer to the origin; nothing was changed
    enclosed,  ///< the origin lies inside the tetrahedron of the four points
  };
  /// Adds the support point of B - A in the direction of the origin. The point of the new hull
  /// nearest to the origin lies on a feature that has the new point as a corner. So only these
  /// features are compared.
  Step add(const Point& s) {
    Feature best{s.point, s.point};
    switch (size_) {
      case 1:
        best = edge(s.point, 0);
        break;
      case 2:
        best = face(s.point, 0, 1, normal(s.point, 0, 1));
        break;
      default:
        if (!nearest_face(s.point, best)) {
          points_[3] = s;
          size_ = 4;
          nearest_.setZero();
          return Step::enclosed;
        }
    }
    if (!(best.squared_distance < squared_distance())) return Step::stuck;
    if (best.size > 1) points_[0] = points_[best.first];
    if (best.size > 2) points_[1] = points_[best.second];
    points_[best.size - 1] = s;
    size_ = static_cast<int>(best.size);
    nearest_ = best.nearest;
    direction_ = best.direction;
    return Step::nearer;
  }

 private:
  /// A feature of the hull (vertex, edge or face) with the new point as a corner, and the point of
  /// the feature nearest to the origin. The other corners are none, one (`first`) or two (`first` <
  /// `second`) of the old points.
  struct Feature {
    Vector nearest, direction;
    T squared_distance = std::numeric_limits<T>::infinity();
    std::size_t size = 0, first = 0, second = 0;
  };

  Vector to(const Vector& s, std::size_t i) const { return points_[i].point - s; }
  Vector normal(const Vector& s, std::size_t i, std::size_t j) const {
    return (unit_ * to(s, i)).cross(to(s, j));
  }

  Feature edge(const Vector& s, std::size_t i) const {
    const Vector along = to(s, i);
    const T t = -s.dot(along);
    if (!(t > T(0))) return {s, s, s.squaredNorm(), 1, 0, 0};
    const Vector x = s + (t / along.squaredNorm()) * along;
    return {x, x, x.squaredNorm(), 2, i, 0};
  }

  // n is the normal times unit_. The plane through an edge, perpendicular to the triangle, separates the triangle from the
  // points that are beyond the edge. If the origin is beyond neither of the two edges at s, it
  // projects onto the face.
  Feature face(const Vector& s, std::size_t i, std::size_t j, const Vector& n) const {
    const T squared = n.squaredNorm();
    // If the points lie on a line to rounding, their normal consists of rounding errors.
    constexpr T parallel = T(1024) * std::numeric_limits<T>::epsilon();
    const bool is_flat = !(squared > parallel * parallel * Vector(unit_ * to(s, i)).squaredNorm() *
                                         to(s, j).squaredNorm());
    const bool is_beyond_i = is_flat || n.cross(to(s, i)).dot(s) > T(0);
    const bool is_beyond_j = is_flat || n.cross(to(s, j)).dot(s) < T(0);
    if (is_beyond_i && is_beyond_j) {
      const Feature along_i = edge(s, i), along_j = edge(s, j);
      return along_j.squared_distance < along_i.squared_distance ? along_j : along_i;
    }
    if (is_beyond_i) return edge(s, i);
    if (is_beyond_j) return edge(s, j);
    const T height = n.dot(s);
    const Vector x = (height / squared) * n;
    return {x, height < T(0) ? Vector(-n) : n, height * height / squared, 3, i, j};
  }

  /// Of the three faces with the new point as a corner, considers those that separate the origin
  /// from the hull, and takes the nearest.
  /// @returns false if there is no such face, so that the origin lies inside the hull
  bool nearest_face(const Vector& s, Feature& best) const {
    constexpr std::array<std::array<std::size_t, 2>, 3> sides = {{{0, 1}, {1, 2}, {0, 2}}};
    const std::array<Vector, 3> normals = {normal(s, 0, 1), normal(s, 1, 2), normal(s, 0, 2)};
    const T volume = normals[0].dot(to(s, 2));
    bool is_outside = false;
    for (std::size_t k = 0; k < 3; ++k) {
      // The normal of the last side has the opposite orientation.
      const T height = unit_ * normals[k].dot(s) * (k == 2 ? -volume : volume);
      if (height < T(0)) continue;
      is_outside = true;
      const Feature candidate = face(s, sides[k][0], sides[k][1], normals[k]);
      if (candidate.squared_distance < best.squared_distance) best = candidate;
    }
    return is_outside;
  }

  std::array<Point, 4> points_;
  int size_ = 1;
  T unit_;
  Vector nearest_, direction_;
};

/// The weights of the simplex's points in the convex combination that is nearest(): each >= 0, with
/// the sum 1.
template <std::floating_point T>
std::array<T, 3> weights_of(const Simplex<T>& simplex) {
  using Vector = typename Space<3, T>::Vector;
  std::array<T, 3> weight{T(1), T(0), T(0)};
  const Vector& x = simplex.nearest();
  if (simplex.size() == 2) {
    const Vector along = simplex[1].point - simplex[0].point;
    weight[1] = std::clamp(along.dot(x - simplex[0].point) / along.squaredNorm(), T(0), T(1));
    weight[0] = T(1) - weight[1];
  } else if (simplex.size() == 3) {
    const Vector p = simplex[0].point - x, q = simplex[1].point - x, r = simplex[2].point - x;
    const Vector n = (q - p).cross(r - p);
    weight = {n.dot(q.cross(r)), n.dot(r.cross(p)), n.dot(p.cross(q))};
    T sum = 0;
    for (T& w : weight) sum += w = std::max(w, T(0));
    if (!(sum > T(0))) return {T(1), T(0), T(0)};
    for (T& w : weight) w /= sum;
  }
  return weight;
}

}  // namespace moreau::detail
