// SPDX-License-Identifier: MIT
// The local solution of Coulomb friction with resistance to rolling for a RoundBlock, for one contact or for one
// contact per SIMD lane.
//
// A contact that does not roll has w = 0, so that m = -(b_w + c n x r) / q. What is left is Coulomb's
// problem with
//
//     slip - c^2 / q,     b_t - (c / q) (b_w x n):
//
// one local solution, whether the contact sticks or slips. It is right if |m| <= eta r_n. Otherwise the
// contact rolls. Then the two laws are solved in turn: the point with the couple of the last visit,
//
//     slip,     b_t + c (m x n),
//
// then the couple with the new impulse of the point, m = -(b_w + c n x r) / q, shortened to eta r_n. The
// normal impulse does not depend on the couple: a visit lowers a convex function of r_t and m over their
// two discs, whose only minimum is the solution.
//
// A visit classifies the contact as rolling if m was shortened in the last visit. So the solution is the only
// fixed point: a contact that is classified wrongly is classified correctly in the next visit.
#pragma once

#include <cstddef>
#include <type_traits>

#include "moreau/law/detail/coulomb_lanes.hpp"
#include "moreau/law/rolling_block.hpp"

namespace moreau::detail {

/// The local problems of the lanes, or of one contact.
/// @tparam Block RoundBlock
template <class S, class Block = RoundBlock<S>>
class RollingLanes {
 public:
  using Lanes = typename Block::Number;
  using Values = typename Lanes::Values;
  using Indices = typename Lanes::Indices;
  using Vector = typename Block::Vector;

  /// @param guess   of the couple of a contact that rolls
  /// @param rolling eta
  /// @param memory  in and out: alpha as in CoulombLanes; 1 if the contact rolls, else 0
  /// @param polish  projects slipping impulses onto the cone
  static Vector solve(const Block& block, const Vector& b, const Vector& guess,
                      const Values& friction, const Values& rolling, typename Block::Memory& memory,
                      bool polish) {
    const Values zero{}, one = Lanes::broadcast(1);
    const Indices rolls = memory[1] > zero;
    const typename Point::Vector impulse = CoulombLanes<S, Point>::solve(
        point_of(block, rolls), velocity_of(block, b, guess, rolls), friction, memory[0], polish);
    Vector r{};
    for (std::size_t d = 0; d < S::dim; ++d) r[d] = impulse[Index(d)];
    Couple couple = Algebra::moment_of_normal(Block::linear(r));
    Values length2{};
    const Values unit = unit_of(block);
    for (std::size_t k = 0; k < couples; ++k) {
      couple[k] = -(b[S::dim + k] + block.cross * couple[k]) * block.inverse_spin;
      length2 += (unit * couple[k]) * (unit * couple[k]);
    }
    const Values limit = unit * (rolling * r[0]);
    const Indices acts = b[0] < zero, beyond = acts & (length2 > limit * limit);
    memory[1] = beyond ? one : zero;
    Values scale = acts ? one : zero;
    if (Lanes::any(beyond))
      scale = beyond ? limit / Lanes::square_root(beyond ? length2 : one) : scale;
    for (std::size_t k = 0; k < couples; ++k) r[S::dim + k] = scale * couple[k];
    return r;
  }

 private:
  using Algebra = typename Block::Algebra;
  using Point = typename Block::Point;
  using Couple = typename Block::Couple;
  using Index = typename Block::Index;
  static constexpr std::size_t couples = S::angular_dim;

  /// What couples are multiplied by before they are squared, see CoulombLanes: 1, and q in single precision.
  static Values unit_of(const Block& block) {
    if constexpr (std::is_same_v<typename S::Scalar, double>)
      return Lanes::broadcast(1);
    else
      return block.spin;
  }
  static Point point_of(const Block& block, const Indices& rolls) {
    Point point = block.point;
    for (Index t = 0; t < Point::tangents; ++t) {
      point.slip[t] = rolls ? point.slip[t] : block.resting_slip[t];
      point.inverse_slip[t] = rolls ? point.inverse_slip[t] : block.inverse_resting_slip[t];
    }
    return point;
  }
  static typename Point::Vector velocity_of(const Block& block, const Vector& b,
                                            const Vector& guess, const Indices& rolls) {
    Couple couple;
    for (std::size_t k = 0; k < couples; ++k)
      couple[k] = rolls ? guess[S::dim + k] : -block.inverse_spin * b[S::dim + k];
    const auto aside = Algebra::spin_of_normal(couple);
    typename Point::Vector velocity;
    for (std::size_t d = 0; d < S::dim; ++d) velocity[Index(d)] = b[d];
    for (std::size_t t = 0; t < aside.size(); ++t) velocity[Index(1 + t)] += block.cross * aside[t];
    return velocity;
  }
};

}  // namespace moreau::detail
