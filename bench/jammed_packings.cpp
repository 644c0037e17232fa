// SPDX-License-Identifier: MIT
// Packings of N grains under a loaded lid: how many sweeps the contact problem of a step takes to a
// tolerance, and how far the impulses of a step depend on where the solver starts. With compliant
// contacts neither should depend on N. Prints two tables.
//
//   bench_jammed_packings SHAPE K N...     SHAPE is polygon or polyhedron, K the stiffness [N/m],
//                                          rigid for contacts without springs
//   bench_jammed_packings polygon 1e8 300 1200 4800 20000
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "moreau/law/compliant.hpp"
#include "moreau/sample/ballast.hpp"
#include "moreau/sample/random_deposition.hpp"
#include "moreau/sample/size_distribution.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"
#include "moreau/world/simulation.hpp"

namespace {

using namespace moreau;

constexpr double density = 2700, thickness = 0.05;  // of the grains [kg/m^3], in the plane [m]
constexpr double pressure = 1e4, h = 2e-4;          // on the lid [Pa], time step [s]

/// The impulses from which a solve starts.
enum class Start { warm, zero, random };

/// The default solver, or the plain reference solver, from a chosen start.
class StartingSolver : public ColouredGaussSeidel {
 public:
  explicit StartingSolver(double tolerance = 1e-5, Start start = Start::warm, bool plain = false)
      : ColouredGaussSeidel(options_of(tolerance)), start_(start), plain_(plain) {}

  template <class Operator, class Law>
  SolveReport solve(ContactProblem<Operator, Law>& problem,
                    std::span<typename Operator::Vector> impulses,
                    Workspace<Operator, Law>& workspace) const {
    double square = 0;
    for (const auto& r : impulses) square += r.squaredNorm();
    const double size = std::sqrt(square / double(std::max<std::size_t>(1, impulses.size())));
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(-1, 1);
    if (start_ != Start::warm)
      for (auto& r : impulses)
        for (double& x : r) x = start_ == Start::zero ? 0 : size * unit(random);
    if (!plain_) return ColouredGaussSeidel::solve(problem, impulses, workspace);
    GaussSeidelOptions options;
    options.tolerance = this->options().tolerance;
    options.max_sweeps = this->options().max_sweeps;
    return NonlinearGaussSeidel(options).solve(problem, impulses);
  }

 private:
  friend struct moreau::SerializationAccess;
  auto serialized_members() {
    return std::tie(static_cast<ColouredGaussSeidel&>(*this), start_, plain_);
  }
  static ColouredOptions options_of(double tolerance) {
    ColouredOptions options;
    options.tolerance = tolerance;
    options.max_sweeps = 20000;
    return options;
  }

  Start start_;
  bool plain_;
};

template <class ShapeT, class Law>
class Packing {
 public:
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  using World = Simulation<ShapeT, Law, MoreauJean, SweepAndPrune<S>, StartingSolver>;
  static constexpr int up = S::dim - 1;

  Packing(std::size_t count, const Law& law) : world(0.025, Materials<Law>(1, law)) {
    std::mt19937_64 random(1);
    std::vector<ShapeT> shapes;
    std::vector<double> radii;
    double volume = 0;
    for (const double diameter : SizeDistribution::azema2008().sample(count, random)) {
      shapes.push_back(Ballast<ShapeT>::draw(random).scaled(diameter / 2));
      radii.push_back(diameter / 2);
      volume += shapes.back().volume();
    }
    length_ = std::pow(volume / 0.6, 1.0 / S::dim);
    const auto poses = random_deposition<S>(radii, length_, random);
    double top = 0;
    for (std::size_t k = 0; k < count; ++k) {
      world.add_grain(world.add_shape(shapes[k]), poses[k], density * depth());
      top = std::max(top, poses[k].position[up] + radii[k]);
    }
    mass_ = density * depth() * volume;
    for (int axis = 0; axis < S::dim; ++axis) world.add_wall(Vector::Unit(axis), Vector::Zero());
    for (int axis = 0; axis < up; ++axis)
      world.add_wall(-Vector::Unit(axis), length_ * Vector::Unit(axis));
    lid_ = world.add_wall(-Vector::Unit(up), top * Vector::Unit(up));
    world.set_gravity(-9.81 * Vector::Unit(up));
  }

  /// Lowers the lid until the grains carry its force, and lets them come to rest under the force.
  void compress() {
    world.set_solver(StartingSolver(1e-4));
    world.set_velocity(lid_, -1.0 * Vector::Unit(up));
    double reaction = 0;
    while (reaction < force()) {
      world.step(h);
      reaction += 0.05 * (world.contact_impulse(lid_)[up] / h - reaction);
    }
    world.set_velocity(lid_, Vector::Zero());
    world.set_wall_mass(lid_, mass_);
    load(1);
    for (int k = 0; k < 1500; ++k) world.step(h);
  }
  /// Sets the force on the lid, relative to that of the pressure.
  void load(double share) { world.set_force(lid_, -share * force() * Vector::Unit(up)); }

  World world;

 private:
  static constexpr double depth() { return std::is_same_v<S, Space<2>> ? thickness : 1; }
  double force() const { return pressure * depth() * std::pow(length_, up); }

  double length_ = 0, mass_ = 0;
  BodyId lid_;
};

/// Prints the mean and the largest number of sweeps over 40 steps, in which the force on the lid falls
/// by 0.5 % per step.
template <class P>
void print_sweeps(const P& packing, std::size_t count) {
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    P copy = packing;
    copy.world.set_solver(StartingSolver(tolerance));
    double sweeps = 0, points = 0, ms = 0;
    int most = 0, capped = 0;
    constexpr int steps = 40;
    for (int k = 0; k < steps; ++k) {
      copy.load(1 - 0.2 * k / steps);
      const StepReport report = copy.world.step(h);
      sweeps += report.solve.sweeps;
      points += double(report.points);
      ms += report.ms_solve;
      most = std::max(most, report.solve.sweeps);
      capped += report.solve.capped;
    }
    std::printf("| %zu | %.0f | %.0e | %.0f | %d | %d | %.1f | %.0f |\n", count, points / steps,
                tolerance, sweeps / steps, most, capped, ms / steps,
                1e6 * ms / sweeps / (points / steps));
    std::fflush(stdout);
  }
}

/// The impulses of one step, solved from a start.
template <class P>
auto impulses(const P& packing, const StartingSolver& solver, SolveReport& report) {
  P copy = packing;
  copy.load(0.99);
  copy.world.set_solver(solver);
  report = copy.world.step(h).solve;
  return copy.world.contacts().impulses;
}

template <class Impulses>
double difference(const Impulses& one, const Impulses& other) {
  double square = 0, norm = 0;
  for (std::size_t c = 0; c < one.size(); ++c) {
    square += (one[c] - other[c]).squaredNorm();
    norm += other[c].squaredNorm();
  }
  return std::sqrt(square / norm);
}

template <class P>
void print_differences(const P& packing, std::size_t count) {
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    SolveReport warm, zero, random, plain;
    const auto reference = impulses(packing, StartingSolver(tolerance), warm);
    const auto from_zero = impulses(packing, StartingSolver(tolerance, Start::zero), zero);
    const auto from_random = impulses(packing, StartingSolver(tolerance, Start::random), random);
    const auto by_plain = impulses(packing, StartingSolver(tolerance, Start::zero, true), plain);
    const bool solved = warm.converged && zero.converged && random.converged && plain.converged;
    std::printf("| %zu | %.0e | %.1e | %.1e | %.1e | %s |\n", count, tolerance,
                difference(from_zero, reference), difference(from_random, reference),
                difference(by_plain, reference), solved ? "all" : "not all");
    std::fflush(stdout);
  }
}

template <class ShapeT, class Law>
void print_tables(const Law& law, const std::vector<std::size_t>& counts) {
  std::vector<Packing<ShapeT, Law>> packings;
  std::printf(
      "| N | points | tolerance | sweeps | most | capped | solve [ms] | per point and sweep [ns] "
      "|\n|---|---|---|---|---|---|---|---|\n");
  for (const std::size_t count : counts) {
    packings.emplace_back(count, law);
    packings.back().compress();
    print_sweeps(packings.back(), count);
  }
  std::printf(
      "\nRelative difference of the impulses of a step from those of a warm start\n\n"
      "| N | tolerance | from zero | from random impulses | plain sweeps from zero | solved "
      "|\n|---|---|---|---|---|---|\n");
  for (std::size_t k = 0; k < counts.size(); ++k)
    if (counts[k] <= 5000) print_differences(packings[k], counts[k]);
}

template <class ShapeT>
void run(const std::string& stiffness, const std::vector<std::size_t>& counts) {
  const SignoriniCoulomb<> coulomb(0.4);
  if (stiffness == "rigid")
    print_tables<ShapeT>(coulomb, counts);
  else
    print_tables<ShapeT>(Compliant<>(coulomb, std::stod(stiffness)), counts);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: %s polygon|polyhedron K|rigid N...\n", argv[0]);
    return 2;
  }
  std::vector<std::size_t> counts;
  for (int k = 3; k < argc; ++k) counts.push_back(std::stoul(argv[k]));
  if (std::string(argv[1]) == "polygon")
    run<Polygon<double>>(argv[2], counts);
  else
    run<Polyhedron<double>>(argv[2], counts);
}
