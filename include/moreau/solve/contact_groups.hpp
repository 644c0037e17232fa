// SPDX-License-Identifier: MIT
// The contacts of a step side by side: pairs of bodies that do not touch one another's bodies fill
// the lanes of a group, so that a group is solved by wide arithmetic as one contact would be. The
// points of a pair stay together: its bodies are loaded once for all of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "moreau/contact/lane_problem.hpp"
#include "moreau/law/lanes.hpp"
#include "moreau/solve/pair_colouring.hpp"

namespace moreau::detail {

/// One contact point per lane. Inert lanes have no rows and a free velocity that separates.
template <class S, class Law>
struct PointPack {
  using Block = LaneBlock<S>;
  using Values = typename Block::Values;
  using Vector = typename Block::Vector;

  std::array<Vector, S::dofs> rows_a{}, rows_b{};  ///< J M^-1/2, one entry of y after the other
  Block block = Block::unit();
  Vector free{Values{} + 1};
  LawLanes<Law, S> law{};
  Vector impulse{}, before{};  ///< after the last sweep and the one before it
};

/// As many pairs as there are lanes, no two sharing a movable body.
template <int Lanes>
struct PairPack {
  std::uint32_t first, count;  ///< PointPacks
  std::uint32_t awake;         ///< of them, those that sweeps between two checks visit: the first
  std::array<std::uint32_t, static_cast<std::size_t>(Lanes)> a, b;
};

template <class Operator, class Law>
class ContactGroups {
 public:
  using S = typename Operator::Space;
  using Points = PointPack<S, Law>;
  using W = typename Points::Block::W;
  using Pairs = PairPack<W::lanes>;
  using Impulse = typename Operator::Vector;
  static constexpr std::size_t lanes = W::lanes;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  std::vector<Pairs> pairs;    ///< sorted by colour
  std::vector<Points> points;  ///< in the order of pairs

  /// @param op       rows and blocks of all contacts; contacts of one pair follow one another
  /// @param impulses the first guess; pairs that carry one come first within their colour
  void build(const Operator& op, std::span<const Law> laws, std::span<const std::uint32_t> law_of,
             std::span<const Impulse> impulses) {
    find_pairs(op);
    colouring_.assign(bodies_, moves_);
    sort(op, impulses);
    pairs.clear();
    points.clear();
    contact_of_.clear();
    const auto dummy = static_cast<std::uint32_t>(op.body_count());
    for (std::size_t k = 0; k < order_.size();) {
      const std::uint32_t colour = colouring_[order_[k].pair];
      std::size_t end = k + 1;
      while (colour < PairColouring::colours && end < order_.size() && end - k < lanes &&
             colouring_[order_[end].pair] == colour)
        ++end;
      pack(op, laws, law_of, impulses, std::span(order_).subspan(k, end - k), dummy);
      k = end;
    }
  }

  /// Impulses of the packs, back in the operator's order.
  void unpack(std::span<Impulse> impulses) const {
    for (std::size_t p = 0; p < points.size(); ++p)
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const std::uint32_t c = contact_of_[p * lanes + lane];
        if (c == none) continue;
        for (std::size_t d = 0; d < S::dim; ++d)
          impulses[c][Eigen::Index(d)] = points[p].impulse[d][lane];
      }
  }

 private:
  struct Ordered {
    std::uint64_t key;
    std::uint32_t pair;
    bool operator<(const Ordered& other) const {
      return key != other.key ? key < other.key : pair < other.pair;
    }
  };

  void find_pairs(const Operator& op) {
    moves_.assign(op.body_count(), 0);
    bodies_.clear();
    first_.clear();
    for (std::size_t c = 0; c < op.size(); ++c) {
      const std::array<std::uint32_t, 2> bodies = op.bodies(c);
      if (c == 0 || bodies != bodies_.back()) {
        bodies_.push_back(bodies);
        first_.push_back(static_cast<std::uint32_t>(c));
      }
      if (!moves_[bodies[0]]) moves_[bodies[0]] = !op.rows_a(c).isZero(0);
      if (!moves_[bodies[1]]) moves_[bodies[1]] = !op.rows_b(c).isZero(0);
    }
    first_.push_back(static_cast<std::uint32_t>(op.size()));
  }

  /// By colour; then pairs of many points that are likely to act; then pairs of many points.
  void sort(const Operator& op, std::span<const Impulse> impulses) {
    order_.clear();
    for (std::uint32_t k = 0; k < bodies_.size(); ++k) {
      std::uint32_t acting = 0;
      for (std::uint32_t c = first_[k]; c < first_[k + 1]; ++c) acting += likely(op, impulses, c);
      const std::uint64_t fewer = 255 - std::min<std::uint32_t>(255, first_[k + 1] - first_[k]);
      const std::uint64_t idle = 255 - std::min<std::uint32_t>(255, acting);
      order_.push_back({std::uint64_t{colouring_[k]} << 16 | idle << 8 | fewer, k});
    }
    std::sort(order_.begin(), order_.end());
  }

  static bool likely(const Operator& op, std::span<const Impulse> impulses, std::uint32_t c) {
    return impulses[c][0] > 0 || op.free_velocity(c)[0] < 0;
  }

  void pack(const Operator& op, std::span<const Law> laws, std::span<const std::uint32_t> law_of,
            std::span<const Impulse> impulses, std::span<const Ordered> members,
            std::uint32_t dummy) {
    Pairs group;
    group.first = static_cast<std::uint32_t>(points.size());
    group.count = group.awake = 0;
    group.a.fill(dummy);
    group.b.fill(dummy);
    for (const Ordered& member : members)
      group.count = std::max(group.count, first_[member.pair + 1] - first_[member.pair]);
    points.resize(points.size() + group.count);
    contact_of_.resize(points.size() * lanes, none);
    for (std::size_t lane = 0; lane < members.size(); ++lane) {
      const std::uint32_t k = members[lane].pair;
      group.a[lane] = bodies_[k][0];
      group.b[lane] = bodies_[k][1];
      // Points that are likely to act come first.
      std::size_t p = group.first;
      for (const bool acts : {true, false})
        for (std::uint32_t c = first_[k]; c < first_[k + 1]; ++c) {
          if (likely(op, impulses, c) != acts) continue;
          contact_of_[p * lanes + lane] = c;
          set(points[p++], lane, op, laws[law_of[c]], impulses[c], c);
        }
    }
    pairs.push_back(group);
  }

  static void set(Points& point, std::size_t lane, const Operator& op, const Law& law,
                  const Impulse& impulse, std::uint32_t c) {
    const auto& rows_a = op.rows_a(c);
    const auto& rows_b = op.rows_b(c);
    for (std::size_t d = 0; d < S::dim; ++d) {
      const auto column = Eigen::Index(d);
      for (std::size_t k = 0; k < S::dofs; ++k) {
        point.rows_a[k][d][lane] = rows_a(Eigen::Index(k), column);
        point.rows_b[k][d][lane] = rows_b(Eigen::Index(k), column);
      }
      point.free[d][lane] = op.free_velocity(c)[column];
      point.impulse[d][lane] = point.before[d][lane] = impulse[column];
    }
    point.block.set(lane, op.block(c));
    point.law.set(lane, law);
  }

  std::vector<std::array<std::uint32_t, 2>> bodies_;
  std::vector<std::uint32_t> first_;  // contact of each pair, and their number at the end
  std::vector<unsigned char> moves_;
  std::vector<Ordered> order_;
  std::vector<std::uint32_t> contact_of_;  // of every lane of every point
  PairColouring colouring_;
};

}  // namespace moreau::detail
