// SPDX-License-Identifier: MIT
// A scene: grains and walls with settings that can be changed while it runs. AnyScene is what the page
// and the native program see; Scene<Shape> is the common part of all scenes (box.hpp, column.hpp, ...),
// for each shape.
//
// The contacts are compliant (moreau/law/compliant.hpp): an error of a step is felt as a force in the
// next, so that a step can be ended after a few hundred sweeps and a packing under load still does not
// drift. That suits a picture that must not wait.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <span>
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
#include "moreau/shape/circumradius.hpp"

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
  /// Lets the pulled grain go with a velocity of the page [m/s].
  virtual void throw_grain(const std::array<double, 3>& velocity) = 0;
  /// Adds a grain at rest, as high in the picture as a few hundred random places allow.
  /// @throws std::invalid_argument if none of them has room
  virtual void add() = 0;
  /// Removes a grain.
  /// @throws std::invalid_argument if it is none, or one that the scene needs
  virtual void remove(std::size_t grain) = 0;

  const std::vector<Mesh>& meshes() const { return meshes_; }
  const std::vector<Placement>& placements() const { return placements_; }  ///< of each grain
  const std::vector<Channel>& channels() const { return channels_; }
  const std::vector<PlotSpec>& plots() const { return plots_; }
  const std::array<double, 6>& bounds() const {
    return bounds_;
  }                                                 ///< of the picture: lower, upper [m]
  const Floats& ground() const { return ground_; }  ///< triangles of a wall, 9 numbers each
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
  Floats ground_;
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
  void throw_grain(const std::array<double, 3>& velocity) final {
    if (!pulled_) return;
    const moreau::BodyId grain = pulled_->grain;
    release();
    Vector v = from_page<Vector>(velocity);
    if (const double speed = v.norm(); speed > fastest_throw) v *= fastest_throw / speed;
    simulation_.set_velocity(grain, v);
  }
  void add() final {
    const std::size_t like =
        std::uniform_int_distribution<std::size_t>(0, placements_.size() - 1)(random_);
    const Placement placement = placements_[like];
    const double radius = moreau::circumradius(bases_[placement.mesh]) * placement.scale;
    Vector best = Vector::Zero();
    bool found = false;
    for (int k = 0; k < 300; ++k) {
      const Vector x = random_place();
      if ((found && x[up] <= best[up]) || !has_room(x, radius)) continue;
      best = x, found = true;
    }
    moreau::require(found, "testbed", "grain", placement.mesh, "found no room for another grain");
    add_grain(placement.mesh, placement.scale, moreau::Pose<S>(best));
  }
  void remove(std::size_t grain) final {
    moreau::require(grain < simulation_.grain_count(), "testbed", "grain", grain,
                    "must be the number of a grain");
    const moreau::BodyId id = simulation_.grain(grain);
    moreau::require(simulation_.grain_count() > 1 && !needs(id), "testbed", "grain", grain,
                    "must be one that the scene does not need");
    if (pulled_ && pulled_->grain == id) release();
    volume_ -= simulation_.shape_of_grain(grain).volume();
    simulation_.remove_grain(id);
    placements_.erase(placements_.begin() + std::ptrdiff_t(grain));
    ++status_.version;
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
    status_.hash = hash();
    status_.ms = {last_.ms_place + last_.ms_pairs,
                  last_.ms_collide,
                  last_.ms_assemble,
                  last_.ms_contacts,
                  last_.ms_correct,
                  last_.ms_total};
    status_.advice.clear();
    for (const std::string& sentence : moreau::check(simulation_, last_))
      status_.advice += (status_.advice.empty() ? "" : "; ") + sentence;
  }

 protected:
  /// @param size   of the smallest grain [m]
  /// @param margin of detection at a step of 0.5 ms, relative to the size: 0.05 is the way of 2.5 m/s. In longer
  ///               steps it is larger in proportion.
  Scene(const Settings& settings, double size, double margin = 0.05)
      : settings_(settings),
        random_(static_cast<std::uint64_t>(settings.seed)),
        simulation_(size, materials(settings), solver_of(settings),
                    tolerances(margin * std::clamp(settings.step / 5e-4, 1., 4.))) {
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
  virtual bool needs(moreau::BodyId) const {
    return false;
  }  ///< whether a grain must not be removed

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
    volume_ += shape.volume();
    const moreau::BodyId id = simulation_.add_grain(simulation_.add_shape(shape), pose, density);
    // A grain that is added later can take the place of one that was removed.
    std::size_t k = simulation_.grain_count() - 1;
    while (simulation_.grain(k) != id) --k;
    placements_.insert(placements_.begin() + std::ptrdiff_t(k),
                       {static_cast<std::uint32_t>(base), static_cast<float>(scale)});
    ++status_.version;
    return id;
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

  /// A block with these half lengths [m]: a cuboid; of concave grains a beam with a waist; of round ones a ball.
  static ShapeT block_of(const Vector& half) {
    if constexpr (is_round) {
      return ShapeT(half.minCoeff());
    } else if constexpr (moreau::CompoundShape<ShapeT>) {
      using Part = moreau::PartOf<ShapeT>;
      Vector low = -half, high = half, waist = 0.6 * half;
      high[up] = -half[up] / 3, waist[up] = half[up] / 3;
      const std::vector<Part> parts{cuboid<Part>(low, high), cuboid<Part>(-waist, waist),
                                    cuboid<Part>(-high, -low)};
      return ShapeT{std::span<const Part>(parts)};
    } else {
      return cuboid<ShapeT>(-half, half);
    }
  }
  template <class Part>
  static Part cuboid(const Vector& lower, const Vector& upper) {
    std::vector<Vector> corners(std::size_t{1} << S::dim, lower);
    for (std::size_t bits = 0; bits < corners.size(); ++bits)
      for (int axis = 0; axis < S::dim; ++axis)
        if ((bits >> axis & 1) != 0) corners[bits][axis] = upper[axis];
    return Part(std::span<const Vector>(corners));
  }

  /// Whether a ball overlaps neither grain nor wall [m].
  bool has_room(const Vector& x, double radius) const {
    const auto& bodies = simulation_.bodies();
    for (const moreau::BodyId wall : simulation_.walls())
      if (bodies.axes(wall.index()).col(0).dot(x - Vector(simulation_.pose(wall).position)) <
          radius)
        return false;
    for (const auto& cylinder : simulation_.cylinders()) {
      Vector way = x - Vector(simulation_.pose(cylinder.body).position);
      for (int k = 1; k < up; ++k) way[k] = 0;  // the axis
      if (way.norm() + radius > cylinder.shape.radius()) return false;
    }
    for (std::size_t k = 0; k < placements_.size(); ++k) {
      const double other = moreau::circumradius(bases_[placements_[k].mesh]) * placements_[k].scale;
      if ((Vector(simulation_.pose(simulation_.grain(k)).position) - x).norm() < radius + other)
        return false;
    }
    return ground_.empty() || x[up] > radius;
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
  static constexpr double fastest_throw = 4;  // [m/s]

  /// A place in the picture.
  Vector random_place() {
    const Vector lower = from_page<Vector>({bounds_[0], bounds_[1], bounds_[2]});
    Vector x = from_page<Vector>({bounds_[3], bounds_[4], bounds_[5]});
    for (int axis = 0; axis < S::dim; ++axis)
      x[axis] = std::uniform_real_distribution<double>(
          lower[axis], std::max(x[axis], lower[axis] + 1e-9))(random_);
    return x;
  }
  /// FNV-1a over the bits of the time, of poses and velocities of all bodies, and of the impulses of the contacts.
  std::string hash() const {
    std::uint64_t h = 14695981039346656037u;
    const auto add = [&](double x) {
      std::uint64_t bits;
      std::memcpy(&bits, &x, sizeof bits);
      for (int k = 0; k < 64; k += 8) h = (h ^ (bits >> k & 255)) * 1099511628211u;
    };
    const auto add_all = [&](const auto& vector) {
      for (Eigen::Index k = 0; k < vector.size(); ++k) add(vector[k]);
    };
    add(simulation_.time());
    const auto& bodies = simulation_.bodies();
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      // Where the body has put its origin and its axes.
      add_all(bodies.pose[k].position);
      for (int axis = 0; axis < S::dim; ++axis) add_all(bodies.pose[k](Vector(Vector::Unit(axis))));
      add_all(bodies.velocity[k]);
    }
    for (const Vector& impulse : simulation_.contacts().impulses) add_all(impulse);
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(h));
    return digits;
  }

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
      push(frame_.segments, Vector(contacts.points[c].frame.col(0)));
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
      const double left =
          problem.law(c)
              .natural_map(u, Vector(scale * problem.delassus.turned(c, contacts.impulse(c))))
              .norm();
      for (const std::uint32_t body : {contacts.points[c].a, contacts.points[c].b})
        residual_[body] = std::max(residual_[body], left);
    }
  }

  moreau::StepReport last_;
  double last_step_ = 1;  // [s]
  std::vector<double> force_, residual_;
};

}  // namespace testbed
