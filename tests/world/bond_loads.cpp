// SPDX-License-Identifier: MIT
// Bonds against closed forms: strength in tension, shear, bending and twisting, fracture energy, the deflection of a chain.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <functional>
#include <string>
#include <type_traits>

#include "moreau/measure/check.hpp"
#include "moreau/measure/energy_balance.hpp"

#include "world/bonded_rows.hpp"

using namespace moreau;
using namespace bonded;

namespace {

/// Share of a load at which the bond breaks if the load grows by `increment` per step.
template <class X>
double breaks_at(double increment, const auto& apply) {
  Row<typename X::Shape, typename X::LawOf> row(2);
  using T = typename decltype(row)::T;
  const T h = row.is_compliant ? T(5e-3) : T(1e-4);
  for (double share = increment; share < 1.5; share += increment) {
    apply(row, share);
    const StepReport report = row.world.step(h);
    if (report.broken_bonds > 0) {
      CHECK(report.bonds == 0);
      CHECK(row.world.bonds().empty());
      CHECK(row.world.breakages().size() == 1);
      CHECK(row.world.breakages()[0].time == row.world.time());
      CHECK(row.world.breakages()[0].a == row.grains[0]);
      return share;
    }
    CHECK(report.bonds == 1);
  }
  return 0;
}

}  // namespace

TEST_CASE_TEMPLATE("bond: two grains break at the strength in tension, shear, bending and twisting",
                   X, BOND_TYPES) {
  const double step = 2e-3;
  const auto check = [&](double share) {
    CHECK(share >= 1 - 1e-5);
    CHECK(share <= 1 + 1.5 * step);
  };
  check(breaks_at<X>(step, [](auto& row, double s) { row.load(s * tension, 0, 0); }));
  // The torque takes the moment of the force at the bond away.
  check(
      breaks_at<X>(step, [](auto& row, double s) { row.load(0, s * shear, -s * shear * radius); }));
  check(breaks_at<X>(step, [](auto& row, double s) {
    const auto& bond = row.world.bonds()[0];
    const double arm = 1 / (1 / double(bond.anchor_a.norm()) + 1 / double(bond.anchor_b.norm()));
    row.load(0, 0, s * bending * arm);
  }));
  if constexpr (SpaceOf<typename X::Shape>::dim == 3)
    check(breaks_at<X>(step, [](auto& row, double s) {
      using S = SpaceOf<typename X::Shape>;
      row.world.set_torque(row.last(),
                           typename S::Angular(s * bending * radius / 2 * S::Angular::UnitX()));
    }));
  // Compression makes the bond stronger, and does not break it.
  CHECK(breaks_at<X>(step, [](auto& row, double s) { row.load(-s * 100, 0, 0); }) == 0);
  check(breaks_at<X>(step, [](auto& row, double s) {
    const double limit = s * shear * 2;
    row.load(-tension, limit, -limit * radius);
  }));
}

/// The work until a bond breaks whose bodies move against each other at a constant rate.
template <class X>
struct Fracture {
  using World = Row<typename X::Shape, typename X::LawOf>;
  using S = typename World::S;
  using T = typename World::T;
  enum Mode { opening, sliding, bending_about_z, twisting };

  double fracture = 0, drives = 0, imbalance = 0, friction = 0, bond = 0, largest = 0, work = 0,
         worst = 0;
  int steps = 0;

  /// @param count  steps in which the bond would lose its strength without springs
  /// @param course function: number of the step -> its share of the rate
  Fracture(
      Mode mode, double energy, double count,
      const std::function<double(int)>& course = [](int) { return 1.0; }) {
    // Some 3e5 kg: so heavy that the bond hardly moves it, so light that the solver, whose tolerance is relative to
    // the speed, resolves the velocity that the bond gives it.
    // In bending, the body that is moved turns about the bond, and its velocity turns from step to step. A step takes
    // it for constant up to the next detection, so that the points of a rigid bond seem to open by h/2 w^2 R per second:
    // the bond bears half of the centrifugal force of the free body in the first step, and loses h w T / B of its
    // strength more per step. So the free body is lighter, and turns slowly and by less.
    const bool turns = mode == bending_about_z && !World::is_compliant;
    World row(2, energy, (S::dim == 2 ? 1e9 : 1e11) * (turns ? 0.01 : 1));
    const double strength = mode == opening ? tension : mode == sliding ? shear : bending;
    const double full = turns ? 1e-4 : 0.02, h = 2 * energy / (strength * full * count);
    const auto drive = [&] {
      const double speed = full * course(steps), spin = speed / row.effective;
      typename S::Vector velocity = S::Vector::Zero();
      if (mode == opening) velocity[0] = T(-speed);
      if (mode == sliding) {
        velocity[1] = T(-speed);
        // Takes the moment of the bond about the centre of the free body away.
        row.load(0, 0, -strength * std::max(0., 1 - (steps + 0.5) / count) * radius);
      }
      if (turns)  // takes the couple of the bond away
        row.load(0, 0,
                 -strength * row.effective *
                     std::max(0., row.world.bonds()[0].strength_left - 0.5 / count));
      if (mode == bending_about_z) {  // about the bond, where it is in the middle of the step
        row.world.set_spin(row.grains[0], World::about_z(spin));
        const typename S::Matrix axes = row.world.bodies().axes(row.grains[0].index());
        const typename S::Vector lever =
            S::exp(World::about_z(spin * h / 2)) * (axes * row.world.bonds()[0].anchor_a);
        velocity[0] = T(spin) * lever[1];
        velocity[1] = T(-spin) * lever[0];
      }
      if (mode == twisting) {
        typename S::Angular about = S::Angular::Zero();
        about[0] = T(spin);
        row.world.set_spin(row.grains[0], about);
      }
      row.world.set_velocity(row.grains[0], velocity);
    };
    drive();
    EnergyBalance<S> balance(row.world);  // it moves already
    const double speed = full;
    for (; steps < 20 * count && row.world.breakages().empty(); ++steps) {
      drive();
      balance.add(row.world, row.world.step(T(h)), T(h));
      largest = std::max(largest, (balance.terms().drives - drives) / (speed * h * strength));
      work += std::abs(balance.terms().drives - drives);
      drives = balance.terms().drives;
      worst = std::max(worst, std::abs(balance.imbalance()));
    }
    fracture = balance.terms().fracture, imbalance = balance.imbalance();
    friction = balance.terms().friction + balance.terms().rolling;
    if (row.world.breakages().size() == 1) bond = row.world.breakages()[0].energy;
  }
};

TEST_CASE_TEMPLATE("bond: the fracture energy is the work up to the end, whatever the step", X,
                   BOND_TYPES) {
  using F = Fracture<X>;
  constexpr bool is_float = std::is_same_v<typename F::T, float>,
                 springs = CompliantLaw<typename X::LawOf, typename F::S>;
  // Implicit Euler dissipates energy of springs in each step of the load.
  const double count = springs ? 1000.4 : 25.4;
  for (int mode = F::opening; mode <= (F::S::dim == 3 ? F::twisting : F::bending_about_z); ++mode) {
    CAPTURE(mode);
    // Sliding turns the free body by its moment about the centre: 1 % of the normal force that the bond then bears.
    if (is_float && mode == F::bending_about_z) continue;  // the circle, as above
    const bool turns = mode == F::bending_about_z;
    const double energy = turns && !springs ? 1e-4 : 1e-3,
                 rounding = (is_float ? 1e-2 : 1e-6) * energy;
    const double share = springs ? 5e-3 : is_float ? 1e-2 : turns ? 2e-3 : 1e-4;
    const F found(typename F::Mode(mode), energy, count);
    CAPTURE(found.largest);
    CAPTURE(found.fracture);
    CAPTURE(found.drives);
    CHECK(std::abs(found.steps - count) < (springs ? 5 : is_float ? 2 : 1));
    CHECK(agree(found.largest, 1 - 0.5 / count, share));  // the mean over the first step
    CHECK(agree(found.fracture, energy, share));
    CHECK(agree(found.drives, energy, share));
    CHECK(agree(found.bond, energy, share));
    CHECK(std::abs(found.imbalance) < rounding);
    CHECK(std::abs(found.friction) < rounding);
  }
}

TEST_CASE_TEMPLATE(
    "bond: energy is balanced over cycles of load, softening, unloading and fracture", X,
    BOND_TYPES) {
  using F = Fracture<X>;
  constexpr bool is_float = std::is_same_v<typename F::T, float>,
                 springs = CompliantLaw<typename X::LawOf, typename F::S>;
  const double count = springs ? 1000.4 : 40.4;
  for (int mode = F::opening; mode <= (F::S::dim == 3 ? F::twisting : F::bending_about_z); ++mode) {
    CAPTURE(mode);
    if (is_float && mode == F::bending_about_z) continue;
    const double energy = mode == F::bending_about_z && !springs ? 1e-4 : 1e-3;
    // Half of the strength is lost; then springs are unloaded by a part of their stretch, a rigid bond stands still.
    const int half = int(count / 2), back = half + int(count / 20), again = back + int(count / 20);
    const F found(typename F::Mode(mode), energy, count, [&](int k) {
      return k < half || k >= again ? 1.0 : !springs ? 0.0 : k < back ? -1.0 : 1.0;
    });
    CAPTURE(found.fracture);
    CAPTURE(found.work);
    CHECK(found.steps > again);
    CHECK(agree(found.fracture, energy, springs ? 2e-2 : is_float ? 2e-2 : 1e-2));
    CHECK(found.worst < (is_float ? 1e-2 : 1e-6) * found.work);
    CHECK(std::abs(found.friction) < (is_float ? 1e-2 : 1e-6) * found.work);
  }
  if constexpr (
      springs) {  // pushed and pulled below the strength: the bond holds, its energy comes back
    using World = typename F::World;
    using S = typename F::S;
    World row(2, 0, 1e12);
    row.world.set_velocity(row.grains[0], typename S::Vector(-2e-3 * S::Vector::UnitX()));
    EnergyBalance<S> balance(row.world);
    double work = 0, drives = 0, worst = 0, stored = 0;
    for (int k = 0; k < 2000; ++k) {  // a quarter of a cycle has 500 steps, 1e-5 m
      const double side = k < 500 || k >= 1500 ? -1 : 1;
      row.world.set_velocity(row.grains[0], typename S::Vector(side * 2e-3 * S::Vector::UnitX()));
      balance.add(row.world, row.world.step(1e-5), 1e-5);
      work += std::abs(balance.terms().drives - drives);
      drives = balance.terms().drives;
      worst = std::max(worst, std::abs(balance.imbalance()));
      stored = std::max(stored, balance.terms().elastic);
    }
    CHECK(agree(stored, stiffness * 1e-10 / 2, 0.01));
    CHECK(worst < 1e-6 * work);
    CHECK(std::abs(balance.terms().elastic) < 1e-4 * stored);
    CHECK(balance.terms().fracture >= 0);
    CHECK(balance.terms().fracture < 0.01 * work);  // of implicit Euler
    CHECK(row.world.bonds().size() == 1);
  }
}

// The extension of a bond on springs, F / k + opening, grows with the opening as 1 - T^2 / (2 G k). Let r = T^2 / (2 G k), the
// energy of the springs at the strength over G. If r > 1, no equilibrium follows under a prescribed extension (snap-back), and
// the work is T^2 / (2 k). Otherwise it is G. In a step the strength is the mean over the opening of the step: for 1 < r < 2 a
// bond then opens from step to step by r / (2 - r) times as much, and in the logarithm of the number of steps does at most the
// work T dx in each.
TEST_CASE_TEMPLATE("bond: springs that hold more energy than the fracture takes break it at once",
                   X, MOREAU_TYPES((Case<Globe, Soft>), (Case<Circle, Soft>))) {
  using F = Fracture<X>;
  for (const auto mode : {F::opening, F::sliding}) {
    CAPTURE(mode);
    const double strength = mode == F::opening ? tension : shear,
                 stored = strength * strength / (2 * (mode == F::opening ? stiffness : tangential));
    for (const double ratio : {0.5, 1.15, 2.0, 10.0}) {
      CAPTURE(ratio);
      const double energy = stored / ratio, count = ratio > 2 ? 100 : 1000;
      const F found(mode, energy, count);
      CAPTURE(found.fracture / energy);
      const double more = ratio > 1 && ratio < 2 ? std::log(count) / std::log(ratio / (2 - ratio)) *
                                                       2 / (ratio * count)
                                                 : 0;
      const double expected = std::max(1.0, ratio) * energy * (1 + more / 2);
      CHECK(found.bond > 0);
      CHECK(agree(found.drives, expected, 0.01 + more / 2));
      CHECK(agree(found.fracture, expected, 0.01 + more / 2));
      CHECK(std::abs(found.imbalance) < 1e-6 * stored);
    }
  }
}

TEST_CASE_TEMPLATE("bond: a brittle bond with springs releases their energy", X,
                   MOREAU_TYPES((Case<Globe, Soft>), (Case<Circle, Soft>))) {
  using S = SpaceOf<typename X::Shape>;
  Row<typename X::Shape, Soft> row(2, 0, 1e12);
  row.world.set_velocity(row.grains[0], typename S::Vector(-2e-3 * S::Vector::UnitX()));
  EnergyBalance<S> balance(row.world);
  double stored = 0;
  for (int k = 0; k < 4000 && row.world.breakages().empty(); ++k) {
    stored = row.world.bonds()[0].elastic;
    balance.add(row.world, row.world.step(1e-5), 1e-5);
  }
  const double expected = tension * tension / (2 * stiffness);
  CHECK(agree(double(stored), expected, 0.01));
  CHECK(agree(double(balance.terms().fracture), expected, 0.01));
  CHECK(agree(double(balance.terms().drives), expected, 0.01));
  CHECK(std::abs(balance.terms().elastic) < 1e-6 * expected);
  CHECK(std::abs(balance.imbalance()) < 1e-6 * expected);
  REQUIRE(row.world.breakages().size() == 1);
  CHECK(agree(double(row.world.breakages()[0].energy), expected, 0.01));
}

TEST_CASE_TEMPLATE(
    "bond: a chain bends as its springs, and nearly as a beam of Euler and Bernoulli", X,
    MOREAU_TYPES((Case<Circle, Soft>), (Case<Globe, Soft>))) {
  const std::size_t count = 11;
  Row<typename X::Shape, Soft> chain(count);
  const double force = 0.01, tip = 2 * radius * double(count - 1), arm = radius / 2;
  chain.load(0, force, 0);
  StepReport report;
  for (int k = 0; k < 200; ++k) report = chain.world.step(0.1);
  double deflection = 0, forces = 0, pushes = 0;
  for (std::size_t k = 0; k + 1 < count; ++k) {
    const double lever = tip - radius * double(2 * k + 1);
    const double square = force * force * (1 + lever * lever / (arm * arm));
    forces += square;
    pushes += square + tension * tension;
    deflection += force / tangential + force * lever * lever / (tangential * arm * arm);
  }
  const double found = chain.world.pose(chain.last()).position[1];
  CHECK(found / deflection == doctest::Approx(1).epsilon(1e-3));
  const double rigidity = tangential * arm * arm * 2 * radius;  // E I
  CHECK(agree(double(found), force * tip * tip * tip / (3 * rigidity), 0.02));
  CHECK(chain.world.bonds().size() == count - 1);
  CHECK(report.bond_error < 1e-3);
  CHECK(report.bond_load == doctest::Approx(std::sqrt(forces / pushes)).epsilon(1e-3));
  const auto says = [&] {
    const auto sentences = moreau::check(chain.world, report);
    return std::any_of(sentences.begin(), sentences.end(), [](const auto& sentence) {
      return sentence.find("bonds") != std::string::npos;
    });
  };
  CHECK(!says());
  report.bond_error = 0.01;
  CHECK(says());
}

TEST_CASE_TEMPLATE("bond: the contact of a broken bond takes over the energy of its compression", X,
                   MOREAU_TYPES((Case<Globe, Soft>), (Case<Circle, Soft>))) {
  using Shape = typename X::Shape;
  using S = SpaceOf<Shape>;
  constexpr double push = 10, k = 1e6, h = 1e-5;
  // Without friction, which would hold the pair after its bond has broken.
  Row<Shape, Soft> row(2, 0, 1e5);
  row.world.set_materials(
      Materials<Soft>(1, Soft(Bonded<double>({tension, shear, bending}), k, k / 2)));
  EnergyBalance<S> balance(row.world);
  for (int n = 0; n < 20000 && row.world.breakages().empty(); ++n) {
    const double aside = 2 * shear * n / 10000;
    row.load(-push * std::min(1.0, n / 2000.0), aside, -aside * radius);
    balance.add(row.world, row.world.step(h), h);
  }
  REQUIRE(row.world.breakages().size() == 1);
  const double pressed = push * push / (2 * k), before = balance.terms().impacts;
  CHECK(agree(double(row.world.breakages()[0].energy), double(balance.terms().fracture), 1e-9));
  row.load(0, 0, 0);
  for (int n = 0; n < 3000; ++n) balance.add(row.world, row.world.step(h), h);
  // The spring of the contact gives it back, without what implicit Euler takes of a swing.
  CHECK(balance.terms().impacts - before > -0.03 * pressed);
  CHECK(balance.terms().elastic < 1e-3 * pressed);
  CHECK(std::abs(balance.imbalance()) < 1e-6 * pressed);
}

TEST_CASE("bond: breakages in an impact take no negative energy") {
  using S = Space<2>;
  using Vector = S::Vector;
  constexpr double size = 0.02, energy = 0.05, h = 1e-5;
  const Bonded<double> law({1000, 800, 600, energy});
  Simulation<Polygon<>, Bonded<double>> world(size, Materials<Bonded<double>>(1, law));
  const ShapeId shape = world.add_shape(cuboid<Polygon<>>(Vector(Vector::Constant(size / 2))));
  world.add_wall(Vector(Vector::UnitY()), Vector(Vector::Zero()));
  const auto turn = S::exp(S::Angular(0.2));
  for (int k = 0; k < 12; ++k) {
    const Vector x = turn * Vector(size * (k % 4), size * (k / 4));
    const BodyId grain =
        world.add_grain(shape, Pose<S>(Vector(x + 0.012 * Vector::UnitY()), turn), 1000);
    world.set_velocity(grain, Vector(-4 * Vector::UnitY()));
  }
  CHECK(world.bond_touching(1e-6) == 29);  // at corners as well
  EnergyBalance<S> balance(world);
  for (int k = 0; k < 300; ++k) balance.add(world, world.step(h), h);
  REQUIRE(world.breakages().size() > 3);
  double sum = 0;
  for (const Breakage& one : world.breakages()) {
    CHECK(one.energy >= 0);
    sum += one.energy;
  }
  CHECK(balance.terms().fracture >= sum - 1e-12);
}
