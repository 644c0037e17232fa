// SPDX-License-Identifier: MIT
// A wall of triangles in space, or of segments in the plane: a funnel, a wavy floor, a tamping tine.
//
// The wall is the outside of its facets. Two facets that join at a ridge (an edge of triangles, an end
// of segments) meet in one of three ways, seen from outside:
//
//   - flat: the ridge is no feature of the surface. Facets that are connected over flat ridges form a face. A grain that
//     slides over it does not notice its ridges: two neighbours share a plane that divides the space above the face;
//   - concave: a grain outside touches the two facets, never the ridge;
//   - convex: a grain can touch the ridge, with a normal between those of the two facets. The rim of an open surface
//     counts as convex: normals there point away from the facet, upwards or downwards.
//
// Between different faces there is no angle too small to be convex or concave. High above a convex ridge
// the space between the two faces is wide even if their angle is small.
//
// A wall with two sides consists of the facets and of their reversed copies, which join at the rim.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "moreau/core/aabb.hpp"
#include "moreau/core/box_tree.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/mesh/check_mesh.hpp"
#include "moreau/mesh/detail/tip_normals.hpp"
#include "moreau/mesh/facet_mesh.hpp"

namespace moreau {

/// Which sides of its facets a mesh wall has.
enum class WallSides : std::uint8_t {
  /// Grains are held on the side from which the corners of a triangle run counter-clockwise; in the plane,
  /// on the right of the way from the first corner of a segment to the second. From behind they pass.
  outside,
  both,  ///< grains are held on both sides of a thin wall
};

/// The surface of a mesh wall, in the frame of its body. It does not change.
template <EuclideanSpace S>
class MeshWall {
 public:
  using Space = S;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;
  using Facet = typename FacetMesh<S>::Facet;  ///< the D corners of a facet, as vertices
  static constexpr std::uint32_t none = ~0U;   ///< the number of no ridge

  /// A facet with what collision tests need of it. All facets of a face have the same plane.
  struct Side {
    Matrix corners;      ///< as columns [m]
    Vector normal;       ///< of the face, unit, to the outside
    Scalar offset;       ///< of the face: normal . x of the points x of its plane [m]
    std::uint32_t face;  ///< lowest number of the facets of the face, in the order of the mesh
    /// For each ridge (number k lies opposite corner k): unit vector in the plane of the face, away from
    /// the ridge to the inside, and its product with the points of the ridge [m].
    std::array<Vector, std::size_t(S::dim)> inward;
    std::array<Scalar, std::size_t(S::dim)> inward_offset;  ///< see inward
    std::array<std::uint32_t, std::size_t(S::dim)> ridge;   ///< number of a convex ridge, or `none`
  };
  /// A convex ridge.
  struct ConvexRidge {
    std::array<std::uint32_t, std::size_t(S::dim - 1)> vertices;  ///< its ends; in the plane one
    /// Directions d of contact normals at the ridge, towards the grain, satisfy d . beyond >= 0 for
    /// both: unit vectors in the planes of the two faces, away from the facets; at a rim both are the
    /// same.
    std::array<Vector, 2> beyond;
    Vector middle;                       ///< of the directions d: unit
    std::array<std::uint32_t, 2> facet;  ///< that join; the same twice at a rim
  };

  /// @param mesh  vertices [m] and facets in the frame of the body
  /// @param sides of the facets at which grains are held
  /// @param function the public name the caller used
  /// @throws std::invalid_argument if the mesh has a fault (find_wall_fault()), or if it has more than
  ///         2^27 facets or vertices
  explicit MeshWall(const FacetMesh<S>& mesh, WallSides sides = WallSides::outside,
                    const char* function = "MeshWall")
      : mesh_(mesh), sides_(sides) {
    require_wall(mesh, function);
    require(std::max(mesh.facets.size(), mesh.vertices.size()) <= (1U << 27), function,
            "facets.size()", mesh.facets.size(), "must be at most 2^27");
    build();
  }

  const FacetMesh<S>& mesh() const { return mesh_; }  ///< as it was given
  WallSides sides() const { return sides_; }          ///< as they were given

  /// Number of facets: with two sides, twice that of the mesh.
  std::size_t size() const { return facets_.size(); }
  /// The facets in the order of tree(): k < size().
  const Side& side(std::size_t k) const { return facet_sides_[k]; }
  const Facet& facet(std::size_t k) const { return facets_[k]; }           ///< corners of side(k)
  const Aabb<S>& box(std::size_t k) const { return boxes_[k]; }            ///< around facet(k) [m]
  const Vector& vertex(std::size_t v) const { return mesh_.vertices[v]; }  ///< [m]
  std::size_t ridge_count() const { return ridges_.size(); }               ///< of convex ridges
  const ConvexRidge& ridge(std::size_t r) const { return ridges_[r]; }     ///< r < ridge_count()
  /// How far facets of one face may lie beside its plane [m].
  Scalar flatness() const { return flat_; }
  /// Whether the surface has no rim.
  bool is_closed() const { return is_closed_; }
  /// Whether a grain can touch a vertex as such: convex ridges end there that do not form a line.
  bool is_tip(std::size_t v) const { return tips_.is_tip(v); }
  /// Whether side(k) has neither a convex ridge nor a tip.
  bool is_plain(std::size_t k) const { return kinds_[k].is_plain; }
  /// The place of the facet that joins side(k) at the ridge opposite corner c, or `none` at a rim.
  std::uint32_t neighbour(std::size_t k, std::size_t c) const { return neighbours_[k][c]; }
  /// Whether side(k) has a concave ridge opposite corner c.
  bool is_concave(std::size_t k, std::size_t c) const {
    const Side& side = facet_sides_[k];
    const std::uint32_t other = neighbours_[k][c];
    return other != none && side.ridge[c] == none && facet_sides_[other].face != side.face;
  }
  /// Whether side(k) has a concave ridge.
  bool has_concave(std::size_t k) const { return kinds_[k].has_concave; }
  /// Whether a direction d, for which is_top() holds, leads from a tip to the outside, and not to the back of a
  /// surface with one side. At a rim both are free.
  bool is_outward(std::size_t v, const Vector& d) const { return tips_.is_outward(v, d); }
  /// Whether a direction d is a possible contact normal at a tip, towards the grain: all faces at the
  /// vertex lie below the plane through it.
  /// @param tolerance sine of the largest angle of a face above the plane [-]
  bool is_top(std::size_t v, const Vector& d, Scalar tolerance) const {
    return tips_.is_top(v, d, tolerance);
  }
  /// The boxes of the facets [m]. A query gives the places k of side().
  const detail::BoxTree<S>& tree() const { return tree_; }

 private:
  struct Kind {
    bool is_plain = true, has_concave = false;
  };

  friend struct SerializationAccess;
  MeshWall() = default;
  auto serialized_members() { return std::tie(mesh_.vertices, mesh_.facets, sides_); }
  void deserialized() {
    require_wall(mesh_, "MeshWall");
    build();
  }

  void build();
  void set_sides();
  void join_faces();
  void set_inward();
  void set_ridges(const std::vector<Ridge<S>>& ridges);
  void sort_by_place();
  void set_kinds();
  /// A vector without its component along a ridge.
  Vector across(const Ridge<S>& ridge, Vector x) const {
    if constexpr (S::dim == 3) {
      const Vector along =
          (mesh_.vertices[ridge.vertices[1]] - mesh_.vertices[ridge.vertices[0]]).normalized();
      x -= x.dot(along) * along;
    }
    return x;
  }

  FacetMesh<S> mesh_;
  WallSides sides_ = WallSides::outside;
  std::vector<Facet> facets_;
  std::vector<Side> facet_sides_;
  std::vector<Facet> neighbours_;  ///< see neighbour()
  std::vector<Aabb<S>> boxes_;
  std::vector<Kind> kinds_;  ///< see is_plain() and has_concave()
  std::vector<ConvexRidge> ridges_;
  detail::TipNormals<S> tips_;
  detail::BoxTree<S> tree_;
  bool is_closed_ = false;
  Scalar flat_ = 0;  ///< a corner closer to the plane of a neighbour than this lies in it [m]
};

// Outside of the class: compiled once where a program declares the wall extern.
template <EuclideanSpace S>
void MeshWall<S>::build() {
  // Files hold coordinates in single precision: facets of a plane floor are plane to 1e-7.
  flat_ = Scalar(2e-7) * size_of(mesh_) + detail::rounding_of(mesh_);
  facets_ = mesh_.facets;
  if (sides_ == WallSides::both)
    for (const Facet& facet : mesh_.facets) {
      facets_.push_back(facet);
      std::swap(facets_.back()[0], facets_.back()[1]);
    }
  set_sides();
  // The two sides of a thin wall join at its rim alone: the ridges of each side are paired first.
  const auto ridges = ridges_of<S>(facets_);
  neighbours_ = detail::neighbours_of<S>(ridges, facets_.size(), mesh_.facets.size());
  join_faces();
  set_inward();
  set_ridges(ridges);
  is_closed_ = std::none_of(ridges_.begin(), ridges_.end(), [](const ConvexRidge& ridge) {
    return ridge.facet[0] == ridge.facet[1];
  });
  tips_ = detail::TipNormals<S>(
      std::span(std::as_const(mesh_.vertices)), std::span(std::as_const(facets_)),
      std::span(std::as_const(facet_sides_)), std::span(std::as_const(ridges_)), ridges,
      sides_ == WallSides::both);
  sort_by_place();
  set_kinds();
}

/// Searches of facets near a grain ask for the kind of each facet that they find.
template <EuclideanSpace S>
void MeshWall<S>::set_kinds() {
  kinds_.resize(facets_.size());
  for (std::size_t k = 0; k < facets_.size(); ++k) {
    Kind kind;
    const Side& side = facet_sides_[k];
    for (std::size_t c = 0; c < facets_[k].size(); ++c) {
      kind.is_plain = kind.is_plain && side.ridge[c] == none && !is_tip(facets_[k][c]);
      kind.has_concave = kind.has_concave || is_concave(k, c);
    }
    kinds_[k] = kind;
  }
}

/// Makes the tree, and brings the facets into its order: those near each other are near in memory.
template <EuclideanSpace S>
void MeshWall<S>::sort_by_place() {
  std::vector<Aabb<S>> boxes(facets_.size());
  for (std::size_t f = 0; f < facets_.size(); ++f)
    for (const std::uint32_t v : facets_[f]) boxes[f].merge(mesh_.vertices[v]);
  tree_ = detail::BoxTree<S>(boxes);
  const auto facets = facets_;
  const auto sides = facet_sides_;
  const auto neighbours = neighbours_;
  std::vector<std::uint32_t> place(facets.size());
  boxes_.resize(facets.size());
  for (std::uint32_t k = 0; k < facets.size(); ++k) {
    facets_[k] = facets[tree_.order()[k]];
    facet_sides_[k] = sides[tree_.order()[k]];
    neighbours_[k] = neighbours[tree_.order()[k]];
    boxes_[k] = boxes[tree_.order()[k]];
    place[tree_.order()[k]] = k;
  }
  for (ConvexRidge& ridge : ridges_)
    for (std::uint32_t& f : ridge.facet) f = place[f];
  for (Facet& joined : neighbours_)
    for (std::uint32_t& f : joined)
      if (f != none) f = place[f];
}

template <EuclideanSpace S>
void MeshWall<S>::set_sides() {
  const FacetMesh<S> all{mesh_.vertices, facets_};
  facet_sides_.resize(facets_.size());
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    const Matrix corners = corners_of(all, f);
    Side& side = facet_sides_[f];
    side.normal = area_vector(corners).normalized();
    side.face = std::uint32_t(f);
    side.corners = corners;
    side.offset = side.normal.dot(corners.rowwise().mean());
    side.ridge.fill(none);
  }
}

/// Unites facets that lie in the plane of the largest facet of their face.
template <EuclideanSpace S>
void MeshWall<S>::join_faces() {
  std::vector<std::uint32_t> lowest(facets_.size(), none), open;  // by the largest facet
  for (Side& side : facet_sides_) side.face = none;
  for (const std::uint32_t seed : detail::largest_first<S>({mesh_.vertices, facets_})) {
    if (facet_sides_[seed].face != none) continue;
    const Side& first = facet_sides_[seed];
    const auto is_flat = [&](std::uint32_t g) {
      bool is = facet_sides_[g].normal.dot(first.normal) > 0;
      for (const std::uint32_t v : facets_[g])
        is = is && std::abs(first.normal.dot(mesh_.vertices[v]) - first.offset) <= flat_;
      return is;
    };
    facet_sides_[seed].face = seed;
    for (open.assign(1, seed); !open.empty();) {
      const std::uint32_t f = open.back();
      open.pop_back();
      lowest[seed] = std::min(lowest[seed], f);
      for (const std::uint32_t g : neighbours_[f]) {
        if (g == none || facet_sides_[g].face != none || !is_flat(g)) continue;
        facet_sides_[g].face = seed;
        facet_sides_[g].normal = first.normal;
        facet_sides_[g].offset = first.offset;
        open.push_back(g);
      }
    }
  }
  for (Side& side : facet_sides_) side.face = lowest[side.face];
}

/// Sets the planes that bound the space above each facet. They contain the normal of the face: two
/// facets of a face share the plane through their ridge.
template <EuclideanSpace S>
void MeshWall<S>::set_inward() {
  for (Side& side : facet_sides_)
    for (int k = 0; k < S::dim; ++k) {
      const Vector on_ridge = side.corners.col((k + 1) % S::dim);
      Vector inward;
      if constexpr (S::dim == 3)
        inward = side.normal.cross(Vector(side.corners.col((k + 2) % 3) - on_ridge));
      else
        inward = {-side.normal[1], side.normal[0]};
      if (inward.dot(side.corners.col(k) - on_ridge) < 0) inward = -inward;
      side.inward[std::size_t(k)] = inward.normalized();
      side.inward_offset[std::size_t(k)] = side.inward[std::size_t(k)].dot(on_ridge);
    }
}

template <EuclideanSpace S>
void MeshWall<S>::set_ridges(const std::vector<Ridge<S>>& ridges) {
  const auto add = [&](const Ridge<S>& a, const Ridge<S>& b) {
    const Vector of_a = -facet_sides_[a.facet].inward[a.corner];
    const Vector normal = facet_sides_[a.facet].normal, other = facet_sides_[b.facet].normal;
    const bool is_rim = a.facet == b.facet;
    const Vector of_b = -facet_sides_[b.facet].inward[b.corner];  // at a rim that of the same facet
    // Where the angle is small, the sum of these two is too short to have an accurate direction.
    Vector middle = of_a + of_b;
    if (!is_rim) middle += across(a, normal + other);
    for (const Ridge<S>& ridge : {a, b})
      facet_sides_[ridge.facet].ridge[ridge.corner] = std::uint32_t(ridges_.size());
    ridges_.push_back({a.vertices, {of_a, of_b}, middle.normalized(), {a.facet, b.facet}});
  };
  for_each_ridge(ridges, [&](std::span<const Ridge<S>> at) {
    // On a surface with one side two facets join; with both sides, two pairs of facets, or the two sides of a rim.
    std::vector<unsigned char> is_paired(at.size(), 0);
    const auto pair_up = [&](const auto& fits) {
      for (std::size_t i = 0; i < at.size(); ++i)
        for (std::size_t j = i + 1; j < at.size(); ++j) {
          const Ridge<S>&a = at[i], &b = at[j];
          if (is_paired[i] != 0 || is_paired[j] != 0 || a.is_forward == b.is_forward ||
              !fits(a.facet, b.facet))
            continue;
          is_paired[i] = is_paired[j] = 1;
          if (facet_sides_[a.facet].face == facet_sides_[b.facet].face) continue;
          const bool is_fold = (a.facet < mesh_.facets.size()) != (b.facet < mesh_.facets.size());
          const Side &of_a = facet_sides_[a.facet], &of_b = facet_sides_[b.facet];
          const Scalar rise =
              of_b.normal.dot(of_a.inward[a.corner]) + of_a.normal.dot(of_b.inward[b.corner]);
          if (is_fold || rise < 0) add(a, b);
        }
    };
    const std::size_t front = mesh_.facets.size();
    pair_up([&](auto f, auto g) { return (f < front) == (g < front); });
    pair_up([&](auto f, auto g) { return (f < front) != (g < front); });
    for (std::size_t i = 0; i < at.size(); ++i)
      if (is_paired[i] == 0) add(at[i], at[i]);
  });
}

}  // namespace moreau
