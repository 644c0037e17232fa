// SPDX-License-Identifier: MIT
// A scene: grains and walls with settings that can be changed while it runs. AnyScene is what the page
// and the native program see; Scene<Shape> is the common part of the scenes of box.hpp, column.hpp,
// drum.hpp and arch.hpp, for each shape.
//
// The contacts are compliant (moreau/law/compliant.hpp): an error of a step is felt as a force in the
// next, so that a step can be ended after a few hundred sweeps and a packing under load still does not
// drift. That suits a picture that must not wait.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "moreau/law/compliant.hpp"
#include "moreau/measure/check.hpp"
#include "moreau/measure/energy.hpp"
#include "moreau/measure/force_chains.hpp"
#include "moreau/moreau.hpp"
#include "moreau/sample/ballast.hpp"
#include "moreau/sample/compound_ballast.hpp"
#include "moreau/sample/random_rotation.hpp"
#include "moreau/sample/size_distribution.hpp"

#include "settings.hpp"
#include "view.hpp"

namespace testbed {

/// A scene of any shape.
class AnyScene {
 public:
  virtual ~AnyScene() = default;

  /// Advances by Settings::step and adds a row to samples().
  /// @throws std::invalid_argument, std::runtime_error as Simulation::step()
  virtual void step() = 0;
  /// Takes other settings for the next step. Those that begin the scene anew have no effect.
  /// @throws std::invalid_argument naming function, argument and value; the scene is then unchanged
  virtual void apply(const Settings& settings) = 0;
  virtual void act() = 0;          ///< what the button of the scene does
  virtual void write_frame() = 0;  ///< fills frame() and status()
  /// Pulls a grain towards a point of the page, from now on until release().
  virtual void pull(std::size_t grain, const std::array<double, 3>& target) = 0;
  virtual void release() = 0;

  const std::vector<Mesh>& meshes() const { return meshes_; }
  const std::vector<Placement>& placements() const { return placements_; }  ///< of each grain
  const std::vector<Channel>& channels() const { return channels_; }
  const std::vector<PlotSpec>& plots() const { return plots_; }
  const std::array<double, 6>& bounds() const {
    return bounds_;
  }  ///< of the picture: lower, upper [m]
  const Frame& frame() const { return frame_; }
  const Status& status() const { return status_; }
  /// Rows of channels(), one per step, since clear_samples().
  const std::vector<double>& samples() const { return samples_; }
  void clear_samples() { samples_.clear(); }

 protected:
  std::vector<Mesh> meshes_;
  std::vector<Placement> placements_;
  std::vector<Channel> channels_;
  std::vector<PlotSpec> plots_;
  std::array<double, 6> bounds_{};
  Frame frame_;
  Status status_;
  std::vector<double> samples_;
};

/// @tparam ShapeT of the grains
template <class ShapeT>
class Scene : public AnyScene {
 public:
  using Shape = ShapeT;
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  using Law = moreau::Compliant<moreau::SignoriniCoulomb<double>>;
  using Simulation = moreau::Simulation<ShapeT, Law>;
  static constexpr int up = S::dim - 1;
  /// The grains of the plane are plates of this thickness [m]. Forces and masses are then of the
  /// magnitude of those in space.
  static constexpr double thickness = up == 1 ? 0.04 : 1;
  static constexpr double wall_thickness = up == 1 ? 0.004 : 0.0005;  ///< in the picture [m]
  static constexpr double density = 2700 * thickness;                 ///< [kg/m^D]

  void step() final {
    pull_grain();
    drive();
    const moreau::StepReport report = simulation_.step(settings_.step);
    status_.capped += report.solve.capped;
    last_ = report, last_step_ = settings_.step;
    record(report);
  }
  void apply(const Settings& settings) final {
    require_whole(settings);
    const moreau::Materials<Law> laws = materials(settings);
    const moreau::ColouredGaussSeidel solver = solver_of(settings);
    moreau::require(std::isfinite(settings.gravity) && std::abs(settings.gravity) <= 1e4, "testbed",
                    "gravity", settings.gravity, "must lie in [-1e4, 1e4] m/s^2");
    check(settings);
    settings_ = settings;
    simulation_.set_materials(laws);
    simulation_.set_solver(solver);
    adopt();
  }
  void pull(std::size_t grain, const std::array<double, 3>& target) final {
    moreau::require(grain < simulation_.grain_count(), "testbed", "grain", grain,
                    "must be the number of a grain");
    release();
    pulled_ = Pull{simulation_.grain(grain), from_page<Vector>(target)};
  }
  void release() final {
    if (pulled_) simulation_.set_force(pulled_->grain, Vector::Zero());
    pulled_.reset();
    status_.hand = 0;
  }
  void write_frame() final {
    frame_.clear();
    for (const moreau::BodyId grain : simulation_.grains()) {
      const moreau::Pose<S>& pose = simulation_.pose(grain);
      push(frame_.poses, Vector(pose.position));
      push(frame_.poses, pose.rotation);
    }
    write_contacts();
    write_walls();
    status_.time = simulation_.time();
    status_.points = simulation_.contacts().size();
    status_.can_act = can_act();
    status_.stage = stage();
    status_.fault = fault();
    status_.mass = mass();
    status_.paths_from = paths_from();
    status_.advice.clear();
    for (const std::string& sentence : moreau::check(simulation_, last_))
      status_.advice += (status_.advice.empty() ? "" : "; ") + sentence;
  }

 protected:
  /// @param size   of the smallest grain [m]
  /// @param margin of detection, relative to the size; at the default step it is the way of 2.5 m/s
  Scene(const Settings& settings, double size, double margin = 0.05)
      : settings_(settings),
        random_(static_cast<std::uint64_t>(settings.seed)),
        simulation_(size, materials(settings), solver_of(settings), tolerances(margin)) {
    require_whole(settings);
  }

  // What differs between the scenes.
  virtual void drive() {}                                     ///< before a step
  virtual void record(const moreau::StepReport& report) = 0;  ///< after it: adds a row of samples
  virtual void check(const Settings&) const {}   ///< throws if the scene cannot take them
  virtual void adopt() { set_gravity(); }        ///< takes settings_
  virtual bool can_act() const { return true; }  ///< whether act() has an effect
  virtual std::string stage() const { return ""; }
  virtual std::string fault() const { return ""; }  ///< Status::fault
  virtual double paths_from() const { return 0; }   ///< Status::paths_from
  virtual void write_walls() = 0;

  /// Materials of bodies: grains, walls with friction, walls without.
  static moreau::MaterialId grain_material() { return moreau::MaterialId(0); }
  static moreau::MaterialId rough() { return moreau::MaterialId(1); }
  static moreau::MaterialId smooth() { return moreau::MaterialId(2); }

  void set_gravity() { simulation_.set_gravity(-settings_.gravity * Vector::Unit(up)); }

  /// Draws `count` base shapes of circumradius 1 with their meshes.
  void draw_bases(std::size_t count) {
    if constexpr (is_round) count = 1;
    for (std::size_t k = 0; k < count; ++k) add_base(moreau::Ballast<ShapeT>::draw(random_));
  }
  void add_base(const ShapeT& shape) {
    bases_.push_back(shape);
    moreau::SurfaceMesh<S> surface;
    moreau::SurfaceMesher<S>(2).mesh(shape, surface);
    meshes_.emplace_back().is_round = is_round;
    triangulate(surface, meshes_.back());
  }
  moreau::BodyId add_grain(std::size_t base, double scale, const moreau::Pose<S>& pose) {
    const ShapeT shape = bases_[base].scaled(scale);
    placements_.push_back({static_cast<std::uint32_t>(base), static_cast<float>(scale)});
    volume_ += shape.volume();
    return simulation_.add_grain(simulation_.add_shape(shape), pose, density);
  }
  /// Circumradii of the grains, of the sizes of the study (2.5, 3.75 and 5 cm) [m].
  std::vector<double> draw_radii() {
    std::vector<double> radii =
        moreau::SizeDistribution::azema2008().sample(std::size_t(settings_.grains), random_);
    for (double& radius : radii) radius /= 2;
    return radii;
  }
  static double smallest_size() { return moreau::SizeDistribution::azema2008().smallest(); }
  /// Volume, in the plane the area, of grains of these radii [m^D].
  double volume_of(const std::vector<double>& radii) const {
    double sum = 0;
    for (std::size_t k = 0; k < radii.size(); ++k)
      sum += bases_[k % bases_.size()].volume() * std::pow(radii[k], S::dim);
    return sum;
  }
  double mass() const { return density * volume_; }
  double kinetic_energy() const { return moreau::kinetic_energy(simulation_).total(); }
  void set_bounds(const Vector& lower, const Vector& upper) {
    Floats both;
    push(both, lower), push(both, upper);
    std::copy(both.begin(), both.end(), bounds_.begin());
  }
  /// A wall as a box with axes parallel to the world [m].
  void show_wall(const Vector& lower, const Vector& upper, bool moves) {
    frame_.walls.push_back(0);
    push(frame_.walls, Vector((lower + upper) / 2));
    push(frame_.walls, Vector((upper - lower) / 2));
    frame_.walls.push_back(moves ? 1 : 0);
  }
  /// Adds a row of samples.
  template <class... Values>
  void add_row(const Values&... values) {
    (samples_.push_back(double(values)), ...);
  }

  static constexpr bool is_round = std::same_as<ShapeT, moreau::BallIn<S>>;

  Settings settings_;
  std::mt19937_64 random_;
  Simulation simulation_;
  std::vector<ShapeT> bases_;
  double volume_ = 0;  // of all grains [m^D]

  /// A grain that is pulled by a spring towards a point.
  struct Pull {
    moreau::BodyId grain;
    Vector target;
  };
  std::optional<Pull> pulled_;

 private:
  static moreau::Materials<Law> materials(const Settings& settings) {
    const auto law = [&](double friction) {
      return Law(moreau::SignoriniCoulomb<double>(friction), settings.stiffness);
    };
    moreau::Materials<Law> laws(3, law(settings.friction));
    laws.set(grain_material(), smooth(), law(0));
    return laws;
  }
  static moreau::ColouredGaussSeidel solver_of(const Settings& settings) {
    moreau::ColouredOptions options;
    options.tolerance = settings.tolerance;
    options.max_sweeps = static_cast<int>(std::clamp(settings.sweeps, 1., 1e6));
    options.check_interval = 10;
    return moreau::ColouredGaussSeidel(options);
  }
  static moreau::Tolerances tolerances(double margin) {
    moreau::Tolerances tolerances;
    tolerances.margin = margin;
    return tolerances;
  }
  /// A critically damped spring at the centre of the grain, which carries its weight and is no stronger than the
  /// hand.
  void pull_grain() {
    if (!pulled_) return;
    constexpr double rate = 40;  // [1/s]
    const double mass = simulation_.bodies().grain_mass[pulled_->grain.index()];
    const Vector way = pulled_->target - Vector(simulation_.pose(pulled_->grain).position);
    Vector force = mass * (rate * rate * way - 2 * rate * simulation_.velocity(pulled_->grain));
    force[up] += mass * settings_.gravity;
    // Jammed grains need more than their inertia: the stiffness grows with the strength of the hand.
    force += settings_.hand / 0.1 * way;
    if (const double norm = force.norm(); norm > settings_.hand) force *= settings_.hand / norm;
    status_.hand = force.norm();
    simulation_.set_force(pulled_->grain, force);
  }
  /// Force chains, and the colours of the grains: the sum of the normal forces on a grain, and the
  /// largest residual of its contacts.
  void write_contacts() {
    const auto& contacts = simulation_.contacts();
    const std::size_t bodies = simulation_.bodies().size();
    force_.assign(bodies, 0), residual_.assign(bodies, 0);
    const auto position_of = [&](std::size_t body) {
      return Vector(simulation_.bodies().pose[body].position);
    };
    const auto is_grain = [&](std::size_t body) { return simulation_.is_grain(body); };
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      if (!(contacts.impulses[c][0] > 0)) continue;
      const moreau::ContactSegment<S> segment =
          moreau::contact_segment(contacts, c, last_step_, position_of, is_grain);
      push(frame_.segments, segment.from);
      push(frame_.segments, segment.to);
      push(frame_.segments, segment.point);
      frame_.segments.push_back(static_cast<float>(segment.normal_force));
      const double friction = simulation_.materials().laws()[contacts.points[c].law].friction();
      const bool slides = segment.friction_force >= 0.999 * friction * segment.normal_force;
      frame_.segments.push_back(slides ? 1 : 0);
      force_[segment.a] += segment.normal_force;
      force_[segment.b] += segment.normal_force;
    }
    measure_residuals(contacts);
    for (const moreau::BodyId grain : simulation_.grains()) {
      const std::size_t i = grain.index();
      frame_.colours.push_back(static_cast<float>(simulation_.velocity(grain).norm()));
      frame_.colours.push_back(static_cast<float>(force_[i]));
      frame_.colours.push_back(static_cast<float>(residual_[i]));
    }
  }
  /// The norm of the natural map of each contact, as a velocity.
  void measure_residuals(const auto& contacts) {
    const auto& problem = simulation_.contact_problem();
    if (problem.size() != contacts.size()) return;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Vector u = problem.delassus.velocity(c);
      if (!std::isfinite(u[0])) continue;
      const double scale = problem.delassus.block(c).trace() / S::dim;
      const double left = problem.law(c).natural_map(u, Vector(scale * contacts.impulse(c))).norm();
      for (const std::uint32_t body : {contacts.points[c].a, contacts.points[c].b})
        residual_[body] = std::max(residual_[body], left);
    }
  }

  moreau::StepReport last_;
  double last_step_ = 1;  // [s]
  std::vector<double> force_, residual_;
};

}  // namespace testbed
