// SPDX-License-Identifier: MIT
// The box of the study (examples/ratcheting): a lid packs the grains without gravity; then the wall at
// the end of the x axis is free and pushed inward by f(t) = fmax (1 - sin 2 pi nu t) / 2.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "moreau/boundary/drive.hpp"
#include "moreau/sample/random_deposition.hpp"

#include "scene.hpp"

namespace testbed {

template <class ShapeT>
class Box final : public Scene<ShapeT> {
  using Base = Scene<ShapeT>;
  using Base::settings_, Base::simulation_, Base::random_, Base::up;
  using typename Base::S, typename Base::Vector;

 public:
  explicit Box(const Settings& settings) : Base(settings, Base::smallest_size()) {
    this->draw_bases(24);
    const std::vector<double> radii = this->draw_radii();
    const double widest = *std::max_element(radii.begin(), radii.end());
    length_ = std::max(std::pow(this->volume_of(radii) / packed, 1.0 / S::dim), 2.1 * widest);
    const auto poses = moreau::random_deposition<S>(radii, length_, random_);
    for (std::size_t k = 0; k < poses.size(); ++k) {
      this->add_grain(k % this->bases_.size(), radii[k], poses[k]);
      height_ = std::max(height_, poses[k].position[up] + radii[k]);
    }
    for (int axis = 0; axis < up; ++axis) {
      const Vector n = Vector::Unit(axis);
      simulation_.add_wall(n, Vector::Zero(), Base::smooth());
      const auto far = simulation_.add_wall(-n, length_ * n, Base::smooth());
      if (axis == 0) wall_ = far;
    }
    simulation_.add_wall(Vector::Unit(up), Vector::Zero(), Base::rough());
    lid_ = simulation_.add_wall(-Vector::Unit(up), height_ * Vector::Unit(up), Base::rough());
    this->channels_ = {{"t", "time", "s", 1},
                       {"x", "wall position x", "mm", 1e3},
                       {"f", "force f", "N", 1},
                       {"fg", "force f_g", "N", 1},
                       {"rho", "solid fraction ρ", "-", 1},
                       {"sweeps", "sweeps", "per step", 1},
                       {"residual", "residual", "-", 1}};
    this->plots_ = {{"Wall position x and applied force f", 0, 1, 2, false, false},
                    {"Force f_g of the grains over wall position x", 1, 3, -1, false, true},
                    {"Volume of the grains / volume of the box", 0, 4, -1, false, false},
                    {"Solver: sweeps and residual of each step", 0, 5, 6, true, false}};
    if (settings.packing == 1)
      close_lid();
    else
      free_wall();
    show_all();
  }

  /// Ends the packing.
  void act() override {
    if (stage_ != Stage::shaking) free_wall();
  }

 private:
  enum class Stage : std::uint8_t { closing, pressing, shaking };
  /// The solid fraction after the packing, about; it only changes the height.
  static constexpr double packed = S::dim == 2 ? 0.80 : 0.53;
  static constexpr double lid_raise = 0.01;     // [m]
  static constexpr double longest_press = 0.2;  // [s]

  double lid_force() const { return 5 * 9.81 * this->mass(); }
  double lid_height() const { return simulation_.pose(lid_).position[up]; }
  double wall_position() const { return simulation_.pose(wall_).position[0]; }

  void close_lid() {
    simulation_.set_gravity(Vector::Zero());
    simulation_.set_wall_mass(lid_, std::numeric_limits<double>::infinity());
    set_lid_speed();
  }
  /// So slowly that contacts are detected in time.
  void set_lid_speed() {
    const double speed = 0.4 * 0.05 * simulation_.grain_size() / settings_.step;
    simulation_.set_velocity(lid_, -std::min(speed, 1.) * Vector::Unit(up));
  }
  void press() {
    stage_ = Stage::pressing;
    begin_ = simulation_.time();
    simulation_.set_velocity(lid_, Vector::Zero());
    simulation_.set_wall_mass(lid_, this->mass());
    simulation_.set_force(lid_, -lid_force() * Vector::Unit(up));
  }
  /// Raises and fixes the lid, switches on gravity, and gives the wall its mass.
  void free_wall() {
    stage_ = Stage::shaking;
    begin_ = simulation_.time();
    simulation_.set_wall_mass(lid_, std::numeric_limits<double>::infinity());
    simulation_.set_velocity(lid_, Vector::Zero());
    simulation_.set_force(lid_, Vector::Zero());
    moreau::Pose<S> pose = simulation_.pose(lid_);
    pose.position[up] += lid_raise;
    simulation_.set_pose(lid_, pose);
    adopt();
    show_all();
  }
  /// Sets the bounds of the picture: the lid, the wall, and room for the arrow of the force.
  void show_all() {
    Vector upper = Vector::Constant(length_);
    upper[0] = std::max(wall_position(), length_) + 0.5 * length_;
    upper[up] = 1.05 * lid_height();
    this->set_bounds(Vector::Zero(), upper);
  }
  moreau::HarmonicForce force(const Settings& settings) const {
    return {0, settings.fmax, settings.frequency, begin_};
  }

  void check(const Settings& settings) const override {
    (void)force(settings);
    moreau::require_positive(settings.wall_mass, "testbed", "wall_mass");
  }
  void adopt() override {
    if (stage_ == Stage::closing) set_lid_speed();
    if (stage_ != Stage::shaking) return;
    this->set_gravity();
    simulation_.set_wall_mass(wall_, settings_.wall_mass * this->mass());
  }
  void drive() override {
    applied_ = 0;
    if (stage_ != Stage::shaking) return;
    applied_ = force(settings_)(simulation_.time() + settings_.step / 2);
    simulation_.set_force(wall_, -applied_ * Vector::UnitX());
  }
  void record(const moreau::StepReport& report) override {
    const double fg = simulation_.contact_impulse(wall_)[0] / settings_.step;
    const double room = wall_position() * std::pow(length_, S::dim - 2) * lid_height();
    this->add_row(simulation_.time(), wall_position() - length_, applied_, fg, this->volume_ / room,
                  report.solve.sweeps, report.solve.residual);
    // It is kept: the step may lie between two frames.
    if (fault_.empty() && wall_position() <= 0)
      fault_ = "the wall has passed the opposite wall";
    else if (fault_.empty() && this->volume_ > room)
      fault_ = "the volume of the grains exceeds that of the box";
    // The wall is about to leave the picture.
    if (wall_position() + 0.4 * length_ > this->bounds_[3]) show_all();
    if (stage_ == Stage::closing) {
      const double now = simulation_.contact_impulse(lid_)[up] / settings_.step;
      reaction_ += 0.05 * (now - reaction_);
      if (reaction_ >= lid_force() || lid_height() < simulation_.grain_size()) press();
    } else if (stage_ == Stage::pressing) {
      const double pressed = simulation_.time() - begin_;
      const double still =
          1e-6 * lid_force() * simulation_.grain_size() * double(simulation_.grain_count());
      const bool settled = pressed > 0.02 && this->kinetic_energy() <= still;
      if (settled || pressed > longest_press) free_wall();
    }
  }
  bool can_act() const override { return stage_ != Stage::shaking; }
  std::string stage() const override {
    if (stage_ == Stage::shaking) return "the wall is free";
    if (stage_ == Stage::pressing) return "packing: the lid presses (no gravity yet)";
    // About: the box is as high as it is long if the solid fraction is that of `packed`.
    const double part = (height_ - lid_height()) / std::max(height_ - length_, 1e-9);
    return "packing: the lid closes (no gravity yet), " +
           std::to_string(int(100 * std::clamp(part, 0., 0.99))) + " %";
  }
  std::string fault() const override { return fault_; }
  double paths_from() const override {
    return stage_ == Stage::shaking ? begin_ : std::numeric_limits<double>::infinity();
  }
  void write_walls() override {
    constexpr double thin = Base::wall_thickness;
    const double x = wall_position(), high = lid_height();
    Vector lower = Vector::Zero(), upper = Vector::Constant(length_);
    upper[0] = x, upper[up] = high;
    for (int axis = 0; axis < S::dim; ++axis)
      for (const bool far : {false, true}) {
        Vector l = lower, u = upper;
        if (far)
          l[axis] = upper[axis], u[axis] = upper[axis] + thin;
        else
          u[axis] = 0, l[axis] = -thin;
        const bool is_lid = axis == up && far, is_wall = axis == 0 && far;
        this->show_wall(l, u, is_wall || (is_lid && stage_ != Stage::shaking));
      }
  }

  Stage stage_ = Stage::closing;
  double length_ = 0, height_ = 0, begin_ = 0, reaction_ = 0, applied_ = 0;
  std::string fault_;
  moreau::BodyId wall_, lid_;
};

}  // namespace testbed
