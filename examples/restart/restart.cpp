// SPDX-License-Identifier: MIT
// A run that continues from its last snapshot after it was stopped. Its table then has the same
// bytes as the table of a run that was not stopped. Disks with random radii fall into a shaken box.
// Writes into restart-output/.
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <moreau/moreau.hpp>
#include <random>
#include <string>

#include "moreau/boundary/drive.hpp"
#include "moreau/io/csv.hpp"
#include "moreau/io/snapshot.hpp"

namespace fs = std::filesystem;
using Disk = moreau::Disk<double>;
using Law = moreau::SignoriniCoulomb<double>;
using Simulation = moreau::Simulation<Disk, Law>;
using Vector = Simulation::Vector;

namespace setup {
constexpr double size = 0.01, width = 0.1, h = 5e-4;  // of a grain; of the box [m]; step [s]
constexpr int steps = 3000, snapshot_every = 500, grain_every = 100;
}  // namespace setup
using namespace setup;

void build(Simulation& simulation) {
  simulation.add_wall({0, 1}, {0, 0});
  simulation.add_wall({1, 0}, {0, 0});
  simulation.add_wall({-1, 0}, {width, 0});
  simulation.set_gravity({0, -9.81});
}

/// Adds a disk with a random radius at a random position at the top of the box.
void rain(Simulation& simulation, std::mt19937_64& random) {
  std::uniform_real_distribution<double> radius(0.4 * size, 0.6 * size), place(size, width - size);
  const moreau::ShapeId disk = simulation.add_shape(Disk(radius(random)));
  const moreau::Pose<Simulation::S> pose{{place(random), width}, Simulation::S::identity()};
  simulation.add_grain(disk, pose, 2500);
}

/// Mean height of the grains [m].
double mean_height(const Simulation& simulation) {
  double sum = 0;
  for (const moreau::BodyId grain : simulation.grains()) sum += simulation.pose(grain).position[1];
  return sum / double(simulation.grain_count());
}

/// Runs up to step `end`: from the last snapshot in the folder, or from the beginning without one.
void run(const fs::path& folder, int end) {
  fs::create_directories(folder);
  const fs::path snapshot = folder / "run.snapshot";
  Simulation simulation(size, moreau::Materials<Law>(1, Law(0.4)));
  std::mt19937_64 random(1);
  int step = 0;
  std::uintmax_t table_size = 0;
  if (fs::exists(snapshot))
    moreau::read_snapshot(snapshot, simulation, random, step, table_size);
  else
    build(simulation);

  moreau::CsvWriter table(folder / "run.csv", {{"t", "s"}, "grains", {"height", "m"}}, 10,
                          table_size);
  // A snapshot holds no functions. Create them again; they read the time from the simulation.
  const moreau::VelocityDrive shake(simulation.walls()[0], Vector::UnitY(),
                                    [](double t) { return 0.02 * std::sin(60 * t); });
  for (; step < end; ++step) {
    if (step % snapshot_every == 0) {
      table.sync();
      moreau::write_snapshot(snapshot, simulation, random, step, table.size());
    }
    if (step % grain_every == 0) rain(simulation, random);
    shake.apply(simulation, h);
    simulation.step(h);
    table.row(simulation.time(), simulation.grain_count(), mean_height(simulation));
  }
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

int main() {
  fs::remove_all("restart-output");
  run("restart-output/whole", steps);
  run("restart-output/stopped", 1700);   // stops 200 steps after its last snapshot
  run("restart-output/stopped", steps);  // continues from step 1500
  const bool same =
      bytes_of("restart-output/whole/run.csv") == bytes_of("restart-output/stopped/run.csv");
  std::cout << (same ? "both tables have the same bytes\n" : "the tables differ\n");
  return same ? 0 : 1;
}
