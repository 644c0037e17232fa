// SPDX-License-Identifier: MIT
// The time of a step on 1, 2, .. threads: packings of N grains under a lid whose force changes by a
// few percent per step, to residual 1e-3. Blocks of steps with each number of threads take turns, so
// that a busy machine disturbs all alike. Prints medians, and how much faster two loops on two
// threads are than one after the other: without two free cores the times say nothing.
//
//   bench_scaling SHAPE THREADS N...     SHAPE is polygon or polyhedron
//   bench_scaling polyhedron 2 1200 4800
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "moreau/core/thread_team.hpp"
#include "moreau/moreau.hpp"

#include "packing.hpp"

namespace {

using namespace moreau;

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

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

struct Times {
  std::vector<double> total, detect, solve;  // of the steps [ms]
};

template <class ShapeT>
void run(int most, std::size_t count) {
  ColouredOptions options;
  options.tolerance = 1e-3;
  using Law = SignoriniCoulomb<>;
  bench::Packing<ShapeT, Law, ColouredGaussSeidel> packing(count, Law(0.4),
                                                           ColouredGaussSeidel(options));
  packing.world.set_team(ThreadTeam(most));
  packing.compress();
  std::vector<Team> teams;
  for (int threads = 1; threads <= most; ++threads) teams.push_back(ThreadTeam(threads));
  std::vector<Times> times(teams.size());
  constexpr int rounds = 20, steps = 10;
  double points = 0, sweeps = 0, free = 0;
  int done = 0;
  for (int round = 0; round < rounds; ++round) {
    free += spin(1) / spin(most) / rounds;
    for (std::size_t t = 0; t < teams.size(); ++t) {
      packing.world.set_team(teams[t]);
      for (int k = 0; k < steps; ++k) {
        packing.load(1 + 0.5 * std::sin(0.1 * done++));
        const StepReport report = packing.world.step(bench::packing_step);
        points += double(report.points);
        sweeps += report.solve.sweeps;
        if (round == 0) continue;  // the team learns what is faster
        times[t].total.push_back(report.ms_total);
        times[t].detect.push_back(report.ms_detect);
        times[t].solve.push_back(report.ms_solve);
      }
    }
  }
  const double alone = median(times[0].total);
  for (std::size_t t = 0; t < times.size(); ++t)
    std::printf("| %zu | %.0f | %.0f | %zu | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f |\n", count,
                points / done, sweeps / done, t + 1, median(times[t].total),
                median(times[t].detect), median(times[t].solve), alone / median(times[t].total),
                median(times[0].detect) / median(times[t].detect), free);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: %s polygon|polyhedron THREADS N...\n", argv[0]);
    return 2;
  }
  const std::string shape = argv[1];
  const int threads = std::stoi(argv[2]);
  std::printf(
      "| N | points | sweeps | threads | step [ms] | detection | solve | faster | detection faster "
      "| "
      "cores free |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (int k = 3; k < argc; ++k) {
    const std::size_t count = std::stoul(argv[k]);
    if (shape == "polygon")
      run<Polygon<double>>(threads, count);
    else if (shape == "polyhedron")
      run<Polyhedron<double>>(threads, count);
    else {
      std::fprintf(stderr, "%s: no such shape\n", shape.c_str());
      return 2;
    }
  }
}
