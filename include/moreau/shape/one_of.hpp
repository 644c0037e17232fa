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

namespace detail {

/// Types of shapes that one assembly can mix: all of the same space.
template <class... Shapes>
concept ShapesOfOneSpace =
    sizeof...(Shapes) > 0 &&
    (std::same_as<SpaceOf<Shapes>, SpaceOf<std::tuple_element_t<0, std::tuple<Shapes...>>>> && ...);

}  // namespace detail

/// A shape whose type is chosen at run time, for assemblies of several types of shapes. For each
/// pair, detection finds out the two types and calls the function for these types
/// (detect/collide.hpp).
/// @tparam Shapes  different types of shapes, all of the same space
template <Shape... Shapes>
requires detail::ShapesOfOneSpace<Shapes...>
class OneOf {
 public:
  using Space = SpaceOf<std::tuple_element_t<0, std::tuple<Shapes...>>>;
  using Scalar = typename Space::Scalar;
  using Vector = typename Space::Vector;

  /// Not explicit, so that a Ball<T> converts to OneOf<Ball<T>, Polyhedron<T>>.
  template <class ShapeT>
  requires(std::same_as<ShapeT, Shapes> || ...) OneOf(ShapeT shape) : held_(std::move(shape)) {}

  /// Index in Shapes of the type of the shape held.
  std::size_t index() const { return held_.index(); }
  /// Pointer to the shape held if it is of type ShapeT, otherwise null.
  template <class ShapeT>
  const ShapeT* get_if() const {
    return std::get_if<ShapeT>(&held_);
  }
  /// Calls use(shape) with the shape held, in its own type.
  template <class Use>
  decltype(auto) visit(Use&& use) const {
    return std::visit(std::forward<Use>(use), held_);
  }

  /// The volume [m^D]. Exists if all types have volume().
  Scalar volume() const requires(HasVolume<Shapes>&&...) {
    return visit([](const auto& shape) { return shape.volume(); });
  }
  /// Distance of the farthest point of the shape from the origin [m].
  Scalar circumradius() const requires(HasCircumradius<Shapes>&&...) {
    return visit([](const auto& shape) { return shape.circumradius(); });
  }
  /// Distance of the nearest point of the surface from the origin [m].
  Scalar inradius() const requires(HasInradius<Shapes>&&...) {
    return visit([](const auto& shape) { return shape.inradius(); });
  }
  /// The point of the shape farthest in the direction, body coordinates [m].
  /// @param direction  body coordinates, of any length but zero
  Vector support(const VectorArgument<Space>& direction) const requires(ConvexShape<Shapes>&&...) {
    return visit([&](const auto& shape) -> Vector { return shape.support(direction); });
  }
  /// Mass, centre of mass and inertia at a uniform density.
  /// @param density [kg/m^D], > 0
  /// @throws the exceptions of the shape held
  MassProperties<Space> mass_properties(Scalar density) const {
    return visit([&](const auto& shape) { return shape.mass_properties(density); });
  }
  /// A box around the shape at a pose, world axes [m].
  Aabb<Space> bounding_box(const Pose<Space>& pose) const {
    return visit([&](const auto& shape) { return shape.bounding_box(pose); });
  }
  /// The same shape with all lengths multiplied by `factor` [-], > 0.
  /// @throws the exceptions of the shape held
  [[nodiscard]] OneOf scaled(Scalar factor) const requires(Scalable<Shapes>&&...) {
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

/// Whether a shape is a OneOf.
template <class ShapeT>
inline constexpr bool is_one_of = false;
template <class... Shapes>
inline constexpr bool is_one_of<OneOf<Shapes...>> = true;

}  // namespace moreau
