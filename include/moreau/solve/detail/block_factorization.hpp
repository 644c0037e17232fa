// SPDX-License-Identifier: MIT
// A sparse symmetric positive definite matrix of square blocks, and its factorization L D L^T. Blocks are
// eliminated in the order of minimum degree: the next block is that with the fewest neighbours that are left
// (A. George and J. W. H. Liu, SIAM Rev. 31 (1989) 1). A chain of bodies then has no fill. The pattern and the
// order are found once for each pattern.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/small_matrix.hpp"

namespace moreau::detail {

/// The matrix and its factors; the head of this file has the method. Keeps its memory.
/// @tparam N rows of a block
template <int N>
class BlockFactorization {
 public:
  using Block = Eigen::Matrix<double, N, N>;
  using Segment = Eigen::Matrix<double, N, 1>;

  /// Finds the order of elimination and the blocks of the factors, unless they are those of the last
  /// call.
  /// @param count rows of blocks
  /// @param edges the pairs i != j with a block (i, j) and a block (j, i)
  MOREAU_COLD void analyse(std::size_t count, std::span<const std::array<std::uint32_t, 2>> edges) {
    if (count == count_ && std::equal(edges.begin(), edges.end(), edges_.begin(), edges_.end()))
      return;
    count_ = count;
    edges_.assign(edges.begin(), edges.end());
    slots_.assign(count * count, none);
    degree_.assign(count, 0);
    slot_count_ = 0;
    for (std::size_t i = 0; i < count; ++i) slots_[i * count + i] = slot_count_++;
    for (const auto& [i, j] : edges) connect(i, j);
    order_.clear();
    later_.clear();
    first_later_.assign(1, 0);
    work_ = 0;
    gone_.assign(count, 0);
    place_.resize(count);
    for (std::size_t k = 0; k < count; ++k) eliminate(next());
  }
  /// Products of two blocks that a factorization takes.
  double work() const { return work_; }

  /// Makes all blocks zero.
  void clear() { blocks_.assign(slot_count_, Block::Zero()); }
  /// Adds to the diagonal block of row i: its lower triangle is used.
  Block& diagonal(std::size_t i) { return blocks_[i]; }
  /// Adds a block (i, j) of an edge, and its transpose (j, i).
  void add(std::size_t i, std::size_t j, const Block& block) {
    if (place_[i] > place_[j])
      add_entries(blocks_[slots_[i * count_ + j]], block, 1, N);
    else
      add_entries(blocks_[slots_[i * count_ + j]], block, N, 1);
  }

  /// Replaces the matrix by its factors.
  /// @returns false if the matrix is not positive definite
  bool factorize() {
    for (std::size_t k = 0; k < count_; ++k) {
      const std::uint32_t p = order_[k];
      if (!invert_definite(blocks_[p])) return false;
      const auto after = later(k);
      for (std::size_t a = 0; a < after.size(); ++a) {
        const Block& of_a = block(after[a], p);
        scaled_.setZero();
        add_product(scaled_, of_a, blocks_[p]);
        subtract_product(blocks_[after[a]], scaled_, of_a);
        for (std::size_t b = a + 1; b < after.size(); ++b)
          subtract(after[a], after[b], block(after[b], p));
      }
    }
    return true;
  }
  /// Replaces the right side by the solution.
  void solve(std::span<Segment> x) const {
    for (std::size_t k = 0; k < count_; ++k) {
      const std::uint32_t p = order_[k];
      Segment part = Segment::Zero();
      add_product(part, blocks_[p], x[p]);
      for (const std::uint32_t i : later(k)) add_product(x[i], block(i, p), part, -1);
    }
    for (std::size_t k = count_; k-- > 0;) {
      const std::uint32_t p = order_[k];
      Segment rest = x[p];
      for (const std::uint32_t j : later(k)) add_transposed_product(rest, block(j, p), x[j], -1);
      x[p].setZero();
      add_product(x[p], blocks_[p], rest);
    }
  }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// The block of two rows: that of the row that is eliminated later and the column of the other.
  const Block& block(std::size_t i, std::size_t j) const { return blocks_[slots_[i * count_ + j]]; }
  /// Subtracts a b^T.
  MOREAU_COMPILED_ONCE static void subtract_product(Block& from, const Block& a, const Block& b) {
    add_product_transposed(from, a, b, -1);
  }
  /// Subtracts the product scaled_ * other^T from the block of the rows i and j.
  void subtract(std::size_t i, std::size_t j, const Block& other) {
    Block& target = blocks_[slots_[i * count_ + j]];
    if (place_[i] > place_[j])
      subtract_product(target, scaled_, other);
    else
      subtract_product(target, other, scaled_);
  }
  /// Adds a block, whose entries lie `down` and `along` apart in memory in a column and in a row.
  static void add_entries(Block& to, const Block& block, int down, int along) {
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < N; ++i) to.data()[j * N + i] += block.data()[j * along + i * down];
  }
  MOREAU_INLINED void connect(std::size_t i, std::size_t j) {
    if (slots_[i * count_ + j] != none) return;
    slots_[i * count_ + j] = slots_[j * count_ + i] = slot_count_++;
    ++degree_[i];
    ++degree_[j];
  }
  /// The row to be eliminated next.
  std::uint32_t next() const {
    std::uint32_t best = none;
    for (std::uint32_t i = 0; i < count_; ++i)
      if (!gone_[i] && (best == none || degree_[i] < degree_[best])) best = i;
    return best;
  }
  MOREAU_INLINED void eliminate(std::uint32_t p) {
    order_.push_back(p);
    place_[p] = static_cast<std::uint32_t>(order_.size() - 1);
    gone_[p] = 1;
    const std::size_t begin = later_.size();
    for (std::uint32_t i = 0; i < count_; ++i)
      if (!gone_[i] && slots_[p * count_ + i] != none) later_.push_back(i);
    first_later_.push_back(later_.size());
    for (std::size_t a = begin; a < later_.size(); ++a) {
      --degree_[later_[a]];
      for (std::size_t b = begin; b < a; ++b) connect(later_[a], later_[b]);
    }
    const double neighbours = double(later_.size() - begin);
    work_ += 1 + neighbours * (neighbours + 3) / 2;
  }
  /// The rows that are eliminated after step k and have a block with that of step k.
  std::span<const std::uint32_t> later(std::size_t k) const {
    return std::span(later_).subspan(first_later_[k], first_later_[k + 1] - first_later_[k]);
  }

  std::size_t count_ = 0;
  std::uint32_t slot_count_ = 0;
  double work_ = 0;
  List<std::array<std::uint32_t, 2>> edges_;
  List<std::uint32_t> slots_;   // of the block (i, j) or (j, i) in blocks_, or none
  List<std::uint32_t> place_;   // of each row in order_
  List<std::uint32_t> degree_;  // neighbours that are left
  List<std::uint32_t> order_, later_;
  List<std::size_t> first_later_;  // of each step, in later_
  List<unsigned char> gone_;
  Block scaled_;
  List<Block> blocks_;
};

}  // namespace moreau::detail
