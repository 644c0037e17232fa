// SPDX-License-Identifier: MIT
// Packings of N grains under a loaded lid: how many sweeps the contact problem of a step takes to a
// tolerance, and how far the impulses of a step depend on where the solver starts. With compliant
// contacts neither should depend on N. Prints two tables.
//
//   bench_jammed_packings SHAPE K N...     SHAPE is polygon or polyhedron, K the stiffness [N/m],
//                                          rigid for contacts without springs
//   bench_jammed_packings polygon 1e8 300 1200 4800 20000
//
// A packing of more than 5000 grains is made of 4 tiles in the plane, 8 in space: copies of a
// periodic packing, of which 2 % of the grains are taken out at random. They come to rest for 1.09 s
// (before, they still move and take more sweeps: polygons 1.3 to 1.6 times as many after 0.19 s,
// polyhedra 1.8 times as many after 0.69 s).
// The tile and the packing are stored in files (jammed-*): a program that was stopped continues.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
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

#include "packing.hpp"
#include "tiles.hpp"

namespace {

using namespace moreau;

constexpr double h = bench::packing_step;

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
using Packing = bench::Packing<ShapeT, Law, StartingSolver>;
template <class ShapeT, class Law>
using Tiles = bench::Tiles<ShapeT, Law, StartingSolver>;

/// Packings of more grains are made of tiles.
constexpr std::size_t most_at_once = 5000;

/// A packing of tiles at rest.
template <class ShapeT, class Law>
Tiles<ShapeT, Law> large_packing(const std::string& name, const Law& law, std::size_t count) {
  constexpr int dim = SpaceOf<ShapeT>::dim;
  const StartingSolver solver(1e-4);
  const std::string stem = "jammed-" + name + "-" + std::to_string(count);
  const Tiles<ShapeT, Law> tile(count >> dim, law, solver, stem + ".tile");
  std::array<int, std::size_t{dim}> counts;
  counts.fill(2);
  Tiles<ShapeT, Law> packing(tile, counts, {bench::Order::curve, 0.02}, law, solver);
  // Large steps first. Stored every 50 steps.
  const std::string file = stem + ".packing";
  int done = 0;
  if (std::filesystem::exists(file)) reload_snapshot(file, packing.world, done);
  while (done < 5000) {
    packing.settle(50, done < 300 ? 5e-4 : h);
    done += 50;
    write_snapshot(file, packing.world, done);
  }
  return packing;
}

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
void print_tables(const std::string& name, const Law& law, const std::vector<std::size_t>& counts) {
  std::vector<Packing<ShapeT, Law>> packings;
  std::printf(
      "| N | points | tolerance | sweeps | most | capped | solve [ms] | per point and sweep [ns] "
      "|\n|---|---|---|---|---|---|---|---|\n");
  for (const std::size_t count : counts) {
    if (count > most_at_once) {
      const auto packing = large_packing<ShapeT>(name, law, count);
      print_sweeps(packing, packing.world.grain_count());
      continue;
    }
    packings.emplace_back(count, law, StartingSolver(1e-4));
    packings.back().compress();
    print_sweeps(packings.back(), count);
  }
  std::printf(
      "\nRelative difference of the impulses of a step from those of a warm start\n\n"
      "| N | tolerance | from zero | from random impulses | plain sweeps from zero | solved "
      "|\n|---|---|---|---|---|---|\n");
  for (const auto& packing : packings) print_differences(packing, packing.world.grain_count());
}

template <class ShapeT>
void run(const std::string& name, const std::string& stiffness,
         const std::vector<std::size_t>& counts) {
  const SignoriniCoulomb<> coulomb(0.4);
  if (stiffness == "rigid")
    print_tables<ShapeT>(name + "-rigid", coulomb, counts);
  else
    print_tables<ShapeT>(name + "-" + stiffness, Compliant<>(coulomb, std::stod(stiffness)),
                         counts);
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
    run<Polygon<double>>(argv[1], argv[2], counts);
  else
    run<Polyhedron<double>>(argv[1], argv[2], counts);
}
