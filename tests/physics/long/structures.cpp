// SPDX-License-Identifier: MIT
// The structures of ../structures.cpp, but larger and for ten seconds.
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/solve/proximal_fallback.hpp"

#include "physics/standing.hpp"
#include "physics/static_friction.hpp"

using moreau::Polygon;
using moreau::Polyhedron;

namespace {
constexpr double step = 5e-3;
constexpr int settle = 20, ten_seconds = 2000;
}  // namespace

// For the bending of a slender column, sweeps converge slowly: after 10000 sweeps the residual is
// 1e-6.
TEST_CASE_TEMPLATE("a column of 40 boxes stands for ten seconds", ShapeT, Polyhedron<>, Polygon<>) {
  auto structure = masonry::column<ShapeT, moreau::ProximalFallback<>>(40);
  masonry::check_stands(structure, step, settle, ten_seconds);
}

TEST_CASE_TEMPLATE("a wall of 500 bricks stands for ten seconds", ShapeT, Polyhedron<>, Polygon<>) {
  // Every second of the 20 courses has two half bricks in place of one brick.
  auto structure = masonry::wall<ShapeT>(20, 25);
  structure.simulation.set_solver(moreau::ColouredGaussSeidel(masonry::tight(200000)));
  masonry::check_stands(structure, step, settle, ten_seconds);
}

TEST_CASE_TEMPLATE("a card house stands for ten seconds", ShapeT, Polyhedron<>, Polygon<>) {
  auto structure = masonry::card_house<ShapeT>(1.5 * masonry::card_friction);
  masonry::check_stands(structure, step, settle, ten_seconds);
}

TEST_CASE_TEMPLATE("an arch of 41 voussoirs stands for ten seconds", ShapeT, Polyhedron<>,
                   Polygon<>) {
  auto structure = masonry::arch<ShapeT>(41, 0.2);
  masonry::check_stands(structure, step, settle, ten_seconds);
}

// Without friction nothing resists a light cube under one that is a thousand times heavier: errors of rounding tilt it,
// and the load accelerates it. It moves by 1 % of its size in a minute and more at 1 ms, in half a minute at 1/60 s.
TEST_CASE_TEMPLATE("structures stand for a minute with the default options", ShapeT, Polyhedron<>,
                   Polygon<>) {
  for (const double h : {1e-3, 1.0 / 60}) {
    const auto steps = [h](double time) { return static_cast<int>(time / h); };
    for (const int cubes : {10, 20, 30, 50})
      for (const double jitter : {0.0, 0.005})
        masonry::check_stands_by_default(masonry::stack<ShapeT>(cubes, 0.5, jitter), h, steps(60));
    for (const double ratio : {1e3, 1e2, 1e-3})
      for (const double friction : {0.0, 0.5})
        masonry::check_stands_by_default(masonry::stack<ShapeT>(2, friction, 0, ratio), h,
                                         steps(ratio == 1e3 && friction == 0 ? 15 : 60));
    for (const int stones : {11, 21, 31, 51})
      masonry::check_stands_by_default(masonry::arch<ShapeT>(stones, 0.2), h, steps(60));
    masonry::check_stands_by_default(masonry::wall<ShapeT>(3, 4), h, steps(60));
    masonry::check_stands_by_default(masonry::card_house<ShapeT>(1.5 * masonry::card_friction), h,
                                     steps(60));
  }
}

TEST_CASE_TEMPLATE("structures stand with the default options in single precision", ShapeT,
                   Polyhedron<float>, Polygon<float>) {
  for (const double h : {1e-3, 1.0 / 60}) {
    const int count = static_cast<int>(5 / h);
    for (const int cubes : {2, 10, 20, 30, 50}) {
      if (cubes > 20 && h < 1e-2) continue;
      for (const double jitter : {0.0, 0.005})
        masonry::check_stands_by_default(masonry::stack<ShapeT>(cubes, 0.5, jitter), h, count);
    }
    for (const double ratio : {1e3, 1e-3})
      masonry::check_stands_by_default(masonry::stack<ShapeT>(2, 0.5, 0, ratio), h, count);
    // Larger arches stand as well, but with 1 ms more than 1 % of the steps are reported as unsolved.
    masonry::check_stands_by_default(masonry::arch<ShapeT>(11, 0.2), h, count);
    masonry::check_stands_by_default(masonry::wall<ShapeT>(3, 4), h, count);
    masonry::check_stands_by_default(masonry::card_house<ShapeT>(1.5 * masonry::card_friction), h,
                                     count);
  }
}

TEST_CASE_TEMPLATE("faces hold up to their static friction", ShapeT, Polyhedron<>, Polygon<>,
                   Polyhedron<float>, Polygon<float>) {
  for (const double step : {1e-2, 1e-3, 1e-4, 1e-5})
    for (const bool incline : {false, true})
      for (const bool islands : {true, false})
        for (const double height : {0.05, 0.02}) {
          static_friction::Options options;
          options.step = step;
          options.rate = std::min(0.5, 1e-3 / step);
          options.incline = incline;
          options.islands = islands;
          options.height = height;
          static_friction::check<ShapeT>(options);
        }
  for (const int corners : {3, 4, 5, 6, 8})
    for (const double azimuth : {0.1, 0.6})
      for (const double lever : {-0.7, 0.0, 0.7})
        for (const bool islands : {true, false})
          for (const bool few : {false, true}) {
            if (moreau::SpaceOf<ShapeT>::dim == 2 && (corners > 3 || azimuth > 0.1)) continue;
            if (few && (corners == 4 || corners == 5)) continue;  // three of them: the block tips
            static_friction::Options options;
            options.corners = corners;
            options.azimuth = moreau::SpaceOf<ShapeT>::dim == 3 ? azimuth : 0;
            options.lever = lever;
            options.islands = islands;
            options.few = few;
            static_friction::check<ShapeT>(options);
          }
  for (const double tolerance : {1e-3, 1e-5, 1e-6, 1e-8}) {
    static_friction::Options options;
    options.tolerance = tolerance;
    options.islands = false;
    static_friction::check<ShapeT>(options);
  }
}
