// SPDX-License-Identifier: MIT
// A convex grain from a mesh: exactly, if the mesh is convex, or as its convex hull, if the hull is
// asked for by name.
//
//   moreau::TriangleMesh<> mesh = moreau::read_mesh("stone.stl", 1e-3);   // in millimetres
//   moreau::Polyhedron<> stone = moreau::convex_of_mesh(mesh);            // throws if it is concave
//   moreau::Polyhedron<> hull = moreau::hull_of_mesh(mesh);
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <sstream>
#include <stdexcept>

#include "moreau/core/error.hpp"
#include "moreau/shape/check_mesh.hpp"
#include "moreau/shape/facet_mesh.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace moreau {

namespace detail {

template <class S>
struct PolytopeIn;
template <class T>
struct PolytopeIn<Space<2, T>> {
  using type = Polygon<T>;
};
template <class T>
struct PolytopeIn<Space<3, T>> {
  using type = Polyhedron<T>;
};

}  // namespace detail

/// Polyhedron in space, Polygon in the plane.
template <class S>
using PolytopeOf = typename detail::PolytopeIn<S>::type;

/// The deepest place of a surface below its convex hull.
template <class S>
struct Concavity {
  typename S::Scalar depth = 0;  ///< below the nearest face of the hull [m], >= 0 up to rounding
  typename S::Vector position = S::Vector::Zero();  ///< in the frame of the mesh [m]
  std::size_t facet = 0;                            ///< a facet that has the position
};

/// The convex hull of the vertices of a mesh. The mesh need not be closed.
/// @throws std::invalid_argument if the mesh is not a surface (require_surface()) or is flat
template <class S>
PolytopeOf<S> hull_of_mesh(const FacetMesh<S>& mesh) {
  require_surface(mesh, "hull_of_mesh");
  std::vector<typename S::Vector> points;
  std::vector<unsigned char> is_used(mesh.vertices.size(), 0);
  for (const auto& facet : mesh.facets)
    for (const std::uint32_t v : facet) is_used[v] = 1;
  for (std::size_t v = 0; v < is_used.size(); ++v)
    if (is_used[v] != 0) points.push_back(mesh.vertices[v]);
  return PolytopeOf<S>(std::span<const typename S::Vector>(points));
}

/// The worst concavity of a mesh, measured at its vertices and at the centres of its facets: the
/// largest depth below a hull. It is 0 if and only if all facets lie on the surface of the hull. The
/// depth is that at the deepest of these points; a concavity that is deepest within a facet may be
/// deeper.
/// @param hull of the mesh, in its own frame (hull_of_mesh())
template <class S>
Concavity<S> worst_concavity(const FacetMesh<S>& mesh, const PolytopeOf<S>& hull) {
  using T = typename S::Scalar;
  Concavity<S> worst;
  worst.depth = -std::numeric_limits<T>::infinity();
  const auto test = [&](const typename S::Vector& x, std::size_t facet) {
    const typename S::Vector y = x - hull.centroid_of_input();
    const T depth = (hull.face_offsets() - (hull.face_normals() * y).array()).minCoeff();
    if (depth > worst.depth) worst = {depth, x, facet};
  };
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const typename S::Matrix corners = corners_of(mesh, f);
    for (int k = 0; k < S::dim; ++k) test(corners.col(k), f);
    test(corners.rowwise().mean(), f);
  }
  return worst;
}

/// A grain from a closed convex mesh. Coplanar triangles form one face.
/// @param tolerance a concavity up to this fraction of size_of(mesh) counts as flat [-]. The default
///                  allows for files that hold coordinates in single precision
/// @throws std::invalid_argument if the mesh does not bound a solid (require_solid()), or if it is
///         concave: with the depth of its worst concavity and the facet that has it
template <class S>
PolytopeOf<S> convex_of_mesh(const FacetMesh<S>& mesh, typename S::Scalar tolerance = 5e-7) {
  require_solid(mesh, "convex_of_mesh");
  PolytopeOf<S> hull = hull_of_mesh(mesh);
  const Concavity<S> worst = worst_concavity(mesh, hull);
  if (worst.depth <= tolerance * size_of(mesh) + detail::rounding_of(mesh)) return hull;
  std::ostringstream message;
  message.precision(4);
  message << "convex_of_mesh: concavity = " << worst.depth << " m at ";
  detail::print(message, worst.position);
  message
      << ", " << detail::named(mesh, worst.facet)
      << ", must be 0: for the convex hull call hull_of_mesh(), to keep the concavity divide the "
         "mesh into convex parts";
  throw std::invalid_argument(message.str());
}

}  // namespace moreau
