// SPDX-License-Identifier: MIT
// Wavefront OBJ: vertices, polygons, names of objects and groups. Texture, normals and materials are
// read over.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "moreau/io/detail/mesh_file.hpp"

namespace moreau::detail {

/// The vertex that a word of a face means: "7", "7/1", "7//3", "7/1/3", or counted back from the last
/// vertex: "-1".
inline std::uint32_t obj_corner(const MeshWords& words, std::string_view word, std::size_t count) {
  const std::string_view index = word.substr(0, word.find('/'));
  double value = 0;
  if (!parse_number(index, value) || value != double(std::int64_t(value)))
    words.fail("corner '" + shown(word) + "' must be the number of a vertex");
  const double place = value < 0 ? double(count) + value : value - 1;
  if (!(place >= 0 && place < double(count)))
    words.fail("corner " + shown(word) + " must be one of the " + std::to_string(count) +
               " vertices before it, counted from 1");
  return static_cast<std::uint32_t>(place);
}

/// @throws std::runtime_error naming the line of the first error
inline MeshFile read_obj(std::string_view text) {
  constexpr std::array passed_over{
      "vt",         "vn",        "vp",    "s",        "mg",       "usemtl", "mtllib", "usemap",
      "maplib",     "lod",       "bevel", "c_interp", "d_interp", "ctech",  "stech",  "call",
      "shadow_obj", "trace_obj", "csh",   "cstype",   "deg",      "bmat",   "step",   "parm",
      "trim",       "hole",      "scrv",  "sp",       "end",      "con",    "curv2"};
  MeshFile file;
  MeshWords words(text);
  std::vector<std::uint32_t> corners;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word == "v") {
      Eigen::Vector3d x;
      for (double& c : x) c = words.number(words.next_of_line(), file.digits);
      file.vertices.push_back(x);
    } else if (word == "f" || word == "fo") {
      corners.clear();
      for (word = words.next_of_line(); !word.empty(); word = words.next_of_line())
        corners.push_back(obj_corner(words, word, file.vertices.size()));
      if (corners.size() < 3) words.fail("a face must have at least 3 corners");
      file.add_polygon(corners);
    } else if (word == "o") {
      file.begin_object(words.rest_of_line());
    } else if (word == "g") {
      file.begin_group(words.rest_of_line());
    } else if (word == "surf" || word == "curv") {
      words.fail("'" + shown(word) +
                 "' is a free-form surface or curve, which is not read: export triangles");
    } else if (word == "l" || word == "p") {
      words.fail("points and lines bound no solid");
    } else if (word.front() != '#' &&
               std::find(passed_over.begin(), passed_over.end(), word) == passed_over.end()) {
      words.fail("'" + shown(word) + "' is no keyword of an OBJ file");
    }
    if (word.starts_with('#')) words.rest_of_line();  // a backslash continues no comment
    while (!words.next_of_line().empty()) continue;
  }
  return file;
}

}  // namespace moreau::detail
