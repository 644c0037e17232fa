// SPDX-License-Identifier: MIT
// The shapes and bodies of a simulation, and which body is a grain, a wall or a cylinder.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <span>
#include <tuple>
#include <vector>

#include "moreau/body/bodies.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/cylinder_wall.hpp"
#include "moreau/shape/half_space.hpp"

namespace moreau {

/// A cylinder wall of a simulation: its body, and its shape in the frame of the body.
template <class S>
struct CylinderBody {
  BodyId body;  ///< its pose places the shape
  /// In the frame of the body.
  CylinderWall<S> shape = SerializationAccess::blank<CylinderWall<S>>();
};

namespace detail {

/// Shapes and bodies of a Simulation, numbered in the order in which they are added. Its functions
/// throw std::invalid_argument in the name of the public function that calls them, which they are
/// given.
template <ConvexShape ShapeT>
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
    bodies_.push_back(pose, material);
    return BodyId(bodies_.size() - 1);
  }
  /// Makes a body a grain.
  void set_grain(BodyId body, ShapeId shape, const MassProperties<S>& mass) {
    bodies_.set_mass(body.index(), mass.mass, mass.inertia);
    grains_.push_back({body, shape});
    grain_ids_.push_back(body);
  }
  /// Makes a body a half-space, where its pose is.
  void set_wall(BodyId body) { walls_.push_back(body); }
  /// Makes a body the inside of a cylinder.
  void set_cylinder(BodyId body, const CylinderWall<S>& shape) {
    cylinders_.push_back({body, shape});
  }

  /// Mass [kg] and inertia [kg m^2] of an added shape, in its own frame.
  /// @throws std::invalid_argument for an unknown shape, a density that is not finite or not
  ///         positive, a mass or an inertia that the scalar cannot hold, a centre of mass farther
  ///         from the origin than 1e-3 of the grain size
  MassProperties<S> mass_of(ShapeId shape, Scalar density, Scalar grain_size,
                            const char* function) const {
    require(shape.index() < shapes_.size(), function, "shape", shape, "must be the id of a shape");
    require(std::isfinite(density) && density > 0, function, "density", density,
            "must be finite and > 0");
    const MassProperties<S> mass = shapes_[shape.index()].mass_properties(density);
    require(std::isfinite(mass.mass) && mass.mass > 0 && all_finite(mass.inertia) &&
                all_finite(inverse_root<S>(mass.inertia)),
            function, "mass", mass.mass, "must be finite and > 0, as must be the inertia");
    require(mass.center.norm() <= Scalar(1e-3) * grain_size, function, "center of mass",
            mass.center, "must be the origin of the shape's frame");
    return mass;
  }

  const ShapeT& shape(ShapeId id) const { return shapes_[id.index()]; }  ///< not checked
  Bodies<S>& bodies() { return bodies_; }
  const Bodies<S>& bodies() const { return bodies_; }
  std::span<const BodyId> walls() const { return walls_; }
  std::span<const BodyId> grains() const { return grain_ids_; }
  std::span<const CylinderBody<S>> cylinders() const { return cylinders_; }
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

  static void require_pose(const Pose<S>& pose, const char* function) {
    require(all_finite(pose.position), function, "pose.position", pose.position, "must be finite");
    require(pose.is_finite() && S::is_rotation(pose.rotation), function, "pose.rotation",
            "(no rotation)", "must be finite and of unit length");
  }
  void require_body(BodyId body, const char* function) const {
    require(body.index() < bodies_.size(), function, "body", body, "must be the id of a body");
  }
  /// A body of which a vector is set: the id of a body and a finite vector.
  void require_body(BodyId body, const char* function, const char* argument,
                    const auto& vector) const {
    require_body(body, function);
    require(all_finite(vector), function, argument, vector, "must be finite");
  }
  void require_wall(BodyId body, const char* function) const {
    bool found = false;
    for (const BodyId wall : walls_) found = found || wall == body;
    require(found, function, "wall", body, "must be the id of a wall");
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

  /// Whether its members agree with one another, after they were read from a file.
  bool is_valid(std::size_t materials) const {
    const auto exists = [&](BodyId body) { return body.index() < bodies_.size(); };
    bool valid = bodies_.are_valid(materials);
    for (const Grain& grain : grains_)
      valid = valid && exists(grain.body) && grain.shape.index() < shapes_.size();
    for (const BodyId wall : walls_) valid = valid && exists(wall);
    for (const CylinderBody<S>& cylinder : cylinders_) valid = valid && exists(cylinder.body);
    return valid;
  }
  /// Adds all grains, walls and cylinders to a detector.
  template <class Detector>
  void add_to(Detector& detector) const {
    for (const Grain& grain : grains_) detector.add_grain(grain.body, shape(grain.shape));
    for (const BodyId wall : walls_) detector.add_wall(wall, HalfSpace<S>(S::Vector::UnitX()));
    for (const CylinderBody<S>& cylinder : cylinders_)
      detector.add_wall(cylinder.body, cylinder.shape);
  }

 private:
  struct Grain {
    BodyId body;
    ShapeId shape;
  };

  friend struct moreau::SerializationAccess;
  auto serialized_members() { return std::tie(shapes_, grains_, walls_, cylinders_, bodies_); }
  void deserialized() {
    grain_ids_.clear();
    for (const Grain& grain : grains_) grain_ids_.push_back(grain.body);
  }

  std::deque<ShapeT> shapes_;  // addresses stay valid as shapes are added
  std::vector<Grain> grains_;
  std::vector<BodyId> grain_ids_;  // the body of each element of grains_, ascending
  std::vector<BodyId> walls_;
  std::vector<CylinderBody<S>> cylinders_;
  Bodies<S> bodies_;
};

}  // namespace detail

}  // namespace moreau
