// SPDX-License-Identifier: MIT
// What a user may write with auto: results of functions, and what operators make of them, are plain
// values and not expressions that refer to a temporary or to the simulation.
#include <type_traits>

#include "moreau/measure/energy.hpp"
#include "moreau/measure/fabric.hpp"
#include "moreau/measure/stress.hpp"
#include "moreau/moreau.hpp"

namespace {

template <class X>
constexpr bool is_value = false;
template <class Matrix>
constexpr bool is_value<moreau::Value<Matrix>> = true;
template <int N, class T>
constexpr bool is_value<moreau::Components<N, T>> = true;

/// Whether a result, its multiples (also by numbers of the other precision), and its sums with itself and with Eigen's expressions are values.
template <class Result, class X = std::decay_t<Result>>
concept Plain = is_value<X> && requires(const X& x, typename X::Scalar t) {
  requires is_value<decltype(x / t)> && is_value<decltype(x * 2)> && is_value<decltype(t * x + x)>;
  requires is_value<decltype(x / 2.0f)> && is_value<decltype(2.0f * x)> &&
      is_value<decltype(x * 2.0)>;
  requires is_value<decltype(x - X::Zero())> && is_value<decltype(X::Zero() - x)>;
  requires is_value<decltype(-x)> && is_value<decltype(x.transpose() * x)>;
};
/// Whether a reference refers to the simulation, and not to a temporary, as its comment says.
template <class Result>
constexpr bool is_reference = std::is_lvalue_reference_v<Result>;

template <class ShapeT, class Scalar = typename moreau::SpaceOf<ShapeT>::Scalar>
consteval bool simulation_is_plain() {
  using Law = moreau::SignoriniCoulomb<Scalar>;
  using World = const moreau::Simulation<ShapeT, Law>;
  using S = moreau::SpaceOf<ShapeT>;
  using Pose = const moreau::Pose<S>;
#define RESULT(class, ...) decltype(std::declval<class&>().__VA_ARGS__)
  return Plain<RESULT(World, contact_impulse(std::declval<moreau::BodyId>()))> &&
         Plain<RESULT(World, velocity(std::declval<moreau::BodyId>()))> &&
         Plain<RESULT(World, spin(std::declval<moreau::BodyId>()))> &&
         Plain<RESULT(World, gravity())> &&
         Plain<RESULT(World, pose(std::declval<moreau::BodyId>()).position)> &&
         Plain<RESULT(World, pose(std::declval<moreau::BodyId>())(S::Vector::Zero()))> &&
         Plain<RESULT(World, pose(std::declval<moreau::BodyId>()).to_body(S::Vector::Zero()))> &&
         Plain<RESULT(World, cell().wrap(S::Vector::Zero()))> &&
         Plain<RESULT(World, cell().nearest(S::Vector::Zero(), S::Vector::Zero()))> &&
         Plain<RESULT(World, contacts().impulse_on(0))> && Plain<RESULT(World, bodies().axes(0))> &&
         Plain<RESULT(World, bodies().inertia(0, S::identity()))> &&
         Plain<RESULT(Pose, position)> &&
         Plain<decltype(moreau::contact_stress(std::declval<World&>(), Scalar(1),
                                               moreau::Aabb<S>()))> &&
         Plain<decltype(moreau::Fabric<S>().tensor)> &&
         Plain<decltype(moreau::Fabric<S>().anisotropy())> &&
         Plain<decltype(moreau::Momentum<S>().linear)> &&
         Plain<decltype(moreau::Momentum<S>().angular)> &&
         is_reference<RESULT(World, pose(std::declval<moreau::BodyId>()))> &&
         is_reference<RESULT(World, contacts())> && is_reference<RESULT(World, materials())> &&
         is_reference<RESULT(World, cell())> && is_reference<RESULT(World, bodies())> &&
         is_reference<RESULT(World, shape(std::declval<moreau::BodyId>()))>;
#undef RESULT
}
static_assert(simulation_is_plain<moreau::Ball<double>>());
static_assert(simulation_is_plain<moreau::Ball<float>>());
static_assert(simulation_is_plain<moreau::Disk<double>>());
static_assert(simulation_is_plain<moreau::Disk<float>>());
static_assert(simulation_is_plain<moreau::Polyhedron<double>>());
static_assert(simulation_is_plain<moreau::Polygon<float>>());

}  // namespace
