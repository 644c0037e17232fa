// SPDX-License-Identifier: MIT
// Grains of all shapes that bounce in a box under gravity: no impact gains energy.
#include "physics/bouncing_grains.hpp"

#include <cmath>
#include <cstdio>
#include <doctest/doctest.h>
#include <random>
#include <vector>

#include "moreau/sample/ballast.hpp"
#include "moreau/sample/compound_ballast.hpp"

#include "instances/compound.hpp"

using namespace moreau;

namespace {

template <class ShapeT>
struct WorldOf {
  using type = scenes::World<ShapeT>;
};
template <class Part>
struct WorldOf<Compound<Part>> {
  using type = Simulation<Compound<Part>, SignoriniCoulomb<double>>;
};

/// Random grains; of polytopes also boxes.
template <class ShapeT>
std::vector<std::vector<ShapeT>> shapes_of() {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  if constexpr (std::is_same_v<ShapeT, BallIn<S>>) {
    return {{ShapeT(T(0.01)), ShapeT(T(0.008))}};
  } else {
    std::mt19937_64 random(8);
    std::vector<std::vector<ShapeT>> sets(1);
    for (const ShapeT& shape : ballast_shapes<ShapeT>(4, random))
      sets[0].push_back(shape.scaled(T(0.01)));
    if constexpr (Polytope<ShapeT>) {
      typename S::Vector half = S::Vector::Constant(T(0.0055));
      sets.push_back({cuboid<ShapeT>(half)});
      half[0] /= 3;
      sets[1].push_back(cuboid<ShapeT>(half));
    }
    return sets;
  }
}

}  // namespace

TEST_CASE_TEMPLATE("impacts of all shapes under gravity gain no energy", ShapeT, Disk<double>,
                   Ball<double>, Polygon<double>, Polyhedron<double>, Compound<Polygon<double>>,
                   Compound<Polyhedron<double>>, Polygon<float>, Polyhedron<float>) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  const double rounding = 1e-9;
  bouncing::Tally all;
  all.kept = 1;
  for (const auto& shapes : shapes_of<ShapeT>())
    for (const double restitution : {0.0, 0.3, 0.7, 1.0})
      for (const double friction : {0.0, 0.5})
        for (const double ratio : {1.0, 1e4})
          for (const double step : {1e-4, 5e-4}) {
            bouncing::Box box;
            box.restitution = restitution, box.friction = friction, box.mass_ratio = ratio;
            box.step = step;
            box.steps = 500;
            const auto tally = bouncing::count<typename WorldOf<ShapeT>::type>(box, shapes);
            CAPTURE(restitution);
            CAPTURE(friction);
            CAPTURE(ratio);
            CAPTURE(step);
            CHECK(tally.worst <= rounding);
            all.steps += tally.steps;
            all.unsolved += tally.unsolved;
            all.worst = std::max(all.worst, tally.worst);
          }
  std::printf("%s %s: %d steps, %d unsolved, largest gain %.1e\n",
              SpaceOf<ShapeT>::dim == 2 ? "plane" : "space", sizeof(T) == 4 ? "float" : "double",
              all.steps, all.unsolved, all.worst);
}
