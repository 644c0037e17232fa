// SPDX-License-Identifier: MIT
// Grains that bounce in a box under gravity, by shape, restitution, friction, masses and step: no impact gains energy.
#include "physics/bouncing_grains.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <doctest/doctest.h>
#include <random>
#include <vector>

#include "moreau/sample/ballast.hpp"

using namespace moreau;

namespace {

/// Random grains; of polytopes also boxes.
template <class ShapeT>
std::vector<std::vector<ShapeT>> shapes_of() {
  using S = SpaceOf<ShapeT>;
  if constexpr (Polytope<ShapeT>) {
    std::mt19937_64 random(8);
    std::vector<std::vector<ShapeT>> sets(2);
    for (const ShapeT& shape : ballast_shapes<ShapeT>(4, random))
      sets[0].push_back(shape.scaled(0.01));
    typename S::Vector half = S::Vector::Constant(0.0055);
    sets[1].push_back(cuboid<ShapeT>(half));
    half[0] /= 3;
    sets[1].push_back(cuboid<ShapeT>(half));
    return sets;
  } else {
    return {{ShapeT(0.01), ShapeT(0.008)}};
  }
}

}  // namespace

TEST_CASE_TEMPLATE("impacts of many shapes under gravity gain no energy", ShapeT, Disk<double>,
                   Ball<double>, Polygon<double>, Polyhedron<double>) {
  bouncing::Tally all;
  bouncing::Box box;
  box.steps = 500;
  for (const auto& shapes : shapes_of<ShapeT>())
    for (const double restitution : {0.0, 0.3, 0.7, 1.0})
      for (const double friction : {0.0, 0.5})
        for (const double ratio : {1.0, 1e4})
          for (const double step : {1e-4, 5e-4}) {
            box.restitution = restitution, box.friction = friction, box.mass_ratio = ratio;
            box.step = step;
            const auto tally = bouncing::count<scenes::World<ShapeT>>(box, shapes);
            CAPTURE(restitution);
            CAPTURE(friction);
            CAPTURE(ratio);
            CAPTURE(step);
            CHECK(tally.worst <= 1e-9);
            // The inertia of uneven grains turns: restitution takes the spin at the impact.
            if (restitution == 1 && friction == 0 && tally.unsolved == 0)
              CHECK(std::abs(tally.kept - 1) <= 1e-4);
            all.steps += tally.steps;
            all.unsolved += tally.unsolved;
            all.beyond += tally.beyond;
            all.worst = std::max(all.worst, tally.worst);
          }
  CHECK(1000 * all.beyond <= all.steps);
  std::printf("%s: %d steps, %d unsolved, %d beyond the lift of contacts at rest\n",
              SpaceOf<ShapeT>::dim == 2 ? "plane" : "space", all.steps, all.unsolved, all.beyond);
}
