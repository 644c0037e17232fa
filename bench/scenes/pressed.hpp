// SPDX-License-Identifier: MIT
// Grains poured into a box and pressed by a wall whose force oscillates.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "moreau/sample/ballast.hpp"
#include "moreau/sample/random_deposition.hpp"
#include "moreau/sample/size_distribution.hpp"

#include "measure.hpp"

namespace scenes {

/// 1,200 random grains with radii of 2.5, 3.75 and 5 cm, each with a shape of its own, poured one after the other
/// into a box with a floor of 0.5 m x 0.5 m, in the plane of 2 m. A wall of 50 kg presses them from above by 3 kN, then by
/// 3 + 3 sin(2 pi 5 t) kN. Friction 0.5 between grains and 0 at walls, no restitution, h = 2e-4 s.
template <class ShapeT>
Scene<ShapeT> pressed_box(const Options& options) {
  using Made = Scene<ShapeT>;
  using S = typename Made::S;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using World = typename Made::World;
  constexpr int up = S::dim - 1;
  constexpr Scalar length(S::dim == 3 ? 0.5 : 2);
  const std::size_t count = options.size > 0 ? std::size_t(options.size) : 1200;

  std::mt19937_64 random(1);
  Grains<ShapeT> grains;
  std::vector<Scalar> radii;
  for (const double radius : SizeDistribution::azema2008().sample(count, random))
    radii.push_back(static_cast<Scalar>(radius));
  std::shuffle(radii.begin(), radii.end(), random);
  for (const Scalar radius : radii)
    grains.shapes.push_back(Ballast<ShapeT>::draw(random).scaled(radius));
  grains.poses = random_deposition<S>(radii, length, random);

  Materials<typename Made::Law> materials(2, typename Made::Law(0));
  materials.set(MaterialId(0), MaterialId(0), typename Made::Law(Scalar(0.5)));
  auto world =
      std::make_unique<World>(Scalar(0.05), materials, solver(options),
                              tolerances(Tolerances{}.margin, options), options.correction);
  grains.add_to(*world, 2700, options);
  Scalar top = 0;
  for (std::size_t k = 0; k < count; ++k)
    top = std::max(top, grains.poses[k].position[up] + radii[k]);
  const MaterialId smooth(1);
  for (int axis = 0; axis < S::dim; ++axis)
    world->add_wall(Vector::Unit(axis), Vector::Zero(), smooth);
  for (int axis = 0; axis < up; ++axis)
    world->add_wall(-Vector::Unit(axis), length * Vector::Unit(axis), smooth);
  const BodyId lid = world->add_wall(-Vector::Unit(up), top * Vector::Unit(up), smooth);
  world->set_gravity(Scalar(-9.81) * Vector::Unit(up));

  Made scene{std::move(world), Scalar(2e-4), 400, 1000};
  scene.prepare = [=](World& box) {
    constexpr auto coarse = static_cast<Scalar>(5e-4);
    box.set_velocity(lid, -Vector::Unit(up));
    for (Scalar reaction = 0; reaction < 3000;) {
      box.step(coarse);
      reaction += Scalar(0.1) * (box.contact_impulse(lid)[up] / coarse - reaction);
    }
    box.set_velocity(lid, Vector::Zero());
    box.set_wall_mass(lid, 50);
    box.set_force(lid, Scalar(-3000) * Vector::Unit(up));
    for (int k = 0; k < 600; ++k) box.step(coarse);
  };
  scene.begin = [=](World& box) { box.set_wall_mass(lid, 50); };
  scene.drive = [=](World& box, double t) {
    const double force = 3000 * (1 + std::sin(2 * std::numbers::pi * 5 * t));
    box.set_force(lid, static_cast<Scalar>(-force) * Vector::Unit(up));
  };
  return scene;
}

}  // namespace scenes
