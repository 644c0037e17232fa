// SPDX-License-Identifier: MIT
// SIMD: the vector types of g++ and clang++, with the width of the registers of the target machine.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/compiler.hpp"

namespace moreau::detail {

/// Width in bytes of the registers for which the target has fast comparisons and shuffles.
#if defined(__AVX__)
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif
/// Width in bytes of the widest registers of the target. Wider vector types are not used, because
/// the way in which functions pass them depends on the target for which they were compiled.
#if defined(__AVX512F__)
inline constexpr int widest_bytes = 64;
#else
inline constexpr int widest_bytes = register_bytes;
#endif

/// Operations on vector registers with components of type T. Loads need no alignment.
template <std::floating_point T, int Bytes = register_bytes>
struct Wide {
  static constexpr int lanes = Bytes / static_cast<int>(sizeof(T));
  using Lane = std::conditional_t<sizeof(T) == 8, std::int64_t, std::int32_t>;
  typedef T Values __attribute__((vector_size(Bytes)));
  typedef Lane Indices __attribute__((vector_size(Bytes)));
  using Index = std::size_t;  ///< of the entries of RowsOf

  static Values load(const T* from) {
    Values v;
    std::memcpy(&v, from, sizeof v);
    return v;
  }
  static Values broadcast(T x) { return x - Values{}; }
  static void set(Values& v, std::size_t lane, T x) { v[lane] = x; }   ///< lane < lanes
  static T get(const Values& v, std::size_t lane) { return v[lane]; }  ///< lane < lanes
  /// Rotates the lanes: lane l of the result is lane (l + Shift) mod lanes of v.
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
  /// Bitwise and of all lanes.
  static Lane common_bits(Indices v) {
    return fold<lanes / 2>(v,
                           [](const Indices& x, const Indices& y) -> Indices { return x & y; })[0];
  }
  /// Whether a comparison holds in at least one lane.
  static bool any(const Indices& mask) {
    if constexpr (Bytes == 64) {
      typename Wide<T, 32>::Indices halves[2];
      std::memcpy(halves, &mask, sizeof mask);
      return Wide<T, 32>::any(halves[0] | halves[1]);
#if defined(__AVX__)
    } else if constexpr (Bytes == 32) {
      // A comparison sets all bits of a lane or none. So it suffices to look at the sign bit of
      // every 32 bits: of each float, of both halves of each double.
      typedef float Floats __attribute__((vector_size(32)));
      return __builtin_ia32_movmskps256(reinterpret_cast<Floats>(mask)) != 0;
#endif
    } else if constexpr (Bytes == 16 && sizeof(T) == 8) {
      return bits(mask) != 0;
    } else {
      return fold<lanes / 2>(
                 mask, [](const Indices& x, const Indices& y) -> Indices { return x | y; })[0] != 0;
    }
  }
  /// Bit l: whether a comparison holds in lane l.
  static std::uint32_t bits(const Indices& mask) {
    constexpr bool of_doubles = sizeof(T) == 8;
#if defined(__AVX__)
    if constexpr (Bytes == 32 && of_doubles) {
      typedef double Doubles __attribute__((vector_size(32)));
      return static_cast<std::uint32_t>(
          __builtin_ia32_movmskpd256(reinterpret_cast<Doubles>(mask)));
    } else if constexpr (Bytes == 32) {
      typedef float Floats __attribute__((vector_size(32)));
      return static_cast<std::uint32_t>(__builtin_ia32_movmskps256(reinterpret_cast<Floats>(mask)));
    }
#endif
#if defined(__SSE2__)
    if constexpr (Bytes == 16 && of_doubles) {
      typedef double Doubles __attribute__((vector_size(16)));
      return static_cast<std::uint32_t>(__builtin_ia32_movmskpd(reinterpret_cast<Doubles>(mask)));
    } else if constexpr (Bytes == 16) {
      typedef float Floats __attribute__((vector_size(16)));
      return static_cast<std::uint32_t>(__builtin_ia32_movmskps(reinterpret_cast<Floats>(mask)));
    }
#endif
    std::uint32_t bits = 0;
    for (int l = 0; l < lanes; ++l) bits |= std::uint32_t{mask[l] != 0} << l;
    return bits;
  }
  /// As std::sqrt, correctly rounded. The square root that Eigen has for registers of floats, and for those of AVX-512, is
  /// an approximation: of infinity it makes NaN, of denormal numbers 0, and its last bit depends on the CPU.
  static Values square_root(const Values& v) {
    constexpr bool floats = sizeof(T) == 4;
#if defined(EIGEN_VECTORIZE_AVX512)
    // With a mask of ones: of the functions without one g++ 12 says that they read an uninitialized variable.
    if constexpr (Bytes == 64 && floats)
      return bits_of<Values>(_mm512_maskz_sqrt_ps(__mmask16(-1), bits_of<__m512>(v)));
    else if constexpr (Bytes == 64)
      return bits_of<Values>(_mm512_maskz_sqrt_pd(__mmask8(-1), bits_of<__m512d>(v)));
#endif
#if defined(EIGEN_VECTORIZE_AVX)
    if constexpr (Bytes == 32 && floats) return bits_of<Values>(_mm256_sqrt_ps(bits_of<__m256>(v)));
#endif
#if defined(EIGEN_VECTORIZE_SSE2)
    if constexpr (Bytes == 16 && floats) return bits_of<Values>(_mm_sqrt_ps(bits_of<__m128>(v)));
#endif
    Eigen::Array<T, lanes, 1> a;
    std::memcpy(a.data(), &v, sizeof v);
    return load(Eigen::Array<T, lanes, 1>(a.sqrt()).data());
  }
  static Values absolute(Values v) {
    return v < Values{} ? -v : v;
  }
  static T sum(Values v) {
    return fold<lanes / 2>(v, [](const Values& x, const Values& y) -> Values { return x + y; })[0];
  }
  /// Transposes a square of rows and lanes: lane l of row i becomes lane i of row l.
  MOREAU_INLINED static void transpose(Values (&rows)[std::size_t{lanes}]) {
    transpose<1>(rows);
  }

  /// The largest of all lanes, in every lane.
  static Values maximum(Values v) {
    return fold<lanes / 2>(v, [](const Values& x, const Values& y) { return x > y ? x : y; });
  }
  /// Combines all lanes by an associative and commutative operation. The result is in every lane.
  template <int Shift, class V, class Operation>
  static V fold(V v, const Operation& operation) {
    if constexpr (Shift == 0) {
      return v;
    } else {
      return fold<Shift / 2>(operation(v, rotated<Shift>(v)), operation);
    }
  }
  /// The number n of rows rounded up to a multiple of the number of lanes.
  static constexpr std::ptrdiff_t padded(std::ptrdiff_t n) {
    return (n + lanes - 1) / lanes * lanes;
  }

 private:
  /// Another type for the same register.
  template <class To, class From>
  static To bits_of(const From& from) {
    To to;
    std::memcpy(&to, &from, sizeof to);
    return to;
  }
  /// In every square of 2 Size rows and lanes, swaps the two off-diagonal blocks.
  template <int Size>
  MOREAU_INLINED static void transpose(Values (&rows)[std::size_t{lanes}]) {
    if constexpr (Size < lanes) {
      for (int i = 0; i < lanes; ++i) {
        if (i & Size) continue;
        const Values upper = rows[i], lower = rows[i | Size];
        rows[i] = mix<Size, false>(upper, lower, std::make_integer_sequence<int, lanes>{});
        rows[i | Size] = mix<Size, true>(upper, lower, std::make_integer_sequence<int, lanes>{});
      }
      transpose<2 * Size>(rows);
    }
  }
  template <int Size, bool Lower, int... Number>
  static Values mix(const Values& upper, const Values& lower,
                    std::integer_sequence<int, Number...>) {
    if constexpr (Lower)
      return __builtin_shufflevector(upper, lower,
                                     ((Number & Size) ? Number + lanes : (Number | Size))...);
    else
      return __builtin_shufflevector(upper, lower,
                                     ((Number & Size) ? (Number ^ Size) + lanes : Number)...);
  }
  template <int Shift, class V, int... Number>
  static V rotate(const V& v, std::integer_sequence<int, Number...>) {
    return __builtin_shufflevector(v, v, ((Number + Shift) % lanes)...);
  }
};

/// The part of Wide that local solutions use, for one number in place of a register.
template <std::floating_point T>
struct OneNumber {
  static constexpr int lanes = 1;
  using Values = T;
  using Indices = int;         ///< 0 or 1: what a comparison gives
  using Index = Eigen::Index;  ///< of the entries of RowsOf

  static Values broadcast(T x) { return x; }
  static bool any(Indices mask) { return mask != 0; }
  static Values square_root(Values v) { return std::sqrt(v); }
  static Values absolute(Values v) { return std::abs(v); }
  static void set(Values& v, std::size_t, T x) { v = x; }
  static T get(const Values& v, std::size_t) { return v; }
};

/// A vector with N entries: of Wide an array of registers, of OneNumber a vector of Eigen.
template <class Number, int N>
struct RowsOf {
  using Type = std::array<typename Number::Values, std::size_t{N}>;
};
template <class T, int N>
struct RowsOf<OneNumber<T>, N> {
  using Type = Eigen::Matrix<T, N, 1>;
};

/// The largest (or smallest) of many numbers, and its index. Of equal numbers, the first.
template <class T>
struct Extreme {
  T value;
  std::uint32_t index;
};

/// The running maximum in every lane, and the index at which it occurred.
template <std::floating_point T>
struct WideMaximum {
  using Lanes = Wide<T>;
  typename Lanes::Values value;
  typename Lanes::Indices index;

  void take(typename Lanes::Values v, typename Lanes::Indices i) {
    const auto larger = v > value;
    value = larger ? v : value;
    index = larger ? i : index;
  }
  /// The maximum over all lanes. Computed without branches, because the lane with the maximum is
  /// unpredictable.
  Extreme<T> reduce() const {
    const auto top = Lanes::maximum(value);
    const auto none = typename Lanes::Indices{} + std::numeric_limits<typename Lanes::Lane>::max();
    const typename Lanes::Indices candidates = value == top ? index : none;
    const auto first = Lanes::template fold<Lanes::lanes / 2>(
        candidates, [](const auto& x, const auto& y) { return x < y ? x : y; });
    return {top[0], static_cast<std::uint32_t>(first[0])};
  }
};

}  // namespace moreau::detail
