// SPDX-License-Identifier: MIT
// One packing in 1, 2, .. processes: sweeps, residual, messages and bytes, beside a model of the
// exchange. A packing of N polyhedra under a lid whose force changes by a few percent per step. The
// packing is prepared by one process.
//
//   mpirun -n 2 bench_distributed LAW STEPS TOLERANCE N SIDE...    SIDE x SIDE packings of N grains each
//   mpirun -n 2 bench_distributed rigid 20 1e-4 1200 1 2 4
//
// LAW is rigid, or compliant with k = 1e8 N/m.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "moreau/distributed/distributed_simulation.hpp"
#include "moreau/io/snapshot.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/measure/solid_fraction.hpp"
#include "moreau/measure/stress.hpp"
#include "moreau/moreau.hpp"
#include "moreau/parallel/thread_team.hpp"

#include "packing.hpp"

namespace {

using namespace moreau;
using Shape = Polyhedron<>;
template <class Law>
using WorldOf = typename bench::Packing<Shape, Law, ColouredGaussSeidel>::World;

template <class Law>
Law law();
template <>
SignoriniCoulomb<> law() {
  return SignoriniCoulomb<>(0.5);
}
template <>
Compliant<> law() {
  return Compliant<>(SignoriniCoulomb<>(0.5), 1e8);
}

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

/// Prints where the lid is, and the solid fraction and vertical stress within 0.8 times its lengths.
template <class World>
void print_state(const World& world) {
  using S = typename World::S;
  const double length = world.pose(world.walls()[3]).position[0];
  const double height = world.pose(world.walls().back()).position[2];
  const Aabb<S> inner({0.1 * length, 0.1 * length, 0.1 * height},
                      {0.9 * length, 0.9 * length, 0.9 * height});
  const double fraction = solid_fraction(world, inner);
  const auto stress = contact_stress(world, bench::packing_step, inner);
  std::printf("  lid at %.8f m, solid fraction %.7f, vertical stress %.2f Pa\n", height, fraction,
              stress(2, 2));
}

/// A packing of `count` grains at rest under a lid; read from a file if there is one.
template <class Law>
WorldOf<Law> packed(std::size_t count) {
  constexpr bool rigid = std::is_same_v<Law, SignoriniCoulomb<>>;
  const std::string file =
      (rigid ? "packing_" : "compliant_packing_") + std::to_string(count) + ".snapshot";
  WorldOf<Law> world(0.025, Materials<Law>(1, law<Law>()), ColouredGaussSeidel());
  if (std::filesystem::exists(file)) {
    read_snapshot(file, world);
  } else {
    bench::Packing<Shape, Law, ColouredGaussSeidel> packing(count, law<Law>(),
                                                            ColouredGaussSeidel());
    packing.compress();
    world = packing.world;
    write_snapshot(file, world);
  }
  return world;
}

/// side x side copies of a packing beside each other under one lid, after some steps.
template <class World>
World tiled(const World& tile, int side) {
  if (side == 1) return tile;
  World world(0.025, tile.materials(), ColouredGaussSeidel());
  world.set_contact_points(tile.contact_points());
  const BodyId lid = tile.walls().back();
  const double length = tile.pose(tile.walls()[3]).position[0];
  std::vector<ShapeId> shapes;
  for (std::size_t k = 0; k < tile.grain_count(); ++k)
    shapes.push_back(world.add_shape(tile.shape_of_grain(k)));
  for (int copy = 0; copy < side * side; ++copy)
    for (std::size_t k = 0; k < tile.grain_count(); ++k) {
      Pose<Space<3>> pose = tile.pose(tile.grain(k));
      pose.position += length * Space<3>::Vector(copy % side, copy / side, 0);
      world.add_grain(shapes[k], pose, 2700);
    }
  for (int axis = 0; axis < 3; ++axis)
    world.add_wall(Space<3>::Vector::Unit(axis), Space<3>::Vector::Zero());
  for (int axis = 0; axis < 2; ++axis)
    world.add_wall(-Space<3>::Vector::Unit(axis), side * length * Space<3>::Vector::Unit(axis));
  const BodyId wide = world.add_wall(-Space<3>::Vector::UnitZ(), tile.pose(lid).position);
  world.set_wall_mass(wide, side * side / tile.bodies().inverse_mass[lid.index()][0]);
  world.set_force(wide, side * side * linear<Space<3>>(tile.bodies().force[lid.index()]));
  world.set_gravity(tile.gravity());
  for (int k = 0; k < 20; ++k) world.step(bench::packing_step);
  return world;
}

template <class Law>
void measure(std::size_t count, int side, int steps, double tolerance) {
  using World = WorldOf<Law>;
  Communicator all;
  ColouredOptions options;
  options.tolerance = tolerance;
  const ColouredGaussSeidel solver(options);
  World world(0.025, Materials<Law>(1, law<Law>()), solver);
  double force = 0;
  if (all.rank() == 0) {
    world = tiled(packed<Law>(count), side);
    world.set_solver(solver);
    force = -world.bodies().force[world.walls().back().index()][2];
    World alone = world;
    print("one process", 1, alone.grain_count(), run(alone, steps, force));
    print_state(alone);
    if (const int threads = all.size(); threads > 1) {
      World shared = world;
      shared.set_team(ThreadTeam(threads));
      print("threads", threads, shared.grain_count(), run(shared, steps, force));
    }
  }
  force = all.sum(force);
  if (all.size() == 1) return;
  const auto grains = std::size_t(all.sum(double(world.grain_count())));
  DistributedSimulation<World> packing(MPI_COMM_WORLD, std::move(world));
  const Traffic before = packing.traffic();
  const Result result = run(packing, steps, force);
  const Traffic traffic = packing.traffic() - before;
  const DistributionReport own = packing.distribution();
  const auto whole = packing.gather();
  if (all.rank() == 0) {
    print("processes", all.size(), grains, result);
    print_state(*whole);
  }
  // The model: cuts in turn along the axes give each process about log2 P faces with a neighbour. A
  // cube of n grains has n^(2/3) grains at each of them. Both sides send 6 numbers for each grain that
  // is shared across a face, once per sweep.
  const double n = double(grains) / all.size();
  const double shared = std::log2(all.size()) * std::pow(n, 2. / 3);
  const double sweeps = result.sweeps * steps;
  for (int rank = 0; rank < all.size(); ++rank) {
    all.sum(0);
    if (rank != all.rank()) continue;
    std::printf(
        "  rank %d: %zu grains, %zu ghosts, %zu shared (model %.0f); per sweep %.2f messages, "
        "%.2f kB (model %.2f), %.2f operations; %.1f %% of the time in exchange\n",
        rank, own.grains, own.ghosts, own.shared, shared, double(traffic.messages) / sweeps,
        double(traffic.bytes) / sweeps / 1e3, 48e-3 * shared, double(traffic.collectives) / sweeps,
        100 * traffic.seconds / (1e-3 * result.milliseconds * steps));
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const moreau::MpiSession mpi(argc, argv);
  const std::string law = argc > 1 ? argv[1] : "";
  if (argc < 6 || (law != "rigid" && law != "compliant")) {
    std::fprintf(stderr, "usage: bench_distributed rigid|compliant STEPS TOLERANCE N SIDE...\n");
    return 2;
  }
  for (int k = 5; k < argc; ++k)
    (law == "rigid" ? measure<moreau::SignoriniCoulomb<>>
                    : measure<moreau::Compliant<>>)(std::strtoul(argv[4], nullptr, 10),
                                                    std::atoi(argv[k]), std::atoi(argv[2]),
                                                    std::atof(argv[3]));
}
