// SPDX-License-Identifier: MIT
// A semicircular arch of blocks on a floor. Angular blocks are wedges. Concave blocks are wedges with
// a tooth, which fills a groove of the next block. Of round blocks no arch can stand.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "scene.hpp"

namespace testbed {

template <class ShapeT>
class Arch final : public Scene<ShapeT> {
  using Base = Scene<ShapeT>;
  using Base::settings_, Base::simulation_, Base::up;
  using typename Base::S, typename Base::Vector;

 public:
  explicit Arch(const Settings& settings) : Base(settings, block) {
    for (std::size_t k = 0; k < blocks; ++k) add_block(k);
    simulation_.add_wall(Vector::Unit(up), Vector::Zero(), Base::rough());
    this->set_gravity();
    Vector lower = Vector::Constant(-depth), upper = Vector::Constant(depth);
    lower[0] = -1.3 * outer, upper[0] = 1.3 * outer;
    lower[up] = 0, upper[up] = 1.15 * outer;
    this->set_bounds(lower, upper);
    crown_ = position(keystone)[up];
    this->channels_ = {{"t", "time", "s", 1},
                       {"x", "sinking", "mm", 1e3},
                       {"thrust", "thrust H", "N", 1},
                       {"load", "load V", "N", 1},
                       {"sweeps", "sweeps", "per step", 1},
                       {"residual", "residual", "-", 1}};
    this->plots_ = {{"Sinking of the keystone", 0, 1, -1, false, false},
                    {"Force of the left springer on the floor", 0, 2, 3, false, false},
                    {"Thrust over the sinking of the keystone", 1, 2, -1, false, true},
                    {"Solver: sweeps and residual of each step", 0, 4, 5, true, false}};
  }

  /// Pulls the keystone up.
  void act() override {
    Vector target = position(keystone);
    target[up] += outer / 2;
    this->release();
    this->pulled_ = typename Base::Pull{simulation_.grain(keystone), target};
    acted_ = simulation_.time();
  }

 private:
  static constexpr std::size_t blocks = 13, keystone = blocks / 2;
  static constexpr double inner = 0.21, outer = 0.29, depth = 0.04, block = 0.05;  // [m]

  static double angle(double k) { return std::numbers::pi * (1 - k / double(blocks)); }
  Vector position(std::size_t k) const { return simulation_.pose(simulation_.grain(k)).position; }

  /// A part of block k between two angles and two radii [m]. Its faces inside and outside are flat:
  /// parallel to those of the block, which has the radii at its joints.
  template <class Part>
  static Part wedge(std::size_t k, double from, double to, double low, double high) {
    const double middle = angle(double(k) + 0.5), half = angle(double(k)) - middle;
    std::vector<Vector> corners;
    for (const double radius : {low, high})
      for (const double at : {from, to}) {
        const double reach = radius * std::cos(half) / std::cos(at - middle);
        Vector x = Vector::Constant(-depth);
        x[0] = reach * std::cos(at), x[up] = reach * std::sin(at);
        corners.push_back(x);
        for (int axis = 1; axis < up; ++axis) {
          x[axis] = depth;
          corners.push_back(x);
        }
      }
    return Part(std::span<const Vector>(corners));
  }
  void add_block(std::size_t k) {
    const double from = angle(double(k)), to = angle(double(k + 1));
    if constexpr (Base::is_round) {
      const double radius = (inner + outer) / 2 * std::sin((from - to) / 2);
      if (k == 0) this->add_base(ShapeT(1));
      Vector x = Vector::Zero();
      x[0] = (inner + outer) / 2 * std::cos((from + to) / 2);
      x[up] = (inner + outer) / 2 * std::sin((from + to) / 2);
      this->add_grain(0, radius, moreau::Pose<S>(x));
    } else if constexpr (moreau::CompoundShape<ShapeT>) {
      using Part = moreau::PartOf<ShapeT>;
      // Each block but the last has a tooth, which fills the groove of the next.
      const double tooth = 0.2 * (from - to), groove = k == 0 ? 0 : tooth;
      const double low = inner + (outer - inner) / 3, high = outer - (outer - inner) / 3;
      std::vector<Part> parts{wedge<Part>(k, from, to, inner, low),
                              wedge<Part>(k, from - groove, to, low, high),
                              wedge<Part>(k, from, to, high, outer)};
      if (k + 1 < blocks) parts.push_back(wedge<Part>(k + 1, to, to - tooth, low, high));
      add_wedge(ShapeT{std::span<const Part>(parts)});
    } else {
      add_wedge(wedge<ShapeT>(k, from, to, inner, outer));
    }
  }
  void add_wedge(const ShapeT& shape) {
    this->add_base(shape);
    this->add_grain(this->bases_.size() - 1, 1, moreau::Pose<S>(shape.centroid_of_input()));
  }

  void record(const moreau::StepReport& report) override {
    const auto& contacts = simulation_.contacts();
    const std::uint32_t floor = simulation_.walls()[0].value, springer = simulation_.grain(0).value;
    Vector on_floor = Vector::Zero();
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const auto& contact = contacts.points[c];
      const Vector impulse = contact.frame * contacts.impulse(c);
      if (contact.a == springer && contact.b == floor) on_floor += impulse;
      if (contact.b == springer && contact.a == floor) on_floor -= impulse;
    }
    this->add_row(simulation_.time(), crown_ - position(keystone)[up],
                  -on_floor[0] / settings_.step, -on_floor[up] / settings_.step,
                  report.solve.sweeps, report.solve.residual);
  }
  bool can_act() const override { return acted_ < 0; }
  /// The plots show the keystone and the left springer. Blocks keep their numbers only if none is removed.
  bool needs(moreau::BodyId) const override { return true; }
  std::string stage() const override {
    return std::abs(crown_ - position(keystone)[up]) < block ? "the arch carries itself"
                                                             : "the arch has fallen";
  }
  void write_walls() override {
    Vector lower = Vector::Constant(-3 * depth), upper = Vector::Constant(3 * depth);
    lower[0] = -2 * outer, upper[0] = 2 * outer;
    lower[up] = -0.01, upper[up] = 0;
    this->show_wall(lower, upper, false);
  }

  /// The button pulls for a second.
  void drive() override {
    if (acted_ < 0 || simulation_.time() < acted_ + 1) return;
    this->release();
    acted_ = -1;
  }

  double crown_ = 0, acted_ = -1;
};

}  // namespace testbed
