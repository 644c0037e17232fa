// SPDX-License-Identifier: MIT
// Statistics of the overlaps (interpenetrations) of contacts.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "moreau/contact/contact.hpp"

namespace moreau {

/// Statistics of overlaps. The overlap of a contact point is -gap [m], counted if it is > 0. All
/// fields are zero if there is no overlap.
template <class T>
struct OverlapStatistics {
  std::size_t points = 0;  ///< contact points with gap < 0
  std::size_t pairs = 0;   ///< number of pairs of bodies with at least one such point
  T mean = 0;              ///< mean overlap of these points [m]
  T mean_of_pairs = 0;     ///< mean over these pairs of the largest overlap of each pair [m]
  T max = 0;               ///< largest overlap of all points [m]

  /// Adds the statistics of another set of points, for example of another step.
  void merge(const OverlapStatistics& other) {
    const auto join = [](T a, std::size_t n, T b, std::size_t m) {
      return n + m == 0 ? T(0) : T((double(a) * double(n) + double(b) * double(m)) / double(n + m));
    };
    mean = join(mean, points, other.mean, other.points);
    mean_of_pairs = join(mean_of_pairs, pairs, other.mean_of_pairs, other.pairs);
    points += other.points;
    pairs += other.pairs;
    max = std::max(max, other.max);
  }
};

/// Statistics of the overlaps of contact points.
/// @param points contact points, sorted by (a, b) as in Contacts
template <class S>
OverlapStatistics<typename S::Scalar> overlap_statistics(std::span<const Contact<S>> points) {
  using Scalar = typename S::Scalar;
  OverlapStatistics<Scalar> sum;
  double mean = 0, mean_of_pairs = 0;
  Scalar deepest = 0;
  for (std::size_t c = 0; c < points.size(); ++c) {
    const Contact<S>& contact = points[c];
    if (contact.gap < 0) {
      ++sum.points;
      mean -= double(contact.gap);
      deepest = std::max(deepest, -contact.gap);
    }
    const bool last_of_pair =
        c + 1 == points.size() || points[c + 1].a != contact.a || points[c + 1].b != contact.b;
    if (!last_of_pair || !(deepest > 0)) continue;
    ++sum.pairs;
    mean_of_pairs += double(deepest);
    sum.max = std::max(sum.max, deepest);
    deepest = 0;
  }
  if (sum.points > 0) sum.mean = Scalar(mean / double(sum.points));
  if (sum.pairs > 0) sum.mean_of_pairs = Scalar(mean_of_pairs / double(sum.pairs));
  return sum;
}

}  // namespace moreau
