// SPDX-License-Identifier: MIT
// Functions shared by the fuzz targets: numbers from the input bytes, and the report of a failure.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

/// Ends the program with a message unless the condition holds.
inline void hold(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

/// Takes numbers from the input bytes one after the other. After the end of the input, all bytes
/// are zero.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  bool is_empty() const { return left_ == 0; }
  template <class T>
  T raw() {
    T value{};
    const std::size_t count = std::min(left_, sizeof value);
    if (count > 0) std::memcpy(&value, data_, count);
    data_ += count;
    left_ -= count;
    return value;
  }
  /// An integer in [lowest, highest]. The range has at most 256 values.
  int between(int lowest, int highest) {
    return lowest + raw<std::uint8_t>() % (highest - lowest + 1);
  }
  /// A number of one of four kinds: a multiple of a quarter; such a number plus or minus a small
  /// number; a number with three digits; or, if wild, arbitrary bits, including infinities and
  /// denormal numbers.
  double number(bool wild = false) {
    switch (between(0, wild ? 3 : 2)) {
      case 0:
        return 0.25 * between(-8, 8);
      case 1: {
        const double on_grid = 0.25 * between(-8, 8);
        return on_grid + between(-3, 3) * std::ldexp(1., -between(20, 56));
      }
      case 2:
        return raw<std::int16_t>() / 8192.;
      default:
        return raw<double>();
    }
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};
