// SPDX-License-Identifier: MIT
// A periodic cell that deforms, under every kind of law, with compound grains and in float: work, energy, and independence of
// the vectors of the lattice.
#include <cmath>
#include <doctest/doctest.h>
#include <random>
#include <vector>

#include "moreau/law/bonded.hpp"
#include "moreau/law/bridges.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/measure/energy_balance.hpp"
#include "moreau/sample/compound_ballast.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/compound.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

using namespace moreau;

namespace {

/// Square of grains in a cell, with velocities; bonded in rows.
template <class ShapeT, class Law>
struct Square {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;
  static constexpr int side = 6;
  static constexpr T spacing = T(0.0205);
  Simulation<ShapeT, Law> simulation;
  std::vector<BodyId> grains;

  /// @param turned with other vectors of the lattice, and other images
  Square(const Law& law, const std::vector<ShapeT>& shapes, bool turned)
      : simulation(T(0.02), Materials<Law>(1, law), solver()) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> jitter(-1, 1);
    std::vector<ShapeId> ids;
    for (const ShapeT& shape : shapes) ids.push_back(simulation.add_shape(shape));
    const Matrix vectors = side * spacing * Matrix::Identity();
    for (int k = 0; k < side * side; ++k) {
      Vector x(spacing * (T(k % side) + T(0.5)), spacing * (T(k / side) + T(0.5)));
      if (turned) x += vectors * Vector(T(k % 3 - 1), T(k % 2));
      const ShapeId shape = ids[std::size_t(k) % ids.size()];
      const Pose<S> pose{x, S::exp(typename S::Angular(T(jitter(random))))};
      grains.push_back(simulation.add_grain(shape, pose, 1000));
      const T u = T(0.1 * jitter(random)), v = T(0.1 * jitter(random));
      simulation.set_velocity(grains.back(), {u, v});
    }
    Matrix other = vectors;
    other.col(0) = vectors.col(1);
    other.col(1) = -vectors.col(0);
    simulation.set_cell(turned ? other : vectors);
    if constexpr (BondingLaw<Law, S>)
      for (int k = 0; k < side * side; ++k)
        for (const int next : {(k / side) * side + (k + 1) % side, (k + side) % (side * side)})
          simulation.bond(grains[std::size_t(k)], grains[std::size_t(next)]);
    CellControl<S> control;
    control.rate(0, 1) = 6;
    control.rate(0, 0) = T(-0.3);
    simulation.control_cell(control);
  }
  static ColouredGaussSeidel solver() {
    ColouredOptions options;
    options.tolerance = std::is_same_v<T, float> ? 1e-5 : 1e-13;
    return ColouredGaussSeidel(options);
  }
};

/// Shears two such simulations, by 0.6.
/// @param tolerance of sums, relative to the largest work of a step
/// @param compared  steps in which forces are compared; later, what rounding has changed has grown
template <class ShapeT, class Law>
void check(const Law& law, const std::vector<ShapeT>& shapes, double tolerance = 1e-9,
           int compared = 25) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  const T h = T(2.5e-4);
  Square<ShapeT, Law> one(law, shapes, false), two(law, shapes, true);
  EnergyBalance<S> energy(one.simulation);
  double largest = 0, worst_power = 0, force = 0, difference = 0;
  for (int k = 0; k < 400; ++k) {
    const StepReport report = one.simulation.step(h);
    energy.add(one.simulation, report, h);
    const auto& motion = one.simulation.cell_motion();
    const double volume = double(one.simulation.cell().volume()) /
                          double((S::Matrix::Identity() + h / 2 * motion.rate()).determinant());
    const double power = -volume * double((motion.stress() * motion.rate()).trace() * h);
    largest = std::max(largest, std::abs(report.cell_work));
    worst_power = std::max(worst_power, std::abs(power - report.cell_work));
    if (k >= compared) continue;
    two.simulation.step(h);
    for (std::size_t i = 0; i < one.grains.size(); ++i) {
      const typename S::Vector push = one.simulation.contact_impulse(one.grains[i]),
                               other = two.simulation.contact_impulse(two.grains[i]);
      force = std::max(force, double(push.norm()));
      difference = std::max(difference, double((push - other).norm()));
    }
  }
  CHECK(one.simulation.cell_motion().deformation()(0, 1) > T(0.55));
  CHECK(worst_power < tolerance * largest);
  CHECK(std::abs(energy.imbalance()) < 100 * tolerance * largest);
  if (compared == 0) return;
  CHECK(force > 0);
  CHECK(difference < 1e3 * tolerance * force);
}

/// Compresses a simulation by a stress on all sides: it comes to rest under the stress, and the balance of energy
/// holds.
template <class ShapeT, class Law>
void check_stress(const Law& law, const std::vector<ShapeT>& shapes) {
  using S = SpaceOf<ShapeT>;
  const double h = 5e-4, pressure = 1e3;
  Square<ShapeT, Law> one(law, shapes, false);
  auto& simulation = one.simulation;
  ColouredOptions options;
  options.tolerance = 1e-6;
  options.max_sweeps = 5000;
  simulation.set_solver(ColouredGaussSeidel(options));
  CellControl<S> control;
  for (const double mass : simulation.bodies().grain_mass)
    control.mass += mass * S::Matrix::Identity();
  control.stress = pressure * S::Matrix::Identity();
  control.damping = 50;
  simulation.control_cell(control);
  EnergyBalance<S> energy(simulation);
  int unsolved = 0;
  typename S::Matrix mean = S::Matrix::Zero();
  for (int k = 0; k < 1600; ++k) {
    const StepReport report = simulation.step(h);
    energy.add(simulation, report, h);
    unsolved += !report.solve.converged;
    if (k >= 1500) mean += simulation.cell_motion().stress() / 100;
  }
  CHECK(unsolved < 32);  // at this tolerance the cap ends 1 to 20 of 1,600 steps
  CHECK((mean.diagonal().array() / pressure - 1).abs().maxCoeff() < 0.01);
  CHECK(simulation.cell_motion().rate().norm() < 1e-2);
  CHECK(std::abs(energy.imbalance()) < 1e-9 * energy.terms().cell);
}

using Coulomb = SignoriniCoulomb<>;
const std::vector<Disk<>> disks{Disk<>(0.01), Disk<>(0.008)};

}  // namespace

TEST_CASE("a deforming cell: rolling resistance") {
  check(RollingResistance<>(0.4, 0.1), disks);
}
TEST_CASE("a deforming cell: cohesion") {
  check(Cohesive<Coulomb>(Coulomb(0.4), 0.5), disks);
}
TEST_CASE("a deforming cell: capillary bridges") {
  check(Bridged<CapillaryBridge<>, Coulomb>(CapillaryBridge<>(1e-9), Coulomb(0.4)), disks);
}
TEST_CASE("a deforming cell: restitution") {
  check(Coulomb(0.4, 0.5), disks);
}
TEST_CASE("a deforming cell: compliant bonds, across the boundary and through a reduction") {
  using Law = Compliant<Bonded<>>;
  check(Law(Bonded<>(BondStrength<>{1e4, 1e4, 1e4}, 0.4), 1e4, 1e4),
        std::vector<Disk<>>{Disk<>(0.0102)});
}
TEST_CASE("a deforming cell: compound grains") {
  std::mt19937_64 random(4);
  std::vector<Compound<Polygon<>>> shapes;
  for (const auto& grain : ballast_shapes<Compound<Polygon<>>>(3, random))
    shapes.push_back(grain.scaled(0.009));
  check(Coulomb(0.4), shapes, 1e-9, 120);
}
TEST_CASE("a deforming cell: compliant polygons") {
  check(Compliant<>(Coulomb(0.4), 1e4, 1e4),
        std::vector<Polygon<>>{cuboid<Polygon<>>({0.008, 0.007})});
}
TEST_CASE("a deforming cell: float") {
  check(SignoriniCoulomb<float>(0.4f), std::vector<Disk<float>>{Disk<float>(0.01f)}, 1e-5,
        0);  // images of a float differ by 1e-7
}
TEST_CASE("a cell under a stress: laws without springs") {
  check_stress(Coulomb(0.4), disks);
  check_stress(Coulomb(0.4, 0.5), disks);
  check_stress(RollingResistance<>(0.4, 0.1), disks);
  check_stress(Cohesive<Coulomb>(Coulomb(0.4), 0.5), disks);
  check_stress(Bridged<CapillaryBridge<>, Coulomb>(CapillaryBridge<>(1e-9), Coulomb(0.4)), disks);
}
