// SPDX-License-Identifier: MIT
// A finite plate with waves, which is a wall of triangles, in the plane of segments. Grains fall on it, and over
// its edge to a floor.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "moreau/mesh/facet_mesh.hpp"
#include "moreau/sample/random_deposition.hpp"

#include "scene.hpp"

namespace testbed {

template <class ShapeT>
class Plate final : public Scene<ShapeT> {
  using Base = Scene<ShapeT>;
  using Base::settings_, Base::simulation_, Base::random_, Base::up;
  using typename Base::S, typename Base::Vector;
  using Mesh = moreau::FacetMesh<S>;

 public:
  explicit Plate(const Settings& settings) : Base(settings, Base::smallest_size(), 0.1) {
    this->draw_bases(24);
    const std::vector<double> radii = this->draw_radii();
    auto poses = moreau::random_deposition<S>(radii, half, random_);
    double top = 0;
    for (std::size_t k = 0; k < poses.size(); ++k) {
      // The floor of the deposition is a square beside the origin.
      for (int axis = 0; axis < up; ++axis) poses[k].position[axis] -= half / 2;
      poses[k].position[up] += 2 * wave;
      top = std::max(top, double(poses[k].position[up]));
      this->add_grain(k % this->bases_.size(), radii[k], poses[k]);
    }
    const Mesh mesh = surface();
    plate_ = simulation_.add_mesh_wall(mesh, {}, moreau::WallSides::both, Base::rough());
    simulation_.add_wall(Vector::Unit(up), -drop * Vector::Unit(up), Base::rough());
    show(mesh);
    this->set_gravity();
    Vector lower = Vector::Constant(-1.6 * half), upper = -lower;
    lower[up] = -drop, upper[up] = std::min(top + 0.05, 3 * half);
    this->set_bounds(lower, upper);
    this->channels_ = {{"t", "time", "s", 1},
                       {"x", "grains on the plate", "", 1},
                       {"energy", "kinetic energy", "J", 1},
                       {"sweeps", "sweeps", "per step", 1},
                       {"residual", "residual", "-", 1}};
    this->plots_ = {{"Grains on the plate", 0, 1, -1, false, false},
                    {"Kinetic energy", 0, 2, -1, false, false},
                    {"Solver: sweeps and residual of each step", 0, 3, 4, true, false}};
  }

  /// Lets the grains slide to one side for a second: gravity is tilted by 25 degrees.
  void act() override { tilted_ = simulation_.time(); }

 private:
  static constexpr double half = 0.25, wave = 0.01, drop = 0.15;  // [m]
  static constexpr int cells = 10;

  /// Height of the plate [m].
  static double height(const Vector& x) {
    double z = wave;
    for (int axis = 0; axis < up; ++axis) z *= std::cos(3 * std::numbers::pi * x[axis] / half);
    return z;
  }
  static Mesh surface() {
    Mesh mesh;
    const int side = cells + 1, rows = up == 1 ? 1 : side;
    for (int k = 0; k < side * rows; ++k) {
      Vector x = Vector::Zero();
      x[0] = (2. * (k % side) / cells - 1) * half;
      for (int axis = 1; axis < up; ++axis) x[axis] = (2. * (k / side) / cells - 1) * half;
      x[up] = height(x);
      mesh.vertices.push_back(x);
    }
    const auto corner = [&](int i, int j) { return static_cast<std::uint32_t>(i + side * j); };
    for (int i = 0; i < cells; ++i) {
      if constexpr (S::dim == 2) {
        mesh.facets.push_back({corner(i + 1, 0), corner(i, 0)});
      } else {
        for (int j = 0; j < cells; ++j) {
          mesh.facets.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
          mesh.facets.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
        }
      }
    }
    return mesh;
  }
  /// The triangles of the picture; in the plane a band below each segment.
  void show(const Mesh& mesh) {
    for (const auto& facet : mesh.facets) {
      const auto& v = mesh.vertices;
      if constexpr (S::dim == 2) {
        const Vector a = v[facet[0]], b = v[facet[1]],
                     down = -Base::wall_thickness * Vector::Unit(up);
        for (const Vector& x : {a, b, Vector(b + down), a, Vector(b + down), Vector(a + down)})
          push(this->ground_, x);
      } else {
        for (const std::uint32_t k : facet) push(this->ground_, v[k]);
      }
    }
  }

  void adopt() override { tilt(tilted_ >= 0); }
  void tilt(bool on) {
    const double angle = on ? 25 * std::numbers::pi / 180 : 0;
    Vector g = -std::cos(angle) * settings_.gravity * Vector::Unit(up);
    g[0] = std::sin(angle) * settings_.gravity;
    simulation_.set_gravity(g);
  }
  void drive() override {
    if (tilted_ >= 0 && simulation_.time() > tilted_ + 1) tilted_ = -1;
    tilt(tilted_ >= 0);
  }
  bool can_act() const override { return tilted_ < 0; }
  void record(const moreau::StepReport& report) override {
    int on = 0;
    for (const moreau::BodyId grain : simulation_.grains())
      on += simulation_.pose(grain).position[up] > 0;
    this->add_row(simulation_.time(), on, this->kinetic_energy(), report.solve.sweeps,
                  report.solve.residual);
  }
  std::string stage() const override { return tilted_ >= 0 ? "gravity is tilted" : ""; }
  void write_walls() override {
    Vector lower = Vector::Constant(-2 * half), upper = -lower;
    lower[up] = -drop - 0.01, upper[up] = -drop;
    this->show_wall(lower, upper, false);
  }

  double tilted_ = -1;
  moreau::BodyId plate_;
};

}  // namespace testbed
