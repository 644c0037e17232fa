// SPDX-License-Identifier: MIT
// Time per grain and step, stage by stage, and memory per grain, over the number of grains and of
// threads. A periodic tile of 1200 grains under a loaded lid is prepared once, stored in the folder,
// and repeated side by side: all packings have the same contacts per grain. Every step takes the
// same number of sweeps. scaling.sh runs it and plots the table.
//
//   bench_scaling SHAPE TILES THREADS [ORDER [SWEEPS [FOLDER]]]
//
//   SHAPE   polyhedron, sphere, polygon or disk
//   TILES   number of tiles of 1200 grains, e.g. 1, 9, 81
//   THREADS most threads; blocks of steps on 1, 2, .. threads take turns
//   ORDER   of the grains in memory: curve (default) or random
//   SWEEPS  per step, default 40
//
// Prints a line of scaling.csv for each number of threads. The last column is how much faster two loops
// of arithmetic are on the threads than one after the other: without free cores the times of several
// threads say nothing.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

#include "moreau/moreau.hpp"
#include "moreau/parallel/thread_team.hpp"

#include "tiles.hpp"

namespace {

using namespace moreau;
using Law = SignoriniCoulomb<>;

constexpr std::size_t tile_size = 1200;

struct Arguments {
  std::string shape;
  int tiles, threads;
  std::string order = "curve";
  int sweeps = 40;
  std::filesystem::path folder = ".";
};

/// Seconds that a loop of arithmetic takes on each of some threads at once.
double spin(int threads) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<std::thread> others;
  const auto work = [] {
    double x = 1;
    for (int k = 0; k < 20'000'000; ++k) x = x * 0.999999 + 1e-9;
    volatile double kept = x;
    (void)kept;
  };
  for (int k = 1; k < threads; ++k) others.emplace_back(work);
  work();
  for (auto& thread : others) thread.join();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Resident memory of the process [bytes].
double memory() {
  std::ifstream file("/proc/self/statm");
  double all = 0, resident = 0;
  file >> all >> resident;
  return resident * double(sysconf(_SC_PAGESIZE));
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

/// The stages of a step, as scaling.csv names them.
constexpr std::array<const char*, 8> stages{"place",   "pairs",    "collide", "assemble",
                                            "correct", "contacts", "rest",    "total"};
std::array<double, 8> times_of(const StepReport& report) {
  const double rest = report.ms_solve - report.ms_assemble - report.ms_correct - report.ms_contacts;
  return {report.ms_place,
          report.ms_pairs,
          report.ms_collide,
          report.ms_assemble,
          report.ms_correct,
          report.ms_contacts,
          rest,
          report.ms_total};
}

ColouredGaussSeidel fixed_sweeps(int sweeps) {
  ColouredOptions options;
  options.tolerance = 1e-12;  // never met
  options.max_sweeps = options.check_interval = sweeps;
  return ColouredGaussSeidel(options);
}
ColouredGaussSeidel to_residual(double tolerance) {
  ColouredOptions options;
  options.tolerance = tolerance;
  return ColouredGaussSeidel(options);
}

/// A nearly square arrangement of this many tiles.
template <class S>
std::array<int, std::size_t{S::dim}> arrangement(int tiles) {
  std::array<int, std::size_t{S::dim}> counts;
  counts.fill(1);
  counts[0] = tiles;
  if (S::dim == 3) {
    int side = static_cast<int>(std::sqrt(double(tiles)));
    while (tiles % side != 0) --side;
    counts = {};
    counts.fill(1);
    counts[0] = tiles / side;
    counts[1] = side;
  }
  return counts;
}

template <class ShapeT>
void run(const Arguments& given) {
  using Tiles = bench::Tiles<ShapeT, Law, ColouredGaussSeidel>;
  using S = typename Tiles::S;
  const Law law(0.4);
  const double before = memory();
  const Tiles tile(tile_size, law, to_residual(1e-3), given.folder / (given.shape + ".tile"));
  const double tile_memory = memory() - before;
  Tiles packing(tile, arrangement<S>(given.tiles),
                {given.order == "random" ? bench::Order::random : bench::Order::curve}, law,
                fixed_sweeps(given.sweeps));
  const auto grains = double(packing.world.grain_count());
  packing.world.set_team(ThreadTeam(given.threads));
  const bool is_small = given.tiles < 4;
  packing.settle(is_small ? 30 : 10);
  const double bytes = (memory() - before - tile_memory) / grains;

  std::vector<Team> teams;
  for (int threads = 1; threads <= given.threads; ++threads) teams.push_back(ThreadTeam(threads));
  std::vector<std::array<std::vector<double>, stages.size()>> times(teams.size());
  const int rounds = is_small ? 12 : 4, steps = is_small ? 8 : 3;
  constexpr int trial = 20;  // steps in which a team learns what is faster
  double points = 0, free = 0;
  int done = 0;
  for (int round = 0; round < rounds; ++round) {
    free += spin(1) * double(given.threads) / spin(given.threads) / rounds;
    for (std::size_t t = 0; t < teams.size(); ++t) {
      packing.world.set_team(teams[t]);
      for (int k = 0; k < (round == 0 ? trial : steps); ++k) {
        packing.load(1 + 0.05 * std::sin(0.3 * done++));
        const StepReport report = packing.world.step(Tiles::step);
        points += double(report.points);
        if (round == 0) continue;
        const auto all = times_of(report);
        for (std::size_t s = 0; s < stages.size(); ++s) times[t][s].push_back(all[s]);
      }
    }
  }
  // A broad phase in every step, as in a flow.
  std::vector<double> broad;
  packing.world.set_team(teams[0]);
  const auto& cell = packing.world.cell();
  for (int k = 0; k < 3; ++k) {
    packing.world.set_periodic(0, cell.lower()[0], cell.lower()[0] + cell.length()[0]);
    broad.push_back(packing.world.step(Tiles::step).ms_pairs);
  }
  // Sweeps that a tolerance takes.
  packing.world.set_solver(to_residual(1e-3));
  double sweeps = 0;
  for (int k = 0; k < 3; ++k) {
    packing.load(1 + 0.05 * std::sin(0.3 * done++));
    sweeps += packing.world.step(Tiles::step).solve.sweeps / 3.0;
  }

  for (std::size_t t = 0; t < times.size(); ++t) {
    std::printf("%s,%s,%.0f,%.2f,%d,%zu", given.shape.c_str(), given.order.c_str(), grains,
                points / done / grains, given.sweeps, t + 1);
    for (const auto& stage : times[t]) std::printf(",%.3f", 1e3 * median(stage) / grains);
    std::printf(",%.3f,%.0f,%.0f,%.2f\n", 1e3 * median(broad) / grains, bytes, sweeps, free);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::printf("shape,order,grains,points per grain,sweeps,threads");
    for (const char* stage : stages) std::printf(",%s [us]", stage);
    std::printf(",broad phase [us],bytes per grain,sweeps to 1e-3,cores free\n");
    return argc == 1 ? 0 : 2;
  }
  Arguments given{argv[1], std::stoi(argv[2]), std::stoi(argv[3])};
  if (argc > 4) given.order = argv[4];
  if (argc > 5) given.sweeps = std::stoi(argv[5]);
  if (argc > 6) given.folder = argv[6];
  if (given.shape == "polyhedron")
    run<Polyhedron<double>>(given);
  else if (given.shape == "sphere")
    run<Ball<double>>(given);
  else if (given.shape == "polygon")
    run<Polygon<double>>(given);
  else if (given.shape == "disk")
    run<Disk<double>>(given);
  else
    return 2;
}
