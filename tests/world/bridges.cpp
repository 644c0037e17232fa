// SPDX-License-Identifier: MIT
// Bridges between grains against closed forms: pull-off force, rupture distance, energy of a cycle.
#include "moreau/law/bridges.hpp"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>

#include "moreau/io/snapshot.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/frictionless.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/measure/check.hpp"
#include "moreau/measure/energy_balance.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

#include "types.hpp"

using namespace moreau;

namespace {

constexpr double radius = 1e-3, tension = 0.07, h = 1e-5;
/// Whether two numbers differ by less than a share of the second one.
bool agree(double found, double expected, double share = 1e-9) {
  return std::abs(found - expected) <= share * std::abs(expected);
}

/// The bridge of the tests: of liquid, whose reach is a tenth of the radius, or linear.
template <class Bridge>
Bridge bridge() {
  using T = typename Bridge::Scalar;
  if constexpr (requires(const Bridge& b) { b.volume(); })
    return Bridge(T(1e-3 * radius * radius * radius), T(tension), T(0.2));
  else
    return Bridge(T(4e-4), T(1e-4));
}

template <class ShapeT>
ShapeT grain() {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  if constexpr (requires(const ShapeT& s) { s.vertices(); })
    return cuboid<ShapeT>(typename S::Vector(S::Vector::Constant(T(radius))));
  else
    return ShapeT(T(radius));
}

/// A law of the tests with the bridge.
template <class Law>
struct Make;
template <class Bridge, class Law>
struct Make<Bridged<Bridge, Law>> {
  static auto law() { return Bridged<Bridge, Law>(bridge<Bridge>(), Law()); }
};
template <class Law>
struct Make<Compliant<Law>> {
  static auto law() { return Compliant<Law>(Make<Law>::law(), 1000); }
};

/// Two equal grains, the first one driven along the line of their centres, the second one heavy.
template <class ShapeT, class Law>
struct Two {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;

  Simulation<ShapeT, Law> world{T(2 * radius), Materials<Law>(1, Make<Law>::law())};
  BodyId driven, heavy;

  explicit Two(T gap) {
    const ShapeId shape = world.add_shape(grain<ShapeT>());
    driven = world.add_grain(shape, Pose<S>(Vector(Vector::Zero())), T(1000));
    heavy =
        world.add_grain(shape, Pose<S>(Vector((T(2 * radius) + gap) * Vector::UnitX())), T(1e9));
    world.prescribe_motion(driven);
  }
  StepReport move(T speed) {
    world.set_velocity(driven, Vector(speed * Vector::UnitX()));
    return world.step(T(h));
  }
  /// Distance of the surfaces [m].
  T distance() const {
    return world.pose(heavy).position[0] - world.pose(driven).position[0] - T(2 * radius);
  }
  /// Force on the heavy grain towards the driven one in the last step [N].
  T pull() const { return -world.contact_impulse(heavy)[0] / T(h); }
  /// The closed form at the detection of the last step.
  T expected() const {
    const auto& contacts = world.contacts();
    if (contacts.size() == 0) return 0;
    const auto& point = contacts.points[0];
    const T size = point.lever_a.norm() - point.gap / 2;
    return world.materials().laws()[0].bridge().force(point.gap, size);
  }
};

using Coulomb = SignoriniCoulomb<double>;
using Wet = Bridged<CapillaryBridge<double>, Coulomb>;

}  // namespace

TEST_CASE("bridge: closed forms of the force") {
  const CapillaryBridge<> bridge(1e-12, 0.07, 0.2);
  CHECK(agree(bridge.force(0, 1e-3), 2 * std::numbers::pi * 7e-5 * std::cos(0.2)));
  CHECK(bridge.force(-1e-5, 1e-3) == bridge.force(0, 1e-3));
  const double s = 5e-5 * std::sqrt(1e-3 / 1e-12);
  CHECK(agree(bridge.force(5e-5, 1e-3), bridge.force(0, 1e-3) / (1 + 1.05 * s + 2.5 * s * s)));
  CHECK(agree(bridge.rupture_distance(), 1.1e-4));
  const LinearCohesion<> linear(2e-3, 1e-4);
  CHECK(agree(linear.force(2.5e-5, 1), 1.5e-3));
  CHECK(linear.force(-1, 1) == 2e-3);
  CHECK(linear.force(2e-4, 1) == 0);
  using doctest::Contains;
  CHECK_THROWS_WITH(CapillaryBridge<>(0), Contains("CapillaryBridge: volume = 0 must be"));
  CHECK_THROWS_WITH(CapillaryBridge<>(1, -1), Contains("surface_tension = -1"));
  CHECK_THROWS_WITH(CapillaryBridge<>(1, 1, 2), Contains("contact_angle = 2"));
  CHECK_THROWS_WITH(LinearCohesion<>(-1, 1), Contains("LinearCohesion: adhesion = -1"));
  CHECK_THROWS_WITH(LinearCohesion<>(1, 0), Contains("range = 0"));
}

template <class ShapeT, class Law>
struct Case {
  using Shape = ShapeT;
  using LawOf = Law;
};
using Circle = BallIn<Space<2>>;
using Globe = BallIn<Space<3>>;
using FloatDisk = BallIn<Space<2, float>>;
using LinearWet = Bridged<LinearCohesion<double>, Frictionless<double>>;
using RollingWet = Bridged<CapillaryBridge<double>, RollingResistance<double>>;
using FloatWet = Bridged<CapillaryBridge<float>, SignoriniCoulomb<float>>;

TEST_CASE_TEMPLATE(
    "bridge: it forms at contact, has the force of its gap, and breaks at its rupture distance", X,
    MOREAU_TYPES((Case<Circle, Wet>, Case<Globe, Compliant<Wet>>),
                 (Case<Globe, Wet>, Case<Circle, Compliant<Wet>>, Case<FloatDisk, FloatWet>,
                  Case<Polygon<>, Wet>, Case<Polyhedron<>, Wet>, Case<Polyhedron<>, Compliant<Wet>>,
                  Case<Circle, LinearWet>, Case<Globe, RollingWet>))) {
  using Law = typename X::LawOf;
  using T = typename SpaceOf<typename X::Shape>::Scalar;
  const T reach = Make<Law>::law().reach(), far = T(0.6) * reach;
  const double rounding = std::is_same_v<T, float> ? 1e-3 : 1e-9;
  {  // no bridge before the first touch, and no contact above the margin
    Two<typename X::Shape, Law> two(far);
    two.move(0);
    CHECK(two.pull() == 0);
    CHECK(two.world.contacts().size() == 0);
    CHECK(two.move(0).points == 0);
  }
  Two<typename X::Shape, Law> two(T(-1e-5 * radius));  // touches
  two.move(0);
  EnergyBalance<typename Two<typename X::Shape, Law>::S> energy(two.world);
  double work = 0, error = 0, worst_gap = 0;
  const T speed = T(1e-2);
  for (int k = 0; k < 2000 && two.distance() < T(1.2) * reach; ++k) {
    const StepReport report = two.move(-speed);
    energy.add(two.world, report, T(h));
    const double pull = double(two.pull()), expected = double(two.expected());
    work += pull * double(speed) * h;
    if (pull > 0) {
      error = std::max(error, std::abs(pull - expected) / expected);
      worst_gap = double(two.distance());
    }
  }
  CHECK(error < 1e3 * rounding);
  // Detection is half a step before the end of the step.
  CHECK(std::abs(worst_gap - double(reach)) < 1.01 * double(speed) * h + rounding * radius);
  CHECK(two.world.contacts().size() == 0);
  // The work of the pull up to the rupture, by Simpson's rule.
  const auto law = Make<Law>::law();
  double integral = 0;
  const int parts = 1000;
  T size = T(radius);
  if constexpr (requires(const typename X::Shape& s) { s.vertices(); })
    size = T(radius * std::sqrt(double(SpaceOf<typename X::Shape>::dim)));
  for (int k = 0; k <= parts; ++k)
    integral += (k == 0 || k == parts ? 1
                 : k % 2              ? 4
                                      : 2) *
                double(law.bridge_force(reach * T(k) / T(parts), size)) * double(reach) /
                (3 * parts);
  CHECK(agree(work, integral, 0.01));
  CHECK(std::abs(energy.terms().drives - work) < 1e-4 * work);
  CHECK(std::abs(energy.imbalance()) < 1e-6 * std::max(work, rounding));
  // The other way round there is no bridge until they touch; then the cycle is closed.
  for (int k = 0; k < 2000 && two.distance() > T(2) * speed * T(h); ++k) {
    energy.add(two.world, two.move(speed), T(h));
    CHECK(two.pull() == 0);
  }
  for (int k = 0; k < 5; ++k) energy.add(two.world, two.move(speed), T(h));
  CHECK(two.pull() != 0);
  CHECK(std::abs(energy.imbalance()) < 1e-6 * std::max(work, rounding));
}

TEST_CASE_TEMPLATE("bridge: a grain hangs up to the pull-off force", X,
                   MOREAU_TYPES((Case<Circle, Wet>, Case<Globe, Compliant<Wet>>),
                                (Case<Globe, Wet>))) {
  using Shape = typename X::Shape;
  using Law = typename X::LawOf;
  using S = SpaceOf<Shape>;
  using Vector = typename S::Vector;
  const double limit = 4 * std::numbers::pi * radius * tension * std::cos(0.2);  // of a plane: 2 R
  for (const double share : {0.999, 1.001}) {
    Simulation<Shape, Law> world(2 * radius, Materials<Law>(1, Make<Law>::law()));
    world.add_wall(Vector(-Vector::Unit(S::dim - 1)), Vector(Vector::Zero()));
    const BodyId ball = world.add_grain(world.add_shape(Shape(radius)),
                                        Pose<S>(Vector(-radius * Vector::Unit(S::dim - 1))), 1000);
    // Slowly: a sudden load would stretch springs twice as far.
    const int ramp = 2000;
    for (int k = 0; k < 3 * ramp; ++k) {
      const double now = limit * share * std::min(1., double(k) / ramp);
      world.set_force(ball, Vector(-now * Vector::Unit(S::dim - 1)));
      world.step(h);
    }
    const double gap = -radius - world.pose(ball).position[S::dim - 1];
    CHECK((gap < 1e-6 * radius) == (share < 1));
  }
}

TEST_CASE("bridge: a snapshot continues it, and a removed grain takes its bridge along") {
  Two<Circle, Wet> two(-1e-5 * radius);
  two.move(0);
  for (int k = 0; k < 60; ++k) two.move(-1e-3);
  CHECK(two.pull() > 0);
  Two<Circle, Wet> copy(0);
  restore_snapshot(snapshot(two.world), copy.world);
  for (int k = 0; k < 100; ++k) two.move(-1e-3), copy.move(-1e-3);
  CHECK(snapshot(two.world) == snapshot(copy.world));
  Two<Circle, Wet> other(-1e-5 * radius);
  other.move(0);
  for (int k = 0; k < 60; ++k) other.move(-1e-3);
  const Pose<Space<2>> pose = other.world.pose(other.heavy);
  other.world.remove_grain(other.heavy);
  CHECK(other.world.contacts().size() == 0);
  other.heavy = other.world.add_grain(other.world.add_shape(Circle(radius)), pose, 1e9);
  other.move(0);
  CHECK(other.pull() == 0);
}

TEST_CASE("bridge: each pair of materials has its volume") {
  const double volume = 1e-3 * radius * radius * radius;
  const auto law = [&](double times) {
    return Wet(CapillaryBridge<>(times * volume, tension, 0.2), Coulomb());
  };
  Materials<Wet> materials(2, law(1));
  materials.set(MaterialId(0), MaterialId(1), law(8));
  double rupture[3];
  for (std::size_t pair = 0; pair < 3; ++pair) {  // of materials (0, 0), (0, 1), (1, 1)
    Simulation<Circle, Wet> world(2 * radius, materials);
    const ShapeId shape = world.add_shape(Circle(radius));
    const BodyId a = world.add_grain(shape, Pose<Space<2>>({0, 0}), 1e9, MaterialId(pair / 2)),
                 b = world.add_grain(shape, Pose<Space<2>>({2 * radius - 1e-8, 0}), 1e9,
                                     MaterialId((pair + 1) / 2));
    world.prescribe_motion(a);
    world.step(h);
    world.set_velocity(a, {-1e-2, 0});
    do world.step(h);
    while (world.contact_impulse(b)[0] < 0);
    rupture[pair] = world.pose(b).position[0] - world.pose(a).position[0] - 2 * radius;
  }
  const double once = law(1).reach(), twice = law(8).reach();
  CHECK(agree(twice, 2 * once));
  for (const auto& [found, expected] :
       {std::pair(rupture[0], once), {rupture[1], twice}, {rupture[2], once}})
    CHECK(std::abs(found - expected) < 2e-2 * h + 1e-8);
}

TEST_CASE("bridge: a periodic cell must have room for its reach") {
  const Wet wide(CapillaryBridge<>(1e-9), Coulomb());  // reach 1 mm
  Simulation<Circle, Wet> world(2 * radius, Materials<Wet>(1, wide));
  world.add_grain(world.add_shape(Circle(radius)), Pose<Space<2>>({0, 0}), 1000);
  CHECK_THROWS_WITH(world.set_periodic(0, 0, 5.5e-3), doctest::Contains("length of the cell"));
  world.set_materials(Materials<Wet>(1, Make<Wet>::law()));
  world.set_periodic(0, 0, 5.5e-3);
  CHECK_THROWS_WITH(world.set_materials(Materials<Wet>(1, wide)),
                    doctest::Contains("Simulation::set_materials: length of the cell"));
  CHECK(world.materials().laws()[0].reach() < 2e-4);
}

TEST_CASE_TEMPLATE("Cohesive: bodies attract each other up to the range, also beyond the margin", X,
                   Disk<double>, Ball<float>, Ball<double>) {
  using S = SpaceOf<X>;
  using T = typename S::Scalar;
  using Law = Cohesive<SignoriniCoulomb<T>>;
  using Vector = typename S::Vector;
  constexpr double step = 1e-6, apart = 0.5, margin = 0.02 * 2 * radius, density = 1000;
  constexpr int count = 2000;
  const double mass = density * std::numbers::pi * radius * radius *
                      (S::dim == 3 ? 4 * radius / 3 : 1) / 2;  // reduced
  const double adhesion = 0.2 * mass * apart * apart / 2 / (10 * margin);
  for (const double share : {0.1, 1.0, 10.0}) {  // of the margin, 0.02 of the grain size
    const double range = share * margin;
    Simulation<X, Law> world{T(2 * radius),
                             Law(SignoriniCoulomb<T>(T(0.5)), T(adhesion), T(range))};
    const ShapeId shape = world.add_shape(X(T(radius)));
    const auto add = [&](double side) {
      const Vector aside = T(side * radius) * Vector::UnitX();
      const BodyId grain = world.add_grain(shape, {aside, S::identity()}, T(density));
      world.set_velocity(grain, Vector(T(side * apart / 2) * Vector::UnitX()));
      return grain;
    };
    const BodyId left = add(-1), right = add(1);
    for (int k = 0; k < count; ++k) world.step(T(step));
    const double speed = double(world.velocity(right)[0] - world.velocity(left)[0]);
    const double work = adhesion * range;
    CAPTURE(share);
    // The attraction acts for whole steps: the work is that of a range which is off by the way of a step at most.
    const double off = adhesion * apart * step / (mass * speed);
    CHECK(std::abs(speed - std::sqrt(apart * apart - 2 * work / mass)) <=
          off + count * double(std::numeric_limits<T>::epsilon()) * apart);
  }
}

TEST_CASE_TEMPLATE(
    "bridge: bodies that are placed in touch have one, whatever the rounding of the gap", X,
    Ball<double>, Ball<float>, Disk<float>) {
  using S = SpaceOf<X>;
  using T = typename S::Scalar;
  using Law = Bridged<CapillaryBridge<T>, SignoriniCoulomb<T>>;
  using Vector = typename S::Vector;
  int apart = 0;
  for (int k = 0; k < 40; ++k) {
    Simulation<X, Law> world{T(2 * radius),
                             Law(bridge<CapillaryBridge<T>>(), SignoriniCoulomb<T>(T(0.5)))};
    const ShapeId shape = world.add_shape(X(T(radius)));
    Vector x = T(0.0037 * k - 0.05) * Vector::UnitX();
    world.add_grain(shape, {x, S::identity()}, T(1000));
    x += T(2 * radius) * Vector::UnitX();
    world.add_grain(shape, {x, S::identity()}, T(1000));
    world.step(T(h));
    apart += world.contacts().size() != 1 || !Law::is_bridged(world.contacts().variants[0]);
  }
  CHECK(apart == 0);
}

TEST_CASE("bridge: points beyond its rupture distance take no share of the force") {
  using S = Space<2>;
  using Law = Bridged<LinearCohesion<double>, SignoriniCoulomb<double>>;
  const double force = 1e-3;
  // A house upside down: its point touches the ceiling, the eaves are 0.05 mm below, within the margin of 0.2 mm.
  const Polygon<double> house(
      {{-4e-3, -8e-3}, {4e-3, -8e-3}, {4e-3, -5e-5}, {0, 0}, {-4e-3, -5e-5}});
  for (const double share : {0.8, 1.2}) {
    Simulation<Polygon<double>, Law> world(
        0.01, Law(LinearCohesion<double>(force, 1e-5), SignoriniCoulomb<double>(0.3)));
    world.add_wall({0, -1}, {0, 0});
    const BodyId grain =
        world.add_grain(world.add_shape(house), {house.centroid_of_input(), S::identity()}, 1000);
    const double top = world.pose(grain).position[1];
    const int ramp = 1000;
    for (int k = 0; k < 2 * ramp; ++k) {
      world.set_force(grain, {0, -force * share * std::min(1., double(k) / ramp)});
      world.step(1e-5);
    }
    CAPTURE(share);
    CHECK((top - world.pose(grain).position[1] < 1e-7) == (share < 1));
  }
}

TEST_CASE_TEMPLATE(
    "Cohesive: without a range it ends at the margin, however far another pair attracts", X,
    Disk<double>, Ball<double>) {
  using S = SpaceOf<X>;
  using Law = Cohesive<SignoriniCoulomb<double>>;
  using Vector = typename S::Vector;
  const SignoriniCoulomb<double> rigid(0.5);
  Materials<Law> materials(2, Law(rigid, 1e-6));
  materials.set(MaterialId(1), MaterialId(1), Law(rigid, 1e-7, radius));
  Simulation<X, Law> world(2 * radius, materials);
  const ShapeId shape = world.add_shape(X(radius));
  const auto pair = [&](double y, MaterialId material, double gap) {
    const BodyId first =
        world.add_grain(shape, {Vector(y * Vector::UnitY()), S::identity()}, 1000, material);
    world.add_grain(
        shape, {Vector((2 * radius + gap) * Vector::UnitX() + y * Vector::UnitY()), S::identity()},
        1000, material);
    return first;
  };
  const double margin = 0.02 * 2 * radius;
  const BodyId far = pair(0, MaterialId(0), 3 * margin),
               near = pair(10 * radius, MaterialId(0), 0.5 * margin),
               other = pair(20 * radius, MaterialId(1), 3 * margin);
  world.step(1e-6);
  CHECK(world.velocity(far).isZero(0));
  CHECK(world.velocity(near)[0] > 0);
  CHECK(world.velocity(other)[0] > 0);
}

TEST_CASE("bridge: check() names a volume that is no m^3") {
  using Law = Bridged<CapillaryBridge<>, SignoriniCoulomb<>>;
  for (const double volume : {1e-12, 1e-8, 1.0}) {
    const Law law(CapillaryBridge<>(volume), SignoriniCoulomb<>(0.4));
    Simulation<Ball<>, Law> world(2 * radius, Materials<Law>(1, law));
    world.add_grain(world.add_shape(Ball<>(radius)), Pose<Space<3>>(), 1000);
    const auto sentences = check(world, world.step(h));
    const bool says = std::any_of(sentences.begin(), sentences.end(), [](const std::string& one) {
      return one.find("bridges reach") != std::string::npos;
    });
    CHECK(says == (volume > 1e-11));
  }
}
