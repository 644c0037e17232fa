// SPDX-License-Identifier: MIT
// Repairs of meshes; one more is in divide_rims.hpp. None of them is done unless its function is called, and each returns what it
// changed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/core/neighbour_cells.hpp"
#include "moreau/mesh/check_mesh.hpp"
#include "moreau/mesh/divide_rims.hpp"
#include "moreau/mesh/facet_mesh.hpp"

namespace moreau {

/// The changes that weld() made.
struct WeldReport {
  std::size_t merged_vertices = 0;  ///< vertices that were replaced by an earlier one
  std::size_t removed_facets = 0;   ///< facets of which two corners became one
};

namespace detail {

/// For each vertex, the first vertex within the tolerance that is not itself replaced.
template <class S>
std::vector<std::uint32_t> first_within(const std::vector<typename S::Vector>& vertices,
                                        typename S::Scalar tolerance) {
  using Cell = std::array<double, std::size_t(S::dim)>;
  std::map<Cell, std::vector<std::uint32_t>> cells;
  const double edge = tolerance > 0 ? double(tolerance) : 1;
  std::vector<std::uint32_t> first(vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    first[v] = std::uint32_t(v);
    // With no tolerance, a cell is a position. The sum turns -0 into 0.
    const auto cell_at = [&](int neighbour) {
      const auto steps = neighbour_cell<Eigen::Matrix<double, S::dim, 1>>(neighbour);
      Cell cell;
      for (std::size_t k = 0; k < cell.size(); ++k) {
        const double x = double(vertices[v][Eigen::Index(k)]);
        cell[k] = tolerance > 0 ? std::floor(x / edge) + steps[Eigen::Index(k)] : x + 0.0;
      }
      return cell;
    };
    constexpr int most = neighbour_cells<S::dim>(), middle = most / 2;
    const int around = tolerance > 0 ? most : 1;
    for (int neighbour = 0; neighbour < around; ++neighbour) {
      const auto found = cells.find(cell_at(neighbour));
      if (found == cells.end()) continue;
      for (const std::uint32_t w : found->second)
        if ((vertices[w] - vertices[v]).norm() <= tolerance) first[v] = std::min(first[v], w);
    }
    if (first[v] == v) cells[cell_at(middle)].push_back(std::uint32_t(v));
  }
  return first;
}

}  // namespace detail

/// Removes the vertices that belong to no facet. The others keep their order.
/// @returns their number
/// @throws std::invalid_argument if the corner of a facet is not the number of a vertex
template <class S>
std::size_t drop_unused_vertices(FacetMesh<S>& mesh) {
  std::vector<std::uint32_t> number(mesh.vertices.size(), 0);
  for (const auto& facet : mesh.facets)
    for (const std::uint32_t v : facet) {
      require(v < number.size(), "drop_unused_vertices", "corner", v,
              "must be the index of a vertex");
      number[v] = 1;
    }
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == 0) continue;
    mesh.vertices[kept] = mesh.vertices[v];
    number[v] = kept++;
  }
  for (auto& facet : mesh.facets)
    for (std::uint32_t& v : facet) v = number[v];
  const std::size_t dropped = mesh.vertices.size() - kept;
  mesh.vertices.resize(kept);
  return dropped;
}

/// Replaces each vertex by the first one that lies within the tolerance of it, and removes the
/// facets of which two corners become one. Vertices without facets are removed.
/// @param tolerance [m], >= 0: below the smallest detail that is to stay. With 0 only vertices at
///                  the same position are merged
/// @throws std::invalid_argument if a coordinate or the tolerance is not finite, if the tolerance is
///         negative, or if a corner is out of range
template <class S>
WeldReport weld(FacetMesh<S>& mesh, typename S::Scalar tolerance) {
  require(std::isfinite(tolerance) && tolerance >= 0, "weld", "tolerance", tolerance,
          "must be finite and >= 0");
  if (const auto fault = detail::find_bad_vertex(mesh))
    throw std::invalid_argument("weld: " + fault->message);
  for (const auto& facet : mesh.facets)
    for (const std::uint32_t v : facet)
      require(v < mesh.vertices.size(), "weld", "corner", v, "must be the index of a vertex");
  const auto first = detail::first_within<S>(mesh.vertices, tolerance);
  WeldReport report;
  for (std::size_t v = 0; v < first.size(); ++v) report.merged_vertices += first[v] != v;
  for (auto& facet : mesh.facets)
    for (std::uint32_t& v : facet) v = first[v];
  report.removed_facets = std::erase_if(mesh.facets, [](auto facet) {
    std::sort(facet.begin(), facet.end());
    return std::adjacent_find(facet.begin(), facet.end()) != facet.end();
  });
  drop_unused_vertices(mesh);
  return report;
}

/// Removes facets that have the same corners as an earlier facet, in any order.
/// @returns their number
template <class S>
std::size_t drop_repeated_facets(FacetMesh<S>& mesh) {
  std::map<typename FacetMesh<S>::Facet, bool> seen;
  return std::erase_if(mesh.facets, [&](auto facet) {
    std::sort(facet.begin(), facet.end());
    return !seen.try_emplace(facet, true).second;
  });
}

/// Removes triangles without an area: those with a corner twice, and those whose corners lie on a line,
/// which weld() leaves. The middle one of three corners on a line then divides the neighbour along the
/// line into two triangles, so that a closed surface stays closed.
/// @returns the number of triangles that were removed
/// @throws std::invalid_argument if a coordinate is not finite or a corner is out of range
template <std::floating_point T>
std::size_t drop_flat_triangles(TriangleMesh<T>& mesh);

namespace detail {

/// Divides the facets of a mesh among several meshes. Each gets its own vertices, in the order of the mesh.
/// @param number  of the new mesh of each facet
template <class S>
std::vector<FacetMesh<S>> divided(const FacetMesh<S>& mesh, std::span<const std::uint32_t> number,
                                  std::size_t count) {
  FacetMesh<S> empty;
  empty.rounding = mesh.rounding;
  std::vector<FacetMesh<S>> meshes(count, empty);
  std::vector<std::size_t> facets(count + 1, 0);  // facets of the meshes before each
  for (const std::uint32_t n : number) ++facets[n + 1];
  for (std::size_t n = 0; n < count; ++n) facets[n + 1] += facets[n];
  std::vector<std::uint32_t> in_order(number.size());
  std::vector<std::size_t> next(facets.begin(), facets.end() - 1);
  for (std::size_t f = 0; f < number.size(); ++f) in_order[next[number[f]]++] = std::uint32_t(f);
  std::vector<std::uint32_t> used, renamed(mesh.vertices.size());
  for (std::size_t n = 0; n < count; ++n) {
    used.clear();
    for (std::size_t k = facets[n]; k < facets[n + 1]; ++k)
      for (const std::uint32_t v : mesh.facets[in_order[k]]) used.push_back(v);
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (std::uint32_t k = 0; k < used.size(); ++k) {
      renamed[used[k]] = k;
      meshes[n].vertices.push_back(mesh.vertices[used[k]]);
    }
    for (std::size_t k = facets[n]; k < facets[n + 1]; ++k) {
      auto& facet = meshes[n].facets.emplace_back(mesh.facets[in_order[k]]);
      for (std::uint32_t& v : facet) v = renamed[v];
    }
  }
  return meshes;
}

}  // namespace detail

/// Divides a mesh into its connected pieces, in the order of their first facets.
/// @throws std::invalid_argument if a corner is out of range
template <class S>
std::vector<FacetMesh<S>> pieces_of(const FacetMesh<S>& mesh) {
  for (const auto& facet : mesh.facets)
    for (const std::uint32_t v : facet)
      require(v < mesh.vertices.size(), "pieces_of", "corner", v, "must be the index of a vertex");
  const auto piece = piece_of_each_facet(mesh);
  std::vector<std::uint32_t> number(mesh.facets.size());
  std::uint32_t count = 0;
  for (std::size_t f = 0; f < piece.size(); ++f)
    number[f] = piece[f] == f ? count++ : number[piece[f]];
  return detail::divided(mesh, number, count);
}

namespace detail {

/// The corner of a flat triangle that lies opposite of its longest edge.
template <std::floating_point T>
std::size_t middle_of_flat(const TriangleMesh<T>& mesh, std::size_t f) {
  const Eigen::Matrix<T, 3, 3> x = corners_of(mesh, f);
  std::size_t best = 0;
  T longest = -1;
  for (int k = 0; k < 3; ++k) {
    const T length = (x.col((k + 1) % 3) - x.col((k + 2) % 3)).norm();
    if (length <= longest) continue;
    longest = length;
    best = std::size_t(k);
  }
  return best;
}

/// Removes flat triangles that share no edge with one another.
/// @returns their number
template <std::floating_point T>
std::size_t drop_some_flat(TriangleMesh<T>& mesh, T flat) {
  using S = Space<3, T>;
  const auto ridges = ridges_of<S>(mesh.facets);
  std::vector<unsigned char> is_gone(mesh.facets.size(), 0), is_changed(mesh.facets.size(), 0);
  std::size_t count = 0;
  const std::size_t before = mesh.facets.size();
  for (std::size_t f = 0; f < before; ++f) {
    const auto facet = mesh.facets[f];
    const bool is_repeated = facet[0] == facet[1] || facet[1] == facet[2] || facet[2] == facet[0];
    if (is_changed[f] != 0) continue;
    if (!is_repeated && height_of<S>(corners_of(mesh, f)) > flat) continue;
    const std::size_t at = middle_of_flat(mesh, f);
    const std::uint32_t middle = facet[at], a = facet[(at + 1) % 3], b = facet[(at + 2) % 3];
    const std::array<std::uint32_t, 2> edge{std::min(a, b), std::max(a, b)};
    const auto first = std::lower_bound(
        ridges.begin(), ridges.end(), edge,
        [](const Ridge<S>& ridge, const auto& wanted) { return ridge.vertices < wanted; });
    auto last = first;
    bool is_free = true;
    for (; last != ridges.end() && last->vertices == edge; ++last)
      is_free = is_free && is_changed[last->facet] == 0;
    if (!is_free) continue;
    is_gone[f] = is_changed[f] = 1;
    ++count;
    if (is_repeated) continue;
    for (auto ridge = first; ridge != last; ++ridge) {
      if (ridge->facet == f) continue;
      is_changed[ridge->facet] = 1;
      auto& neighbour = mesh.facets[ridge->facet];
      auto half = neighbour;
      neighbour[(ridge->corner + 1) % 3] = middle;
      half[(ridge->corner + 2) % 3] = middle;
      mesh.facets.push_back(half);
    }
  }
  is_gone.resize(mesh.facets.size(), 0);
  std::size_t kept = 0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    if (is_gone[f] == 0) mesh.facets[kept++] = mesh.facets[f];
  mesh.facets.resize(kept);
  return count;
}

}  // namespace detail

template <std::floating_point T>
std::size_t drop_flat_triangles(TriangleMesh<T>& mesh) {
  if (const auto fault = detail::find_bad_vertex(mesh))
    throw std::invalid_argument("drop_flat_triangles: " + fault->message);
  for (const auto& facet : mesh.facets)
    for (const std::uint32_t v : facet)
      require(v < mesh.vertices.size(), "drop_flat_triangles", "corner", v,
              "must be the index of a vertex");
  // A division can leave a flat triangle, which is divided in its turn. Each shortens an edge, so few
  // rounds are needed.
  constexpr int most_rounds = 64;
  std::size_t sum = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const std::size_t count = detail::drop_some_flat(mesh, detail::rounding_of(mesh));
    sum += count;
    if (count == 0) break;
  }
  return sum;
}

/// Turns facets so that neighbours have their outsides on the same side, and each piece that is
/// closed has a positive volume. A piece that is open keeps the side of its first facet.
/// @returns the number of facets that were turned
/// @throws std::invalid_argument if a corner is out of range or a coordinate is not finite, if a
///         ridge has more than two facets, or if a piece has one side only, like a Moebius strip
template <class S>
std::size_t orient(FacetMesh<S>& mesh);

namespace detail {

/// Whether each facet has to be turned to agree with the first facet of its piece.
template <class S>
std::vector<unsigned char> turns_of(const FacetMesh<S>& mesh, const std::vector<Ridge<S>>& ridges) {
  struct Neighbour {
    std::uint32_t facet;
    bool disagrees;
  };
  std::vector<std::vector<Neighbour>> neighbours(mesh.facets.size());
  for_each_ridge(ridges, [&](std::span<const Ridge<S>> at) {
    if (at.size() > 2)
      throw std::invalid_argument("orient: " + find_bad_ridge(mesh, ridges)->message);
    if (at.size() < 2) return;
    const bool disagrees = at[0].is_forward == at[1].is_forward;
    neighbours[at[0].facet].push_back({at[1].facet, disagrees});
    neighbours[at[1].facet].push_back({at[0].facet, disagrees});
  });
  constexpr unsigned char unknown = 2;
  std::vector<unsigned char> turn(mesh.facets.size(), unknown);
  std::vector<std::size_t> open;
  for (std::size_t f = 0; f < turn.size(); ++f) {
    if (turn[f] != unknown) continue;
    turn[f] = 0;
    for (open.assign(1, f); !open.empty();) {
      const std::size_t at = open.back();
      open.pop_back();
      for (const auto& [next, disagrees] : neighbours[at]) {
        const auto wanted = static_cast<unsigned char>(turn[at] != (disagrees ? 1 : 0));
        if (turn[next] == unknown) {
          turn[next] = wanted;
          open.push_back(next);
        } else if (turn[next] != wanted) {
          throw std::invalid_argument("orient: " + named(mesh, next) +
                                      " must have two sides: the surface can not be oriented");
        }
      }
    }
  }
  return turn;
}

}  // namespace detail

template <class S>
std::size_t orient(FacetMesh<S>& mesh) {
  if (const auto fault = find_surface_fault(mesh))
    throw std::invalid_argument("orient: " + fault->message);
  const auto ridges = ridges_of<S>(mesh.facets);
  std::vector<unsigned char> turn = detail::turns_of(mesh, ridges);
  const auto turn_around = [](typename FacetMesh<S>::Facet& facet) {
    std::swap(facet[0], facet[1]);
  };
  FacetMesh<S> turned = mesh;
  for (std::size_t f = 0; f < turn.size(); ++f)
    if (turn[f] != 0) turn_around(turned.facets[f]);
  // The volume of each piece, about a point that the pieces share, and whether the piece is closed.
  const auto piece = piece_of_each_facet(mesh);
  std::vector<Moments<S>> moments(piece.size());
  std::vector<unsigned char> is_open(piece.size(), 0);
  for (std::size_t f = 0; f < piece.size(); ++f)
    moments[piece[f]].add_simplex(corners_of(turned, f).colwise() -
                                  mesh.vertices[mesh.facets[piece[f]][0]]);
  for_each_ridge(ridges, [&](std::span<const Ridge<S>> at) {
    if (at.size() == 1) is_open[piece[at[0].facet]] = 1;
  });
  std::size_t count = 0;
  for (std::size_t f = 0; f < piece.size(); ++f) {
    const bool is_inside_out = is_open[piece[f]] == 0 && moments[piece[f]].volume < 0;
    if (is_inside_out == (turn[f] != 0)) continue;
    turn_around(mesh.facets[f]);
    ++count;
  }
  return count;
}

}  // namespace moreau
