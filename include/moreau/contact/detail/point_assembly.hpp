// SPDX-License-Identifier: MIT
// Fills the points of an operator: frames, levers, blocks and free velocities, several contacts at once.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <span>

#include "moreau/contact/contact.hpp"
#include "moreau/contact/detail/contact_lanes.hpp"
#include "moreau/contact/detail/operator_frames.hpp"
#include "moreau/contact/detail/operator_point.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/motion/mobility.hpp"
#include "moreau/parallel/team.hpp"

namespace moreau::detail {

/// What an operator is assembled from, and its parts that are filled.
template <class S, bool Couples, bool Springs>
struct PointAssembly {
  using Scalar = typename S::Scalar;
  using Lanes = ContactLanes<S>;
  using Point = OperatorPoint<S, Couples>;

  std::span<const Contact<S>> contacts;
  std::span<const InverseMass<S>> masses;   ///< of all bodies
  std::span<const typename S::Twist> free;  ///< of all bodies, without contacts [m/s, rad/s]
  const SpringRows<typename Point::Vector, Springs>& springs;
  // One per contact.
  std::span<Point> points;
  std::span<OperatorHead<Scalar>> heads;
  OperatorFrames<S, Couples>& frames;

  /// @returns the longest lever of a body that impulses rotate [m]
  Scalar assemble(const Team& team) const {
    std::atomic<Scalar> longest = 0;  // its square
    team.share(contacts.size(), 64, [&](std::size_t begin, std::size_t end) {
      typename Lanes::Values levers{};
      for (std::size_t c = begin; c < end; c += Lanes::lanes)
        assemble_some(c, std::min(end, c + Lanes::lanes), levers);
      const Scalar here = Lanes::largest(levers);
      for (Scalar so_far = longest; here > so_far;)
        if (longest.compare_exchange_weak(so_far, here)) break;
    });
    return std::sqrt(longest.load());
  }
  /// The rows of the couples, after those of the points.
  void assemble_couples(std::span<const MobilityRoot<S>> roots, const Team& team) const {
    team.share_each(contacts.size(), 64, [&](std::size_t c) {
      Point& point = points[c];
      point.assemble_couple(contacts[c], roots, masses[point.a], masses[point.b], free);
      auto& block = point.block;
      if constexpr (Springs) block.spin.diagonal() += angular<S>(springs.compliance[c]);
      // Two bodies whose rotation is prescribed: any positive value will do, see ContactLanes.
      if (block.spin.isZero(0)) block.spin.diagonal().setConstant(block.point.normal);
      heads[c].trace = block.trace();
    });
  }

 private:
  /// @param end    at most as many contacts as there are lanes
  /// @param levers in, out: square of the longest lever in each lane [m^2]
  MOREAU_COMPILED_ONCE void assemble_some(std::size_t begin, std::size_t end,
                                          typename Lanes::Values& levers) const {
    constexpr std::size_t lanes = Lanes::lanes;
    Lanes some;
    std::array<const Contact<S>*, lanes> of_lane;
    std::array<const InverseMass<S>*, lanes> mass_a, mass_b;
    std::array<const typename S::Twist*, lanes> free_a, free_b;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::size_t c = std::min(begin + lane, end - 1);
      const Contact<S>& contact = contacts[c];
      of_lane[lane] = &contact;
      mass_a[lane] = &masses[contact.a], mass_b[lane] = &masses[contact.b];
      free_a[lane] = &free[contact.a], free_b[lane] = &free[contact.b];
      if constexpr (Springs)
        for (std::size_t d = 0; d < S::dim; ++d)
          some.compliance[d][lane] = springs.compliance[c][Eigen::Index(d)];
    }
    some.set_contacts(of_lane);
    some.a.set_bodies(mass_a, free_a);
    some.b.set_bodies(mass_b, free_b);
    some.assemble();
    some.find_longest_lever(levers);
    if constexpr (!Couples) {
      Point unused;
      std::array<Point*, lanes> of_points;
      for (std::size_t lane = 0; lane < lanes; ++lane)
        of_points[lane] = begin + lane < end ? &points[begin + lane] : &unused;
      some.write(of_points);
    }
    for (std::size_t c = begin; c < end; ++c) {
      const std::size_t lane = c - begin;
      const Contact<S>& contact = contacts[c];
      Point& point = points[c];
      point.a = contact.a;
      point.b = contact.b;
      heads[c] = {{contact.a, contact.b}, some.trace(lane)};
      frames.set(c, some.turn(lane));
      if constexpr (Couples) {
        point.frame.col(0) = contact.frame.col(0);
        some.get_tangents(lane, point.frame);
        point.lever_a = contact.lever_a;
        point.lever_b = contact.lever_b;
        point.block.point = some.block(lane);
        linear<S>(point.free) = some.free_velocity(lane);
      }
    }
  }
};

}  // namespace moreau::detail
