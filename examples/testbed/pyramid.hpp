// SPDX-License-Identifier: MIT
// A pyramid of blocks. Of round grains it stands between walls, which hold the lowest layer.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>

#include "scene.hpp"

namespace testbed {

template <class ShapeT>
class Pyramid final : public Scene<ShapeT> {
  using Base = Scene<ShapeT>;
  using Base::settings_, Base::simulation_, Base::up;
  using typename Base::S, typename Base::Vector;

 public:
  explicit Pyramid(const Settings& settings) : Base(settings, block, fast_margin) {
    this->add_base(Base::block_of(Vector::Constant(block / 2)));
    for (int layer = 0; layer < layers; ++layer) add_layer(layer);
    simulation_.add_wall(Vector::Unit(up), Vector::Zero(), Base::rough());
    if constexpr (Base::is_round)
      for (int axis = 0; axis < up; ++axis)
        for (const double side : {-1., 1.})
          simulation_.add_wall(-side * Vector::Unit(axis), side * half_base * Vector::Unit(axis),
                               Base::rough());
    this->set_gravity();
    Vector lower = Vector::Constant(-1.5 * half_base), upper = -lower;
    lower[0] -= block, lower[up] = 0, upper[up] = 1.4 * double(layers) * block;
    this->set_bounds(lower, upper);
    this->channels_ = {{"t", "time", "s", 1},
                       {"x", "height of the top", "m", 1},
                       {"energy", "kinetic energy", "J", 1},
                       {"sweeps", "sweeps", "per step", 1},
                       {"residual", "residual", "-", 1}};
    this->plots_ = {{"Height of the top", 0, 1, -1, false, false},
                    {"Kinetic energy", 0, 2, -1, false, false},
                    {"Solver: sweeps and residual of each step", 0, 3, 4, true, false}};
  }

  /// Shoots a block from the left, in a pyramid of round grains from above.
  void act() override {
    Vector x = Vector::Zero(), v = Vector::Zero();
    if constexpr (Base::is_round)
      x[up] = (layers + 3) * block, v[up] = -speed;
    else
      x[0] = -half_base - 2 * block, x[up] = 0.4 * layers * block, v[0] = speed;
    if (!this->has_room(x, block)) return;
    simulation_.set_velocity(this->add_grain(0, 1, moreau::Pose<S>(x)), v);
  }

 private:
  static constexpr int layers = S::dim == 2 ? 8 : 5;
  static constexpr double block = 0.05, speed = 4, fast_margin = 0.1;  // [m], [m/s]
  /// Distance of neighbours [m]: blocks of a layer do not touch, balls do.
  static constexpr double pitch = Base::is_round ? block : 1.04 * block;
  static constexpr double half_base = layers * pitch / 2;

  void add_layer(int layer) {
    // A ball lies between the four below, a disk between the two below.
    const double rise = !Base::is_round ? block
                        : S::dim == 2   ? block * std::sqrt(0.75)
                                        : block * std::sqrt(0.5);
    const int side = layers - layer, count = up == 1 ? side : side * side;
    for (int k = 0; k < count; ++k) {
      Vector x = Vector::Zero();
      for (int axis = 0, rest = k; axis < up; ++axis, rest /= side)
        x[axis] = pitch * (rest % side - (side - 1) / 2.);
      x[up] = block / 2 + layer * rise;
      this->add_grain(0, 1, moreau::Pose<S>(x));
    }
  }
  void record(const moreau::StepReport& report) override {
    double top = 0;
    for (const moreau::BodyId grain : simulation_.grains())
      top = std::max(top, double(simulation_.pose(grain).position[up]) + block / 2);
    this->add_row(simulation_.time(), top, this->kinetic_energy(), report.solve.sweeps,
                  report.solve.residual);
  }
  std::string stage() const override { return ""; }
  void write_walls() override {
    Vector lower = Vector::Constant(-2 * half_base), upper = -lower;
    lower[up] = -0.01, upper[up] = 0;
    this->show_wall(lower, upper, false);
    if constexpr (Base::is_round)
      for (int axis = 0; axis < up; ++axis)
        for (const double side : {-1., 1.}) {
          lower = Vector::Constant(-half_base), upper = -lower;
          lower[axis] = side * half_base + std::min(0., side * Base::wall_thickness);
          upper[axis] = side * half_base + std::max(0., side * Base::wall_thickness);
          lower[up] = 0, upper[up] = block;
          this->show_wall(lower, upper, false);
        }
  }
};

}  // namespace testbed
