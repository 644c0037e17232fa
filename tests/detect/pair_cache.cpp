// SPDX-License-Identifier: MIT
// The pair cache changes no bit of any result, whatever the motion of the pair and the content of
// the cache.
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <random>
#include <vector>

#include "moreau/detect/collide.hpp"

#include "detect/same_manifold.hpp"
#include "detect/shapes.hpp"
#include "sanitized.hpp"
#include "types.hpp"

using namespace moreau;

namespace {

/// Two shapes, with one cache per query that is kept during all motions.
template <class ShapeT>
class Companions {
 public:
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;

  Companions(const ShapeT& a, const ShapeT& b, std::mt19937_64& random)
      : shape_a_(a), shape_b_(b), size_(a.circumradius() + b.circumradius()), a_(a), b_(b) {
    pose_a_.rotation = samples::rotation(S{}, random);
    touch_again(random);
  }

  T size() const { return size_; }
  /// Moves b to a random position and orientation in which the shapes nearly touch.
  void touch_again(std::mt19937_64& random) {
    pose_b_.rotation = samples::rotation(S{}, random);
    const Vector line = samples::direction<S>(random);
    T inside = 0, outside = size_ * T(1.001);
    for (int k = 0; k < 30; ++k) {
      pose_b_.position = pose_a_.position + (inside + outside) / 2 * line;
      place();
      (overlap(a_, b_) ? inside : outside) = (inside + outside) / 2;
    }
  }
  /// Moves both shapes by about step times their size and rotates them by about step [rad].
  void move(T step, std::mt19937_64& random) {
    for (Pose<S>* pose : {&pose_a_, &pose_b_}) {
      pose->position += step * size_ * samples::direction<S>(random);
      typename S::Angular turn;
      for (auto& w : turn) w = step * samples::direction<S>(random)[0];
      pose->rotation = S::normalized(S::exp(turn) * pose->rotation);
    }
    place();
  }
  void set_caches(const std::array<PairCache<S>, 3>& caches) { caches_ = caches; }
  const std::array<PairCache<S>, 3>& caches() const { return caches_; }

  /// Compares the results of all three queries with and without cache.
  void check(T margin) {
    Manifold<S> cold, cached;
    const bool touch = collide(a_, b_, margin, cold);
    CHECK(collide(a_, b_, margin, cached, caches_[0]) == touch);
    if (touch) CHECK(is_same(cold, cached));
    const SignedDistance<S> one = distance(a_, b_), other = distance(a_, b_, caches_[1]);
    CHECK(one.gap == other.gap);
    CHECK(one.normal == other.normal);
    CHECK(one.witness_a == other.witness_a);
    CHECK(one.witness_b == other.witness_b);
    const bool together = overlap(a_, b_, caches_[2]);
    CHECK(overlap(a_, b_) == together);
    // overlap() stops at the first separating axis. If the gap is zero to within rounding, both
    // results are allowed.
    const T rounding = size_ * DetectionTolerance<T>::rounding;
    if (std::abs(one.gap) > rounding) CHECK(together == (one.gap <= 0));
  }

 private:
  void place() {
    a_.update(shape_a_, pose_a_);
    b_.update(shape_b_, pose_b_);
  }

  const ShapeT& shape_a_;
  const ShapeT& shape_b_;
  T size_;
  Pose<S> pose_a_, pose_b_;
  Placed<ShapeT> a_, b_;
  std::array<PairCache<S>, 3> caches_;
};

template <class T>
std::vector<Polyhedron<T>> shapes_to_try(Space<3, T> space, std::mt19937_64& random) {
  std::vector<Polyhedron<T>> shapes;
  for (int i = 0; i < 20; ++i) shapes.push_back(samples::grain(space, random));
  for (const Polyhedron<T>& shape :
       {samples::box<T>(1, 1, 1), samples::box<T>(1, 1, T(.01)), samples::box<T>(1, T(.02), T(.02)),
        samples::tetrahedron<T>(T(.5)), samples::prism<T>(12, T(.5), 1),
        samples::prism<T>(30, T(.5), T(.02))})
    shapes.push_back(shape);
  return shapes;
}
template <class T>
std::vector<Polygon<T>> shapes_to_try(Space<2, T> space, std::mt19937_64& random) {
  std::vector<Polygon<T>> shapes;
  for (int i = 0; i < 20; ++i) shapes.push_back(samples::grain(space, random));
  shapes.push_back(samples::box<T>(1, 1));
  shapes.push_back(samples::box<T>(1, T(.01)));
  return shapes;
}

}  // namespace

TEST_CASE_TEMPLATE("a pair cache changes no bit, whatever the motion", ShapeT,
                   MOREAU_TYPES((Polyhedron<double>, Polygon<double>),
                                (Polyhedron<float>, Polygon<float>))) {
  using T = typename ShapeT::Scalar;
  std::mt19937_64 random(1);
  const auto shapes = shapes_to_try(SpaceOf<ShapeT>{}, random);
  std::uniform_real_distribution<double> exponent(-6, -0.5);
  for (int i = 0; i < rounds(1000); ++i) {
    Companions<ShapeT> pair(shapes[random() % shapes.size()], shapes[random() % shapes.size()],
                            random);
    for (int k = 0; k < 60; ++k) {
      // Small steps, with an occasional large step or jump.
      const double step = k % 10 == 9 ? std::pow(10., exponent(random)) : 1e-4;
      if (k % 20 == 19) pair.touch_again(random);
      pair.move(static_cast<T>(step), random);
      pair.check(T(0.01) * pair.size());
    }
  }
}

TEST_CASE_TEMPLATE("a pair cache that holds another pair's features changes no bit", ShapeT,
                   Polyhedron<double>, Polygon<double>) {
  using S = SpaceOf<ShapeT>;
  std::mt19937_64 random(2);
  const auto shapes = shapes_to_try(S{}, random);
  for (int i = 0; i < rounds(10000); ++i) {
    Companions<ShapeT> pair(shapes[random() % shapes.size()], shapes[random() % shapes.size()],
                            random);
    std::array<PairCache<S>, 3> caches;
    for (PairCache<S>& cache : caches) {
      cache.kind = static_cast<detail::AxisKind>(random() % 8);
      cache.a = static_cast<std::uint32_t>(random() % (i % 2 ? 12 : 100));
      cache.b = static_cast<std::uint32_t>(random() % (i % 2 ? 12 : 100));
      if (i % 3) cache.axis = samples::direction<S>(random);
    }
    pair.set_caches(caches);
    pair.check(0.01 * pair.size());
  }
}

TEST_CASE_TEMPLATE("aligned shapes: ties of features are not remembered wrongly", ShapeT,
                   Polyhedron<double>, Polygon<double>) {
  using S = SpaceOf<ShapeT>;
  std::mt19937_64 random(3);
  std::vector<ShapeT> shapes = shapes_to_try(S{}, random);
  shapes.erase(shapes.begin(), shapes.begin() + 20);
  for (const ShapeT& a : shapes)
    for (const ShapeT& b : shapes) {
      Pose<S> pose;
      PairCache<S> cache;
      const Placed<ShapeT> first(a);
      Placed<ShapeT> second(b);
      for (int k = 0; k < rounds(300); ++k) {
        // Positions on a grid where faces, edges and vertices coincide, with and without small
        // perturbations.
        for (auto& x : pose.position) x = 0.125 * (static_cast<int>(random() % 17) - 8);
        if (k % 3 == 1) pose.position += 1e-13 * samples::direction<S>(random);
        typename S::Angular turn;
        for (auto& w : turn) w = samples::direction<S>(random)[0];
        turn *= k % 4 == 0 ? 0. : std::pow(10., -4. - static_cast<double>(random() % 11));
        pose.rotation = S::exp(turn);
        second.update(b, pose);
        Manifold<S> cold, cached;
        for (int again = 0; again < 2; ++again) {
          const bool touch = collide(first, second, 0.01, cold);
          CHECK(collide(first, second, 0.01, cached, cache) == touch);
          if (touch) CHECK(is_same(cold, cached));
        }
        CHECK(overlap(first, second, cache) == overlap(first, second));
        const auto one = distance(first, second), other = distance(first, second, cache);
        CHECK(one.gap == other.gap);
        CHECK(one.normal == other.normal);
        CHECK(one.witness_a == other.witness_a);
      }
    }
}

TEST_CASE_TEMPLATE("coherent pairs are proved, seldom searched", T, double, float) {
  using S = Space<3, T>;
  using Vector = typename S::Vector;
  using Shape = Polyhedron<T>;
  std::mt19937_64 random(4);
  std::vector<Shape> shapes;
  for (int i = 0; i < 20; ++i) shapes.push_back(samples::grain(S{}, random));
  int proved = 0, asked = 0;
  // Shapes that overlap and, with another share of pairs of vertices and edges, that are apart.
  for (const T depth : {T(1e-3), T(-0.05)})
    for (int i = 0; i < rounds(100); ++i) {
      const Shape& shape_a = shapes[random() % shapes.size()];
      const Shape& shape_b = shapes[random() % shapes.size()];
      Pose<S> pose_a,
          pose_b{Vector(T(1.2) * samples::direction<S>(random)), samples::rotation(S{}, random)};
      const Placed<Shape> a(shape_a, pose_a);
      const auto found = distance(a, Placed<Shape>(shape_b, pose_b));
      pose_b.position -= (found.gap + depth) * found.normal;
      PairCache<S> cache;
      for (int k = 0; k < 20; ++k) {
        const Placed<Shape> b(shape_b, pose_b);
        const detail::PolytopePair<Shape> both(a, b);
        if (k > 0) {
          proved += detail::prove_axis(both, cache).has_value();
          ++asked;
        }
        static_cast<void>(distance(a, b, cache));
        pose_b.position += T(1e-4) * samples::direction<S>(random);
        pose_b.rotation = S::exp(Vector(T(1e-4) * samples::direction<S>(random))) * pose_b.rotation;
      }
    }
  MESSAGE("proved ", proved, " of ", asked);
  CHECK(proved > 0.9 * asked);
}

TEST_CASE_TEMPLATE(
    "shapes whose faces lie on each other keep all bits with a cache, whatever their tilt", T,
    double, float) {
  using S = Space<3, T>;
  using Vector = typename S::Vector;
  using Shape = Polyhedron<T>;
  std::mt19937_64 random(5);
  const std::vector<Shape> shapes = {samples::box<T>(1, 1, 1), samples::box<T>(2, 1, T(0.2)),
                                     samples::prism<T>(6, T(0.8), T(0.4)),
                                     samples::prism<T>(3, T(0.5), 1)};
  for (const Shape& shape_a : shapes)
    for (const Shape& shape_b : shapes)
      for (const Vector& at : {Vector(T(.35), 0, 0), Vector(0, 0, 0), Vector(T(.3), T(.2), 0)})
        for (const T tilt : {T(0), T(1e-12), T(1e-8), T(1e-5), T(1e-3)})
          for (const T gap : {T(-1e-3), T(-1e-6), T(0), T(1e-5)})
            for (int i = 0; i < rounds(2); ++i) {
              PairCache<S> cache;
              const Vector turn = tilt * samples::direction<S>(random);
              const T yaw = i % 2 == 0 ? T(0) : T(0.7);
              const Placed<Shape> a(shape_a);
              const T height =
                  a.bounding_box().upper[2] + Placed<Shape>(shape_b).bounding_box().upper[2] + gap;
              for (int k = 0; k < 5; ++k) {
                Pose<S> pose;
                pose.position =
                    at + T(1e-6) * samples::direction<S>(random) + height * Vector::UnitZ();
                pose.rotation = S::exp(Vector(turn + T(0.1) * tilt * samples::direction<S>(random) +
                                              yaw * Vector::UnitZ()));
                const Placed<Shape> b(shape_b, pose);
                Manifold<S> cold, cached;
                CHECK(collide(a, b, T(0.01), cold));
                CHECK(collide(a, b, T(0.01), cached, cache));
                CHECK(is_same(cold, cached));
              }
            }
}

TEST_CASE_TEMPLATE("stacked boxes at rest are proved, seldom searched", T, double, float) {
  using S = Space<3, T>;
  using Vector = typename S::Vector;
  std::mt19937_64 random(6);
  const auto box = samples::box<T>(1, 1, 1);
  const Placed<Polyhedron<T>> a(box);
  int proved = 0, asked = 0;
  for (int i = 0; i < rounds(100); ++i) {
    Pose<S> rest;
    rest.position = Vector(T(0.55), 0, T(1 - 1e-4)) + T(1e-5) * samples::direction<S>(random);
    rest.rotation = S::exp(Vector(T(1e-5) * samples::direction<S>(random)));
    PairCache<S> cache;
    for (int k = 0; k < 10; ++k) {
      Pose<S> pose = rest;
      pose.position += T(1e-8) * samples::direction<S>(random);
      const Placed<Polyhedron<T>> b(box, pose);
      Manifold<S> manifold;
      const detail::PolytopePair<Polyhedron<T>> pair(a, b);
      if (const auto remembered = detail::remember_axis(pair, cache); k > 0 && remembered) {
        ++asked;
        proved += detail::is_proved(pair, *remembered) ||
                  detail::collide_remembered_faces(pair, *remembered, T(0.02), manifold) ==
                      detail::RememberedFaces::proved;
      }
      CHECK(collide(a, b, T(0.02), manifold, cache));
    }
  }
  MESSAGE("proved ", proved, " of ", asked);
  CHECK(proved > 0.6 * asked);
}
