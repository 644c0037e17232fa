// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

#include "moreau/core/serialize.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/moments.hpp"
#include "moreau/shape/vertices.hpp"

namespace moreau {

/// What Polygon and Polyhedron share: vertices and planes of the faces as matrices, exact moments,
/// and the functions of a shape. The body frame has the axes of the input and its origin at the
/// centre of mass. In the plane the faces are the edges.
/// @tparam Names  the strings mass_properties, scaled and unit_of_second_moment for errors
template <EuclideanSpace S, class Names>
class PolytopeBase {
 public:
  using Space = S;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using FaceOffsets = Eigen::Array<Scalar, Eigen::Dynamic, 1>;

  const VertexMatrix<S>& vertices() const { return vertices_; }          ///< N x D [m]
  const VertexMatrix<S>& face_normals() const { return face_normals_; }  ///< F x D, unit, outward
  const FaceOffsets& face_offsets() const { return face_offsets_; }  ///< F, normal . x on it [m]
  std::size_t vertex_count() const { return static_cast<std::size_t>(vertices_.rows()); }  ///< N

  /// Centre of mass in the coordinates of the input [m].
  const Vector& centroid_of_input() const { return centroid_of_input_; }
  Scalar volume() const { return moments_.volume; }      ///< [m^D]: in the plane the area
  Scalar circumradius() const { return circumradius_; }  ///< largest |vertex| from the origin [m]
  Scalar inradius() const { return inradius_; }  ///< from the origin to the nearest face [m]
  /// About the origin, which is the centre of mass, at density one.
  const Moments<S>& moments() const { return moments_; }
  /// Least distance between two face normals, as unit vectors [-]: about the least angle [rad].
  Scalar normal_spacing() const { return normal_spacing_; }

  /// Index of the first vertex that lies farthest in the direction (any length but zero), body
  /// coordinates.
  std::size_t support_vertex(const VectorArgument<S>& direction) const {
    return farthest_vertex<S>(vertices_, direction);
  }
  /// A vertex that lies farthest in the direction (any length but zero), body coordinates [m].
  Vector support(const VectorArgument<S>& direction) const {
    return row_of<S>(vertices_, static_cast<Eigen::Index>(support_vertex(direction)));
  }

  /// @param density [kg/m^D], > 0
  /// @throws std::invalid_argument unless the density is finite and greater than zero
  MassProperties<S> mass_properties(Scalar density) const {
    detail::require_positive(density, Names::mass_properties, "density");
    typename S::Inertia inertia = moments_.inertia();
    inertia *= density;
    return {density * moments_.volume, Vector::Zero(), inertia};
  }
  /// The tight box around the shape at the pose, world axes [m].
  Aabb<S> bounding_box(const Pose<S>& pose) const { return box_around<S>(vertices_, pose); }

 protected:
  PolytopeBase() = default;
  /// References to all members, for serialization.
  auto members() {
    return std::tie(vertices_, face_normals_, face_offsets_, centroid_of_input_, circumradius_,
                    inradius_, normal_spacing_, moments_);
  }

  /// Moves the origin of the vertices to the centre of mass, which `rough` gives in the coordinates
  /// that have their origin at `origin_in_input`.
  void move_origin(const Moments<S>& rough, const Vector& origin_in_input) {
    const Vector center = rough.first / rough.volume;
    centroid_of_input_ = origin_in_input + center;
    // Eigen's square root of several floats at once rounds differently from that of one.
    Eigen::Array<Scalar, Eigen::Dynamic, 1> squares(vertices_.rows());
    for (Eigen::Index i = 0; i < vertices_.rows(); ++i) {
      for (int k = 0; k < S::dim; ++k) vertices_(i, k) -= center[k];
      squares[i] = squared_distance<S>(vertices_, i, Vector::Zero());
    }
    circumradius_ = squares.sqrt().maxCoeff();
  }
  /// Takes the moments.
  /// @throws std::invalid_argument in the name of the function if the second moment is not regular
  void set_moments(const Moments<S>& moments, std::string_view function) {
    moments_ = moments;
    require(moments_.are_regular(), function, "second moment", moments_.second.trace(),
            Names::unit_of_second_moment);
  }
  /// Computes what follows from face_normals_ and face_offsets_.
  void summarize_faces() {
    inradius_ = face_offsets_.minCoeff();
    normal_spacing_ = least_distance<S>(face_normals_);
  }
  /// Multiplies all lengths by the factor [-], > 0.
  void scale(Scalar factor) {
    detail::require_positive(factor, Names::scaled, "factor");
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
