// SPDX-License-Identifier: MIT
// Pairs of bodies to measure the narrow phase on, made from a fixed seed. The same code makes those
// of every shape and dimension.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "moreau/detect/collide.hpp"
#include "moreau/sample/ballast.hpp"
#include "moreau/shape/compound.hpp"
#include "moreau/shape/rounded.hpp"

namespace pairs {

using moreau::Placed;
using moreau::Pose;
using moreau::Space;
using moreau::SpaceOf;

template <class S>
typename S::Vector random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  typename S::Vector v;
  for (auto& x : v) x = static_cast<typename S::Scalar>(normal(random));
  return v.normalized();
}
template <class T>
Eigen::Rotation2D<T> random_rotation(Space<2, T>, std::mt19937_64& random) {
  return Eigen::Rotation2D<T>(
      static_cast<T>(std::uniform_real_distribution<double>(-3.2, 3.2)(random)));
}
template <class T>
Eigen::Quaternion<T> random_rotation(Space<3, T>, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Eigen::Quaternion<T> q;
  for (auto& x : q.coeffs()) x = static_cast<T>(normal(random));
  return q.normalized();
}

/// A polyhedron with `count` vertices, all on an ellipsoid.
template <class T>
moreau::Polyhedron<T> with_vertices(Space<3, T>, std::size_t count, std::mt19937_64& random) {
  using Vector = typename Space<3, T>::Vector;
  std::vector<Vector> points;
  while (points.size() < count) {
    const Vector x = random_direction<Space<3, T>>(random);
    // The points are spread evenly, so that no four of them make a splinter.
    const bool is_near = std::any_of(points.begin(), points.end(), [&](const Vector& y) {
      return (x - y).norm() * std::sqrt(static_cast<T>(count)) < T(1.6);
    });
    if (!is_near) points.push_back(x);
  }
  for (Vector& x : points) x = x.cwiseProduct(Vector(1, T(0.85), T(0.7)));
  return moreau::Polyhedron<T>(std::span<const Vector>(points));
}
/// A polygon with `count` vertices, all on an ellipse.
template <class T>
moreau::Polygon<T> with_vertices(Space<2, T>, std::size_t count, std::mt19937_64& random) {
  using Vector = typename Space<2, T>::Vector;
  std::uniform_real_distribution<double> part(0.2, 0.8);
  std::vector<Vector> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle =
        2 * std::numbers::pi * (static_cast<double>(i) + part(random)) / static_cast<double>(count);
    points.emplace_back(static_cast<T>(std::cos(angle)), static_cast<T>(0.8 * std::sin(angle)));
  }
  return moreau::Polygon<T>(std::span<const Vector>(points));
}

/// How near the shapes of a pair are: the distance of the centres is that at which they touch, plus
/// a fraction of the smaller diameter that is drawn uniformly from [from, to].
struct Situation {
  const char* name;
  double from, to;
  bool faces_are_aligned = false;  ///< one of each, but for half a degree
};
inline constexpr Situation touching{"touching", -0.005, 0.005};
inline constexpr Situation overlapping{"overlapping", -0.02, -0.005};
inline constexpr Situation near{"near", 0.006, 0.02};
inline constexpr Situation apart{"apart", 0.01, 0.15};
inline constexpr Situation aligned{"aligned", -0.005, 0.005, true};
inline constexpr double margin_over_diameter = 0.005;

/// Radius of a ball about the centre of a placed shape that contains the shape.
template <class ShapeT>
auto radius_of(const Placed<ShapeT>& placed) {
  if constexpr (requires { placed.radius(); }) {
    return placed.radius();
  } else {
    const auto box = placed.bounding_box();
    return (box.lower - placed.center())
        .cwiseAbs()
        .cwiseMax((box.upper - placed.center()).cwiseAbs())
        .norm();
  }
}

/// Moves the centre of a placed shape, world axes [m].
/// @param rotation with which the shape was placed
template <class ShapeT>
void move_to(Placed<ShapeT>& placed, const ShapeT& shape,
             const typename SpaceOf<ShapeT>::Rotation& rotation,
             const typename SpaceOf<ShapeT>::Vector& center) {
  if constexpr (requires { placed.move_to(center); })
    placed.move_to(center);
  else
    placed.update(shape, {center, rotation});
}

/// The distance of b's centre from a's along the line at which they touch.
/// @param move function that moves the centre of b
template <class ShapeT>
auto touching_distance(const Placed<ShapeT>& a, Placed<ShapeT> b,
                       const typename Placed<ShapeT>::Vector& line, const auto& move) {
  auto inside = typename Placed<ShapeT>::Scalar(0), outside = radius_of(a) + radius_of(b);
  for (int k = 0; k < 50; ++k) {
    const auto middle = (inside + outside) / 2;
    move(b, a.center() + middle * line);
    (overlap(a, b) ? inside : outside) = middle;
  }
  return inside;
}

/// Bodies at the origin in random orientations, and pairs of them with the position of the second
/// body. 600 bodies do not fit into the caches next to the core, as those of a simulation do not.
template <class ShapeT>
struct Pairs {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  struct Pair {
    std::size_t a, b;
    Vector offset;
    T margin;
  };
  std::vector<ShapeT> shapes;
  std::vector<Pose<S>> poses;
  std::vector<Placed<ShapeT>> bodies;
  std::vector<Pair> list;

  Pairs(const Situation& situation, std::size_t count, std::vector<ShapeT> shapes_in)
      : shapes(std::move(shapes_in)) {
    std::mt19937_64 random(1);
    for (std::size_t k = 0; k < 3 * shapes.size(); ++k)
      add_body(k % shapes.size(), random_rotation(S{}, random));
    while (list.size() < count) add(situation, random);
  }
  const ShapeT& shape_of(std::size_t body) const { return shapes[shape_index_[body]]; }
  /// Moves the centre of a body, or of a copy of it, world axes [m].
  void move_to(std::size_t body, Placed<ShapeT>& placed, const Vector& center) const {
    pairs::move_to(placed, shape_of(body), poses[body].rotation, center);
  }
  std::size_t shape_index(std::size_t body) const { return shape_index_[body]; }
  T diameter(const Pair& pair) const {
    return 2 * std::min(radius_of(bodies[pair.a]), radius_of(bodies[pair.b]));
  }

 private:
  void add_body(std::size_t shape, const typename S::Rotation& rotation) {
    poses.push_back({Vector::Zero(), rotation});
    shape_index_.push_back(shape);
    bodies.emplace_back(shapes[shape], poses.back());
  }
  void add(const Situation& situation, std::mt19937_64& random) {
    const std::size_t count = 3 * shapes.size();
    const std::size_t a = random() % count;
    std::size_t b = random() % count;
    Vector line = random_direction<S>(random);
    if constexpr (moreau::Polytope<ShapeT>)
      if (situation.faces_are_aligned) {
        // b turns so that its face looks against a's.
        line = bodies[a].normals()[random() % bodies[a].normals().size()];
        const auto& shape = shapes[b % shapes.size()];
        const auto face = static_cast<Eigen::Index>(random() % shape.face_count());
        const Vector normal = shape.face_normals().row(face).transpose();
        const Vector askew = line + T(0.0087) * random_direction<S>(random);
        add_body(b % shapes.size(), turn_onto(normal, Vector(-askew.normalized())));
        b = bodies.size() - 1;
      }
    const T size = 2 * std::min(radius_of(bodies[a]), radius_of(bodies[b]));
    std::uniform_real_distribution<double> part(situation.from, situation.to);
    const auto move = [&](Placed<ShapeT>& placed, const Vector& x) { move_to(b, placed, x); };
    const T distance = touching_distance(bodies[a], bodies[b], line, move);
    list.push_back({a, b, (distance + size * static_cast<T>(part(random))) * line,
                    static_cast<T>(margin_over_diameter) * size});
  }
  std::vector<std::size_t> shape_index_;

  static Eigen::Quaternion<T> turn_onto(const Eigen::Matrix<T, 3, 1>& from,
                                        const Eigen::Matrix<T, 3, 1>& to) {
    return Eigen::Quaternion<T>::FromTwoVectors(from, to);
  }
  static Eigen::Rotation2D<T> turn_onto(const Eigen::Matrix<T, 2, 1>& from,
                                        const Eigen::Matrix<T, 2, 1>& to) {
    return Eigen::Rotation2D<T>(std::atan2(to.y(), to.x()) - std::atan2(from.y(), from.x()));
  }
};

/// Pairs that move a little from step to step, by 1e-4 of the diameter and 1e-4 rad, in a random
/// walk. All steps are placed beforehand.
template <class ShapeT>
struct Trajectories {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  static constexpr std::size_t steps = 200;
  struct Trajectory {
    std::size_t a;
    T margin;
    std::vector<Pose<S>> poses;
    std::vector<Placed<ShapeT>> b;
  };
  Pairs<ShapeT> pairs;
  std::vector<Trajectory> list;

  Trajectories(const Situation& situation, std::size_t count, std::vector<ShapeT> shapes)
      : pairs(situation, count, std::move(shapes)) {
    std::mt19937_64 random(2);
    for (const auto& pair : pairs.list) {
      Trajectory way{pair.a, pair.margin, {}, {}};
      Pose<S> pose = pairs.poses[pair.b];
      pose.position = pair.offset;
      for (std::size_t k = 0; k < steps; ++k) {
        way.poses.push_back(pose);
        way.b.emplace_back(pairs.shape_of(pair.b), pose);
        pose.position += T(1e-4) * pairs.diameter(pair) * random_direction<S>(random);
        typename S::Angular turn = S::Angular::Zero();
        turn[static_cast<Eigen::Index>(k) % turn.size()] = T(k % 2 ? 1e-4 : -1e-4);
        pose.rotation = S::normalized(S::exp(turn) * pose.rotation);
      }
      list.push_back(std::move(way));
    }
  }
};

/// A type that draws random shapes: draw(random) returns a shape, of this type or of another.
template <class T>
concept Family = requires(std::mt19937_64& random) {
  { T::draw(random) } -> moreau::GrainShape;
};

/// The shape of the library from which a class is derived: the narrow phase is written for that one.
struct BaseShape {
  template <class T>
  static moreau::Polyhedron<T> of(const moreau::Polyhedron<T>*);
  template <class T>
  static moreau::Polygon<T> of(const moreau::Polygon<T>*);
  template <class S>
  static moreau::BallIn<S> of(const moreau::BallIn<S>*);
  template <class Core>
  static moreau::Rounded<Core> of(const moreau::Rounded<Core>*);
  template <class Part>
  static moreau::Compound<Part> of(const moreau::Compound<Part>*);
};
template <class ShapeT>
struct Plain {
  using type = ShapeT;
};
template <class ShapeT>
requires requires(const ShapeT* shape) {
  BaseShape::of(shape);
}
struct Plain<ShapeT> {
  using type = decltype(BaseShape::of(static_cast<const ShapeT*>(nullptr)));
};

/// Random shapes of a family.
template <Family FamilyT>
auto draw_shapes(std::size_t count) {
  std::mt19937_64 random(1);
  std::vector<typename Plain<decltype(FamilyT::draw(random))>::type> shapes;
  for (std::size_t k = 0; k < count; ++k) shapes.push_back(FamilyT::draw(random));
  return shapes;
}

/// Random shapes as in the samples of the study.
template <class ShapeT>
std::vector<ShapeT> ballast(std::size_t count) {
  std::mt19937_64 random(1);
  return moreau::ballast_shapes<ShapeT>(count, random);
}

}  // namespace pairs
