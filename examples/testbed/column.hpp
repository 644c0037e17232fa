// SPDX-License-Identifier: MIT
// The collapse of a column: grains settle behind a gate, the gate is taken away, they run out over the
// floor. In space the column is a slice between two walls without friction.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "moreau/sample/random_deposition.hpp"

#include "scene.hpp"

namespace testbed {

template <class ShapeT>
class Column final : public Scene<ShapeT> {
  using Base = Scene<ShapeT>;
  using Base::settings_, Base::simulation_, Base::random_, Base::up;
  using typename Base::S, typename Base::Vector;

 public:
  explicit Column(const Settings& settings) : Base(settings, Base::smallest_size(), fast_margin) {
    this->draw_bases(24);
    const std::vector<double> radii = this->draw_radii();
    const double section = this->volume_of(radii) / packed / (up == 1 ? 1 : depth);
    length_ = std::max(std::sqrt(section / settings.aspect), 2.1 * widest);
    fill(radii);
    const double far = 6 * length_ + 10 * widest;
    simulation_.add_wall(Vector::Unit(up), Vector::Zero(), Base::rough());
    simulation_.add_wall(Vector::UnitX(), Vector::Zero(), Base::smooth());
    simulation_.add_wall(-Vector::UnitX(), far * Vector::UnitX(), Base::smooth());
    gate_ = simulation_.add_wall(-Vector::UnitX(), length_ * Vector::UnitX(), Base::smooth());
    for (int axis = 1; axis < up; ++axis) {
      simulation_.add_wall(Vector::Unit(axis), Vector::Zero(), Base::smooth());
      simulation_.add_wall(-Vector::Unit(axis), depth * Vector::Unit(axis), Base::smooth());
    }
    this->set_gravity();
    upper_ = Vector::Constant(depth);
    upper_[0] = far;
    upper_[up] = std::max(1.3 * length_ * settings.aspect, 4 * widest);
    // Before the gate opens, the picture shows the grains that fall into the column.
    shown_ = upper_;
    shown_[0] = std::min(far, 4.5 * length_ + 2 * widest);
    Vector all = shown_;
    for (const moreau::BodyId grain : simulation_.grains())
      all[up] = std::max(all[up], simulation_.pose(grain).position[up] + widest / 2);
    this->set_bounds(Vector::Zero(), all);
    this->channels_ = {{"t", "time", "s", 1},
                       {"x", "front", "m", 1},
                       {"height", "height", "m", 1},
                       {"energy", "kinetic energy", "J", 1},
                       {"sweeps", "sweeps", "per step", 1},
                       {"residual", "residual", "-", 1}};
    this->plots_ = {{"Front and height of the heap (98 % of the grains)", 0, 1, 2, false, false},
                    {"Height of the heap over its front", 1, 2, -1, false, true},
                    {"Kinetic energy of the grains", 0, 3, -1, false, false},
                    {"Solver: sweeps and residual of each step", 0, 4, 5, true, false}};
  }

  /// Takes the gate away.
  void act() override {
    if (open_) return;
    open_ = true;
    this->set_bounds(Vector::Zero(), shown_);
    moreau::Pose<S> pose = simulation_.pose(gate_);
    pose.position += 1000 * Vector::UnitX();
    simulation_.set_pose(gate_, pose);
  }

 private:
  static constexpr double fast_margin = 0.1;  // grains fall at up to 4 m/s
  static constexpr double packed = S::dim == 2 ? 0.80 : 0.55;
  static constexpr double widest = 0.05, depth = 0.15;  // [m]
  static constexpr double settling = 0.7;               // [s]

  /// In space the depositions are square towers, side by side along the column.
  void fill(const std::vector<double>& radii) {
    const auto towers =
        up == 1 ? std::size_t(1) : static_cast<std::size_t>(std::ceil(length_ / depth));
    const double width = up == 1 ? length_ : std::min(depth, length_ / double(towers));
    for (std::size_t tower = 0; tower < towers; ++tower) {
      std::vector<double> own;
      for (std::size_t k = tower; k < radii.size(); k += towers) own.push_back(radii[k]);
      auto poses = moreau::random_deposition<S>(own, width, random_);
      for (std::size_t k = 0; k < poses.size(); ++k) {
        poses[k].position[0] += length_ / double(towers) * double(tower);
        this->add_grain((tower + k * towers) % this->bases_.size(), own[k], poses[k]);
      }
    }
  }
  /// The coordinate that 98 % of the grains do not exceed [m].
  double reach(int axis) {
    reaches_.clear();
    for (const moreau::BodyId grain : simulation_.grains())
      reaches_.push_back(simulation_.pose(grain).position[axis]);
    const auto at = reaches_.begin() + std::ptrdiff_t(0.98 * double(reaches_.size()));
    std::nth_element(reaches_.begin(), at, reaches_.end());
    return *at;
  }

  void record(const moreau::StepReport& report) override {
    this->add_row(simulation_.time(), reach(0), reach(up), this->kinetic_energy(),
                  report.solve.sweeps, report.solve.residual);
    if (simulation_.time() > settling) act();
  }
  bool can_act() const override { return !open_; }
  std::string stage() const override {
    return open_ ? "the gate is open" : "the grains settle behind the gate";
  }
  void write_walls() override {
    constexpr double thin = Base::wall_thickness;
    Vector lower = Vector::Zero(), upper = upper_;
    const auto show = [&](int axis, double at, double low, bool moves) {
      Vector l = lower, u = upper;
      l[axis] = at + std::min(low, 0.), u[axis] = at + std::max(low, 0.);
      this->show_wall(l, u, moves);
    };
    show(up, 0, -thin, false);
    show(0, 0, -thin, false);
    show(0, upper[0], thin, false);
    for (int axis = 1; axis < up; ++axis)
      show(axis, 0, -thin, false), show(axis, depth, thin, false);
    if (!open_) show(0, length_, thin, true);
  }

  bool open_ = false;
  double length_ = 0;
  Vector upper_, shown_;  // of the walls; of the picture when the gate is open
  std::vector<double> reaches_;
  moreau::BodyId gate_;
};

}  // namespace testbed
