// SPDX-License-Identifier: MIT
// Contacts with mesh walls where a shape overlaps the wall beside ridges, in valleys and corners and at
// rims: none is deeper than the overlap, none is missing, and none depends on the order of the triangles.
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <doctest/doctest.h>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "moreau/detect/pairs/collide_mesh_wall.hpp"
#include "moreau/sample/concave_mesh.hpp"
#include "moreau/sample/random_rotation.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/capsule.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/shape/rounded.hpp"

#include "conformance/random_direction.hpp"
#include "detect/mesh_surfaces.hpp"
#include "types.hpp"

namespace {

using namespace moreau;
using namespace mesh_surfaces;
constexpr double grain_size = 0.02, margin = 0.02 * grain_size;  // [m]

/// What was found over many poses.
struct Tally {
  int poses = 0, wanted = 0, missing = 0, too_deep = 0, aside = 0;
};

/// A shape between half-spaces {x : normal . x <= 0}, at given depths below their planes.
template <class ShapeT>
class AmongHalfSpaces {
 public:
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;

  AmongHalfSpaces(const FacetMesh<S>& mesh, const std::vector<Vector>& normals)
      : wall_(mesh), normals_(normals) {}
  /// Compares the contacts with those of the half-spaces: each vertex below a plane touches it, where it is
  /// not far from the facets; no contact has another normal.
  void check(const ShapeT& grain, const typename S::Rotation& turn,
             const std::vector<double>& depth, Tally& tally) const {
    Placed<ShapeT> shape(grain, {Vector::Zero(), turn});
    typename S::Matrix rows = S::Matrix::Identity();  // without a third plane: y = 3.7 mm
    Vector heights = Vector::Zero();
    if constexpr (S::dim == 3) rows.row(2) = Vector::UnitY(), heights[2] = T(0.0037);
    for (std::size_t i = 0; i < normals_.size(); ++i) {
      rows.row(int(i)) = normals_[i].transpose();
      heights[int(i)] = shape.vertices().reach(-normals_[i]) - T(depth[i]);
    }
    shape.move_to(rows.inverse() * heights);
    for (const Vector& n : normals_)
      if (!(n.dot(shape.center()) > T(2e-4))) return;
    ++tally.poses;
    const auto found = contacts(shape, wall_, margin);
    const double deepest = *std::max_element(depth.begin(), depth.end());
    for (const auto& point : found) {
      const auto is_normal = [&](const Vector& n) { return (n - point.normal).norm() < T(1e-5); };
      tally.aside += std::none_of(normals_.begin(), normals_.end(), is_normal);
      tally.too_deep += point.gap < -deepest - tolerance();
    }
    for (std::size_t v = 0; v < shape.vertices().size(); ++v)
      for (const Vector& n : normals_) {
        const Vector x = shape.center() + shape.vertices()[v];
        const T gap = n.dot(x);
        if (!(gap < -2 * tolerance()) || !is_near_face(n, x, 0.9 * margin)) continue;
        ++tally.wanted;
        const auto is_it = [&](const auto& point) {
          return (point.normal - n).norm() < T(1e-5) && std::abs(point.gap - gap) < tolerance() &&
                 (point.position - (x - gap / 2 * n)).norm() < 1e-7 + tolerance();
        };
        tally.missing += std::none_of(found.begin(), found.end(), is_it);
      }
  }

 private:
  double tolerance() const {
    return 2e-9 + 2 * double(wall_.flatness()) +
           (std::same_as<T, float> ? grain_size * double(DetectionTolerance<T>::coincident) : 0);
  }
  bool is_near_face(const Vector& n, const Vector& x, double distance) const {
    for (std::size_t k = 0; k < wall_.size(); ++k) {
      if (!(wall_.side(k).normal.dot(n) > T(1 - 5e-7))) continue;
      const Vector projected = x - n.dot(x) * n;
      const typename S::Matrix corners = wall_.side(k).corners.colwise() - projected;
      if (double(moreau::detail::nearest_on_facet(corners).norm()) < distance) return true;
    }
    return false;
  }

  MeshWall<S> wall_;
  std::vector<Vector> normals_;
};

/// Depths below the planes of up to 1.5 % of the grain size, often none and often equal.
std::vector<double> depths(std::mt19937_64& random) {
  std::vector<double> list;
  for (int i = 0; i < 3; ++i) list.push_back(std::array{0.0, 1e-6, 1e-5, 1e-4, 3e-4}[random() % 5]);
  if (random() % 2 == 0)
    for (double& d : list) d *= std::uniform_real_distribution<double>(0, 1)(random);
  return list;
}

void check_tally(const Tally& tally) {
  CHECK(tally.wanted > 0);
  CHECK(tally.missing == 0);
  CHECK(tally.too_deep == 0);
  CHECK(tally.aside == 0);
}

}  // namespace

TEST_CASE_TEMPLATE("vertices below a valley touch both faces, as at two half-spaces", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Polygon<>), (Polyhedron<float>, Polygon<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  std::mt19937_64 random(3);
  const auto shapes = grains<ShapeT>();
  for (const double angle :
       {20.0, 45.0, 60.0, 89.9, 90.0, 90.1, 120.0, 150.0, 170.0, 179.0, 179.9}) {
    const double a = angle * std::numbers::pi / 180;
    const Profile profile{{1000, 0}, {0, 0}, {1000 * std::cos(a), 1000 * std::sin(a)}};
    Vector first = Vector::Unit(S::dim - 1), second = Vector::Zero();
    second[0] = T(std::sin(a));
    second[S::dim - 1] = T(-std::cos(a));
    const AmongHalfSpaces<ShapeT> valley(shuffled(surface(S{}, profile), 4), {first, second});
    Tally tally;
    for (std::size_t k = 0; k < 60; ++k)
      valley.check(shapes[k % shapes.size()],
                   k % 3 == 0 ? S::identity() : random_rotation<S>(random), depths(random), tally);
    CAPTURE(angle);
    check_tally(tally);
  }
}

TEST_CASE_TEMPLATE("vertices below a corner of three faces touch them, as at three half-spaces",
                   ShapeT, MOREAU_TYPES((Polyhedron<>), (Polyhedron<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const auto shapes = grains<ShapeT>();
  Tally tally;
  for (int k = 0; k < 40; ++k) {
    std::array<Vector, 3> edge{Vector::UnitX(), Vector::UnitY(), Vector::UnitZ()};
    if (k % 2 != 0)
      for (Vector& e : edge) {
        for (auto& c : e) c = T(normal(random));
        e.normalize();
      }
    if (edge[0].cross(edge[1]).dot(edge[2]) < 0) std::swap(edge[0], edge[1]);
    if (edge[0].cross(edge[1]).dot(edge[2]) < T(0.2)) continue;
    const std::uint32_t fan = std::uint32_t(k) / 2 % 5 + 1;  // triangles of a face at the corner
    FacetMesh<S> mesh{{Vector::Zero()}, {}};
    std::vector<Vector> normals;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector next = edge[(i + 1) % 3];
      normals.push_back(edge[i].cross(next).normalized());
      for (std::uint32_t f = 0; f < fan; ++f) {
        const T w = T(f) / T(fan);
        mesh.vertices.push_back(T(0.5) * ((1 - w) * edge[i] + w * next).normalized());
      }
    }
    for (std::uint32_t i = 0; i < 3 * fan; ++i)
      mesh.facets.push_back({0, 1 + i, 1 + (i + 1) % (3 * fan)});
    const AmongHalfSpaces<ShapeT> corner(shuffled(mesh, std::uint32_t(k)), normals);
    for (std::size_t j = 0; j < 10; ++j)
      corner.check(shapes[j % shapes.size()],
                   j % 3 == 0 ? S::identity() : random_rotation<S>(random), depths(random), tally);
  }
  check_tally(tally);
}

namespace {

/// A shape that touches a wall, and then overlaps it by moving on: the overlap is not deeper than the way.
template <class ShapeT>
struct Approach {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  int poses = 0, too_deep = 0, missing = 0, sliding = 0, by_order = 0;

  void check(const MeshWall<S>& wall, const MeshWall<S>& same, Placed<ShapeT>& shape,
             const Vector& up) {
    if (!lower(wall, up, shape)) return;
    if (!is_in_front(wall, shape)) return;
    const Vector touching = shape.center();
    const double tolerance = 6e-9 + wall.flatness();
    for (const double way : {0.0, 2e-8, 2e-7, 2e-6, 2e-5}) {
      shape.move_to(touching - way * up);
      const auto found = contacts(shape, wall, margin);
      double least = 1, resists = 0;
      for (const auto& point : found) {
        least = std::min(least, point.gap);
        if (point.gap <= tolerance) resists = std::max(resists, point.normal.dot(up));
      }
      ++poses;
      too_deep += least < -way - tolerance;
      missing += least > tolerance;
      sliding += way > tolerance && !(resists > 1e-6);
      by_order += !are_equal(found, contacts(shape, same, margin));
    }
  }

 private:
  /// A wall with one side holds only what is in front of it.
  static bool is_in_front(const MeshWall<S>& wall, const Placed<ShapeT>& shape) {
    if (wall.sides() == WallSides::both) return true;
    for (std::uint32_t k = 0; k < wall.size(); ++k)
      if (facet_gap(wall, k, shape, 1e-3) < 2e-9 &&
          wall.side(k).normal.dot(shape.center()) < wall.side(k).offset + 2e-5)
        return false;
    return true;
  }
  static bool are_equal(const std::vector<Point<S>>& some, const std::vector<Point<S>>& others) {
    const auto has = [&](const Point<S>& p) {
      return std::any_of(others.begin(), others.end(), [&](const Point<S>& q) {
        return (p.position - q.position).norm() < 2e-8 && (p.normal - q.normal).norm() < 1e-6 &&
               std::abs(p.gap - q.gap) < 2e-9;
      });
    };
    return some.size() == others.size() && std::all_of(some.begin(), some.end(), has);
  }
};

template <class ShapeT>
void check_approaches(const char* name, const FacetMesh<SpaceOf<ShapeT>>& mesh, int count) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  static const auto shapes = grains<ShapeT>();
  std::mt19937_64 random(11);
  for (const WallSides sides : {WallSides::outside, WallSides::both}) {
    const MeshWall<S> wall(mesh, sides), same(shuffled(mesh, 5), sides);
    Approach<ShapeT> approach;
    for (int t = 0; t < count; ++t) {
      const auto [point, up] = mesh_surfaces::above_facet(wall, t, random);
      const auto turn = t % 2 != 0 ? random_rotation<S>(random) : S::identity();
      const Vector aside = 0.012 * conformance::random_direction<S>(random);
      Placed<ShapeT> shape(shapes[std::size_t(t) % shapes.size()],
                           {point + 0.045 * up + aside, turn});
      approach.check(wall, same, shape, up);
    }
    CAPTURE(name);
    CAPTURE(int(sides));
    CHECK(approach.poses > 0);
    CHECK(approach.too_deep == 0);
    CHECK(approach.missing == 0);
    CHECK(approach.sliding == 0);
    CHECK(approach.by_order == 0);
  }
}

#ifdef MOREAU_TEST_FURTHER_TYPES
constexpr int approaches = 300;  // per surface
#else
constexpr int approaches = 15;
#endif

}  // namespace

// The margin of a pair leaves contacts out whose gap it cannot close, and changes no other.
TEST_CASE_TEMPLATE("contacts with small gaps are those of all contacts within the margin", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Polygon<>, Rounded<Polyhedron<>>),
                                (Polyhedron<float>, Ball<>, Capsule<>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  constexpr double wide = 0.2 * grain_size,
                   rounding = 100 * grain_size * std::numeric_limits<T>::epsilon();
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<ShapeT> shapes;
  if constexpr (std::same_as<ShapeT, Ball<>>)
    shapes = {Ball<>(0.01), Ball<>(0.005)};
  else if constexpr (std::same_as<ShapeT, Capsule<>>)
    shapes = {Capsule<>(0.01, 0.005), Capsule<>(0.01, 0.001)};
  else if constexpr (std::same_as<ShapeT, Rounded<Polyhedron<>>>)
    for (const auto& core : grains<Polyhedron<>>()) shapes.emplace_back(core, 0.002);
  else
    shapes = grains<ShapeT>();
  int near = 0, far = 0;
  for (const auto& [name, profile] : profiles())
    for (const WallSides sides : {WallSides::outside, WallSides::both}) {
      const MeshWall<S> wall(surface(S{}, profile), sides);
      for (std::size_t t = 0; t < 4 * approaches; ++t) {
        const auto& side = wall.side(random() % wall.size());
        Vector w;  // a place on the facet, often on a ridge
        for (auto& x : w) x = T(uniform(random));
        if (t % 3 != 0) w[int(random() % S::dim)] = 0;
        Vector at = side.corners * w / w.sum();
        at += T(0.02 * uniform(random)) * side.normal +
              T(0.005) * conformance::random_direction<S>(random);
        const Placed<ShapeT> shape(shapes[t % shapes.size()], {at, random_rotation<S>(random)});
        auto all = contacts(shape, wall, wide);
        for (const double largest : {0.1 * wide, 0.4 * wide, wide}) {
          const auto some = contacts(shape, wall, wide, largest);
          std::vector<Point<S>> wanted;
          for (const auto& point : all)
            if (T(point.gap) <= T(largest)) wanted.push_back(point);
          near += int(wanted.size());
          far += int(all.size() - wanted.size());
          CAPTURE(std::string(name));
          CAPTURE(int(sides));
          CAPTURE(t);
          CAPTURE(largest);
          CHECK(some.size() == wanted.size());
          if (some.size() != wanted.size()) continue;
          // In any order: which end of an edge finds a contact depends on which ends are near.
          for (const Point<S>& wish : wanted)
            CHECK(std::any_of(some.begin(), some.end(), [&](const Point<S>& point) {
              return (point.position - wish.position).norm() < rounding &&
                     (point.normal - wish.normal).norm() < rounding / grain_size &&
                     std::abs(point.gap - wish.gap) < rounding;
            }));
        }
      }
    }
  CHECK(near > 100);
  CHECK(far > 100);
}

TEST_CASE("no contact is deeper than the way into the wall, none is missing: profiles") {
  for (const auto& [name, profile] : profiles()) {
    check_approaches<Polygon<>>(name, surface(Space<2>{}, profile), 2 * approaches);
    check_approaches<Polyhedron<>>(name, surface(Space<3>{}, profile), approaches);
  }
}

TEST_CASE(
    "no contact is deeper than the way into the wall, none is missing: closed bodies and bowls") {
  using S = Space<3>;
  for (const double radius : {0.02, 0.1}) {
    check_approaches<Polyhedron<>>("pebble", pebble_mesh<S>(radius, 5, 2, 2), approaches);
    check_approaches<Polygon<>>("pebble", pebble_mesh<Space<2>>(radius, 5, 2), approaches);
    check_approaches<Polyhedron<>>("tetrapod", tetrapod_mesh<S>(radius, 0.35 * radius, 3),
                                   approaches);
  }
  FacetMesh<S> bowl = star_mesh<S>([](const auto&) { return 0.05; }, 2);
  for (auto& facet : bowl.facets) std::swap(facet[0], facet[1]);  // the outside is within
  check_approaches<Polyhedron<>>("bowl", bowl, approaches);
}

namespace {

/// A floor of small facets with waves. The last coordinate of its vertices is a height, the others are moved
/// aside by up to 0.3 of a cell.
template <class S>
FacetMesh<S> waves(int n, double cell, double wave, double height, std::uint32_t seed) {
  FacetMesh<S> mesh;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> aside(-0.3 * cell, 0.3 * cell);
  const double k = 2 * std::numbers::pi / wave;
  for (int j = 0; j <= (S::dim == 3 ? n : 0); ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = (i - n / 2) * cell + aside(random), y = (j - n / 2) * cell + aside(random);
      const double z = height * std::sin(k * x) * (S::dim == 3 ? std::cos(k * y) : 1);
      if constexpr (S::dim == 3)
        mesh.vertices.push_back({x, y, z});
      else
        mesh.vertices.push_back({x, z});
    }
  const auto at = [&](int i, int j) { return std::uint32_t(j * (n + 1) + i); };
  for (int i = 0; i < n; ++i)
    if constexpr (S::dim == 3) {
      for (int j = 0; j < n; ++j) {
        mesh.facets.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        mesh.facets.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    } else {
      mesh.facets.push_back({at(i + 1, 0), at(i, 0)});
    }
  return mesh;
}

/// Whether a point lies below a floor, by more than `near`: by the facet above or below it.
template <class S>
bool is_below(const MeshWall<S>& wall, const typename S::Vector& x, double near) {
  for (std::uint32_t k = 0; k < wall.size(); ++k) {
    const auto& side = wall.side(k);
    typename S::Vector at_plane = x;
    const double height = (side.normal.dot(x) - side.offset) / side.normal[S::dim - 1];
    at_plane[S::dim - 1] -= height;
    const auto corners = typename S::Matrix(side.corners.colwise() - at_plane);
    if (moreau::detail::nearest_on_facet(corners).norm() < 1e-12) return height < -near;
  }
  return false;
}

/// Grains as deep in a floor as their centre is above it: each vertex below the floor has a contact.
template <class ShapeT>
void check_deep(double cell, double wave, double height) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  CAPTURE(cell);
  CAPTURE(height);
  static const auto shapes = grains<ShapeT>();
  const auto mesh = waves<S>(int(0.1 / cell), cell, wave, height, 3);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const WallSides sides : {WallSides::outside, WallSides::both}) {
    const MeshWall<S> wall(mesh, sides);
    int wanted = 0, missing = 0;
    for (int t = 0; t < 20 * approaches; ++t) {
      Vector at = 0.02 * conformance::random_direction<S>(random);
      at[S::dim - 1] = height * uniform(random) + 0.006 * (1 + uniform(random));
      if (is_below<S>(wall, at, -1e-4)) continue;
      const Placed<ShapeT> shape(shapes[std::size_t(t) % shapes.size()],
                                 {at, random_rotation<S>(random)});
      const auto found = contacts(shape, wall, margin);
      for (std::size_t v = 0; v < shape.vertices().size(); ++v) {
        const Vector x = shape.center() + shape.vertices()[v];
        if (!is_below<S>(wall, x, 1e-6)) continue;
        ++wanted;
        missing += std::none_of(found.begin(), found.end(), [&](const auto& p) {
          return p.gap < 0 && (p.position + p.gap / 2 * p.normal - x).norm() < 1e-8;
        });
      }
    }
    CHECK(wanted > 10);
    CHECK(missing == 0);
  }
}

}  // namespace

TEST_CASE("a vertex below a floor of small facets has a contact, however deep it is") {
  for (const double cell : {0.004, 0.01, 0.02})
    for (const double height : {0.001, 0.006}) {
      check_deep<Polyhedron<>>(cell, 0.05, height);
      check_deep<Polygon<>>(cell, 0.05, height);
    }
}

namespace {

/// A spike with its tip at the origin, in the plane two segments.
FacetMesh<Space<3>> spike(Space<3>) {
  FacetMesh<Space<3>> mesh{{Space<3>::Vector::Zero()}, {}};
  for (std::uint32_t k = 0; k < 5; ++k) {
    const double angle = 0.4 * std::numbers::pi * k;
    mesh.vertices.push_back({0.02 * std::cos(angle), 0.02 * std::sin(angle), -0.06});
    mesh.facets.push_back({0, 1 + k, 1 + (k + 1) % 5});
  }
  return mesh;
}
FacetMesh<Space<2>> spike(Space<2>) {
  return {{{0.02, -0.06}, {0, 0}, {-0.02, -0.06}}, {{0, 1}, {1, 2}}};
}
/// The same with its outside within.
template <class S>
FacetMesh<S> reversed(FacetMesh<S> mesh) {
  for (auto& facet : mesh.facets) std::swap(facet[0], facet[1]);
  return mesh;
}

/// Rods that come from all directions and overlap a wall by 10 um.
template <class ShapeT>
struct Rods {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  int poses = 0, missing = 0, too_deep = 0;

  void check(const MeshWall<S>& wall, const Vector& point, const Vector& up,
             std::mt19937_64& random) {
    Vector half = Vector::Constant(0.001);
    half[0] = 0.015;
    static const ShapeT rod = cuboid<ShapeT>(half);
    const Vector aside = 0.012 * conformance::random_direction<S>(random);
    Placed<ShapeT> shape(rod, {point + 0.045 * up + aside, random_rotation<S>(random)});
    if (!lower(wall, up, shape)) return;
    shape.move_to(shape.center() - 1e-5 * up);
    const double gap = union_gap(wall, shape, margin);
    if (gap > -1e-6) return;  // it slides past
    ++poses;
    double least = 1;
    for (const auto& contact : contacts(shape, wall, margin)) least = std::min(least, contact.gap);
    missing += least > -1e-7;
    too_deep += least < -1.1e-5;
  }
};

}  // namespace

// The centre of a rod that touches the tip can be behind the planes of some of the faces that join there.
TEST_CASE_TEMPLATE("a rod touches the tip of a spike from all sides", ShapeT, Polygon<>,
                   Polyhedron<>) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  std::mt19937_64 random(5);
  for (const bool is_back : {false, true}) {
    const MeshWall<S> wall(is_back ? reversed(spike(S{})) : spike(S{}),
                           is_back ? WallSides::both : WallSides::outside);
    Rods<ShapeT> rods;
    for (int k = 0; k < 40 * approaches; ++k) {
      const Vector up =
          (Vector::Unit(S::dim - 1) + conformance::random_direction<S>(random)).normalized();
      rods.check(wall, Vector::Zero(), up, random);
    }
    CAPTURE(is_back);
    CHECK(rods.poses > 100);
    CHECK(rods.missing == 0);
  }
}

// The end of a rod beside a crest lies behind the planes of facets on the other side of the wall.
TEST_CASE_TEMPLATE("a rod beside a wavy wall with two sides has no contact with the other side",
                   ShapeT, Polygon<>, Polyhedron<>) {
  using S = SpaceOf<ShapeT>;
  std::mt19937_64 random(6);
  for (const double cell : {0.004, 0.02}) {
    const MeshWall<S> wall(waves<S>(int(0.1 / cell), cell, 0.05, 0.006, 3), WallSides::both);
    Rods<ShapeT> rods;
    for (int k = 0; k < 20 * approaches; ++k) {
      const auto [point, up] = above_facet(wall, k, random);
      if (point.template head<S::dim - 1>().cwiseAbs().maxCoeff() > 0.03)
        continue;  // not at the rim
      rods.check(wall, point, up, random);
    }
    CAPTURE(cell);
    CHECK(rods.poses > 30);
    CHECK(rods.missing == 0);
    CHECK(rods.too_deep == 0);
  }
}

namespace {

/// A pass between two ridges that rise along x and -x, with valleys along y and -y: nothing can touch its lowest point as
/// a tip. With `turned` > 0 one of the valleys is a third ridge, that falls.
FacetMesh<Space<3>> pass(double rise, std::uint32_t turned, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.7, 1.3);
  FacetMesh<Space<3>> mesh{{Space<3>::Vector::Zero()}, {}};
  const std::uint32_t count = 4 + turned;
  const std::array<double, 5> four{0, 90, 180, 270, 0}, five{0, 70, 110, 180, 270};
  for (std::uint32_t k = 0; k < count; ++k) {
    const double angle = (turned > 0 ? five : four)[k] * std::numbers::pi / 180;
    const double slope = std::abs(std::cos(angle)) > 0.9 ? rise : -0.8;
    mesh.vertices.push_back(
        {0.04 * std::cos(angle), 0.04 * std::sin(angle), 0.04 * slope * uniform(random)});
    mesh.facets.push_back({0, 1 + k, 1 + (k + 1) % count});
  }
  return mesh;
}

}  // namespace

// The edge of a rod in a pass lies on two ridges. If it overlaps both, the nearest points on their lines can lie beyond
// their common end.
TEST_CASE(
    "a rod that lies in a pass between two ridges touches both, also beyond their common end") {
  using S = Space<3>;
  using Vector = S::Vector;
  using Rod = Polyhedron<>;
  const Rod rod = cuboid<Rod>(Vector(0.001, 0.015, 0.001));
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const WallSides sides : {WallSides::outside, WallSides::both})
    for (const double rise : {0.05, 0.3, 0.6}) {
      int poses = 0, missing = 0, too_deep = 0, beyond = 0;
      for (int k = 0; k < 20 * approaches; ++k) {
        const MeshWall<S> wall(pass(rise, k % 2, random), sides);
        const S::Rotation turn = S::exp(Vector(0, 0, 0.4 * uniform(random))) *
                                 S::exp(Vector(0.2 * uniform(random), 0, 0)) *
                                 S::exp(Vector(0, std::numbers::pi / 4 + 0.1 * uniform(random), 0));
        Placed<Rod> shape(rod, {Vector::Zero(), turn});
        // The lower edge passes below the pass, by `way`.
        std::size_t lowest = 0;
        for (std::size_t v = 0; v < shape.vertices().size(); ++v)
          if (shape.vertices()[v][2] < shape.vertices()[lowest][2]) lowest = v;
        const Vector edge = turn * Vector(0, shape.vertices()[lowest][1] > 0 ? -0.03 : 0.03, 0);
        const Vector on_edge = shape.vertices()[lowest] + (0.5 + 0.2 * uniform(random)) * edge;
        const double way = std::array{1e-6, 1e-5, 5e-5}[std::size_t(k) % 3];
        shape.move_to(Vector(0.3 * way * uniform(random), 0, -way) - on_edge);
        const double gap = union_gap(wall, shape, margin);
        if (gap > -0.1 * way) continue;
        ++poses;
        const auto found = contacts(shape, wall, margin);
        double right = 1, left = 1;
        for (const auto& contact : found) {
          (contact.normal[0] < 0 ? right : left) =
              std::min(contact.normal[0] < 0 ? right : left, contact.gap);
          too_deep += contact.gap < -1.1 * way;
          beyond += contact.gap < 0 && !contact.is_of_face;
        }
        missing += !(right < -0.1 * way) || !(left < -0.1 * way);
      }
      CAPTURE(int(sides));
      CAPTURE(rise);
      CHECK(poses > 10 * approaches);
      CHECK(missing == 0);
      CHECK(too_deep == 0);
      CHECK(beyond > 0);
    }
}

namespace {

/// Whether a vertex of a wall lies in a shape, deeper than `depth` below each of its faces.
template <class ShapeT>
bool is_pierced(const Placed<ShapeT>& shape, const FacetMesh<SpaceOf<ShapeT>>& mesh, double depth) {
  const auto is_in = [&](const auto& x) {
    return moreau::detail::highest_face(shape, x - shape.center()).value < -depth;
  };
  return std::any_of(mesh.vertices.begin(), mesh.vertices.end(), is_in);
}

/// Thin plates into whose lower face crests reach, up to beyond the middle of the plate: a contact leads out.
template <class ShapeT>
void check_pierced(double cell, double height) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  CAPTURE(cell);
  CAPTURE(height);
  const auto mesh = waves<S>(int(0.1 / cell), cell, 0.05, height, 5);
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const WallSides sides : {WallSides::outside, WallSides::both}) {
    const MeshWall<S> wall(mesh, sides);
    int wanted = 0, missing = 0;
    for (int t = 0; t < 40 * approaches; ++t) {
      Vector half = Vector::Constant(0.01), at = 0.02 * conformance::random_direction<S>(random);
      half[S::dim - 1] = t % 2 != 0 ? 0.002 : 0.001;
      at[S::dim - 1] = height + 0.002 * uniform(random);
      typename S::Angular turn;
      for (auto& x : turn) x = 0.2 * uniform(random);
      const ShapeT plate = cuboid<ShapeT>(half);
      const Placed<ShapeT> shape(plate, {at, S::exp(turn)});
      if (is_below<S>(wall, at, -1e-4) || !is_pierced(shape, mesh, 3e-4)) continue;
      ++wanted;
      const auto found = contacts(shape, wall, margin);
      missing += std::none_of(found.begin(), found.end(), [&](const auto& p) {
        return p.gap < -1.5e-4 && p.normal[S::dim - 1] > 0.3;
      });
    }
    CHECK(wanted > 3);
    // With two sides, where the centre of the plate is below a neighbouring slope, which side counts is open.
    CHECK(missing <= (sides == WallSides::both ? wanted / 20 : 0));
  }
}

/// A flat sieve: strips 10 mm wide around square holes of 30 mm.
FacetMesh<Space<3>> sieve() {
  FacetMesh<Space<3>> mesh;
  std::vector<double> lines;
  for (int k = -3; k <= 3; ++k) lines.insert(lines.end(), {0.04 * k - 0.005, 0.04 * k + 0.005});
  const auto count = static_cast<std::uint32_t>(lines.size());
  for (const double y : lines)
    for (const double x : lines) mesh.vertices.push_back({x, y, 0});
  for (std::uint32_t j = 0; j + 1 < count; ++j)
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
      if (i % 2 == 1 && j % 2 == 1) continue;
      const std::uint32_t at = j * count + i;
      mesh.facets.push_back({at, at + 1, at + count + 1});
      mesh.facets.push_back({at, at + count + 1, at + count});
    }
  return mesh;
}

TEST_CASE("a cube that lies on rims has contacts, and none deeper than it has sunk") {
  using Cube = Polyhedron<>;
  using S = Space<3>;
  using Vector = S::Vector;
  const Cube cube = cuboid<Cube>(Vector(0.018, 0.018, 0.018));
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const WallSides sides : {WallSides::outside, WallSides::both}) {
    const MeshWall<S> wall(sieve(), sides);
    for (const double tilt : {0.0, 1e-6, 1e-4, 1e-2}) {
      int missing = 0, too_deep = 0;
      for (int k = 0; k < 3000; ++k) {
        const S::Rotation turn = S::exp(Vector(tilt * any(random), tilt * any(random), 0)) *
                                 S::exp(Vector(0, 0, 3 * any(random)));
        Placed<Cube> shape(cube, {Vector::Zero(), turn});
        const double sunk = std::pow(10., -5 + 2 * any(random));  // 1e-7 to 1e-3 m
        shape.move_to(Vector(0.05 * any(random), 0.05 * any(random),
                             shape.vertices().reach(-Vector::UnitZ()) - sunk));
        const auto found = contacts(shape, wall, margin);
        missing += found.empty();
        too_deep += std::any_of(found.begin(), found.end(),
                                [&](const auto& point) { return point.gap < -1.01 * sunk - 1e-9; });
      }
      CAPTURE(tilt);
      CHECK(missing == 0);
      CHECK(too_deep == 0);
    }
  }
}

}  // namespace

TEST_CASE(
    "a crest that reaches into a thin plate has a contact that leads out, also beyond its middle") {
  for (const double cell : {0.004, 0.01})
    for (const double height : {0.002, 0.006}) {
      check_pierced<Polyhedron<>>(cell, height);
      check_pierced<Polygon<>>(cell, height);
    }
}
