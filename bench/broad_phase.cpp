// SPDX-License-Identifier: MIT
// Time of the broad phases per body: boxes of one size, and boxes of sizes 1 : 20 mixed, in a
// region of their total volume. The boxes are created from a fixed seed outside the timed loop.
#include <benchmark/benchmark.h>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "moreau/detect/broad/all_pairs.hpp"
#include "moreau/detect/broad/cell_grid.hpp"
#include "moreau/detect/broad/sweep_and_prune.hpp"

namespace {

using namespace moreau;

/// Boxes with sizes between 1 / ratio and 1: the total volume is equal in equal intervals of
/// log(size). Together they fill the region.
template <class S>
std::vector<Aabb<S>> random_boxes(std::size_t count, double ratio) {
  using T = typename S::Scalar;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> sizes(count);
  double volume = 0;
  for (double& size : sizes) {
    // Density of sizes ~ size^-(D+1).
    const double u = uniform(random);
    size = std::pow(std::pow(ratio, S::dim) * u + 1 - u, -1.0 / S::dim);
    volume += std::pow(size, S::dim);
  }
  const double span = std::pow(volume, 1.0 / S::dim);
  std::vector<Aabb<S>> boxes(count);
  for (std::size_t i = 0; i < count; ++i)
    for (Eigen::Index k = 0; k < S::dim; ++k) {
      boxes[i].lower[k] = static_cast<T>(span * uniform(random));
      boxes[i].upper[k] = boxes[i].lower[k] + static_cast<T>(sizes[i]);
    }
  return boxes;
}

template <class S, class BroadPhaseT>
void run(benchmark::State& state, double ratio) {
  const auto boxes = random_boxes<S>(static_cast<std::size_t>(state.range(0)), ratio);
  BroadPhaseT broad_phase;
  std::vector<IndexPair> pairs;
  for ([[maybe_unused]] auto _ : state) {
    broad_phase.find_pairs(boxes, pairs);
    benchmark::DoNotOptimize(pairs.data());
  }
  const auto bodies = static_cast<double>(boxes.size());
  state.counters["pairs_per_body"] = static_cast<double>(pairs.size()) / bodies;
  state.counters["per_body"] = benchmark::Counter(
      bodies, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <class S, class BroadPhaseT>
void add(const std::string& name, std::int64_t most) {
  for (const double ratio : {1.0, 20.0}) {
    auto* entry = benchmark::RegisterBenchmark(
        (name + (ratio == 1.0 ? "/equal" : "/1_to_20")).c_str(),
        [ratio](benchmark::State& state) { run<S, BroadPhaseT>(state, ratio); });
    for (const std::int64_t count : {100, 1000, 10000, 100000})
      if (count <= most) entry->Arg(count);
  }
}

template <class S>
void add_all(const std::string& space) {
  add<S, AllPairs<S>>(space + "/all_pairs", 1000);
  add<S, SweepAndPrune<S>>(space + "/sweep_and_prune", 10000);
  add<S, CellGrid<S>>(space + "/cell_grid", 100000);
}

}  // namespace

int main(int argc, char** argv) {
  add_all<Space<2>>("plane");
  add_all<Space<3>>("space");
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
