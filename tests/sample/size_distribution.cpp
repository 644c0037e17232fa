// SPDX-License-Identifier: MIT
#include "moreau/sample/size_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <numeric>

#include "shape/message_of.hpp"

namespace {

using moreau::SizeDistribution;
using moreau::SizeReading;
using Counts = std::vector<std::size_t>;

TEST_CASE("the paper's distribution") {
  const auto paper = SizeDistribution::azema2008();
  CHECK(paper.counts(1200) == Counts{600, 408, 192});
  CHECK(paper.counts(100) == Counts{50, 34, 16});
  CHECK(paper.counts(300) == Counts{150, 102, 48});
  CHECK(paper.counts(1) == Counts{1, 0, 0});
  CHECK(paper.counts(0) == Counts{0, 0, 0});
  CHECK(paper.counts(10) == Counts{5, 3, 2});
  CHECK(paper.smallest() == 0.025);
  CHECK(paper.largest() == 0.05);
}

TEST_CASE(
    "whole shares come out whole, all counts sum up and differ from the share by less than one") {
  const auto paper = SizeDistribution::azema2008();
  for (std::size_t n = 0; n < 3000; ++n) {
    const Counts count = paper.counts(n);
    REQUIRE(std::accumulate(count.begin(), count.end(), std::size_t{0}) == n);
    if (n % 50 == 0) REQUIRE(count == Counts{n / 2, n / 50 * 17, n / 50 * 8});
    for (std::size_t i = 0; i < 3; ++i) {
      const double share = paper.classes()[i].share * static_cast<double>(n);
      REQUIRE(std::abs(static_cast<double>(count[i]) - share) < 1);
    }
  }
  const SizeDistribution thirds({{1, 1}, {2, 1}, {3, 1}});
  CHECK(thirds.counts(5) == Counts{2, 2, 1});
  const SizeDistribution sevenths({{1, 1}, {2, 2}, {3, 4}, {4, 0}});
  CHECK(sevenths.counts(7) == Counts{1, 2, 4, 0});
}

TEST_CASE("a sample has exactly the counts, in an order that the seed decides") {
  const auto paper = SizeDistribution::azema2008();
  std::mt19937_64 random(7), same(7), other(8);
  const auto sizes = paper.sample(1200, random);
  CHECK(std::count(sizes.begin(), sizes.end(), 0.025) == 600);
  CHECK(std::count(sizes.begin(), sizes.end(), 0.0375) == 408);
  CHECK(std::count(sizes.begin(), sizes.end(), 0.05) == 192);
  CHECK(sizes == paper.sample(1200, same));
  CHECK(sizes != paper.sample(1200, other));
  CHECK_FALSE(std::is_sorted(sizes.begin(), sizes.end()));
}

TEST_CASE("both readings of a size") {
  CHECK(moreau::circumradius_of(0.05, SizeReading::circumdiameter) == 0.025);
  CHECK(moreau::circumradius_of(0.05, SizeReading::circumradius) == 0.05);
}

TEST_CASE("bad arguments are named") {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  const auto message = [](std::vector<SizeDistribution::Class> classes) {
    return message_of([&] { SizeDistribution{classes}; });
  };
  CHECK(message({}) == "SizeDistribution: classes.size() = 0 must be at least 1");
  CHECK(message({{1, 1}, {0, 1}}) ==
        "SizeDistribution: classes[1].size = 0 must be finite and > 0");
  CHECK(message({{nan, 1}}) == "SizeDistribution: classes[0].size = nan must be finite and > 0");
  CHECK(message({{1, -0.1}}) ==
        "SizeDistribution: classes[0].share = -0.1 must be finite and not negative");
  CHECK(message({{1, inf}}) ==
        "SizeDistribution: classes[0].share = inf must be finite and not negative");
  CHECK(message({{1, 0}, {2, 0}}) == "SizeDistribution: sum of shares = 0 must be finite and > 0");
  std::mt19937_64 random;
  CHECK(message_of([&] { SizeDistribution::azema2008().sample(0, random); }) ==
        "SizeDistribution::sample: n = 0 must be at least 1");
  CHECK(message_of([&] { moreau::circumradius_of(-1, SizeReading::circumradius); }) ==
        "circumradius_of: size = -1 must be finite and > 0");
}

}  // namespace
