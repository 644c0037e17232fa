// SPDX-License-Identifier: MIT
// Tests of meshes before they become grains or walls. Each fault names the facet (triangle, in the
// plane segment) where it was found, counted from 0 in the order of the file.
//
// A surface has facets that exist and have an area. A wall is a surface whose facets join where they
// meet, with their outsides on one side. A grain must be a solid: a surface that is closed, in one
// piece, with its outside outside.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "moreau/core/aabb.hpp"
#include "moreau/core/box_tree.hpp"
#include "moreau/core/disjoint_sets.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/mesh/facet_mesh.hpp"

namespace moreau {

/// The defects of a mesh, roughly in the order in which they are tested: of defects of single facets the first facet
/// decides.
enum class MeshDefect : std::uint8_t {
  empty,           ///< no facet; for a solid fewer than D + 1
  not_finite,      ///< a coordinate is infinite or not a number
  out_of_range,    ///< a facet has a corner that is not in the list of vertices
  degenerate,      ///< a facet has the same corner twice, or no area
  non_manifold,    ///< more than two facets at a ridge, or two surfaces that touch at a vertex
  open,            ///< a ridge with one facet: the surface has a rim
  unoriented,      ///< two neighbours whose outsides are on different sides
  several_pieces,  ///< surfaces that are not connected: several solids, or a cavity
  inside_out,      ///< the outsides of all facets are inside
  unwelded,        ///< of a wall: two rims at the same place, with vertices of their own
};

/// The name of a defect, as its enumerator is written.
constexpr const char* name(MeshDefect defect) {
  constexpr const char* names[] = {"empty",        "not_finite", "out_of_range", "degenerate",
                                   "non_manifold", "open",       "unoriented",   "several_pieces",
                                   "inside_out",   "unwelded"};
  return names[static_cast<int>(defect)];
}

/// The first fault of a mesh.
struct MeshFault {
  MeshDefect defect;  ///< what is wrong
  std::size_t facet =
      0;  ///< where it was found; the number of facets for a vertex of no facet, 0 for an empty mesh
  std::string message;  ///< names the facet, with its corners, and the requirement
};

namespace detail {

/// The words of a dimension.
template <class S>
struct FacetWords {
  static constexpr bool in_space = S::dim == 3;
  static constexpr const char* facet = in_space ? "triangle" : "segment";
  static constexpr const char* area = in_space ? "area" : "length";
  static constexpr const char* ridge = in_space ? "edge" : "end";
};

template <class Indices>
std::string list_of(const Indices& indices) {
  std::string list;
  for (const std::uint32_t i : indices) list += (list.empty() ? "(" : ", ") + std::to_string(i);
  return list + ")";
}

template <class S>
std::string named(const FacetMesh<S>& mesh, std::size_t facet) {
  return std::string(FacetWords<S>::facet) + " " + std::to_string(facet) + " = " +
         list_of(mesh.facets[facet]);
}

template <class S>
MeshFault fault_of(const FacetMesh<S>& mesh, MeshDefect defect, std::size_t facet,
                   const std::string& expectation) {
  return {defect, facet, named(mesh, facet) + " must " + expectation};
}

/// The height of a facet: of a triangle above its longest edge, of a segment its length [m].
template <class S>
typename S::Scalar height_of(const typename S::Matrix& corners) {
  const auto area = area_vector(corners).norm();
  typename S::Scalar longest = 0;
  for (int k = 0; k < S::dim; ++k)
    longest = std::max(longest, (corners.col(k) - corners.col((k + 1) % S::dim)).norm());
  if (!(longest > 0)) return 0;
  return FacetWords<S>::in_space ? area / longest : area;
}

template <class S>
std::optional<MeshFault> find_bad_vertex(const FacetMesh<S>& mesh) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (all_finite(mesh.vertices[v])) continue;
    std::size_t facet = 0;
    while (facet < mesh.facets.size() &&
           std::count(mesh.facets[facet].begin(), mesh.facets[facet].end(), v) == 0)
      ++facet;
    std::ostringstream message;
    message << "vertex " << v << " = ";
    detail::print(message, mesh.vertices[v]);
    if (facet < mesh.facets.size()) message << " of " << FacetWords<S>::facet << ' ' << facet;
    message << " must be finite";
    return MeshFault{MeshDefect::not_finite, facet, message.str()};
  }
  return std::nullopt;
}

template <class S>
std::optional<MeshFault> find_bad_facet(const FacetMesh<S>& mesh) {
  using T = typename S::Scalar;
  const T flat = rounding_of(mesh);
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    for (const std::uint32_t v : mesh.facets[f])
      if (v >= mesh.vertices.size())
        return fault_of(mesh, MeshDefect::out_of_range, f,
                        "have corners below " + std::to_string(mesh.vertices.size()) +
                            ", the number of vertices");
    auto sorted = mesh.facets[f];
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      return fault_of(mesh, MeshDefect::degenerate, f, "have different corners");
    if (!(height_of<S>(corners_of(mesh, f)) > flat))
      return fault_of(mesh, MeshDefect::degenerate, f,
                      "have an " + std::string(FacetWords<S>::area) + " that is not 0");
  }
  return std::nullopt;
}

/// Whether two facets have the same corners.
template <class Facet>
bool is_repeated(Facet a, Facet b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

/// The first ridge that does not join two facets, as an oriented surface demands.
/// @param may_have_rims whether ridges of one facet are allowed
template <class S>
std::optional<MeshFault> find_bad_ridge(const FacetMesh<S>& mesh,
                                        const std::vector<Ridge<S>>& ridges,
                                        bool may_have_rims = false) {
  std::optional<MeshFault> open, crowded, turned;
  const auto keep = [&](std::optional<MeshFault>& fault, MeshDefect defect, std::size_t facet,
                        const std::string& expectation) {
    if (!fault || facet < fault->facet) fault = fault_of(mesh, defect, facet, expectation);
  };
  for_each_ridge(ridges, [&](std::span<const Ridge<S>> at) {
    const std::string where = std::string(FacetWords<S>::ridge) + " " + list_of(at[0].vertices);
    const auto facet = [&](std::size_t k) {
      return std::string(FacetWords<S>::facet) + " " + std::to_string(at[k].facet);
    };
    for (std::size_t k = 1; k < at.size(); ++k)
      if (is_repeated(mesh.facets[at[k - 1].facet], mesh.facets[at[k].facet]))
        keep(crowded, MeshDefect::non_manifold, at[k].facet,
             "not have the corners of " + facet(k - 1));
    if (at.size() > 2)
      keep(crowded, MeshDefect::non_manifold, at[2].facet,
           "not share the " + where + " with " + facet(0) + " and " + facet(1) +
               ": the surface is not a manifold");
    else if (at.size() == 1 && may_have_rims)
      return;
    else if (at.size() == 1)
      keep(open, MeshDefect::open, at[0].facet,
           "have a neighbour at its " + where + ": the surface is open");
    else if (at[0].is_forward == at[1].is_forward)
      keep(turned, MeshDefect::unoriented, at[1].facet,
           "have its outside on the side of its neighbour, " + facet(0) + ", at the " + where);
  });
  return crowded ? crowded : open ? open : turned;
}

/// Whether two ends of segments are at the same place.
template <class T>
bool lie_along(const std::array<Eigen::Matrix<T, 2, 1>, 1>& a,
               const std::array<Eigen::Matrix<T, 2, 1>, 1>& b, T near) {
  return (a[0] - b[0]).norm() <= near;
}
/// Whether an edge lies near another over some of its length.
template <class T>
bool lie_along(const std::array<Eigen::Matrix<T, 3, 1>, 2>& a,
               const std::array<Eigen::Matrix<T, 3, 1>, 2>& b, T near) {
  const Eigen::Matrix<T, 3, 1> edge = a[1] - a[0], other = b[1] - b[0];
  const T length = edge.norm();
  const T first = (b[0] - a[0]).dot(edge) / length, last = (b[1] - a[0]).dot(edge) / length;
  const T begin = std::max(std::min(first, last), T(0)),
          end = std::min(std::max(first, last), length);
  if (!(end - begin > 4 * near)) return false;
  const auto is_near = [&](T along) {
    const Eigen::Matrix<T, 3, 1> on_b = b[0] + (along - first) / (last - first) * other;
    return (on_b - a[0] - along / length * edge).norm() <= near;
  };
  return is_near(begin) && is_near(end);
}

/// The first rim that lies along another.
template <class S>
std::optional<MeshFault> find_unwelded_rim(const FacetMesh<S>& mesh,
                                           const std::vector<Ridge<S>>& ridges) {
  using T = typename S::Scalar;
  using Ends = std::array<typename S::Vector, std::size_t(S::dim - 1)>;
  const T near = T(1e-6) * size_of(mesh) + rounding_of(mesh);
  std::vector<Ridge<S>> rims;
  for_each_ridge(ridges, [&](std::span<const Ridge<S>> at) {
    if (at.size() == 1) rims.push_back(at[0]);
  });
  std::vector<Ends> ends(rims.size());
  std::vector<Aabb<S>> boxes(rims.size());
  for (std::size_t r = 0; r < rims.size(); ++r)
    for (std::size_t k = 0; k < ends[r].size(); ++k) {
      ends[r][k] = mesh.vertices[rims[r].vertices[k]];
      boxes[r].merge(ends[r][k]);
    }
  const BoxTree<S> tree(boxes);
  std::optional<MeshFault> first;
  for (std::size_t r = 0; r < rims.size(); ++r) {
    const Aabb<S> around = boxes[r].inflated(near);
    tree.query([&](const Aabb<S>& box) { return box.overlaps(around); },
               [&](std::uint32_t place) {
                 const std::size_t s = tree.order()[place];
                 const std::uint32_t facet = rims[r].facet, other = rims[s].facet;
                 if (s == r || facet < other || (first && first->facet <= facet)) return;
                 if (!lie_along(ends[r], ends[s], near) && !lie_along(ends[s], ends[r], near))
                   return;
                 first = fault_of(
                     mesh, MeshDefect::unwelded, facet,
                     "have vertices in common with " + std::string(FacetWords<S>::facet) + " " +
                         std::to_string(other) + ", along whose rim its " + FacetWords<S>::ridge +
                         " " + list_of(rims[r].vertices) + " lies: call weld()" +
                         (S::dim > 2 ? ", then divide_rims()" : ""));
               });
  }
  return first;
}

/// The first vertex at which two surfaces touch. Each ridge has two facets.
template <class S>
std::optional<MeshFault> find_pinched_vertex(const FacetMesh<S>& mesh,
                                             const std::vector<Ridge<S>>& ridges) {
  constexpr std::size_t n = std::size_t(S::dim);
  DisjointSets fans(mesh.facets.size() * n);  // of corners at the same vertex
  const auto corner = [&](std::uint32_t facet, std::uint32_t vertex) {
    const auto& v = mesh.facets[facet];
    return facet * n + std::size_t(std::find(v.begin(), v.end(), vertex) - v.begin());
  };
  for_each_ridge(ridges, [&](std::span<const Ridge<S>> at) {
    for (const std::uint32_t v : at[0].vertices)
      fans.unite(corner(at[0].facet, v), corner(at[1].facet, v));
  });
  constexpr std::uint32_t none = ~0U;
  std::vector<std::uint32_t> fan_at(mesh.vertices.size(), none);
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    for (std::size_t k = 0; k < n; ++k) {
      const std::uint32_t v = mesh.facets[f][k], fan = fans.find(f * n + k);
      if (fan_at[v] == none) fan_at[v] = fan;
      if (fan_at[v] != fan)
        return fault_of(mesh, MeshDefect::non_manifold, f,
                        "not touch " + std::string(FacetWords<S>::facet) + " " +
                            std::to_string(fan_at[v] / n) + " only at the vertex " +
                            std::to_string(v) + ": the surface is not a manifold");
    }
  return std::nullopt;
}

}  // namespace detail

/// For each facet, the smallest index of the facets that are connected to it over ridges.
template <class S>
std::vector<std::uint32_t> piece_of_each_facet(const FacetMesh<S>& mesh) {
  detail::DisjointSets pieces(mesh.facets.size());
  for_each_ridge(ridges_of<S>(mesh.facets), [&](std::span<const Ridge<S>> at) {
    for (const Ridge<S>& ridge : at) pieces.unite(at[0].facet, ridge.facet);
  });
  std::vector<std::uint32_t> piece(mesh.facets.size());
  for (std::size_t f = 0; f < piece.size(); ++f) piece[f] = pieces.find(f);
  return piece;
}

/// The first fault of a mesh that is to be a surface: empty, not finite, out of range or degenerate.
template <class S>
std::optional<MeshFault> find_surface_fault(const FacetMesh<S>& mesh) {
  if (mesh.facets.empty())
    return MeshFault{MeshDefect::empty, 0,
                     std::string(detail::FacetWords<S>::facet) + "s = 0 must be at least 1"};
  if (auto fault = detail::find_bad_vertex(mesh)) return fault;
  return detail::find_bad_facet(mesh);
}

/// The first fault of a mesh that is to bound a solid, such as a grain. Surfaces that cross each
/// other are not found.
template <class S>
std::optional<MeshFault> find_solid_fault(const FacetMesh<S>& mesh) {
  if (auto fault = find_surface_fault(mesh)) return fault;
  if (mesh.facets.size() <= std::size_t(S::dim))
    return MeshFault{MeshDefect::empty, 0,
                     std::string(detail::FacetWords<S>::facet) +
                         "s = " + std::to_string(mesh.facets.size()) + " must be at least " +
                         std::to_string(S::dim + 1) + " to bound a solid"};
  const auto ridges = ridges_of<S>(mesh.facets);
  if (auto fault = detail::find_bad_ridge(mesh, ridges)) return fault;
  if (auto fault = detail::find_pinched_vertex(mesh, ridges)) return fault;
  const auto piece = piece_of_each_facet(mesh);
  for (std::size_t f = 0; f < piece.size(); ++f)
    if (piece[f] != 0)
      return detail::fault_of(mesh, MeshDefect::several_pieces, f,
                              "be connected to " + std::string(detail::FacetWords<S>::facet) +
                                  " 0: the mesh has several pieces");
  const auto volume = volume_of(mesh);
  if (volume > 0) return std::nullopt;
  std::ostringstream message;
  message << "volume = " << volume << " m^" << S::dim
          << " must be positive: " << detail::named(mesh, 0) << " and all others are inside out";
  return MeshFault{MeshDefect::inside_out, 0, message.str()};
}

/// The first fault of a mesh that is to be a wall: that of a surface, more than two facets at a ridge,
/// a facet that is there twice, neighbours with their outsides on different sides, or rims that lie
/// within 1e-6 of the size of the mesh along each other. A grain would touch such rims as the ends of
/// the wall: weld() joins them.
template <class S>
std::optional<MeshFault> find_wall_fault(const FacetMesh<S>& mesh) {
  if (auto fault = find_surface_fault(mesh)) return fault;
  const auto ridges = ridges_of<S>(mesh.facets);
  if (auto fault = detail::find_bad_ridge(mesh, ridges, true)) return fault;
  return detail::find_unwelded_rim(mesh, ridges);
}

/// Requires that a mesh is a surface (find_surface_fault).
/// @param function name of the calling function, for the message
/// @throws std::invalid_argument that names the function and the facet
template <class S>
void require_surface(const FacetMesh<S>& mesh, std::string_view function) {
  if (const auto fault = find_surface_fault(mesh))
    throw std::invalid_argument(std::string(function) + ": " + fault->message);
}
/// Requires that a mesh can be a wall (find_wall_fault).
/// @param function name of the calling function, for the message
/// @throws std::invalid_argument that names the function and the facet
template <class S>
void require_wall(const FacetMesh<S>& mesh, std::string_view function) {
  if (const auto fault = find_wall_fault(mesh))
    throw std::invalid_argument(std::string(function) + ": " + fault->message);
}
/// Requires that a mesh bounds a solid (find_solid_fault).
/// @param function name of the calling function, for the message
/// @throws std::invalid_argument that names the function and the facet
template <class S>
void require_solid(const FacetMesh<S>& mesh, std::string_view function) {
  if (const auto fault = find_solid_fault(mesh))
    throw std::invalid_argument(std::string(function) + ": " + fault->message);
}

}  // namespace moreau
