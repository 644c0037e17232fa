// SPDX-License-Identifier: MIT
// Incidence of the vertices, edges and faces of a polyhedron.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/shape/detail/index_table.hpp"
#include "moreau/simd/prefetch.hpp"

namespace moreau {

/// Lists of indices, of different lengths, stored one after the other in one array.
class IndexLists {
 public:
  std::size_t size() const { return begins_.size() - 1; }  ///< number of lists
  std::size_t total() const { return items_.size(); }  ///< number of indices in all lists together
  /// List i, for i < size().
  std::span<const std::uint32_t> operator[](std::size_t i) const {
    MOREAU_ASSERT(i < size());
    return {items_.data() + begins_[i], begins_[i + 1] - begins_[i]};
  }
  /// Begins to load the lists into the cache.
  void prefetch() const {
    detail::prefetch(begins_);
    detail::prefetch(items_);
  }
  /// Appends a list.
  void push_back(std::span<const std::uint32_t> list) {
    items_.append(list.data(), list.size());
    begins_.push_back(static_cast<std::uint32_t>(items_.size()));
  }
  /// An item of a list.
  struct Entry {
    std::uint32_t list;  ///< number of the list
    std::uint32_t item;  ///< what it gets
  };
  /// Replaces all lists. Each gets its items in the order of the entries.
  MOREAU_COMPILED_ONCE void assign(std::size_t lists, std::span<const Entry> entries) {
    begins_.assign(lists + 1, 0);
    for (const Entry& entry : entries) ++begins_[entry.list + 1];
    for (std::size_t i = 0; i < lists; ++i) begins_[i + 1] += begins_[i];
    List<std::uint32_t> next(begins_);
    items_.resize(entries.size());
    for (const Entry& entry : entries) items_[next[entry.list]++] = entry.item;
  }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(begins_, items_); }
  void deserialized() const {
    require(!begins_.empty() && begins_.front() == 0 && begins_.back() == items_.size() &&
                std::is_sorted(begins_.begin(), begins_.end()),
            "IndexLists", "begins", begins_.size(),
            "entries, which must rise from 0 to the number of items");
  }

  List<std::uint32_t> begins_{0}, items_;
};

/// An edge and the two faces that share it. Going around face[0] counter-clockwise, the edge leads
/// from vertex[0] to vertex[1]; going around face[1], from vertex[1] to vertex[0].
struct PolyhedronEdge {
  std::array<std::uint32_t, 2> vertex;  ///< the two ends
  std::array<std::uint32_t, 2> face;    ///< the two adjacent faces
};

/// The incidences of the vertices, edges and faces of a closed surface, derived from the vertices
/// of its faces. All lists contain indices. List i belongs to the face or vertex with the index i.
struct FaceTopology {
  IndexLists faces;         ///< vertices of each face, counter-clockwise from outside
  IndexLists face_edges;    ///< edges of each face: edge k joins vertices k and k + 1 of the face
  IndexLists vertex_faces;  ///< faces at each vertex, in ascending order
  IndexLists vertex_edges;  ///< edges at each vertex, in ascending order
  List<PolyhedronEdge> edges;  ///< the edges, each listed once

  /// Begins to load the lists into the cache that the narrow phase reads of most pairs: all but vertex_edges.
  void prefetch() const {
    faces.prefetch();
    face_edges.prefetch();
    vertex_faces.prefetch();
    detail::prefetch(edges);
  }

  /// An empty topology, to be overwritten by deserialization.
  FaceTopology() = default;
  /// Only the faces are stored; all other members follow from them. See core/serialize.hpp.
  auto serialized_members() { return std::tie(faces); }

  /// @param vertex_count number of vertices; each vertex must belong to at least three faces
  /// @param face_list    vertices of each face, counter-clockwise seen from outside
  /// @param function     name of the calling function, for error messages
  /// @throws std::invalid_argument for an index out of range, a face with fewer than three vertices
  ///                               or with a repeated vertex, an edge that does not occur once in
  ///                               each direction, a vertex in fewer than three faces, or a surface
  ///                               that is not one piece without handles (V - E + F is not 2)
  FaceTopology(std::size_t vertex_count, std::span<const std::vector<std::uint32_t>> face_list,
               std::string_view function) {
    List<std::size_t> last_face(vertex_count, 0);  // one past the last face with the vertex
    for (std::size_t f = 0; f < face_list.size(); ++f) {
      if (face_list[f].size() < 3)
        throw_element(function, "faces[", f, "].size()", face_list[f].size(), "must be at least 3");
      for (const std::uint32_t v : face_list[f]) {
        if (v >= vertex_count)
          throw_element(function, "a vertex of faces[", f, "]", v,
                        "must be below the number of vertices, ", vertex_count);
        if (last_face[v] == f + 1)
          throw_element(function, "a vertex of faces[", f, "]", v, "must not occur twice");
        last_face[v] = f + 1;
      }
      faces.push_back(face_list[f]);
    }
    pair_edges(function);
    collect(vertex_count, function);
    const auto euler = static_cast<std::ptrdiff_t>(vertex_count + faces.size()) -
                       static_cast<std::ptrdiff_t>(edges.size());
    require(euler == 2, function, "V - E + F", euler, "must be 2: one closed surface, no holes");
  }

 private:
  // Texts of errors: append() is used because g++ 12 warns about "literal" + std::string.

  /// Throws that element k of a list has a bad value.
  /// @param before, after the text on both sides of k
  /// @param limit         a number behind the expectation; npos: none
  [[noreturn]] MOREAU_COLD static void throw_element(std::string_view function,
                                                     std::string_view before, std::size_t k,
                                                     std::string_view after, std::size_t value,
                                                     std::string_view expectation,
                                                     std::size_t limit = std::string::npos) {
    std::string element(before), most(expectation);
    element.append(std::to_string(k)).append(after);
    if (limit != std::string::npos) most.append(std::to_string(limit));
    throw_invalid(function, element, value, most);
  }
  [[noreturn]] MOREAU_COLD static void throw_edge(std::string_view function, std::uint32_t a,
                                                  std::uint32_t b, std::string_view expectation) {
    std::string edge(1, '(');
    edge.append(std::to_string(a)).append(", ").append(std::to_string(b)).append(1, ')');
    throw_invalid(function, "edge", edge, expectation);
  }

  void pair_edges(std::string_view function) {
    detail::IndexTable open;  // edges whose reverse has not been found
    const auto key = [](std::uint32_t from, std::uint32_t to) {
      return std::uint64_t(from) << 32 | to;
    };
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      const auto face = faces[f];
      std::vector<std::uint32_t> of_face(face.size());
      for (std::size_t k = 0; k < face.size(); ++k) {
        const std::uint32_t a = face[k], b = face[(k + 1) % face.size()];
        if (const std::uint32_t reverse = open.find(key(b, a));
            reverse != detail::IndexTable::none) {
          of_face[k] = reverse;
          edges[reverse].face[1] = f;
          open[key(b, a)] = detail::IndexTable::none;
          continue;
        }
        of_face[k] = static_cast<std::uint32_t>(edges.size());
        std::uint32_t& edge = open[key(a, b)];
        if (edge != detail::IndexTable::none)
          throw_edge(function, a, b, "must not run the same way in two faces");
        edge = of_face[k];
        edges.push_back({{a, b}, {f, f}});
      }
      face_edges.push_back(of_face);
    }
    const std::uint64_t first = open.smallest_key();
    if (first == ~std::uint64_t(0)) return;
    throw_edge(function, std::uint32_t(first >> 32), std::uint32_t(first),
               "must run back in another face: the surface is not closed");
  }

  void collect(std::size_t vertex_count, std::string_view function) {
    List<IndexLists::Entry> entries;
    for (std::uint32_t f = 0; f < faces.size(); ++f)
      for (const std::uint32_t v : faces[f]) entries.push_back({v, f});
    vertex_faces.assign(vertex_count, entries);
    entries.clear();
    for (std::uint32_t e = 0; e < edges.size(); ++e)
      for (const std::uint32_t v : edges[e].vertex) entries.push_back({v, e});
    vertex_edges.assign(vertex_count, entries);
    for (std::size_t v = 0; v < vertex_count; ++v)
      if (vertex_faces[v].size() < 3)
        throw_element(function, "number of faces at vertices[", v, "]", vertex_faces[v].size(),
                      "must be at least 3");
  }
};

}  // namespace moreau
