// SPDX-License-Identifier: MIT
// A capsule that friction holds between two pads.
#include "moreau/shape/capsule.hpp"

#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <span>
#include <type_traits>

#include "sanitized.hpp"
#include "world/assemblies.hpp"

TEST_CASE("a capsule does not swing down between pads, however light they are") {
  using Capsule = moreau::Capsule<double>;
  using Vector = moreau::Space<3>::Vector;
  constexpr double radius = 0.004, mass = 0.045, weight = 9.81;
  const Capsule capsule(0.02, radius);
  // Near rounding a step may be reported as unsolved; the pressures are even nevertheless.
  // Steps of 0.01 and 0.001 times the root of the diameter over g: Newton's method ends at rounding in other places.
  for (const auto& variant :
       {std::array{1.0, 12.0, 0.0, 2e-4}, std::array{1e-3, 12.0, 0.0, 2e-4},
        std::array{1.0, 60.0, 0.0, 2e-4}, std::array{1e-3, 60.0, 0.0, 2e-4},
        std::array{1e-3, 12.0, 1e-8, 2e-4}, std::array{1e-3, 12.0, 1e-10, 2e-4},
        std::array{1e-3, 60.0, 1e-12, 2e-4}, std::array{1e3, 12.0, 1e-12, 2e-4},
        std::array{1e-3, 12.0, 1e-12, 2.856e-4}, std::array{1e-3, 12.0, 1e-10, 2.827e-4},
        std::array{1e-3, 12.0, 1e-10, 2.856e-5}}) {
    const double ratio = variant[0], force = variant[1], tolerance = variant[2], h = variant[3];
    CAPTURE(h);
    CAPTURE(ratio);
    CAPTURE(force);
    CAPTURE(tolerance);
    moreau::ColouredOptions options;
    if (tolerance > 0) {
      options.tolerance = options.velocity_tolerance = tolerance;
      options.max_sweeps = 20000;
    }
    scenes::LawOf<Capsule> law(0.7);
    moreau::Simulation<Capsule, scenes::LawOf<Capsule>> world(2 * radius, law,
                                                              moreau::ColouredGaussSeidel(options));
    world.set_gravity({0, 0, -weight});
    moreau::Pose<moreau::Space<3>> pose;  // its axis along y
    pose.rotation = moreau::Space<3>::exp(Vector(0, 0, std::numbers::pi / 2));
    const auto grain =
        world.add_grain(world.add_shape(capsule), pose, mass / capsule.mass_properties(1).mass);
    for (const double side : {-1.0, 1.0}) {
      const auto pad = world.add_wall(-side * Vector::UnitX(), side * radius * Vector::UnitX());
      world.set_wall_mass(pad, ratio * mass);
      world.set_force(pad, -side * force * Vector::UnitX());
    }
    for (int k = 0; k < rounds(1500); ++k) CHECK((world.step(h).solve.converged || tolerance > 0));
    CHECK(world.pose(grain).position.norm() < 1e-3 * radius);
    CHECK(
        (world.pose(grain).rotation.toRotationMatrix() - pose.rotation.toRotationMatrix()).norm() <
        1e-3);
  }
}

namespace {

struct Grip {
  double size, ratio, share, tolerance, load;  // load over the weight; step over sqrt(size / g)
};
constexpr std::array doubles{
    Grip{1e-6, 1e-3, 1e-2, 1e-12, 27.183},
    Grip{2.3667751497214843e-06, 1e-3, 0.013698421787960323, 1e-12, 13.47355533305694},
    Grip{0.00013335368133004223, 1e-3, 0.011162506773691735, 1e-10, 3.3134080116866764},
    Grip{0.0037389908481047611, 1e-3, 0.017908650275911948, 1e-8, 148.58017616003644},
    Grip{0.00021684023483337995, 1e-3, 0.0012097404342915944, 1e-13, 7.4971719100261263},
    Grip{8.149156900400687, 1e-3, 0.0010056527590775162, 1e-13, 14.364822561323459},
    Grip{6.0351895837619098e-06, 0.1, 0.0042565556542343884, 1e-12, 1.0839338778106984},
    Grip{6.0351895837619098e-06, 1e3, 0.0042565556542343884, 1e-12, 1.0839338778106984},
    Grip{0.079149228184516543, 1e3, 0.0042425296808690826, 1e-12, 1.1019062603062113},
    Grip{0.12615303358321484, 1e3, 0.0021028674727020824, 1e-12, 1.0615482268347947}};
constexpr std::array floats{
    Grip{274.57692871089745, 1e-3, 0.0047123625432907634, 1e-10, 7.0182532182501243},
    Grip{0.0034393849393976254, 1e-3, 0.010268231212729077, 1e-10, 30.136859225093993},
    Grip{0.00023080965873593194, 1e-3, 0.013370390471741047, 1e-10, 3.6371979454918915},
    Grip{0.0016492145813395765, 1e-3, 0.0019499946976345699, 1e-10, 1.6635763698023531},
    Grip{418.04550241518183, 1e-3, 0.0018593679593042862, 1e-10, 2.0605095825173612}};

}  // namespace

// Found among 300 random grips for each mass ratio and tolerance: Newton's method ends at rounding in a line search that
// leads nowhere, or above a tolerance that the sweeps have met.
TEST_CASE_TEMPLATE("a capsule between light pads keeps even pressures that end in rounding", T,
                   double, float) {
  using Capsule = moreau::Capsule<T>;
  using S = moreau::Space<3, T>;
  using Vector = typename S::Vector;
  using Law = moreau::SignoriniCoulomb<T>;
  constexpr double weight = 9.81;
  const bool is_double = std::is_same_v<T, double>;
  for (const Grip& grip : is_double ? std::span<const Grip>(doubles) : floats) {
    CAPTURE(grip.size);
    CAPTURE(grip.ratio);
    CAPTURE(grip.tolerance);
    const double mass = 0.045 * std::pow(grip.size / 0.008, 3),
                 h = grip.share * std::sqrt(grip.size / weight);
    const Capsule capsule(T(2.5 * grip.size), T(grip.size / 2));
    moreau::ColouredOptions options;
    options.tolerance = options.velocity_tolerance = grip.tolerance;
    options.max_sweeps = 20000;
    moreau::Simulation<Capsule, Law> world(T(grip.size), moreau::Materials<Law>(1, Law(T(0.7))),
                                           moreau::ColouredGaussSeidel(options));
    world.set_gravity({0, 0, T(-weight)});
    moreau::Pose<S> pose;  // its axis along y
    pose.rotation = S::exp(Vector(0, 0, T(std::numbers::pi / 2)));
    const auto grain = world.add_grain(world.add_shape(capsule), pose,
                                       T(mass / double(capsule.mass_properties(1).mass)));
    for (const T side : {T(-1), T(1)}) {
      const auto pad =
          world.add_wall(-side * Vector::UnitX(), side * T(grip.size / 2) * Vector::UnitX());
      world.set_wall_mass(pad, T(grip.ratio * mass));
      world.set_force(pad, -side * T(grip.load * mass * weight) * Vector::UnitX());
    }
    for (int k = 0; k < 4; ++k) world.step(T(h));
    const double fall = double(world.velocity(grain).norm()),
                 turn = double(world.spin(grain).norm()) * grip.size;
    CHECK(fall + turn < 1e-4 * weight * h);
  }
}
