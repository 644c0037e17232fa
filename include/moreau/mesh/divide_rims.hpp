// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "moreau/core/aabb.hpp"
#include "moreau/core/box_tree.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/space.hpp"
#include "moreau/mesh/check_mesh.hpp"
#include "moreau/mesh/facet_mesh.hpp"

namespace moreau {

namespace detail {

/// A vertex within an edge of a triangle.
template <class T>
struct OnRim {
  std::uint32_t facet, corner;  ///< the edge begins at this corner of the triangle
  T along;                      ///< from there to the vertex [m]
  std::uint32_t vertex;

  friend constexpr auto operator<=>(const OnRim&, const OnRim&) = default;
};

/// The vertices of rims that lie within other rims, sorted.
template <std::floating_point T>
std::vector<OnRim<T>> vertices_on_rims(const TriangleMesh<T>& mesh, T tolerance) {
  using S = Space<3, T>;
  using Vector = typename S::Vector;
  std::vector<OnRim<T>> rims;  // of each its edge
  std::vector<std::uint32_t> vertices;
  std::vector<Aabb<S>> boxes;
  for_each_ridge(ridges_of<S>(mesh.facets), [&](std::span<const Ridge<S>> at) {
    if (at.size() != 1) return;
    rims.push_back({at[0].facet, (at[0].corner + 1) % 3, 0, 0});
    Aabb<S>& box = boxes.emplace_back();
    for (const std::uint32_t v : at[0].vertices) {
      box.merge(mesh.vertices[v]);
      vertices.push_back(v);
    }
  });
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const BoxTree<S> tree(boxes);
  std::vector<OnRim<T>> found;
  for (const std::uint32_t v : vertices) {
    const Vector& x = mesh.vertices[v];
    Aabb<S> around;
    around.merge(x);
    around = around.inflated(tolerance);
    tree.query([&](const Aabb<S>& box) { return box.overlaps(around); },
               [&](std::uint32_t place) {
                 const OnRim<T>& rim = rims[tree.order()[place]];
                 const auto& facet = mesh.facets[rim.facet];
                 if (std::find(facet.begin(), facet.end(), v) != facet.end()) return;
                 const Vector &begin = mesh.vertices[facet[rim.corner]],
                              &end = mesh.vertices[facet[(rim.corner + 1) % 3]];
                 const T length = (end - begin).norm(),
                         along = (x - begin).dot(end - begin) / length;
                 if (!(along > tolerance && along < length - tolerance)) return;
                 if ((x - begin - along / length * (end - begin)).norm() <= tolerance)
                   found.push_back({rim.facet, rim.corner, along, v});
               });
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace detail

/// Divides triangles at the vertices of others that lie on their rims, as where two fine tiles meet a coarse one:
/// the rim of the coarse tile is one edge, that of the fine ones is two. Afterwards both have the same edges. Call weld()
/// before, so that the ends of rims are common vertices.
/// @param tolerance largest distance of a vertex from a rim [m], > 0
/// @returns the number of divisions
/// @throws std::invalid_argument if the tolerance is not finite and > 0, a coordinate is not finite, or a corner is out
///         of range
template <std::floating_point T>
std::size_t divide_rims(TriangleMesh<T>& mesh, T tolerance) {
  require_positive(tolerance, "divide_rims", "tolerance");
  if (const auto fault = detail::find_bad_vertex(mesh))
    throw std::invalid_argument("divide_rims: " + fault->message);
  for (const auto& facet : mesh.facets)
    for (const std::uint32_t v : facet)
      require(v < mesh.vertices.size(), "divide_rims", "corner", v,
              "must be the index of a vertex");
  std::size_t sum = 0;
  // A triangle has three edges. Each round divides one of them.
  for (int round = 0; round < 3; ++round) {
    const auto found = detail::vertices_on_rims(mesh, tolerance);
    if (found.empty()) break;
    for (std::size_t first = 0, last; first < found.size(); first = last) {
      const auto facet = mesh.facets[found[first].facet];
      const std::uint32_t corner = found[first].corner, end = facet[(corner + 1) % 3],
                          opposite = facet[(corner + 2) % 3];
      std::uint32_t begin = facet[corner];
      bool is_first = true;
      for (last = first; last < found.size() && found[last].facet == found[first].facet; ++last) {
        if (found[last].corner != corner) continue;  // in the next round
        const typename FacetMesh<Space<3, T>>::Facet part{begin, found[last].vertex, opposite};
        if (is_first)
          mesh.facets[found[first].facet] = part;
        else
          mesh.facets.push_back(part);
        begin = found[last].vertex;
        is_first = false;
        ++sum;
      }
      mesh.facets.push_back({begin, end, opposite});
    }
  }
  return sum;
}

}  // namespace moreau
