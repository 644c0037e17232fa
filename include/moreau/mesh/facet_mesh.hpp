// SPDX-License-Identifier: MIT
// A surface of triangles in space, or of line segments in the plane. Scans and CAD files contain
// such surfaces, and walls of any form are made of them. Triangles and segments are facets with D corners, so one text
// serves both dimensions.
//
// A facet mesh is data. check_mesh.hpp tests it, repair_mesh.hpp mends it on request,
// convex_of_mesh.hpp makes a grain of it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "moreau/core/aabb.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/space.hpp"
#include "moreau/shape/mass_properties.hpp"
#include "moreau/shape/moments.hpp"

namespace moreau {

/// A surface of facets. Seen from outside, the corners of a triangle run counter-clockwise. In the
/// plane an outline runs counter-clockwise around the solid.
template <EuclideanSpace S>
struct FacetMesh {
  using Vector = typename S::Vector;
  using Facet = std::array<std::uint32_t, std::size_t(S::dim)>;  ///< indices of the corners

  std::vector<Vector> vertices;  ///< in any frame [m]
  std::vector<Facet> facets;     ///< triangles; in the plane segments
  /// Largest error of a coordinate by the digits of the file that has the mesh [m]; 0: that of the scalar.
  typename S::Scalar rounding = 0;
};

/// A surface of triangles in space.
template <std::floating_point T = double>
using TriangleMesh = FacetMesh<Space<3, T>>;
/// A line of segments in the plane.
template <std::floating_point T = double>
using SegmentMesh = FacetMesh<Space<2, T>>;

/// The corners of a facet as the columns of a D x D matrix, in the frame of the mesh [m].
template <class S>
typename S::Matrix corners_of(const FacetMesh<S>& mesh, std::size_t facet) {
  typename S::Matrix corners;
  for (int k = 0; k < S::dim; ++k)
    corners.col(k) = mesh.vertices[mesh.facets[facet][std::size_t(k)]];
  return corners;
}

/// The normal of a triangle, pointing outside, as long as twice its area [m^2].
/// @param corners as columns [m]
template <std::floating_point T>
Eigen::Matrix<T, 3, 1> area_vector(const Eigen::Matrix<T, 3, 3>& corners) {
  const Eigen::Matrix<T, 3, 1> from = corners.col(0);
  return (corners.col(1) - from).cross(corners.col(2) - from);
}
/// The normal of a segment in the plane, pointing outside, as long as the segment [m].
/// @param corners as columns [m]
template <std::floating_point T>
Eigen::Matrix<T, 2, 1> area_vector(const Eigen::Matrix<T, 2, 2>& corners) {
  return {corners(1, 1) - corners(1, 0), corners(0, 0) - corners(0, 1)};
}

namespace detail {

/// Calls use(x) for the corners of all facets that are finite vertices; without facets for all such vertices. A vertex
/// that no facet has, such as a marker in a file, is no part of the surface.
template <class S>
void for_each_corner(const FacetMesh<S>& mesh, const auto& use) {
  const auto add = [&](const typename S::Vector& x) {
    if (x.allFinite()) use(x);
  };
  if (mesh.facets.empty())
    for (const auto& x : mesh.vertices) add(x);
  for (const auto& facet : mesh.facets)
    for (const std::uint32_t v : facet)
      if (v < mesh.vertices.size()) add(mesh.vertices[v]);
}

}  // namespace detail

/// The longest edge of the box around the facets [m], wherever the origin is. Tolerances of meshes
/// are relative to it. A vertex with a coordinate that is not finite, or without a facet, is left out; if there
/// are no facets all finite vertices count.
template <class S>
typename S::Scalar size_of(const FacetMesh<S>& mesh) {
  Aabb<S> box;
  detail::for_each_corner(mesh, [&](const typename S::Vector& x) { box.merge(x); });
  return std::max<typename S::Scalar>((box.upper - box.lower).maxCoeff(), 0);
}

namespace detail {

/// The largest distance of a coordinate from 0 [m]; vertices are left out as in size_of().
template <class S>
typename S::Scalar largest_coordinate(const FacetMesh<S>& mesh) {
  typename S::Scalar largest = 0;
  for_each_corner(mesh, [&](const typename S::Vector& x) {
    largest = std::max(largest, x.cwiseAbs().maxCoeff());
  });
  return largest;
}
/// Largest change of a length by the rounding of coordinates [m].
template <class S>
typename S::Scalar rounding_of(const FacetMesh<S>& mesh) {
  using T = typename S::Scalar;
  return 16 * std::numeric_limits<T>::epsilon() * largest_coordinate(mesh);
}

}  // namespace detail

/// The mesh with all lengths multiplied by `factor` [-]: 1e-3 converts millimetres to metres.
/// @throws std::invalid_argument if the factor is not finite or not positive
template <class S>
[[nodiscard]] FacetMesh<S> scaled(FacetMesh<S> mesh, typename S::Scalar factor) {
  require_positive(factor, "scaled", "factor");
  for (auto& x : mesh.vertices) x *= factor;
  mesh.rounding *= factor;
  return mesh;
}

/// Moments at density one of the solid that a closed mesh bounds, about a point.
/// @param about in the frame of the mesh [m]
template <class S>
Moments<S> moments_of(const FacetMesh<S>& mesh, const typename S::Vector& about) {
  Moments<S> sum;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    sum.add_simplex(corners_of(mesh, f).colwise() - about);
  return sum;
}

/// Mass, centre of mass in the frame of the mesh, and inertia about the centre of mass of the solid
/// that a closed mesh bounds: the exact integral over the solid. The mesh is not checked
/// (require_solid() in check_mesh.hpp does). Zero of a mesh without facets.
/// @param density [kg/m^D], > 0
/// @throws std::invalid_argument unless the density and the volume are finite and > 0
template <class S>
MassProperties<S> mass_properties(const FacetMesh<S>& mesh, typename S::Scalar density) {
  using Vector = typename S::Vector;
  require_positive(density, "mass_properties", "density");
  if (mesh.facets.empty()) return {};
  // Three passes, each about a better centre: a scan may lie far from the origin of its frame.
  Vector center = mesh.vertices[mesh.facets[0][0]];
  for (int pass = 0; pass < 2; ++pass) {
    const Moments<S> rough = moments_of(mesh, center);
    center += rough.first / rough.volume;
  }
  const Moments<S> moments = moments_of(mesh, center);
  require_positive(moments.volume, "mass_properties", "volume of the mesh");
  return {density * moments.volume, center, density * moments.centered().inertia()};
}

/// The volume [m^D] of the solid that a closed mesh bounds: in the plane the area. Negative if the
/// mesh is inside out.
template <class S>
typename S::Scalar volume_of(const FacetMesh<S>& mesh) {
  if (mesh.facets.empty()) return 0;
  return moments_of(mesh, mesh.vertices[mesh.facets[0][0]]).volume;
}

/// Where facets join: an edge of triangles, in the plane the end of a segment. Each facet has D
/// ridges.
template <class S>
struct Ridge {
  std::array<std::uint32_t, std::size_t(S::dim - 1)> vertices;  ///< ascending
  std::uint32_t facet = 0;                                      ///< a facet that has this ridge
  std::uint32_t corner = 0;  ///< the corner of the facet that is not on the ridge: 0 .. D - 1
  /// The direction in which the facet runs along the ridge. Two facets of an oriented surface run
  /// in opposite directions.
  bool is_forward = false;
};

/// The ridges of all facets, sorted by their vertices, then by facet: facets that share a ridge are
/// next to each other.
template <class S>
std::vector<Ridge<S>> ridges_of(const std::vector<typename FacetMesh<S>::Facet>& facets) {
  std::vector<Ridge<S>> ridges;
  ridges.reserve(facets.size() * std::size_t(S::dim));
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (std::size_t corner = 0; corner < facets[f].size(); ++corner) {
      Ridge<S> ridge;
      ridge.facet = std::uint32_t(f);
      ridge.corner = std::uint32_t(corner);
      ridge.is_forward = corner % 2 == 0;
      auto& v = ridge.vertices;
      for (std::size_t k = 0, n = 0; k < facets[f].size(); ++k)
        if (k != corner) v[n++] = facets[f][k];
      for (std::size_t k = 1; k < v.size(); ++k)  // two vertices at most: one exchange sorts them
        if (v[k] < v[k - 1]) {
          std::swap(v[k], v[k - 1]);
          ridge.is_forward = !ridge.is_forward;
        }
      ridges.push_back(ridge);
    }
  std::sort(ridges.begin(), ridges.end(), [](const Ridge<S>& a, const Ridge<S>& b) {
    return a.vertices != b.vertices ? a.vertices < b.vertices : a.facet < b.facet;
  });
  return ridges;
}

/// Calls use(ridges) for each group of ridges at the same place: `ridges` is a span with one element
/// per facet that has the ridge.
/// @param ridges result of ridges_of()
template <class S, class Use>
void for_each_ridge(const std::vector<Ridge<S>>& ridges, const Use& use) {
  for (std::size_t begin = 0, end = 0; begin < ridges.size(); begin = end) {
    while (end < ridges.size() && ridges[end].vertices == ridges[begin].vertices) ++end;
    use(std::span<const Ridge<S>>(ridges.data() + begin, end - begin));
  }
}

namespace detail {

/// The number of no facet.
inline constexpr std::uint32_t no_facet = ~0U;

/// For each facet the facets that join it, at the ridges opposite its corners; `no_facet` at a rim.
/// @param ridges result of ridges_of()
/// @param count  number of facets
/// @param front  number of facets in front: these join among themselves, and so do those behind
template <class S>
std::vector<typename FacetMesh<S>::Facet> neighbours_of(const std::vector<Ridge<S>>& ridges,
                                                        std::size_t count, std::size_t front) {
  std::vector<typename FacetMesh<S>::Facet> neighbours(count);
  for (auto& joined : neighbours) joined.fill(no_facet);
  for_each_ridge(ridges, [&](std::span<const Ridge<S>> at) {
    for (const Ridge<S>& a : at)
      for (const Ridge<S>& b : at)
        if (a.is_forward != b.is_forward && (a.facet < front) == (b.facet < front))
          neighbours[a.facet][a.corner] = b.facet;
  });
  return neighbours;
}

/// The facets, the largest first, whatever their order in the mesh.
template <class S>
std::vector<std::uint32_t> largest_first(const FacetMesh<S>& mesh) {
  std::vector<std::pair<typename S::Scalar, typename S::Vector>> place(mesh.facets.size());
  std::vector<std::uint32_t> order(mesh.facets.size());
  for (std::uint32_t f = 0; f < order.size(); ++f) {
    const typename S::Matrix corners = corners_of(mesh, f);
    place[f] = {-area_vector(corners).norm(), corners.rowwise().mean()};
    order[f] = f;
  }
  std::sort(order.begin(), order.end(), [&](std::uint32_t f, std::uint32_t g) {
    const auto& [area, at] = place[f];
    const auto& [other, there] = place[g];
    if (area != other) return area < other;
    for (int k = 0; k < S::dim; ++k)
      if (at[k] != there[k]) return at[k] < there[k];
    return f < g;
  });
  return order;
}

}  // namespace detail

}  // namespace moreau
