// SPDX-License-Identifier: MIT
// Coordination number: the mean number of neighbours with which a grain has a contact that carries
// force.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/core/error.hpp"
#include "moreau/measure/detail/of_simulation.hpp"

namespace moreau {

/// Coordination number: the mean number of neighbours with which a grain has a contact that carries
/// force.
struct Coordination {
  std::size_t grains =
      0;  ///< number of grains counted, without obstacles and the rattlers that were removed
  std::size_t rattlers = 0;  ///< number of rattlers that were removed
  std::size_t points = 0;  ///< number of contact points of the counted bodies with normal impulse >
                           ///< 0
  std::size_t pairs = 0;   ///< number of pairs of counted bodies with at least one such point
  /// Mean number of neighbours of a grain [-]: bodies that have a contact point with normal impulse
  /// > 0 with the grain. A pair of two grains adds two to the sum over all grains, a pair of a
  /// grain and a wall adds one. A pair counts once, whatever its number of points. 0 if there are
  /// no grains.
  double neighbours = 0;
  double points_per_grain = 0;  ///< mean number of contact points of a grain with normal impulse >
                                ///< 0 [-]
};

/// Counts neighbours. The object keeps its buffers from call to call.
template <class S>
class CoordinationCounter {
 public:
  /// Counts the contacts with normal impulse > 0.
  /// @param points     contact points, sorted by (a, b) as in Contacts
  /// @param impulses   impulse of each point in its contact frame, normal component first [N s]: Contacts::impulses
  /// @param body_count number of bodies, including walls
  /// @param is_grain   function: index of a body -> true for a grain, false for a wall or an obstacle: it is a
  ///                   neighbour, and is neither counted nor removed
  /// @param fewest     grains with fewer neighbours than this are rattlers. They are removed with
  ///                   their contacts. This is repeated until no rattlers are left. With 0 all
  ///                   grains are counted. Use S::dim + 1 for frictionless rigid spheres. With
  ///                   friction two contacts can hold a grain.
  /// @throws std::invalid_argument if the numbers of points and impulses differ
  Coordination count(std::span<const Contact<S>> points, const auto& impulses,
                     std::size_t body_count, const auto& is_grain, std::size_t fewest = 0) {
    require(points.size() == impulses.size(), "CoordinationCounter::count", "impulses.size()",
            impulses.size(), "must be the number of points");
    find_pairs(points, impulses, body_count);
    Coordination result;
    result.rattlers = take_rattlers(is_grain, fewest);
    std::size_t ends = 0, point_ends = 0;
    for (const Pair& pair : pairs_) {
      if (taken_[pair.a] != 0 || taken_[pair.b] != 0) continue;
      const std::size_t grains = (is_grain(pair.a) ? 1u : 0u) + (is_grain(pair.b) ? 1u : 0u);
      ++result.pairs;
      result.points += pair.points;
      ends += grains;
      point_ends += grains * pair.points;
    }
    for (std::uint32_t body = 0; body < body_count; ++body)
      if (is_grain(body) && taken_[body] == 0) ++result.grains;
    if (result.grains == 0) return result;
    result.neighbours = double(ends) / double(result.grains);
    result.points_per_grain = double(point_ends) / double(result.grains);
    return result;
  }

 private:
  struct Pair {
    std::uint32_t a, b;
    std::size_t points;
  };

  void find_pairs(std::span<const Contact<S>> points, const auto& impulses,
                  std::size_t body_count) {
    pairs_.clear();
    neighbours_.assign(body_count, 0);
    for (std::size_t c = 0; c < points.size(); ++c) {
      const auto [a, b] = std::pair(points[c].a, points[c].b);
      if (!(impulses[c][0] > 0)) continue;
      if (pairs_.empty() || pairs_.back().a != a || pairs_.back().b != b) {
        MOREAU_ASSERT(a < body_count && b < body_count);
        pairs_.push_back({a, b, 0});
        ++neighbours_[a];
        ++neighbours_[b];
      }
      ++pairs_.back().points;
    }
  }

  /// Removes the rattlers one by one. A removal takes a neighbour from each partner, which may make it a rattler; the
  /// order does not matter. The work is proportional to the numbers of bodies and pairs.
  std::size_t take_rattlers(const auto& is_grain, std::size_t fewest) {
    taken_.assign(neighbours_.size(), 0);
    if (fewest == 0) return 0;
    // The partners of body i are partners_[first_[i]] to partners_[first_[i + 1] - 1].
    first_.assign(neighbours_.size() + 1, 0);
    for (std::size_t i = 0; i < neighbours_.size(); ++i) first_[i + 1] = first_[i] + neighbours_[i];
    partners_.resize(first_.back());
    next_.assign(first_.begin(), first_.end() - 1);
    for (const Pair& pair : pairs_) {
      partners_[next_[pair.a]++] = pair.b;
      partners_[next_[pair.b]++] = pair.a;
    }
    rattlers_.clear();
    const auto take = [&](std::uint32_t body) {
      if (taken_[body] != 0 || neighbours_[body] >= fewest || !is_grain(body)) return;
      taken_[body] = 1;
      rattlers_.push_back(body);
    };
    for (std::uint32_t body = 0; body < neighbours_.size(); ++body) take(body);
    for (std::size_t k = 0; k < rattlers_.size(); ++k) {
      const std::uint32_t body = rattlers_[k];
      for (std::size_t n = first_[body]; n < first_[body + 1]; ++n) {
        const std::uint32_t partner = partners_[n];
        --neighbours_[partner];
        take(partner);
      }
    }
    return rattlers_.size();
  }

  std::vector<Pair> pairs_;
  std::vector<std::size_t> neighbours_;
  std::vector<std::size_t> first_, next_;
  std::vector<std::uint32_t> partners_;
  std::vector<std::uint32_t> rattlers_;  // in the order in which they are removed
  std::vector<char> taken_;
};

/// The coordination number of a simulation after its last step:
///
///     const double z = coordination(simulation).neighbours;
///
/// A contact is a pair of bodies with at least one contact point whose normal impulse is > 0 in the
/// last step. A pair counts once, whatever its number of points; a grain that touches a wall has the
/// wall as a neighbour. A grain of prescribed motion is an obstacle and counts as a wall does: it is a neighbour, it
/// has no mean of its own, and it is never a rattler. Points without impulse and points that attract do not count.
/// @param simulation a Simulation
/// @param fewest     grains with fewer neighbours than this are removed as rattlers; with 0 all
///                   grains are counted (CoordinationCounter::count())
template <class Simulation>
Coordination coordination(const Simulation& simulation, std::size_t fewest = 0) {
  const auto& contacts = simulation.contacts();
  return CoordinationCounter<typename Simulation::S>().count(
      contacts.points, contacts.impulses, simulation.bodies().size(),
      detail::free_grain_in(simulation), fewest);
}

}  // namespace moreau
