// SPDX-License-Identifier: MIT
// Numbers in texts, whatever the locale.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

namespace moreau::detail {

/// What a decimal number that is out of the range of double stands for: 0, or infinity, with its sign.
/// @param word digits, with a sign, a point and an exponent if it has them
inline double out_of_range(std::string_view word) {
  const bool is_negative = word.front() == '-';
  if (is_negative) word.remove_prefix(1);
  const std::size_t e = std::min(word.find_first_of("eE"), word.size());
  const std::string_view mantissa = word.substr(0, e);
  const auto point = static_cast<std::ptrdiff_t>(std::min(mantissa.find('.'), mantissa.size()));
  const auto first = static_cast<std::ptrdiff_t>(mantissa.find_first_of("123456789"));
  std::ptrdiff_t exponent = 0;  // stays 0 if it is out of range itself
  const bool shrinks = e + 1 < word.size() && word[e + 1] == '-';
  std::string_view digits = word.substr(std::min(e + 1, word.size()));
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  const auto end = digits.data() + digits.size();
  const bool is_long =
      std::from_chars(digits.data(), end, exponent).ec == std::errc::result_out_of_range;
  const bool is_small = is_long ? shrinks : exponent + point - first < 0;
  const double size = is_small ? 0 : std::numeric_limits<double>::infinity();
  return is_negative ? -size : size;
}

/// Reads a word as a number.
/// @param value out: the number; infinite or 0 if it is too large or too small for a double
/// @returns whether the whole word is a number, "nan" and "inf" included
inline bool parse_number(std::string_view word, double& value) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
#if defined(__cpp_lib_to_chars)
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return false;
  // 1e-400 is 0, 1e400 is inf. strtod would ask the locale for the decimal point.
  if (error == std::errc::result_out_of_range) value = out_of_range(word);
  return error == std::errc() || error == std::errc::result_out_of_range;
#else  // libc++ before version 20. strtod also reads a second '+' and hexadecimal numbers.
  const std::string text(word);
  if (text.empty() || text.front() == '+' || text.find_first_of("xX") != std::string::npos)
    return false;
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return end == text.c_str() + text.size();
#endif
}

/// A word in a form that can be printed: at most 32 characters, with ? in place of characters that
/// are not printable. The file may be binary.
inline std::string shown(std::string_view word) {
  constexpr std::size_t most = 32;
  std::string text(word.substr(0, most));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return word.size() > most ? text + "..." : text;
}

}  // namespace moreau::detail
