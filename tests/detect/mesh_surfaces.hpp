// SPDX-License-Identifier: MIT
// Surfaces with ridges, valleys, corners, steps and rims for tests of mesh walls, for grains of 20 mm, and
// the gap between a convex shape and the union of the facets of a mesh, which knows no ridges.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "moreau/detect/collide.hpp"
#include "moreau/detect/pairs/collide_mesh_wall.hpp"
#include "moreau/sample/random_rotation.hpp"
#include "moreau/shape/regular_shape.hpp"

#include "conformance/random_direction.hpp"

namespace mesh_surfaces {

using namespace moreau;
using Profile =
    std::vector<Eigen::Vector2d>;  ///< (x, z) [mm], from right to left: the outside is above

/// A profile with its name.
struct Named {
  const char* name;
  Profile profile;
};

inline Profile stairs() {
  Profile p;
  for (int i = 0; i < 6; ++i) {
    p.push_back({40 - 12 * i, 7 * i});
    p.push_back({28 - 12 * i, 7 * i});
  }
  return p;
}
inline Profile round_step() {
  Profile p{{60, 0}, {0, 0}};
  for (int k = 0; k <= 10; ++k) {
    const double a = k * std::numbers::pi / 20;
    p.push_back({-3 + 3 * std::cos(a), 5 + 3 * std::sin(a)});
  }
  p.push_back({-60, 8});
  return p;
}
inline Profile waves() {
  Profile p;
  for (int i = 25; i >= -25; --i)
    p.push_back({2 * i, 4 * std::cos(2 * std::numbers::pi * i / 15.)});
  return p;
}
inline std::vector<Named> profiles() {
  return {{"step", {{60, 0}, {0, 0}, {0, 8}, {-60, 8}}},
          {"low step", {{60, 0}, {0, 0}, {0, 0.1}, {-60, 0.1}}},
          {"stairs", stairs()},
          {"corner", {{60, 0}, {0, 0}, {0, 60}}},
          {"acute valley", {{60, 0}, {0, 0}, {50, 50}}},
          {"valley", {{60, 20}, {0, 0}, {-60, 20}}},
          {"shallow valley", {{60, 1}, {0, 0}, {-60, 1}}},
          {"trough", {{40, 40}, {3, 0}, {-3, 0}, {-40, 40}}},
          {"edge", {{60, 0}, {0, 0}, {0, -60}}},
          {"knife", {{30, -60}, {0, 0}, {-30, -60}}},
          {"roof", {{60, -20}, {0, 0}, {-60, -20}}},
          {"dam", {{60, 0}, {0, 0}, {0, 3}, {-3, 3}, {-3, -50}}},
          {"low dam", {{60, 0}, {0, 0}, {0, 0.05}, {-0.05, 0.05}, {-0.05, -50}}},
          {"round step", round_step()},
          {"waves", waves()},
          {"plate", {{60, 0}, {0, 0}}},
          {"gutter", {{60, 0}, {0, 0}, {0, 5}}}};
}

/// The profile as segments [m].
template <class T>
FacetMesh<Space<2, T>> surface(Space<2, T>, const Profile& profile) {
  FacetMesh<Space<2, T>> mesh;
  for (std::uint32_t i = 0; i < profile.size(); ++i) {
    mesh.vertices.push_back((1e-3 * profile[i]).template cast<T>());
    if (i > 0) mesh.facets.push_back({i - 1, i});
  }
  return mesh;
}
/// The profile over 100 mm along y, in strips whose widths and diagonals are random [m].
template <class T>
FacetMesh<Space<3, T>> surface(Space<3, T>, const Profile& profile) {
  constexpr std::uint32_t strips = 5;
  FacetMesh<Space<3, T>> mesh;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> aside(-0.3, 0.3);
  for (const auto& p : profile)
    for (std::uint32_t j = 0; j <= strips; ++j) {
      const double y = (j + (j > 0 && j < strips ? aside(random) : 0)) / strips - 0.5;
      mesh.vertices.push_back(Eigen::Vector3d(1e-3 * p[0], 0.1 * y, 1e-3 * p[1]).cast<T>());
    }
  for (std::uint32_t i = 0; i + 1 < profile.size(); ++i)
    for (std::uint32_t j = 0; j < strips; ++j) {
      const std::uint32_t at = i * (strips + 1) + j, next = at + strips + 1;
      if (random() % 2 == 0) {
        mesh.facets.push_back({at, at + 1, next + 1});
        mesh.facets.push_back({at, next + 1, next});
      } else {
        mesh.facets.push_back({at, at + 1, next});
        mesh.facets.push_back({at + 1, next + 1, next});
      }
    }
  return mesh;
}
/// The same surface, with vertices, facets and corners in another order.
template <class S>
FacetMesh<S> shuffled(const FacetMesh<S>& mesh, std::uint32_t seed) {
  std::mt19937 random(seed);
  FacetMesh<S> other = mesh;
  std::vector<std::uint32_t> to(mesh.vertices.size());
  for (std::uint32_t i = 0; i < to.size(); ++i) to[i] = i;
  std::shuffle(to.begin(), to.end(), random);
  for (std::size_t i = 0; i < to.size(); ++i) other.vertices[to[i]] = mesh.vertices[i];
  std::shuffle(other.facets.begin(), other.facets.end(), random);
  for (auto& facet : other.facets) {
    for (auto& v : facet) v = to[v];
    if (S::dim == 3)
      std::rotate(facet.begin(), facet.begin() + std::ptrdiff_t(random() % 3), facet.end());
  }
  return other;
}

/// Boxes and hulls of random points, with a circumradius of at most 10 to 17 mm.
template <class ShapeT>
std::vector<ShapeT> grains() {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  std::vector<ShapeT> list;
  for (const double thin : {0.01, 0.002}) {
    Vector half = Vector::Constant(T(0.01));
    half[S::dim - 1] = T(thin);
    list.push_back(cuboid<ShapeT>(half));
  }
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 3; ++k) {
    std::vector<Vector> points;
    for (int i = 0; i < 10 + 4 * k; ++i) {
      Vector x;
      for (auto& c : x) c = T(normal(random));
      points.push_back(T(0.01) * x.normalized());
    }
    list.emplace_back(points);
  }
  return list;
}

/// A facet as a convex core, relative to the mean of its corners.
template <class S>
struct FacetCore {
  using Space = S;
  typename S::Matrix corners;  // as columns
  typename S::Vector support(const typename S::Vector& d) const {
    int best = 0;
    for (int k = 1; k < S::dim; ++k)
      if (d.dot(corners.col(k)) > d.dot(corners.col(best))) best = k;
    return corners.col(best);
  }
  Aabb<S> bounding_box(const Pose<S>& pose) const {
    Aabb<S> box;
    for (int k = 0; k < S::dim; ++k) box.merge(pose(corners.col(k)));
    return box;
  }
};
/// The gap between a shape and a facet, by GJK and EPA; at most about `within` [m].
template <class S, class ShapeT>
double facet_gap(const MeshWall<S>& wall, std::uint32_t k, const Placed<ShapeT>& shape,
                 double within) {
  if (!wall.box(k).overlaps(shape.bounding_box().inflated(within))) return within;
  const auto& corners = wall.side(k).corners;
  const typename S::Vector middle = corners.rowwise().mean();
  const FacetCore<S> core{corners.colwise() - middle};
  const Placed<FacetCore<S>> placed(core, {middle, S::identity()});
  return detail::ConvexPair<ShapeT, FacetCore<S>>(shape, placed).distance(within).gap;
}
/// The least gap between a shape and the facets; at most `within` [m].
template <class S, class ShapeT>
double union_gap(const MeshWall<S>& wall, const Placed<ShapeT>& shape, double within) {
  double least = within;
  const auto box = shape.bounding_box();
  wall.tree().query(
      [&](const Aabb<S>& b) { return b.overlaps(box.inflated(least)); },
      [&](std::uint32_t k) { least = std::min(least, facet_gap(wall, k, shape, least)); });
  return least;
}
/// Moves a shape along -up until it touches a facet.
/// @returns whether it touches, within 160 mm
template <class S, class ShapeT>
bool lower(const MeshWall<S>& wall, const typename S::Vector& up, Placed<ShapeT>& shape) {
  if (union_gap(wall, shape, 0.02) < 2e-5) return false;  // it starts in the wall
  typename S::Vector at = shape.center();
  double path = 0;
  for (int i = 0; i < 400 && path < 0.16; ++i) {
    const double gap = union_gap(wall, shape, 0.02);
    if (gap < 2e-13) return true;
    at -= gap * up;
    path += gap;
    shape.move_to(at);
  }
  return false;
}

/// A contact point with its normal towards the shape.
template <class S>
struct Point {
  typename S::Vector position, normal;
  double gap;
  bool is_of_face;
};
/// The contacts with gaps of at most `largest` [m]; the facets within the margin decide.
template <class ShapeT>
std::vector<Point<SpaceOf<ShapeT>>> contacts(const Placed<ShapeT>& shape,
                                             const MeshWall<SpaceOf<ShapeT>>& wall, double margin,
                                             double largest) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  std::vector<Point<S>> points;
  Manifold<S> manifold;
  MeshScratch scratch;
  MeshNeighbours<S> near;
  near.update(wall, shape.bounding_box().inflated(T(margin)));
  collide_each(shape, wall, T(margin), T(largest), near, scratch, manifold,
               [&](std::uint32_t face) {
                 for (const auto& p : manifold.points)
                   points.push_back(
                       {p.position, -manifold.normal, double(p.gap), face != MeshWall<S>::none});
               });
  return points;
}
template <class ShapeT>
std::vector<Point<SpaceOf<ShapeT>>> contacts(const Placed<ShapeT>& shape,
                                             const MeshWall<SpaceOf<ShapeT>>& wall, double margin) {
  using S = SpaceOf<ShapeT>;
  std::vector<Point<S>> points;
  Manifold<S> manifold;
  MeshScratch scratch;
  collide_each(shape, wall, typename S::Scalar(margin), scratch, manifold, [&](std::uint32_t face) {
    for (const auto& p : manifold.points)
      points.push_back({p.position, -manifold.normal, double(p.gap), face != MeshWall<S>::none});
  });
  return points;
}

/// A random point of a facet, often on a ridge, and a direction away from it: of every fourth t the normal.
template <class S>
struct AboveFacet {
  typename S::Vector point, up;
};
template <class S>
AboveFacet<S> above_facet(const MeshWall<S>& wall, int t, std::mt19937_64& random) {
  using Vector = typename S::Vector;
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto& side = wall.side(random() % wall.size());
  Vector w;
  for (auto& x : w) x = uniform(random);
  if (t % 3 != 0) w[int(random() % S::dim)] = 0;
  Vector up = side.normal;
  if (t % 4 != 0) up = (up + conformance::random_direction<S>(random)).normalized();
  return {side.corners * w / w.sum(), up};
}

}  // namespace mesh_surfaces
