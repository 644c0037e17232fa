// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <doctest/doctest.h>

#include "moreau/boundary/servo.hpp"

#include "world/assemblies.hpp"

namespace scenes {

/// A lid under pressure settles on 18 grains. Then the mean pressure of the grains on the lid is the
/// prescribed one within 1 %.
template <class ShapeT>
void check_lid() {
  using Scene = BoxOfGrains<ShapeT>;
  using T = typename Scene::T;
  using Vector = typename Scene::Vector;
  Scene scene(18);
  const T h = T(5e-4), pressure = T(Scene::up == 1 ? 2e3 : 5e3);
  const BodyId lid =
      scene.simulation.add_wall(-Vector::Unit(Scene::up), T(0.2) * Vector::Unit(Scene::up));
  const double area = std::pow(0.08, double(Scene::up));
  const moreau::PressureLoad load(scene.simulation, lid, double(pressure), 0.5,
                                  [&] { return area; });
  T mean = 0;
  const int settle = 1200, last = 100;
  for (int k = 0; k < settle + last; ++k) {
    load.apply(scene.simulation, h);
    scene.simulation.step(h);
    if (k >= settle) mean += moreau::wall_pressure(scene.simulation, lid, h, T(area)) / last;
  }
  CHECK(double(mean) == doctest::Approx(double(pressure)).epsilon(0.01));
  CHECK(scene.simulation.bodies().pose[lid.index()].position[Scene::up] > T(0.02));
  // The floor carries the load of the lid and the weight of the grains, minus the friction of the
  // side walls.
  CHECK(moreau::wall_pressure(scene.simulation, scene.walls.back(), h, T(area)) > pressure / 2);
}

}  // namespace scenes
