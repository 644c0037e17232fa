// SPDX-License-Identifier: MIT
// Floors of facets of different sizes, with a given height.
#pragma once

#include <cstdint>
#include <random>

#include "moreau/mesh/facet_mesh.hpp"

namespace mesh_floor {

using moreau::FacetMesh;
using moreau::Space;

/// Adds n x n squares of two triangles each, of (n + 1) x (n + 1) vertices in rows.
template <class S>
void add_squares(FacetMesh<S>& mesh, int n) {
  const auto at = [&](int i, int j) { return std::uint32_t(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.facets.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.facets.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
}

/// A floor of n x n squares of two triangles each, or in the plane of n segments, from -size to size.
/// The last coordinate is height(x), the inner vertices are moved aside by up to 0.3 squares.
template <class Height>
FacetMesh<Space<3, double>> floor_of(Space<3, double>, double size, int n, const Height& height) {
  FacetMesh<Space<3, double>> mesh;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> aside(-0.3, 0.3);
  const double cell = 2 * size / n;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const bool inner = i > 0 && j > 0 && i < n && j < n;
      const double x = (i + (inner ? aside(random) : 0)) * cell - size;
      const double y = (j + (inner ? aside(random) : 0)) * cell - size;
      mesh.vertices.push_back({x, y, height(Eigen::Vector3d(x, y, 0))});
    }
  add_squares(mesh, n);
  return mesh;
}
template <class Height>
FacetMesh<Space<2, double>> floor_of(Space<2, double>, double size, int n, const Height& height) {
  FacetMesh<Space<2, double>> mesh;
  for (int i = 0; i <= n; ++i) {
    const double x = 2 * size * i / n - size;
    mesh.vertices.push_back({x, height(Eigen::Vector2d(x, 0))});
    // The outside is on the right of a segment: a floor runs to the left.
    if (i > 0) mesh.facets.push_back({std::uint32_t(i), std::uint32_t(i - 1)});
  }
  return mesh;
}

}  // namespace mesh_floor
