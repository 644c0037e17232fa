// SPDX-License-Identifier: MIT
// Placed<Shape>: a shape at the pose that it has in this step. The narrow phase reads nothing else.
//
// All but the centre is kept relative to the centre, in world axes. A pair is then judged in
// coordinates of the size of the shapes, however far from the world's origin it lies.
//
// detail::Placement holds what is kept of each kind of shape; its functions are those of Placed.
#pragma once

#include <algorithm>
#include <type_traits>
#include <utility>
#include <variant>

#include "moreau/core/rows.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/half_space.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/rounded.hpp"
#include "moreau/shape/segment.hpp"

namespace moreau {

namespace detail {

/// What is kept of a convex shape of which only the support function is known.
template <class ShapeT>
class Placement {
 public:
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Places the shape at a pose, world axes [m]. The shape must outlive this object's use.
  void update(const ShapeT& shape, const Pose<S>& pose) {
    shape_ = &shape;
    pose_ = pose;
  }
  /// Moves the centre, world axes [m]; the orientation stays.
  void move_to(const Vector& center) { pose_.position = center; }

  const ShapeT& shape() const { return *shape_; }          ///< the shape that was placed
  const Vector& center() const { return pose_.position; }  ///< the body's origin, world axes [m]
  /// Radius of the ball about the centre that holds the shape [m].
  Scalar radius() const requires HasCircumradius<ShapeT> { return shape_->circumradius(); }
  /// The farthest point in the direction (any length but zero), relative to the centre, world
  /// axes [m].
  Vector support(const Vector& direction) const {
    return pose_.rotation * shape_->support(pose_.rotation.inverse() * direction);
  }
  /// World axes [m].
  Aabb<S> bounding_box() const { return shape_->bounding_box(pose_); }

 private:
  const ShapeT* shape_ = nullptr;
  Pose<S> pose_;
};

/// What is kept of a polytope: vertices and face normals, turned into world axes once per step.
template <class ShapeT>
requires Polytope<ShapeT>
class Placement<ShapeT> {
 public:
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Places the shape at a pose, world axes [m]. Allocates only if the shape has more vertices or
  /// faces than any before. The shape must outlive this object's use.
  void update(const ShapeT& shape, const Pose<S>& pose) {
    const typename S::Matrix rotation = pose.rotation.toRotationMatrix();
    shape_ = &shape;
    center_ = pose.position;
    vertices_.assign(shape.vertices(), rotation);
    normals_.assign(shape.face_normals(), rotation);
    const Eigen::Index count = shape.face_offsets().size();
    offsets_.resize(normals_.padded_size());
    const Scalar* offsets = shape.face_offsets().data();
    std::fill(std::copy(offsets, offsets + count, offsets_.data()),
              offsets_.data() + offsets_.size(), offsets[0]);
  }

  /// Moves the centre, world axes [m]; the orientation stays. Costs nothing, unlike update().
  void move_to(const Vector& center) { center_ = center; }

  const ShapeT& shape() const { return *shape_; }   ///< the shape that was placed
  const Vector& center() const { return center_; }  ///< the body's origin, world axes [m]
  /// The N vertices, relative to the centre, world axes [m].
  const Rows<S>& vertices() const { return vertices_; }
  /// The F face normals, unit, outward, world axes.
  const Rows<S>& normals() const { return normals_; }
  /// Distance of face f's plane from the centre [m].
  Scalar offset(std::size_t f) const { return offsets_[static_cast<Eigen::Index>(f)]; }
  /// The offsets of all faces [m], as many as normals().padded_size().
  const Scalar* offsets() const { return offsets_.data(); }
  /// Radius of the ball about the centre that holds the shape [m].
  Scalar radius() const { return shape_->circumradius(); }
  /// The farthest vertex in the direction (any length but zero), relative to the centre, world
  /// axes [m].
  Vector support(const Vector& direction) const {
    return vertices_[vertices_.farthest(direction).index];
  }
  /// World axes [m].
  Aabb<S> bounding_box() const {
    Aabb<S> box = vertices_.bounding_box();
    box.lower += center_;
    box.upper += center_;
    return box;
  }

 private:
  const ShapeT* shape_ = nullptr;
  Vector center_ = Vector::Zero();
  Rows<S> vertices_, normals_;
  Eigen::Array<Scalar, Eigen::Dynamic, 1> offsets_;
};

/// What is kept of a ball or disk.
template <class S>
class Placement<BallIn<S>> {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Places the shape at a pose, world axes [m].
  void update(const BallIn<S>& shape, const Pose<S>& pose) {
    center_ = pose.position;
    radius_ = shape.radius();
  }
  /// Moves the centre, world axes [m].
  void move_to(const Vector& center) { center_ = center; }
  const Vector& center() const { return center_; }  ///< the body's origin, world axes [m]
  Scalar radius() const { return radius_; }         ///< [m]
  /// The farthest point in the direction (any length but zero), relative to the centre, world
  /// axes [m].
  Vector support(const Vector& direction) const { return radius_ * direction.normalized(); }
  /// World axes [m].
  Aabb<S> bounding_box() const { return {center_.array() - radius_, center_.array() + radius_}; }

 private:
  Vector center_ = Vector::Zero();
  Scalar radius_ = 0;
};

/// What is kept of a half-space. The solid is { x : normal . (x - center) <= 0 }.
template <class S>
class Placement<HalfSpace<S>> {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Places the shape at a pose, world axes [m].
  void update(const HalfSpace<S>& shape, const Pose<S>& pose) {
    center_ = pose.position;
    normal_ = pose.rotation * shape.normal();
  }
  const Vector& center() const { return center_; }        ///< a point of the plane, world axes [m]
  const Vector& normal() const { return normal_; }        ///< unit, out of the solid, world axes
  Scalar offset() const { return normal_.dot(center_); }  ///< normal . x = offset on the plane [m]

 private:
  Vector center_ = Vector::Zero();
  Vector normal_ = Vector::Zero();
};

/// What is kept of a segment, the core of a capsule.
template <class S>
class Placement<Segment<S>> {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Places the shape at a pose, world axes [m].
  void update(const Segment<S>& shape, const Pose<S>& pose) {
    center_ = pose.position;
    radius_ = shape.half_length();
    half_ = pose.rotation * Vector(radius_ * Vector::UnitX());
  }
  const Vector& center() const { return center_; }  ///< the body's origin, world axes [m]
  Scalar radius() const { return radius_; }         ///< of the ball about the centre around it [m]
  const Vector& half() const { return half_; }      ///< from the centre to vertex 1, world axes [m]
  /// Vertex 0 or 1, relative to the centre, world axes [m].
  Vector vertex(std::size_t v) const { return v == 0 ? Vector(-half_) : half_; }
  /// The farthest end in the direction (any length but zero), relative to the centre, world
  /// axes [m].
  Vector support(const Vector& direction) const { return vertex(direction.dot(half_) < 0 ? 0 : 1); }
  /// World axes [m].
  Aabb<S> bounding_box() const { return {center_ - half_.cwiseAbs(), center_ + half_.cwiseAbs()}; }

 private:
  Vector center_ = Vector::Zero(), half_ = Vector::Zero();
  Scalar radius_ = 0;
};

}  // namespace detail

/// A shape at a pose. Its functions are update(shape, pose), which places it anew, center(),
/// support(direction), bounding_box() and those of its detail::Placement.
template <class ShapeT>
class Placed : public detail::Placement<ShapeT> {
 public:
  using Space = SpaceOf<ShapeT>;
  using Scalar = typename Space::Scalar;
  using Vector = typename Space::Vector;

  /// Places the shape at the origin, not turned. The shape must outlive this object's use.
  explicit Placed(const ShapeT& shape) { this->update(shape, Pose<Space>{}); }
  /// Places the shape at a pose, world axes [m]. The shape must outlive this object's use.
  Placed(const ShapeT& shape, const Pose<Space>& pose) { this->update(shape, pose); }
};

/// A rounded shape at a pose: its placed core, and the radius about it.
template <class Core>
class Placed<Rounded<Core>> {
 public:
  using Space = SpaceOf<Core>;
  using Scalar = typename Space::Scalar;
  using Vector = typename Space::Vector;

  /// Places the shape at a pose, world axes [m]. The shape must outlive this object's use.
  explicit Placed(const Rounded<Core>& shape, const Pose<Space>& pose = {})
      : core_(shape.core(), shape.core_pose(pose)),
        center_(pose.position),
        radius_(shape.radius()) {}

  /// Places the shape at a pose, world axes [m]. The shape must outlive this object's use.
  void update(const Rounded<Core>& shape, const Pose<Space>& pose) {
    core_.update(shape.core(), shape.core_pose(pose));
    center_ = pose.position;
    radius_ = shape.radius();
  }
  /// The core at its pose.
  const Placed<Core>& core() const { return core_; }
  const Vector& center() const { return center_; }    ///< the body's origin, world axes [m]
  Scalar rounding_radius() const { return radius_; }  ///< of the surface about the core [m]
  /// The farthest point in the direction (any length but zero), relative to the centre, world
  /// axes [m].
  Vector support(const Vector& direction) const {
    return (core_.center() - center_) + core_.support(direction) + radius_ * direction.normalized();
  }
  /// World axes [m].
  Aabb<Space> bounding_box() const { return core_.bounding_box().inflated(radius_); }

 private:
  Placed<Core> core_;
  Vector center_;
  Scalar radius_;
};

/// A OneOf shape at a pose: the shape that it holds.
template <class... Shapes>
class Placed<OneOf<Shapes...>> {
 public:
  using Space = SpaceOf<OneOf<Shapes...>>;
  using Scalar = typename Space::Scalar;
  using Vector = typename Space::Vector;

  /// Places the shape at a pose, world axes [m]. The shape must outlive this object's use.
  explicit Placed(const OneOf<Shapes...>& shape, const Pose<Space>& pose = {})
      : held_(shape.visit([&](const auto& kind) -> Held {
          return Placed<KindOf<decltype(kind)>>(kind, pose);
        })) {}

  /// Places the shape at a pose, world axes [m]. Keeps its memory while the shape is of the same
  /// kind as before. The shape must outlive this object's use.
  void update(const OneOf<Shapes...>& shape, const Pose<Space>& pose) {
    shape.visit([&](const auto& kind) {
      using Kind = Placed<KindOf<decltype(kind)>>;
      if (Kind* same = std::get_if<Kind>(&held_))
        same->update(kind, pose);
      else
        held_.template emplace<Kind>(kind, pose);
    });
  }
  /// Calls use with the Placed shape of the kind that is held.
  template <class Use>
  decltype(auto) visit(Use&& use) const {
    return std::visit(std::forward<Use>(use), held_);
  }
  /// The body's origin, world axes [m].
  Vector center() const {
    return visit([](const auto& kind) -> Vector { return kind.center(); });
  }
  /// The farthest point in the direction (any length but zero), relative to the centre, world
  /// axes [m].
  Vector support(const Vector& direction) const {
    return visit([&](const auto& kind) -> Vector { return kind.support(direction); });
  }
  /// World axes [m].
  Aabb<Space> bounding_box() const {
    return visit([](const auto& kind) -> Aabb<Space> { return kind.bounding_box(); });
  }

 private:
  template <class Reference>
  using KindOf = std::remove_cvref_t<Reference>;
  using Held = std::variant<Placed<Shapes>...>;
  Held held_;
};

}  // namespace moreau
