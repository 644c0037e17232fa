// SPDX-License-Identifier: MIT
// The box with its walls and grains, the preparation by the lid, and a step under the harmonic
// force. The first axis, x, points outward through the moving wall; the last axis points up.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "moreau/io/snapshot.hpp"
#include "moreau/measure/energy.hpp"
#include "moreau/parallel/thread_team.hpp"
#include "moreau/sample/random_deposition.hpp"
#include "moreau/world/simulation.hpp"

#include "methods.hpp"
#include "parameters.hpp"
#include "sample.hpp"

namespace ratcheting {

/// A progress callback throws it to stop the preparation. Everything written so far is complete.
struct Interrupted {};

/// @tparam ShapeT of the grains
/// @tparam Method law, integrator and solver
template <class ShapeT, class Method>
class Experiment {
 public:
  using Shape = ShapeT;
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  using Law = typename Method::Law;
  using Solver = typename Method::Solver;
  using Simulation = moreau::Simulation<ShapeT, Law, typename Method::Integrator,
                                        moreau::SweepAndPrune<S>, Solver>;
  static constexpr int up = S::dim - 1;
  static constexpr bool solves = Method::solves;
  /// Called after every step of the preparation with the stage's name; may throw Interrupted.
  using Progress = std::function<void(const char* stage, const moreau::StepReport&)>;

  /// @param thickness of a grain out of the plane [m]; 1 in space
  Experiment(const Parameters& p, double thickness)
      : parameters_(p), random_(p.seed), simulation_(make_simulation(p)) {
    simulation_.set_team(moreau::ThreadTeam(p.threads));
    const Grains<ShapeT> grains = make_grains<ShapeT>(p, random_);
    volume_ = grains.volume;
    thickness_ = thickness;
    mass_ = p.density * thickness * volume_;
    length_ = p.box_length > 0 ? p.box_length : length_from_volume();
    width_ = p.width_ratio * length_;
    std::array<double, std::size_t(up)> floor;
    for (int k = 0; k < up; ++k) floor[std::size_t(k)] = extent(k);
    const auto poses = moreau::random_deposition<S>(grains.circumradii, floor, random_);
    double top = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const auto shape = simulation_.add_shape(grains.shapes[i]);
      simulation_.add_grain(shape, poses[i], p.density * thickness);
      top = std::max(top, poses[i].position[up] + grains.circumradii[i]);
    }
    add_walls(top);
  }

  /// First half of the paper's preparation: compression by the lid without gravity.
  /// 1. The lid moves down at constant speed, so slowly that contacts are detected in time, until
  ///    the grains react with the lid force.
  /// 2. The lid force acts until the kinetic energy per grain is below 1e-6 of lid force times
  ///    grain size, for preparation_time at most.
  /// The solver makes at most preparation_sweeps sweeps in a step, because the packing needs no
  /// converged history.
  void compress(const Progress& progress) {
    const double step = parameters_.preparation_step;
    if constexpr (Method::solves) {
      moreau::ColouredOptions options;
      options.tolerance = parameters_.preparation_tolerance;
      options.stop_test = moreau::StopTest::qm16;
      options.max_sweeps = parameters_.preparation_sweeps;
      options.islands = false;
      simulation_.set_solver(Solver(options));
    }
    const double force = parameters_.lid_force * mass_ * 9.81;
    const double size = simulation_.grain_size();
    const double speed = 0.4 * parameters_.margin * size / std::max(step, slowest_step);
    const Vector up_axis = Vector::Unit(up);
    simulation_.set_velocity(lid_, -speed * up_axis);
    double reaction = 0;
    while (reaction < force) {
      if (simulation_.pose(lid_).position[up] < size)
        throw std::runtime_error(
            "the lid reached the floor without meeting its force: the sample "
            "is too small for its box");
      progress("closing", simulation_.step(step));
      const double now = simulation_.contact_impulse(lid_)[up] / step;
      reaction += 0.05 * (now - reaction);
    }
    simulation_.set_velocity(lid_, Vector::Zero());
    simulation_.set_wall_mass(lid_, mass_);
    simulation_.set_force(lid_, -force * up_axis);
    const double still = 1e-6 * force * size * double(simulation_.grain_count());
    const double begin = simulation_.time();
    settled_ = false;
    for (int k = 0; !settled_ && simulation_.time() - begin < parameters_.preparation_time; ++k) {
      progress("compressing", simulation_.step(step));
      settled_ = k >= 20 && kinetic_energy() <= still;
    }
  }

  /// Second half of the preparation: sets the solver of the experiment, switches on gravity, raises
  /// and fixes the lid, and frees the wall.
  void release() {
    if constexpr (Method::solves) {
      simulation_.set_solver(study_solver(parameters_));
      set_correction();
    }
    if (parameters_.order != 0) reorder();
    fix_lid();
  }

  /// Raises and fixes the lid, switches on gravity, and gives the wall its mass.
  void fix_lid() {
    simulation_.set_wall_mass(lid_, std::numeric_limits<double>::infinity());
    simulation_.set_velocity(lid_, Vector::Zero());
    simulation_.set_force(lid_, Vector::Zero());
    auto pose = simulation_.pose(lid_);
    pose.position[up] += parameters_.lid_raise;
    simulation_.set_pose(lid_, pose);
    height_ = pose.position[up];
    set_weights();
    start_ = simulation_.time();
  }

  /// One step under f at the middle of the step.
  moreau::StepReport vibrate() {
    if constexpr (Method::solves) change_stiffness();
    if (parameters_.wall_speed > 0 && time() > parameters_.begin() + parameters_.hold) {
      simulation_.set_wall_mass(wall_, std::numeric_limits<double>::infinity());
      simulation_.set_velocity(wall_, parameters_.wall_speed * Vector::UnitX());
      return simulation_.step(parameters_.step);
    }
    const double f = parameters_.force(time() + parameters_.step / 2);
    simulation_.set_force(wall_, -f * Vector::UnitX());
    return simulation_.step(parameters_.step);
  }

  /// Writes the packing that compress() made.
  void write_packing(const std::filesystem::path& path, const std::string& made_by) const {
    moreau::write_snapshot(path, simulation_, made_by, settled_);
  }
  /// Reads such a packing, in place of compress(). The parameters of the preparation must be the
  /// same.
  /// @throws std::runtime_error naming the path if the file is not such a packing
  void read_packing(const std::filesystem::path& path, std::string& made_by) {
    moreau::reload_snapshot(path, simulation_, made_by, settled_);
  }

  /// Writes the state of the experiment and more members of the run.
  template <class... More>
  void write_checkpoint(const std::filesystem::path& path, const More&... more) const {
    moreau::write_snapshot(path, simulation_, start_, height_, wall_mass_, settled_, old_stiffness_,
                           more...);
  }
  /// Reads such a checkpoint, in place of compress() and release(). The parameters must be the
  /// same.
  /// @throws std::runtime_error naming the path if the file is not such a checkpoint
  template <class... More>
  void read_checkpoint(const std::filesystem::path& path, More&... more) {
    moreau::reload_snapshot(path, simulation_, start_, height_, wall_mass_, settled_,
                            old_stiffness_, more...);
  }

  /// Makes the state that read_checkpoint() read the start of a run with other laws, solver, force,
  /// gravity, mass of the wall and step, `hold` before a maximum of its force. The stiffness changes gradually over the first
  /// half of the hold, because the overlaps are those of the old stiffness.
  /// @param stiffness of the run that made the checkpoint [N/m]
  void start_again(double stiffness) requires solves {
    old_stiffness_ = stiffness;
    simulation_.set_solver(study_solver(parameters_));
    set_correction();
    set_weights();
    start_ = simulation_.time() - parameters_.begin();
  }

  /// Gives grains and walls the positions and velocities of an experiment of the same sample with
  /// another law, in place of compress() and release().
  template <class Other>
  void place_as(const Other& other) {
    const auto& from = other.simulation();
    for (std::size_t k = 0; k < simulation_.grain_count(); ++k) {
      const auto grain = simulation_.grain(k);
      const auto& velocity = from.bodies().velocity[from.grain(k).index()];
      simulation_.set_pose(grain, from.pose(from.grain(k)));
      simulation_.set_velocity(grain, velocity.template head<S::dim>());
      simulation_.set_spin(grain, velocity.template tail<S::angular_dim>());
    }
    simulation_.set_pose(wall_, from.pose(other.wall()));
    simulation_.set_velocity(wall_, from.velocity(other.wall()));
    auto lid = simulation_.pose(lid_);
    lid.position[up] = height_ = other.height();
    simulation_.set_pose(lid_, lid);
    settled_ = other.settled();
  }

  double time() const { return simulation_.time() - start_; }  ///< since f started [s]
  /// Displacement of the wall, outward positive [m].
  double displacement() const { return simulation_.pose(wall_).position[0] - length_; }
  double wall_velocity() const { return simulation_.velocity(wall_)[0]; }
  /// Force of the grains on the wall over the last step, outward positive [N].
  double wall_force() const { return simulation_.contact_impulse(wall_)[0] / parameters_.step; }
  /// Kinetic energy of the grains [J].
  double kinetic_energy() const { return moreau::kinetic_energy(simulation_).total(); }

  const Simulation& simulation() const { return simulation_; }
  /// Displacement of the wall by the overlap correction in the last step, outward positive [m].
  double corrected_displacement() const {
    if constexpr (Method::solves) {
      const auto shifts = simulation_.correction().shifts();
      return shifts.empty() ? 0 : shifts[wall_.index()][0];
    } else {
      return 0;
    }
  }
  /// Whether the preparation ended because the grains were at rest, not because its time was over.
  bool settled() const { return settled_; }
  double mass() const { return mass_; }
  double wall_mass() const { return wall_mass_; }
  double volume() const { return volume_; }
  double length() const { return length_; }
  double width() const { return width_; }  ///< in the plane as in space
  double height() const { return height_; }
  double thickness() const { return thickness_; }
  moreau::BodyId wall() const { return wall_; }
  /// The box with the moving wall at its present position.
  moreau::Aabb<S> box() const {
    moreau::Aabb<S> box;
    box.lower.setZero();
    for (int k = 0; k < up; ++k) box.upper[k] = extent(k);
    box.upper[0] += displacement();
    box.upper[up] = height_;
    return box;
  }

 private:
  /// The speed of the lid in the preparation is that of steps of at least this length [s].
  static constexpr double slowest_step = 2e-4;

  /// Sets gravity and the mass of the wall.
  void set_weights() {
    simulation_.set_gravity(-parameters_.gravity * Vector::Unit(up));
    wall_mass_ = parameters_.wall_mass_ratio * mass_;
    simulation_.set_wall_mass(wall_, wall_mass_);
  }
  /// Sets the stiffness of this time in the hold of a run from a checkpoint.
  void change_stiffness() {
    if (old_stiffness_ == 0) return;
    const double passed = (time() - parameters_.begin()) / (parameters_.hold / 2);
    Parameters now = parameters_;
    if (passed < 1)
      now.stiffness = old_stiffness_ * std::pow(parameters_.stiffness / old_stiffness_, passed);
    else
      old_stiffness_ = 0;
    simulation_.set_materials(materials(now));
  }

  static Solver study_solver(const Parameters& p) requires solves {
    moreau::ColouredOptions options;
    options.tolerance = p.tolerance;
    options.stop_test = p.stop_test;
    options.max_sweeps = p.max_sweeps;
    options.cold_sweeps = p.cold_sweeps;
    options.islands = false;  // all grains are one packing, and the paper has no such method
    return Solver(options, p.cold_start, p.solver == "plain");
  }
  void set_correction() requires solves {
    moreau::OverlapCorrectionOptions correction;
    correction.enabled = parameters_.correction;
    simulation_.set_correction(correction);
  }
  /// Materials: 0 grains, 1 horizontal walls, 2 vertical walls.
  static moreau::Materials<Law> materials(const Parameters& p) {
    moreau::Materials<Law> laws(3, Method::law(p, p.friction));
    laws.set(moreau::MaterialId(0), moreau::MaterialId(2), Method::law(p, 0));
    return laws;
  }
  static Simulation make_simulation(const Parameters& p) {
    const moreau::Materials<Law> laws = materials(p);
    moreau::Tolerances tolerances;
    tolerances.margin = p.margin;
    const double size = p.size_scale * moreau::SizeDistribution::azema2008().smallest();
    Simulation simulation = [&] {
      if constexpr (Method::solves)
        return Simulation(size, laws, study_solver(p), tolerances);
      else
        return Simulation(size, laws, tolerances);
    }();
    // The rule of the paper: a contact between faces has three points, in the plane two. Springs
    // in series with the contacts need all points.
    if constexpr (!moreau::CompliantLaw<Law, S>)
      simulation.set_contact_points(moreau::ContactPoints::few);
    return simulation;
  }

  /// Length of the box along a horizontal axis at displacement 0 [m].
  double extent(int axis) const { return axis == 0 ? length_ : width_; }

  /// L from V = rho L^D H/L W/L, where rho is the solid fraction after the compression: about 0.53
  /// in space and 0.80 in the plane for angular grains. An error of rho only changes H/L.
  double length_from_volume() const {
    constexpr double packed[] = {0.80, 0.53};
    const double ratios = parameters_.box_ratio * parameters_.width_ratio;
    return std::pow(volume_ / (packed[S::dim - 2] * ratios), 1.0 / S::dim);
  }

  /// Makes a new simulation with the same packing, with the grains in another order and the walls
  /// at rest.
  void reorder() {
    const Simulation old = std::move(simulation_);
    simulation_ = make_simulation(parameters_);
    std::vector<std::size_t> order(old.grain_count());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::mt19937_64 random(parameters_.order);
    std::shuffle(order.begin(), order.end(), random);
    const auto& bodies = old.bodies();
    for (const std::size_t k : order) {
      const std::size_t i = old.grain(k).index();
      const auto shape = simulation_.add_shape(old.shape_of_grain(k));
      const auto grain =
          simulation_.add_grain(shape, bodies.pose[i], parameters_.density * thickness_);
      simulation_.set_velocity(grain, bodies.velocity[i].template head<S::dim>());
      simulation_.set_spin(grain, bodies.velocity[i].template tail<S::angular_dim>());
    }
    add_walls(bodies.pose[lid_.index()].position[up]);
    if constexpr (Method::solves) set_correction();
  }

  void add_walls(double top) {
    const moreau::MaterialId horizontal(1), vertical(2);
    for (int axis = 0; axis < up; ++axis) {
      if (axis > 0 && parameters_.side_walls == "periodic") {
        simulation_.set_periodic(axis, 0, extent(axis));
        continue;
      }
      const bool rough = axis > 0 && parameters_.side_walls == "frictional";
      const auto material = rough ? horizontal : vertical;
      const Vector n = Vector::Unit(axis);
      simulation_.add_wall(n, Vector::Zero(), material);
      const auto far = simulation_.add_wall(-n, extent(axis) * n, material);
      if (axis == 0) wall_ = far;
    }
    const Vector n = Vector::Unit(up);
    simulation_.add_wall(n, Vector::Zero(), horizontal);
    lid_ = simulation_.add_wall(-n, top * n, horizontal);
  }

  Parameters parameters_;
  std::mt19937_64 random_;
  Simulation simulation_;
  double volume_ = 0, thickness_ = 1, mass_ = 0, wall_mass_ = 0, length_ = 0, width_ = 0,
         height_ = 0;
  double start_ = 0;
  double old_stiffness_ = 0;  // that still changes to the stiffness of the run; 0: none [N/m]
  bool settled_ = false;
  moreau::BodyId wall_, lid_;
};

}  // namespace ratcheting
