// SPDX-License-Identifier: MIT
// The features of two polyhedra that belong to the last simplex of GJK: the vertices, edges or
// faces on which the nearest points lie, and the positions of these points.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "moreau/detect/polytope/axis.hpp"
#include "moreau/detect/polytope/polytope_pair.hpp"

namespace moreau::detail {

/// The index of the edge between two vertices of a shape, if there is such an edge.
template <std::floating_point T>
std::optional<std::uint32_t> edge_between(const Placed<Polyhedron<T>>& shape, std::uint32_t v,
                                          std::uint32_t w) {
  if (v == w) return std::nullopt;
  for (const std::uint32_t e : shape.shape().vertex_edges(v)) {
    const auto& ends = shape.shape().edges()[e].vertex;
    if (ends[0] == w || ends[1] == w) return e;
  }
  return std::nullopt;
}

/// The features on which the nearest points of a simplex lie, if one feature is a vertex and the
/// other feature is a vertex or an edge. Otherwise the kind is nearest_points, and the indices are
/// the vertices of the simplex's first point.
template <std::floating_point T>
PairCache<Space<3, T>> features_of(const PolytopePair<Polyhedron<T>>& pair,
                                   const Simplex<T>& simplex) {
  PairCache<Space<3, T>> found;
  found.kind = AxisKind::nearest_points;
  found.a = simplex[0].a;
  found.b = simplex[0].b;
  if (simplex.size() == 1) {
    found.kind = AxisKind::vertices;
  } else if (simplex.size() == 2) {
    const auto &p = simplex[0], &q = simplex[1];
    const auto edge_a = p.b == q.b ? edge_between(pair.a, p.a, q.a) : std::nullopt;
    const auto edge_b = p.a == q.a ? edge_between(pair.b, p.b, q.b) : std::nullopt;
    if (edge_a) {
      found.kind = AxisKind::edge_vertex;
      found.a = *edge_a;
    } else if (edge_b) {
      found.kind = AxisKind::vertex_edge;
      found.b = *edge_b;
    }
  }
  return found;
}

/// A guess of the features on which the nearest points of a simplex of three points lie: a face and
/// a vertex, or an edge of each shape. A face is guessed as the face whose normal points most
/// towards the other shape. prove_axis decides whether the guess is correct.
template <std::floating_point T>
PairCache<Space<3, T>> guess_features_of(const PolytopePair<Polyhedron<T>>& pair,
                                         const Simplex<T>& simplex) {
  PairCache<Space<3, T>> guess;
  const auto &p = simplex[0], &q = simplex[1], &r = simplex[2];
  if (p.b == q.b && p.b == r.b) {
    guess.kind = AxisKind::face_a;
    guess.a = pair.a.normals().farthest(simplex.direction()).index;
  } else if (p.a == q.a && p.a == r.a) {
    guess.kind = AxisKind::face_b;
    guess.b = pair.b.normals().farthest(-simplex.direction()).index;
  } else {
    const auto edge_a = edge_between(pair.a, p.a, p.a == q.a ? r.a : q.a);
    const auto edge_b = edge_between(pair.b, p.b, p.b == q.b ? r.b : q.b);
    if (!edge_a || !edge_b) return guess;
    guess.kind = AxisKind::edges;
    guess.a = *edge_a;
    guess.b = *edge_b;
  }
  return guess;
}

/// The nearest points of the two shapes according to the last simplex of GJK.
template <std::floating_point T>
WitnessPoints<Space<3, T>> witness_of(const PolytopePair<Polyhedron<T>>& pair,
                                      const Simplex<T>& simplex) {
  using Vector = typename Space<3, T>::Vector;
  const std::array<T, 3> weight = weights_of(simplex);
  WitnessPoints<Space<3, T>> witness{Vector::Zero(), Vector::Zero(), FeatureKey()};
  for (int i = 0; i < simplex.size(); ++i) {
    const T w = weight[static_cast<std::size_t>(i)];
    witness.on_a += w * pair.a.vertices()[simplex[i].a];
    const Vector corner = pair.b.vertices()[simplex[i].b] + pair.offset;
    witness.on_b += w * corner;
  }
  witness.feature = FeatureKey(FeatureKey::Kind::vertex_vertex, simplex[0].a, simplex[0].b);
  return witness;
}

}  // namespace moreau::detail
