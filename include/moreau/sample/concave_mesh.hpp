// SPDX-License-Identifier: MIT
// Meshes of concave grains: a pebble with dents, a tetrapod, and a ballast stone from which lumps
// have been broken. They are star-shaped: each ray from the origin crosses the surface once. In the
// plane the same functions give outlines (of the tetrapod one with three legs).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/mesh/facet_mesh.hpp"
#include "moreau/mesh/surface_mesh.hpp"
#include "moreau/shape/ball.hpp"

namespace moreau {

/// A star-shaped surface: closed, oriented, in one piece.
/// @param radius   function: unit direction -> distance of the surface from the origin [m], > 0
/// @param fineness resolution, 0 to 6: 20 * 4^fineness triangles, in the plane 8 * 2^fineness
///                 segments
/// @throws std::invalid_argument if the fineness is not in this range, or a distance is not finite and > 0
template <EuclideanSpace S, class Radius>
FacetMesh<S> star_mesh(const Radius& radius, int fineness = 3) {
  SurfaceMesh<S> sphere;
  SurfaceMesher<S>(fineness).mesh(BallIn<S>(1), sphere);
  FacetMesh<S> mesh;
  for (const auto& direction : sphere.points) {
    const typename S::Vector unit = direction.normalized();
    const auto distance = radius(unit);
    require(std::isfinite(distance) && distance > 0, "star_mesh", "radius", distance,
            "m must be finite and > 0");
    mesh.vertices.push_back(distance * unit);
  }
  // A face of the sphere is a triangle; in the plane the outline is one face. Both are cut into
  // facets with D corners, beginning at each corner of the face in the plane.
  std::size_t begin = 0;
  for (const std::int32_t last : sphere.ends) {
    const auto end = std::size_t(last), count = end - begin;
    const std::size_t facets = count > std::size_t(S::dim) ? count : 1;
    for (std::size_t f = 0; f < facets; ++f) {
      auto& facet = mesh.facets.emplace_back();
      for (std::size_t k = 0; k < facet.size(); ++k)
        facet[k] = std::uint32_t(sphere.corners[begin + (f + k) % count]);
    }
    begin = end;
  }
  return mesh;
}

namespace detail {

/// A direction that is distributed evenly.
template <class S, class Random>
typename S::Vector even_direction(Random& random) {
  std::normal_distribution<double> normal;
  typename S::Vector x = S::Vector::Zero();
  while (x.norm() <= typename S::Scalar(1e-3))
    for (auto& coordinate : x) coordinate = static_cast<typename S::Scalar>(normal(random));
  return x.normalized();
}

/// The D + 1 directions from the centre of a regular simplex to its corners.
template <class S>
std::array<typename S::Vector, S::dim + 1> simplex_directions() {
  using T = typename S::Scalar;
  std::array<typename S::Vector, S::dim + 1> corners;
  for (auto& corner : corners) corner.setZero();
  for (int i = 0; i < S::dim; ++i) {
    auto& own = corners[std::size_t(i)];
    own[i] = std::sqrt(1 - own.squaredNorm());
    for (std::size_t k = std::size_t(i) + 1; k < corners.size(); ++k)
      corners[k][i] = (T(-1) / T(S::dim) - own.dot(corners[k])) / own[i];
  }
  return corners;
}

}  // namespace detail

/// A pebble: a ball from which round dents have been pressed.
/// @param radius   [m], > 0
/// @param dents    their number, >= 0; each is about 0.3 radii deep and 60 degrees wide
/// @param seed     of the random directions of the dents
/// @param fineness see star_mesh()
/// @throws std::invalid_argument outside these ranges
template <EuclideanSpace S>
FacetMesh<S> pebble_mesh(typename S::Scalar radius, int dents, std::uint64_t seed,
                         int fineness = 3) {
  using T = typename S::Scalar;
  require_positive(radius, "pebble_mesh", "radius");
  require(dents >= 0, "pebble_mesh", "dents", dents, "must be >= 0");
  std::mt19937_64 random(seed);
  std::vector<typename S::Vector> at;
  for (int k = 0; k < dents; ++k) at.push_back(detail::even_direction<S>(random));
  return star_mesh<S>(
      [&](const typename S::Vector& u) {
        T height = 1;
        for (const auto& dent : at) {
          const T from = (1 - u.dot(dent)) / T(0.13);  // 1 at 30 degrees
          if (from < 1) height -= T(0.3) * (1 - from) * (1 - from);
        }
        return radius * std::max(height, T(0.3));
      },
      fineness);
}

/// A tetrapod: D + 1 legs along the directions of a regular simplex.
/// @param length of the legs, from the origin [m], > 0
/// @param width  of the legs: their radius [m], > 0 and < length
/// @param fineness see star_mesh()
/// @throws std::invalid_argument outside these ranges, and for legs so thin that the end of one has fewer than D vertices:
///         such a leg would be a spike, shorter than the others
template <EuclideanSpace S>
FacetMesh<S> tetrapod_mesh(typename S::Scalar length, typename S::Scalar width, int fineness = 4) {
  using T = typename S::Scalar;
  require(width > 0 && width < length, "tetrapod_mesh", "width", width,
          "m must be > 0 and < length");
  const auto legs = detail::simplex_directions<S>();
  FacetMesh<S> mesh = star_mesh<S>(
      [&](const typename S::Vector& u) {
        T reach = width;
        for (const auto& leg : legs) {
          const T cosine = u.dot(leg), sine = std::sqrt(std::max(1 - cosine * cosine, T(0)));
          if (cosine <= 0) continue;
          reach = std::max(reach, std::min(length / cosine, sine > 0 ? width / sine : length));
        }
        return reach;
      },
      fineness);
  for (const auto& leg : legs) {
    const auto at_end =
        std::count_if(mesh.vertices.begin(), mesh.vertices.end(),
                      [&](const typename S::Vector& x) { return x.dot(leg) > T(0.99) * length; });
    require(at_end >= S::dim, "tetrapod_mesh", "fineness", fineness,
            "is too low for legs so thin: take a higher one, or wider legs");
  }
  return mesh;
}

/// A ballast stone with concavities: a convex body of random planes, of which lumps are missing.
/// @param radius [m], > 0: the planes lie at 0.75 to 1 radii
/// @param lumps  number of missing lumps, >= 0: each leaves a hollow about 0.25 radii deep
/// @param seed     of the random planes and lumps
/// @param fineness see star_mesh()
/// @throws std::invalid_argument outside these ranges
template <EuclideanSpace S>
FacetMesh<S> ballast_mesh(typename S::Scalar radius, int lumps, std::uint64_t seed,
                          int fineness = 4) {
  using T = typename S::Scalar;
  require_positive(radius, "ballast_mesh", "radius");
  require(lumps >= 0, "ballast_mesh", "lumps", lumps, "must be >= 0");
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> offset(0.75, 1);
  struct Plane {
    typename S::Vector normal;
    T offset;
  };
  std::vector<Plane> planes;
  for (int k = 0; k < 12 * (S::dim - 1); ++k)
    planes.push_back({detail::even_direction<S>(random), T(offset(random))});
  for (const auto& direction : detail::simplex_directions<S>())  // so that the body is bounded
    planes.push_back({direction, T(1)});
  std::vector<typename S::Vector> hollows;
  for (int k = 0; k < lumps; ++k) hollows.push_back(detail::even_direction<S>(random));
  return star_mesh<S>(
      [&](const typename S::Vector& u) {
        T reach = T(1.3);
        for (const Plane& plane : planes)
          if (plane.normal.dot(u) > 0) reach = std::min(reach, plane.offset / plane.normal.dot(u));
        for (const auto& hollow : hollows) {
          // A ball of radius 0.55 about a point at 1.1: its near side cuts the ray.
          const T along = T(1.1) * u.dot(hollow), root = along * along - T(1.21) + T(0.3025);
          if (along > 0 && root > 0) reach = std::min(reach, along - std::sqrt(root));
        }
        return radius * reach;
      },
      fineness);
}

}  // namespace moreau
