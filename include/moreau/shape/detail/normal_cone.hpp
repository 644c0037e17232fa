// SPDX-License-Identifier: MIT
// Exact moments of the pieces that a ball of radius r adds to a polytope.
//
// The Minkowski sum of a polytope and a ball is a union of pieces that do not overlap. There is one
// piece for each face F of any dimension k: the polytope itself (k = D), its facets, edges and
// vertices. The piece consists of all sums y + z of a point y of F and a point z of the ball that
// lies in the normal cone of F. The cone has the dimension D - k and is orthogonal to F. So
// integrals over a piece are products of integrals over F and over the cone. The cones are
//
//     (D-1)-face     a ray along its normal
//     (D-2)-face     a sector of a disk between the normals of its two facets, of angle theta
//     vertex in 3D   all directions in a spherical polygon Q. The corners of Q are the normals of
//                    the faces at the vertex. Arc i, of angle theta_i, belongs to edge i there
//
// Let u_i be the unit vector along edge i away from the vertex, n_i and n_i' the normals of the two
// faces at edge i, and alpha_f the angle of face f at the vertex. Then
//
//     area of Q      W = 2 pi - sum alpha_f           (Gauss-Bonnet; Descartes' angular defect)
//     int_Q n        = -1/2 sum theta_i u_i           (the resultant of a uniform pressure is 0)
//     int_Q n n^T    = W/3 1 - 1/3 sum sym(u_i E_i^T)
//     E_i = int_i n  = tan(theta_i / 2) (n_i + n_i')
//
// The third line follows from the divergence theorem on Q for the field (a.n) grad(b.n), whose
// divergence is a.b - 3 (a.n)(b.n). The outward conormal of arc i is u_i, which is constant along
// the arc. The integrals over the radius give the factors r^3/3, r^4/4 and r^5/5.
#pragma once

#include <cmath>
#include <numbers>

#include "moreau/shape/moments.hpp"

namespace moreau::detail {

/// Moments of the set of all sums y + z of points y of one set and points z of a second set. The
/// two sets lie in orthogonal subspaces. The volume of a set of dimension k is its k-dimensional
/// measure.
template <class S>
Moments<S> sum_set(const Moments<S>& y, const Moments<S>& z) {
  return {y.volume * z.volume, z.volume * y.first + y.volume * z.first,
          z.volume * y.second + y.volume * z.second + y.first * z.first.transpose() +
              z.first * y.first.transpose()};
}

/// Moments of the simplex whose corners are the N columns: a point, a line segment or a triangle.
template <class S, int N>
Moments<S> simplex_moments(typename S::Scalar measure,
                           const Eigen::Matrix<typename S::Scalar, S::dim, N>& corners) {
  using T = typename S::Scalar;
  const typename S::Vector sum = corners.rowwise().sum();
  return {measure, measure / T(N) * sum,
          measure / T(N * (N + 1)) * (corners * corners.transpose() + sum * sum.transpose())};
}
template <class S>
Moments<S> vertex_moments(const typename S::Vector& v) {
  return {1, v, v * v.transpose()};
}
template <class S>
Moments<S> edge_moments(const typename S::Vector& v, const typename S::Vector& w) {
  Eigen::Matrix<typename S::Scalar, S::dim, 2> corners;
  corners << v, w;
  return simplex_moments<S, 2>((w - v).norm(), corners);
}

/// Moments of the segment from the origin to r n, where n is a unit vector.
template <class S>
Moments<S> ray_moments(const typename S::Vector& n, typename S::Scalar r) {
  return {r, r * r / 2 * n, r * r * r / 3 * (n * n.transpose())};
}

/// The angle between two unit vectors [rad], exact to rounding for any angle.
template <class Vector>
typename Vector::Scalar angle_between(const Vector& n, const Vector& m) {
  return 2 * std::atan2((m - n).norm(), (m + n).norm());
}

/// Moments of the sector of a disk of radius r about the origin between two unit vectors, whose
/// angle must be less than pi.
template <class S>
Moments<S> sector_moments(const typename S::Vector& n, const typename S::Vector& m,
                          typename S::Scalar r) {
  using T = typename S::Scalar;
  const T angle = angle_between(n, m), r2 = r * r;
  const typename S::Vector middle = (n + m).normalized(), across = (m - n).normalized();
  return {r2 * angle / 2, r * r2 / 3 * (m - n).norm() * middle,
          r2 * r2 / 8 *
              ((angle + std::sin(angle)) * middle * middle.transpose() +
               (angle - std::sin(angle)) * across * across.transpose())};
}

/// Normal cone of a vertex in space, computed as a sum over the faces and edges at the vertex, in
/// any order.
template <std::floating_point T>
class VertexCone {
 public:
  using S = Space<3, T>;
  using Vector = typename S::Vector;

  /// @param v,w  vectors from the vertex along the two edges of the face
  void add_face(const Vector& v, const Vector& w) {
    defect_ -= std::atan2(v.cross(w).norm(), v.dot(w));
  }
  /// @param u    unit vector along the edge away from the vertex
  /// @param n,m  unit normals of the two faces at the edge
  void add_edge(const Vector& u, const Vector& n, const Vector& m) {
    const T angle = angle_between(n, m);
    const Vector along_arc = (m - n).norm() / (m + n).norm() * (n + m);
    first_ -= angle / 2 * u;
    second_ -= (u * along_arc.transpose() + along_arc * u.transpose()) / 6;
  }
  /// Moments of the part of the ball of radius r about the vertex that lies in the cone.
  Moments<S> moments(T r) const {
    const T r3 = r * r * r;
    return {defect_ * r3 / 3, r3 * r / 4 * first_,
            r3 * r * r / 5 * (defect_ / 3 * S::Matrix::Identity() + second_)};
  }

 private:
  T defect_ = 2 * std::numbers::pi_v<T>;
  Vector first_ = Vector::Zero();
  typename S::Matrix second_ = S::Matrix::Zero();
};

}  // namespace moreau::detail
