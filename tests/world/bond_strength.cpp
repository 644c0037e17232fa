// SPDX-License-Identifier: MIT
// Two bonded grains hold a load below their strength and break under one above it.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <type_traits>

#include "moreau/law/bonded.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

#include "types.hpp"

using namespace moreau;

namespace {

constexpr double radius = 0.01, tension = 20, shear = 12, bending = 8;

enum class Load { pull, slide, bend, twist };

template <class ShapeT, class Law>
struct Case {
  using Shape = ShapeT;
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using LawOf = Law;
  static Law law() {
    const Bonded<T> bonds({T(tension), T(shear), T(bending)}, T(0.4));
    if constexpr (CompliantLaw<Law, S>)
      return Law(bonds, T(1e6), T(5e5));
    else
      return bonds;
  }
};
using Rigid = Bonded<>;
using Soft = Compliant<Bonded<>>;

/// Whether the bond of two grains bears a load that rises towards a share of its strength.
template <class X>
bool holds(Load load, double share) {
  using S = typename X::S;
  using T = typename X::T;
  using Vector = typename S::Vector;
  using Angular = typename S::Angular;
  ColouredOptions options;
  options.tolerance = std::is_same_v<T, float> ? 1e-5 : 1e-11;
  Simulation<typename X::Shape, typename X::LawOf> world(
      T(2 * radius), Materials<typename X::LawOf>(1, X::law()), ColouredGaussSeidel(options));
  ShapeId shape;
  if constexpr (requires(const typename X::Shape& s) { s.vertices(); })
    shape = world.add_shape(cuboid<typename X::Shape>(Vector(Vector::Constant(T(radius)))));
  else
    shape = world.add_shape(typename X::Shape(T(radius)));
  const BodyId held = world.add_grain(shape, Pose<S>(), T(1000));
  const BodyId grain =
      world.add_grain(shape, Pose<S>(Vector(T(2 * radius) * Vector::UnitX())), T(1000));
  world.prescribe_motion(held);
  world.bond(held, grain);
  const auto& bond = world.bonds()[0];
  const double arm = 1 / (1 / double(bond.anchor_a.norm()) + 1 / double(bond.anchor_b.norm()));
  for (int k = 1; k <= 160 && world.breakages().empty(); ++k) {
    const double now = share * (1 - std::pow(0.8, k));  // springs follow without a swing
    Vector force = Vector::Zero();
    Angular torque = Angular::Zero();
    if (load == Load::pull) force[0] = T(now * tension);
    if (load == Load::slide) {
      force[1] = T(now * shear);
      torque[S::angular_dim - 1] = T(-now * shear * radius);  // takes its moment at the bond away
    }
    if (load == Load::bend) torque[S::angular_dim - 1] = T(now * bending * arm);
    if (load == Load::twist) torque[0] = T(now * bending * arm);
    world.set_force(grain, force);
    world.set_torque(grain, torque);
    world.step(CompliantLaw<typename X::LawOf, S> ? T(5e-3) : T(1e-4));
  }
  return world.breakages().empty();
}

}  // namespace

TEST_CASE_TEMPLATE("bond: it breaks at its strength to 3e-5, in double precision to 2e-8", X,
                   MOREAU_TYPES((Case<Disk<>, Rigid>, Case<Ball<>, Soft>),
                                (Case<Disk<>, Soft>, Case<Ball<>, Rigid>, Case<Polygon<>, Rigid>,
                                 Case<Polyhedron<>, Soft>, Case<Polyhedron<>, Rigid>,
                                 Case<Disk<float>, Bonded<float>>,
                                 Case<Ball<float>, Compliant<Bonded<float>>>))) {
  // The tolerance of the solver in single precision, detail::limit_rounding in double.
  const double share = std::is_same_v<typename X::T, float> ? 1e-5 : 1.5e-8;
  for (const Load load : {Load::pull, Load::slide, Load::bend, Load::twist}) {
    if (load == Load::twist && X::S::dim == 2) continue;
    CAPTURE(int(load));
    CHECK(holds<X>(load, 1 - 3 * share));
    CHECK(!holds<X>(load, 1 + 3 * share));
  }
}
