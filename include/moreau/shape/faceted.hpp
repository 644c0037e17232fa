// SPDX-License-Identifier: MIT
// A polytope in place of a shape that has only a support function.
//
// Contact detection of polytopes takes a tenth of the time of contact detection by support points,
// and faces have several contact points. The polytope P is the convex hull of support points of the
// shape K, so it lies inside K. The points are added where P is farthest from K (the sandwich
// algorithm: G. Rote, Computing 48, 1992, for the plane): with h_K(d) = d . support(d) and the offset
// h_P(n) of a face with the unit outward normal n, the face with the largest e = h_K(n) - h_P(n) gets
// the new point support(n).
//
// Bound of the distance. The points of K farthest from P lie above a vertex, an edge or a face of P:
// their distance is h_K(d) - h_P(d) for a unit vector d in the normal cone of some vertex, so
// d = sum l_i n_i with l_i >= 0 over the faces at this vertex. Support functions are sublinear, and h_P
// is linear on the cone:
//
//   h_K(d) <= sum l_i h_K(n_i) = h_P(d) + sum l_i e_i <= h_P(d) + max e_i sum l_i.
//
// With the unit vector c = sum n_i / |sum n_i| and g = min n_i . c > 0: 1 >= d . c >= g sum l_i. So no
// point of K is farther from P than the largest max e_i / g of all vertices.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace moreau {

namespace detail {

template <class S>
struct PolytopeInSpace;
template <class T>
struct PolytopeInSpace<Space<2, T>> : std::type_identity<Polygon<T>> {};
template <class T>
struct PolytopeInSpace<Space<3, T>> : std::type_identity<Polyhedron<T>> {};

/// The faces at vertex v.
template <std::floating_point T>
std::array<std::size_t, 2> faces_at(const Polygon<T>& polygon, std::size_t v) {
  return {v, (v + polygon.vertex_count() - 1) % polygon.vertex_count()};
}
template <std::floating_point T>
std::span<const std::uint32_t> faces_at(const Polyhedron<T>& polyhedron, std::size_t v) {
  return polyhedron.vertex_faces(v);
}

}  // namespace detail

/// A polytope with at most n vertices inside a convex shape, and how far it is from the surface of
/// the shape. Example: `simulation.add_shape(Faceted<MyShape>(shape, 100).polytope())`.
template <ConvexShape ShapeT>
class Faceted {
 public:
  using Space = SpaceOf<ShapeT>;
  using Scalar = typename Space::Scalar;
  using Vector = typename Space::Vector;
  /// Polygon in the plane, Polyhedron in space.
  using Polytope = typename detail::PolytopeInSpace<Space>::type;

  /// The polytope has fewer vertices if the shape is a polytope or close to one.
  /// @param shape convex, of any frame; it is not stored
  /// @param n     largest number of vertices, at least 2 D + 2^D: 8 in the plane, 14 in space
  /// @throws std::invalid_argument for a smaller n; the exceptions of Polygon or Polyhedron for a
  ///         shape without thickness or a support point that is not finite
  Faceted(const ShapeT& shape, std::size_t n)
      : points_(first_points(shape, n)), polytope_(std::span<const Vector>(points_)) {
    while (true) {
      const std::vector<Candidate> candidates = measure(shape);
      const std::size_t room = n - points_.size();
      if (room == 0 || candidates.empty()) break;
      const std::size_t more = std::min({room, candidates.size(), 1 + points_.size() / 8});
      for (std::size_t k = 0; k < more; ++k) points_.push_back(candidates[k].point);
      polytope_ = Polytope(std::span<const Vector>(points_));
    }
    points_.clear();
  }

  /// The convex hull of support points. Its frame has the axes of the frame of the shape; its origin,
  /// the centre of mass of the polytope, is at polytope().centroid_of_input() in that frame.
  const Polytope& polytope() const { return polytope_; }
  /// No point of the shape is farther than this from the polytope, which lies inside the shape [m].
  Scalar error() const { return error_; }

 private:
  struct Candidate {
    Scalar height;  // of the point above the face [m]
    Vector point;
  };

  static std::vector<Vector> first_points(const ShapeT& shape, std::size_t n) {
    constexpr std::size_t corners = std::size_t{1} << Space::dim;
    constexpr std::size_t least = 2 * std::size_t(Space::dim) + corners;
    require(n >= least, "Faceted", "n", n, "must be at least 2 D + 2^D, in space 14");
    std::vector<Vector> points;
    // Oblique directions: points that mirror each other in a symmetric shape give faces that are almost
    // coplanar, which no pair cache can tell apart.
    const auto oblique = Space::exp(Space::Angular::Constant(Scalar(0.4)));
    const auto add = [&](const Vector& direction) {
      const Vector point = shape.support(oblique * direction);
      if (std::find(points.begin(), points.end(), point) == points.end()) points.push_back(point);
    };
    for (int axis = 0; axis < Space::dim; ++axis) {
      add(Vector::Unit(axis));
      add(-Vector::Unit(axis));
    }
    for (std::size_t bits = 0; bits < corners; ++bits) {
      Vector corner;
      for (int axis = 0; axis < Space::dim; ++axis)
        corner[axis] = (bits >> axis & 1) != 0 ? Scalar(1) : Scalar(-1);
      add(corner);
    }
    return points;
  }

  /// Sets the error. Returns a point of the shape above each face that the shape exceeds by more than
  /// rounding, farthest first.
  std::vector<Candidate> measure(const ShapeT& shape) {
    const Scalar rounding =
        64 * std::numeric_limits<Scalar>::epsilon() * (polytope_.circumradius() + center().norm());
    std::vector<Candidate> candidates;
    std::vector<Scalar> heights;
    for (std::size_t f = 0; f < polytope_.face_count(); ++f) {
      const Vector normal = normal_of(f);
      const Vector point = shape.support(normal);
      const Scalar offset = polytope_.face_offsets()[static_cast<Eigen::Index>(f)];
      heights.push_back(std::max(normal.dot(point - center()) - offset, Scalar(0)));
      if (heights.back() > rounding) candidates.push_back({heights.back(), point});
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const auto& a, const auto& b) { return a.height > b.height; });
    error_ = 0;
    for (std::size_t v = 0; v < polytope_.vertex_count(); ++v)
      error_ = std::max(error_, bound_at(v, heights));
    return candidates;
  }
  /// The largest e_i / g of the faces at a vertex; see the head of this file.
  Scalar bound_at(std::size_t v, const std::vector<Scalar>& heights) const {
    Vector sum = Vector::Zero();
    Scalar highest = 0;
    for (const std::size_t f : detail::faces_at(polytope_, v)) {
      sum += normal_of(f);
      highest = std::max(highest, heights[f]);
    }
    const Vector axis = sum.normalized();
    Scalar least = 1;
    for (const std::size_t f : detail::faces_at(polytope_, v))
      least = std::min(least, axis.dot(normal_of(f)));
    if (highest == 0) return 0;
    return least > 0 ? highest / least : std::numeric_limits<Scalar>::infinity();
  }
  Vector normal_of(std::size_t f) const {
    return polytope_.face_normals().row(static_cast<Eigen::Index>(f)).transpose();
  }
  const Vector& center() const { return polytope_.centroid_of_input(); }

  std::vector<Vector> points_;  // while the polytope is constructed, in the frame of the shape
  Polytope polytope_;
  Scalar error_ = 0;  // see error()
};

}  // namespace moreau
