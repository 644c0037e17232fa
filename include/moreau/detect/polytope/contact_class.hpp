// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/detect/manifold.hpp"

namespace moreau::detail {

/// The class of a contact of one point.
constexpr ContactClass class_of_point(FeatureKey feature) {
  switch (feature.kind()) {
    case FeatureKey::Kind::vertex_vertex:
      return ContactClass::vertex_vertex;
    case FeatureKey::Kind::vertex_edge:
    case FeatureKey::Kind::edge_vertex:
      return ContactClass::vertex_edge;
    case FeatureKey::Kind::edge_edge:
      return ContactClass::edge_edge;
    default:
      return ContactClass::vertex_face;
  }
}

/// How a vertex of a on a face of b is keyed: in the plane, faces are edges.
template <std::floating_point T>
constexpr FeatureKey::Kind vertex_on_face(Space<2, T>) {
  return FeatureKey::Kind::vertex_edge;
}
template <std::floating_point T>
constexpr FeatureKey::Kind vertex_on_face(Space<3, T>) {
  return FeatureKey::Kind::vertex_face;
}

}  // namespace moreau::detail
