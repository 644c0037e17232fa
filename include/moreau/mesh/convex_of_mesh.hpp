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
#include <cstdint>
#include <limits>
#include <span>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "moreau/core/box_tree.hpp"
#include "moreau/core/error.hpp"
#include "moreau/mesh/check_mesh.hpp"
#include "moreau/mesh/facet_mesh.hpp"
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

namespace detail {

/// The depth of points below the nearest face of a polytope. The faces are found by their dual points
/// p = normal / offset: depth = offset (1 - p . x), where the offset lies between the inradius and the
/// circumradius. A tree of the dual points leaves out the faces that face away.
template <class S>
class DepthBelowFaces {
 public:
  using T = typename S::Scalar;
  using Vector = typename S::Vector;

  explicit DepthBelowFaces(const PolytopeOf<S>& hull) : hull_(hull) {
    // A hull as thin as its rounding errors has no dual points.
    if (!(hull.inradius() > 64 * std::numeric_limits<T>::epsilon() * hull.circumradius())) return;
    std::vector<Aabb<S>> boxes;
    for (Eigen::Index f = 0; f < hull.face_offsets().size(); ++f) {
      const Vector dual = hull.face_normals().row(f).transpose() / hull.face_offsets()[f];
      boxes.emplace_back(dual, dual);
    }
    tree_ = BoxTree<S>(boxes);
  }
  /// @param x body coordinates of the polytope [m]
  T operator()(const Vector& x) {
    const T slack = 32 * std::numeric_limits<T>::epsilon() * hull_.circumradius();
    T least = depth(nearest_, x);
    if (tree_.order().empty())
      return (hull_.face_offsets() - (hull_.face_normals() * x).array()).minCoeff();
    const auto may_be_nearer = [&](const Aabb<S>& box) {
      T above = T(1);
      for (int k = 0; k < S::dim; ++k) above -= std::max(box.lower[k] * x[k], box.upper[k] * x[k]);
      return above * (above > T(0) ? hull_.inradius() : hull_.circumradius()) - slack < least;
    };
    tree_.query(may_be_nearer, [&](std::uint32_t place) {
      const auto face = static_cast<Eigen::Index>(tree_.order()[place]);
      const T here = depth(face, x);
      if (here < least) {
        least = here;
        nearest_ = face;
      }
    });
    return least;
  }

 private:
  T depth(Eigen::Index face, const Vector& x) const {
    return hull_.face_offsets()[face] - hull_.face_normals().row(face).dot(x);
  }

  const PolytopeOf<S>& hull_;
  BoxTree<S> tree_;
  Eigen::Index nearest_ = 0;  // of the last point: the first guess for the next
};

}  // namespace detail

/// The convex hull of the corners of a mesh's facets. The mesh may have any other fault: it may be open,
/// not a manifold, turned inside out, in several pieces, or have facets without an area. Corners that lie in one plane
/// within the digits of the file (FacetMesh::rounding) form one face: Polyhedron(points, rounding).
/// @throws std::invalid_argument if the mesh has no facet, if a facet has a corner that is not in the
///         list of vertices or is not finite, or if the corners lie in one plane (in the plane: on
///         one line)
template <class S>
PolytopeOf<S> hull_of_mesh(const FacetMesh<S>& mesh) {
  require(!mesh.facets.empty(), "hull_of_mesh", "facets", mesh.facets.size(), "must be at least 1");
  std::vector<typename S::Vector> points;
  std::vector<unsigned char> is_used(mesh.vertices.size(), 0);
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    for (const std::uint32_t v : mesh.facets[f]) {
      if (v >= is_used.size() || !all_finite(mesh.vertices[v]))
        throw std::invalid_argument("hull_of_mesh: " + detail::named(mesh, f) +
                                    " must have corners that exist and are finite");
      is_used[v] = 1;
    }
  for (std::size_t v = 0; v < is_used.size(); ++v)
    if (is_used[v] != 0) points.push_back(mesh.vertices[v]);
  return PolytopeOf<S>(std::span<const typename S::Vector>(points), mesh.rounding);
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
  detail::DepthBelowFaces<S> below(hull);
  const auto test = [&](const typename S::Vector& x, std::size_t facet) {
    const T depth = below(x - hull.centroid_of_input());
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
///                  allows for files that hold coordinates in single precision. Beside it, the digits of the file
///                  (FacetMesh::rounding) are allowed for
/// @throws std::invalid_argument if the mesh does not bound a solid (require_solid()), or if it is
///         concave: with the depth of its worst concavity and the facet that has it
template <class S>
PolytopeOf<S> convex_of_mesh(const FacetMesh<S>& mesh, typename S::Scalar tolerance = 5e-7) {
  require_solid(mesh, "convex_of_mesh");
  PolytopeOf<S> hull = hull_of_mesh(mesh);
  const Concavity<S> worst = worst_concavity(mesh, hull);
  const auto by_digits = typename S::Scalar(4 * HullTolerance{}.rounded) * mesh.rounding;
  if (worst.depth <= tolerance * size_of(mesh) + detail::rounding_of(mesh) + by_digits) return hull;
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
