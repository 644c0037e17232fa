// SPDX-License-Identifier: MIT
// A few numbers at once: the compiler's vector types (g++ and clang++), as wide as the machine the
// code is compiled for.
#pragma once

#include <concepts>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

namespace moreau::detail {

/// Vector registers of T. Loads accept any address.
template <std::floating_point T>
struct Wide {
#if defined(__AVX__)
  static constexpr int lanes = 32 / static_cast<int>(sizeof(T));
#else
  static constexpr int lanes = 16 / static_cast<int>(sizeof(T));
#endif
  using Lane = std::conditional_t<sizeof(T) == 8, std::int64_t, std::int32_t>;
#if defined(__AVX__)
  typedef T Values __attribute__((vector_size(32)));
  typedef Lane Indices __attribute__((vector_size(32)));
#else
  typedef T Values __attribute__((vector_size(16)));
  typedef Lane Indices __attribute__((vector_size(16)));
#endif

  static Values load(const T* from) {
    Values v;
    std::memcpy(&v, from, sizeof v);
    return v;
  }
  static Values broadcast(T x) {
    return x - Values{};
  }
  /// Lane l becomes what lane l + shift was, around the end.
  template <int Shift, class V>
  static V rotated(const V& v) {
    return rotate<Shift>(v, std::make_integer_sequence<int, lanes>{});
  }
  /// 0, 1, 2, ...
  static Indices iota() {
    Indices i{};
    for (int l = 0; l < lanes; ++l) i[l] = l;
    return i;
  }
  /// The bits set in all lanes.
  static Lane common_bits(Indices v) {
    return fold<lanes / 2>(v,
                           [](const Indices& x, const Indices& y) -> Indices { return x & y; })[0];
  }
  /// The largest lane, in every lane.
  static Values maximum(Values v) {
    return fold<lanes / 2>(v, [](const Values& x, const Values& y) { return x > y ? x : y; });
  }
  /// Folds the lanes by an associative, commutative operation; the result is in every lane.
  template <int Shift, class V, class Operation>
  static V fold(V v, const Operation& operation) {
    if constexpr (Shift == 0) {
      return v;
    } else {
      return fold<Shift / 2>(operation(v, rotated<Shift>(v)), operation);
    }
  }
  /// The count n of rows, rounded up to whole registers.
  static constexpr std::ptrdiff_t padded(std::ptrdiff_t n) {
    return (n + lanes - 1) / lanes * lanes;
  }

 private:
  template <int Shift, class V, int... Number>
  static V rotate(const V& v, std::integer_sequence<int, Number...>) {
    return __builtin_shufflevector(v, v, ((Number + Shift) % lanes)...);
  }
};

/// The largest (or smallest) of many numbers and where it is; the first of equals.
template <class T>
struct Extreme {
  T value;
  std::uint32_t index;
};

/// The running maximum in every lane, and its index.
template <std::floating_point T>
struct WideMaximum {
  using W = Wide<T>;
  typename W::Values value;
  typename W::Indices index;

  void take(typename W::Values v, typename W::Indices i) {
    const auto larger = v > value;
    value = larger ? v : value;
    index = larger ? i : index;
  }
  /// Without branches: which lane wins is as good as random.
  Extreme<T> reduce() const {
    const auto top = W::maximum(value);
    const auto none = typename W::Indices{} + std::numeric_limits<typename W::Lane>::max();
    const typename W::Indices candidates = value == top ? index : none;
    const auto first = W::template fold<W::lanes / 2>(
        candidates, [](const auto& x, const auto& y) { return x < y ? x : y; });
    return {top[0], static_cast<std::uint32_t>(first[0])};
  }
};

}  // namespace moreau::detail
