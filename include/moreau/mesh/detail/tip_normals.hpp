// SPDX-License-Identifier: MIT
// The tips of a mesh wall, which are the vertices that a grain can touch as such, and the contact normals that are
// possible at each of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "moreau/core/space.hpp"
#include "moreau/mesh/facet_mesh.hpp"

namespace moreau::detail {

/// The tips of a mesh wall and the cones of their contact normals.
template <EuclideanSpace S>
class TipNormals {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Facet = typename FacetMesh<S>::Facet;

  TipNormals() = default;
  /// @param vertices of the wall [m]
  /// @param facets   of the wall; of a wall with two sides those of the back are the second half
  /// @param sides    of each facet its MeshWall::Side
  /// @param convex   the convex ridges of the wall, MeshWall::ConvexRidge
  /// @param ridges   result of ridges_of() for the facets
  /// @param two_sided whether grains are held on both sides
  template <class Side, class ConvexRidge>
  TipNormals(std::span<const Vector> vertices, std::span<const Facet> facets,
             std::span<const Side> sides, std::span<const ConvexRidge> convex,
             const std::vector<Ridge<S>>& ridges, bool two_sided) {
    set_tips(vertices, convex);
    set_rings(vertices, sides, ridges, two_sided ? facets.size() / 2 : facets.size());
    outward_.assign(vertices.size(), Vector::Zero());
    if (!two_sided) set_outward(facets, sides, ridges);
  }

  /// Whether a grain can touch a vertex as such: convex ridges end there that do not form a line.
  bool is_tip(std::size_t v) const { return is_tip_[v] != 0; }
  /// Whether a direction d, for which is_top() holds, leads from a tip to the outside, and not to the back of a
  /// surface with one side. At a rim both are free.
  bool is_outward(std::size_t v, const Vector& d) const {
    return d.dot(outward_[v]) >= Scalar(-1e-6);
  }
  /// Whether a direction d is a possible contact normal at a tip, towards the grain: all faces at the
  /// vertex lie below the plane through it.
  /// @param tolerance sine of the largest angle of a face above the plane [-]
  bool is_top(std::size_t v, const Vector& d, Scalar tolerance) const {
    for (std::uint32_t k = ring_begin_[v]; k < ring_begin_[v + 1]; ++k)
      if (d.dot(ring_[k]) > tolerance) return false;
    return true;
  }

 private:
  template <class ConvexRidge>
  void set_tips(std::span<const Vector> vertices, std::span<const ConvexRidge> convex);
  template <class Side>
  void set_rings(std::span<const Vector> vertices, std::span<const Side> sides,
                 const std::vector<Ridge<S>>& ridges, std::size_t front);
  template <class Side>
  void set_outward(std::span<const Facet> facets, std::span<const Side> sides,
                   const std::vector<Ridge<S>>& ridges);

  std::vector<unsigned char> is_tip_;
  /// Unit vectors from each tip along the lines in which its faces meet, and within the faces.
  std::vector<Vector> ring_;
  std::vector<std::uint32_t> ring_begin_;  ///< the first of each vertex
  std::vector<Vector> outward_;            ///< of each vertex, see set_outward()
};

// Outside of the class: compiled once where a program declares the wall extern.

/// Finds the tips: the other ends of the convex ridges at a vertex must not lie in one line with it. In the plane a
/// ridge is a vertex.
template <EuclideanSpace S>
template <class ConvexRidge>
void TipNormals<S>::set_tips(std::span<const Vector> vertices,
                             std::span<const ConvexRidge> convex) {
  is_tip_.assign(vertices.size(), 0);
  Scalar far = 0;
  for (const Vector& x : vertices) far = std::max(far, x.cwiseAbs().maxCoeff());
  const Scalar rounding = 4 * std::numeric_limits<Scalar>::epsilon() * far;  // of a vertex [m]
  std::vector<Vector> first(vertices.size(), Vector::Zero());                // of each vertex
  std::vector<Scalar> inverse(vertices.size(), 0);  // 1 / length of its first ridge
  for (const ConvexRidge& ridge : convex)
    for (const std::uint32_t v : ridge.vertices) {
      if (ridge.vertices.size() == 1) is_tip_[v] = 1;
      for (const std::uint32_t w : ridge.vertices) {
        if (w == v) continue;
        const Vector ends = vertices[w] - vertices[v];
        const Scalar length = ends.norm();
        const Vector along = ends / length;
        if (first[v].isZero(0)) {
          first[v] = along;
          inverse[v] = 1 / length;
        }
        // The sine of their angle: in single precision its cosine is 1 to rounding.
        const Scalar sine = (along - along.dot(first[v]) * first[v]).norm();
        if (sine > Scalar(1.5e-5) + rounding * (inverse[v] + 1 / length)) is_tip_[v] = 1;
      }
    }
}

/// @param front number of facets in front
template <EuclideanSpace S>
template <class Side>
void TipNormals<S>::set_rings(std::span<const Vector> vertices, std::span<const Side> sides,
                              const std::vector<Ridge<S>>& ridges, std::size_t front) {
  std::vector<std::pair<std::uint32_t, Vector>> found;  // tip, direction
  for_each_ridge(ridges, [&](std::span<const Ridge<S>> at) {
    const auto add = [&](std::uint32_t v, const Vector& along) {
      if (is_tip_[v] != 0) found.emplace_back(v, along);
    };
    // With both sides, the facets of the back are last: they have the same directions.
    const Side& a = sides[at[0].facet];
    const bool is_rim = at.size() < 2 || at[1].facet >= front;
    const Side& b = is_rim ? a : sides[at[1].facet];
    if constexpr (S::dim == 2) {
      add(at[0].vertices[0], a.inward[at[0].corner]);
      if (!is_rim) add(at[0].vertices[0], b.inward[at[1].corner]);
    } else {
      const auto [v, w] = at[0].vertices;
      Vector along = vertices[w] - vertices[v];
      along = (along - along.dot(a.normal) * a.normal).normalized();
      // Facets of a face lie near its plane only: two planes need not meet in the ridge.
      const Vector line = a.normal.cross(b.normal);
      const Scalar length = line.norm(), part = line.dot(along);
      if (a.face != b.face && std::abs(part) > length / 2 && length > Scalar(1e-9))
        along = part > 0 ? Vector(line / length) : Vector(-line / length);
      add(v, along);
      add(w, -along);
    }
  });
  ring_begin_.assign(vertices.size() + 1, 0);
  for (const auto& [v, along] : found) ++ring_begin_[v + 1];
  std::partial_sum(ring_begin_.begin(), ring_begin_.end(), ring_begin_.begin());
  ring_.resize(found.size());
  std::vector<std::uint32_t> end(ring_begin_.begin(), ring_begin_.end() - 1);
  for (const auto& [v, along] : found) ring_[end[v]++] = along;
}

/// Sets a normal at each vertex that says on which side of the surface a point is that is nearest to the vertex: the
/// mean of the normals of its facets, weighted by their angles at the vertex. It is 0 where both sides are free: of a
/// wall with two sides, and at rims. Source: J. A. Baerentzen, H. Aanaes, Signed distance computation using the
/// angle weighted pseudonormal (2005).
template <EuclideanSpace S>
template <class Side>
void TipNormals<S>::set_outward(std::span<const Facet> facets, std::span<const Side> sides,
                                const std::vector<Ridge<S>>& ridges) {
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (int k = 0; k < S::dim; ++k) {
      Scalar angle = 1;
      if constexpr (S::dim == 3) {
        const auto& corners = sides[f].corners;
        const Vector to_next = corners.col((k + 1) % 3) - corners.col(k);
        const Vector to_last = corners.col((k + 2) % 3) - corners.col(k);
        angle = std::atan2(to_next.cross(to_last).norm(), to_next.dot(to_last));
      }
      outward_[facets[f][std::size_t(k)]] += angle * sides[f].normal;
    }
  for (Vector& outward : outward_) outward.normalize();
  for_each_ridge(ridges, [&](std::span<const Ridge<S>> at) {
    if (at.size() > 1) return;
    for (const std::uint32_t v : at[0].vertices) outward_[v].setZero();
  });
}

}  // namespace moreau::detail
