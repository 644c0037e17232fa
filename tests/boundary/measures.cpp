// SPDX-License-Identifier: MIT
// Instruments (stress, energy balance, ..) of whole simulations: with contacts across a periodic
// boundary, and while the simulation runs.
#include <cmath>
#include <doctest/doctest.h>
#include <stdexcept>
#include <string>
#include <vector>

#include "moreau/boundary/servo.hpp"
#include "moreau/io/snapshot.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/measure/contact_classes.hpp"
#include "moreau/measure/coordination.hpp"
#include "moreau/measure/energy_balance.hpp"
#include "moreau/measure/fabric.hpp"
#include "moreau/measure/force_chains.hpp"
#include "moreau/measure/pair_forces.hpp"
#include "moreau/measure/solid_fraction.hpp"
#include "moreau/measure/stress.hpp"
#include "moreau/measure/velocity_field.hpp"

#include "world/assemblies.hpp"

using moreau::Aabb;
using moreau::BallIn;
using moreau::Pose;
using moreau::Space;

namespace {

using Law = moreau::SignoriniCoulomb<double>;

template <class S>
auto position_of(const auto& simulation) {
  return [&](std::uint32_t body) ->
         typename S::Vector { return simulation.bodies().pose[body].position; };
}

/// The energy balance of grains that fall into a box. One wall moves towards the opposite wall;
/// another wall has a mass and is pushed back; the grains slide on all walls with friction.
template <class ShapeT>
moreau::EnergyBalance<moreau::SpaceOf<ShapeT>> balance_of(double h) {
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  scenes::BoxOfGrains<ShapeT> box(12);
  auto& world = box.simulation;
  world.set_velocity(box.walls[0], 0.05 * Vector::UnitX() + 0.02 * Vector::Unit(S::dim - 1));
  world.set_wall_mass(box.walls[1], 0.01);
  world.set_force(box.walls[1], -0.5 * Vector::UnitX());
  world.set_force(box.grains[0], 0.01 * Vector::UnitX());
  const typename S::Angular torque = 1e-5 * S::Angular::Unit(S::angular_dim - 1);
  world.set_torque(box.grains[1], torque);
  moreau::EnergyBalance<S> energy(world);
  for (double t = 0; t < 0.2; t += h) energy.add(world, world.step(h), h);
  return energy;
}

/// Sum of the absolute values of the terms, the scale for the imbalance.
double turnover(const moreau::EnergyTerms& terms) {
  return std::abs(terms.gravity) + std::abs(terms.forces) + std::abs(terms.drives) +
         std::abs(terms.impacts) + std::abs(terms.friction) + std::abs(terms.correction);
}

}  // namespace

TEST_CASE_TEMPLATE("the energy balance closes to rounding where the inertia does not turn", ShapeT,
                   moreau::Ball<>, moreau::Polygon<double>) {
  const auto energy = balance_of<ShapeT>(1e-3);
  const moreau::EnergyTerms& terms = energy.terms();
  CHECK(std::abs(energy.imbalance()) < 1e-12 * turnover(terms));
  // Every term contributes, and has the right sign.
  CHECK(terms.gravity > 0);
  CHECK(terms.impacts > 0);
  CHECK(terms.friction > 0);
  CHECK(terms.drives > 1e-3 * terms.impacts);
  CHECK(std::abs(terms.forces) > 1e-3 * terms.impacts);
  CHECK(terms.rolling == 0);
  CHECK(energy.kinetic_at_start() == 0);
}

TEST_CASE("the energy balance of bodies whose inertia turns closes as the step shrinks") {
  const auto coarse = balance_of<moreau::Polyhedron<double>>(1e-3);
  const auto fine = balance_of<moreau::Polyhedron<double>>(2.5e-4);
  CHECK(std::abs(coarse.imbalance()) < 1e-2 * turnover(coarse.terms()));
  CHECK(std::abs(fine.imbalance()) < 0.5 * std::abs(coarse.imbalance()));
}

TEST_CASE("a balance goes on with a run from its snapshot") {
  using ShapeT = moreau::Polygon<double>;
  const auto run = [](auto& world, auto& energy) {
    for (int k = 0; k < 50; ++k) energy.add(world, world.step(1e-3), 1e-3);
  };
  scenes::BoxOfGrains<ShapeT> box(6), other(6);
  moreau::EnergyBalance<Space<2>> energy(box.simulation), again(other.simulation);
  run(box.simulation, energy);
  const std::string bytes = moreau::snapshot(box.simulation, energy);
  moreau::restore_snapshot(bytes, other.simulation, again);
  run(box.simulation, energy);
  run(other.simulation, again);
  CHECK(moreau::snapshot(box.simulation, energy) == moreau::snapshot(other.simulation, again));
  CHECK(again.imbalance() == energy.imbalance());
  CHECK(energy.terms().gravity != 0);
}

TEST_CASE("a balance is kept of the bodies that it began with") {
  scenes::BoxOfGrains<moreau::Ball<>> box(2);
  moreau::EnergyBalance<Space<3>> energy(box.simulation);
  const auto report = box.simulation.step(1e-3);
  CHECK_THROWS_AS(energy.add(box.simulation, report, 0), std::invalid_argument);
  CHECK_THROWS_WITH_AS(energy.add(box.simulation, report, 1),
                       "EnergyBalance::add: step = 1 must be the step of the report",
                       std::invalid_argument);
  box.simulation.add_wall({0, 0, -1}, {0, 0, 1});
  CHECK_THROWS_AS(energy.add(box.simulation, report, 1e-3), std::invalid_argument);
}

TEST_CASE_TEMPLATE("measures see contacts across the boundary", ShapeT, moreau::Ball<>,
                   moreau::Disk<>) {
  // A chain of three balls that is closed through the periodic boundary and compressed by a cell
  // that is slightly too short.
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  const double h = 1e-3, radius = 0.1, overlap = 1e-4;
  moreau::OverlapCorrectionOptions off;
  off.enabled = false;
  scenes::World<ShapeT> ring(0.2, moreau::Materials<Law>(1, Law(0.3)),
                             moreau::ColouredGaussSeidel(), {}, off);
  const double length = 3 * (2 * radius - overlap);
  ring.set_periodic(0, 0, length);
  const auto shape = ring.add_shape(ShapeT(radius));
  for (int k = 0; k < 3; ++k) {
    Pose<S> pose;
    pose.position[0] = 0.05 + (k - 4) * length / 3;  // all balls start outside of the cell
    ring.add_grain(shape, pose, 1000);
  }
  // One step finds the three contacts. Their impulses are then set to a known value.
  ring.step(h);
  REQUIRE(ring.contacts().size() == 3);
  auto contacts = ring.contacts();
  for (Vector& impulse : contacts.impulses) impulse = 2 * Vector::UnitX();
  const auto is_grain = [](std::uint32_t) { return true; };
  Aabb<S> volume;
  volume.lower.setConstant(-0.5);
  volume.upper.setConstant(0.5);
  volume.lower[0] = 0.3;  // differs from the bounds of the cell
  volume.upper[0] = 0.3 + length;
  const auto stress =
      moreau::contact_stress(contacts, h, volume, position_of<S>(ring), is_grain, ring.cell());
  // For a chain that carries the force f, the stress along the chain is f per cross-section.
  CHECK(stress(0, 0) == doctest::Approx(2 / h));
  moreau::CoordinationCounter<S> counter;
  CHECK(counter.count(contacts.points, contacts.impulses, 3, is_grain).neighbours == 2);
  std::vector<moreau::ContactSegment<S>> segments;
  moreau::force_chains(contacts, h, position_of<S>(ring), is_grain, segments, ring.cell());
  REQUIRE(segments.size() == 3);
  for (const auto& segment : segments) {
    CHECK((segment.to - segment.from).norm() == doctest::Approx(length / 3));
    CHECK((segment.from - segment.point).norm() < radius);
    CHECK((segment.to - segment.point).norm() < radius);
  }
  // All images of the balls are in the cell, whose sides cut some of them.
  const double solid = 3 * ShapeT(radius).volume();
  CHECK(moreau::solid_fraction(ring, volume) ==
        doctest::Approx(solid / moreau::volume(volume)).epsilon(1e-12));
  Aabb<S> twice = volume;
  twice.upper[0] += length;
  CHECK(moreau::solid_fraction(ring, twice) ==
        doctest::Approx(solid / moreau::volume(volume)).epsilon(1e-12));
  Aabb<S> left = volume, right = volume;
  left.upper[0] = right.lower[0] = 0.37;
  CHECK(moreau::solid_fraction(ring, left) * moreau::volume(left) +
            moreau::solid_fraction(ring, right) * moreau::volume(right) ==
        doctest::Approx(solid).epsilon(1e-12));
  moreau::VelocityField<S> field(volume, 3, 1);
  for (std::uint32_t k = 0; k < 3; ++k)
    field.add(ring.bodies().pose[k].position, Vector::UnitX(), ring.cell());
  for (std::size_t column = 0; column < 3; ++column) CHECK(field.sample(column, 0).grains == 1);
}

TEST_CASE_TEMPLATE("measures of a simulation count images", ShapeT, moreau::Ball<>,
                   moreau::Disk<>) {
  // One ball lies on the floor, another on it, across the periodic boundary.
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  const double h = 1e-3, radius = 0.1, distance = 2 * radius - 1e-4, length = 1, offset = 0.1;
  scenes::World<ShapeT> pile(0.2, moreau::Materials<Law>(1, Law(0.3)));
  pile.set_periodic(0, 0, length);
  pile.set_gravity(-9.81 * Vector::Unit(up));
  pile.add_wall(Vector::Unit(up), Vector::Zero());
  const auto shape = pile.add_shape(ShapeT(radius));
  Pose<S> lower, upper;
  lower.position[0] = 0.05;
  lower.position[up] = radius;
  const Vector branch = -offset * Vector::UnitX() +
                        std::sqrt(distance * distance - offset * offset) * Vector::Unit(up);
  upper.position = lower.position + branch + length * Vector::UnitX();
  pile.add_grain(shape, lower, 1000);
  pile.add_grain(shape, upper, 1000);
  pile.step(h);
  REQUIRE(pile.contacts().size() == 2);

  Aabb<S> volume;
  volume.lower.setConstant(-0.5);
  volume.upper.setConstant(0.5);
  const auto is_grain = [&](std::size_t body) { return pile.is_grain(body); };
  const auto stress = moreau::contact_stress(pile, h, volume);
  CHECK(stress == moreau::contact_stress(pile.contacts(), h, volume, position_of<S>(pile), is_grain,
                                         pile.cell()));
  CHECK(stress(up, up) > 0);
  CHECK(moreau::pair_forces(pile, h).size() == 2);
  const auto fabric = moreau::fabric(pile, h, volume);
  REQUIRE(fabric.pairs == 1);
  const Vector normal = branch / distance;
  CHECK((fabric.tensor - normal * normal.transpose()).norm() < 1e-3);
  double neighbours = 0;
  for (const auto& share : moreau::contact_classes(pile, h).shares) neighbours += share.neighbours;
  CHECK(neighbours == moreau::coordination(pile).neighbours);
  CHECK(neighbours == 1.5);
  for (const auto& segments : {moreau::force_chains(pile, h), moreau::contact_segments(pile, h)}) {
    REQUIRE(segments.size() == 2);
    for (const auto& segment : segments) CHECK((segment.to - segment.from).norm() < 2 * radius);
  }
  Aabb<S> twice = volume;
  twice.upper[0] += length;  // two images of a contact lie in it
  CHECK_THROWS_AS(moreau::contact_stress(pile, h, twice), std::invalid_argument);
  CHECK_THROWS_AS(moreau::fabric(pile, h, twice), std::invalid_argument);
  CHECK_THROWS_AS(moreau::contact_stress(pile, 0, volume), std::invalid_argument);
  CHECK_THROWS_AS(moreau::pair_forces(pile, 0), std::invalid_argument);
  // A step in ms would give forces that are a thousandth.
  const auto ms = typename S::Scalar(1000 * h);
  const char* const text = "step / last step = 1000 must be near 1";
  CHECK_THROWS_WITH_AS((void)moreau::contact_stress(pile, ms, volume), doctest::Contains(text),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(moreau::pair_forces(pile, ms), doctest::Contains(text),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(moreau::fabric(pile, ms, volume), doctest::Contains(text),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(moreau::contact_classes(pile, ms), doctest::Contains(text),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(moreau::force_chains(pile, ms), doctest::Contains(text),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(moreau::contact_segments(pile, ms), doctest::Contains(text),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(moreau::wall_pressure(pile, pile.walls()[0], ms, 1), doctest::Contains(text),
                       std::invalid_argument);
  CHECK_THROWS_AS(moreau::fabric(pile, h, Aabb<S>{}), std::invalid_argument);
}

TEST_CASE(
    "the balance of balls that twist against each other closes where the net impulse is zero") {
  using Law = moreau::Cohesive<moreau::RollingResistance<>>;
  moreau::Simulation<moreau::Ball<>, Law> world(
      0.02, moreau::Materials<Law>(1, Law(moreau::RollingResistance<>(0.5, 0.1), 1.0)));
  const moreau::ShapeId shape = world.add_shape(moreau::Ball<>(0.01));
  const moreau::BodyId a = world.add_grain(shape, {{0, 0, 0}}, 2500);
  const moreau::BodyId b = world.add_grain(shape, {{0.02, 0, 0}}, 2500);
  world.set_spin(a, {10, 0, 0});
  world.set_spin(b, {-10, 0, 0});
  moreau::EnergyBalance<Space<3>> energy(world);
  for (int k = 0; k < 20; ++k) energy.add(world, world.step(1e-5), 1e-5);
  CHECK(energy.terms().rolling > 1e-6);
  CHECK(std::abs(energy.imbalance()) < 1e-12 * energy.kinetic_at_start());
}
