// SPDX-License-Identifier: MIT
// The shapes and bodies of a simulation, and which body is a grain or a wall.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <span>
#include <sstream>
#include <tuple>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/contact/relative_velocity.hpp"
#include "moreau/core/aabb.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/erase_at.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/periodic_cell.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/sort_items.hpp"
#include "moreau/mesh/mesh_wall.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/cylinder_wall.hpp"
#include "moreau/shape/half_space.hpp"
#include "moreau/shape/smallest_width.hpp"
#include "moreau/world/wall_bodies.hpp"

namespace moreau {

namespace detail {

/// Shapes and bodies of a Simulation, numbered in the order in which they are added; a new body takes
/// the lowest index that a removed grain has left. Its functions throw std::invalid_argument in the
/// name of the public function that calls them, which they are given.
template <GrainShape ShapeT>
class Assembly {
 public:
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;

  /// Adds a shape that grains can share.
  ShapeId add_shape(const ShapeT& shape) {
    shapes_.push_back(shape);
    return ShapeId(shapes_.size() - 1);
  }
  /// Adds a body at rest that no force moves. It is neither grain nor wall yet.
  /// @param materials number of materials
  /// @throws std::invalid_argument unless `material` is one of them
  BodyId add_body(const Pose<S>& pose, MaterialId material, std::size_t materials,
                  const char* function) {
    require(material.index() < materials, function, "material", material,
            "must be the id of a material");
    if (free_.empty()) {
      bodies_.push_back(pose, material);
      note_placed(bodies_.size() - 1);
      return bodies_.id.back();
    }
    const std::uint32_t index = free_.back();
    free_.pop_back();
    bodies_.reuse(index, pose, material);
    note_placed(index);
    return bodies_.id[index];
  }
  /// Makes a body a grain.
  void set_grain(BodyId body, ShapeId shape, const MassProperties<S>& mass) {
    bodies_.set_mass(body.index(), mass.mass, mass.inertia);
    const auto place = std::lower_bound(grain_ids_.begin(), grain_ids_.end(), body);
    grains_.insert(grains_.begin() + (place - grain_ids_.begin()), {body, shape});
    grain_ids_.insert(place, body);
  }
  /// Finds out whether grains can be removed; changes nothing that anyone but remove_grains() sees.
  /// @returns one entry per body: whether it is one of these grains
  /// @throws std::invalid_argument for a body that is not a grain, or one that is listed twice
  const List<unsigned char>& mark(std::span<const BodyId> grains, const char* function) {
    marked_.assign(bodies_.size(), 0);
    for (const BodyId grain : grains) {
      number_of_grain(grain, function);
      require(marked_[grain.index()] == 0, function, "grain", grain, "must be listed once");
      marked_[grain.index()] = 1;
    }
    return marked_;
  }
  /// Removes the grains that the last mark() was given. Their indices become free.
  void remove_marked() {
    set_changed();
    for (const BodyId grain : grain_ids_) {
      if (marked_[grain.index()] == 0) continue;
      bodies_.remove(grain.index());
      add_free(bodies_.id[grain.index()]);
    }
    sort_items(free_, std::greater<>());
    const auto is_gone = [&](std::size_t k) { return marked_[grains_[k].body.index()] != 0; };
    erase_at(grain_ids_, is_gone);
    erase_at(grains_, is_gone);
  }
  /// Makes a body a half-space with the normal UnitX(), where its pose is.
  void set_wall(BodyId body, const HalfSpace<S>&) { walls_.push_back(body); }
  /// Makes a body the inside of a cylinder.
  void set_wall(BodyId body, const CylinderWall<S>& shape) { cylinders_.push_back({body, shape}); }
  /// Makes a body a mesh wall.
  void set_wall(BodyId body, const MeshWall<S>& shape) { meshes_.push_back({body, shape}); }

  /// Mass [kg] and inertia [kg m^2] of an added shape, in its own frame.
  /// @throws std::invalid_argument for an unknown shape, a density that is not finite or not
  ///         positive, a mass or an inertia that the scalar cannot hold, a centre of mass farther
  ///         from the origin than 1e-3 of the grain size
  MassProperties<S> mass_of(ShapeId shape, Scalar density, Scalar grain_size,
                            const char* function) const {
    require_shape(shape, function);
    require_positive(density, function, "density");
    const MassProperties<S> mass = shapes_[shape.index()].mass_properties(density);
    // A number below the least normal one has lost digits.
    bool is_normal = std::isnormal(mass.mass) && mass.mass > 0;
    for (int k = 0; k < S::angular_dim; ++k)
      is_normal = is_normal && std::isnormal(mass.inertia(k, k));
    require(is_normal && all_finite(mass.inertia) && all_finite(inverse_root<S>(mass.inertia)),
            function, "mass", mass.mass, "must be finite and > 0, as must be the inertia");
    require(mass.center.norm() <= Scalar(1e-3) * grain_size, function, "center of mass",
            mass.center, "must be the origin of the shape's frame");
    return mass;
  }

  /// Notes whether the contact forces of a regularized law no longer belong to the bodies: a pose, what
  /// moves a body, or a law has changed.
  void set_changed(bool changed = true) { changed_ = changed; }
  bool has_changed() const { return changed_; }

  /// Notes that a body was placed since the last step: that step looks for deep overlaps of it.
  void note_placed(std::size_t body) {
    set_changed();
    placed_.resize(bodies_.size());
    placed_[body] = 1;
    any_placed_ = true;
  }
  /// The same for all bodies, where the cell has changed.
  void note_all_placed() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) note_placed(i);
  }
  bool any_placed() const { return any_placed_; }  ///< since the last step
  /// The bodies are those after a step.
  void forget_placed() {
    placed_.clear();
    any_placed_ = false;
  }
  void allow_overlaps(bool allow) { overlaps_allowed_ = allow; }
  /// Keeps the poses before a step moves bodies, if bodies were placed.
  /// @param step length of the step [s]
  void keep_poses(Scalar step) {
    step_ = step;
    if (any_placed_) kept_poses_ = bodies_.pose;
  }
  /// Checks the contacts of bodies that were placed since the last step.
  /// @param undo function: undoes what the step has changed so far but for the poses
  /// @throws std::invalid_argument for an overlap deeper than half of the smallest width of a grain
  ///         of the contact, unless overlaps are allowed; the poses are then those before the step
  void require_no_deep_overlap(const DetectedContacts<S>& contacts, const char* function,
                               const auto& undo) {
    if (!any_placed_) return;
    placed_.resize(bodies_.size());
    for (const Contact<S>& contact : contacts.points) {
      if (overlaps_allowed_ || !(contact.gap < 0)) continue;
      if (placed_[contact.a] == 0 && placed_[contact.b] == 0) continue;
      const Scalar most = std::min(width_of(contact.a), width_of(contact.b)) / 2;
      const Scalar speed =
          relative_velocity(contact, bodies_.velocity[contact.a], bodies_.velocity[contact.b])[0];
      // The prediction has moved the bodies by less than this.
      if (-contact.gap <= most + std::max(Scalar(0), -speed * step_)) continue;
      bodies_.pose = kept_poses_;
      undo();
      throw_deep_overlap(contact, most, function);
    }
    placed_.assign(bodies_.size(), 0);
    any_placed_ = false;
  }

  const ShapeT& shape(ShapeId id) const { return shapes_[id.index()]; }  ///< not checked
  Bodies<S>& bodies() { return bodies_; }
  const Bodies<S>& bodies() const { return bodies_; }
  std::span<const BodyId> walls() const { return walls_; }
  std::span<const BodyId> grains() const { return grain_ids_; }
  std::span<const CylinderBody<S>> cylinders() const { return cylinders_; }
  std::span<const MeshBody<S>> meshes() const { return meshes_; }
  std::size_t grain_count() const { return grains_.size(); }
  BodyId grain(std::size_t k) const { return grains_[k].body; }  ///< not checked
  /// Shape of the k-th grain; k is not checked.
  const ShapeT& shape_of_grain(std::size_t k) const { return shape(grains_[k].shape); }

  /// The number k of a grain, such that grain(k) == body.
  /// @throws std::invalid_argument for a body that is not a grain
  std::size_t number_of_grain(BodyId body, const char* function) const {
    const auto found = std::lower_bound(grain_ids_.begin(), grain_ids_.end(), body);
    require(found != grain_ids_.end() && *found == body, function, "grain", body,
            "must be the id of a grain");
    return static_cast<std::size_t>(found - grain_ids_.begin());
  }

  /// Shape of a grain; the body is not checked.
  const ShapeT& shape_of(BodyId grain) const {
    const auto found = std::lower_bound(grain_ids_.begin(), grain_ids_.end(), grain);
    return shape_of_grain(static_cast<std::size_t>(found - grain_ids_.begin()));
  }

  static void require_pose(const Pose<S>& pose, const char* function) {
    require(all_finite(pose.position), function, "pose.position", pose.position, "must be finite");
    require(pose.is_finite() && S::is_rotation(pose.rotation), function, "pose.rotation",
            pose.rotation, "must be finite and of unit length");
  }
  bool contains(BodyId body) const {
    return body.index() < bodies_.size() && bodies_.id[body.index()] == body &&
           bodies_.exists(body.index());
  }
  void require_shape(ShapeId shape, const char* function) const {
    require(shape.index() < shapes_.size(), function, "shape", shape, "must be the id of a shape");
  }
  void require_body(BodyId body, const char* function) const {
    require(body.index() < bodies_.size(), function, "body", body, "must be the id of a body");
    require(contains(body), function, "body", body, "must not be the id of a removed grain");
  }
  /// A body of which a vector is set: the id of a body and a finite vector.
  void require_body(BodyId body, const char* function, const char* argument,
                    const auto& vector) const {
    require_body(body, function);
    require(all_finite(vector), function, argument, vector, "must be finite");
  }
  void require_wall(BodyId body, const char* function) const {
    bool found = std::find(walls_.begin(), walls_.end(), body) != walls_.end();
    for (const MeshBody<S>& mesh : meshes_) found = found || mesh.body == body;
    require(found, function, "wall", body, "must be the id of a half-space or of a mesh wall");
  }
  /// Checks that a wall at a pose does not lie across a periodic axis. Any other body passes.
  void require_walls_fit(const PeriodicCell<S>& cell, BodyId body, const Pose<S>& pose,
                         const char* function) const {
    for_each_wall(*this, [&](BodyId wall, const auto& shape) {
      if (wall == body) require_fits(shape, pose, cell, function);
    });
  }
  /// Checks that a wall that keeps a spin does not turn across a periodic axis: a half-space and a cylinder may turn
  /// about the periodic axis if there is one only. If a half-space turned about its normal, the velocities of a point
  /// and of its image, which are the same place, would differ by spin x length of the cell. Any other body passes.
  void require_walls_stay(const PeriodicCell<S>& cell, BodyId body, const AngularArgument<S>& spin,
                          const char* function) const {
    if (cell.is_open()) return;
    bool is_wall = std::find(walls_.begin(), walls_.end(), body) != walls_.end();
    for (const CylinderBody<S>& cylinder : cylinders_) is_wall = is_wall || cylinder.body == body;
    if (!is_wall) return;
    const auto turns = [&](const typename S::Vector& axis) {
      return S::spin(spin, axis).norm() > Scalar(1e-5) * spin.norm();
    };
    for (int axis = 0; axis < S::dim; ++axis)
      require(!cell.is_periodic(axis) || !turns(S::Vector::Unit(axis)), function, "spin", spin,
              "must be about the only periodic axis, or zero");
  }
  void require_grain(std::size_t k, const char* function) const {
    require(k < grains_.size(), function, "k", k, "must be below the number of grains");
  }

  /// @throws std::runtime_error for a velocity or a pose that is not finite
  void require_finite(const char* function) const {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (!all_finite(bodies_.velocity[i]))
        throw_not_finite(function, "velocity of body", i, bodies_.velocity[i]);
      if (!bodies_.pose[i].is_finite())
        throw_not_finite(function, "position of body", i, bodies_.pose[i].position);
    }
  }

  /// Whether the lists of bodies, grains, shapes and walls agree with one another, after they were read from a file.
  bool is_valid(std::size_t materials) const {
    bool valid = bodies_.are_valid(materials) &&
                 std::adjacent_find(grain_ids_.begin(), grain_ids_.end(), std::greater_equal<>()) ==
                     grain_ids_.end();
    for (const Grain& grain : grains_)
      valid = valid && contains(grain.body) && grain.shape.index() < shapes_.size();
    for_each_wall(*this, [&](BodyId wall, const auto&) { valid = valid && contains(wall); });
    return valid;
  }
  /// Adds all grains and walls to a detector.
  template <class Detector>
  void add_to(Detector& detector) const {
    for (const Grain& grain : grains_) detector.add_grain(grain.body, shape(grain.shape));
    for_each_wall(*this, [&](BodyId wall, const auto& shape) { detector.add_wall(wall, shape); });
  }
  /// Calls visit(body, shape) for every wall: for half-spaces, then for cylinders, then for meshes, each in the order in
  /// which they were added.
  /// @param self an Assembly; if it is not constant, visit can change the body
  static void for_each_wall(auto& self, const auto& visit) {
    const HalfSpace<S> half_space(S::Vector::UnitX());
    for (auto& wall : self.walls_) visit(wall, half_space);
    for (auto& cylinder : self.cylinders_) visit(cylinder.body, cylinder.shape);
    for (auto& mesh : self.meshes_) visit(mesh.body, mesh.shape);
  }

 private:
  struct Grain {
    BodyId body;
    ShapeId shape;
  };

  friend struct moreau::SerializationAccess;
  friend struct StateAccess;
  auto serialized_members() {
    return std::tie(shapes_, grains_, walls_, cylinders_, meshes_, bodies_, changed_, placed_,
                    any_placed_, overlaps_allowed_);
  }
  void deserialized() {
    placed_.resize(bodies_.size());
    widths_.clear();
    grain_ids_.clear();
    for (const Grain& grain : grains_) grain_ids_.push_back(grain.body);
    free_.clear();
    for (std::size_t i = bodies_.id.size(); i-- > 0;)
      if (!bodies_.exists(i)) add_free(bodies_.id[i]);
  }
  static void require_fits(const HalfSpace<S>& shape, const Pose<S>& pose,
                           const PeriodicCell<S>& cell, const char* function) {
    cell.require_along(pose.rotation * shape.normal(), function);
  }
  static void require_fits(const CylinderWall<S>& shape, const Pose<S>& pose,
                           const PeriodicCell<S>& cell, const char* function) {
    cell.require_around(shape.axis_at(pose.rotation), function);
  }
  /// A cell with a mesh wall is open.
  static void require_fits(const MeshWall<S>&, const Pose<S>&, const PeriodicCell<S>&,
                           const char*) {}
  /// The smallest width of a grain (smallest_width.hpp) [m]; infinite for a wall. The width of a shape is computed once:
  /// that of a hull with 300 vertices takes 1.8e5 dot products.
  MOREAU_COLD Scalar width_of(std::uint32_t body) {
    constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
    if (!(bodies_.grain_mass[body] > 0)) return infinity;
    const ShapeId shape = grains_[number_of_grain(bodies_.id[body], "Simulation::step")].shape;
    widths_.resize(shapes_.size(), infinity);
    Scalar& width = widths_[shape.index()];
    if (width == infinity) width = smallest_width(shapes_[shape.index()]);
    return width;
  }
  [[noreturn]] void throw_deep_overlap(const Contact<S>& contact, Scalar most,
                                       const char* function) const {
    std::ostringstream which, limit;
    const auto kind = [&](std::uint32_t i) {
      return bodies_.grain_mass[i] > 0 ? "grain " : "wall ";
    };
    which << "overlap of " << kind(contact.a) << contact.a << " and " << kind(contact.b)
          << contact.b;
    limit << "m must be at most " << most << " m, half of the smallest width of the grain. "
          << "Place it elsewhere, or call allow_overlaps()";
    throw_invalid(function, which.str(), -contact.gap, limit.str());
  }
  /// Makes the index of a removed body free, unless its generations are used up.
  void add_free(BodyId removed) {
    if (removed.generation < std::numeric_limits<std::uint32_t>::max())
      free_.push_back(removed.value);
  }

  std::deque<ShapeT> shapes_;  // addresses stay valid as shapes are added
  List<Grain> grains_;         // ascending by body
  List<BodyId> grain_ids_;     // the body of each element of grains_
  List<std::uint32_t> free_;   // indices that removed grains have left, descending
  List<unsigned char> marked_;
  List<BodyId> walls_;
  std::vector<CylinderBody<S>> cylinders_;
  std::vector<MeshBody<S>> meshes_;
  Bodies<S> bodies_;
  bool changed_ = false, any_placed_ = false, overlaps_allowed_ = false;
  List<unsigned char> placed_;  // one per body: whether it was placed since the last step
  List<Scalar> widths_;  // one per shape, as far as known: its smallest width [m], or infinity
  List<Pose<S>> kept_poses_;
  Scalar step_ = 0;
};

}  // namespace detail

}  // namespace moreau
