// SPDX-License-Identifier: MIT
// Contacts with turning walls, with cylinders and of balls with balls at rest, to second order in the step h.
//
// A material point at the lever X from the centre of a body that turns at w moves along an arc. Over a
// step it is displaced by h (v + w x X + E(w) X), where
//
//     E(w) X = ((exp(h w) - 1) / h) X - w x X = h/2 w x (w x X) + O(h^2).
//
// The velocity v + w x X is tangent to the arc: a grain that follows it leaves the wall's circle by
// E(w) X per unit of time. So a body that rests on a turning wall would drift outwards, by pi h |w| times
// its radius per turn. The contact problem therefore uses the chord of the arc, (displacement)/h, as
// the velocity of the wall, and does the same for the rotation of the grain, so that a grain that turns with the
// wall is at rest to rounding. The second derivative of the gap g(t) along the normal n has one more term
// if the body that owns the touching face turns at w and the bodies slide at u_t:
//
//     h/2 g'' = n . (E(w_b) X_b - E(w_a) X_a) + h (w x n) . u_t
//
// A wall along a cylinder is curved itself. Let R be the radius of the cylinder minus that of the
// rounding of the grain. A point on the circle R that moves by h u along its tangent stays inside of the
// circle only if it moves inwards by
//
//     h c = R - sqrt(R^2 - (h u)^2).
//
// Without c a grain that slides along the wall would lose the part of its velocity along the new normal
// in every step: pi h u / R of its speed per turn. With c a step without friction is the map of SHAKE (J.-P.
// Ryckaert et al., J. Comput. Phys. 23 (1977) 327), which reflects this part and conserves the speed.
//
// For a rounded body X leads to a point of its core: the centre of a ball, the end of the
// segment of a capsule, a point of the axis of a Cylinder that is touched at its round side. For other grains of which
// only the support function is known it leads to the centre. X_a and X_b lead to the point of the core of the body that
// touches the face of the other one. So a ball or a capsule that turns about its own axis moves no point of a core, and
// nothing sinks into a roller. Where neither body has a face, as between two balls, each X leads to the own core, and
// instead of the turning face there is the curvature, h/2 |u_t|^2 / d, with the distance d of the cores.
//
// A rounded grain that rolls along a face or a cylinder touches it at a place that moves with the velocity c, not with
// the wall, and its lever from the core to this place turns with the normal, at the rate m. At the end of the step the
// relative velocity along the wall has changed by
//
//     h/2 (w_b x (c - v_b - w_b x X_b) - w_a x m),      c = (velocity of the core of a) + m
//
// beside the chords. Without it the velocities of the step lag behind the path by half a step: with h Omega = 0.005 a
// ball that rolls on a turntable left its circle by 1.1 % of the radius per turn, and one that rolls round in a tube
// lost half of its energy in 20 turns. On a ball at rest the normal turns with the cores, m = r u_t / d with the radius
// r of the ball that rolls: a ball that spins and rolls around it lost
// the tilt of its spin axis, and 0.1 % of its spin per turn.
//
// The side of a capsule, of a Cylinder and the edge of a polyhedron, rounded or not, are straight: nothing bends along them.
// A side is followed in a frame that turns with its direction e, but not about it, at the rate t = w - e (e . w): the core of
// the other body stays at its place in this frame but for its motion s relative to it. About the axis the normal turns at a rate
// m: if the other core is a point, as of a ball, an end or a vertex, d m = (s . (e x n)) e x n with the distance d of the cores,
// and the curvature is h/2 d |m|^2. If it is a straight side along f that turns at w', the normal stays across f:
// f . m = f . ((w' - t) x n), and the curvature is h m . s - h/2 d |m|^2, of which that of a point is a case. The edge of a
// face that lies across a side has m = 0. Whether a polyhedron is touched at a vertex, an edge or a face is told by the
// vertices that lie farthest out: the points of two faces can lie at crossings of their edges.
//
// A bond is fixed to a point of each body, and has its own chords, of free bodies as well (bond_list.hpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "moreau/contact/contact.hpp"
#include "moreau/contact/relative_velocity.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/world/bond.hpp"
#include "moreau/world/detail/assembly.hpp"
#include "moreau/world/detail/core_touch.hpp"

namespace moreau::detail {

/// E(w) X at the top of this file [m/s].
/// @param w     angular velocity, world axes [rad/s]
/// @param lever X, world axes [m]
/// @param step  h, also negative: the chord of the past step [s]
template <class S>
[[gnu::cold, gnu::noinline]] typename S::Vector chord_excess(const typename S::Angular& w,
                                                             const typename S::Vector& lever,
                                                             typename S::Scalar step) {
  using T = typename S::Scalar;
  const T angle = std::abs(step) * w.norm(), square = angle * angle;
  // sin(x) / x - 1 and (1 - cos x) / x^2, for small x by their series
  const bool is_small = angle < T(1e-2);
  const T half = is_small ? T(0) : std::sin(angle / 2);
  const T first = is_small ? -square / 6 * (1 - square / 20) : std::sin(angle) / angle - 1;
  const T second = is_small ? (1 - square / 12) / 2 : 2 * half * half / square;
  const typename S::Vector along = S::spin(w, lever);
  return first * along + second * step * S::spin(w, along);
}

/// The velocities to add to the relative velocities of contacts, so that these times h are displacements
/// over a step to second order.
template <class ShapeT>
class ChordVelocities {
 public:
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Angular = typename S::Angular;

  /// @param contacts of the bodies at their present poses
  /// @param step     h [s]: of the step that begins; -h for the step that ends; 0: none
  /// @returns one per contact, body b minus body a, world axes [m/s]; empty if no wall turns and there is no cylinder
  ///          and no ball at rest
  std::span<const Vector> update(const Assembly<ShapeT>& assembly,
                                 const DetectedContacts<S>& contacts, Scalar step) {
    velocities_.clear();
    find_marked(assembly);
    if (step == 0 || marks_.empty()) return {};
    velocities_.assign(contacts.size(), Vector::Zero());
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Contact<S>& contact = contacts.points[c];
      const ContactKey& key = contacts.keys[c];
      if (is_bond(key) || !has_chord(assembly, contact, key)) continue;
      const auto* cylinder = cylinder_of(assembly, contact.b);
      velocities_[c] = cylinder ? along_cylinder(assembly, *cylinder, contact, key, step)
                                : along_wall(assembly, contact, key, step);
    }
    return velocities_;
  }
  /// Whether a body of the last update() turns by prescription, is a cylinder or a ball at rest: its contacts have
  /// velocities.
  bool has_any() const { return !marks_.empty(); }

 private:
  using Touch = CoreTouch<ShapeT>;
  /// Why the contacts of a body have chords: it is a ball that is prescribed not to turn, of which only the contacts
  /// with balls have them; it turns by prescription, or is a cylinder.
  enum Mark : unsigned char { unmarked, ball_at_rest, turns };

  void find_marked(const Assembly<ShapeT>& assembly) {
    const Bodies<S>& bodies = assembly.bodies();
    marks_.clear();
    const auto set = [&](std::size_t i, Mark mark) {
      marks_.resize(bodies.size(), unmarked);
      marks_[i] = mark;
    };
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (bodies.rotates(i)) continue;
      if (!angular<S>(bodies.velocity[i]).isZero(0))
        set(i, turns);
      else if (Touch::has_ball(assembly, i))
        set(i, ball_at_rest);
    }
    for (const CylinderBody<S>& cylinder : assembly.cylinders()) set(cylinder.body.index(), turns);
  }
  /// Whether a contact has a chord.
  bool has_chord(const Assembly<ShapeT>& assembly, const Contact<S>& contact,
                 const ContactKey& key) const {
    const unsigned char mark = std::max(marks_[contact.a], marks_[contact.b]);
    return mark == turns || (mark == ball_at_rest && !is_bond(key) &&
                             Touch::is_ball(assembly, contact.a, key.part_a) &&
                             Touch::is_ball(assembly, contact.b, key.part_b));
  }
  static const CylinderBody<S>* cylinder_of(const Assembly<ShapeT>& assembly, std::uint32_t body) {
    for (const CylinderBody<S>& cylinder : assembly.cylinders())
      if (cylinder.body.index() == body) return &cylinder;
    return nullptr;
  }

  /// The chord of a contact with a half-space, a mesh wall or a grain whose rotation is prescribed [m/s]. The normal turns at the rate tilt x n + swerve.
  [[gnu::cold, gnu::noinline]] static Vector along_wall(const Assembly<ShapeT>& assembly,
                                                        const Contact<S>& contact,
                                                        const ContactKey& key, Scalar step) {
    const Bodies<S>& bodies = assembly.bodies();
    const Vector normal = contact.frame.col(0);
    const Touch touch = Touch::of(assembly, contact, key);
    const bool face = touch.has_face;
    const Vector lever_a =
                     contact.lever_a - (face && touch.owner_is_a ? touch.core_b : touch.core_a),
                 lever_b =
                     contact.lever_b - (face && !touch.owner_is_a ? touch.core_a : touch.core_b);
    const auto &twist_a = bodies.velocity[contact.a], &twist_b = bodies.velocity[contact.b];
    const Angular of_a = angular<S>(twist_a), of_b = angular<S>(twist_b);
    // From the core of a to that of b.
    const Vector apart = face ? Vector(Vector::Zero()) : Vector(touch.core_a - touch.core_b);
    const Scalar distance = apart.norm();
    const Vector slip = relative_velocity_at<S>(twist_a, lever_a, twist_b, lever_b);
    Angular tilt = Angular::Zero();
    Vector swerve = Vector::Zero();
    bool is_of_wall = true;  // the face or the side
    if (face) {
      is_of_wall = touch.owner_is_a == touch.wall_is_a;
      tilt = touch.owner_is_a ? of_a : of_b;
    } else if (Touch::has_sides && touch.has_side()) {
      is_of_wall = touch.side_is_a == touch.wall_is_a;
      follow_side(touch, normal, of_a, of_b, slip, apart, tilt, swerve);
    } else if (distance > 0) {
      swerve = along(slip, -normal.dot(slip), normal) / distance;
    }
    // In the frame that turns at tilt.
    const Vector turned = S::spin(tilt, normal), slide = slip - S::spin(tilt, apart);
    const Scalar bend = step * (turned + swerve).dot(slide) -
                        step / 2 * distance * swerve.squaredNorm() -
                        normal.dot(chord_excess<S>(tilt, apart, step));
    Vector sum = chord_excess<S>(of_b, lever_b, step) - chord_excess<S>(of_a, lever_a, step);
    const Scalar rounding = touch.rounding_of_grain();
    if (rounding > 0 && is_of_wall && (face || distance > 0)) {
      const Scalar sign = touch.wall_is_a ? -1 : 1;
      const Angular &of_wall = touch.wall_is_a ? of_a : of_b,
                    &of_grain = touch.wall_is_a ? of_b : of_a;
      sum += sign * rolling(normal, of_grain, of_wall, Vector(sign * rounding * (turned + swerve)),
                            Vector(sign * slip), step);
    }
    return sum + bend * normal;
  }
  /// The turn of the normal at a straight side: with the side, but not about it, and about it with the core of the other
  /// body, if that is a point or a straight side.
  /// @param slip  between the cores [m/s]
  /// @param apart from the core of a to that of b [m]
  MOREAU_INLINED static void follow_side(const Touch& touch, const Vector& normal,
                                         const Angular& of_a, const Angular& of_b,
                                         const Vector& slip, const Vector& apart, Angular& tilt,
                                         Vector& swerve) {
    if constexpr (Touch::has_sides) {
      const bool is_a = touch.side_is_a;
      const Vector &side = is_a ? touch.feature_a.side : touch.feature_b.side,
                   &other = is_a ? touch.feature_b.side : touch.feature_a.side;
      const Angular &of_side = is_a ? of_a : of_b, &of_other = is_a ? of_b : of_a;
      tilt = of_side - side * side.dot(of_side);
      const Vector aside = S::spin(side, normal);
      const Scalar distance = apart.norm(), across = aside.dot(other);
      constexpr Scalar parallel = Scalar(0.05);
      if (std::abs(across) > parallel)
        swerve = S::spin(Angular(of_other - tilt), normal).dot(other) / across * aside;
      else if (distance > 0 && other.isZero(0) && (is_a ? touch.rounding_b : touch.rounding_a) >= 0)
        swerve = (slip - S::spin(tilt, apart)).dot(aside) / distance * aside;
    }
  }
  /// What the relative velocity of a rounded grain and a wall changes by along the wall until the end of the step
  /// beside the chords: the place of the contact moves with the grain, and the lever from the core turns with the
  /// normal.
  /// @param swing rate of change of the lever from the core to the contact [m/s]
  /// @param slip  velocity of the wall at the core minus that of the core [m/s]
  /// @returns wall minus grain [m/s]
  MOREAU_INLINED static Vector rolling(const Vector& normal, const Angular& of_grain,
                                       const Angular& of_wall, const Vector& swing,
                                       const Vector& slip, Scalar step) {
    const Vector change = S::spin(of_wall, Vector(swing - slip)) - S::spin(of_grain, swing);
    return step / 2 * along(change, -normal.dot(change), normal);
  }

  /// The chord of a contact with a cylinder [m/s]. A rotation of the cylinder about its axis does not move its surface.
  [[gnu::cold, gnu::noinline]] static Vector along_cylinder(const Assembly<ShapeT>& assembly,
                                                            const CylinderBody<S>& cylinder,
                                                            const Contact<S>& contact,
                                                            const ContactKey& key, Scalar step) {
    const Bodies<S>& bodies = assembly.bodies();
    const std::uint32_t a = contact.a, b = contact.b;
    const Vector normal = contact.frame.col(0);
    const Vector shift =
        Touch::from_core(assembly, a, key.part_a, normal, contact.lever_a, contact.gap);
    const Vector lever_a = contact.lever_a - shift, lever_b = contact.lever_b - shift;
    const Angular of_a = angular<S>(bodies.velocity[a]), of_b = angular<S>(bodies.velocity[b]);
    const Angular axis = cylinder.shape.axis_at(bodies.pose[b].rotation);
    const Angular tilt = along(of_b, -axis.dot(of_b), axis);
    const Vector own = chord_excess<S>(of_a, lever_a, step);
    const Vector tilted = chord_excess<S>(tilt, lever_b, step);
    typename S::Twist tilting = bodies.velocity[b];
    angular<S>(tilting) = tilt;
    const Vector slip = relative_velocity_at<S>(bodies.velocity[a], lever_a, tilting, lever_b);
    const Scalar radius = -S::spin(axis, S::spin(axis, lever_b)).dot(normal) + contact.gap;
    const Vector excess = tilted - own;
    const Scalar along = step * S::spin(axis, normal).dot(slip + excess);
    const Scalar inside = std::sqrt(std::max(Scalar(0), radius * radius - along * along));
    const Scalar curved = radius > 0 ? along * along / (radius + inside) / step : Scalar(0);
    const Scalar along_normal =
        normal.dot(excess) + step * S::spin(tilt, normal).dot(slip) - curved;
    // Only a wall that turns does work on a grain that rests on it.
    Vector sum = of_b.isZero(0) ? Vector(Vector::Zero())
                                : Vector(chord_excess<S>(of_b, lever_b, step) - own);
    if (radius > contact.gap && Touch::rounding_of(assembly, a, key.part_a, normal) > 0) {
      const Vector around = S::spin(axis, normal);
      const Scalar rate = -around.dot(slip) / (radius - contact.gap);  // of the core about the axis
      // The chord is that of the core: a ball that rolls on the spot has none.
      if (!of_b.isZero(0))
        sum += chord_excess<S>(Angular(axis * rate), lever_b, step) -
               chord_excess<S>(Angular(of_b - tilt), lever_b, step);
      const Vector swing = rate * shift.dot(normal) * around;
      sum += rolling(normal, of_a, of_b, swing,
                     Vector(slip + S::spin(Angular(of_b - tilt), lever_b)), step);
    }
    return sum + (along_normal - normal.dot(sum)) * normal;
  }

  List<unsigned char> marks_;  // one Mark per body; empty if all are unmarked
  List<Vector> velocities_;    // one per contact
};

/// Adds the second-order terms of contact c to its free relative velocity. A normal term that pushes is at
/// most the approach before the step, which it equals in a contact that stays closed: it makes no energy.
/// @param op      the operator of the contacts, of their points or also of their couples
/// @param context StepContext of the step
/// @param before  relative velocity before the step, contact frame [m/s]
/// @returns the normal term [m/s]: u_n before the step where the contact neither opens nor closes
template <class Operator>
typename Operator::Scalar add_chord(Operator& op, const auto& context, std::size_t c,
                                    const auto& before) {
  if (context.chords.empty()) return 0;
  auto chord = transposed_product(op.frame(c), context.chords[c]);
  using Scalar = typename Operator::Scalar;
  chord[0] = std::max(chord[0], std::min(Scalar(0), before[0]));
  typename Operator::Vector row = Operator::Vector::Zero();
  for (Eigen::Index k = 0; k < chord.size(); ++k) row[k] = chord[k];
  op.offset(c, row);
  return chord[0];
}

}  // namespace moreau::detail
