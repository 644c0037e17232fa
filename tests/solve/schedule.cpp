// SPDX-License-Identifier: MIT
#include "moreau/solve/coloured/schedule.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <doctest/doctest.h>
#include <memory>
#include <random>
#include <tuple>
#include <vector>

using namespace moreau;
using namespace moreau::detail;

namespace {

struct Group {
  static constexpr std::uint32_t serial = ~std::uint32_t{0}, shared = serial;
  std::uint32_t phase;
  std::uint32_t chunk;
};

/// Members that work one after another.
struct Turns final : TeamThreads {
  explicit Turns(int size) : size_(size) { shares = true; }
  int size() const override { return size_; }
  void run(const Work& work) override {
    for (int rank = 0; rank < size_; ++rank) work(rank, size_, TeamBarrier());
  }
  bool begin(TimedWork) override { return true; }
  void end(TimedWork, std::size_t) override {}
  int size_;
};

}  // namespace

TEST_CASE("every group with points is visited once, whatever the size of the team") {
  std::mt19937_64 random(1);
  for (int round = 0; round < 100; ++round) {
    moreau::List<Group> groups;
    std::vector<std::uint32_t> points;
    for (std::uint64_t k = random() % 80; k > 0; --k) {
      constexpr std::uint32_t phases[] = {0, 1, 2, FirstFitColouring::colours, Group::serial};
      const std::uint64_t phase = random() % 5;
      const bool inside = phase < 3 && random() % 2 == 0;
      groups.push_back(
          {phases[phase], inside ? static_cast<std::uint32_t>(random() % 3) : Group::shared});
      points.push_back(static_cast<std::uint32_t>(random() % 4));
    }
    std::sort(groups.begin(), groups.end(), [](const Group& l, const Group& r) {
      return std::tie(l.chunk, l.phase) < std::tie(r.chunk, r.phase);
    });
    Schedule schedule;
    schedule.assign(groups, [&](std::uint32_t k) { return points[k]; });
    for (const int size : {1, 2, 3, 8})
      for (const bool back : {false, true}) {
        std::vector<int> visits(groups.size(), 0), settled(groups.size(), 0);
        const auto wait = [] {};
        const auto visit = [&](std::uint32_t k) { ++visits[k]; };
        const auto settle = [&](std::uint32_t k) { ++settled[k]; };
        std::vector<int> member(3, -1);  // of each chunk
        int rank = 0;
        const auto visit_in_chunks = [&](std::uint32_t k) {
          visit(k);
          if (groups[k].chunk == Group::shared) return;
          int& owner = member[groups[k].chunk];
          CHECK((owner == -1 || owner == rank));
          owner = rank;
        };
        for (; rank < size; ++rank)
          if (back)
            schedule.backward(rank, size, wait, visit_in_chunks, settle);
          else
            schedule.forward(rank, size, wait, visit_in_chunks, settle);
        for (std::size_t k = 0; k < groups.size(); ++k) {
          CHECK(visits[k] == (points[k] > 0));
          CHECK(settled[k] == (points[k] > 0 && groups[k].phase == FirstFitColouring::colours));
        }
      }
  }
}
