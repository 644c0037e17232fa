// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <sstream>
#include <tuple>
#include <vector>

#include "moreau/core/components.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/shape/circumradius.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/detail/overlap_test.hpp"
#include "moreau/shape/detail/seams.hpp"
#include "moreau/shape/detail/vertices.hpp"

namespace moreau {

namespace detail {

/// A polygon or polyhedron, which knows where its points were given.
template <class T>
concept KnowsInput = Polytope<T> && requires(const T shape) {
  { shape.centroid_of_input() } -> std::same_as<const typename T::Vector&>;
};

}  // namespace detail

/// A rigid grain of several convex parts: a concave stone of polyhedra, an L of two polygons, a clump
/// of balls. Parts touch other grains, each as a convex shape. Parts of one grain do not touch one
/// another. For a grain of parts of different types, ShapeT is a OneOf.
///
/// The body frame has the axes of the frame in which the parts are given, and its origin at the centre
/// of mass. Parts that are disjoint, or have a common face, have the mass of their sum, exactly. Parts
/// that overlap need mass properties from elsewhere, for example of the closed mesh around them.
///
///     const Polygon<> foot({{0, 0}, {2, 0}, {2, 1}, {0, 1}}), leg({{0, 1}, {1, 1}, {1, 3}, {0, 3}});
///     const Compound<Polygon<>> l({foot, leg});
///
/// @tparam ShapeT shape of the parts
template <ConvexShape ShapeT>
class Compound {
 public:
  using PartShape = ShapeT;  ///< shape of the parts
  using Space = SpaceOf<ShapeT>;
  using Scalar = typename Space::Scalar;
  using Vector = typename Space::Vector;

  /// A convex part of the grain.
  struct Part {
    ShapeT shape = SerializationAccess::blank<ShapeT>();  ///< in its own frame
    /// From the frame of the part to the frame of the grain; for a constructor, to the frame in which
    /// all parts are given.
    Pose<Space> pose;
  };

  /// Parts at poses. They may have common faces, but not overlap.
  /// @param parts one or more, in any common frame
  /// @throws std::invalid_argument for no part, a pose that is not finite or whose rotation is not of
  ///         unit length, two parts that overlap by more than about 1e-6 of their size, or mass
  ///         properties that the scalar type cannot represent
  explicit Compound(std::span<const Part> parts) : parts_(parts.begin(), parts.end()) {
    require_parts();
    require_disjoint();
    set_mass(sum_of_parts());
  }
  /// Parts at poses, which may overlap, with given mass properties.
  /// @param parts one or more, in any common frame
  /// @param of_density_one mass properties of the whole grain at density 1 in the frame of the parts:
  ///        the mass is the volume [m^D], the inertia [m^(D+2)] is about the centre; of a closed mesh
  ///        mass_properties(mesh, 1.0)
  /// @throws std::invalid_argument for no part, a pose that is not finite or whose rotation is not of
  ///         unit length, a volume or a centre that do not fit into the box around the parts, or an
  ///         inertia that no body has: not symmetric, or a sum of two principal moments below the third
  Compound(std::span<const Part> parts, const MassProperties<Space>& of_density_one)
      : parts_(parts.begin(), parts.end()) {
    require_parts();
    require_body(of_density_one);
    set_mass(of_density_one);
  }
  /// Polygons or polyhedra that stay where their points were given.
  /// @throws std::invalid_argument as for parts at poses
  explicit Compound(std::span<const ShapeT> shapes) requires detail::KnowsInput<ShapeT>
      : Compound(std::span<const Part>(in_place(shapes))) {}
  /// Polygons or polyhedra, which may overlap, that stay where their points were given.
  /// @param of_density_one as for parts at poses
  /// @throws std::invalid_argument as for parts at poses
  Compound(std::span<const ShapeT> shapes,
           const MassProperties<Space>& of_density_one) requires detail::KnowsInput<ShapeT>
      : Compound(std::span<const Part>(in_place(shapes)), of_density_one) {}
  /// A list of parts at poses.
  explicit Compound(std::initializer_list<Part> parts)
      : Compound(std::span<const Part>(parts.begin(), parts.size())) {}
  /// A list of polygons or polyhedra that stay where their points were given.
  explicit Compound(std::initializer_list<ShapeT> shapes) requires detail::KnowsInput<ShapeT>
      : Compound(std::span<const ShapeT>(shapes.begin(), shapes.size())) {}

  /// The parts, in the order of the input, with their poses in the body frame.
  const std::vector<Part>& parts() const { return parts_; }
  /// Position of the centre of mass in the frame in which the parts were given [m].
  const Vector& centroid_of_input() const { return centroid_of_input_; }
  Scalar volume() const { return unit_.mass; }  ///< volume, in the plane the area [m^D]
  /// Volume of the grain over the sum of the volumes of its parts [-]: 1 if they do not overlap.
  Scalar volume_share() const { return volume_share_; }
  /// Distance of the farthest point of the grain from the origin [m]; an upper bound unless the parts
  /// are polytopes or balls.
  Scalar circumradius() const { return circumradius_; }

  /// Where the parts touch one another; for contact detection.
  const detail::Seams& seams() const requires Polytope<ShapeT> { return seams_; }

  /// Mass, centre of mass and inertia at a uniform density.
  /// @param density [kg/m^D], > 0
  /// @throws std::invalid_argument unless the density is finite and > 0
  MassProperties<Space> mass_properties(Scalar density) const {
    require_positive(density, "Compound::mass_properties", "density");
    typename Space::Inertia inertia = unit_.inertia;
    inertia *= density;
    return {density * unit_.mass, Vector::Zero(), inertia};
  }
  /// A box around all parts at a pose of the grain, world axes [m].
  Aabb<Space> bounding_box(const Pose<Space>& pose) const {
    Aabb<Space> box;
    for (const Part& part : parts_) {
      const Aabb<Space> of_part = part.shape.bounding_box(pose * part.pose);
      box.merge(of_part.lower);
      box.merge(of_part.upper);
    }
    return box;
  }

  /// The same grain with all lengths multiplied by `factor` [-], > 0.
  /// @throws std::invalid_argument unless the factor is finite and > 0; also the
  ///         exceptions of the parts
  [[nodiscard]] Compound scaled(Scalar factor) const requires Scalable<ShapeT> {
    require_positive(factor, "Compound::scaled", "factor");
    Compound copy = *this;
    for (Part& part : copy.parts_) {
      part.shape = part.shape.scaled(factor);
      part.pose.position *= factor;
    }
    copy.centroid_of_input_ *= factor;
    copy.circumradius_ *= factor;
    copy.unit_.mass *= std::pow(factor, Scalar(Space::dim));
    copy.unit_.inertia *= std::pow(factor, Scalar(Space::dim + 2));
    copy.require_mass("Compound::scaled");
    return copy;
  }

 private:
  friend struct SerializationAccess;
  Compound() = default;
  auto serialized_members() {
    return std::tie(parts_, centroid_of_input_, unit_.mass, unit_.inertia, volume_share_,
                    circumradius_);
  }
  void deserialized() {
    require(!parts_.empty(), "Compound", "parts.size()", parts_.size(), "must be at least 1");
    find_seams();
  }
  void find_seams() {
    if constexpr (Polytope<ShapeT>) seams_.find(parts_);
  }

  static std::vector<Part> in_place(
      std::span<const ShapeT> shapes) requires detail::KnowsInput<ShapeT> {
    std::vector<Part> parts;
    for (const ShapeT& shape : shapes) parts.push_back({shape, {shape.centroid_of_input()}});
    return parts;
  }

  void require_parts() const {
    require(!parts_.empty(), "Compound", "parts.size()", parts_.size(), "must be at least 1");
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const Pose<Space>& pose = parts_[k].pose;
      require(pose.is_finite() && Space::is_rotation(pose.rotation), "Compound", "part", k,
              "must have a finite position and a rotation of unit length");
    }
  }
  void require_disjoint() const {
    for (std::size_t i = 0; i < parts_.size(); ++i)
      for (std::size_t j = i + 1; j < parts_.size(); ++j) {
        if (!detail::parts_overlap<Space>(parts_[i], parts_[j])) continue;
        std::ostringstream pair;
        pair << i << " and " << j;
        throw_invalid("Compound", "parts", pair.str(),
                      "must not overlap, unless the mass properties of the grain are given");
      }
  }

  /// Mass properties of the sum of the parts at density 1, by the parallel axis theorem.
  MassProperties<Space> sum_of_parts() const {
    MassProperties<Space> sum;
    for (const Part& part : parts_) {
      const auto mass = part.shape.mass_properties(Scalar(1));
      sum.mass += mass.mass;
      sum.center += mass.mass * part.pose(mass.center);
    }
    sum.center /= sum.mass;
    for (const Part& part : parts_) {
      const auto mass = part.shape.mass_properties(Scalar(1));
      const typename Space::Inertia turn = Space::adjoint(part.pose.rotation);
      const typename Space::Lever arm = Space::lever(part.pose(mass.center) - sum.center);
      sum.inertia += turn * mass.inertia * turn.transpose() + mass.mass * arm.transpose() * arm;
    }
    return sum;
  }
  /// Requires mass properties of a body that fits into the box around the parts.
  void require_body(const MassProperties<Space>& given) const {
    constexpr const char* self = "Compound";
    const Aabb<Space> box = bounding_box({});
    const Vector edges = box.upper - box.lower;
    require(all_finite(given.center) && box.contains(given.center), self, "center", given.center,
            "m must lie in the box around the parts");
    require(
        given.mass <= Scalar(1.001) * edges.prod(), self, "volume", given.mass,
        "m^D must be at most that of the box around the parts: give mass properties at density 1");
    const Scalar polar = given.inertia.trace() / Scalar(Space::dim - 1);
    require(std::isfinite(polar) && polar <= given.mass * edges.squaredNorm(), self, "inertia",
            polar, "m^(D+2) must be that of a body in the box around the parts, at density 1");
    if constexpr (Space::dim == 3) {
      using Inertia = typename Space::Inertia;
      const Scalar trace = given.inertia.trace(), rounding = Scalar(1e-5) * std::abs(trace);
      const Inertia second = trace / 2 * Inertia::Identity() - given.inertia;
      const bool is_symmetric =
          (given.inertia - given.inertia.transpose()).cwiseAbs().maxCoeff() <= rounding;
      require(
          all_finite(given.inertia) && is_symmetric &&
              Eigen::SelfAdjointEigenSolver<Inertia>(second, Eigen::EigenvaluesOnly)
                      .eigenvalues()[0] >= -rounding,
          self, "inertia", given.inertia,
          "m^(D+2) must be symmetric, with principal moments of which each is at most the sum of "
          "the others");
    }
  }
  /// Moves the origin to the centre of mass.
  void set_mass(const MassProperties<Space>& of_density_one) {
    require(all_finite(of_density_one.center), "Compound", "center", of_density_one.center,
            "must be finite");
    unit_ = of_density_one;
    unit_.center = Vector::Zero();
    centroid_of_input_ = of_density_one.center;
    require_mass("Compound");
    Scalar sum = 0;
    for (Part& part : parts_) {
      part.pose.position -= centroid_of_input_;
      sum += part.shape.mass_properties(Scalar(1)).mass;
      circumradius_ = std::max(circumradius_, reach(part));
    }
    volume_share_ = unit_.mass / sum;
    find_seams();
  }
  void require_mass(const char* function) const {
    require_positive(unit_.mass, function, "volume");
    bool regular = all_finite(unit_.inertia);
    for (int k = 0; k < Space::angular_dim; ++k) regular = regular && unit_.inertia(k, k) > 0;
    require(regular, function, "inertia", unit_.inertia, "m^(D+2) must be positive and finite");
  }
  /// Distance of the farthest point of a part from the origin of the grain [m], or an upper bound.
  static Scalar reach(const Part& part) {
    if constexpr (Polytope<ShapeT>) {
      Scalar farthest = 0;
      for (Eigen::Index i = 0; i < part.shape.vertices().rows(); ++i)
        farthest = std::max(farthest, part.pose(part.shape.vertices().row(i).transpose()).norm());
      return farthest;
    } else {
      return part.pose.position.norm() + moreau::circumradius(part.shape);
    }
  }

  std::vector<Part> parts_;
  MassProperties<Space> unit_;  // at density 1, about the origin
  Vector centroid_of_input_ = Vector::Zero();
  Scalar volume_share_ = 1, circumradius_ = 0;
  detail::Seams seams_;
};

}  // namespace moreau
