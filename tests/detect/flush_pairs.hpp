// SPDX-License-Identifier: MIT
// Pairs of convex shapes of which two faces lie on each other to within some roundings, and a check of their contact
// points in long double.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "moreau/detect/collide.hpp"

#include "detect/same_manifold.hpp"
#include "detect/shapes.hpp"

namespace flush {

using Real = long double;

/// A placed shape in long double: the vertices that the narrow phase uses, relative to an origin.
template <class S>
struct Exact {
  static constexpr int dim = S::dim;
  using Vector = Eigen::Matrix<Real, dim, 1>;
  struct Plane {
    Vector normal;
    Real offset;
  };
  std::vector<Vector> vertices;
  std::vector<std::array<std::size_t, 2>> edges;
  std::vector<Plane> planes;  ///< of the faces

  template <class ShapeT>
  Exact(const moreau::Placed<ShapeT>& shape, const typename S::Vector& origin) {
    const Vector at = (shape.center() - origin).template cast<Real>();
    for (std::size_t i = 0; i < std::size_t(shape.vertices().size()); ++i)
      vertices.push_back(typename S::Vector(shape.vertices()[i]).template cast<Real>() + at);
    if constexpr (dim == 2) {
      for (std::size_t i = 0; i < vertices.size(); ++i)
        edges.push_back({i, (i + 1) % vertices.size()});
      for (const auto& [i, j] : edges) {
        const Vector along = vertices[j] - vertices[i];
        add_plane(Vector(along.y(), -along.x()));
      }
    } else {
      for (const auto& edge : shape.shape().edges())
        edges.push_back({edge.vertex[0], edge.vertex[1]});
      for (std::size_t f = 0; f < std::size_t(shape.normals().size()); ++f) {
        const auto loop = shape.shape().face(f);
        Vector normal = Vector::Zero();
        for (std::size_t k = 1; k + 1 < loop.size(); ++k)
          normal += (vertices[loop[k]] - vertices[loop[0]])
                        .cross(vertices[loop[k + 1]] - vertices[loop[0]]);
        add_plane(normal);
      }
    }
  }
  Real reach(const Vector& n) const {
    Real top = n.dot(vertices[0]);
    for (const Vector& x : vertices) top = std::max(top, n.dot(x));
    return top;
  }

  /// The distance of a point from the shape, at least; < 0 inside.
  Real outside(const Vector& x) const {
    Real most = -std::numeric_limits<Real>::infinity();
    for (const Plane& plane : planes) most = std::max(most, plane.normal.dot(x) - plane.offset);
    return most;
  }

 private:
  void add_plane(const Vector& direction) {
    const Vector n = direction.normalized();
    planes.push_back({n, reach(n)});
  }
};

template <class S>
Real separation(const Exact<S>& a, const Exact<S>& b, const typename Exact<S>::Vector& n) {
  return -b.reach(-n) - a.reach(n);
}
/// Distance of a point from a segment.
template <class V>
Real distance_to(const V& x, const V& p, const V& q) {
  const V along = q - p;
  return (x - p - std::clamp<Real>(along.dot(x - p) / along.squaredNorm(), 0, 1) * along).norm();
}
/// The signed gap of two shapes: the largest separation along the normals of all faces and, in space, of all pairs of
/// edges; if it is positive, the least distance of any two features.
template <class S>
Real signed_gap(const Exact<S>& a, const Exact<S>& b) {
  using Vector = typename Exact<S>::Vector;
  Real best = -std::numeric_limits<Real>::infinity();
  for (const auto& plane : a.planes) best = std::max(best, separation(a, b, plane.normal));
  for (const auto& plane : b.planes) best = std::max(best, separation(a, b, Vector(-plane.normal)));
  Real nearest = std::numeric_limits<Real>::infinity();
  for (const auto& [p, q] : a.edges)
    for (const Vector& x : b.vertices)
      nearest = std::min(nearest, distance_to(x, a.vertices[p], a.vertices[q]));
  for (const auto& [p, q] : b.edges)
    for (const Vector& x : a.vertices)
      nearest = std::min(nearest, distance_to(x, b.vertices[p], b.vertices[q]));
  if constexpr (S::dim == 3)
    for (const auto& [p, q] : a.edges)
      for (const auto& [v, w] : b.edges) {
        const Vector u = a.vertices[q] - a.vertices[p], t = b.vertices[w] - b.vertices[v];
        const Vector n = u.cross(t);
        if (!(n.norm() > 1e-15L * u.norm() * t.norm())) continue;
        best = std::max({best, separation(a, b, Vector(n.normalized())),
                         separation(a, b, Vector(-n.normalized()))});
      }
  if (best <= 0) return best;
  Real inner = nearest;
  const auto over = [&](const Exact<S>& own, const Exact<S>& other) {
    for (const auto& plane : own.planes)
      for (const Vector& x : other.vertices) {
        const Real h = plane.normal.dot(x) - plane.offset;
        if (!(h >= 0 && h < inner)) continue;
        const Vector foot = x - h * plane.normal;
        bool inside = true;
        for (const auto& side : own.planes)
          inside = inside && side.normal.dot(foot) <= side.offset + 1e-18L;
        if (inside) inner = h;
      }
  };
  over(a, b);
  over(b, a);
  if constexpr (S::dim == 3)
    for (const auto& [p, q] : a.edges)
      for (const auto& [v, w] : b.edges) {
        const Vector u = a.vertices[q] - a.vertices[p], t = b.vertices[w] - b.vertices[v];
        const Vector n = u.cross(t), d = b.vertices[v] - a.vertices[p];
        const Real n2 = n.squaredNorm();
        if (!(n2 > 1e-30L * u.squaredNorm() * t.squaredNorm())) continue;
        const Real s = d.cross(t).dot(n) / n2, r = d.cross(u).dot(n) / n2;
        if (s >= 0 && s <= 1 && r >= 0 && r <= 1)
          inner = std::min(inner, (d + r * t - s * u).norm());
      }
  return inner;
}

/// The errors of a manifold, in units of epsilon times the size of the pair, except `rim`.
struct Errors {
  Real gap = 0;     ///< of the pair, against signed_gap()
  Real normal = 0;  ///< the gap of the pair minus the separation along the normal
  Real deeper = 0;  ///< the gap of the pair minus that of the deepest point
  Real point =
      0;  ///< how far an end of the gap of a point lies inside its shape, or both ends lie outside
  Real rim =
      0;  ///< how far one end lies outside, in units of DetectionTolerance::coincident times the size
  void take(const Errors& e) {
    gap = std::max(gap, e.gap), normal = std::max(normal, e.normal);
    deeper = std::max(deeper, e.deeper), point = std::max(point, e.point),
    rim = std::max(rim, e.rim);
  }
};

/// The errors of a manifold.
template <class ShapeT>
Errors errors(const moreau::Placed<ShapeT>& a, const moreau::Placed<ShapeT>& b,
              const moreau::Manifold<moreau::SpaceOf<ShapeT>>& manifold) {
  using S = moreau::SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename Exact<S>::Vector;
  const Real size = Real(a.radius() + b.radius()),
             unit = size * Real(std::numeric_limits<T>::epsilon());
  const Exact<S> first(a, a.center()), second(b, a.center());
  const Vector n = manifold.normal.template cast<Real>().normalized();
  const Real gap = Real(manifold.gap), along = separation(first, second, n);
  Errors w;
  w.gap = std::abs(gap - signed_gap(first, second)) / unit;
  w.normal = (gap - along) / unit;
  const Real near = Real(moreau::DetectionTolerance<T>::coincident) * size;
  for (const auto& point : manifold.points) {
    w.deeper = std::max(w.deeper, (gap - Real(point.gap)) / unit);
    const Vector x = (point.position - a.center()).template cast<Real>();
    // The ends of the gap lie on the surfaces. An end can lie up to `near` beyond the rim of a face, because two
    // corners closer together than that count as one; the other end is a corner then.
    const Real on_a = first.outside(Vector(x - Real(point.gap) / 2 * n));
    const Real on_b = second.outside(Vector(x + Real(point.gap) / 2 * n));
    w.point = std::max({w.point, -on_a / unit, -on_b / unit, std::min(on_a, on_b) / unit});
    w.rim = std::max({w.rim, on_a / near, on_b / near});
  }
  return w;
}

template <class T>
struct Random {
  std::mt19937_64& random;
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  bool flip() { return (random() & 1) != 0; }
  double sign() { return flip() ? 1 : -1; }
  /// 0 in a quarter of all cases, else of random sign and of a size of 0.1 to 1000 epsilon.
  double roundings() { return random() % 4 == 0 ? 0 : roundings(0.1, 1000); }
  /// Of random sign and of a size between two numbers of epsilon, which are drawn evenly in their logarithm.
  double roundings(double least, double most) {
    return sign() * std::exp((*this)(std::log(least), std::log(most))) *
           double(std::numeric_limits<T>::epsilon());
  }
};

/// A trapezoid or a triangle on a base at height 0 from `from` to `to`, to a height of the sign of `up`.
template <class T>
moreau::Polygon<T> frustum(Random<T>& rnd, double from, double to, double up) {
  using V = typename moreau::Space<2, T>::Vector;
  const double h = up * std::pow(10, rnd(-1.3, 0.3)), s = rnd.flip() ? 0.5 : 0.02;
  const double l = from + rnd(-s, s), r = std::max(to + rnd(-s, s), l + 0.1);
  std::vector<V> points{V(T(from), T(0)), V(T(to), T(0)), V(T(r), T(h)), V(T(l), T(h))};
  if (rnd.random() % 4 == 0) points = {V(T(from), T(0)), V(T(to), T(0)), V(T((l + r) / 2), T(h))};
  if (rnd.random() % 4 == 0) points.push_back(V(T((l + r) / 2), T(1.2 * h)));
  return moreau::Polygon<T>(std::span<const V>(points));
}
/// Two shapes with their poses.
template <class ShapeT>
struct Pair {
  using S = moreau::SpaceOf<ShapeT>;
  ShapeT a, b;
  moreau::Pose<S> pose_a, pose_b;
};
/// Two shapes whose bases lie on each other to within 0.1 to 1000 roundings, often with the same ends; b is in a quarter
/// of all cases turned about an end of a's base by up to 1 rad.
template <class T>
Pair<moreau::Polygon<T>> pair(moreau::Space<2, T>, std::mt19937_64& random) {
  using S = moreau::Space<2, T>;
  using V = typename S::Vector;
  Random<T> rnd{random};
  const double from = rnd(-0.5, 0), to = from + std::pow(10, rnd(-1, 0));
  double other_from = from, other_to = to;
  if (rnd.random() % 3 == 0) other_from += rnd.flip() ? rnd(-0.3, 0.3) : rnd(-1, 1) * 1e-6;
  if (rnd.random() % 3 == 0) other_to += rnd.flip() ? rnd(-0.3, 0.3) : rnd(-1, 1) * 1e-6;
  if (other_to < other_from + 0.05) other_to = other_from + 0.05;
  const auto a = frustum<T>(rnd, from, to, -1), b = frustum<T>(rnd, other_from, other_to, 1);
  const auto rotation = samples::rotation(S{}, random);
  const V at = samples::direction<S>(random);
  Pair<moreau::Polygon<T>> p{a, b, {}, {}};
  const auto turn = S::exp(typename S::Angular(
      T(random() % 4 == 0 ? rnd.sign() * std::pow(10, rnd(-6, 0)) : rnd.roundings())));
  const V pivot(T(rnd.flip() ? from : to), T(0));
  p.pose_a = {V(rotation * V(a.centroid_of_input()) + at), rotation};
  // The vertices at a shared corner are often farther apart than the edges, by more than the search leaves in doubt.
  const bool is_sharing = rnd.flip();
  const V shift(T(is_sharing ? rnd.roundings(30, 1000) : rnd.roundings()),
                T(is_sharing ? rnd.roundings(0.1, 3) : rnd.roundings()));
  p.pose_b = {V(rotation * V(turn * V(V(b.centroid_of_input()) - pivot) + pivot + shift) + at),
              typename S::Rotation(rotation * turn)};
  return p;
}

/// A frustum on a base at height 0, sometimes with an apex, to a height of the sign of `up`.
template <class T>
moreau::Polyhedron<T> frustum(Random<T>& rnd, const std::vector<std::array<double, 2>>& base,
                              double up) {
  using V = typename moreau::Space<3, T>::Vector;
  const double h = up * std::pow(10, rnd(-1.3, 0.3)), wide = 1 + rnd(-0.5, 0.5),
               s = rnd.flip() ? 0.3 : 0;
  const double x = rnd(-s, s), y = rnd(-s, s), scale = rnd.flip() ? wide : 1;
  std::vector<V> points;
  for (const auto& c : base) {
    points.push_back(V(T(c[0]), T(c[1]), T(0)));
    points.push_back(V(T(x + scale * c[0]), T(y + scale * c[1]), T(h)));
  }
  if (rnd.random() % 4 == 0) points.push_back(V(T(x), T(y), T(1.2 * h)));
  return moreau::Polyhedron<T>(std::span<const V>(points));
}
/// The corners of a base with 3 to 6 sides.
template <class T>
std::vector<std::array<double, 2>> base_of(Random<T>& rnd) {
  std::vector<std::array<double, 2>> base;
  const int n = 3 + int(rnd.random() % 4);
  const double flat = std::pow(10, rnd(-1, 0));
  if (n == 4 && rnd.flip())
    return {{-0.5, -0.5 * flat}, {0.5, -0.5 * flat}, {0.5, 0.5 * flat}, {-0.5, 0.5 * flat}};
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * (i + rnd(-0.3, 0.3)) / n;
    base.push_back({std::cos(angle), flat * std::sin(angle)});
  }
  return base;
}
template <class T>
Pair<moreau::Polyhedron<T>> pair(moreau::Space<3, T>, std::mt19937_64& random) {
  using S = moreau::Space<3, T>;
  using V = typename S::Vector;
  Random<T> rnd{random};
  auto base = base_of(rnd), other = base;
  switch (random() % 4) {
    case 0:
      other = base_of(rnd);
      break;
    case 1:
      for (auto& c : other) c[0] += 0.3;
      break;
    case 2:
      other[0] = {1.3 * other[0][0], 1.3 * other[0][1]};
      break;
    default:
      break;
  }
  const auto a = frustum<T>(rnd, base, -1), b = frustum<T>(rnd, other, 1);
  const auto rotation = samples::rotation(S{}, random);
  const V at = samples::direction<S>(random);
  Pair<moreau::Polyhedron<T>> p{a, b, {}, {}};
  V by;
  for (auto& x : by) x = T(rnd.roundings());
  if (random() % 4 == 0) by = V(samples::direction<S>(random) * T(std::pow(10, rnd(-6, 0))));
  const auto turn = S::exp(typename S::Angular(by));
  const auto& at_corner = base[random() % base.size()];
  const V pivot{T(at_corner[0]), T(at_corner[1]), T(0)};
  V shift;
  const bool is_sharing = rnd.flip();
  for (int k = 0; k < 2; ++k) shift[k] = T(is_sharing ? rnd.roundings(30, 1000) : rnd.roundings());
  shift[2] = T(is_sharing ? rnd.roundings(0.1, 3) : rnd.roundings());
  p.pose_a = {V(rotation * V(a.centroid_of_input()) + at), rotation};
  p.pose_b = {V(rotation * V(turn * V(V(b.centroid_of_input()) - pivot) + pivot + shift) + at),
              typename S::Rotation(rotation * turn)};
  return p;
}

/// Checks the manifolds of random pairs, without a cache and with the cache of the same pair.
template <class T, int dim>
void check_pairs(int count, unsigned seed) {
  using S = moreau::Space<dim, T>;
  std::mt19937_64 random(seed);
  Errors worst;
  const T margin = T(0.002);
  for (int i = 0; i < count; ++i) {
    CAPTURE(i);
    const auto p = pair(S{}, random);
    const moreau::Placed a(p.a, p.pose_a), b(p.b, p.pose_b);
    moreau::Manifold<S> manifold, again;
    moreau::PairCache<S> cache;
    const bool touches = collide(a, b, margin, manifold, cache);
    CHECK(collide(a, b, margin, again, cache) == touches);
    if (!touches) continue;
    CHECK(is_same(again, manifold));
    worst.take(errors(a, b, manifold));
  }
  CAPTURE(sizeof(T));
  // The promise is about 60. Polyhedra apart by a corner, which a face separates by less than a rounding, pass for
  // touching at a few times that (contacts.md).
  CHECK(worst.gap < (dim == 2 ? 128 : 256));
  CHECK(worst.normal < 128);
  CHECK(worst.deeper < 128);
  CHECK(worst.point < 128);
  CHECK(worst.rim < 2);
}

}  // namespace flush
