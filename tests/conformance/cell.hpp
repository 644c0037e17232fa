// SPDX-License-Identifier: MIT
// The requirements on every combination of shape, law and integrator for impulses in a periodic cell that deforms. A new
// policy is tested by one line:
//
//   TEST_CASE("mine") { conformance::cell(MyShape(...), MyLaw(...), size); }
#pragma once

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <vector>

#include "moreau/law/concepts.hpp"
#include "moreau/measure/energy_balance.hpp"
#include "moreau/world/simulation.hpp"

#include "conformance/world.hpp"

namespace conformance {

/// Grains on a lattice in a cell, with random velocities; without gravity.
template <class SimulationT, class ShapeT>
class CellOfGrains {
 public:
  using S = moreau::SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Matrix = typename S::Matrix;

  /// @param size diameter of a ball that contains any of the shapes [m]
  /// @param side grains along each axis
  CellOfGrains(const std::vector<ShapeT>& shapes, const auto& law, T size, int side)
      : simulation(size, moreau::Materials<std::decay_t<decltype(law)>>(2, law)), size_(size) {
    const T spacing = T(1.1) * size;
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<moreau::ShapeId> ids;
    for (const ShapeT& shape : shapes) ids.push_back(simulation.add_shape(shape));
    int count = 1;
    for (int axis = 0; axis < S::dim; ++axis) count *= side;
    for (int k = 0; k < count; ++k) {
      moreau::Pose<S> pose;
      typename S::Vector v;
      typename S::Angular turn, w;
      for (int axis = 0, rest = k; axis < S::dim; ++axis, rest /= side) {
        pose.position[axis] = spacing * (T(rest % side) + T(0.5));
        v[axis] = T(uniform(random));
      }
      for (auto& x : turn) x = T(uniform(random));
      for (auto& x : w) x = T(uniform(random)) / size;
      pose.rotation = S::exp(turn);
      const auto grain = simulation.add_grain(ids[std::size_t(k) % ids.size()], pose, T(1000),
                                              moreau::MaterialId(std::size_t(k) % 2));
      simulation.set_velocity(grain, v);
      simulation.set_spin(grain, w);
    }
    simulation.set_cell(T(side) * spacing * Matrix::Identity());
  }
  double mass() const {
    double sum = 0;
    for (const T one : simulation.bodies().grain_mass) sum += double(one);
    return sum;
  }
  /// Largest relative difference of the principal moments of a grain, whose free flight has an error of second order in
  /// the rotation per step (case asymmetric_top of the validation).
  double unevenness() const {
    double most = 0;
    for (std::size_t i = 0; i < simulation.bodies().size(); ++i) {
      const typename S::Inertia inertia =
          simulation.bodies().inertia(i, simulation.bodies().pose[i].rotation);
      const auto moments =
          Eigen::SelfAdjointEigenSolver<typename S::Inertia>(inertia).eigenvalues().eval();
      most = std::max(most, 1 - double(moments.minCoeff() / moments.maxCoeff()));
    }
    return most > 1e-6 ? most : 0;
  }
  /// Momentum relative to the cell [N s].
  typename S::Vector momentum() const {
    typename S::Vector sum = S::Vector::Zero();
    for (std::size_t i = 0; i < simulation.bodies().size(); ++i)
      sum += simulation.bodies().grain_mass[i] *
             simulation.bodies().velocity[i].template head<S::dim>();
    return sum;
  }

  /// Runs some steps. Checks that the energy balance closes, that stress times rate of strain is the power of the cell, and
  /// that overlaps stay small.
  void run(int steps, T step) {
    using Law = typename std::decay_t<decltype(simulation.materials().laws()[0])>;
    const double rounding = double(std::numeric_limits<T>::epsilon());
    moreau::EnergyBalance<S> energy(simulation);
    double scale = energy.kinetic(), power_error = 0, work = 0, deepest = 0;
    int unsolved = 0;
    for (int k = 0; k < steps; ++k) {
      if constexpr (moreau::BondingLaw<Law, S>)
        if (k % 10 == 0) bonds_ += simulation.bond_touching(T(0.02) * size_);
      const auto& motion = simulation.cell_motion();
      const Matrix before = motion.rate();
      const moreau::StepReport report = simulation.step(step);
      energy.add(simulation, report, step);
      power_error =
          std::max(power_error, std::abs(power_of_stress(before, step) - report.cell_work));
      work += std::abs(report.cell_work);
      scale = std::max(scale, energy.kinetic());
      deepest = std::max(deepest, report.max_overlap);
      points_ += report.points;
      unsolved += !report.solve.converged;
    }
    CHECK(std::isfinite(energy.kinetic()));
    CHECK(work > 0);
    CHECK(power_error < 1e5 * rounding * (scale + work));
    CHECK(std::abs(energy.imbalance()) < (1e6 * rounding + 1e-3 * unevenness()) * (scale + work));
    CHECK(deepest < 0.05 * double(size_));
    CHECK(unsolved <= 1 + steps / 50);
  }
  /// -V tr(sigma L) h of the last step: the stress of the contacts with the mean of L before and after the step, that of the
  /// velocities with L before it.
  double power_of_stress(const Matrix& before, T step) const {
    const auto& motion = simulation.cell_motion();
    const auto& contacts = simulation.contacts();
    using Sum = Eigen::Matrix<double, S::dim, S::dim>;
    Sum by_contacts = Sum::Zero();
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const auto& contact = contacts.points[c];
      by_contacts +=
          ((contact.lever_a - contact.lever_b) * (contact.frame * contacts.impulse(c)).transpose())
              .template cast<double>();
    }
    const Sum all = (motion.volume() * step * motion.stress()).template cast<double>(),
              first = before.template cast<double>(), last = motion.rate().template cast<double>();
    return -(by_contacts * (first + last) / 2 + (all - by_contacts) * first).trace();
  }
  std::size_t points() const { return points_; }  ///< contact points of all steps
  std::size_t bonds() const { return bonds_; }    ///< that were made

  SimulationT simulation;

 private:
  T size_;
  std::size_t points_ = 0, bonds_ = 0;
};

/// Grains with random velocities in a cell that is compressed and sheared at a rate, then sheared at this rate while a
/// stress moves its height. Checks momentum, energy, power, and how far the cell has deformed.
/// @param size diameter of a ball that contains any of the shapes [m]
/// @param side grains along each axis; 3 have room in the sheared cell if the shapes are narrower than size
template <class Choice = Defaults, class ShapeT, class Law>
void cell(const std::vector<ShapeT>& shapes, const Law& law,
          typename moreau::SpaceOf<ShapeT>::Scalar size, int side = 3) {
  using Simulation = typename Choice::template Simulation<ShapeT, Law>;
  using Cell = CellOfGrains<Simulation, ShapeT>;
  using S = typename Cell::S;
  using T = typename Cell::T;
  const T h = T(2e-4);
  Cell grains(shapes, law, size, side);
  typename S::Vector momentum = grains.momentum();
  moreau::CellControl<S> control;
  control.rate(0, 1) = 6;
  for (int axis = 0; axis < S::dim; ++axis) control.rate(axis, axis) = T(-1.5);
  grains.simulation.control_cell(control);
  grains.run(200, h);
  // Contacts keep the sum of the momenta m p, which changes by -L m p (world/cell_control.hpp).
  for (int k = 0; k < 200; ++k) momentum -= h * control.rate * momentum;
  CHECK(double((grains.momentum() - momentum).norm()) < 1e-3 * grains.mass());
  CHECK(grains.points() > 0);
  if constexpr (moreau::BondingLaw<Law, S>) CHECK(grains.bonds() > 0);
  CHECK(double(grains.simulation.cell_motion().deformation()(0, 0)) ==
        doctest::Approx(std::exp(-0.06)).epsilon(1e-3));
  const double mass = grains.mass(), time = 100 * double(h);
  control = {};
  control.rate(0, 1) = 6;
  control.mass(1, 1) = T(mass);
  control.stress(1, 1) =
      T(0.2 * mass * std::pow(double(grains.simulation.cell().volume()), 2.0 / S::dim - 1) /
        (time * time));
  grains.simulation.control_cell(control);
  grains.run(100, h);
  const auto rate = grains.simulation.cell_motion().rate();
  CHECK(rate(0, 1) == T(6));
  CHECK(rate(1, 1) != T(0));
  CHECK(rate(0, 0) == T(0));
  CHECK(grains.simulation.cell_motion().deformation()(0, 1) > T(0.3));
}
template <class Choice = Defaults, moreau::Shape ShapeT, class Law>
void cell(const ShapeT& shape, const Law& law, typename moreau::SpaceOf<ShapeT>::Scalar size) {
  cell<Choice>(std::vector<ShapeT>{shape}, law, size);
}

}  // namespace conformance
