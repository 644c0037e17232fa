// SPDX-License-Identifier: MIT
// The sums of measure_residual() over contacts that are packed for SIMD arithmetic, one contact per lane.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <type_traits>

#include "moreau/simd/wide.hpp"
#include "moreau/solve/measure_residual.hpp"

namespace moreau::detail {

/// Numbers of the lanes of a register, in double precision: registers of the same width.
template <class Number>
struct DoubleLanes {
  using Values = typename Number::Values;
  using T = std::remove_cvref_t<decltype(Values{}[0])>;
  static constexpr std::size_t count = sizeof(double) / sizeof(T);
  using Doubles = Wide<double, int(sizeof(Values))>;
  using Registers = std::array<typename Doubles::Values, count>;

  static Registers of(const Values& v) {
    if constexpr (count == 1) {
      return {v};
    } else {
      typedef T Part __attribute__((vector_size(sizeof(Values) / count)));
      Part parts[count];
      std::memcpy(parts, &v, sizeof v);
      Registers registers;
      for (std::size_t k = 0; k < count; ++k)
        registers[k] = __builtin_convertvector(parts[k], typename Doubles::Values);
      return registers;
    }
  }
  static double sum(const Registers& v) {
    double sum = 0;
    for (const auto& one : v) sum += Doubles::sum(one);
    return sum;
  }
  static double largest(const Registers& v) {
    double most = 0;
    for (const auto& one : v) most = std::max(most, Doubles::maximum(one)[0]);
    return most;
  }
};

/// ResidualSums, one contact per lane.
template <class Points>
class LaneResidual {
 public:
  using Block = typename Points::Block;
  using Number = typename Block::Number;
  using Values = typename Number::Values;
  using Row = typename Points::Row;
  using InDouble = DoubleLanes<Number>;
  using Registers = typename InDouble::Registers;

  void add(const LaneResidual& other) {
    for (std::size_t k = 0; k < InDouble::count; ++k) {
      map_[k] += other.map_[k];
      norm_[k] += other.norm_[k];
      approach_[k] += other.approach_[k];
      closing_[k] += other.closing_[k];
      dissipation_[k] += other.dissipation_[k];
      raise(velocity_[k], other.velocity_[k]);
      raise(complementarity_[k], other.complementarity_[k]);
      raise(cone2_[k], other.cone2_[k]);
    }
  }
  /// Adds a contact per lane.
  /// @param u     relative velocity, contact frame [m/s]
  /// @param scale makes velocities of impulses [1/kg]
  void add(const Points& point, const Row& u, typename InDouble::T scale) {
    constexpr std::size_t rows = Block::rows;
    const Values zero{},
        far = Number::broadcast(std::numeric_limits<typename InDouble::T>::infinity());
    const Row& r = point.impulse;
    const auto acts = ~((r[0] == zero) & (u[0] >= zero)) & ~(u[0] == far);
    const Values free = point.free[0] < zero ? point.free[0] : zero;
    add_square(approach_, free);
    if (!Number::any(acts)) return;
    Row scaled, still, seen;
    Values norm{}, velocity2{}, power{};
    for (std::size_t d = 0; d < rows; ++d) {
      seen[d] = acts ? u[d] : zero;
      scaled[d] = r[d] * scale;
      still[d] = zero;
      norm += scaled[d] * scaled[d];
      velocity2 += seen[d] * seen[d];
      if (d > 0) power += seen[d] * r[d];
    }
    const Registers map = InDouble::of(squared(point.law.natural_map(seen, scaled))),
                    of_u = InDouble::of(velocity2), of_r = InDouble::of(norm),
                    of_power = InDouble::of(power),
                    cone2 = InDouble::of(squared(point.law.natural_map(still, scaled))),
                    approach = InDouble::of(seen[0] >= zero ? zero : -seen[0]),
                    product = InDouble::of(Number::absolute(seen[0] * r[0]));
    constexpr double rounding = 8 * double(std::numeric_limits<typename InDouble::T>::epsilon());
    for (std::size_t k = 0; k < InDouble::count; ++k) {
      raise_sum(map_[k], map[k] - rounding * rounding * of_u[k]);
      norm_[k] += of_r[k];
      closing_[k] += approach[k] * approach[k];
      raise_sum(dissipation_[k], of_power[k]);
      raise(velocity_[k], approach[k]);
      raise(complementarity_[k], product[k]);
      raise(cone2_[k], cone2[k]);
    }
  }
  /// The sums over all lanes.
  template <class Sums>
  Sums sums(double scale) const {
    Sums sums;
    sums.map = InDouble::sum(map_);
    sums.norm = InDouble::sum(norm_);
    sums.approach = InDouble::sum(approach_);
    sums.closing = InDouble::sum(closing_);
    sums.dissipation = InDouble::sum(dissipation_);
    sums.velocity = InDouble::largest(velocity_);
    sums.cone = std::sqrt(InDouble::largest(cone2_)) / scale;
    sums.complementarity = InDouble::largest(complementarity_);
    return sums;
  }

 private:
  using Register = typename InDouble::Doubles::Values;
  static void raise(Register& most, const Register& x) { most = x > most ? x : most; }
  /// Adds what is positive, or NaN.
  static void raise_sum(Register& sum, const Register& x) {
    sum += x <= Register{} ? Register{} : x;
  }
  static void add_square(Registers& sum, const Values& x) {
    const Registers one = InDouble::of(x);
    for (std::size_t k = 0; k < InDouble::count; ++k) sum[k] += one[k] * one[k];
  }
  static Values squared(const Row& x) {
    Values sum{};
    for (std::size_t d = 0; d < Block::rows; ++d) sum += x[d] * x[d];
    return sum;
  }

  Registers map_{}, norm_{}, approach_{}, closing_{}, dissipation_{}, velocity_{},
      complementarity_{}, cone2_{};
};

}  // namespace moreau::detail
