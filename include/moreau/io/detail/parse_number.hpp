// SPDX-License-Identifier: MIT
// Numbers in texts, whatever the locale.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

namespace moreau::detail {

/// Reads a word as a number.
/// @param value out: the number; infinite or 0 if it is too large or too small for a double
/// @returns whether the whole word is a number, "nan" and "inf" included
inline bool parse_number(std::string_view word, double& value) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
#if defined(__cpp_lib_to_chars)
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return false;
  if (error == std::errc::result_out_of_range)  // 1e-400 is 0, 1e400 is inf
    value = std::strtod(std::string(word).c_str(), nullptr);
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
