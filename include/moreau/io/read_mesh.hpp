// SPDX-License-Identifier: MIT
// Meshes from OBJ, STL and PLY files. No library is needed.
//
// Polygons of a file are divided into triangles. Corners at the same position become one corner,
// because an STL file repeats the corners of each triangle; nothing else is changed. The vertices of an
// OBJ or PLY file keep their numbers, counted from 0: of vertices at the same position, triangles have
// the first. The vertices of an STL file are numbered as they come.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/io/detail/input_file.hpp"
#include "moreau/io/detail/mesh_file.hpp"
#include "moreau/io/detail/read_obj.hpp"
#include "moreau/io/detail/read_ply.hpp"
#include "moreau/io/detail/read_stl.hpp"
#include "moreau/mesh/facet_mesh.hpp"
#include "moreau/mesh/repair_mesh.hpp"

namespace moreau {

/// A group or object of a file.
template <std::floating_point T = double>
struct MeshGroup {
  std::string name;      ///< as the file has it; empty in a file without names
  TriangleMesh<T> mesh;  ///< its triangles
};

namespace detail {

/// Reads a file, in its own unit.
/// @throws std::runtime_error naming the file
inline MeshFile read_mesh_file(const std::filesystem::path& path, const char* function) {
  const std::string kind = lower_case(path.extension().string());
  require(kind == ".obj" || kind == ".stl" || kind == ".ply", function, "path", path.string(),
          "must end in .obj, .stl or .ply");
  const std::string bytes = read_file(path, function);
  try {
    if (bytes.empty()) throw std::runtime_error("the file is empty");
    MeshFile file = kind == ".obj"   ? read_obj(bytes)
                    : kind == ".stl" ? read_stl(bytes)
                                     : PlyReader::read(bytes);
    if (file.triangles.empty())
      throw std::runtime_error("the file has " + std::to_string(file.vertices.size()) +
                               " vertices, but no triangle");
    return file;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

/// Lets corners at the same position have the same number: the first. The vertices of a file that
/// does not number them are renumbered without gaps.
inline void merge_corners(MeshFile& file) {
  struct Corner {
    std::array<double, 3> x;
    std::uint32_t number;
  };
  std::vector<Corner> corners;
  corners.reserve(file.vertices.size());
  // The sum turns -0 into 0.
  for (const Eigen::Vector3d& x : file.vertices)
    corners.push_back({{x[0] + 0.0, x[1] + 0.0, x[2] + 0.0}, std::uint32_t(corners.size())});
  std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
    return a.x != b.x ? a.x < b.x : a.number < b.number;
  });
  std::vector<std::uint32_t> number(corners.size());  // at first the first corner at the position
  for (std::size_t k = 0; k < corners.size(); ++k)
    number[corners[k].number] = k > 0 && corners[k].x == corners[k - 1].x
                                    ? number[corners[k - 1].number]
                                    : corners[k].number;
  std::vector<Eigen::Vector3d> kept;
  for (std::size_t v = 0; v < number.size(); ++v) {
    const bool is_new = number[v] == v;
    number[v] = !is_new                      ? number[number[v]]
                : file.has_numbered_vertices ? std::uint32_t(v)
                                             : std::uint32_t(kept.size());
    if (is_new || file.has_numbered_vertices) kept.push_back(file.vertices[v]);
  }
  file.vertices = std::move(kept);
  for (auto& triangle : file.triangles)
    for (std::uint32_t& v : triangle) v = number[v];
}

/// @throws std::runtime_error if the digits of the file do not hold the shape
template <std::floating_point T>
void require_near_origin(const TriangleMesh<T>& mesh, int digits, const std::string& path) {
  const int kept = std::min(digits, std::numeric_limits<T>::digits10);
  const T size = size_of(mesh), far = largest_coordinate(mesh);
  if (far <= T(std::pow(10., std::max(kept, 7) - 3)) * size || !(size > 0)) return;
  std::ostringstream message;
  message << path << ": the mesh has a size of " << size << " m and coordinates up to " << far
          << " m, of which " << kept << " digits are known: move it to the origin";
  throw std::runtime_error(message.str());
}

/// The vertices and triangles of a file. Their distance from the origin is not checked.
template <std::floating_point T>
TriangleMesh<T> mesh_of_file(const MeshFile& file, T unit, const std::string& path) {
  TriangleMesh<T> mesh;
  for (const Eigen::Vector3d& x : file.vertices) {
    mesh.vertices.push_back((double(unit) * x).template cast<T>());
    if (!mesh.vertices.back().allFinite())
      throw std::runtime_error(path + ": vertex " + std::to_string(mesh.vertices.size() - 1) +
                               " is too large for the scalar type");
  }
  mesh.facets.assign(file.triangles.begin(), file.triangles.end());
  mesh.rounding = static_cast<T>(double(unit) * file.rounding());
  return mesh;
}

template <std::floating_point T>
void require_unit(T unit, const char* function) {
  require(std::isfinite(unit) && unit > 0, function, "unit", unit, "m must be finite and > 0");
}

}  // namespace detail

/// Reads all groups of a file into one mesh. The mesh is not checked: call require_solid() or
/// require_surface() (mesh/check_mesh.hpp), and the repairs of mesh/repair_mesh.hpp before, if
/// they are wanted. FacetMesh::rounding says how far coordinates are known: of a binary file of floats half a unit of the last
/// bit of the largest coordinate, of a text half a unit of its last digit. Given the path as the name of the function, their messages name the file.
/// @param path of an .obj, .stl or .ply file
/// @param unit length of one unit of the file [m]: 1e-3 for a file in millimetres
/// @returns the mesh in the frame of the file [m], vertices and triangles in the order of the file
/// @throws std::invalid_argument for another kind of file, or a unit that is not finite and positive
/// @throws std::runtime_error naming the file, and the line, triangle or vertex, if it cannot be read,
///         is damaged, has no triangle or a coordinate that is not finite, or if the mesh is farther
///         from its origin than its digits allow: ten thousand times its size with seven digits
template <std::floating_point T>
TriangleMesh<T> read_mesh(const std::filesystem::path& path, T unit) {
  detail::require_unit(unit, "read_mesh");
  detail::MeshFile file = detail::read_mesh_file(path, "read_mesh");
  detail::merge_corners(file);
  TriangleMesh<T> mesh = detail::mesh_of_file<T>(file, unit, path.string());
  detail::require_near_origin(mesh, file.digits, path.string());
  return mesh;
}

/// Reads each group or object of a file into a mesh of its own: the convex parts of a concave grain
/// that another program has made.
/// @param path of an .obj, .stl or .ply file; a PLY file has one group. Groups of the same name are
///             one group, unless a line "o" of an OBJ file begins another object between them. Each solid of an STL file is a
///             group of its own
/// @param unit length of one unit of the file [m]
/// @returns the groups with triangles, in the order of the file; each has the vertices of its own
/// @throws std::invalid_argument, std::runtime_error as read_mesh()
template <std::floating_point T>
std::vector<MeshGroup<T>> read_mesh_groups(const std::filesystem::path& path, T unit) {
  detail::require_unit(unit, "read_mesh_groups");
  detail::MeshFile file = detail::read_mesh_file(path, "read_mesh_groups");
  detail::merge_corners(file);
  const TriangleMesh<T> mesh = detail::mesh_of_file<T>(file, unit, path.string());
  std::vector<MeshGroup<T>> groups;
  auto meshes =
      detail::divided(mesh, std::span<const std::uint32_t>(file.group_of), file.groups.size());
  for (std::size_t g = 0; g < meshes.size(); ++g) {
    if (meshes[g].facets.empty()) continue;
    detail::require_near_origin(meshes[g], file.digits, path.string());
    groups.push_back({file.groups[g], std::move(meshes[g])});
  }
  return groups;
}

}  // namespace moreau
