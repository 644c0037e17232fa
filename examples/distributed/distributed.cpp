// SPDX-License-Identifier: MIT
// Grains fall into a box. The program runs in any number of processes:
//
//   mpirun -n 2 distributed [GRAINS [STEPS [FOLDER]]]     500, 1000, distributed-output
//
// A run that is started again goes on from its last snapshot for STEPS more steps, also with another
// number of processes; then the snapshot says how many grains there are.
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <moreau/distributed/distributed_simulation.hpp>
#include <moreau/distributed/write_pieces.hpp>
#include <moreau/io/snapshot.hpp>
#include <moreau/law/compliant.hpp>
#include <moreau/moreau.hpp>
#include <random>

namespace {

// Or moreau::Polygon<double>, moreau::Ball<double>, moreau::Disk<double>:
using Shape = moreau::Polyhedron<double>;
using S = moreau::SpaceOf<Shape>;
using Law = moreau::Compliant<>;
using World = moreau::Simulation<Shape, Law>;
constexpr double size = 0.02, step = 2e-4;  // [m], [s]

/// Cubes with random rotations on a lattice, above the floor of a box.
void build(World& world, std::size_t count) {
  constexpr int up = S::dim - 1;
  const auto wide = std::size_t(std::ceil(std::pow(double(count) / 2, 1.0 / S::dim)));
  const double pitch = 1.8 * size, length = pitch * double(wide);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> angle(-1, 1);
  const moreau::ShapeId shape = world.add_shape(moreau::regular_shape<Shape>(size));
  for (std::size_t k = 0; k < count; ++k) {
    moreau::Pose<S> pose;
    std::size_t rest = k;
    for (int axis = 0; axis < up; ++axis, rest /= wide)
      pose.position[axis] = pitch * (double(rest % wide) + 0.5);
    pose.position[up] = pitch * (double(rest) + 0.5);
    pose.rotation = S::exp(S::Angular::Constant(angle(random)));
    world.add_grain(shape, pose, 2700);
  }
  for (int axis = 0; axis < S::dim; ++axis) {
    const S::Vector normal = S::Vector::Unit(axis);
    world.add_wall(normal, S::Vector::Zero());
    if (axis < up) world.add_wall(-normal, length * normal);
  }
  world.set_gravity(-9.81 * S::Vector::Unit(up));
}

/// Lets `count` grains fall, or goes on from the snapshot in the folder.
void run(moreau::Communicator& all, std::size_t count, int steps,
         const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "packing.snapshot";

  // The same simulation in all processes; its content comes from the first.
  World world(size, moreau::Materials<Law>(1, Law(moreau::SignoriniCoulomb<>(0.5), 1e7)));
  if (all.rank() == 0) {
    std::filesystem::create_directories(folder);
    if (std::filesystem::exists(file))
      moreau::read_snapshot(file, world);
    else
      build(world, count);
  }
  moreau::DistributedSimulation<World> packing(MPI_COMM_WORLD, std::move(world));

  for (int k = 1; k <= steps; ++k) {
    const moreau::StepReport report = packing.step(step);
    if (k % 100 != 0 && k != steps) continue;
    const moreau::DistributionReport own = packing.distribution();
    if (all.rank() == 0)
      std::printf("t = %.2f s: %zu points, %d sweeps, residual %.1e, %zu grains in process 0\n",
                  packing.time(), report.points, report.solve.sweeps, report.solve.residual,
                  own.grains);
    moreau::write_pieces(folder / "packing", packing, step);
    if (const std::optional<World> whole = packing.gather()) moreau::write_snapshot(file, *whole);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const moreau::MpiSession mpi(argc, argv);
  const long count = argc > 1 ? std::strtol(argv[1], nullptr, 10) : 500;
  const int steps = argc > 2 ? std::atoi(argv[2]) : 1000;
  moreau::Communicator all;
  if (count < 1 || steps < 1 || argc > 4) {
    if (all.rank() == 0)
      std::fprintf(stderr,
                   "usage: distributed [GRAINS [STEPS [FOLDER]]], both numbers at least 1\n");
    return 2;
  }
  try {
    run(all, std::size_t(count), steps, argc > 3 ? argv[3] : "distributed-output");
  } catch (const std::exception& error) {
    all.end_all(error.what());
  }
}
