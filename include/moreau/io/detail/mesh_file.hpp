// SPDX-License-Identifier: MIT
// Common to the readers of mesh files: the words of a text, the integers of a binary file, and the triangles that a
// file holds.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/io/detail/parse_number.hpp"

namespace moreau::detail {

/// The content of a mesh file, in its own unit.
struct MeshFile {
  using Triangle = std::array<std::uint32_t, 3>;  ///< indices of the corners
  std::vector<Eigen::Vector3d> vertices;          ///< in the order of the file
  std::vector<Triangle> triangles;                ///< in the order of the file
  std::vector<std::uint32_t> group_of;            ///< of each triangle
  std::vector<std::string> groups;                ///< their names, in the order of the file
  /// Significant digits of the coordinates: 7 of a binary file of floats, of a text the most that it
  /// has written.
  int digits = 0;
  bool has_numbered_vertices = true;  ///< false for STL, which repeats the corners
  bool is_binary = false;             ///< floats or doubles, not a text

  /// The largest error of a coordinate by the rounding of the file, in its own unit; 0: that of a double. Coordinates with
  /// up to nine digits were floats, as far as is known, or have fewer digits. Fewer than four digits say nothing: a
  /// corner at 0.5 is meant to be there.
  double rounding() const {
    constexpr int few = 4, of_float = 9;
    double largest = 0;
    for (const Eigen::Vector3d& x : vertices) largest = std::max(largest, x.cwiseAbs().maxCoeff());
    if (!(largest > 0) || digits > std::numeric_limits<double>::digits10) return 0;
    const double by_digits = 0.5 * std::pow(10., std::floor(std::log10(largest)) + 1 - digits);
    const double by_float = std::ldexp(1., std::ilogb(largest) - 24);
    if (digits > of_float) return by_digits;
    return is_binary || digits < few ? by_float : std::max(by_digits, by_float);
  }

  void add_triangle(const Triangle& corners) {
    if (groups.empty()) begin_group({});
    triangles.push_back(corners);
    group_of.push_back(current_group);
  }
  /// The groups of the object before are complete: a name that comes again is another group.
  void begin_object(std::string_view name) {
    number_of_group.clear();
    begin_group(name);
  }
  /// Later triangles belong to this group; a name that comes again in the same object is the same group.
  void begin_group(std::string_view name) {
    const auto next = static_cast<std::uint32_t>(groups.size());
    current_group = number_of_group.try_emplace(std::string(name), next).first->second;
    if (current_group == next) groups.emplace_back(name);
  }
  void add_polygon(std::span<const std::uint32_t> corners);

  std::uint32_t current_group = 0;
  std::map<std::string, std::uint32_t> number_of_group;
};

/// Divides a plane polygon into triangles: cuts off corners that turn to the left and contain no
/// other corner. Corners on a straight line are not cut off by themselves. Corners at the same place are one: a polygon
/// with a hole passes twice through the two ends of the cut that joins its rim to the hole.
inline void MeshFile::add_polygon(std::span<const std::uint32_t> corners) {
  if (corners.size() == 3) return add_triangle({corners[0], corners[1], corners[2]});
  const std::size_t count = corners.size();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t k = 2; k < count; ++k)
    normal += (vertices[corners[k - 1]] - vertices[corners[0]])
                  .cross(vertices[corners[k]] - vertices[corners[0]]);
  const double flat = 1e-12 * normal.norm();
  const Eigen::Vector3d up = normal.normalized();
  const auto turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return up.dot((vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]));
  };
  // The corners that are left, as a ring of places in `corners`.
  std::vector<std::size_t> next(count), previous(count);
  for (std::size_t k = 0; k < count; ++k) next[k] = (k + 1) % count, previous[next[k]] = k;
  const auto is_convex = [&](std::size_t k) {
    return turn(corners[previous[k]], corners[k], corners[next[k]]) > flat;
  };
  // If a corner lies in a triangle that is to be cut off, one that is not convex does. The angle of a corner does not grow.
  std::vector<unsigned char> is_reflex(count, 0);
  std::vector<std::size_t> reflex;
  for (std::size_t k = 0; k < count; ++k)
    if (!is_convex(k)) is_reflex[k] = 1, reflex.push_back(k);
  const auto is_ear = [&](std::size_t k) {
    if (is_reflex[k] != 0 || !is_convex(k)) return false;
    const std::uint32_t a = corners[previous[k]], b = corners[k], c = corners[next[k]];
    return std::none_of(reflex.begin(), reflex.end(), [&](std::size_t other) {
      if (is_reflex[other] == 0) return false;
      const std::uint32_t x = corners[other];
      if (turn(a, b, x) < 0 || turn(b, c, x) < 0 || turn(c, a, x) < 0) return false;
      return vertices[x] != vertices[a] && vertices[x] != vertices[b] && vertices[x] != vertices[c];
    });
  };
  std::size_t at = 0, stale = 0;
  for (std::size_t left = count; left > 3; --left) {
    std::size_t tried = 0;
    for (; tried < left && !is_ear(at); ++tried) at = next[at];
    if (tried == left)
      at = next[at];  // not plane, or it crosses itself: the checks of meshes judge it
    const std::size_t before = previous[at], after = next[at];
    add_triangle({corners[before], corners[at], corners[after]});
    next[before] = after, previous[after] = before;
    for (const std::size_t k : {before, at, after})
      if (is_reflex[k] != 0 && (k == at || is_convex(k))) is_reflex[k] = 0, ++stale;
    if (2 * stale > reflex.size()) {
      std::erase_if(reflex, [&](std::size_t k) { return is_reflex[k] == 0; });
      stale = 0;
    }
    at = after;
  }
  add_triangle({corners[previous[at]], corners[at], corners[next[at]]});
}

/// The words of a text, with the numbers of their lines.
class MeshWords {
 public:
  /// @throws std::runtime_error for a text in UTF-16 and for binary data
  explicit MeshWords(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
    if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF"))
      throw std::runtime_error("the text is in UTF-16: save it in UTF-8");
    const auto zero = text_.find('\0');
    if (zero == std::string_view::npos) return;
    throw std::runtime_error("byte " + std::to_string(zero) +
                             " is 0: the file is no text, or a text in UTF-16 (save it in UTF-8)");
  }

  /// The next word, empty at the end of the text.
  std::string_view next() {
    skip_blanks(" \t\r\f\v\n");
    return take();
  }
  /// The next word of the line, empty at its end. A backslash at the end continues the line.
  std::string_view next_of_line() {
    skip_blanks(" \t\r\f\v");
    while (at_ < text_.size() && text_[at_] == '\\' && is_line_end(at_ + 1)) {
      ++at_;
      skip_blanks(" \t\r\f\v\n");
    }
    if (at_ < text_.size() && text_[at_] == '\n') return {};
    return take();
  }
  /// The rest of the line, without blanks around it; goes to the next line.
  std::string_view rest_of_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view rest = text_.substr(at_, end - at_);
    at_ = end;
    while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
    while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
    return rest;
  }
  bool is_at_end() {
    skip_blanks(" \t\r\f\v\n");
    return at_ == text_.size();
  }
  std::string_view rest() const { return text_.substr(at_); }

  /// @throws std::runtime_error always, naming the line
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error("line " + std::to_string(line_) + ": " + what);
  }
  /// A finite number; counts its digits.
  double number(std::string_view word, int& digits) const {
    double value = 0;
    if (word.empty()) fail("a number is missing");
    if (!parse_number(word, value)) fail("'" + shown(word) + "' must be a number");
    if (!std::isfinite(value)) fail("the coordinate " + shown(word) + " must be finite");
    int count = 0;
    for (const char c : word.substr(0, word.find_first_of("eE")))
      if (std::isdigit(static_cast<unsigned char>(c)) != 0 && (count > 0 || c != '0')) ++count;
    digits = std::max(digits, count);
    return value;
  }

 private:
  static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
  }
  bool is_line_end(std::size_t at) const {
    while (at < text_.size() && is_blank(text_[at])) ++at;
    return at == text_.size() || text_[at] == '\n';
  }
  void skip_blanks(std::string_view blanks) {
    for (; at_ < text_.size() && blanks.find(text_[at_]) != std::string_view::npos; ++at_)
      line_ += std::size_t(text_[at_] == '\n');
  }
  std::string_view take() {
    const std::size_t end = std::min(text_.find_first_of(" \t\r\f\v\n", at_), text_.size());
    const std::string_view word = text_.substr(at_, end - at_);
    at_ = end;
    return word;
  }

  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
};

/// An unsigned integer of a binary file. The bytes must reach to the end of the integer; this is not checked.
/// @param begin         its first byte, in the file
/// @param is_big_endian whether the byte of the highest value comes first
template <class Unsigned>
Unsigned unsigned_at(std::string_view bytes, std::size_t begin, bool is_big_endian = false) {
  MOREAU_ASSERT(begin + sizeof(Unsigned) <= bytes.size());
  Unsigned value = 0;
  for (std::size_t k = 0; k < sizeof value; ++k) {
    const auto byte =
        static_cast<unsigned char>(bytes[begin + (is_big_endian ? sizeof value - 1 - k : k)]);
    value = static_cast<Unsigned>(value | static_cast<Unsigned>(Unsigned{byte} << (8 * k)));
  }
  return value;
}

/// A word in lower case.
inline std::string lower_case(std::string_view word) {
  std::string text(word);
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace moreau::detail
