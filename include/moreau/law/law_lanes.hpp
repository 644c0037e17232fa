// SPDX-License-Identifier: MIT
// The local solutions of several contacts at once, for any set-valued law.
#pragma once

#include <array>
#include <cstddef>
#include <tuple>
#include <utility>

#include "moreau/law/concepts.hpp"
#include "moreau/law/lane_block.hpp"

namespace moreau::detail {

/// For a law that is no LaneLaw: its solve() lane after lane.
template <class Law, class S>
class LawLanes {
 public:
  using Block = LaneBlockOf<Law, S>;
  using Vector = typename Block::Vector;

  void set(std::size_t lane, const Law& law) { law_[lane] = &law; }
  Vector solve(const Block& block, const Vector& b, const Vector& guess, bool) const {
    Vector r{};
    for (std::size_t lane = 0; lane < law_.size(); ++lane) {
      if (!law_[lane]) continue;
      typename BlockOf<Law, S>::Vector b_lane, guess_lane;
      for (std::size_t d = 0; d < Block::rows; ++d) {
        b_lane[Eigen::Index(d)] = b[d][lane];
        guess_lane[Eigen::Index(d)] = guess[d][lane];
      }
      const typename BlockOf<Law, S>::Vector solution =
          law_[lane]->solve(block[lane], b_lane, guess_lane);
      for (std::size_t d = 0; d < Block::rows; ++d) r[d][lane] = solution[Eigen::Index(d)];
    }
    return r;
  }

 private:
  std::array<const Law*, std::size_t{Block::Number::lanes}>
      law_{};  // in the table of laws, which outlives the solve
};

template <class Law, class S>
requires LaneLaw<Law, S>
class LawLanes<Law, S> {
 public:
  using Block = LaneBlockOf<Law, S>;
  using Vector = typename Block::Vector;

  void set(std::size_t lane, const Law& law) {
    const auto parameters = law.lane_parameters();
    for (std::size_t k = 0; k < parameters.size(); ++k) parameters_[k][lane] = parameters[k];
    Block::forget(memory_, lane);
  }
  Vector solve(const Block& block, const Vector& b, const Vector& guess, bool polish) {
    return Law::solve_lanes(block, b, guess, parameters_, memory_, polish);
  }
  Vector natural_map(const Vector& u, const Vector& r) const requires MapsLanes<Law, S> {
    return Law::template natural_map_lanes<S>(u, r, parameters_);
  }

 private:
  using Parameters = decltype(std::declval<const Law&>().lane_parameters());
  std::array<typename Block::Values, std::tuple_size_v<Parameters>> parameters_{};
  typename Block::Memory memory_{};
};

}  // namespace moreau::detail
