// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <initializer_list>
#include <span>
#include <vector>

#include "moreau/core/serialize.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/convex_hull.hpp"
#include "moreau/shape/moments.hpp"
#include "moreau/shape/vertices.hpp"

namespace moreau {

/// A convex polygon. Its body frame has the axes of the input and its origin at the centre of mass.
/// Face i is the edge from vertex i to vertex i + 1; they run counter-clockwise.
template <std::floating_point T = double>
class Polygon {
 public:
  using Space = moreau::Space<2, T>;
  using Scalar = T;
  using Vector = typename Space::Vector;
  using FaceOffsets = Eigen::Array<T, Eigen::Dynamic, 1>;

  /// The convex hull of the vertices [m]; those inside or on an edge are dropped, the others keep
  /// their cyclic order, the first of the input first.
  /// @param vertices N points, in any order and in any frame [m]
  /// @throws std::invalid_argument for fewer than 3, one that is not finite, ones that coincide or
  ///         are collinear, or moments that the scalar cannot hold
  explicit Polygon(std::span<const Vector> vertices);
  /// The same from a list of points: Polygon<double>({{0, 0}, {1, 0}, ..}).
  explicit Polygon(std::initializer_list<VectorArgument<Space>> vertices)
      : Polygon(std::span<const Vector>(std::vector<Vector>(vertices.begin(), vertices.end()))) {}

  const VertexMatrix<Space>& vertices() const { return vertices_; }  ///< N x 2 [m]
  const VertexMatrix<Space>& face_normals() const {
    return face_normals_;
  }                                                                  ///< N x 2, unit, outward
  const FaceOffsets& face_offsets() const { return face_offsets_; }  ///< N, normal . x on it [m]
  std::size_t vertex_count() const { return static_cast<std::size_t>(vertices_.rows()); }  ///< N
  std::size_t face_count() const { return vertex_count(); }  ///< N: the faces are the edges
  std::size_t edge_count() const { return vertex_count(); }  ///< N

  /// Where the centre of mass was in the coordinates of the input [m].
  const Vector& centroid_of_input() const { return centroid_of_input_; }
  T area() const { return moments_.volume; }        ///< [m^2]
  T volume() const { return moments_.volume; }      ///< the area, under its uniform name [m^2]
  T circumradius() const { return circumradius_; }  ///< largest |vertex| from the origin [m]
  T inradius() const { return inradius_; }          ///< from the origin to the nearest face [m]
  /// About the origin, which is the centre of mass, at density one.
  const Moments<Space>& moments() const { return moments_; }
  /// The least distance of two face normals, as unit vectors [-]: about the least angle [rad].
  T normal_spacing() const { return normal_spacing_; }

  /// The first vertex that lies farthest in the direction (any length but zero), body coordinates.
  std::size_t support_vertex(const VectorArgument<Space>& direction) const {
    return farthest_vertex<Space>(vertices_, direction);
  }
  /// A vertex that is farthest in the direction (any length but zero), body coordinates [m].
  Vector support(const VectorArgument<Space>& direction) const {
    return vertices_.row(static_cast<Eigen::Index>(support_vertex(direction))).transpose();
  }

  /// @param density per area [kg/m^2], > 0
  /// @throws std::invalid_argument unless the density is finite and greater than zero
  MassProperties<Space> mass_properties(T density) const {
    detail::require_positive(density, "Polygon::mass_properties", "density");
    return {density * moments_.volume, Vector::Zero(), density * moments_.inertia()};
  }
  /// The tight box around it at the pose, world axes [m].
  Aabb<Space> bounding_box(const Pose<Space>& pose) const {
    return box_around<Space>(vertices_, pose);
  }

  /// The same polygon, all lengths times the factor [-], > 0.
  /// @throws std::invalid_argument unless the factor is finite and greater than zero, and so are
  ///         the moments
  Polygon scaled(T factor) const {
    detail::require_positive(factor, "Polygon::scaled", "factor");
    Polygon copy = *this;
    copy.vertices_ *= factor;
    copy.face_offsets_ *= factor;
    copy.circumradius_ *= factor;
    copy.inradius_ *= factor;
    copy.centroid_of_input_ *= factor;
    copy.moments_ = moments_.scaled(factor);
    require(copy.moments_.are_regular(), "Polygon::scaled", "second moment",
            copy.moments_.second.trace(), "m^4 must be positive and finite");
    return copy;
  }

 private:
  friend struct SerializationAccess;
  Polygon() = default;
  auto serialized_members() {
    return std::tie(vertices_, face_normals_, face_offsets_, centroid_of_input_, circumradius_,
                    inradius_, normal_spacing_, moments_);
  }
  void deserialized() const {
    const Eigen::Index count = vertices_.rows();
    require(count >= 3 && face_normals_.rows() == count && face_offsets_.size() == count, "Polygon",
            "vertices", count, "must be 3 at least, with as many edges");
  }

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
    inradius_ = face_offsets_.minCoeff();
    normal_spacing_ = least_distance<Space>(face_normals_);
  }

  VertexMatrix<Space> vertices_, face_normals_;
  FaceOffsets face_offsets_;
  Vector centroid_of_input_ = Vector::Zero();
  T circumradius_ = 0, inradius_ = 0, normal_spacing_ = 0;
  Moments<Space> moments_;
};

// Outside of the class: compiled once where a program declares the class extern.
template <std::floating_point T>
Polygon<T>::Polygon(std::span<const Vector> vertices) {
  const std::vector<std::uint32_t> ring = convex_hull(vertices, "Polygon");
  vertices_.resize(static_cast<Eigen::Index>(ring.size()), 2);
  for (Eigen::Index i = 0; i < vertices_.rows(); ++i) {
    vertices_.row(i) =
        (vertices[ring[static_cast<std::size_t>(i)]] - vertices[ring[0]]).transpose();
  }
  const Moments<Space> rough = sum_moments();
  require(std::isfinite(rough.volume) && rough.volume > T(0), "Polygon", "area", rough.volume,
          "m^2 must be positive and finite");
  const Vector center = rough.first / rough.volume;
  centroid_of_input_ = vertices[ring[0]] + center;
  vertices_.rowwise() -= center.transpose();
  moments_ = sum_moments();
  require(moments_.are_regular(), "Polygon", "second moment", moments_.second.trace(),
          "m^4 must be positive and finite");
  circumradius_ = vertices_.rowwise().norm().maxCoeff();
  set_faces();
}

}  // namespace moreau
