// SPDX-License-Identifier: MIT
// Grains in a rotating drum; in space, a slice of a drum between two walls without friction.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "scene.hpp"

namespace testbed {

template <class ShapeT>
class Drum final : public Scene<ShapeT> {
  using Base = Scene<ShapeT>;
  using Base::settings_, Base::simulation_, Base::random_, Base::up;
  using typename Base::S, typename Base::Vector;

 public:
  explicit Drum(const Settings& settings) : Base(settings, Base::smallest_size()) {
    this->draw_bases(24);
    std::vector<double> radii = this->draw_radii();
    // Large grains below small ones: the drum then mixes or segregates them.
    std::sort(radii.begin(), radii.end(), [](double a, double b) { return a > b; });
    const double section = this->volume_of(radii) / packed / (up == 1 ? 1 : depth);
    radius_ = std::max(std::sqrt(section / (filled * std::numbers::pi)), 3 * radii.front());
    std::vector<Vector> places;
    while (!place(radii, places)) radius_ *= 1.05;
    for (std::size_t k = 0; k < radii.size(); ++k)
      this->add_grain(k % this->bases_.size(), radii[k],
                      {places[k], moreau::random_rotation<S>(random_)});
    drum_ = simulation_.add_cylinder(Vector::Zero(), axis(), radius_, Base::rough());
    for (int k = 1; k < up; ++k) {
      simulation_.add_wall(Vector::Unit(k), Vector::Zero(), Base::smooth());
      simulation_.add_wall(-Vector::Unit(k), depth * Vector::Unit(k), Base::smooth());
    }
    adopt();
    Vector lower = Vector::Constant(-1.05 * radius_), upper = -lower;
    for (int k = 1; k < up; ++k) lower[k] = 0, upper[k] = depth;
    this->set_bounds(lower, upper);
    this->channels_ = {{"t", "time", "s", 1},
                       {"x", "angle", "°", 1},
                       {"energy", "kinetic energy", "J", 1},
                       {"power", "power", "W", 1},
                       {"sweeps", "sweeps", "per step", 1},
                       {"residual", "residual", "-", 1}};
    this->plots_ = {{"Angle of the centre of mass", 0, 1, -1, false, false},
                    {"Power that the drum gives to the grains", 0, 3, -1, false, false},
                    {"Kinetic energy of the grains", 0, 2, -1, false, false},
                    {"Solver: sweeps and residual of each step", 0, 4, 5, true, false}};
  }

  /// Reverses the drum.
  void act() override {
    sense_ = -sense_;
    adopt();
  }

 private:
  static constexpr double packed = S::dim == 2 ? 0.80 : 0.55, filled = 0.4;
  static constexpr double depth = 0.15;  // [m]

  /// The axis of the drum. A positive spin lifts the grains on the right side of the picture.
  static typename S::Angular axis() { return S::Angular::Unit(S::angular_dim / 2); }
  static constexpr double turn = S::dim == 2 ? 1 : -1;

  /// Rows of square cells in the drum, from below, one grain in each cell.
  bool place(const std::vector<double>& radii, std::vector<Vector>& places) const {
    places.clear();
    double bottom = -0.98 * radius_;
    while (places.size() < radii.size()) {
      const double cell = 2.02 * radii[places.size()], height = bottom + cell / 2;
      const double farthest = std::max(std::abs(bottom), std::abs(bottom + cell));
      if (bottom + cell > 0.8 * radius_) return false;
      const double room =
          2 * std::sqrt(std::max(0., std::pow(0.98 * radius_, 2) - farthest * farthest));
      const auto columns = static_cast<std::size_t>(room / cell);
      const auto rows = up == 1 ? std::size_t(1) : static_cast<std::size_t>(depth / cell);
      for (std::size_t k = 0; k < columns * rows && places.size() < radii.size(); ++k) {
        Vector x;
        x[0] = (double(k % columns) - double(columns - 1) / 2) * cell;
        for (int other = 1; other < up; ++other)
          x[other] = (double(k / columns) + 0.5) * depth / double(rows);
        x[up] = height;
        places.push_back(x);
      }
      bottom += columns == 0 ? cell / 4 : cell;
    }
    return true;
  }
  double rate() const { return sense_ * settings_.drum_speed * 2 * std::numbers::pi / 60; }

  void check(const Settings& settings) const override {
    moreau::require(std::abs(settings.drum_speed) <= 1000, "testbed", "drum_speed",
                    settings.drum_speed, "must lie in [-1000, 1000] rev/min");
  }
  void adopt() override {
    this->set_gravity();
    simulation_.set_spin(drum_, rate() * turn * axis());
  }
  void record(const moreau::StepReport& report) override {
    Vector centre = Vector::Zero();
    for (const moreau::BodyId grain : simulation_.grains())
      centre +=
          simulation_.bodies().grain_mass[grain.index()] * Vector(simulation_.pose(grain).position);
    angle_ += rate() * settings_.step;
    this->add_row(simulation_.time(), std::atan2(centre[0], -centre[up]) * 180 / std::numbers::pi,
                  this->kinetic_energy(), power(), report.solve.sweeps, report.solve.residual);
  }
  /// Moment of the contacts with the drum about its axis times its angular velocity [W].
  double power() const {
    const auto& contacts = simulation_.contacts();
    double moment = 0;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const auto& contact = contacts.points[c];
      const bool is_a = contact.a == drum_.value;
      if (!is_a && contact.b != drum_.value) continue;
      const Vector impulse = contact.frame * contacts.impulse(c);
      const Vector lever = is_a ? contact.lever_a : contact.lever_b;
      moment += (is_a ? 1 : -1) * axis().dot(S::moment(lever, impulse));
    }
    return moment * turn * rate() / settings_.step;
  }
  std::string stage() const override { return "the drum turns"; }
  void write_walls() override {
    this->frame_.walls.push_back(1);
    Vector centre = Vector::Zero();
    for (int k = 1; k < up; ++k) centre[k] = depth / 2;
    push(this->frame_.walls, centre);
    for (const double x : {radius_, up == 1 ? 0 : depth / 2, angle_, 1.})
      this->frame_.walls.push_back(static_cast<float>(x));
  }

  double radius_ = 0, angle_ = 0, sense_ = 1;
  moreau::BodyId drum_;
};

}  // namespace testbed
