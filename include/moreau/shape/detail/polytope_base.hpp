// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string_view>
#include <tuple>

#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/detail/vertices.hpp"
#include "moreau/shape/moments.hpp"

namespace moreau {
namespace detail {

/// @throws std::invalid_argument unless the rounding of points is finite and >= 0
template <class T>
void require_rounding(T rounding, const char* function) {
  require(std::isfinite(rounding) && rounding >= 0, function, "rounding", rounding,
          "m must be finite and >= 0");
}

/// Names the frame in which the points of a polytope were given.
struct InputFrame {
  /// Adds a vector to centroid_of_input() [m].
  static void move_by(auto& polytope, const auto& vector) { polytope.centroid_of_input_ += vector; }
};

}  // namespace detail

/// The common base of Polygon and Polyhedron: vertices and planes of the faces as matrices, exact
/// moments, and the functions of a shape. The body frame has the axes of the input coordinates and
/// its origin at the centre of mass. In the plane the faces are the edges.
/// @tparam Names  a class with the strings mass_properties, scaled and unit_of_second_moment for
///                error messages
template <EuclideanSpace S, class Names>
class PolytopeBase {
 public:
  using Space = S;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using FaceOffsets = Eigen::Array<Scalar, Eigen::Dynamic, 1>;

  /// N x D, one vertex per row, body coordinates [m]
  const VertexMatrix<S>& vertices() const { return vertices_; }
  /// F x D, one unit outward normal per row, body coordinates
  const VertexMatrix<S>& face_normals() const { return face_normals_; }
  /// normal . x for the points x of each face, F numbers [m]
  const FaceOffsets& face_offsets() const { return face_offsets_; }
  std::size_t vertex_count() const { return static_cast<std::size_t>(vertices_.rows()); }  ///< N

  /// Position of the centre of mass in the coordinates of the input [m].
  const Vector& centroid_of_input() const { return centroid_of_input_; }
  Scalar volume() const { return moments_.volume; }  ///< volume, in the plane the area [m^D]
  /// distance of the farthest vertex from the origin [m]
  Scalar circumradius() const { return circumradius_; }
  /// distance of the nearest face from the origin [m]
  Scalar inradius() const { return inradius_; }
  /// Moments at density one about the origin, which is the centre of mass.
  const Moments<S>& moments() const { return moments_; }
  /// Smallest distance |n_i - n_j| between the unit normals of two faces [-], approximately the
  /// smallest angle between them [rad].
  Scalar normal_spacing() const { return normal_spacing_; }

  /// Index of the first vertex that is farthest in the direction.
  /// @param direction  body coordinates, of any length but zero
  std::size_t support_vertex(const VectorArgument<S>& direction) const {
    return farthest_vertex<S>(vertices_, direction);
  }
  /// A vertex farthest in the direction, body coordinates [m].
  /// @param direction  body coordinates, of any length but zero
  Vector support(const VectorArgument<S>& direction) const {
    return row_of<S>(vertices_, static_cast<Eigen::Index>(support_vertex(direction)));
  }

  /// Mass, centre of mass and inertia at a uniform density.
  /// @param density [kg/m^D], > 0
  /// @throws std::invalid_argument unless the density is finite and > 0
  MassProperties<S> mass_properties(Scalar density) const {
    require_positive(density, Names::mass_properties, "density");
    typename S::Inertia inertia = moments_.inertia();
    inertia *= density;
    return {density * moments_.volume, Vector::Zero(), inertia};
  }
  /// The smallest axis-aligned box around the shape at a pose, world axes [m].
  Aabb<S> bounding_box(const Pose<S>& pose) const { return box_around<S>(vertices_, pose); }

 protected:
  friend struct detail::InputFrame;
  PolytopeBase() = default;
  /// References to all members, for serialization.
  auto members() {
    return std::tie(vertices_, face_normals_, face_offsets_, centroid_of_input_, circumradius_,
                    inradius_, normal_spacing_, moments_);
  }

  /// Moves the origin of the vertex coordinates to the centre of mass.
  /// @param rough            moments in the present coordinates
  /// @param origin_in_input  position of the present origin in the coordinates of the input [m]
  void move_origin(const Moments<S>& rough, const Vector& origin_in_input) {
    const Vector center = rough.first / rough.volume;
    centroid_of_input_ = origin_in_input + center;
    Scalar largest = 0;
    for (Eigen::Index i = 0; i < vertices_.rows(); ++i) {
      for (int k = 0; k < S::dim; ++k) vertices_(i, k) -= center[k];
      largest = std::max(largest, squared_distance<S>(vertices_, i, Vector::Zero()));
    }
    circumradius_ = std::sqrt(largest);
  }
  /// Sets the moments.
  /// @param function  name of the calling function, for error messages
  /// @throws std::invalid_argument if the scalar type cannot represent the moments
  void set_moments(const Moments<S>& moments, std::string_view function) {
    moments_ = moments;
    Scalar trace = 0;
    for (int k = 0; k < S::dim; ++k) trace += moments_.second(k, k);
    require(moments_.are_regular(), function, "second moment", trace, Names::unit_of_second_moment);
  }
  /// Computes inradius and normal spacing from face_normals_ and face_offsets_.
  void summarize_faces() {
    inradius_ = face_offsets_.minCoeff();
    normal_spacing_ = least_distance<S>(face_normals_);
  }
  /// Multiplies all lengths by the factor [-], > 0.
  void scale(Scalar factor) {
    require_positive(factor, Names::scaled, "factor");
    vertices_ *= factor;
    face_offsets_ *= factor;
    circumradius_ *= factor;
    inradius_ *= factor;
    centroid_of_input_ *= factor;
    set_moments(moments_.scaled(factor), Names::scaled);
  }

  VertexMatrix<S> vertices_;                   ///< see vertices()
  VertexMatrix<S> face_normals_;               ///< see face_normals()
  FaceOffsets face_offsets_;                   ///< see face_offsets()
  Vector centroid_of_input_ = Vector::Zero();  ///< see centroid_of_input()
  Scalar circumradius_ = 0;                    ///< see circumradius()
  Scalar inradius_ = 0;                        ///< see inradius()
  Scalar normal_spacing_ = 0;                  ///< see normal_spacing()
  Moments<S> moments_;                         ///< see moments()
};

}  // namespace moreau
