// SPDX-License-Identifier: MIT
// What bonds and a cell that deforms cost: steps of one jammed packing of polyhedra, each with a shape of its own, in a
// periodic box, pressed from both sides towards its middle plane. There is one program per law; all have the same grains.
//
//   bench_bonds_and_cells_LAW make FILE [GRAINS]      makes the packing by the stress of a cell, without friction
//   bench_bonds_and_cells_LAW FILE CELL BONDS SWEEPS STEPS
//
//   LAW     coulomb, cohesive, rolling, bonded, springs, bonded_springs
//   CELL    box     a periodic box (set_periodic())
//           cell    the same as a cell of set_cell() that does not deform
//           rate    the same, sheared at a rate
//           stress  the same, sheared at a rate while a stress moves its height
//   BONDS   bonds (all pairs that touch are bonded) or none
//   SWEEPS  of every step; 0: as many as the default tolerance takes
//
// Times say little on a machine with other load. Instructions of the STEPS, without what comes before:
//
//   valgrind --tool=callgrind --toggle-collect='measured_steps*' bench_bonds_and_cells_bonded ...
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "moreau/law/bonded.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/moreau.hpp"
#include "moreau/sample/ballast.hpp"
#include "moreau/sample/size_distribution.hpp"

using namespace moreau;
using S = Space<3>;
using Vector = S::Vector;
using Matrix = S::Matrix;

namespace {

[[maybe_unused]] constexpr double friction = 0.4, rolling = 0.1, pressure = 1e5;  // [-], [-], [Pa]
constexpr double stiffness = 5e8;                                                 // [N/m]
constexpr double step = 1e-4, density = 2700;                                     // [s], [kg/m^3]

[[maybe_unused]] SignoriniCoulomb<> law_of(const SignoriniCoulomb<>*) {
  return SignoriniCoulomb<>(friction);
}
[[maybe_unused]] RollingResistance<> law_of(const RollingResistance<>*) {
  return RollingResistance<>(friction, rolling);
}
[[maybe_unused]] Bonded<> law_of(const Bonded<>*) {
  return Bonded<>({1e4, 1e4, 1e4}, friction, rolling);
}
template <class Law>
Cohesive<Law> law_of(const Cohesive<Law>*) {
  return Cohesive<Law>(law_of(static_cast<const Law*>(nullptr)), 10);
}
template <class Law>
Compliant<Law> law_of(const Compliant<Law>*) {
  return Compliant<Law>(law_of(static_cast<const Law*>(nullptr)), stiffness);
}
using Law = MOREAU_BENCH_LAW;
using World = Simulation<Polyhedron<>, Law>;

/// The shapes and their radii [m], the same in all programs.
std::vector<Polyhedron<>> shapes_of(std::size_t count) {
  std::mt19937_64 random(1);
  std::vector<double> radii = SizeDistribution::azema2008().sample(count, random);
  std::shuffle(radii.begin(), radii.end(), random);
  std::vector<Polyhedron<>> shapes;
  for (const double radius : radii)
    shapes.push_back(Ballast<Polyhedron<>>::draw(random).scaled(radius));
  return shapes;
}

/// A cube and the poses of the grains in it.
struct Packing {
  double length = 0;  ///< [m]
  std::vector<Pose<S>> poses;
};

Packing make(std::size_t count) {
  const auto shapes = shapes_of(count);
  const int side = int(std::ceil(std::cbrt(double(count)) - 1e-9));
  const double spacing = 0.105;
  SignoriniCoulomb<> smooth(0);
  Simulation<Polyhedron<>, SignoriniCoulomb<>> world(0.05,
                                                     Materials<SignoriniCoulomb<>>(1, smooth));
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t n = std::size_t(side);
    Pose<S> pose;
    pose.position =
        spacing * Vector(double(k % n) + 0.5, double(k / n % n) + 0.5, double(k / n / n) + 0.5);
    pose.rotation = S::exp(3 * S::Angular(normal(random), normal(random), normal(random)));
    world.add_grain(world.add_shape(shapes[k]), pose, density);
  }
  double mass = 0;
  for (const double one : world.bodies().grain_mass) mass += one;
  world.set_cell(spacing * side * Matrix::Identity());
  CellControl<S> control;
  control.rate = -10 * Matrix::Identity();
  world.control_cell(control);
  const auto report = [&](const StepReport& of) {
    std::printf("t = %.4f s: solid fraction %.3f, %zu points, %d sweeps\n", world.time(),
                mass / density / world.cell().volume(), of.points, of.solve.sweeps);
  };
  while (mass / density / world.cell().volume() < 0.5) world.step(2 * step);
  report(world.step(2 * step));
  control = {};
  control.mass = mass * Matrix::Identity();
  control.stress = pressure * Matrix::Identity();
  control.damping = 10;
  world.control_cell(control);
  for (int k = 0; k < 1000; ++k) {
    const StepReport last = world.step(2 * step);
    if (k % 100 == 99) report(last);
  }
  // The cell as a cube of the same volume: a stress on all sides has hardly made it anything else.
  Packing packing;
  packing.length = std::cbrt(world.cell().volume());
  const Matrix map = packing.length * world.cell().vectors().inverse();
  for (const BodyId grain : world.grains()) {
    Pose<S> pose = world.pose(grain);
    pose.position = map * pose.position;
    packing.poses.push_back(pose);
  }
  return packing;
}

void write(const Packing& packing, const std::string& file) {
  std::ofstream out(file);
  out.precision(17);
  out << packing.poses.size() << ' ' << packing.length << '\n';
  for (const Pose<S>& pose : packing.poses)
    out << pose.position.transpose() << ' ' << pose.rotation.coeffs().transpose() << '\n';
}
Packing read(const std::string& file) {
  std::ifstream in(file);
  std::size_t count = 0;
  Packing packing;
  in >> count >> packing.length;
  for (std::size_t k = 0; k < count; ++k) {
    Pose<S> pose;
    for (double& x : pose.position) in >> x;
    for (double& x : pose.rotation.coeffs()) in >> x;
    pose.rotation.normalize();
    packing.poses.push_back(pose);
  }
  if (!in || count == 0) throw std::invalid_argument(file + ": no packing");
  return packing;
}

}  // namespace

extern "C" [[gnu::noinline]] void measured_steps(World& world, int steps, StepReport& sum) {
  for (int k = 0; k < steps; ++k) {
    const StepReport one = world.step(step);
    sum.points += one.points;
    sum.pairs += one.pairs;
    sum.bonds = one.bonds;
    sum.broken_bonds += one.broken_bonds;
    sum.solve.sweeps += one.solve.sweeps;
    sum.solve.residual = one.solve.residual;
    sum.repeated |= one.repeated;
    sum.ms_detect += one.ms_detect, sum.ms_assemble += one.ms_assemble;
    sum.ms_correct += one.ms_correct, sum.ms_contacts += one.ms_contacts;
    sum.ms_total += one.ms_total;
  }
}

namespace {

void measure(const std::string& file, const std::string& cell, bool bonds, int sweeps, int steps) {
  const Packing packing = read(file);
  const auto shapes = shapes_of(packing.poses.size());
  ColouredOptions options;
  if (sweeps > 0) {
    options.tolerance = 1e-12;
    options.max_sweeps = sweeps;
    options.islands = false;
  }
  World world(0.05, Materials<Law>(1, law_of(static_cast<const Law*>(nullptr))),
              ColouredGaussSeidel(options));
  double mass = 0;
  for (std::size_t k = 0; k < shapes.size(); ++k)
    world.add_grain(world.add_shape(shapes[k]), packing.poses[k], density);
  for (const double one : world.bodies().grain_mass) mass += one;
  const double length = packing.length;
  if (cell == "box") {
    for (int axis = 0; axis < 3; ++axis) world.set_periodic(axis, 0, length);
  } else {
    world.set_cell(length * Matrix::Identity());
    CellControl<S> control;
    if (cell != "cell") control.rate(0, 1) = 0.1;
    if (cell == "stress") {
      control.mass(1, 1) = mass;
      control.stress(1, 1) = pressure;
    }
    world.control_cell(control);
  }
  for (const BodyId grain : world.grains()) {
    const double z = world.cell().wrap(world.pose(grain).position)[2];
    const double share = 2 * world.bodies().grain_mass[grain.index()] / mass;
    world.set_force(
        grain, (z > length / 2 ? -1 : 1) * pressure * length * length * share * Vector::UnitZ());
  }
  if constexpr (BondingLaw<Law, S>)
    if (bonds) world.bond_touching(1e-3 * 0.05);
  StepReport warm_up, sum;
  measured_steps(world, 0, warm_up);
  for (int k = 0; k < 5; ++k) warm_up = world.step(step);
  measured_steps(world, steps, sum);
  const double n = steps;
  std::printf(
      "%s %s: %.0f pairs, %.0f points, %zu bonds, %zu broken, %.1f sweeps, residual %.1e, "
      "repeated %d, detect %.2f assemble %.2f correct %.2f contacts %.2f total %.2f ms\n",
      cell.c_str(), bonds ? "bonds" : "none", double(sum.pairs) / n, double(sum.points) / n,
      sum.bonds, sum.broken_bonds, sum.solve.sweeps / n, double(sum.solve.residual),
      int(sum.repeated), sum.ms_detect / n, sum.ms_assemble / n, sum.ms_correct / n,
      sum.ms_contacts / n, sum.ms_total / n);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc >= 3 && std::string(argv[1]) == "make")
      write(make(argc > 3 ? std::stoul(argv[3]) : 1200), argv[2]);
    else if (argc == 6)
      measure(argv[1], argv[2], std::string(argv[3]) == "bonds", std::stoi(argv[4]),
              std::stoi(argv[5]));
    else
      throw std::invalid_argument("arguments: make FILE [GRAINS], or FILE CELL BONDS SWEEPS STEPS");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_bonds_and_cells: %s\n", error.what());
    return 1;
  }
}
