// SPDX-License-Identifier: MIT
// Meshes from OBJ, STL and PLY files, by the library assimp.
//
// It needs assimp (CMake: moreau::mesh; else -lassimp). Polygons of a file are divided into
// triangles. Vertices at the same position become one vertex, because an STL file repeats the
// corners of each triangle; nothing else is changed. Assimp holds coordinates in single precision.
#pragma once

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/shape/facet_mesh.hpp"

namespace moreau {

/// A group or object of a file.
template <std::floating_point T = double>
struct MeshGroup {
  std::string name;      ///< as the file has it; empty in a file without names
  TriangleMesh<T> mesh;  ///< its triangles
};

namespace detail {

/// Appends what assimp has read to a mesh; vertices at the same position become one.
template <std::floating_point T>
class MeshCollector {
 public:
  explicit MeshCollector(T unit) : unit_(unit) {}

  /// @throws std::runtime_error for a face that is a point or a line, or that has a corner that does
  ///                            not exist
  void add(const aiMesh& from, const std::string& path) {
    std::vector<std::uint32_t> number(from.mNumVertices);
    for (unsigned v = 0; v < from.mNumVertices; ++v) number[v] = vertex(from.mVertices[v]);
    for (unsigned f = 0; f < from.mNumFaces; ++f) {
      const aiFace& face = from.mFaces[f];
      if (face.mNumIndices != 3)
        throw std::runtime_error(path + ": face " + std::to_string(f) + " has " +
                                 std::to_string(face.mNumIndices) +
                                 " corners: points and lines bound no solid");
      auto& corners = mesh.facets.emplace_back();
      for (unsigned k = 0; k < 3; ++k) {
        if (face.mIndices[k] >= number.size())
          throw std::runtime_error(path + ": face " + std::to_string(f) + " has the corner " +
                                   std::to_string(face.mIndices[k]) + " of " +
                                   std::to_string(number.size()) + " vertices");
        corners[k] = number[face.mIndices[k]];
      }
    }
  }

  /// @throws std::runtime_error if single precision does not hold the shape
  void require_near_origin(const std::string& path) const {
    const T size = size_of(mesh), far = largest_coordinate(mesh);
    if (far <= T(1e4) * size || !(size > 0)) return;
    std::ostringstream message;
    message << path << ": the mesh has a size of " << size << " m and coordinates up to " << far
            << " m, of which the reader keeps seven digits: move it to the origin";
    throw std::runtime_error(message.str());
  }

  TriangleMesh<T> mesh;

 private:
  std::uint32_t vertex(const aiVector3D& x) {
    const std::array<float, 3> key{x.x + 0.f, x.y + 0.f, x.z + 0.f};  // -0 is 0
    const bool is_number = std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
    const auto next = std::uint32_t(mesh.vertices.size());
    const auto found = is_number ? numbers_.try_emplace(key, next).first->second : next;
    if (found == next) mesh.vertices.push_back({unit_ * T(x.x), unit_ * T(x.y), unit_ * T(x.z)});
    return found;
  }

  T unit_;
  std::map<std::array<float, 3>, std::uint32_t> numbers_;
};

/// Reads a file and calls use(aiMesh) for each of its groups.
template <class Use>
void for_each_group(const std::filesystem::path& path, const char* function, const Use& use) {
  std::string kind = path.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  require(kind == ".obj" || kind == ".stl" || kind == ".ply", function, "path", path.string(),
          "must end in .obj, .stl or .ply");
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_Triangulate);
  if (scene == nullptr) throw std::runtime_error(path.string() + ": " + importer.GetErrorString());
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) use(*scene->mMeshes[m]);
}

template <std::floating_point T>
void require_unit(T unit, const char* function) {
  require(std::isfinite(unit) && unit > 0, function, "unit", unit, "m must be finite and > 0");
}

}  // namespace detail

/// Reads all groups of a file into one mesh. The mesh is not checked: call require_solid() or
/// require_surface() (shape/check_mesh.hpp), and the repairs of shape/repair_mesh.hpp before, if
/// they are wanted.
/// @param path of an .obj, .stl or .ply file
/// @param unit length of one unit of the file [m]: 1e-3 for a file in millimetres
/// @returns the mesh in the frame of the file [m], triangles in the order of the file
/// @throws std::invalid_argument for another kind of file, or a unit that is not finite and positive
/// @throws std::runtime_error naming the file if it cannot be read, or if the mesh is farther from the
///         origin than ten thousand times its size: the reader keeps single precision
template <std::floating_point T>
TriangleMesh<T> read_mesh(const std::filesystem::path& path, T unit) {
  detail::require_unit(unit, "read_mesh");
  detail::MeshCollector<T> all(unit);
  detail::for_each_group(path, "read_mesh",
                         [&](const aiMesh& group) { all.add(group, path.string()); });
  all.require_near_origin(path.string());
  return std::move(all.mesh);
}

/// Reads each group or object of a file into a mesh of its own: the convex parts of a concave grain
/// that another program has made.
/// @param path of an .obj, .stl or .ply file; only .obj files have several groups. Their names must
///             differ: assimp gives the triangles of a name that comes again to another group. A group
///             with several materials is several groups, named after these
/// @param unit length of one unit of the file [m]
/// @throws std::invalid_argument, std::runtime_error as read_mesh()
template <std::floating_point T>
std::vector<MeshGroup<T>> read_mesh_groups(const std::filesystem::path& path, T unit) {
  detail::require_unit(unit, "read_mesh_groups");
  std::vector<MeshGroup<T>> groups;
  detail::for_each_group(path, "read_mesh_groups", [&](const aiMesh& group) {
    detail::MeshCollector<T> part(unit);
    part.add(group, path.string());
    part.require_near_origin(path.string());
    groups.push_back({group.mName.C_Str(), std::move(part.mesh)});
  });
  return groups;
}

}  // namespace moreau
