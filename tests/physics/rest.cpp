// SPDX-License-Identifier: MIT
// A packing at rest remains at rest. The same test over twenty seconds is in long/rest.cpp.
#include <limits>

#include "physics/packing.hpp"
#include "physics/static_friction.hpp"
#include "sanitized.hpp"

using moreau::Polygon;
using moreau::Polyhedron;

TEST_CASE_TEMPLATE("a packing of 60 grains at rest: overlap and motion do not grow in 2 s", ShapeT,
                   Polyhedron<>, Polygon<>) {
  packing::check_rests<ShapeT>(2.0 / sanitizer_share);
}

// A box that is placed on the floor moves only because of the residual. In the natural map a point inside of its cone does not
// change its velocity, so that the velocities u of its n points have |u| <= e (2-norm over all of them), with e = 1e-8 |r| w
// and the mean w of the diagonal of W. For a cube with m g h / n at each corner of its lower face, w is 4/m in space and
// 2.5/m in the plane: e is at most 1e-8 times 2 g h. With the velocity v of the centre of the face, the spin
// omega and half the size a, |u|^2 >= n (|v|^2 + a^2 |omega|^2), so that |v| + a |omega| <= sqrt(2/n) e. This bounds the velocity
// of the centre of the box, which is a above the face, and a |omega|. To e adds the rounding of the gap, over h. In 0.7 s the
// box moves by less than 1e-9 m with the largest step. If the box is dropped, the gap
// closes with an error of first order in the step. The overlap correction reduces overlaps beyond
// its slop by a factor of 0.8 in each step. So, for any step, the overlap at rest lies in [0,
// slop].
TEST_CASE_TEMPLATE("the gap of a box at rest does not follow the step", ShapeT, Polyhedron<>,
                   Polygon<>) {
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  constexpr double size = 0.1;
  const double slop = moreau::OverlapCorrectionOptions{}.slop * size;
  moreau::ColouredOptions options;
  options.tolerance = 1e-8;
  for (const double tilt : {0.0, 0.1})
    for (const double height : {0.0, 0.02})
      for (const double h : {1e-2, 1e-3, 1e-4, 1e-5}) {
        if (tilt > 0 && height == 0) continue;
        if (h < 1e-4 && tilt == 0) continue;  // one with 70,000 steps
        if (h < 1e-3 && sanitizer_share > 1) continue;
        scenes::World<ShapeT> simulation(size,
                                         moreau::Materials<packing::Law>(1, packing::Law(0.5)),
                                         moreau::ColouredGaussSeidel(options));
        simulation.set_contact_points(moreau::ContactPoints::all);
        const ShapeT box = scenes::cuboid<ShapeT>(Vector::Constant(size / 2));
        moreau::Pose<S> pose;
        pose.position[up] = size / 2 + height;
        pose.rotation = S::exp(S::Angular::Constant(tilt));
        const auto grain = simulation.add_grain(simulation.add_shape(box), pose, 1000);
        simulation.add_wall(Vector::Unit(up), Vector::Zero());
        simulation.set_gravity(-9.81 * Vector::Unit(up));
        moreau::StepReport report;
        while (simulation.time() < 0.7) report = simulation.step(h);
        const double lowest = [&] {
          double least = 1;
          for (const auto& row : box.vertices().rowwise())
            least = std::min(least, simulation.pose(grain)(row.transpose())[up]);
          return least;
        }();
        CAPTURE(tilt);
        CAPTURE(height);
        CAPTURE(h);
        const double rounding = 16 * std::numeric_limits<double>::epsilon() * size / h;
        const double allowed = options.tolerance * 2 * 9.81 * h + rounding;
        CHECK(report.solve.converged);
        CHECK(simulation.velocity(grain).norm() <= allowed);
        CHECK(simulation.spin(grain).norm() * size / 2 <= allowed);
        CHECK(lowest < 1e-9);
        CHECK(lowest > (height == 0 ? -1e-9 : -1.01 * slop));
      }
}

TEST_CASE_TEMPLATE("a face that does not slide holds up to its static friction", ShapeT,
                   Polyhedron<>, Polygon<>) {
  for (const double lever : {0.0, 0.7})
    for (const bool islands : {true, false}) {
      static_friction::Options options;
      options.lever = lever;
      options.islands = islands;
      static_friction::check<ShapeT>(options);
    }
  static_friction::Options options;
  options.incline = true;
  static_friction::check<ShapeT>(options);
}

TEST_CASE_TEMPLATE(
    "a block slides with its own friction beside a heavier one that it does not touch", ShapeT,
    Polyhedron<>, Polygon<>) {
  for (const double ratio : {1.0, 1e3, 1e6})
    for (const double step : {1e-3, 1.0 / 60})
      for (const bool islands : {true, false})
        static_friction::check_beside<ShapeT>(ratio, step, islands);
}
