// SPDX-License-Identifier: MIT
// Placed<Shape>: a shape at the pose that it has in this step. The narrow phase takes shapes in
// this form only.
//
// The centre is a position in world axes. Everything else is stored relative to the centre, in
// world axes. So the narrow phase computes with coordinates of the size of the shapes, however far
// the pair lies from the world's origin.
//
// detail::Placement holds the data stored for each kind of shape. Its functions are the functions
// of Placed.
#pragma once

#include <algorithm>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "moreau/core/list.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/half_space.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/rounded.hpp"
#include "moreau/shape/segment.hpp"
#include "moreau/simd/point_rows.hpp"
#include "moreau/simd/prefetch.hpp"

namespace moreau {

namespace detail {

/// The placed data of a convex shape of which only the support function is known.
template <class ShapeT>
class Placement {
 public:
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Places the shape at a pose, world axes [m]. The shape must outlive this object.
  void update(const ShapeT& shape, const Pose<S>& pose) {
    shape_ = &shape;
    pose_ = pose;
    box_ = shape.bounding_box(pose);
  }
  /// Moves the centre, world axes [m]. The orientation is unchanged.
  void move_to(const Vector& center) {
    pose_.position = center;
    box_ = shape_->bounding_box(pose_);
  }

  const ShapeT& shape() const { return *shape_; }          ///< the shape that was placed
  const Pose<S>& pose() const { return pose_; }            ///< of the shape, world axes [m]
  const Vector& center() const { return pose_.position; }  ///< the body's origin, world axes [m]
  /// Radius of a ball about the centre that contains the shape [m].
  Scalar radius() const requires HasCircumradius<ShapeT> { return shape_->circumradius(); }
  /// The point of the shape farthest in the direction, relative to the centre, world axes [m].
  /// @param direction  world axes, of any length but zero
  Vector support(const Vector& direction) const {
    return pose_.rotation * shape_->support(pose_.rotation.inverse() * direction);
  }
  /// The bounding box, world axes [m].
  const Aabb<S>& bounding_box() const { return box_; }

 private:
  const ShapeT* shape_ = nullptr;
  Pose<S> pose_;
  Aabb<S> box_;
};

/// The placed data of a polytope: vertices and face normals, rotated into world axes once per step.
template <class ShapeT>
requires Polytope<ShapeT>
class Placement<ShapeT> {
 public:
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Places the shape at a pose, world axes [m]. Allocates only if the shape has more vertices or
  /// faces than every shape placed before. The shape must outlive this object.
  void update(const ShapeT& shape, const Pose<S>& pose) {
    const typename S::Matrix rotation = pose.rotation.toRotationMatrix();
    shape_ = &shape;
    center_ = pose.position;
    vertices_.assign(shape.vertices(), rotation);
    normals_.assign(shape.face_normals(), rotation);
    const Eigen::Index count = shape.face_offsets().size();
    offsets_.resize(std::size_t(normals_.padded_size()));
    const Scalar* offsets = shape.face_offsets().data();
    std::fill(std::copy(offsets, offsets + count, offsets_.data()),
              offsets_.data() + offsets_.size(), offsets[0]);
  }

  /// Begins to load the object that holds the shape into the cache. The functions below read it.
  void prefetch_shape() const { detail::prefetch(shape_, sizeof(ShapeT)); }
  /// Begins to load what update() reads and writes for a shape.
  void prefetch_update(const ShapeT& shape) const {
    const auto load = [](const auto& rows) {
      detail::prefetch(rows.data(), std::size_t(rows.size()) * sizeof(Scalar));
    };
    load(shape.vertices());
    load(shape.face_normals());
    load(shape.face_offsets());
    prefetch_rows();
  }
  /// Prefetches what the narrow phase reads for most pairs. The offsets are left out: only a search reads more than two.
  void prefetch_contact() const {
    vertices_.prefetch();
    normals_.prefetch();
    if constexpr (requires { shape_->prefetch(); }) shape_->prefetch();
  }

  /// Moves the centre, world axes [m]. The orientation is unchanged. Unlike update(), this function
  /// does not rotate the vertices.
  void move_to(const Vector& center) { center_ = center; }

  const ShapeT& shape() const { return *shape_; }   ///< the shape that was placed
  const Vector& center() const { return center_; }  ///< the body's origin, world axes [m]
  /// The N vertices, relative to the centre, world axes [m].
  const PointRows<S>& vertices() const { return vertices_; }
  /// The F face normals, unit, outward, world axes.
  const PointRows<S>& normals() const { return normals_; }
  /// Signed distance of the plane of face f from the centre, along the face's normal [m].
  Scalar offset(std::size_t f) const { return offsets_[f]; }
  /// The offsets of all faces [m]. The array has normals().padded_size() elements.
  const Scalar* offsets() const { return offsets_.data(); }
  /// Radius of a ball about the centre that contains the shape [m].
  Scalar radius() const { return shape_->circumradius(); }
  /// The vertex farthest in the direction, relative to the centre, world axes [m].
  /// @param direction  world axes, of any length but zero
  Vector support(const Vector& direction) const {
    return vertices_[vertices_.farthest(direction).index];
  }
  /// The bounding box, world axes [m].
  Aabb<S> bounding_box() const {
    Aabb<S> box = vertices_.bounding_box();
    box.lower += center_;
    box.upper += center_;
    return box;
  }

 private:
  void prefetch_rows() const {
    vertices_.prefetch();
    normals_.prefetch();
    detail::prefetch(offsets_.data(), offsets_.size() * sizeof(Scalar));
  }

  const ShapeT* shape_ = nullptr;
  Vector center_ = Vector::Zero();
  PointRows<S> vertices_, normals_;
  List<Scalar, detail::cache_line> offsets_;
};

/// The placed data of a ball or disk.
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
  /// The point of the shape farthest in the direction, relative to the centre, world axes [m].
  /// @param direction  world axes, of any length but zero
  Vector support(const Vector& direction) const { return radius_ * direction.normalized(); }
  /// The bounding box, world axes [m].
  Aabb<S> bounding_box() const { return {center_.array() - radius_, center_.array() + radius_}; }

 private:
  Vector center_ = Vector::Zero();
  Scalar radius_ = 0;
};

/// The placed data of a half-space. The solid is { x : normal . (x - center) <= 0 }.
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
  const Vector& center() const { return center_; }  ///< a point of the plane, world axes [m]
  const Vector& normal() const { return normal_; }  ///< unit, pointing out of the solid, world axes
  Scalar offset() const { return normal_.dot(center_); }  ///< normal . x on the plane [m]
  /// Whether a box comes as near to the solid as the margin [m], world axes.
  bool reaches(const Aabb<S>& box, Scalar margin) const {
    const Vector center = (box.lower + box.upper) / 2 - center_;
    const Vector half = (box.upper - box.lower) / 2;
    return normal_.dot(center) - normal_.cwiseAbs().dot(half) <= margin;
  }

 private:
  Vector center_ = Vector::Zero();
  Vector normal_ = Vector::Zero();
};

/// The placed data of a segment, the core of a capsule.
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
  /// Radius of the ball about the centre that contains the segment: its half length [m].
  Scalar radius() const { return radius_; }
  const Vector& half() const { return half_; }  ///< from the centre to vertex 1, world axes [m]
  /// Vertex 0 or 1, relative to the centre, world axes [m].
  Vector vertex(std::size_t v) const { return v == 0 ? Vector(-half_) : half_; }
  /// The end of the segment farthest in the direction, relative to the centre, world axes [m].
  /// @param direction  world axes, of any length but zero
  Vector support(const Vector& direction) const { return vertex(direction.dot(half_) < 0 ? 0 : 1); }
  /// The bounding box, world axes [m].
  Aabb<S> bounding_box() const { return {center_ - half_.cwiseAbs(), center_ + half_.cwiseAbs()}; }

 private:
  Vector center_ = Vector::Zero(), half_ = Vector::Zero();
  Scalar radius_ = 0;
};

}  // namespace detail

/// A shape at a pose. Its functions are update(shape, pose), which places the shape again,
/// center(), support(direction), bounding_box() and the other functions of its detail::Placement.
/// It may refer to the shape, so the shape must not be a temporary object.
template <class ShapeT>
class Placed : public detail::Placement<ShapeT> {
 public:
  using Space = SpaceOf<ShapeT>;
  using Scalar = typename Space::Scalar;
  using Vector = typename Space::Vector;

  /// Places the shape at the world's origin, without rotation. The shape must outlive this object.
  explicit Placed(const ShapeT& shape) { this->update(shape, Pose<Space>{}); }
  /// Places the shape at a pose, world axes [m]. The shape must outlive this object.
  Placed(const ShapeT& shape, const Pose<Space>& pose) { this->update(shape, pose); }
  explicit Placed(const ShapeT&&) = delete;
  Placed(const ShapeT&&, const Pose<Space>&) = delete;
};

/// A rounded shape at a pose: its placed core and the rounding radius.
template <class Core>
class Placed<Rounded<Core>> {
 public:
  using Space = SpaceOf<Core>;
  using Scalar = typename Space::Scalar;
  using Vector = typename Space::Vector;

  /// Places the shape at a pose, world axes [m]. The shape must outlive this object.
  explicit Placed(const Rounded<Core>& shape, const Pose<Space>& pose = {})
      : core_(shape.core(), shape.core_pose(pose)),
        center_(pose.position),
        radius_(shape.radius()) {}
  explicit Placed(const Rounded<Core>&&, const Pose<Space>& = {}) = delete;

  /// Places the shape at a pose, world axes [m]. The shape must outlive this object.
  void update(const Rounded<Core>& shape, const Pose<Space>& pose) {
    core_.update(shape.core(), shape.core_pose(pose));
    center_ = pose.position;
    radius_ = shape.radius();
  }
  /// The core at its pose.
  const Placed<Core>& core() const { return core_; }
  const Vector& center() const { return center_; }    ///< the body's origin, world axes [m]
  Scalar rounding_radius() const { return radius_; }  ///< distance of the surface from the core [m]
  /// The point of the shape farthest in the direction, relative to the centre, world axes [m].
  /// @param direction  world axes, of any length but zero
  Vector support(const Vector& direction) const {
    return (core_.center() - center_) + core_.support(direction) + radius_ * direction.normalized();
  }
  /// The bounding box, world axes [m].
  Aabb<Space> bounding_box() const { return core_.bounding_box().inflated(radius_); }

 private:
  Placed<Core> core_;
  Vector center_;
  Scalar radius_;
};

/// A compound grain at a pose: its placed parts and their boxes.
template <CompoundShape ShapeT>
class Placed<ShapeT> {
 public:
  using Space = SpaceOf<ShapeT>;
  using Scalar = typename Space::Scalar;
  using Vector = typename Space::Vector;
  using Part = Placed<PartOf<ShapeT>>;

  /// Places the grain at a pose, world axes [m]. The shape must outlive this object.
  explicit Placed(const ShapeT& shape, const Pose<Space>& pose = {}) { update(shape, pose); }
  explicit Placed(const ShapeT&&, const Pose<Space>& = {}) = delete;

  /// Places the grain at a pose, world axes [m]. Keeps the memory of the parts. The shape must outlive
  /// this object.
  void update(const ShapeT& shape, const Pose<Space>& pose) {
    shape_ = &shape;
    center_ = pose.position;
    box_ = {};
    boxes_.clear();
    for (const auto& part : shape.parts()) {
      const std::size_t k = boxes_.size();
      if (k < parts_.size())
        parts_[k].update(part.shape, pose * part.pose);
      else
        parts_.emplace_back(part.shape, pose * part.pose);
      boxes_.push_back(parts_[k].bounding_box());
      box_.merge(boxes_[k].lower);
      box_.merge(boxes_[k].upper);
    }
  }

  const ShapeT& shape() const { return *shape_; }                    ///< the grain that was placed
  const Vector& center() const { return center_; }                   ///< world axes [m]
  std::size_t part_count() const { return boxes_.size(); }           ///< number of parts
  const Part& part(std::size_t k) const { return parts_[k]; }        ///< part k at its pose
  const Aabb<Space>& box(std::size_t k) const { return boxes_[k]; }  ///< of part k, world axes [m]
  /// The bounding box of all parts, world axes [m].
  const Aabb<Space>& bounding_box() const { return box_; }

 private:
  const ShapeT* shape_ = nullptr;
  Vector center_;
  std::vector<Part> parts_;  // more than part_count() if a grain placed before had more
  List<Aabb<Space>> boxes_;
  Aabb<Space> box_;
};

/// A OneOf shape at a pose: the placed shape that the OneOf holds.
template <class... Shapes>
class Placed<OneOf<Shapes...>> {
 public:
  using Space = SpaceOf<OneOf<Shapes...>>;
  using Scalar = typename Space::Scalar;
  using Vector = typename Space::Vector;

  /// Places the shape at a pose, world axes [m]. The shape must outlive this object.
  explicit Placed(const OneOf<Shapes...>& shape, const Pose<Space>& pose = {})
      : held_(shape.visit([&](const auto& kind) -> Held {
          return Placed<KindOf<decltype(kind)>>(kind, pose);
        })) {}
  explicit Placed(const OneOf<Shapes...>&&, const Pose<Space>& = {}) = delete;

  /// Places the shape at a pose, world axes [m]. Keeps its memory if the shape held is of the same
  /// type as the shape placed before. The shape must outlive this object.
  void update(const OneOf<Shapes...>& shape, const Pose<Space>& pose) {
    shape.visit([&](const auto& kind) {
      using Kind = Placed<KindOf<decltype(kind)>>;
      if (Kind* same = std::get_if<Kind>(&held_))
        same->update(kind, pose);
      else
        held_.template emplace<Kind>(kind, pose);
    });
  }
  /// Calls use(placed) with the Placed shape that is held.
  template <class Use>
  decltype(auto) visit(Use&& use) const {
    return std::visit(std::forward<Use>(use), held_);
  }
  /// The body's origin, world axes [m].
  Vector center() const {
    return visit([](const auto& kind) -> Vector { return kind.center(); });
  }
  /// The point of the shape farthest in the direction, relative to the centre, world axes [m].
  /// @param direction  world axes, of any length but zero
  Vector support(const Vector& direction) const {
    return visit([&](const auto& kind) -> Vector { return kind.support(direction); });
  }
  /// The bounding box, world axes [m].
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
