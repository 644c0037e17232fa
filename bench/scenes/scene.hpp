// SPDX-License-Identifier: MIT
// A scene is a simulation with what happens to it in time; measure() runs it and prints its times.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "moreau/moreau.hpp"
#include "moreau/parallel/thread_team.hpp"
#include "moreau/sample/spatial_order.hpp"

namespace scenes {

using namespace moreau;

/// What the user asks for; 0 or an empty string: as the scene has it.
struct Options {
  std::string scene;
  std::string scalar = "double", points = "all", order = "added", state;
  double tolerance = 1e-3;  ///< of the residual
  double margin = 0;        ///< relative to the grain size
  int size = 0, threads = 1, settle = -1, steps = 0;
  bool narrows = true;  ///< Tolerances::narrows
  bool islands = true;  ///< ColouredOptions::islands
};

/// A simulation and its time loop. Grains are numbered in the order in which they were added.
template <class ShapeT>
struct Scene {
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Law = SignoriniCoulomb<Scalar>;
  using World = Simulation<ShapeT, Law>;
  using Vector = typename S::Vector;

  std::unique_ptr<World> world;
  Scalar step;                               ///< [s]
  int settle, steps;                         ///< before the measurement, and of it
  std::function<void(World&)> prepare = {};  ///< makes the state from which the settling begins
  std::function<void(World&)> begin = {};    ///< after prepare(), or after the state of a file
  /// Sets forces before a measured step, at the time since the measurement began [s].
  std::function<void(World&, double)> drive = {};
};

/// The grains of a scene, to be added in the order that the user asks for.
template <class ShapeT>
struct Grains {
  using S = SpaceOf<ShapeT>;
  std::vector<ShapeT> shapes;  ///< one per grain
  std::vector<Pose<S>> poses;

  void add_to(auto& world, typename S::Scalar density, const Options& options) const {
    std::vector<std::size_t> order(poses.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (options.order == "random") {
      std::mt19937_64 random(3);
      std::shuffle(order.begin(), order.end(), random);
    } else if (options.order == "curve") {
      std::vector<typename S::Vector> points;
      for (const auto& pose : poses) points.push_back(pose.position);
      order = spatial_order<S>(points);
    }
    for (const std::size_t k : order)
      world.add_grain(world.add_shape(shapes[k]), poses[k], density);
  }
};

/// The tolerances of a scene: the defaults, but for the margin and `narrows`.
/// @param margin of the scene, relative to the grain size
inline Tolerances tolerances(double margin, const Options& options) {
  Tolerances tolerances;
  tolerances.margin = options.margin > 0 ? options.margin : margin;
  tolerances.narrows = options.narrows;
  return tolerances;
}
inline ColouredGaussSeidel solver(const Options& options) {
  ColouredOptions coloured;
  coloured.tolerance = options.tolerance;
  coloured.islands = options.islands;
  return ColouredGaussSeidel(coloured);
}

/// Poses and velocities of all bodies in a file that every version of the library can read. The
/// impulses of the contacts are not in it: the first steps after it need more sweeps.
template <class World>
class StateFile {
 public:
  using S = typename World::S;
  explicit StateFile(const std::filesystem::path& path) : path_(path) {}

  void write(const World& world) const {
    std::ofstream file(path_);
    file.precision(17);
    for (std::size_t i = 0; i < world.bodies().size(); ++i) {
      const Pose<S>& pose = world.bodies().pose[i];
      file << pose.position.transpose() << ' ' << coordinates(pose.rotation).transpose() << ' '
           << world.bodies().velocity[i].transpose() << '\n';
    }
    if (!file) throw std::runtime_error("cannot write " + path_.string());
  }
  /// @returns whether the file exists
  bool read(World& world) const {
    std::ifstream file(path_);
    if (!file) return false;
    world.allow_overlaps();
    for (std::size_t i = 0; i < world.bodies().size(); ++i) {
      const BodyId body = world.bodies().id[i];
      Pose<S> pose;
      typename S::Twist velocity;
      auto rotation = coordinates(pose.rotation);
      for (auto& x : pose.position) file >> x;
      for (auto& x : rotation) file >> x;
      for (auto& x : velocity) file >> x;
      pose.rotation = rotation_of(S{}, rotation);
      world.set_pose(body, pose);
      if (!world.bodies().is_prescribed(i) || !velocity.isZero(0)) {
        world.set_velocity(body, typename S::Vector(velocity.template head<S::dim>()));
        world.set_spin(body, typename S::Angular(velocity.template tail<S::dofs - S::dim>()));
      }
    }
    if (!file) throw std::runtime_error(path_.string() + " is not of this scene");
    return true;
  }

 private:
  template <class T>
  static Eigen::Matrix<T, 1, 1> coordinates(const Eigen::Rotation2D<T>& rotation) {
    return Eigen::Matrix<T, 1, 1>(rotation.angle());
  }
  template <class T>
  static Eigen::Matrix<T, 4, 1> coordinates(const Eigen::Quaternion<T>& rotation) {
    return rotation.coeffs();
  }
  template <class T>
  static Eigen::Rotation2D<T> rotation_of(Space<2, T>, const Eigen::Matrix<T, 1, 1>& x) {
    return Eigen::Rotation2D<T>(x[0]);
  }
  template <class T>
  static Eigen::Quaternion<T> rotation_of(Space<3, T>, const Eigen::Matrix<T, 4, 1>& x) {
    return Eigen::Quaternion<T>(x).normalized();
  }

  std::filesystem::path path_;
};

/// The columns of the table.
inline void print_header() {
  std::printf(
      "| scene | grains | scalar, order, points, threads | residual asked for | pairs | points | "
      "placing | broad phase | "
      "pairs' contacts | assembly | overlap correction | solver | rest | step, median and mean "
      "[ms] | "
      "detection [us/pair] | after detection [us/point] | sweeps | ns per point and sweep | "
      "residual, largest | "
      "largest overlap / grain size | cold points [%%] |\n|");
  for (int k = 0; k < 21; ++k) std::printf("---|");
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
  Series pairs, points, sweeps, residual, overlap, cold;

  void add(const StepReport& report, double grain_size) {
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
                options.threads, options.tolerance, pairs.mean(), points.mean());
    for (const Series* stage : {&place, &broad, &collide, &assemble, &correct, &solver, &rest})
      std::printf(" %.3f |", stage->mean());
    std::printf(" %.2f, %.2f | %.3f | %.3f |", total.median(), total.mean(),
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
  for (int k = 0; k < steps; ++k) {
    if (scene.drive) scene.drive(world, k * double(scene.step));
    record.add(world.step(scene.step), double(world.grain_size()));
  }
  record.print(options, world.grain_count());
}

/// Runs the scene that the options name, if there is one of these shapes.
/// @returns whether there was
bool run_polyhedra(const Options& options);
bool run_polyhedra_float(const Options& options);
bool run_polygons(const Options& options);
bool run_polygons_float(const Options& options);
bool run_compounds(const Options& options);

}  // namespace scenes
