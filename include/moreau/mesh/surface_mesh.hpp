// SPDX-License-Identifier: MIT
// The surface of a grain as points and faces, for files and pictures. The mesh of a polytope
// consists of its vertices and faces. The mesh of any other shape is inscribed: its points are the
// support points in the directions of the vertices of a fine polyhedron (in the plane a polygon).
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/one_of.hpp"

namespace moreau {

/// A surface as points and faces. A face is a list of point indices, counter-clockwise seen from
/// outside. In the plane there is one face, the outline.
template <class S>
struct SurfaceMesh {
  std::vector<typename S::Vector> points;  ///< body coordinates [m]
  std::vector<std::int32_t> corners;       ///< the point indices of all faces, face after face
  std::vector<std::int32_t> ends;  ///< for each face, the index in `corners` one past its last
                                   ///< corner

  /// Removes points and faces; keeps the memory.
  void clear() {
    points.clear();
    corners.clear();
    ends.clear();
  }
  /// Makes a face of the corners that were added after the last face.
  void end_face() { ends.push_back(static_cast<std::int32_t>(corners.size())); }
};

namespace detail {

/// A regular polygon with 8 * 2^fineness corners on the unit circle.
template <class T>
SurfaceMesh<Space<2, T>> unit_mesh(Space<2, T>, int fineness) {
  SurfaceMesh<Space<2, T>> mesh;
  const int count = 8 << fineness;
  for (int k = 0; k < count; ++k) {
    const T angle = 2 * std::numbers::pi_v<T> * T(k) / T(count);
    mesh.points.emplace_back(std::cos(angle), std::sin(angle));
    mesh.corners.push_back(k);
  }
  mesh.end_face();
  return mesh;
}

/// Divides each triangle into four triangles. The new points lie on the unit sphere.
template <class T>
SurfaceMesh<Space<3, T>> split(const SurfaceMesh<Space<3, T>>& coarse) {
  SurfaceMesh<Space<3, T>> fine;
  fine.points = coarse.points;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t i, std::int32_t j) {
    const auto [at, is_new] = middles.try_emplace(std::minmax(i, j), 0);
    if (is_new) {
      at->second = static_cast<std::int32_t>(fine.points.size());
      fine.points.push_back(
          (coarse.points[std::size_t(i)] + coarse.points[std::size_t(j)]).normalized());
    }
    return at->second;
  };
  for (std::size_t f = 0; f < coarse.ends.size(); ++f) {
    const std::int32_t* x = &coarse.corners[3 * f];
    const std::int32_t m[] = {middle(x[0], x[1]), middle(x[1], x[2]), middle(x[2], x[0])};
    const std::int32_t triangles[4][3] = {
        {x[0], m[0], m[2]}, {m[0], x[1], m[1]}, {m[2], m[1], x[2]}, {m[0], m[1], m[2]}};
    for (const auto& triangle : triangles) {
      fine.corners.insert(fine.corners.end(), std::begin(triangle), std::end(triangle));
      fine.end_face();
    }
  }
  return fine;
}

/// An icosahedron on the unit sphere, each triangle of which is divided into four `fineness` times.
template <class T>
SurfaceMesh<Space<3, T>> unit_mesh(Space<3, T>, int fineness) {
  SurfaceMesh<Space<3, T>> mesh;
  const T g = std::numbers::phi_v<T>;
  const T corners[12][3] = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                            {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                            {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  constexpr std::int32_t faces[20][3] = {
      {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (const auto& x : corners)
    mesh.points.push_back(typename Space<3, T>::Vector(x[0], x[1], x[2]).normalized());
  for (const auto& face : faces) {
    mesh.corners.insert(mesh.corners.end(), std::begin(face), std::end(face));
    mesh.end_face();
  }
  for (int k = 0; k < fineness; ++k) mesh = split(mesh);
  return mesh;
}

template <class ShapeT, class T>
void append_faces(const ShapeT& shape, SurfaceMesh<Space<2, T>>& mesh) {
  for (Eigen::Index i = 0; i < shape.vertices().rows(); ++i)
    mesh.corners.push_back(static_cast<std::int32_t>(i));
  mesh.end_face();
}
template <class ShapeT, class T>
void append_faces(const ShapeT& shape, SurfaceMesh<Space<3, T>>& mesh) {
  for (std::size_t f = 0; f < shape.face_count(); ++f) {
    for (const auto vertex : shape.face(f))
      mesh.corners.push_back(static_cast<std::int32_t>(vertex));
    mesh.end_face();
  }
}

}  // namespace detail

/// Computes meshes of shapes. It stores the directions of the support points for shapes with curved
/// surfaces.
template <class S>
class SurfaceMesher {
 public:
  /// @param fineness resolution of curved surfaces, 0 to 6: 8 * 2^fineness points in the plane, 10
  ///                 * 4^fineness + 2 points in space
  /// @throws std::invalid_argument if the fineness is not in this range
  explicit SurfaceMesher(int fineness = 2) {
    require(fineness >= 0 && fineness <= 6, "SurfaceMesher", "fineness", fineness,
            "must lie in [0, 6]");
    directions_ = detail::unit_mesh(S{}, fineness);
  }

  /// Replaces the contents of `mesh` by the surface of a shape in body coordinates [m]. It is exact
  /// for polytopes and inscribed for other shapes.
  template <ConvexShape ShapeT>
  void mesh(const ShapeT& shape, SurfaceMesh<S>& mesh) const {
    mesh.clear();
    if constexpr (Polytope<ShapeT>) {
      for (Eigen::Index i = 0; i < shape.vertices().rows(); ++i)
        mesh.points.push_back(shape.vertices().row(i).transpose());
      detail::append_faces(shape, mesh);
    } else {
      mesh.corners = directions_.corners;
      mesh.ends = directions_.ends;
      for (const typename S::Vector& direction : directions_.points)
        mesh.points.push_back(shape.support(direction));
    }
  }
  /// The mesh of the shape that a OneOf holds.
  template <ConvexShape... Shapes>
  void mesh(const OneOf<Shapes...>& shape, SurfaceMesh<S>& out) const {
    shape.visit([&](const auto& held) { mesh(held, out); });
  }
  /// The surfaces of all parts of a compound grain, one after the other. The pieces of them that lie inside
  /// the grain are not cut off.
  template <CompoundShape ShapeT>
  void mesh(const ShapeT& shape, SurfaceMesh<S>& out) const {
    out.clear();
    SurfaceMesh<S> of_part;
    for (const auto& part : shape.parts()) {
      mesh(part.shape, of_part);
      const auto first = static_cast<std::int32_t>(out.points.size());
      const auto corner = static_cast<std::int32_t>(out.corners.size());
      for (const auto& x : of_part.points) out.points.push_back(part.pose(x));
      for (const std::int32_t k : of_part.corners) out.corners.push_back(first + k);
      for (const std::int32_t end : of_part.ends) out.ends.push_back(corner + end);
    }
  }

 private:
  SurfaceMesh<S> directions_;
};

}  // namespace moreau
