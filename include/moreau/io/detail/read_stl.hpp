// SPDX-License-Identifier: MIT
// STL, as a text or binary. The normals are read over: the order of the corners gives the outside.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "moreau/io/detail/mesh_file.hpp"

namespace moreau::detail {

constexpr std::size_t stl_header = 84, stl_triangle = 50;

/// 80 bytes of text, the number of triangles, then for each its normal, its corners and 2 bytes.
inline MeshFile read_binary_stl(std::string_view bytes) {
  MeshFile file;
  file.digits = 7;
  file.is_binary = true;
  file.has_numbered_vertices = false;
  const std::size_t count = (bytes.size() - stl_header) / stl_triangle;
  file.vertices.reserve(3 * count);
  for (std::size_t t = 0; t < count; ++t) {
    const auto first = static_cast<std::uint32_t>(file.vertices.size());
    for (std::size_t k = 0; k < 3; ++k) {
      Eigen::Vector3d x;
      for (std::size_t axis = 0; axis < 3; ++axis)
        x[Eigen::Index(axis)] = double(std::bit_cast<float>(unsigned_at<std::uint32_t>(
            bytes, stl_header + t * stl_triangle + 12 + 12 * k + 4 * axis)));
      if (!x.allFinite())
        throw std::runtime_error("triangle " + std::to_string(t) + ", corner " + std::to_string(k) +
                                 ": coordinates must be finite");
      file.vertices.push_back(x);
    }
    file.add_triangle({first, first + 1, first + 2});
  }
  return file;
}

/// solid NAME, for each triangle "facet normal .. outer loop vertex .. vertex .. vertex .. endloop
/// endfacet", endsolid, in any case of letters.
inline MeshFile read_text_stl(std::string_view text) {
  MeshFile file;
  file.has_numbered_vertices = false;
  MeshWords words(text);
  const auto expect = [&](const char* expected) {
    const std::string_view word = words.next();
    if (word.empty()) words.fail(std::string("the file ends before '") + expected + "'");
    if (lower_case(word) != expected)
      words.fail("'" + shown(word) + "' must be '" + expected + "'");
  };
  for (bool is_first = true; is_first || !words.is_at_end(); is_first = false) {
    expect("solid");
    file.begin_object(words.rest_of_line());
    while (true) {
      const std::string_view word = words.next();
      const std::string keyword = lower_case(word);
      if (keyword == "endsolid") break;
      if (word.empty()) words.fail("the file ends before 'endsolid'");
      if (keyword != "facet") words.fail("'" + shown(word) + "' must be 'facet' or 'endsolid'");
      expect("normal");
      for (int k = 0; k < 3; ++k) words.next();
      expect("outer");
      expect("loop");
      const auto first = static_cast<std::uint32_t>(file.vertices.size());
      for (int k = 0; k < 3; ++k) {
        expect("vertex");
        Eigen::Vector3d x;
        for (double& c : x) c = words.number(words.next(), file.digits);
        file.vertices.push_back(x);
      }
      expect("endloop");
      expect("endfacet");
      file.add_triangle({first, first + 1, first + 2});
    }
    words.rest_of_line();
  }
  return file;
}

/// A file whose size is that of its number of triangles is binary, even if it begins with "solid".
/// @throws std::runtime_error naming the line or triangle of the first error
inline MeshFile read_stl(std::string_view bytes) {
  const std::uint64_t count =
      bytes.size() >= stl_header ? unsigned_at<std::uint32_t>(bytes, stl_header - 4) : 0;
  const std::uint64_t wanted = stl_header + stl_triangle * count;
  if (bytes.size() >= stl_header && bytes.size() == wanted) return read_binary_stl(bytes);
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  const bool begins_as_text =
      begin != std::string_view::npos && lower_case(bytes.substr(begin, 5)) == "solid";
  const bool has_zero = bytes.find('\0') != std::string_view::npos;
  if (has_zero && bytes.size() >= stl_header && !bytes.starts_with("\xFF\xFE") &&
      !bytes.starts_with("\xFE\xFF"))
    throw std::runtime_error("a binary STL file of " + std::to_string(count) +
                             " triangles must have " + std::to_string(wanted) + " bytes, but has " +
                             std::to_string(bytes.size()));
  if (!begins_as_text && !has_zero && bytes.size() < stl_header && !bytes.starts_with("\xFF\xFE") &&
      !bytes.starts_with("\xFE\xFF"))
    throw std::runtime_error("no STL file: it must begin with 'solid', or have at least 84 bytes");
  return read_text_stl(bytes);
}

}  // namespace moreau::detail
