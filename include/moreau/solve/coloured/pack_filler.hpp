// SPDX-License-Identifier: MIT
// Contact points are packed for the sweeps: the data that the operator has of a contact go into a lane.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "moreau/core/compiled_once.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/law/law_lanes.hpp"
#include "moreau/simd/lane_rows.hpp"
#include "moreau/solve/coloured/packs.hpp"
#include "moreau/solve/contact_problem.hpp"

namespace moreau::detail {

/// Fills PointPacks.
template <class Operator, class Law>
class PackFiller {
 public:
  using S = typename Operator::Space;
  using Points = PointPack<S, Law>;
  using Lanes = typename LaneBlock<S>::Number;
  using Impulse = typename Operator::Vector;
  using Numbers = typename Operator::PointNumbers;
  using Point = typename Numbers::Point;
  static constexpr std::size_t lanes = Lanes::lanes, rows_of_point = Points::Block::rows;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();  ///< no contact

  /// Fills a PointPack.
  /// @param contacts of the lanes, or none
  static void fill(Points& point, const std::uint32_t* contacts,
                   const ContactProblem<Operator, Law>& problem,
                   std::span<const Impulse> impulses) {
    const Operator& op = problem.delassus;
    if constexpr (Rolls<Law>) {
      point = {};
      for (std::size_t lane = 0; lane < lanes; ++lane)
        if (contacts[lane] != none) set(point, lane, op, contacts[lane]);
    } else {
      static const Point unused = unused_point();
      std::array<const typename S::Scalar*, lanes> rows;
      for (std::size_t lane = 0; lane < lanes; ++lane)
        rows[lane] = Numbers::begin(contacts[lane] == none ? unused : op.point(contacts[lane]));
      read(point, rows);
    }
    set_impulses(point, contacts, impulses);
    if constexpr (CompliantLaw<Law, S>) point.compliance = {};
    LawLanes<Law, S> law{};
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::uint32_t c = contacts[lane];
      if (c == none) continue;
      law.set(lane, problem.law(c));
      if constexpr (CompliantLaw<Law, S>)
        for (std::size_t d = 0; d < rows_of_point; ++d)
          point.compliance[d][lane] = op.compliance(c)[Eigen::Index(d)];
    }
    point.law = law;
  }
  /// Replaces the free velocities and the impulses of a PointPack, and sets the memory of the laws to 0.
  static void refill(Points& point, const std::uint32_t* contacts,
                     const ContactProblem<Operator, Law>& problem,
                     std::span<const Impulse> impulses) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::uint32_t c = contacts[lane];
      if (c == none) continue;
      for (std::size_t d = 0; d < rows_of_point; ++d)
        point.free[d][lane] = problem.delassus.free_velocity(c)[Eigen::Index(d)];
      point.law.set(lane, problem.law(c));
    }
    set_impulses(point, contacts, impulses);
  }

  /// Replaces the impulses of a PointPack.
  static void set_impulses(Points& point, const std::uint32_t* contacts,
                           std::span<const Impulse> impulses) {
    static const Impulse zero = Impulse::Zero();
    std::array<const Impulse*, lanes> of_lane;
    for (std::size_t lane = 0; lane < lanes; ++lane)
      of_lane[lane] = contacts[lane] == none ? &zero : &impulses[contacts[lane]];
    for (std::size_t d = 0; d < rows_of_point; ++d) {
      typename Lanes::Values row{};
      for (std::size_t lane = 0; lane < lanes; ++lane)
        row[lane] = (*of_lane[lane])[Eigen::Index(d)];
      point.impulse[d] = point.before[d] = row;
    }
  }

 private:
  /// Reads frames, levers, blocks and free velocities.
  /// @param rows the PointNumbers of each lane
  static void read(Points& point, const std::array<const typename S::Scalar*, lanes>& rows) {
    using Values = typename Lanes::Values;
    using Member = typename Numbers::Member;
    Values padding;
    read_rows<Lanes, Numbers::count>(rows, [&](auto k) MOREAU_INLINED_LAMBDA -> Values& {
      constexpr auto place = Numbers::place(k);
      constexpr std::size_t i = place.index;
      if constexpr (place.member == Member::frame)
        return point.frame[i % S::dim][i / S::dim];
      else if constexpr (place.member == Member::lever_a)
        return point.lever_a[i];
      else if constexpr (place.member == Member::lever_b)
        return point.lever_b[i];
      else if constexpr (place.member == Member::normal)
        return point.block.normal;
      else if constexpr (place.member == Member::coupling)
        return point.block.coupling[i];
      else if constexpr (place.member == Member::slip)
        return point.block.slip[i];
      else if constexpr (place.member == Member::free)
        return point.free[i];
      else {
        static_assert(place.member == Member::padding);
        return padding;
      }
    });
    point.block.invert();
  }
  /// The numbers of a lane without a contact: see PointPack.
  static Point unused_point() {
    Point point{};
    point.frame.setZero();
    point.lever_a.setZero();
    point.lever_b.setZero();
    point.block.normal = 1;
    point.block.coupling.setZero();
    point.block.slip.setOnes();
    point.free.setZero();
    point.free[0] = 1;  // separates
    return point;
  }
  /// Fills a lane of a PointPack with couples, but for impulse and law.
  static void set(Points& point, std::size_t lane, const Operator& op, std::uint32_t c) {
    for (std::size_t d = 0; d < S::dim; ++d) {
      const auto column = Eigen::Index(d);
      for (std::size_t k = 0; k < S::dim; ++k)
        point.frame[k][d][lane] = op.frame(c)(Eigen::Index(k), column);
      point.lever_a[d][lane] = op.lever_a(c)[column];
      point.lever_b[d][lane] = op.lever_b(c)[column];
    }
    if constexpr (Rolls<Law>) point.radius[lane] = op.radius(c);
    for (std::size_t d = 0; d < rows_of_point; ++d)
      point.free[d][lane] = op.free_velocity(c)[Eigen::Index(d)];
    point.block.set(lane, op.block(c));
  }
};

}  // namespace moreau::detail
