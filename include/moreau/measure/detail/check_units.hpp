// SPDX-License-Identifier: MIT
// The part of check() that looks for numbers in other units than SI, for an attraction that the margin cuts off, and for
// gravity that is missing or has the wrong sign.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <type_traits>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/measure/detail/check_report.hpp"
#include "moreau/shape/circumradius.hpp"
#include "moreau/shape/smallest_width.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau::detail {

/// The extremes over the grains that move freely and over the laws that are judged. Grains whose motion is prescribed
/// are obstacles: their mass has no effect, and their size can be that of a machine.
struct Extremes {
  double width = std::numeric_limits<double>::infinity();  ///< smallest circumdiameter [m]
  /// Smallest width of a grain, smallest_width() [m]; only if all circumdiameters are far above the grain size.
  double thickness = 0;
  double density = std::numeric_limits<double>::infinity();   ///< smallest [kg/m^3]
  double heaviest = 0;                                        ///< largest density [kg/m^3]
  double lightest = std::numeric_limits<double>::infinity();  ///< smallest mass [kg]
  double friction = 0;  ///< largest of the laws from 5 to 90, else 0
  double gravity = 0;   ///< its length [m/s^2]
  double step = 0;      ///< h [s]
  /// Whether the grain size is not below the smallest width of a grain.
  bool thickness_fits(double size) const { return 0.999 * thickness <= size; }
};

[[gnu::cold]] inline void judge(Findings& found, const Extremes& of, double size) {
  const bool earth = of.gravity > 9 && of.gravity<11, grains = of.heaviest> 0;
  // For a plate or a stick any length between thickness and diameter is accepted, also among larger grains.
  const bool fits = of.width > 0.2 * size && (of.width < 5 * size || of.thickness_fits(size));
  if (grains && !fits)
    found.say(
        "grain size % m, but the ball around the smallest grain has a diameter of % m; all "
        "tolerances are relative to the grain size",
        {size, of.width});
  if (grains && fits && earth && of.width > 4)
    found.say("all grains are wider than % m. If lengths are in mm, divide them by 1000: % m",
              {of.width, of.width / 1000});
  if (grains && earth && of.density < 12)
    found.say(
        "a density of % kg/m^3 is that of no grain (in the plane % kg/m^2: of none 1 m thick). If "
        "it is in g/cm^3, type %; in the plane it is right for thin disks",
        {of.density, of.density, 1000 * of.density});
  if (of.heaviest > 25000)
    found.say(
        "a density of % kg/m^3 (in the plane kg/m^2) is above that of every solid. If it is in "
        "g/m^3, "
        "type %",
        {of.heaviest, of.heaviest / 1000});
  for (const double factor : {100.0, 1000.0})
    if (std::abs(of.gravity / (9.81 * factor) - 1) < 0.02)
      found.say("a gravity of % m/s^2 is % times that of the earth. If it is in % m/s^2, type %",
                {of.gravity, factor, 1 / factor, of.gravity / factor});
  // Far above each step that is of use: falling from rest, a grain passes 10 margins of detection (0.02 of the
  // grain size by default) in its first step. A packing at rest shows nothing of it: nothing approaches.
  const double fall = of.gravity * of.step * of.step, shortest = std::min(of.width, size);
  if (grains && fall > 0.2 * shortest)
    found.say(
        "a step of % s is too long: in one step a grain at rest falls by g h^2 = % m, which is % "
        "of "
        "the grain size. If it is in ms, type %",
        {of.step, fall, fall / shortest, of.step / 1000});
  if (of.friction > 0)
    found.say("a friction of % looks like an angle in degrees: its tangent is %",
              {of.friction, std::tan(of.friction * std::numbers::pi / 180)});
}

/// Whether a wall or an obstacle can hold a grain that gravity pulls: a half-space that faces it, a
/// cylinder, or a corner of a mesh or an obstacle that lies farther along gravity than the first grain.
template <class Simulation>
[[gnu::cold]] bool is_held(const Simulation& simulation) {
  using Vector = typename Simulation::Vector;
  using Scalar = typename Simulation::Scalar;
  const Vector gravity = simulation.gravity();
  const auto& bodies = simulation.bodies();
  if (!simulation.cylinders().empty()) return true;
  for (const BodyId wall : simulation.walls())
    if (Vector(bodies.axes(wall.index()).col(0)).dot(gravity) < Scalar(-0.1) * gravity.norm())
      return true;
  Scalar first = std::numeric_limits<Scalar>::infinity(), last = -first;
  for (const BodyId grain : simulation.grains()) {
    const Scalar depth = gravity.dot(bodies.pose[grain.index()].position);
    if (bodies.is_prescribed(grain.index()))
      last = std::max(last, depth);
    else
      first = std::min(first, depth);
  }
  for (const auto& mesh : simulation.mesh_walls())
    for (const Vector& vertex : mesh.shape.mesh().vertices)
      last = std::max(last, gravity.dot(bodies.pose[mesh.body.index()](vertex)));
  return last > first || !(first < std::numeric_limits<Scalar>::infinity());
}

/// Gravity that points elsewhere than down the last axis, along an axis that is not periodic, to where nothing can hold
/// a grain. A free fall down the last axis is what its user sees.
template <class Simulation>
MOREAU_INLINED inline void check_direction(Findings& found, const Simulation& simulation) {
  constexpr int last = Simulation::S::dim - 1;
  const typename Simulation::Vector gravity = simulation.gravity();
  const double length = double(gravity.norm()), up = double(gravity[last]);
  int axis = last;
  for (int k = 0; k < last; ++k)
    if (std::abs(gravity[k]) > std::abs(gravity[axis])) axis = k;
  if (up <= -length / 2 || simulation.cell().is_periodic(axis) || is_held(simulation)) return;
  if (up > length / 2)
    found.say(
        "gravity points along the last axis (% m/s^2), and no wall and no obstacle lies there. If "
        "the last axis points up, type %",
        {up, -up});
  else
    found.say(
        "gravity has % m/s^2 along axis % (x is 0), and no wall and no obstacle lies there. If the "
        "last axis points up, it is % m/s^2 along axis %",
        {double(gravity[axis]), double(axis), -length, double(last)});
}

/// An attraction that is not 0 at the margin, of a law that does not say how far it reaches.
template <class Simulation>
[[gnu::cold]] void check_range([[maybe_unused]] Findings& found,
                               [[maybe_unused]] const Simulation& simulation) {
  using S = typename Simulation::S;
  using Scalar = typename S::Scalar;
  using Law = std::remove_cvref_t<decltype(simulation.materials().laws()[0])>;
  if constexpr (AttractiveLaw<Law, S> && !AttractsInRange<Law, S> &&
                requires(const Law law) { law.attraction(Scalar{}); }) {
    const Scalar margin = simulation.tolerances().lengths(simulation.grain_size()).margin;
    Scalar most = 0;
    for (const Law& law : simulation.materials().laws())
      most = std::max(most, law.attraction(Scalar(1.001) * margin));
    if (most > 0)
      found.say(
          "a law attracts with % N at the margin of detection, % m, beyond which pairs have no "
          "contacts: the attraction ends there. Give the law a function range() that returns the "
          "largest gap with an attraction [m]",
          {double(most), double(margin)});
  }
}

/// A step that does not resolve an impact of two of the lightest grains, under a law that says how long it lasts. With a
/// fifth of the duration the restitution of LinearSpringDashpot is wrong by up to 0.1, with a third by up to 0.4; that of
/// HertzMindlin by up to 0.08 and 1, and with a half the speed is doubled and more.
/// @param of       lightest: mass of a grain [kg], width: of a grain [m]
/// @param approach largest approach velocity of the contacts of the step [m/s]
template <class Simulation>
[[gnu::cold]] void check_duration([[maybe_unused]] Findings& found,
                                  [[maybe_unused]] const Simulation& simulation,
                                  [[maybe_unused]] const Extremes& of,
                                  [[maybe_unused]] double approach) {
  using Scalar = typename Simulation::Scalar;
  using Law = std::remove_cvref_t<decltype(simulation.materials().laws()[0])>;
  constexpr bool by_mass = requires(const Law law, Scalar x) {
    double(law.duration(x));
  };
  constexpr bool by_speed = requires(const Law law, Scalar x) {
    double(law.duration(x, x, x));
  };
  if constexpr (by_mass || by_speed) {
    double duration = std::numeric_limits<double>::infinity();
    for (const Law& law : simulation.materials().laws()) {
      const auto mass = Scalar(of.lightest / 2);
      if constexpr (by_mass)
        duration = std::min(duration, double(law.duration(mass)));
      else if (approach > 0)
        duration =
            std::min(duration, double(law.duration(mass, Scalar(of.width / 4), Scalar(approach))));
    }
    if (of.step > 0.2 * duration)
      found.say(
          "a step of % s does not resolve an impact of two of the lightest grains, which lasts % "
          "s: "
          "restitution and friction are not those of the law. Use a twentieth, % s, or softer "
          "springs",
          {of.step, duration, round_down(duration / 20)});
  }
}

template <class Simulation>
[[gnu::cold]] void check_units(Findings& found, const Simulation& simulation,
                               const StepReport& report) {
  Extremes of;
  of.step = report.step;
  const auto& bodies = simulation.bodies();
  const double size = double(simulation.grain_size());
  // Then, if all are wide, thicknesses, until a grain is thin enough: the smallest width of a hull takes long.
  const void* last = nullptr;
  for (const bool thin : {false, true}) {
    if (thin && of.width < 5 * size) break;
    if (thin) of.thickness = of.width;
    for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
      const std::size_t body = simulation.grain(k).index();
      if (bodies.is_prescribed(body)) continue;
      const auto& shape = simulation.shape_of_grain(k);
      if (thin) {
        if (of.thickness_fits(size)) break;
        if (&shape != last) of.thickness = std::min(of.thickness, double(smallest_width(shape)));
        last = &shape;
        continue;
      }
      const double density =
          double(bodies.grain_mass[body]) / double(shape.mass_properties(1).mass);
      of.width = std::min(of.width, 2 * double(circumradius(shape)));
      of.density = std::min(of.density, density);
      of.lightest = std::min(of.lightest, double(bodies.grain_mass[body]));
      of.heaviest = std::max(of.heaviest, density);
    }
  }
  for (const auto& law : simulation.materials().laws())
    if constexpr (FrictionLaw<std::remove_cvref_t<decltype(law)>>)
      if (const double friction = double(law.friction()); friction >= 5 && friction <= 90)
        of.friction = std::max(of.friction, friction);
  check_range(found, simulation);
  check_duration(found, simulation, of,
                 report.approach * simulation.tolerances().margin * size / report.step);
  of.gravity = double(simulation.gravity().norm());
  judge(found, of, size);
  check_direction(found, simulation);
}

/// Whether nothing moves, and nothing will: no gravity, and no body has a velocity, a force or a part of its overlap
/// that a spring or the correction would push back.
template <class Simulation>
MOREAU_INLINED inline bool is_idle(const Simulation& simulation, const StepReport& report) {
  bool idle = simulation.grain_count() > 0 && simulation.gravity().isZero(0) &&
              !simulation.cell_motion().is_active() && report.overlapping == 0;
  const auto& bodies = simulation.bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i)
    idle = idle && bodies.velocity[i].isZero(0) && bodies.force[i].isZero(0);
  return idle;
}

}  // namespace moreau::detail
