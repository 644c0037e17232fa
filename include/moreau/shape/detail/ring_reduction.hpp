// SPDX-License-Identifier: MIT
// Removes corners of a polygon one by one, each time the one for which a measure of the corner and its
// two neighbours is least.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <tuple>
#include <vector>

namespace moreau::detail {

/// Removes corners until only `least_count` are left or the least measure exceeds a limit. Of corners
/// with the same measure the first goes first. n corners take a time proportional to n log n.
/// @param ring    the corners, in cyclic order
/// @param measure function: corner before, corner, corner behind -> what its removal changes
template <class Corner, class Measure>
void reduce_ring(std::vector<Corner>& ring, std::size_t least_count, double limit,
                 const Measure& measure) {
  const std::size_t n = ring.size();
  std::vector<std::size_t> before(n), behind(n);
  std::vector<std::uint32_t> version(n, 0);
  std::vector<unsigned char> is_gone(n, 0);
  using Entry = std::tuple<double, std::size_t, std::uint32_t>;  // measure, place, version
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto push = [&](std::size_t i) {
    queue.emplace(measure(ring[before[i]], ring[i], ring[behind[i]]), i, ++version[i]);
  };
  for (std::size_t i = 0; i < n; ++i) {
    before[i] = (i + n - 1) % n;
    behind[i] = (i + 1) % n;
  }
  for (std::size_t i = 0; i < n; ++i) push(i);
  for (std::size_t left = n; left > least_count && !queue.empty();) {
    const auto [least, i, of_version] = queue.top();
    queue.pop();
    if (of_version != version[i]) continue;
    if (!(least <= limit)) break;
    is_gone[i] = 1;
    ++version[i];
    if (--left <= least_count) break;
    behind[before[i]] = behind[i];
    before[behind[i]] = before[i];
    push(before[i]);
    push(behind[i]);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (is_gone[i] == 0) ring[kept++] = ring[i];
  ring.resize(kept);
}

}  // namespace moreau::detail
