// SPDX-License-Identifier: MIT
// The experiment: grains rest on a slope behind a gate at its foot. The gate opens, the grains flow
// onto a horizontal floor, and come to rest in front of a barrier. In space the width is periodic.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <moreau/moreau.hpp>
#include <numbers>
#include <random>
#include <tuple>
#include <vector>

#include "moreau/parallel/thread_team.hpp"
#include "moreau/sample/ballast.hpp"
#include "moreau/sample/random_deposition.hpp"
#include "moreau/sample/size_distribution.hpp"
#include "moreau/sample/spatial_order.hpp"

namespace avalanche {

constexpr double size = 0.02;                             // diameter of the smallest grain [m]
constexpr double gravity = 9.81, density = 2500;          // [m/s^2], [kg/m^3]
constexpr double friction = 0.4, incline = 36;            // [-], [degrees]
constexpr double margin = 0.1;                            // margin / size [-]
constexpr std::size_t shape_count = 300;                  // the grains share this many shapes
constexpr double settle_speed = 0.05, rest_speed = 0.02;  // mean speeds / sqrt(gravity size) [-]

/// What the state of a run consists of beside the simulation. It goes into the snapshot.
struct Progress {
  std::uint64_t step = 0;
  std::uint64_t opened_at = 0;      ///< step at which the gate opened; 0: it is closed
  std::uint64_t unsolved = 0;       ///< steps in which the solver did not reach its tolerance
  double length = 0;                ///< of the deposit along the slope [m]
  double h = 0;                     ///< time step [s]
  double mean_speed = 0;            ///< of the grains [m/s]
  double front = 0;                 ///< 98 % of the grains have a smaller x [m]
  std::vector<std::uint8_t> layer;  ///< one per grain: its layer in the first deposit, 0 .. 7
};

template <class Shape>
class Avalanche {
 public:
  using S = moreau::SpaceOf<Shape>;
  using Vector = typename S::Vector;
  using Law = moreau::SignoriniCoulomb<double>;
  using Simulation = moreau::Simulation<Shape, Law>;
  static constexpr int up = S::dim - 1;

  explicit Avalanche(int threads)
      : simulation(size, moreau::Materials<Law>(1, Law(friction)), solver(), tolerances()) {
    simulation.set_team(moreau::ThreadTeam(threads));
  }

  /// Adds walls and grains.
  void build(std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const std::vector<double> diameters{size, 1.25 * size, 1.5 * size};
    std::vector<moreau::ShapeId> shapes;
    std::vector<double> radius_of_shape, volume_of_shape;
    for (std::size_t k = 0; k < shape_count; ++k) {
      const double radius = diameters[k % diameters.size()] / 2;
      const Shape shape = moreau::Ballast<Shape>::draw(random).scaled(radius);
      shapes.push_back(simulation.add_shape(shape));
      radius_of_shape.push_back(radius);
      volume_of_shape.push_back(shape.volume());
    }
    std::uniform_int_distribution<std::size_t> any(0, shape_count - 1);
    std::vector<std::size_t> shape_of;
    std::vector<double> radii;
    double volume = 0;
    for (std::size_t k = 0; k < count; ++k) {
      shape_of.push_back(any(random));
      radii.push_back(radius_of_shape[shape_of.back()]);
      volume += volume_of_shape[shape_of.back()];
    }
    // A square floor; about half as high as long in space, as high as long in the plane.
    progress.length = std::pow((up == 1 ? 1.3 : 3.6) * volume, 1.0 / S::dim);
    // 0.15 of the smallest grain per step at the speed (g L)^(1/2), which few grains exceed.
    progress.h = 0.15 * size / std::sqrt(gravity * progress.length);
    add_walls();
    const auto poses = moreau::random_deposition<S>(radii, progress.length, random);
    double top = 0;
    std::vector<Vector> centers;
    for (const auto& pose : poses) {
      top = std::max(top, pose.position[up]);
      centers.push_back(pose.position);
    }
    for (const std::size_t k : moreau::spatial_order<S>(centers)) {
      moreau::Pose<S> pose = poses[k];
      pose.position = on_slope(centers[k]);
      simulation.add_grain(shapes[shape_of[k]], pose, density);
      progress.layer.push_back(std::uint8_t(std::min(7.0, 8 * centers[k][up] / top)));
    }
    simulation.set_gravity(-gravity * Vector::Unit(up));
  }

  /// One step; opens the gate once the grains are at rest behind it.
  moreau::StepReport step() {
    const moreau::StepReport report = simulation.step(progress.h);
    ++progress.step;
    progress.unsolved += !report.solve.converged;
    if (progress.step % 10 == 0) {
      measure();
      if (progress.opened_at == 0 && time() > fall_time() && is_slower(settle_speed)) open();
    }
    return report;
  }
  /// Whether the gate is open and the grains are at rest.
  bool is_at_rest() const {
    return progress.opened_at > 0 && is_slower(rest_speed) &&
           double(progress.step - progress.opened_at) * progress.h > 2 * fall_time();
  }
  double time() const { return simulation.time(); }  ///< [s]
  /// Longest time of the flow after the gate opens [s]; grains that roll never come to rest.
  double longest_flow() const { return 4 * fall_time(); }

  Simulation simulation;
  Progress progress;

 private:
  static moreau::ColouredGaussSeidel solver() {
    moreau::ColouredOptions options;
    options.tolerance = 1e-3;
    options.max_sweeps = 500;
    return moreau::ColouredGaussSeidel(options);
  }
  static moreau::Tolerances tolerances() {
    moreau::Tolerances tolerances;
    tolerances.margin = margin;
    tolerances.skin = 0.1;
    return tolerances;
  }

  static double angle() { return incline * std::numbers::pi / 180; }
  /// Unit vectors up the slope and out of it.
  static Vector uphill() {
    return -std::cos(angle()) * Vector::UnitX() + std::sin(angle()) * Vector::Unit(up);
  }
  static Vector out_of_slope() {
    return std::sin(angle()) * Vector::UnitX() + std::cos(angle()) * Vector::Unit(up);
  }
  /// A point given by its distance from the gate, along the width, and its height above the slope.
  static Vector on_slope(const Vector& x) {
    Vector point = x;
    point[0] = point[up] = 0;
    return point + x[0] * uphill() + x[up] * out_of_slope();
  }
  void add_walls() {
    const double length = progress.length;
    simulation.add_wall(Vector::Unit(up), Vector::Zero());
    simulation.add_wall(out_of_slope(), Vector::Zero());
    simulation.add_wall(-uphill(), length * uphill());
    simulation.add_wall(uphill(), Vector::Zero());                          // the gate
    simulation.add_wall(-Vector::UnitX(), 1.5 * length * Vector::UnitX());  // the barrier
    for (int axis = 1; axis < up; ++axis) simulation.set_periodic(axis, 0, length);
  }
  void open() {
    const moreau::BodyId gate = simulation.walls()[3];
    moreau::Pose<S> pose = simulation.pose(gate);
    pose.position -= 1000 * progress.length * uphill();
    simulation.set_pose(gate, pose);
    progress.opened_at = progress.step;
  }
  double fall_time() const { return std::sqrt(progress.length / gravity); }
  bool is_slower(double speed) const {
    return progress.mean_speed < speed * std::sqrt(gravity * size);
  }
  void measure() {
    double sum = 0;
    x_.clear();
    for (const moreau::BodyId grain : simulation.grains()) {
      sum += simulation.velocity(grain).norm();
      x_.push_back(simulation.pose(grain).position[0]);
    }
    const auto last = x_.begin() + std::ptrdiff_t(0.98 * double(x_.size()));
    std::nth_element(x_.begin(), last, x_.end());
    progress.front = *last;
    progress.mean_speed = sum / double(x_.size());
  }

  std::vector<double> x_;
};

}  // namespace avalanche
