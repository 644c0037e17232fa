// SPDX-License-Identifier: MIT
// Projected Gauss-Seidel sweeps of the overlap correction. Contact c pushes its bodies apart by a multiplier p >= 0
// along its normal: d += M^-1 J^T dp, where J is the change of its gap per shift d of the bodies.
//
//  1. The sweeps take the contacts that are too deep or nearly so, and later those that the shifts so far could close. Each
//     time the new contacts form a batch. A contact that no shift can close would change nothing. Only contacts whose gap is
//     not far beyond the shifts are candidates; the others become candidates when the shifts have grown. The search for
//     candidates skips blocks of contacts without a contact that is deep enough, and reads the shifts only of bodies that have a
//     row. So it visits few contacts of a packing.
//  2. A contact that is taken gets a row with J and M^-1 J^T: a visit then reads the row and two shifts, padded to whole
//     SIMD registers.
//  3. The rows of a batch are sorted by level: one more than the highest level of the rows before it that share a body
//     with it that moves. The result is that of the order of the contacts, in which shifts go up a stack in one sweep.
//     Rows of one level share no such body, so that a CPU need not end a visit before it begins the next one.
//
// Threads share all steps. The result is the same to the bit for any number of threads:
//
//  - contacts and bodies are searched in slices, whose results are put together in the order of the slices;
//  - the sweeps are shared by the chunks of bodies of the contact solver (solve/body_chunks.hpp). The contacts inside a
//    chunk are a part, those between chunks are one more. Each part has its own rows and levels. In a sweep the members
//    of a team visit the parts inside chunks, then one member visits the contacts between chunks.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

#include "moreau/contact/contact.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/motion/mobility.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/solve/body_chunks.hpp"
#include "moreau/solve/shared_bodies.hpp"

namespace moreau::detail {

/// The sweeps of the overlap correction.
template <class S>
class OverlapSweeps {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Angular = typename S::Angular;
  using Twist = typename S::Twist;
  /// A Twist padded to whole SIMD registers; the padding is zero.
  static constexpr int width = (S::dofs + 3) / 4 * 4;
  using PaddedTwist = Eigen::Matrix<Scalar, width, 1>;
  /// Least bodies of a chunk. The contact solver has twice as many, because its chunks leave SIMD lanes empty.
  static constexpr std::size_t bodies_of_chunk = 300;

  /// Contacts of a block, see run().
  static constexpr std::size_t block = 16;

  /// Begins without shifts.
  void start(std::size_t bodies) {
    shifts_.assign(bodies + 1, PaddedTwist::Zero());
    reach_.assign(bodies, 0);
    // Whole words, twice.
    touched_.assign(2 * words(bodies) * word, 0);
  }
  /// Pushes a body at a point, before the sweeps.
  /// @param push  mass times displacement, world axes [kg m]
  /// @param lever from the centre of the body to the point [m]
  void push(const InverseMass<S>& mass, std::uint32_t body, const Vector& push,
            const Vector& lever) {
    mass.add_change(shifts_[body], push, S::moment(lever, push));
    touched_[body] = 1;
  }
  /// Makes sweeps.
  /// @param op      operator of the contacts
  /// @param depths  overlap beyond the slop, < 0 if there is none, one per contact [m]
  /// @param deepest the largest depth of each block of contacts, or more [m]
  /// @param guess   of the shifts: contacts that shifts of this length could close are taken at once [m]
  /// @param target  function: depth -> what the change of the gap must not be below [m]
  /// @param finish  function: finish(i, shift) gets the shift of a body i that has moved: displacement [m], rotation
  ///                vector [rad]
  /// @param shared  bodies that other processes share; null: none
  void run(int sweeps, const auto& op, std::span<const Contact<S>> contacts,
           std::span<const Scalar> depths, std::span<const Scalar> deepest, Scalar guess,
           const auto& target, const auto& finish, const Team& team, SharedBodies* shared) {
    moves_ = op.freedoms();
    divide(contacts.size());
    const Scalar longest = op.longest_lever();
    const auto work = [&](int rank, int size, const TeamBarrier& wait) {
      Member me{Share(slices_.size(), rank, size), Share(inner_, rank, size), rank + 1 == size};
      for (int k = 0; k < sweeps; ++k) {
        if (k <= 2 || k == 4 || k == 8 || k == 32) {
          if (me.is_apart) wait();
          for (std::size_t s = me.slices.begin; s < me.slices.end; ++s)
            find_reach(slices_[s], longest);
          wait();
          take(me, contacts, depths, deepest, k == 0 ? guess : Scalar(0));
          wait();
          fill(me, op, contacts, target);
        }
        for (std::size_t p = me.parts.begin; p < me.parts.end; ++p) visit_all(parts_[p]);
        me.is_apart = me.between == 0 && !shared;
        if (me.is_apart) continue;
        wait();
        if (rank == 0) visit_all(parts_[inner_]);
        if (rank == 0 && shared) {
          shared->average(std::span(shifts_[0].data(), moves_.size() * std::size_t(width)), width);
          std::fill(touched_.begin(), touched_.end(), 1);  // by any process
        }
        wait();
      }
      if (me.is_apart) wait();
      for (std::size_t s = me.slices.begin; s < me.slices.end; ++s) finish_all(slices_[s], finish);
    };
    team.run_timed(TimedWork::correction, inner_ == 0 ? 0 : contacts.size(), least_contacts, work);
  }

 private:
  /// The data that a visit reads. The shift of a body that cannot move is that after the last body; it stays zero.
  struct Row {
    PaddedTwist gap_a, gap_b;    // (n, l x n): J of b, and less J of a [-, m]
    PaddedTwist move_a, move_b;  // M^-1 times these [1/kg, 1/(kg m)]
    Scalar inverse;              // 1 / (J M^-1 J^T) [kg]
    Scalar target;               // [m]
    Scalar push;                 // p [kg m]
    std::uint32_t a, b;
  };

  /// A contact that is not yet taken.
  struct Candidate {
    Scalar depth;
    std::uint32_t a, b, contact, part;
  };
  /// The k-th contact of a batch: its index among the taken contacts, and its level. `next` belongs to the k-th level of the
  /// batch: the number of its rows, then its next free row.
  struct Ordered {
    std::uint32_t taken, level, next;
  };
  /// Contacts and bodies that a member of a team searches. The candidates and the taken contacts of a slice stand in
  /// candidates_ and behind taken_ from the number of its first contact on.
  struct Slice {
    Share contacts{0, 0, 1}, bodies{0, 0, 1};
    std::size_t candidates = 0, taken = 0;
    Scalar reach = 0;  // largest of the bodies [m]
  };
  struct Range {
    std::size_t begin, end;
  };
  /// Contacts inside a chunk, or between chunks.
  struct Part {
    std::array<Range, 6> batches{};  // rows
    std::size_t batch_count = 0;
    Range bodies;            // that the contacts move
    std::uint32_t* levels;   // one per body: above its rows in a batch
    unsigned char* touched;  // one per body: whether it has a row
  };
  /// What a member of a team works on, and how far all members are.
  struct Member {
    Share slices, parts;
    bool is_last;
    std::size_t rows = 0, between = 0;  // of all parts; of the part between chunks
    bool is_apart = false;              // whether other members may still change shifts
    Scalar listed =
        std::numeric_limits<Scalar>::infinity();  // least depth of candidates so far [m]
  };
  static constexpr int slice_count = 16;
  /// Contacts below which one thread takes less time.
  static constexpr std::size_t least_contacts = 4096;
  /// Twice the multiple of the shifts up to which contacts become candidates.
  static constexpr Scalar far = 4;

  MOREAU_COLD void divide(std::size_t contacts) {
    const std::size_t bodies = moves_.size();
    for (int s = 0; s < slice_count; ++s) {
      Share of_contacts((contacts + block - 1) / block, s, slice_count),
          of_bodies(words(bodies), s, slice_count);
      of_contacts.begin *= block, of_contacts.end = std::min(contacts, of_contacts.end * block);
      of_bodies.begin *= word, of_bodies.end = std::min(bodies, of_bodies.end * word);
      slices_[std::size_t(s)] = {of_contacts, of_bodies};
    }
    chunks_.assign(bodies, bodies_of_chunk);
    inner_ = chunks_.size();
    levels_.resize(2 * bodies);
    parts_.resize(inner_ + 1);
    for (std::size_t p = 0; p < inner_; ++p)
      parts_[p] = {
          {}, 0, {chunks_.begin(p), chunks_.begin(p + 1)}, levels_.data(), touched_.data()};
    parts_[inner_] = {
        {}, 0, {0, bodies}, levels_.data() + bodies, touched_.data() + touched_.size() / 2};
    counts_.resize(slices_.size() * parts_.size());
    // All memory at once: steps with more deep contacts need no more.
    if (rows_.size() < contacts) {
      candidates_.resize(2 * contacts);
      order_.resize(contacts);
      rows_.resize(contacts);
    }
    taken_ = candidates_.data() + rows_.size();
  }

  static constexpr std::size_t word = sizeof(std::uint64_t);  // bodies whose marks are read at once
  static std::size_t words(std::size_t bodies) { return (bodies + word - 1) / word; }
  /// Calls use(i) for the bodies of a slice that a row or a push may have moved.
  void for_each_touched(const Slice& slice, const auto& use) const {
    const std::size_t half = touched_.size() / 2;
    for (std::size_t i = slice.bodies.begin; i < slice.bodies.end; i += word) {
      std::uint64_t inner, between;
      std::memcpy(&inner, &touched_[i], word);
      std::memcpy(&between, &touched_[half + i], word);
      if ((inner | between) == 0) continue;
      for (std::size_t k = i; k < std::min(i + word, slice.bodies.end); ++k)
        if (touched_[k] || touched_[half + k]) use(k);
    }
  }
  /// Bounds how far each body of a slice has moved a point at a distance up to `longest` from its centre.
  MOREAU_COMPILED_ONCE void find_reach(Slice& slice, Scalar longest) {
    slice.reach = 0;
    for_each_touched(slice, [&](std::size_t i) {
      const PaddedTwist& shift = shifts_[i];
      reach_[i] = shift.squaredNorm() > 0
                      ? linear<S>(shift).norm() + longest * angular<S>(shift).norm()
                      : Scalar(0);
      slice.reach = std::max(slice.reach, reach_[i]);
    });
  }
  /// Takes the candidates that the shifts can close, as a batch.
  /// @param least reach of bodies that move [m]
  MOREAU_COMPILED_ONCE void take(Member& me, std::span<const Contact<S>> contacts,
                                 std::span<const Scalar> depths, std::span<const Scalar> deepest,
                                 Scalar least) {
    Scalar reach = least;
    for (const Slice& slice : slices_) reach = std::max(reach, slice.reach);
    const bool is_beyond = -2 * reach < me.listed;
    for (std::size_t s = me.slices.begin; s < me.slices.end; ++s) {
      if (is_beyond) list(slices_[s], contacts, depths, deepest, -far * reach, me.listed);
      take(slices_[s], least, reach);
    }
    if (is_beyond) me.listed = -far * reach;
  }
  /// Makes candidates of the contacts whose depth is in (least, most].
  void list(Slice& slice, std::span<const Contact<S>> contacts, std::span<const Scalar> depths,
            std::span<const Scalar> deepest, Scalar least, Scalar most) {
    std::size_t end = slice.contacts.begin + slice.candidates;
    for (std::size_t first = slice.contacts.begin; first < slice.contacts.end; first += block) {
      if (!(deepest[first / block] > least)) continue;
      for (std::size_t c = first; c < std::min(first + block, slice.contacts.end); ++c) {
        if (!(depths[c] > least && depths[c] <= most)) continue;
        const std::uint32_t a = contacts[c].a, b = contacts[c].b;
        const auto part = std::min(chunks_.of_pair(a, b, moves_[a] != 0, moves_[b] != 0),
                                   static_cast<std::uint32_t>(inner_));
        candidates_[end++] = {depths[c], a, b, static_cast<std::uint32_t>(c), part};
      }
    }
    slice.candidates = end - slice.contacts.begin;
  }
  /// @param most the largest reach of a body [m]
  void take(Slice& slice, Scalar least, Scalar most) {
    const std::size_t first = slice.contacts.begin;
    std::uint32_t* const counts = &counts_[std::size_t(&slice - slices_.data()) * parts_.size()];
    std::fill(counts, counts + parts_.size(), 0);
    std::size_t taken = first, left = first;
    const auto reach = [&](std::uint32_t body) {
      return moves_[body] ? std::max(least, reach_[body]) : reach_[body];
    };
    for (std::size_t k = first; k < first + slice.candidates; ++k) {
      const Candidate& candidate = candidates_[k];
      if (candidate.depth + most + most > 0 &&
          candidate.depth + reach(candidate.a) + reach(candidate.b) > 0) {
        taken_[taken++] = candidate;
        ++counts[candidate.part];
      } else {
        if (left != k) candidates_[left] = candidate;
        ++left;
      }
    }
    slice.candidates = left - first;
    slice.taken = taken - first;
  }
  /// Makes the rows of a batch.
  MOREAU_COMPILED_ONCE void fill(Member& me, const auto& op, std::span<const Contact<S>> contacts,
                                 const auto& target) {
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      Range batch{me.rows, me.rows};
      for (std::size_t s = 0; s < slices_.size(); ++s) batch.end += counts_[s * parts_.size() + p];
      me.rows = batch.end;
      if (p == inner_) me.between += batch.end - batch.begin;
      const bool is_own = p == inner_ ? me.is_last : p >= me.parts.begin && p < me.parts.end;
      if (!is_own || batch.begin == batch.end) continue;
      parts_[p].batches[parts_[p].batch_count++] = batch;
      fill(p, batch, op, contacts, target);
    }
  }
  /// Makes the rows of a part.
  void fill(std::size_t number, const Range& batch, const auto& op,
            std::span<const Contact<S>> contacts, const auto& target) {
    const Part& part = parts_[number];
    std::fill(part.levels + part.bodies.begin, part.levels + part.bodies.end, 0);
    Ordered* const batch_order = &order_[batch.begin];
    std::size_t count = 0;
    std::uint32_t levels = 0;
    for (const Slice& slice : slices_)
      for (std::size_t k = slice.contacts.begin; k < slice.contacts.begin + slice.taken; ++k) {
        if (taken_[k].part != number) continue;
        const std::uint32_t level = level_of(contacts[taken_[k].contact], part.levels);
        if (level == levels) batch_order[levels++].next = 0;
        ++batch_order[level].next;
        batch_order[count].taken = static_cast<std::uint32_t>(k);
        batch_order[count++].level = level;
      }
    auto end = static_cast<std::uint32_t>(batch.begin);
    for (std::uint32_t k = 0; k < levels; ++k) end += std::exchange(batch_order[k].next, end);
    for (std::size_t k = 0; k < count; ++k) {
      const Candidate& taken = taken_[batch_order[k].taken];
      fill(rows_[batch_order[batch_order[k].level].next++], op, contacts[taken.contact],
           taken.contact, target(taken.depth));
      for (const std::uint32_t body : {taken.a, taken.b})
        if (moves_[body]) part.touched[body] = 1;
    }
  }
  /// The level of a contact, above those of its bodies that move, which it raises.
  std::uint32_t level_of(const Contact<S>& contact, std::uint32_t* levels) const {
    const bool a = moves_[contact.a], b = moves_[contact.b];
    const std::uint32_t level = std::max(a ? levels[contact.a] : 0, b ? levels[contact.b] : 0);
    if (a) levels[contact.a] = level + 1;
    if (b) levels[contact.b] = level + 1;
    return level;
  }
  void fill(Row& row, const auto& op, const Contact<S>& contact, std::uint32_t c,
            Scalar target) const {
    const auto still = static_cast<std::uint32_t>(moves_.size());
    const Vector normal = contact.frame.col(0);
    const auto set = [&](PaddedTwist& gap, PaddedTwist& move, const InverseMass<S>& mass,
                         const Vector& lever) {
      const Angular arm = S::moment(lever, normal);
      const Vector velocity = mass.velocity_of(normal);
      const Angular spin = mass.spin_of(arm);
      for (int k = 0; k < S::dim; ++k) gap[k] = normal[k], move[k] = velocity[k];
      for (int k = 0; k < S::angular_dim; ++k) gap[S::dim + k] = arm[k], move[S::dim + k] = spin[k];
      for (int k = S::dofs; k < width; ++k) gap[k] = move[k] = 0;
    };
    set(row.gap_a, row.move_a, op.inverse_mass(contact.a), contact.lever_a);
    set(row.gap_b, row.move_b, op.inverse_mass(contact.b), contact.lever_b);
    row.inverse = op.normal(c) > 0 ? 1 / op.normal(c) : Scalar(0);
    row.target = target;
    row.push = 0;
    row.a = moves_[contact.a] ? contact.a : still;
    row.b = moves_[contact.b] ? contact.b : still;
  }

  MOREAU_COMPILED_ONCE void finish_all(const Slice& slice, const auto& finish) const {
    for_each_touched(slice, [&](std::size_t i) {
      if (!shifts_[i].isZero(0)) finish(i, Twist(shifts_[i].template head<S::dofs>()));
    });
  }

  /// Visits all rows of a part once.
  MOREAU_COMPILED_ONCE void visit_all(const Part& part) {
    for (const Range& batch : std::span(part.batches).first(part.batch_count))
      visit(std::span(rows_).subspan(batch.begin, batch.end - batch.begin));
  }
  void visit(std::span<Row> rows) {
    const std::size_t still = moves_.size();
    for (Row& row : rows) {
      PaddedTwist &a = shifts_[row.a], &b = shifts_[row.b];
      const Scalar opening = (row.gap_b.cwiseProduct(b) - row.gap_a.cwiseProduct(a)).sum();
      const Scalar push = std::max(Scalar(0), row.push + (row.target - opening) * row.inverse);
      const Scalar change = push - row.push;
      if (change == 0) continue;  // as of contacts that stay open: the next visits need not wait
      row.push = push;
      if (row.a != still) a -= change * row.move_a;
      if (row.b != still) b += change * row.move_b;
    }
  }

  // One per body.
  std::span<const unsigned char> moves_;  // not 0 if impulses move it; of the operator
  List<unsigned char>
      touched_;               // by rows inside of chunks, then by rows between chunks; whole words
  List<PaddedTwist> shifts_;  // and zero at the end
  List<Scalar> reach_;        // [m]
  List<std::uint32_t> levels_;  // inside chunks, then between chunks
  BodyChunks chunks_;
  std::array<Slice, std::size_t(slice_count)> slices_;
  std::size_t inner_ = 0;       // number of parts inside chunks
  List<Part> parts_;            // inside chunks, then between chunks
  List<std::uint32_t> counts_;  // taken contacts of each slice in each part
  List<Candidate> candidates_;  // as many as contacts, and behind them as many taken contacts
  Candidate* taken_ = nullptr;
  // As many as contacts; sorted by batch, then by part.
  List<Ordered> order_;
  List<Row> rows_;
};

}  // namespace moreau::detail
