// SPDX-License-Identifier: MIT
// Bond: a bond between two bodies. Breakage: the record of a bond that broke. The law is in law/bonded.hpp.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>

#include "moreau/contact/contact.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/periodic_cell.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/core/space.hpp"
#include "moreau/motion/bodies.hpp"

namespace moreau {

/// A bond. It is fixed to a point and a frame of each body that coincided when it was made. The frame F that turns with
/// the mean of both rotations has the normal as its first column, from a to b.
template <class S>
struct Bond {
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Angular = typename S::Angular;

  BodyId a;                                            ///< its first body
  BodyId b;                                            ///< its second body; a wall is b
  Vector anchor_a = Vector::Zero();                    ///< its point in the frame of body a [m]
  Vector anchor_b = Vector::Zero();                    ///< its point in the frame of body b [m]
  typename S::Matrix frame_a = S::Matrix::Identity();  ///< its frame in that of body a
  typename S::Matrix frame_b = S::Matrix::Identity();  ///< its frame in that of body b
  Vector cells = Vector::Zero();   ///< whole numbers of periodic cells from b to its image at a
  Vector slip = Vector::Zero();    ///< opening and slip where it has yielded, in F [m]
  Angular bend = Angular::Zero();  ///< rotation where it has yielded, in F [rad]
  /// Velocity of b against a at the bond in the last step: errors and their correction, in F [m/s].
  Vector opening = Vector::Zero();
  Angular turning = Angular::Zero();  ///< the same of the rotation [rad/s]
  double dissipated = 0;              ///< energy that its yielding took [J]
  double elastic = 0;                 ///< energy of its springs; 0 without [J]
  Scalar strength_left = 1;           ///< s: share of its strength that is left [-]
  bool is_new = true;                 ///< no step has ended since it was made

  auto serialized_members() {  ///< see core/serialize.hpp
    return std::tie(a, b, anchor_a, anchor_b, frame_a, frame_b, cells, slip, bend, opening, turning,
                    dissipated, elastic, strength_left, is_new);
  }
};

/// A bond that broke.
struct Breakage {
  double time = 0;    ///< at the end of the step in which it broke [s]
  BodyId a;           ///< the first body that it held
  BodyId b;           ///< the second one
  double energy = 0;  ///< that its yielding took and its springs released, >= 0 [J]

  auto serialized_members() { return std::tie(time, a, b, energy); }  ///< see core/serialize.hpp
};

namespace detail {

/// The feature of the contact of a bond, with indices that no feature of a shape has.
inline constexpr FeatureKey bond_feature(FeatureKey::Kind::vertex_vertex, 0xfffffff, 0xfffffff);
/// Whether the contact of this key is a bond.
inline bool is_bond(const ContactKey& key) {
  return key.feature == bond_feature;
}

/// Where a bond is, world axes.
template <class S>
struct BondPlace {
  typename S::Matrix frame;     ///< F
  typename S::Vector middle_a;  ///< from the centre of a to the middle of both points [m]
  typename S::Vector middle_b;  ///< from the centre of b, or its image, to it [m]
  typename S::Vector stretch;   ///< from the point of a to that of b [m]
  typename S::Angular turn;     ///< rotation vector from the frame of a to that of b [rad]
  typename S::Scalar
      rounding;  ///< of the stretch by that of the positions: no motion makes it smaller [m]
  typename S::Scalar measured;  ///< of the stretch as it is computed from the positions [m]
};

/// The rotation vector of the rotation that takes the orthonormal columns of `from` to those of `to` [rad].
template <class S>
typename S::Angular rotation_between(const typename S::Matrix& from, const typename S::Matrix& to) {
  using Scalar = typename S::Scalar;
  typename S::Angular sum = S::Angular::Zero();  // 2 sin(angle) along the axis
  for (int k = 0; k < S::dim; ++k) sum += S::moment(from.col(k), to.col(k));
  const Scalar sine = sum.norm() / 2;
  const Scalar cosine = ((from.transpose() * to).trace() - Scalar(S::dim - 2)) / 2;
  if (sine < Scalar(1e-3) && cosine > 0) return sum / 2 * (1 + sine * sine / 6);
  // The sine vanishes at half a turn, so that the axis would be lost.
  if (cosine < 0) return S::log(typename S::Rotation(to * from.transpose()));
  return sum * (std::atan2(sine, cosine) / (2 * sine));
}

/// @param shift from body b to its image at a [m]
template <class S>
BondPlace<S> place_of(const Bond<S>& bond, const Bodies<S>& bodies,
                      const typename S::Vector& shift) {
  const Pose<S>&a = bodies.pose[bond.a.index()], &b = bodies.pose[bond.b.index()];
  const typename S::Matrix axes_a = bodies.axes(bond.a.index()),
                           axes_b = bodies.axes(bond.b.index());
  const typename S::Matrix of_a = axes_a * bond.frame_a, of_b = axes_b * bond.frame_b;
  const typename S::Vector at_a = axes_a * bond.anchor_a, at_b = axes_b * bond.anchor_b;
  const typename S::Vector between = b.position - a.position + shift;
  BondPlace<S> place;
  place.stretch = between + at_b - at_a;
  place.turn = rotation_between<S>(of_a, of_b);
  place.frame = S::exp(place.turn / 2).toRotationMatrix() * of_a;
  const typename S::Scalar levers = at_a.norm() + at_b.norm() + shift.norm();
  constexpr auto epsilon = std::numeric_limits<typename S::Scalar>::epsilon();
  // Positions are multiples of their rounding. Their difference has the rounding of itself alone.
  place.rounding = epsilon * (levers + a.position.norm() + b.position.norm());
  place.measured = epsilon * (levers + between.norm());
  place.middle_a = at_a + place.stretch / 2;
  place.middle_b = at_b - place.stretch / 2;
  return place;
}

/// Counts the cells to the image of b at a: a user may have moved bodies by whole cells, or set another cell.
template <class S>
MOREAU_COLD void count_cells(Bond<S>& bond, const Bodies<S>& bodies, const PeriodicCell<S>& cell) {
  using Vector = typename S::Vector;
  const std::size_t a = bond.a.index(), b = bond.b.index();
  const Vector at_a = bodies.pose[a].position + bodies.axes(a) * bond.anchor_a,
               at_b = bodies.pose[b].position + bodies.axes(b) * bond.anchor_b;
  bond.cells = cell.cells(Vector(at_a - at_b));
}
/// A bond at the middle of contact points of two bodies.
/// @param points at least one
template <class S>
Bond<S> bond_of(std::span<const Contact<S>> points, const Bodies<S>& bodies,
                const PeriodicCell<S>& cell) {
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  Bond<S> bond;
  Vector lever_a = Vector::Zero(), lever_b = Vector::Zero(), normal = Vector::Zero();
  for (const Contact<S>& point : points) {
    lever_a += point.lever_a;
    lever_b += point.lever_b;
    normal += point.frame.col(0);
  }
  lever_a /= Scalar(points.size());
  lever_b /= Scalar(points.size());
  // Normals of several parts that cancel: any will do.
  normal = normal.norm() > Scalar(0.1) ? normal.normalized() : Vector(points[0].frame.col(0));
  const std::uint32_t a = points[0].a, b = points[0].b;
  const typename S::Matrix axes_a = bodies.axes(a), axes_b = bodies.axes(b),
                           frame = S::contact_frame(normal);
  bond.a = bodies.id[a];
  bond.b = bodies.id[b];
  bond.anchor_a = axes_a.transpose() * lever_a;
  bond.anchor_b = axes_b.transpose() * lever_b;
  bond.frame_a = axes_a.transpose() * frame;
  bond.frame_b = axes_b.transpose() * frame;
  count_cells(bond, bodies, cell);
  return bond;
}

}  // namespace detail
}  // namespace moreau
