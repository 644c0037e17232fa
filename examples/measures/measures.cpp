// SPDX-License-Identifier: MIT
// The same experiment in the plane and in space, from one source: grains fall into a box, a lid
// presses on them, and the program measures the packing. Prints a table for each dimension and
// writes into measures-output/:
//  - run.csv: height of the lid and kinetic energy over time
//  - run.pvd: grains, walls and contacts over time, for ParaView
//  - displacement.vtp: displacements of the grains at the end, for ParaView
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <moreau/moreau.hpp>
#include <random>
#include <string>
#include <vector>

#include "moreau/io/csv.hpp"
#include "moreau/io/vtk.hpp"
#include "moreau/io/write_paraview.hpp"
#include "moreau/measure/contact_classes.hpp"
#include "moreau/measure/coordination.hpp"
#include "moreau/measure/energy_balance.hpp"
#include "moreau/measure/fabric.hpp"
#include "moreau/measure/force_distribution.hpp"
#include "moreau/measure/pair_forces.hpp"
#include "moreau/measure/stress.hpp"

namespace fs = std::filesystem;
using Law = moreau::SignoriniCoulomb<double>;

namespace setup {
constexpr double size = 0.01, width = 0.06;   // of a grain; of the box [m]
constexpr double pressure = 1000;             // of the lid [Pa]; in the plane [N/m]
constexpr double h = 2.5e-4, duration = 0.5;  // [s]
}  // namespace setup
using namespace setup;

/// Counts the steps that did not converge and keeps the largest residual and overlap [m] of a run.
struct Watch {
  std::size_t steps = 0, unsolved = 0;
  double residual = 0, overlap = 0, approach = 0;

  void operator()(const moreau::StepReport& report) {
    ++steps;
    if (!report.solve.converged) ++unsolved;
    residual = std::max(residual, report.solve.residual);
    overlap = std::max(overlap, report.max_overlap);
    approach = std::max(approach, report.approach);
  }
};

/// Adds an open box, gravity along the last axis, and grains of three sizes near the points of a
/// grid.
/// @returns mass of all grains [kg]
template <class Simulation>
double fill(Simulation& simulation) {
  using S = typename Simulation::S;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  const moreau::ShapeId grains[] = {simulation.add_shape(moreau::BallIn<S>(0.40 * size)),
                                    simulation.add_shape(moreau::BallIn<S>(0.45 * size)),
                                    simulation.add_shape(moreau::BallIn<S>(0.50 * size))};
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> jitter(-0.05 * size, 0.05 * size);
  const int per_side = 5, layers = 8;
  const int count = layers * (up == 1 ? per_side : per_side * per_side);
  double mass = 0;
  for (int k = 0; k < count; ++k) {
    moreau::Pose<S> pose;
    int rest = k;
    for (int axis = 0; axis < up; ++axis, rest /= per_side)
      pose.position[axis] = width / per_side * (rest % per_side + 0.5) + jitter(random);
    pose.position[up] = 1.15 * size * (rest + 0.5);
    mass += simulation.bodies().grain_mass[simulation.add_grain(grains[k % 3], pose, 2500).index()];
  }
  for (int axis = 0; axis < up; ++axis) {
    simulation.add_wall(Vector::Unit(axis), Vector::Zero());
    simulation.add_wall(-Vector::Unit(axis), width * Vector::Unit(axis));
  }
  simulation.add_wall(Vector::Unit(up), Vector::Zero());
  simulation.set_gravity(-9.81 * Vector::Unit(up));
  return mass;
}

template <class Shape>
void run(const fs::path& folder) {
  using S = moreau::SpaceOf<Shape>;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  fs::create_directories(folder);

  moreau::Simulation<Shape, Law> simulation(size, moreau::Materials<Law>(1, Law(0.4)));
  const double mass = fill(simulation), area = std::pow(width, up);
  const moreau::BodyId lid = simulation.add_wall(-Vector::Unit(up), 9.5 * size * Vector::Unit(up));
  simulation.set_wall_mass(lid, mass);
  simulation.set_force(lid, -pressure * area * Vector::Unit(up));

  std::vector<Vector> start;
  for (const moreau::BodyId grain : simulation.grains())
    start.push_back(simulation.pose(grain).position);

  moreau::CsvWriter table(folder / "run.csv", {{"t", "s"}, {"lid", "m"}, {"kinetic", "J"}});
  moreau::PvdSeries series(folder / "run.pvd");
  moreau::EnergyBalance<S> energy(simulation);
  Watch watch;
  for (int step = 0; simulation.time() < duration; ++step) {
    const moreau::StepReport report = simulation.step(h);
    watch(report);
    energy.add(simulation, report, h);
    if (step % 200 != 0) continue;
    table.row(simulation.time(), simulation.pose(lid).position[up], energy.kinetic());
    const std::string name = "run_" + std::to_string(step / 200);
    moreau::write_paraview(folder / name, simulation, h);
    series.add(simulation.time(), name + ".vtm");
  }

  moreau::Aabb<S> box{Vector::Zero(), Vector::Constant(width)};
  box.upper[up] = simulation.pose(lid).position[up];
  // One grain diameter inside the walls: contact points on a wall can lie outside a control volume that
  // ends on the wall, and the stress is then 3 to 19 percent too small.
  const moreau::Aabb<S> inside = box.inflated(-size);
  const typename S::Matrix stress = moreau::contact_stress(simulation, h, inside);
  const moreau::Fabric<S> fabric = moreau::fabric(simulation, h, inside);
  const std::vector<moreau::PairForce<S>> pairs = moreau::pair_forces(simulation, h);
  const auto forces = moreau::force_distribution<double>(
      pairs.size(), [&](std::size_t k) { return pairs[k].normal_force; }, 12, 4.0);
  const moreau::Coordination coordination = moreau::coordination(simulation, 2);
  typename moreau::GridField<S>::Cells cells;
  cells.fill(6);
  moreau::GridField<S> displacement(box, cells);
  for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
    const Vector& position = simulation.pose(simulation.grain(k)).position;
    displacement.add(position, position - start[k]);
  }
  moreau::VtkWriter<S>().write_field(folder / "displacement.vtp", displacement);

  const moreau::EnergyTerms& terms = energy.terms();
  std::cout << folder.filename().string() << ", " << simulation.grain_count() << " grains\n"
            << "  steps " << watch.steps << ", not converged " << watch.unsolved
            << ", largest residual " << watch.residual << ", largest overlap "
            << watch.overlap / size << " d\n"
            << "  stress normal to the lid " << stress(up, up) << ", parallel to it "
            << stress(0, 0) << "; pressure of the lid " << pressure << '\n'
            << "  mean number of neighbours " << coordination.neighbours << " without "
            << coordination.rattlers << " rattlers; fabric " << fabric.tensor.diagonal().transpose()
            << '\n'
            << "  share of forces above the mean, in bins of a third of the mean:";
  for (std::size_t k = 3; k < 12; ++k) std::cout << ' ' << forces.density[k] * forces.width;
  std::cout << "\n  energy [J]: gravity " << terms.gravity << ", lid " << terms.forces
            << ", impacts " << terms.impacts << ", friction " << terms.friction << ", imbalance "
            << energy.imbalance() << '\n';
}

int main() {
  run<moreau::Disk<double>>("measures-output/plane");
  run<moreau::Ball<double>>("measures-output/space");
}
