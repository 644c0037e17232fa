// SPDX-License-Identifier: MIT
// A row of dominoes of which the first is pushed. Round grains roll instead.
#pragma once

#include <cstddef>
#include <string>

#include "scene.hpp"

namespace testbed {

template <class ShapeT>
class Dominoes final : public Scene<ShapeT> {
  using Base = Scene<ShapeT>;
  using Base::settings_, Base::simulation_, Base::up;
  using typename Base::S, typename Base::Vector;

 public:
  explicit Dominoes(const Settings& settings) : Base(settings, high, 0.06) {
    Vector half = Vector::Constant(wide);
    half[0] = thin, half[up] = high;
    this->add_base(Base::block_of(half));
    const double centre = Base::is_round ? half.minCoeff() : high;
    for (int k = 0; k < count; ++k) {
      Vector x = Vector::Zero();
      x[0] = k * pitch, x[up] = centre;
      const moreau::BodyId grain = this->add_grain(0, 1, moreau::Pose<S>(x));
      if (k == 0) first_ = grain;
    }
    simulation_.add_wall(Vector::Unit(up), Vector::Zero(), Base::rough());
    this->set_gravity();
    Vector lower = Vector::Constant(-2 * wide), upper = -lower;
    lower[0] = -2 * pitch, upper[0] = (count + 2) * pitch;
    lower[up] = 0, upper[up] = 4 * high;
    this->set_bounds(lower, upper);
    this->channels_ = {{"t", "time", "s", 1},
                       {"x", "dominoes that have fallen", "", 1},
                       {"energy", "kinetic energy", "J", 1},
                       {"sweeps", "sweeps", "per step", 1},
                       {"residual", "residual", "-", 1}};
    this->plots_ = {{"Dominoes that have fallen", 0, 1, -1, false, false},
                    {"Kinetic energy", 0, 2, -1, false, false},
                    {"Solver: sweeps and residual of each step", 0, 3, 4, true, false}};
  }

  /// Turns the first domino about its lower edge, towards the others.
  void act() override {
    pushed_ = true;
    simulation_.set_velocity(first_, rate * high * Vector::UnitX());
    if constexpr (!Base::is_round)
      simulation_.set_spin(first_,
                           (S::dim == 2 ? -rate : rate) * S::Angular::Unit(S::angular_dim / 2));
  }

 private:
  static constexpr int count = 20;
  static constexpr double thin = 0.01, wide = 0.025, high = 0.05,
                          pitch = 0.055;  // half lengths, pitch [m]
  static constexpr double rate = 4;       // [rad/s]

  void drive() override {
    if (!pushed_ && simulation_.time() > 0.5) act();
  }
  bool can_act() const override { return !pushed_; }
  bool needs(moreau::BodyId grain) const override { return grain == first_; }
  void record(const moreau::StepReport& report) override {
    int fallen = 0;
    for (const moreau::BodyId grain : simulation_.grains())
      fallen += !Base::is_round && simulation_.pose(grain).position[up] < 0.85 * high;
    this->add_row(simulation_.time(), fallen, this->kinetic_energy(), report.solve.sweeps,
                  report.solve.residual);
  }
  void write_walls() override {
    Vector lower = Vector::Constant(-2 * wide), upper = -lower;
    lower[0] = -3 * pitch, upper[0] = (count + 3) * pitch;
    lower[up] = -0.01, upper[up] = 0;
    this->show_wall(lower, upper, false);
  }

  bool pushed_ = false;
  moreau::BodyId first_;
};

}  // namespace testbed
