// SPDX-License-Identifier: MIT
#include "moreau/core/sort_by_key.hpp"

#include <algorithm>
#include <cstdint>
#include <doctest/doctest.h>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "moreau/core/list.hpp"
#include "moreau/core/sort_items.hpp"
#include "moreau/core/space.hpp"
#include "moreau/core/z_curve.hpp"

namespace {

struct Entry {
  std::uint64_t key;
  std::uint32_t number;
  bool operator==(const Entry&) const = default;
};

}  // namespace

TEST_CASE("sort_by_key sorts, and keeps the order of equal keys") {
  std::mt19937_64 random(1);
  for (int round = 0; round < 100; ++round) {
    moreau::List<Entry> entries, scratch;
    const auto count = static_cast<std::uint32_t>(random() % 300);
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint64_t wide = random() % 5 << 50 | random() % 3 << 20 | random() % 300;
      entries.push_back({round % 3 == 0 ? random() : round % 3 == 1 ? wide : random() % 7, k});
    }
    auto expected = entries;
    std::sort(expected.begin(), expected.end(), [](const Entry& l, const Entry& r) {
      return l.key != r.key ? l.key < r.key : l.number < r.number;
    });
    moreau::detail::sort_by_key(entries, scratch);
    CHECK(entries == expected);
  }
}

TEST_CASE_TEMPLATE("neighbours in space follow one another", S, moreau::Space<2>,
                   moreau::Space<3>) {
  using Vector = typename S::Vector;
  constexpr int count = S::dim == 2 ? 4096 : 4096 * 2;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-1, 1);
  std::vector<moreau::Aabb<S>> boxes;
  for (int k = 0; k < count; ++k) {
    Vector center;
    for (int axis = 0; axis < S::dim; ++axis) center[axis] = place(random);
    boxes.push_back({center, center});
  }
  moreau::detail::SpatialOrder<S> order;
  order.assign(boxes);
  REQUIRE(order.size() == boxes.size());
  std::vector<int> seen(boxes.size(), 0);
  double sum = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    ++seen[order[k]];
    if (k > 0) sum += (boxes[order[k]].lower - boxes[order[k - 1]].lower).norm();
  }
  CHECK(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
  // Two boxes of a random order are 1.0 apart in the plane and 1.3 in space. Boxes lie 0.03 and 0.1
  // apart here.
  CHECK(sum / count < (S::dim == 2 ? 0.06 : 0.2));
  order.assign(std::vector<moreau::Aabb<S>>(3, boxes[0]));  // all at one place
  CHECK(order.size() == 3);
}

TEST_CASE("a list holds its elements as a std::vector does") {
  std::mt19937_64 random(2);
  moreau::List<Entry> list;
  std::vector<Entry> vector;
  for (int round = 0; round < 3000; ++round) {
    const std::size_t size = vector.size(), at = size == 0 ? 0 : random() % size;
    const Entry entry{random() % 5, static_cast<std::uint32_t>(round)};
    switch (random() % 9) {
      case 0:
        list.resize(size + 3), vector.resize(size + 3);
        break;
      case 1:
        list.resize(at), vector.resize(at);
        break;
      case 2:
        list.resize(size + 5, entry), vector.resize(size + 5, entry);
        break;
      case 3:
        list.insert(list.begin() + at, entry),
            vector.insert(vector.begin() + std::ptrdiff_t(at), entry);
        break;
      case 4:
        list.erase(list.begin() + at, list.end());
        vector.erase(vector.begin() + std::ptrdiff_t(at), vector.end());
        break;
      case 5: {
        const auto is_gone = [&](const Entry& item) { return item.key == entry.key; };
        CHECK(erase_if(list, is_gone) == std::erase_if(vector, is_gone));
        break;
      }
      case 6: {
        moreau::List<Entry> copy = list, other;
        other = copy;
        list = std::move(other);
        break;
      }
      default:
        list.push_back(size > 0 ? list[at] : entry);  // an element of the list itself
        vector.push_back(size > 0 ? Entry(vector[at]) : entry);
    }
    const std::vector<Entry> same = list;
    REQUIRE(same == vector);
  }
  // Matrices that registers load are aligned, whatever the size of the list.
  using Matrix = Eigen::Matrix<double, 4, 4>;
  moreau::List<Matrix> matrices;
  for (int k = 0; k < 40; ++k) matrices.push_back(k * Matrix::Identity());
  CHECK(matrices == moreau::List<Matrix>(matrices));
  CHECK(matrices[39](3, 3) == 39);
  CHECK(reinterpret_cast<std::uintptr_t>(matrices.data()) % alignof(Matrix) == 0);
}

TEST_CASE("a list refuses an index beyond its end, and is read backwards") {
  moreau::List<int> list{1, 2, 3};
  list.at(1) = 5;
  CHECK(list.at(1) == 5);
  CHECK_THROWS_AS(list.at(3), std::out_of_range);
  CHECK(std::vector<int>(list.rbegin(), list.rend()) == std::vector<int>{3, 5, 1});
  CHECK(list == std::vector<int>{1, 5, 3});
  CHECK_FALSE(std::vector<int>{1, 5} == list);
}

TEST_CASE("short and long lists are sorted") {
  std::mt19937_64 random(3);
  for (const std::size_t size : {0, 1, 2, 16, 17, 1000}) {
    std::vector<std::uint64_t> items(size);
    for (std::uint64_t& item : items) item = random() % (2 * size);
    auto sorted = items;
    std::sort(sorted.begin(), sorted.end());
    moreau::sort_items(items);
    CHECK(items == sorted);
  }
}
