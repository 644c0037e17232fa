// SPDX-License-Identifier: MIT
// measure() runs a scene and prints its times.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <numeric>
#include <vector>

#include "moreau/parallel/thread_team.hpp"

#include "exchange.hpp"

namespace scenes {

/// The columns of the table.
inline void print_header() {
  std::printf(
      "| scene | grains | scalar, order, points, threads | residual asked for | pairs | points | "
      "placing | broad phase | "
      "pairs' contacts | assembly | overlap correction | solver | rest | step, median and mean "
      "[ms] | CPU time of a step, mean [ms] | "
      "detection [us/pair] | after detection [us/point] | sweeps | ns per point and sweep | "
      "residual, largest | "
      "largest overlap / grain size | cold points [%%] |\n|");
  for (int k = 0; k < 22; ++k) std::printf("---|");
  std::printf("\n");
}

/// Values of all measured steps.
class Series {
 public:
  void add(double value) { values_.push_back(value); }
  double mean() const {
    return std::accumulate(values_.begin(), values_.end(), 0.0) / double(values_.size());
  }
  double largest() const { return *std::max_element(values_.begin(), values_.end()); }
  double median() const {
    std::vector<double> sorted = values_;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }

 private:
  std::vector<double> values_;
};

/// What is measured in every step.
struct Record {
  Series place, broad, collide, assemble, correct, solver, rest, total, detect, after;
  Series pairs, points, sweeps, residual, overlap, cold, cpu;

  /// @param cpu_time of the step, of all threads [ms]
  void add(const StepReport& report, double grain_size, double cpu_time) {
    cpu.add(cpu_time);
    const double shown = report.ms_place + report.ms_pairs + report.ms_collide +
                         report.ms_assemble + report.ms_correct + report.ms_contacts;
    place.add(report.ms_place), broad.add(report.ms_pairs), collide.add(report.ms_collide);
    assemble.add(report.ms_assemble), correct.add(report.ms_correct);
    solver.add(report.ms_contacts), rest.add(report.ms_total - shown), total.add(report.ms_total);
    detect.add(report.ms_detect), after.add(report.ms_solve);
    const double count = std::max(1.0, double(report.points));
    pairs.add(double(report.pairs)), points.add(double(report.points));
    sweeps.add(report.solve.sweeps), residual.add(double(report.solve.residual));
    overlap.add(report.max_overlap / grain_size);
    cold.add(100 * (count - double(report.warm_started)) / count);
  }
  void print(const Options& options, std::size_t grains) const {
    std::printf("| %s | %zu | %s, %s, %s, %d | %.0e | %.0f | %.0f |", options.scene.c_str(), grains,
                options.scalar.c_str(), options.order.c_str(), options.points.c_str(),
                options.threads, options.solver.tolerance, pairs.mean(), points.mean());
    for (const Series* stage : {&place, &broad, &collide, &assemble, &correct, &solver, &rest})
      std::printf(" %.3f |", stage->mean());
    std::printf(" %.2f, %.2f | %.3f | %.3f | %.3f |", total.median(), total.mean(), cpu.mean(),
                1e3 * detect.mean() / std::max(1.0, pairs.mean()),
                1e3 * after.mean() / std::max(1.0, points.mean()));
    std::printf(" %.1f | %.1f | %.1e | %.1e | %.2f |\n", sweeps.mean(),
                1e6 * solver.mean() / std::max(1.0, points.mean() * sweeps.mean()),
                residual.largest(), overlap.largest(), cold.mean());
  }
};

/// Brings a scene into its state, from the file if there is one, and measures its steps.
template <class ShapeT>
void measure(Scene<ShapeT> scene, const Options& options) {
  auto& world = *scene.world;
  if (!options.write.empty()) return describe(scene, options.write);
  if (!options.check.empty()) return print_overlaps(scene, options.check);
  world.set_contact_points(options.points == "few" ? ContactPoints::few : ContactPoints::all);
  world.set_team(ThreadTeam(options.threads));
  const StateFile<typename Scene<ShapeT>::World> state(options.state);
  const bool known = !options.state.empty() && state.read(world);
  if (!known) {
    if (scene.prepare) scene.prepare(world);
    if (scene.begin) scene.begin(world);
    const int settle = options.settle >= 0 ? options.settle : scene.settle;
    for (int k = 0; k < settle; ++k) {
      if (scene.drive) scene.drive(world, 0);
      world.step(scene.step);
    }
    if (!options.state.empty()) state.write(world);
  } else if (scene.begin) {
    scene.begin(world);
  }
  // The first steps after a state from a file are without a warm start, and a team learns in its first steps.
  constexpr int warm_up = 30;
  const bool moves = scene.settle == 0;  // what is measured is the motion from the start
  for (int k = 0; k < warm_up && !moves; ++k) {
    if (scene.drive) scene.drive(world, 0);
    world.step(scene.step);
  }
  Record record;
  const int steps = options.steps > 0 ? options.steps : scene.steps;
  const int frames = 4;
  PosesFile<typename Scene<ShapeT>::World> poses(options.poses);
  for (int k = 0; k < steps; ++k) {
    if (scene.drive) scene.drive(world, k * double(scene.step));
    const std::clock_t start = std::clock();
    const StepReport report = world.step(scene.step);
    record.add(report, double(world.grain_size()),
               1e3 * double(std::clock() - start) / CLOCKS_PER_SEC);
    if ((k + 1) % std::max(1, steps / frames) == 0) poses.write(world);
  }
  record.print(options, world.grain_count());
}

}  // namespace scenes
