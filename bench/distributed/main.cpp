// SPDX-License-Identifier: MIT
// One packing in 1, 2, .. processes: sweeps, residual, messages and bytes, beside a model of the
// exchange. A packing of N polyhedra under a lid whose force changes by a few percent per step. The
// packing is prepared by one process.
//
//   mpirun -n 2 bench_distributed STEPS TOLERANCE N...
//   mpirun -n 2 bench_distributed 20 1e-4 1200 4800
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "moreau/distributed/distributed_simulation.hpp"
#include "moreau/io/snapshot.hpp"
#include "moreau/moreau.hpp"

#include "packing.hpp"

namespace {

using namespace moreau;
using Law = SignoriniCoulomb<>;
using Shape = Polyhedron<>;
using Packing = bench::Packing<Shape, Law, ColouredGaussSeidel>;
using World = Packing::World;

struct Result {
  double sweeps = 0, milliseconds = 0, worst = 0;  // mean per step, mean per step, largest residual
  int capped = 0;
};

/// Steps a simulation, of one process or of several, with a force on its lid that grows and falls.
template <class Simulation>
Result run(Simulation& world, int steps, double force) {
  Result result;
  const BodyId lid = world.walls().back();
  for (int k = 0; k < steps; ++k) {
    const double load = 1 + 0.05 * std::sin(0.4 * k);
    world.set_force(lid, {0, 0, -load * force});
    const StepReport report = world.step(bench::packing_step);
    result.sweeps += report.solve.sweeps / double(steps);
    result.milliseconds += report.ms_total / steps;
    result.worst = std::max(result.worst, report.solve.residual);
    result.capped += report.solve.capped;
  }
  return result;
}

void print(const char* who, int size, std::size_t grains, const Result& result) {
  std::printf("%-12s %2d  N %6zu  sweeps %6.1f  residual %.1e  capped %d  ms %8.2f\n", who, size,
              grains, result.sweeps, result.worst, result.capped, result.milliseconds);
}

void measure(std::size_t count, int steps, double tolerance) {
  Communicator all;
  ColouredOptions options;
  options.tolerance = tolerance;
  const ColouredGaussSeidel solver(options);
  World world(0.025, Materials<Law>(1, Law(0.5)), solver);
  double force = 0;
  if (all.rank() == 0) {
    const std::string file = "packing_" + std::to_string(count) + ".snapshot";
    if (std::filesystem::exists(file)) {
      read_snapshot(file, world);
    } else {
      Packing packing(count, Law(0.5), ColouredGaussSeidel());
      packing.compress();
      world = packing.world;
      write_snapshot(file, world);
    }
    world.set_solver(solver);
    force = -world.bodies().force[world.walls().back().index()][2];
    World alone = world;
    print("one process", 1, count, run(alone, steps, force));
  }
  force = all.sum(force);
  if (all.size() == 1) return;
  DistributedSimulation<World> packing(MPI_COMM_WORLD, world);
  const Traffic before = packing.traffic();
  const Result result = run(packing, steps, force);
  const Traffic traffic = packing.traffic() - before;
  const DistributionReport own = packing.distribution();
  if (all.rank() == 0) print("processes", all.size(), count, result);
  // The model: a cube of n grains lends the grains of its faces with neighbours, n^(2/3) each; with
  // cuts in turn along the axes, P cubes have 3 (P^(1/3) - 1) P^(2/3) / P inner faces per cube. Each
  // shared copy sends 6 numbers to one other process per sweep.
  const double n = double(count) / all.size(), faces = std::log2(all.size());
  const double in_sweeps = result.sweeps * steps;
  for (int rank = 0; rank < all.size(); ++rank) {
    all.sum(0);
    if (rank != all.rank()) continue;
    std::printf(
        "  rank %d: %zu grains, %zu ghosts, %zu shared (model %.0f); per sweep %.2f messages, "
        "%.2f kB (model %.2f), %.2f operations; %.1f %% of the time in exchange\n",
        rank, own.grains, own.ghosts, own.shared, faces * std::pow(n, 2. / 3),
        double(traffic.messages) / in_sweeps, double(traffic.bytes) / in_sweeps / 1e3,
        48e-3 * faces * std::pow(n, 2. / 3), double(traffic.collectives) / in_sweeps,
        100 * traffic.seconds / (1e-3 * result.milliseconds * steps));
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const moreau::MpiSession mpi(argc, argv);
  if (argc < 4) {
    std::fprintf(stderr, "usage: bench_distributed STEPS TOLERANCE N...\n");
    return 2;
  }
  for (int k = 3; k < argc; ++k)
    measure(std::strtoul(argv[k], nullptr, 10), std::atoi(argv[1]), std::atof(argv[2]));
}
