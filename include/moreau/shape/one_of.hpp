// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <tuple>
#include <utility>
#include <variant>

#include "moreau/core/serialize.hpp"
#include "moreau/shape/concepts.hpp"

namespace moreau {

/// A shape that is one of several kinds: the shape of a mixed assembly. Detection finds the kinds
/// of a pair by one visit and then runs as for a pair of these kinds (detect/collide.hpp).
/// @tparam Shapes  different types, all of the same space
template <Shape... Shapes>
requires(sizeof...(Shapes) > 0 &&
         (std::same_as<SpaceOf<Shapes>, SpaceOf<std::tuple_element_t<0, std::tuple<Shapes...>>>> &&
          ...)) class OneOf {
 public:
  using Space = SpaceOf<std::tuple_element_t<0, std::tuple<Shapes...>>>;
  using Scalar = typename Space::Scalar;
  using Vector = typename Space::Vector;

  /// Not explicit: a Ball converts to OneOf<Ball<T>, Polyhedron<T>>.
  template <class ShapeT>
  requires(std::same_as<ShapeT, Shapes> || ...) OneOf(ShapeT shape) : held_(std::move(shape)) {}

  /// Index of its kind in Shapes.
  std::size_t index() const { return held_.index(); }
  /// The shape if it is of this kind, else null.
  template <class ShapeT>
  const ShapeT* get_if() const {
    return std::get_if<ShapeT>(&held_);
  }
  /// Calls use(shape) with the shape of its own type.
  template <class Use>
  decltype(auto) visit(Use&& use) const {
    return std::visit(std::forward<Use>(use), held_);
  }

  /// [m^D], if all kinds have volume().
  Scalar volume() const requires(HasVolume<Shapes>&&...) {
    return visit([](const auto& shape) { return shape.volume(); });
  }
  /// Distance of the farthest point from the origin [m].
  Scalar circumradius() const requires(HasCircumradius<Shapes>&&...) {
    return visit([](const auto& shape) { return shape.circumradius(); });
  }
  /// Distance of the nearest point of the surface from the origin [m].
  Scalar inradius() const requires(HasInradius<Shapes>&&...) {
    return visit([](const auto& shape) { return shape.inradius(); });
  }
  /// The farthest point in the direction (any length but zero), body coordinates [m].
  Vector support(const VectorArgument<Space>& direction) const requires(ConvexShape<Shapes>&&...) {
    return visit([&](const auto& shape) -> Vector { return shape.support(direction); });
  }
  /// @param density [kg/m^D], > 0
  /// @throws what the shape throws
  MassProperties<Space> mass_properties(Scalar density) const {
    return visit([&](const auto& shape) { return shape.mass_properties(density); });
  }
  /// The box around it at the pose, world axes [m].
  Aabb<Space> bounding_box(const Pose<Space>& pose) const {
    return visit([&](const auto& shape) { return shape.bounding_box(pose); });
  }
  /// The same shape, all lengths times the factor [-], > 0.
  /// @throws what the shape throws
  OneOf scaled(Scalar factor) const requires(Scalable<Shapes>&&...) {
    return visit([&](const auto& shape) { return OneOf(shape.scaled(factor)); });
  }

 private:
  friend struct SerializationAccess;
  OneOf()
      : held_(std::in_place_index<0>,
              SerializationAccess::blank<std::tuple_element_t<0, std::tuple<Shapes...>>>()) {}
  auto serialized_members() { return std::tie(held_); }

  std::variant<Shapes...> held_;
};

}  // namespace moreau
