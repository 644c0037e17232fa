// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "moreau/shape/convex_hull.hpp"
#include "moreau/shape/detail/polytope_base.hpp"

namespace moreau {

namespace detail {

struct PolygonNames {
  static constexpr const char* mass_properties = "Polygon::mass_properties";
  static constexpr const char* scaled = "Polygon::scaled";
  static constexpr const char* unit_of_second_moment = "m^4 must be positive and finite";
};

}  // namespace detail

/// A convex polygon. Its vertices are ordered counter-clockwise. Its faces are its edges: face i
/// leads from vertex i to vertex i + 1.
template <std::floating_point T = double>
class Polygon : public PolytopeBase<Space<2, T>, detail::PolygonNames> {
  using Base = PolytopeBase<moreau::Space<2, T>, detail::PolygonNames>;

 public:
  using typename Base::Space, typename Base::Vector;

  /// The convex hull of points. Points inside the hull or on an edge are removed. The others keep
  /// their cyclic order, beginning with the point that comes first in the input.
  /// @param vertices N points, in any order and in any frame [m]
  /// @throws std::invalid_argument for fewer than 3 points, a point that is not finite, points that
  ///                               coincide or are collinear, or moments that the scalar type
  ///                               cannot represent
  explicit Polygon(std::span<const Vector> vertices);
  /// The same of points that have the rounding of a file, such as 6 decimals. A vertex that is nearer to the line through its
  /// neighbours than HullTolerance::rounded times this rounding is removed. If the shape is as thin as this, the result is
  /// that without rounding.
  /// @param rounding largest error of a coordinate [m], >= 0: half a unit of the last digit
  /// @throws std::invalid_argument as above, or if the rounding is not finite or negative
  Polygon(std::span<const Vector> vertices, T rounding);
  /// The convex hull of a list of points: Polygon<double>({{0, 0}, {1, 0}, ..}).
  explicit Polygon(std::initializer_list<VectorArgument<Space>> vertices)
      : Polygon(std::span<const Vector>(std::vector<Vector>(vertices.begin(), vertices.end()))) {}

  /// N, because the faces are the edges
  std::size_t face_count() const { return this->vertex_count(); }
  std::size_t edge_count() const { return this->vertex_count(); }  ///< N
  T area() const { return this->volume(); }                        ///< the area [m^2]

  /// The same polygon with all lengths multiplied by `factor` [-], > 0.
  /// @throws std::invalid_argument unless the factor and the new moments are finite and greater
  ///                               than zero
  [[nodiscard]] Polygon scaled(T factor) const {
    Polygon copy = *this;
    copy.scale(factor);
    return copy;
  }

 private:
  friend struct SerializationAccess;
  using Base::vertices_, Base::face_normals_, Base::face_offsets_;
  Polygon() = default;
  auto serialized_members() { return Base::members(); }
  void deserialized() const {
    const Eigen::Index count = vertices_.rows();
    require(count >= 3 && face_normals_.rows() == count && face_offsets_.size() == count, "Polygon",
            "vertices", count, "must be at least 3, with one edge for each");
  }

  /// @param ring vertices of the hull, counter-clockwise
  void build(std::span<const Vector> vertices, std::span<const std::uint32_t> ring);
  Vector vertex(Eigen::Index i) const { return vertices_.row(i % vertices_.rows()).transpose(); }

  Moments<Space> sum_moments() const {
    Moments<Space> sum;
    for (Eigen::Index i = 0; i < vertices_.rows(); ++i) {
      typename Space::Matrix corners;
      corners << vertex(i), vertex(i + 1);
      sum.add_simplex(corners);
    }
    return sum;
  }

  void set_faces() {
    face_normals_.resize(vertices_.rows(), 2);
    face_offsets_.resize(vertices_.rows());
    for (Eigen::Index i = 0; i < vertices_.rows(); ++i) {
      const Vector along = vertex(i + 1) - vertex(i);
      const Vector normal = Vector(along.y(), -along.x()).normalized();
      face_normals_.row(i) = normal.transpose();
      face_offsets_[i] = normal.dot(vertex(i) + vertex(i + 1)) / T(2);
    }
    this->summarize_faces();
  }
};

// Defined outside of the class, so that it is compiled only once where a program declares the class
// extern.
template <std::floating_point T>
Polygon<T>::Polygon(std::span<const Vector> vertices) {
  build(vertices, convex_hull(vertices, "Polygon"));
}

template <std::floating_point T>
Polygon<T>::Polygon(std::span<const Vector> vertices, T rounding) : Polygon(vertices) {
  detail::require_rounding(rounding, "Polygon");
  const T flat = T(HullTolerance{}.rounded) * rounding;
  if (!(flat > 0) || !(this->inradius() > 2 * flat)) return;
  const std::vector<std::uint32_t> ring = convex_hull(vertices, "Polygon", double(rounding));
  if (ring.size() != this->vertex_count()) build(vertices, ring);
}

template <std::floating_point T>
void Polygon<T>::build(std::span<const Vector> vertices, std::span<const std::uint32_t> ring) {
  vertices_.resize(static_cast<Eigen::Index>(ring.size()), 2);
  for (Eigen::Index i = 0; i < vertices_.rows(); ++i) {
    vertices_.row(i) =
        (vertices[ring[static_cast<std::size_t>(i)]] - vertices[ring[0]]).transpose();
  }
  const Moments<Space> rough = sum_moments();
  require(std::isfinite(rough.volume) && rough.volume > T(0), "Polygon", "area", rough.volume,
          "m^2 must be positive and finite");
  this->move_origin(rough, vertices[ring[0]]);
  this->set_moments(sum_moments(), "Polygon");
  set_faces();
}

}  // namespace moreau
