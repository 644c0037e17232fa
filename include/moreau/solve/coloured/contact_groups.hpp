// SPDX-License-Identifier: MIT
// The contacts of a step, grouped for SIMD arithmetic. A group has one pair of bodies per lane, and
// no two of its pairs share a body that can move. All contact points of a pair are in its lane, so
// that the velocities of its bodies are loaded once for all of them.
//
// A hub, a body with many partners such as a moving wall, would need one group for each of its
// pairs. If it is much heavier than its partners, its pairs share groups, and the block of each of their points is
// multiplied by heavier_by_hub() (hub_share.hpp), n being the number of points of the hub in a group. The pairs of a hub that
// is as light as its partners do not share groups: shared groups would take n times the sweeps.
// The groups of a hub that is heavier still form phases of their own: all groups of such a phase read
// the velocity of the hub before the phase, so that the members of a team divide them, and n is the
// number of points in the phase. All pairs of one hub have different partners.
//
// Pairs whose bodies belong to one chunk (solve/body_chunks.hpp) come first, chunk after chunk: between two
// barriers a member of a team visits all colours of its chunks, and the velocities of the bodies stay in the
// cache of its core.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "moreau/contact/contact_pairs.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/sort_by_key.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/solve/body_chunks.hpp"
#include "moreau/solve/coloured/first_fit_colouring.hpp"
#include "moreau/solve/coloured/lane_masses.hpp"
#include "moreau/solve/coloured/pack_filler.hpp"
#include "moreau/solve/coloured/packs.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/hub_share.hpp"

namespace moreau::detail {

/// The groups of a contact problem, with the data of their contacts.
template <class Operator, class Law>
class ContactGroups {
 public:
  using S = typename Operator::Space;
  using Points = PointPack<S, Law>;
  using Lanes = typename LaneBlock<S>::Number;
  using Group = PairGroup<Lanes::lanes>;
  using Impulse = typename Operator::Vector;
  using Block = BlockOf<Law, S>;
  using Filler = PackFiller<Operator, Law>;
  static constexpr std::size_t lanes = Lanes::lanes, rows_of_point = Points::Block::rows;
  static constexpr std::uint32_t none = Filler::none;
  /// Largest tr(W^-1 W_hub) of a hub whose pairs share groups.
  static constexpr auto largest_share = typename S::Scalar(0.02);
  /// Largest sum of tr(W^-1 W_hub) over the points of a phase of a hub.
  static constexpr auto most_in_phase = typename S::Scalar(0.1);

  List<Group> groups;                       ///< sorted by chunk, then by phase
  List<Points> points;                      ///< in the order of groups
  List<std::array<LaneMass<S>, 2>> masses;  ///< of the bodies a and b of each group
  List<LaneMassMatrices<S>> mass_matrices;  ///< of groups with a body that needs them

  /// Number of velocities of LaneVelocities: one per body, and one per group for unused lanes and bodies
  /// that cannot move, so that groups of one colour never write the same velocity.
  std::size_t velocities() const { return body_count_ + groups.size(); }
  std::size_t bodies() const { return body_count_; }  ///< number of bodies

  /// Makes the groups; pack() then fills them.
  /// @param op       of a problem in which the contacts of one pair of bodies follow one another
  /// @param impulses the warm start; pairs with most points that push or approach come first within their colour
  /// @param team     threads that share the work
  void lay_out(const Operator& op, std::span<const Impulse> impulses, const Team& team) {
    body_count_ = op.body_count();
    bodies_ = op.pairs().bodies();
    first_ = op.pairs().first();
    moves_ = op.freedoms();
    isotropic_.resize(body_count_);
    for (std::size_t i = 0; i < body_count_; ++i) isotropic_[i] = op.inverse_mass(i).is_isotropic();
    chunks_.assign(body_count_, bodies_of_chunk);
    colouring_.assign(bodies_, moves_,
                      [this](std::size_t k) { return chunk_of(k) != Group::shared; });
    find_shares(op);
    sort(op, impulses, team);
    groups.clear();
    phase_points_.clear();
    begin_.clear();
    point_count_ = matrices_ = 0;
    for (std::size_t k = 0; k < order_.size();) {
      const std::uint64_t kind = order_[k].key & kind_mask;
      std::size_t end = k + 1;
      while (kind != alone_kind && end < order_.size() && end - k < lanes &&
             (order_[end].key & kind_mask) == kind)
        ++end;
      lay_out(k, end);
      k = end;
    }
    begin_.push_back(order_.size());
    points.resize(point_count_);
    contact_of_.resize(point_count_ * lanes, none);
    masses.resize(groups.size());
    mass_matrices.resize(matrices_);
  }

  /// Fills a group with its bodies and contacts. Several threads may fill different groups.
  /// @param problem,impulses those of lay_out()
  void pack(const ContactProblem<Operator, Law>& problem, std::span<const Impulse> impulses,
            std::size_t number) {
    const Operator& op = problem.delassus;
    Group& group = groups[number];
    const auto members_of = [&](std::size_t k) {
      return std::span(order_).subspan(begin_[k], begin_[k + 1] - begin_[k]);
    };
    const auto members = members_of(number);
    if (number + 1 < groups.size())
      for (const Ordered& next : members_of(number + 1))
        op.prefetch(first_[next.pair], points_of(next.pair));
    const auto still = static_cast<std::uint32_t>(body_count_ + number);
    group.a.fill(group.hub == Hub::a ? body_of(members[0].pair, Hub::a) : still);
    group.b.fill(group.hub == Hub::b ? body_of(members[0].pair, Hub::b) : still);
    masses[number] = {};
    if (group.matrices != Group::isotropic) mass_matrices[group.matrices] = {};
    for (std::size_t lane = 0; lane < members.size(); ++lane) {
      const auto& [a, b] = bodies_[members[lane].pair];
      masses[number][0].set(lane, op.inverse_mass(a));
      masses[number][1].set(lane, op.inverse_mass(b));
      if (group.matrices != Group::isotropic)
        mass_matrices[group.matrices].set(lane, op.inverse_mass(a), op.inverse_mass(b));
    }
    std::uint32_t together = 0;  // points of the group
    for (const Ordered& member : members) together += points_of(member.pair);
    if (together < group.count * lanes)
      std::fill_n(contact_of_.begin() + std::ptrdiff_t(group.first * lanes), group.count * lanes,
                  none);
    for (std::size_t lane = 0; lane < members.size(); ++lane) {
      const std::uint32_t k = members[lane].pair;
      if (moves_[bodies_[k][0]]) group.a[lane] = bodies_[k][0];
      if (moves_[bodies_[k][1]]) group.b[lane] = bodies_[k][1];
      // Points that are likely to act come first.
      std::size_t p = group.first;
      const std::uint32_t count = points_of(k), places = std::bit_ceil(count);
      for (const bool acts : {true, false})
        for (std::uint32_t i = 0; i < places; ++i) {
          const std::uint32_t c = first_[k] + scattered(i, count);
          if (c >= first_[k + 1] || likely(op, impulses, c) != acts) continue;
          contact_of_[p++ * lanes + lane] = c;
        }
    }
    for (std::uint32_t p = group.first; p < group.first + group.count; ++p)
      Filler::fill(points[p], &contact_of_[p * lanes], problem, impulses);
    if (group.hub == Hub::none) return;
    const std::uint32_t with_hub =
        group.delays_hub() ? phase_points_[group.phase - FirstFitColouring::colours] : together;
    for (std::uint32_t p = group.first; p < group.first + group.count; ++p)
      for (std::size_t lane = 0; lane < members.size(); ++lane) {
        const std::uint32_t c = contact_of_[p * lanes + lane];
        if (c == none) continue;
        Block block = op.block(c);
        block *= heavier_by_hub(op, c, group.hub == Hub::a, with_hub);
        points[p].block.set(lane, block);
      }
  }

  /// Takes other free velocities and impulses of the contacts of lay_out(), after pack().
  void refill(const ContactProblem<Operator, Law>& problem, std::span<const Impulse> impulses,
              const Team& team) {
    team.share_each(points.size(), 64, [&](std::size_t p) {
      Filler::refill(points[p], &contact_of_[p * lanes], problem, impulses);
    });
  }
  /// Takes other impulses alone.
  void refill(std::span<const Impulse> impulses, const Team& team) {
    team.share_each(points.size(), 64, [&](std::size_t p) {
      Filler::set_impulses(points[p], &contact_of_[p * lanes], impulses);
    });
  }
  /// Writes the impulses of the groups in the order of the problem.
  void unpack(std::span<Impulse> impulses, const Team& team) const {
    team.share_each(points.size(), 128, [&](std::size_t p) {
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const std::uint32_t c = contact_of_[p * lanes + lane];
        if (c == none) continue;
        for (std::size_t d = 0; d < rows_of_point; ++d)
          impulses[c][Eigen::Index(d)] = points[p].impulse[d][lane];
      }
    });
  }

 private:
  /// Pairs inside a chunk come first, sorted by chunk and colour; then the others, sorted by colour and
  /// hub. Of equal pairs, those with most points that are likely to act come first, then those with most
  /// points. Bits of the key, from the highest:
  ///
  ///     inside a chunk   63: 0   62-24: chunk                                    23-16: colour   15-8: idle   7-0: fewer
  ///     other pairs      63: 1   62-50: colour   49-48: Hub   47-16: body of hub                 15-8: idle   7-0: fewer
  ///
  /// idle and fewer are 255 less the number of points that act, and of all points.
  struct Ordered {
    std::uint64_t key;
    std::uint32_t pair;
  };
  static constexpr int hub_bits = 16, side_bits = hub_bits + 32, colour_bits = side_bits + 2;
  static constexpr int inner_colour_bits = 16, chunk_bits = inner_colour_bits + 8;
  static constexpr std::uint64_t not_inside = std::uint64_t{1} << 63;
  static constexpr std::uint64_t kind_mask = ~((std::uint64_t{1} << hub_bits) - 1);
  /// In place of a colour: pairs without a phase. Those without a hub share no group.
  static constexpr std::uint64_t serial = FirstFitColouring::colours + 1,
                                 alone_kind = not_inside | serial << colour_bits;
  static constexpr std::size_t bodies_of_chunk = 600;

  void sort(const Operator& op, std::span<const Impulse> impulses, const Team& team) {
    order_.resize(bodies_.size());
    team.share_each(bodies_.size(), 256, [&](std::size_t pair) {
      const auto k = static_cast<std::uint32_t>(pair);
      std::uint32_t acting = 0;
      for (std::uint32_t c = first_[k]; c < first_[k + 1]; ++c) acting += likely(op, impulses, c);
      const std::uint64_t fewer = 255 - std::min<std::uint32_t>(255, first_[k + 1] - first_[k]);
      const std::uint64_t idle = 255 - std::min<std::uint32_t>(255, acting);
      const std::uint32_t chunk = chunk_of(k);
      if (chunk != Group::shared && colouring_[k] != FirstFitColouring::colours) {
        order_[k] = {std::uint64_t{chunk} << chunk_bits |
                         std::uint64_t{colouring_[k]} << inner_colour_bits | idle << 8 | fewer,
                     k};
        return;
      }
      const Hub hub = hub_of(k);
      const std::uint64_t body = hub == Hub::none ? 0 : body_of(k, hub);
      const bool is_serial = colouring_[k] == FirstFitColouring::colours &&
                             (hub == Hub::none || !forms_phases(body_of(k, hub)));
      order_[k] = {not_inside | (is_serial ? serial : std::uint64_t{colouring_[k]}) << colour_bits |
                       std::uint64_t{static_cast<std::uint8_t>(hub)} << side_bits |
                       body << hub_bits | idle << 8 | fewer,
                   k};
    });
    sort_by_key(order_, sorted_);
  }
  /// The chunk of all bodies of a pair that move; `shared` if there are two.
  std::uint32_t chunk_of(std::size_t k) const {
    const auto [a, b] = bodies_[k];
    return chunks_.of_pair(a, b, moves_[a] != 0, moves_[b] != 0);
  }
  /// The body of a pair that is its hub.
  std::uint32_t body_of(std::size_t k, Hub hub) const { return bodies_[k][hub == Hub::b]; }
  /// The heavy hub of a pair; none if the pair has no hub, a light hub or two hubs.
  Hub hub_of(std::uint32_t k) const {
    if (colouring_[k] != FirstFitColouring::colours) return Hub::none;
    const bool a = colouring_.is_hub(bodies_[k][0]), b = colouring_.is_hub(bodies_[k][1]);
    if (a == b || !(share_[body_of(k, a ? Hub::a : Hub::b)] <= largest_share)) return Hub::none;
    return a ? Hub::a : Hub::b;
  }
  /// Finds the largest share of each hub in its contacts. Hubs above largest_share are light.
  void find_shares(const Operator& op) {
    share_.assign(body_count_, 0);
    for (std::uint32_t k = 0; k < bodies_.size(); ++k) {
      const Hub hub = hub_of(k);
      if (hub == Hub::none) continue;
      auto& share = share_[body_of(k, hub)];
      for (std::uint32_t c = first_[k]; c < first_[k + 1] && share <= largest_share; ++c) {
        const typename S::Scalar own = share_of_hub(op, c, hub == Hub::a);
        if (!(own <= share)) share = own;
      }
    }
  }
  static bool likely(const Operator& op, std::span<const Impulse> impulses, std::uint32_t c) {
    return impulses[c][0] > 0 || op.free_velocity(c)[0] < 0;
  }

  /// Adds the group of the pairs order_[begin] .. order_[end - 1], without its contacts.
  void lay_out(std::size_t begin, std::size_t end) {
    const std::uint32_t pair = order_[begin].pair;
    Group group;
    group.first = point_count_;
    group.count = group.active = 0;
    group.hub = hub_of(pair);
    group.is_simple = group.hub == Hub::none;
    const std::uint64_t key = order_[begin].key;
    group.chunk = key & not_inside ? Group::shared : static_cast<std::uint32_t>(key >> chunk_bits);
    std::uint32_t together = 0;
    bool all_isotropic = true;
    for (std::size_t k = begin; k < end; ++k) {
      const auto [a, b] = bodies_[order_[k].pair];
      all_isotropic = all_isotropic && isotropic_[a] && isotropic_[b];
      group.count = std::max(group.count, points_of(order_[k].pair));
      together += points_of(order_[k].pair);
    }
    point_count_ += group.count;
    begin_.push_back(begin);
    group.phase = group.hub != Hub::none ? phase_of_hub(body_of(pair, group.hub), together)
                  : colouring_[pair] == FirstFitColouring::colours ? Group::serial
                                                                   : colouring_[pair];
    group.matrices = all_isotropic ? Group::isotropic : matrices_++;
    groups.push_back(group);
  }
  /// Whether a hub is so heavy that a phase has room for enough points to be worth it.
  bool forms_phases(std::uint32_t body) const {
    constexpr auto fewest = typename S::Scalar(16 * lanes);
    return share_[body] * fewest <= most_in_phase;
  }
  /// The phase of a group of contacts of a hub: the phase added last, if it belongs to this hub and has
  /// room, otherwise a new one.
  /// @param together points of the group
  std::uint32_t phase_of_hub(std::uint32_t body, std::uint32_t together) {
    using T = typename S::Scalar;
    if (!forms_phases(body)) return Group::serial;
    const bool has_room = !phase_points_.empty() && phase_hub_ == body &&
                          share_[body] * T(phase_points_.back() + together) <= most_in_phase;
    if (!has_room) phase_points_.push_back(0);
    phase_hub_ = body;
    phase_points_.back() += together;
    return FirstFitColouring::colours + static_cast<std::uint32_t>(phase_points_.size()) - 1;
  }
  std::uint32_t points_of(std::uint32_t pair) const { return first_[pair + 1] - first_[pair]; }

  /// The order in which the points of a pair are visited: i with its bits reversed. Vertices of a face often have
  /// their numbers along its rim. A sweep along the rim hardly damps the rocking of a face of many vertices, and with
  /// friction under a tall body it lets the rocking grow.
  /// @param i below std::bit_ceil(count); the result can be `count` or more
  static std::uint32_t scattered(std::uint32_t i, std::uint32_t count) {
    constexpr std::uint32_t few = 4;
    if (count <= few) return i;
    std::uint32_t reversed = 0;
    for (std::uint32_t bit = 1; bit < std::bit_ceil(count); bit *= 2, i /= 2)
      reversed = 2 * reversed + i % 2;
    return reversed;
  }

  std::size_t body_count_ = 0;
  std::uint32_t point_count_ = 0, matrices_ = 0;  // PointPacks; groups with mass_matrices
  List<std::size_t> begin_;  // of each group in order_; at the end, the number of pairs
  // Of the operator of lay_out(): the pairs, see ContactPairs, and which bodies move (not 0).
  std::span<const ContactPairs::Pair> bodies_;
  std::span<const std::uint32_t> first_;
  std::span<const unsigned char> moves_;
  List<unsigned char> isotropic_;  // bodies
  BodyChunks chunks_;
  List<typename S::Scalar> share_;    // of each hub, see find_shares()
  List<std::uint32_t> phase_points_;  // points of each phase of a hub
  std::uint32_t phase_hub_ = 0;       // hub of the last phase
  List<Ordered> order_, sorted_;
  List<std::uint32_t> contact_of_;  // of every lane of every PointPack, or none
  FirstFitColouring colouring_;
};

}  // namespace moreau::detail
