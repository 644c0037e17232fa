// SPDX-License-Identifier: MIT
// What a fuzz target makes of the bytes that it is given, and how it says that something is wrong.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

/// Ends the program with a message unless the condition holds: a finding.
inline void hold(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

/// Numbers from bytes, taken one after the other; zeros once they have run out.
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
  /// A whole number in [lowest, highest], at most 256 of them.
  int between(int lowest, int highest) {
    return lowest + raw<std::uint8_t>() % (highest - lowest + 1);
  }
  /// A number on a grid of quarters, that number and a little more or less, a number of three
  /// digits, or (if wild) any bits: infinities and denormals are among them.
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
