// SPDX-License-Identifier: MIT
// Moments of the Minkowski sum of a core and a ball of radius r, in the core's frame, at density
// one. A core defined by a user needs a function rounded_moments(core, r) in the user's namespace.
#pragma once

#include <cstddef>
#include <numbers>
#include <vector>

#include "moreau/shape/detail/normal_cone.hpp"
#include "moreau/shape/moments.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/segment.hpp"

namespace moreau {

/// Moments of a rounded polygon: the sum over the polygon, a rectangle on each edge, and a sector
/// of a disk at each vertex.
/// @param r radius of the ball [m], > 0
/// @returns moments about the core's origin, in its axes, at density one
template <std::floating_point T>
Moments<Space<2, T>> rounded_moments(const Polygon<T>& core, T r) {
  using S = Space<2, T>;
  using Vector = typename S::Vector;
  const Eigen::Index count = core.vertices().rows();
  Moments<S> sum = core.moments();
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index before = i > 0 ? i - 1 : count - 1, after = i + 1 < count ? i + 1 : 0;
    const Vector vertex = core.vertices().row(i).transpose();
    const Vector next = core.vertices().row(after).transpose();
    const Vector normal = core.face_normals().row(i).transpose();
    const Vector normal_before = core.face_normals().row(before).transpose();
    sum +=
        detail::sum_set(detail::edge_moments<S>(vertex, next), detail::ray_moments<S>(normal, r));
    sum += detail::sum_set(detail::vertex_moments<S>(vertex),
                           detail::sector_moments<S>(normal_before, normal, r));
  }
  return sum;
}

namespace detail {

/// Moments of face f of a polyhedron. Also adds the angles of this face to the cones of its
/// vertices.
template <std::floating_point T>
Moments<Space<3, T>> face_moments(const Polyhedron<T>& core, std::size_t f,
                                  std::vector<VertexCone<T>>& cones) {
  using S = Space<3, T>;
  using Vector = typename S::Vector;
  const auto loop = core.face(f);
  const auto at = [&](std::size_t k) -> Vector {
    return core.vertices().row(static_cast<Eigen::Index>(loop[k % loop.size()])).transpose();
  };
  Moments<S> face;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vector here = at(k), next = at(k + 1), before = at(k + loop.size() - 1);
    cones[loop[k]].add_face(next - here, before - here);
    if (k == 0 || k + 1 == loop.size()) continue;
    typename S::Matrix corners;
    corners << at(0), here, next;
    const T area = (here - at(0)).cross(next - at(0)).norm() / 2;
    face += simplex_moments<S, 3>(area, corners);
  }
  return face;
}

}  // namespace detail

/// Moments of a rounded polyhedron: the sum over the polyhedron, a prism on each face, a sector of
/// a cylinder along each edge, and a sector of a ball at each vertex.
/// @param r radius of the ball [m], > 0
/// @returns moments about the core's origin, in its axes, at density one
template <std::floating_point T>
Moments<Space<3, T>> rounded_moments(const Polyhedron<T>& core, T r) {
  using S = Space<3, T>;
  using Vector = typename S::Vector;
  const auto row = [](const auto& rows, std::size_t i) -> Vector {
    return rows.row(static_cast<Eigen::Index>(i)).transpose();
  };
  std::vector<detail::VertexCone<T>> cones(core.vertex_count());
  Moments<S> sum = core.moments();
  for (std::size_t f = 0; f < core.face_count(); ++f)
    sum += detail::sum_set(detail::face_moments(core, f, cones),
                           detail::ray_moments<S>(row(core.face_normals(), f), r));
  for (const auto& edge : core.edges()) {
    const Vector v = row(core.vertices(), edge.vertex[0]), w = row(core.vertices(), edge.vertex[1]);
    const Vector n = row(core.face_normals(), edge.face[0]);
    const Vector m = row(core.face_normals(), edge.face[1]);
    const Vector along = (w - v).normalized();
    cones[edge.vertex[0]].add_edge(along, n, m);
    cones[edge.vertex[1]].add_edge(-along, n, m);
    sum += detail::sum_set(detail::edge_moments<S>(v, w), detail::sector_moments<S>(n, m, r));
  }
  for (std::size_t v = 0; v < cones.size(); ++v)
    sum += detail::sum_set(detail::vertex_moments<S>(row(core.vertices(), v)), cones[v].moments(r));
  return sum;
}

/// Moments of a capsule: a cylinder between two half balls; in the plane, a rectangle between two
/// half disks. The centres of the half balls lie at a distance h from the origin. Each half ball
/// has the first moment int x = B_(D-1) r^(D+1) / (D+1) about its centre, where B_k is the volume
/// of the unit ball of dimension k.
/// @param r radius of the ball [m], > 0
/// @returns moments about the core's origin, in its axes, at density one
template <class S>
Moments<S> rounded_moments(const Segment<S>& core, typename S::Scalar r) {
  using T = typename S::Scalar;
  const T h = core.half_length(), pi = std::numbers::pi_v<T>;
  const T section = S::dim == 2 ? 2 * r : pi * r * r;  // B_(D-1) r^(D-1)
  const T ball = S::dim == 2 ? pi * r * r : 4 * pi / 3 * r * r * r;
  const T tube = 2 * h * section;
  Moments<S> sum;
  sum.volume = ball + tube;
  sum.second.diagonal().setConstant(ball * r * r / T(S::dim + 2) + tube * r * r / T(S::dim + 1));
  sum.second(0, 0) = ball * (r * r / T(S::dim + 2) + h * h) +
                     4 * h * section * r * r / T(S::dim + 1) + tube * h * h / 3;
  return sum;
}

}  // namespace moreau
