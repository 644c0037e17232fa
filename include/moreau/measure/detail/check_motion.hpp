// SPDX-License-Identifier: MIT
// The part of check() that looks for bodies that cannot move as they are told to, or that move too far in a step.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/measure/detail/check_report.hpp"
#include "moreau/shape/circumradius.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau::detail {

/// A body of prescribed motion that moves towards grains, and pushes some: a half-space along its normal, a mesh wall or an
/// obstacle in any direction; -1 if there is none.
template <class Simulation>
MOREAU_INLINED inline double pressing_body(const Simulation& simulation) {
  using S = typename Simulation::S;
  const auto& bodies = simulation.bodies();
  const auto speed_of = [&](std::size_t i, const typename S::Vector& v) {
    const typename S::Vector normal = bodies.axes(i).col(0);
    return simulation.is_grain(i) ? v.norm() : normal.dot(v);
  };
  const auto pushes = [&](std::size_t i) {
    return !simulation.contact_impulse(simulation.body_id(i)).isZero(0);
  };
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies.exists(i) && bodies.is_prescribed(i) &&
        speed_of(i, linear<S>(bodies.velocity[i])) > 0 && pushes(i))
      return double(i);
  for (const auto& mesh : simulation.mesh_walls())
    if (const std::size_t i = mesh.body.index();
        bodies.is_prescribed(i) && linear<S>(bodies.velocity[i]).norm() > 0 && pushes(i))
      return double(i);
  return -1;
}

/// Names a wall with a mass that has passed another one, and two walls in one place.
template <class Simulation>
MOREAU_INLINED inline void check_walls(Findings& found, const Simulation& simulation) {
  using Vector = typename Simulation::S::Vector;
  using Scalar = typename Simulation::S::Scalar;
  const auto& bodies = simulation.bodies();
  for (const BodyId wall : simulation.walls())
    for (const BodyId other : simulation.walls()) {
      const std::size_t i = wall.index(), k = other.index();
      const Vector normal = bodies.axes(i).col(0), facing = bodies.axes(k).col(0);
      const Vector way = bodies.pose[k].position - bodies.pose[i].position;
      if (i < k && normal.dot(facing) > Scalar(0.999999) &&
          bodies.velocity[i] == bodies.velocity[k] &&
          std::abs(normal.dot(way)) <= Scalar(1e-3) * simulation.grain_size())
        return found.say(
            "walls % and % lie in the same place: grains touch both, each has a part of the force, "
            "and springs and attraction act twice. Add the wall once",
            {double(i), double(k)});
      if (bodies.is_prescribed(i) || normal.dot(way) >= 0 || normal.dot(facing) >= Scalar(-0.9999))
        continue;
      return found.say(
          "wall % has passed wall %, which it faces: two walls never touch, whatever their masses",
          {double(i), double(k)});
    }
}

/// Names two cylinders, and two meshes, in one place.
template <class Simulation>
MOREAU_INLINED inline void check_twice(Findings& found, const Simulation& simulation) {
  using S = typename Simulation::S;
  using Scalar = typename S::Scalar;
  const auto& bodies = simulation.bodies();
  const Scalar near = Scalar(1e-3) * simulation.grain_size();
  // Calls `coincide` for all pairs of walls of a kind that move alike, until it says yes.
  const auto look_for = [&](const auto& walls, const auto& coincide) {
    for (std::size_t b = 1; b < walls.size(); ++b)
      for (std::size_t a = 0; a < b; ++a) {
        const std::size_t i = walls[a].body.index(), k = walls[b].body.index();
        if (bodies.velocity[i] != bodies.velocity[k] ||
            !coincide(walls[a].shape, bodies.pose[i], walls[b].shape, bodies.pose[k]))
          continue;
        return found.say(
            "walls % and % lie in the same place: grains touch both, each has a part of the force, "
            "and springs and attraction act twice. Add the wall once",
            {double(i), double(k)});
      }
  };
  look_for(
      simulation.cylinders(), [&](const auto& a, const auto& at, const auto& b, const auto& other) {
        const typename S::Angular axis = a.axis_at(at.rotation), second = b.axis_at(other.rotation);
        const typename S::Vector way = other.position - at.position;
        return std::abs(a.radius() - b.radius()) <= near &&
               std::abs(axis.dot(second)) > Scalar(0.999999) && S::spin(axis, way).norm() <= near;
      });
  look_for(simulation.mesh_walls(), [&](const auto& a, const auto& at, const auto& b,
                                        const auto& other) {
    const auto &one = a.mesh(), &two = b.mesh();
    bool same = one.vertices.size() == two.vertices.size() && one.facets == two.facets;
    for (std::size_t v = 0; same && v < one.vertices.size(); ++v)
      same = typename S::Vector(at(one.vertices[v]) - other(two.vertices[v])).norm() <= near;
    return same;
  });
}

/// Whether a contact of a body was found, with an impulse or without.
template <class Simulation>
MOREAU_INLINED inline bool touches(const Simulation& simulation, std::size_t body) {
  const auto& points = simulation.contacts().points;
  return std::any_of(points.begin(), points.end(),
                     [&](const auto& point) { return point.a == body || point.b == body; });
}

/// Names a wall with a mass above grains on which no force acts, one that its force alone has pulled away from grains since the
/// start or from rest, and one that slides
/// and begins a step without velocity along its normal, which forces and contacts then give it: set_velocity() of a lid
/// in every step.
template <class Simulation>
MOREAU_INLINED inline void check_weights(Findings& found, const Simulation& simulation,
                                         double step) {
  using S = typename Simulation::S;
  using Vector = typename S::Vector;
  const auto& bodies = simulation.bodies();
  const Vector gravity = simulation.gravity();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto inverse = double(bodies.inverse_mass[i][0]);
    if (simulation.is_grain(i) || !(inverse > 0)) continue;
    const Vector normal = bodies.axes(i).col(0);
    if (!bodies.force[i].isZero(0)) {
      const Vector impulse = simulation.contact_impulse(simulation.body_id(i)),
                   velocity = linear<S>(bodies.velocity[i]);
      const auto push = double(normal.dot(linear<S>(bodies.force[i]))),
                 speed = double(normal.dot(velocity)), gain = push * step * inverse,
                 before = speed - gain - double(normal.dot(impulse)) * inverse;
      if (std::abs(before) < 1e-3 * std::abs(speed) && std::abs(speed) > 0.1 * std::abs(gain) &&
          double(velocity.norm()) > 1.001 * std::abs(speed) && simulation.time() > 1.5 * step)
        return found.say(
            "wall % slides, and began the step at rest along its normal. If "
            "set_velocity() is called in each step, it holds the wall back: take a VelocityDrive",
            {double(i)});
      // A piston that has pressed and is pulled back touches the grains in its first step, and is slower than by the force alone.
      const bool since_start =
          std::abs(gain * simulation.time() - speed * step) <= 0.01 * std::abs(speed) * step;
      const bool from_rest = std::abs(before) < 1e-3 * std::abs(speed) && !touches(simulation, i);
      if (push < 0 && speed < 0 && impulse.isZero(0) && (since_start || from_rest))
        return found.say(
            "the force on wall %, % N along its normal, pulls it away from the grains, and it "
            "touches none. If it shall press, turn the sign of the force or of the pressure",
            {double(i), push});
      continue;
    }
    const auto pull = double(normal.dot(gravity));
    if (!(pull > 0.1 * double(gravity.norm()))) continue;
    return found.say(
        "wall % has a mass of % kg, and no force acts on it: gravity does not act on walls. If it "
        "shall press with its weight of % N, call set_force(), with mass x gravity",
        {double(i), 1 / inverse, pull / inverse});
  }
}

/// Names a body whose surface moves by more than half a grain size in the step because it turns: of walls and obstacles where
/// they touch grains.
template <class Simulation>
MOREAU_INLINED inline void check_spins(Findings& found, const Simulation& simulation, double step) {
  using S = typename Simulation::S;
  const auto& bodies = simulation.bodies();
  double most = double(simulation.grain_size()) / 2 / step;
  std::size_t fastest = bodies.size();
  const auto take = [&](std::size_t i, double speed) {
    if (speed > most) fastest = i, most = speed;
  };
  const auto spin_of = [&](std::size_t i) ->
      typename S::Angular { return angular<S>(bodies.velocity[i]); };
  for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
    const std::size_t i = simulation.grain(k).index();
    if (bodies.rotates(i))
      take(i, double(spin_of(i).norm() * circumradius(simulation.shape_of_grain(k))));
  }
  const auto& points = simulation.contacts().points;
  for (const auto& point : points)
    for (const bool is_b : {false, true}) {
      const std::size_t i = is_b ? point.b : point.a;
      if (!bodies.rotates(i) && !spin_of(i).isZero(0))
        take(i, double(S::spin(spin_of(i), is_b ? point.lever_b : point.lever_a).norm()));
    }
  if (fastest == bodies.size()) return;
  const auto spin = double(spin_of(fastest).norm());
  found.say(
      "body % turns by % rad in the step: its surface moves by % m, % times the grain size. Use a "
      "shorter step; if its spin of % is in revolutions per minute, type % rad/s",
      {double(fastest), spin * step, most * step, most * step / double(simulation.grain_size()),
       spin, spin * std::numbers::pi / 30});
}

/// Names a body whose force has no effect, or only a part of it, a grain that moves by more than a grain size in the step
/// although no contact shows it, and a simulation in which the motion of all
/// bodies is prescribed.
template <class Simulation>
MOREAU_INLINED inline void check_motion(Findings& found, const Simulation& simulation,
                                        const StepReport& report) {
  using S = typename Simulation::S;
  using Vector = typename S::Vector;
  using Scalar = typename S::Scalar;
  const auto& bodies = simulation.bodies();
  const auto normal_of = [&](std::size_t wall) -> Vector { return bodies.axes(wall).col(0); };
  std::size_t in_vain = bodies.size(), fastest = bodies.size();
  double most = double(simulation.grain_size()) / report.step;
  bool any_free = simulation.grain_count() == 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies.exists(i)) continue;
    if (!bodies.rotates(i)) {
      // The motion of a wall with a mass is prescribed but for its normal, the first of its axes.
      const bool moves = !bodies.inverse_mass[i].isZero(0);
      Vector force = linear<S>(bodies.force[i]);
      const Scalar rounding = moves ? Scalar(1e-3) * force.norm() : Scalar(0);
      if (moves) force -= force.dot(normal_of(i)) * normal_of(i);
      if (in_vain == bodies.size() &&
          (force.norm() > rounding || !angular<S>(bodies.force[i]).isZero(0)))
        in_vain = i;
      any_free = any_free || moves;
      if (!moves && !simulation.is_grain(i))
        continue;  // a half-space may move along itself at any speed
    } else {
      any_free = true;
    }
    const auto speed = double(linear<S>(bodies.velocity[i]).norm());
    if (speed > most) fastest = i, most = speed;
  }
  check_walls(found, simulation);
  check_twice(found, simulation);
  check_weights(found, simulation, report.step);
  check_spins(found, simulation, report.step);
  if (in_vain < bodies.size())
    found.say(
        bodies.is_prescribed(in_vain)
            ? "the force or torque of body % has no effect: its motion is prescribed. Call "
              "set_wall_mass() for a wall, release() for a grain; or set_force() with zero if it "
              "shall be driven"
            : "the force or torque of body % has no effect, or a part of it: a wall with a mass "
              "moves along the first axis of its frame only, a half-space along its normal",
        {double(in_vain)});
  if (fastest < bodies.size() && report.approach <= 1)
    found.say(
        "body % moves by % m in the step, % times the grain size: it can pass through others. Use "
        "a shorter step; if "
        "its velocity of % is in mm/s, type it in m/s",
        {double(fastest), most * report.step, most * report.step / double(simulation.grain_size()),
         most});
  if (!any_free)
    found.say("the motion of all bodies is prescribed. Call release() for grains that shall move",
              {});
}

}  // namespace moreau::detail
