// SPDX-License-Identifier: MIT
// Merges the coplanar triangles of a convex surface into faces.
//
// A face grows from the largest triangle that is not yet part of a face. Neighbour triangles are
// added if their corners lie within the tolerance of the face's plane. The plane is then fitted
// again to all corners. This is repeated until no neighbour can be added. Because faces grow from
// large triangles, slivers do no harm: they are added to faces whose plane is accurate, and their
// own normals are not used. After merging, a vertex with fewer than three faces lies inside a face
// or on an edge, and is removed.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "moreau/core/aabb.hpp"
#include "moreau/core/box_tree.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/sort_items.hpp"
#include "moreau/core/space.hpp"
#include "moreau/shape/detail/face_plane.hpp"
#include "moreau/shape/detail/triangle_hull.hpp"

namespace moreau::detail {

using FaceList = std::vector<std::vector<std::uint32_t>>;

/// The directed edges of all faces, sorted.
inline List<std::array<std::uint32_t, 2>> directed_edges(const FaceList& faces) {
  List<std::array<std::uint32_t, 2>> edges;
  for (const auto& face : faces) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      edges.push_back({face[k], face[(k + 1) % face.size()]});
    }
  }
  sort_items(edges);
  return edges;
}

/// Whether every edge occurs once in each direction, and Euler's formula V - E + F = 2 holds.
inline bool is_closed_surface(const FaceList& faces) {
  const auto edges = directed_edges(faces);
  std::size_t vertices = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const std::array<std::uint32_t, 2> back{edges[i][1], edges[i][0]};
    if (i > 0 && edges[i] == edges[i - 1]) return false;
    if (!std::binary_search(edges.begin(), edges.end(), back)) return false;
    if (i == 0 || edges[i][0] != edges[i - 1][0]) ++vertices;
  }
  return vertices + faces.size() == edges.size() / 2 + 2;
}

class FaceMerging {
 public:
  FaceMerging(std::span<const HullTriangle> triangles, std::span<const Eigen::Vector3d> points,
              double tolerance)
      : triangles_(triangles), points_(points), tolerance_(tolerance) {
    area_.reserve(triangles.size());
    for (const HullTriangle& t : triangles)
      area_.push_back(area_vector(points[t.vertex[0]], points[t.vertex[1]], points[t.vertex[2]]));
    List<double> size;
    for (const Eigen::Vector3d& area : area_) size.push_back(area.squaredNorm());
    List<std::uint32_t> order(triangles.size());
    std::iota(order.begin(), order.end(), 0U);
    sort_items(order, [&](std::uint32_t a, std::uint32_t b) {
      return size[a] > size[b] || (size[a] == size[b] && a < b);
    });
    group_.assign(triangles.size(), none);
    for (const std::uint32_t t : order) {
      if (group_[t] == none) grow(t);
    }
  }

  /// The faces, or nothing if the merged faces do not bound a solid.
  std::optional<FaceList> faces() const {
    FaceList faces;
    for (std::uint32_t g = 0; g < members_.size(); ++g) {
      auto boundary = boundary_of(g);
      if (!boundary) return std::nullopt;
      faces.push_back(std::move(*boundary));
    }
    drop_flat_vertices(faces);
    if (!is_closed_surface(faces)) return std::nullopt;
    return faces;
  }

 private:
  static constexpr std::uint32_t none = ~0U;

  /// The product of the two shorter edges: that of two long edges of a sliver, which are nearly
  /// parallel, would lose digits.
  static Eigen::Vector3d area_vector(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                     const Eigen::Vector3d& c) {
    const Eigen::Vector3d ab = b - a, bc = c - b, ca = a - c;
    const double of_ab = ab.squaredNorm(), of_bc = bc.squaredNorm(), of_ca = ca.squaredNorm();
    if (of_bc >= of_ab && of_bc >= of_ca) return ca.cross(ab);
    return of_ca >= of_ab ? ab.cross(bc) : bc.cross(ca);
  }

  void grow(std::uint32_t seed) {
    const auto g = static_cast<std::uint32_t>(members_.size());
    auto& members = members_.emplace_back(1, seed);
    group_[seed] = g;
    for (std::size_t before = 0; before != members.size();) {
      before = members.size();
      fit_plane(members);
      for (std::size_t i = 0; i < members.size(); ++i) {
        for (const std::uint32_t t : triangles_[members[i]].neighbour) {
          if (group_[t] != none || !lies_on_plane(t)) continue;
          group_[t] = g;
          members.push_back(t);
        }
      }
    }
  }

  void fit_plane(std::span<const std::uint32_t> members) {
    Eigen::Vector3d area = Eigen::Vector3d::Zero(), sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t t : members) {
      area += area_[t];
      for (const std::uint32_t v : triangles_[t].vertex) sum += points_[v];
    }
    normal_ = area.normalized();
    center_ = sum / static_cast<double>(3 * members.size());
  }

  bool lies_on_plane(std::uint32_t t) const {
    return std::all_of(triangles_[t].vertex.begin(), triangles_[t].vertex.end(), [&](auto v) {
      return std::abs(normal_.dot(points_[v] - center_)) <= tolerance_;
    });
  }

  /// The cyclic list of vertices around a group of triangles, or nothing if there is more than one
  /// such cycle.
  std::optional<std::vector<std::uint32_t>> boundary_of(std::uint32_t g) const {
    List<std::pair<std::uint32_t, std::uint32_t>> next;
    for (const std::uint32_t t : members_[g]) {
      for (std::size_t e = 0; e < 3; ++e) {
        if (group_[triangles_[t].neighbour[e]] == g) continue;
        next.emplace_back(triangles_[t].vertex[e], triangles_[t].vertex[(e + 1) % 3]);
      }
    }
    if (next.empty()) return std::nullopt;
    sort_items(next);
    std::vector<std::uint32_t> cycle{next.front().first};
    while (cycle.size() <= next.size()) {
      const auto at = std::lower_bound(next.begin(), next.end(), std::pair(cycle.back(), 0U));
      if (at->second == cycle.front()) break;
      cycle.push_back(at->second);
    }
    if (cycle.size() != next.size()) return std::nullopt;
    return cycle;
  }

  /// Removes vertices with fewer than three faces, and faces with fewer than three vertices. Repeats
  /// until nothing changes.
  void drop_flat_vertices(FaceList& faces) const {
    for (bool changed = true; changed;) {
      changed = false;
      List<int> faces_at(points_.size(), 0);
      for (const auto& face : faces) {
        for (const std::uint32_t v : face) ++faces_at[v];
      }
      for (auto& face : faces) {
        changed |= std::erase_if(face, [&](std::uint32_t v) { return faces_at[v] < 3; }) > 0;
      }
      std::erase_if(faces, [](const auto& face) { return face.size() < 3; });
    }
  }

  std::span<const HullTriangle> triangles_;
  std::span<const Eigen::Vector3d> points_;
  double tolerance_;
  std::vector<Eigen::Vector3d> area_;  ///< area vectors: outward, twice as long as the area
  List<std::uint32_t> group_;
  std::vector<std::vector<std::uint32_t>> members_;
  Eigen::Vector3d normal_, center_;
};

/// Whether the plane of a face is a supporting plane: all points lie on or below it, and the face's
/// own vertices lie on it, both within the tolerance. This must hold even if the vertices are later
/// displaced by the rounding. Such a displacement can tilt a face of width w about its long axis by
/// the angle rounding / w.
/// @param tree of the points, each as a box
inline bool has_supporting_plane(std::span<const std::uint32_t> face,
                                 std::span<const Eigen::Vector3d> points,
                                 const BoxTree<Space<3>>& tree, double tolerance, double rounding) {
  using Vector = Eigen::Vector3d;
  const auto plane =
      face_plane<Vector>(face.size(), [&](std::size_t k) { return points[face[k]]; });
  const Vector across = plane.normal.cross(plane.axis);
  const double angle = rounding / plane.width;
  const auto height = [&](const Vector& x) { return plane.normal.dot(x - plane.center); };
  const auto tilt = [&](const Vector& x) { return angle * std::abs(across.dot(x - plane.center)); };
  // The largest value of height + tilt in a box, and a bound of its rounding error.
  const auto may_exceed = [&](const Aabb<Space<3>>& box) {
    const Vector middle = (box.lower + box.upper) / 2, half = (box.upper - box.lower) / 2;
    const double reach = plane.normal.cwiseAbs().dot(half) + angle * across.cwiseAbs().dot(half);
    const double slack = 32 * std::numeric_limits<double>::epsilon();
    return !(height(middle) + tilt(middle) + reach <= tolerance - slack * (1 + angle));
  };
  bool is_below = true;
  tree.query([&](const Aabb<Space<3>>& box) { return is_below && may_exceed(box); },
             [&](std::uint32_t place) {
               const Vector& x = points[tree.order()[place]];
               is_below = is_below && height(x) + tilt(x) <= tolerance;
             });
  return is_below && std::all_of(face.begin(), face.end(),
                                 [&](std::uint32_t v) { return height(points[v]) >= -tolerance; });
}

/// Whether the plane of each face is a supporting plane.
inline bool has_supporting_planes(const FaceList& faces, std::span<const Eigen::Vector3d> points,
                                  double tolerance, double rounding) {
  std::vector<Aabb<Space<3>>> boxes;
  boxes.reserve(points.size());
  for (const Eigen::Vector3d& x : points) boxes.emplace_back(x, x);
  const BoxTree<Space<3>> tree(boxes);
  return std::all_of(faces.begin(), faces.end(), [&](const auto& face) {
    return has_supporting_plane(face, points, tree, tolerance, rounding);
  });
}

/// The faces of a closed convex surface of triangles, with coplanar triangles merged. If some
/// points have a distance from a plane that is close to the tolerance, some triangles may not be
/// merged, and slivers with meaningless normals remain. The function then tries larger tolerances,
/// up to a given factor. If none succeeds, the triangles are returned.
/// @param tolerance vertices closer to a plane than this lie on it, in the unit of the points
/// @param rounding  largest displacement of the points by the rounding of the caller, after this
///                  function, in the unit of the points; much smaller than the tolerance
/// @param most      largest factor, >= 1 [-]
inline FaceList merged_faces(std::span<const HullTriangle> triangles,
                             std::span<const Eigen::Vector3d> points, double tolerance,
                             double rounding, double most) {
  for (double factor = 1; factor <= most; factor *= 2) {
    const auto faces = FaceMerging(triangles, points, factor * tolerance).faces();
    if (faces && has_supporting_planes(*faces, points, 2 * factor * tolerance, rounding)) {
      return *faces;
    }
  }
  FaceList faces;
  for (const HullTriangle& t : triangles) faces.emplace_back(t.vertex.begin(), t.vertex.end());
  return faces;
}

}  // namespace moreau::detail
