// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <random>
#include <vector>

#include "moreau/detect/collide.hpp"

#include "detect/flush_pairs.hpp"
#include "detect/oracle.hpp"
#include "detect/shapes.hpp"
#include "rotation_between.hpp"
#include "sanitized.hpp"

using namespace moreau;

namespace {

using S = Space<3>;
using Vector = S::Vector;
using Solid = Polyhedron<double>;

struct Pair {
  const Solid* a;
  const Solid* b;
  Pose<S> pose_a, pose_b;
  double size;
};

/// A random pair of shapes, moved along a random line until the shapes touch.
Pair touching_pair(const std::vector<Solid>& shapes, std::mt19937_64& random) {
  Pair pair;
  pair.a = &shapes[random() % shapes.size()];
  pair.b = &shapes[random() % shapes.size()];
  pair.pose_a.rotation = samples::rotation(S{}, random);
  pair.pose_b.rotation = samples::rotation(S{}, random);
  pair.size = pair.a->circumradius() + pair.b->circumradius();
  const Vector line = samples::direction<S>(random);
  double inside = 0, outside = pair.size * 1.001;
  for (int k = 0; k < 55; ++k) {
    const double middle = (inside + outside) / 2;
    pair.pose_b.position = middle * line;
    (overlap(Placed<Solid>(*pair.a, pair.pose_a), Placed<Solid>(*pair.b, pair.pose_b)) ? inside
                                                                                       : outside) =
        middle;
  }
  return pair;
}

std::vector<Solid> grains(int count, std::mt19937_64& random) {
  std::vector<Solid> shapes;
  for (int i = 0; i < count; ++i) shapes.push_back(samples::grain(S{}, random));
  return shapes;
}

std::vector<Solid> nasty_shapes(std::mt19937_64& random) {
  std::vector<Solid> shapes = {samples::box(1., 1., 1.),   samples::box(1., 1., .01),
                               samples::box(1., .01, .01), samples::tetrahedron(.5),
                               samples::prism(12, .5, 1.), samples::prism(40, .5, .02),
                               samples::prism(5, .01, 1.), samples::box(1e-3, 1e-3, 1e-3),
                               samples::tetrahedron(5e-4), samples::grain(S{}, random)};
  shapes.push_back(shapes.back().scaled(1e-3));
  return shapes;
}

double height_above(const Solid& shape, const Pose<S>& pose, const Vector& x) {
  const Vector body = pose.to_body(x);
  return ((shape.face_normals() * body).array() - shape.face_offsets().array()).maxCoeff();
}

/// Calls check(pair, random) with pairs of grains that touch.
void with_touching_grains(unsigned seed, int count, const auto& check) {
  std::mt19937_64 random(seed);
  const auto shapes = grains(40, random);
  for (int i = 0; i < count; ++i) {
    Pair pair = touching_pair(shapes, random);
    check(pair, random);
  }
}

void check_against_oracle(const Pair& pair, double margin) {
  const auto truth = oracle::signed_gap(*pair.a, pair.pose_a, *pair.b, pair.pose_b);
  const Placed<Solid> a(*pair.a, pair.pose_a), b(*pair.b, pair.pose_b);
  const double tiny = 1e-12 * pair.size;
  const auto found = distance(a, b);
  CHECK(std::abs(found.gap - truth.gap) < tiny);
  if (std::abs(truth.gap) > tiny) CHECK(overlap(a, b) == (truth.gap <= 0));
  CHECK(found.normal.norm() == doctest::Approx(1).epsilon(1e-14));
  if (truth.is_unique) CHECK((found.normal - truth.normal).norm() < 1.7e-4);
  CHECK((found.witness_b - found.witness_a - found.gap * found.normal).norm() < tiny);
  CHECK(std::abs(height_above(*pair.a, pair.pose_a, found.witness_a)) < 10 * tiny);
  CHECK(std::abs(height_above(*pair.b, pair.pose_b, found.witness_b)) < 10 * tiny);

  Manifold<S> manifold;
  const bool touch = collide(a, b, margin, manifold);
  if (std::abs(truth.gap - margin) > tiny) CHECK(touch == (truth.gap <= margin));
  if (!touch) return;
  CHECK(manifold.gap == doctest::Approx(found.gap).epsilon(1e-12));
  CHECK((manifold.normal - found.normal).norm() < 1e-12);
  REQUIRE(!manifold.points.empty());
  double deepest = 1e9;
  for (const auto& point : manifold.points) {
    deepest = std::min(deepest, point.gap);
    CHECK(point.gap <= margin + tiny);
    // Each witness point lies on the face from which the gap was measured, so it never lies outside
    // of its shape.
    const Vector half = point.gap / 2 * manifold.normal;
    CHECK(height_above(*pair.a, pair.pose_a, point.position - half) < 1e-7 * pair.size);
    CHECK(height_above(*pair.b, pair.pose_b, point.position + half) < 1e-7 * pair.size);
  }
  CHECK(std::abs(deepest - truth.gap) < tiny);
  CHECK(std::is_sorted(manifold.points.begin(), manifold.points.end(),
                       [](const auto& p, const auto& q) { return p.feature < q.feature; }));
}

/// Checks that the result is the same if a and b are exchanged and if both shapes are moved by the
/// same motion.
void check_same(const Manifold<S>& one, const Manifold<S>& other, const Pose<S>& motion, bool swap,
                double tiny) {
  const double sign = swap ? -1 : 1;
  CHECK(one.contact_class == other.contact_class);
  CHECK(std::abs(one.gap - other.gap) < tiny);
  CHECK((sign * (motion.rotation * one.normal) - other.normal).norm() < 1e-6);
  REQUIRE(one.points.size() == other.points.size());
  for (const auto& point : one.points) {
    const bool is_there = std::any_of(other.points.begin(), other.points.end(), [&](const auto& q) {
      return (motion(point.position) - q.position).norm() < 1e-6 &&
             std::abs(point.gap - q.gap) < 1e-6;
    });
    CHECK(is_there);
  }
}

}  // namespace

TEST_CASE("polyhedra: gap, normal and points against exhaustive search, around touching") {
  std::uniform_real_distribution<double> offset(-0.005, 0.005);
  with_touching_grains(1, rounds(150), [&](Pair& pair, auto& random) {
    pair.pose_b.position *= 1 + offset(random);
    check_against_oracle(pair, 0.004 * pair.size);
  });
}

TEST_CASE("polyhedra: gap, normal and points against exhaustive search, deep and apart") {
  std::uniform_real_distribution<double> factor(0, 1.3);
  with_touching_grains(2, rounds(100), [&](Pair& pair, auto& random) {
    pair.pose_b.position *= factor(random);
    check_against_oracle(pair, 0.1 * pair.size);
  });
}

TEST_CASE("polyhedra: gaps of 1e-15 to 1e-3 of the size keep their digits") {
  std::uniform_real_distribution<double> exponent(-15, -3);
  double sign = -1;
  with_touching_grains(3, rounds(100), [&](Pair& pair, auto& random) {
    pair.pose_b.position *= 1 + sign * std::pow(10., exponent(random));
    sign = -sign;
    check_against_oracle(pair, 1e-5 * pair.size);
  });
}

TEST_CASE("polyhedra: needles, plates, prisms, tetrahedra, boxes, sizes 1 to 1000") {
  std::mt19937_64 random(4);
  const auto shapes = nasty_shapes(random);
  std::uniform_real_distribution<double> factor(-1, 1);
  for (int i = 0; i < rounds(200); ++i) {
    Pair pair = touching_pair(shapes, random);
    pair.pose_b.position *= i % 2 ? 1 + 0.01 * factor(random) : std::abs(factor(random));
    check_against_oracle(pair, 0.01 * pair.size);
  }
}

TEST_CASE("polyhedra: axes parallel, faces, edges and vertices exactly on each other") {
  std::mt19937_64 random(5);
  const std::vector<Solid> shapes = {samples::box(1., 1., 1.), samples::box(1., 2., .5),
                                     samples::tetrahedron(.5), samples::prism(6, 1., 1.)};
  for (const Solid& a : shapes)
    for (const Solid& b : shapes)
      for (int k = 0; k < 40; ++k) {
        Pair pair{&a, &b, {}, {}, a.circumradius() + b.circumradius()};
        // All coordinates are multiples of a quarter, so that faces, edges and vertices often
        // coincide.
        for (auto& x : pair.pose_b.position) x = 0.25 * (static_cast<int>(random() % 17) - 8);
        check_against_oracle(pair, 1e-3);
      }
}

TEST_CASE("polyhedra: coincident shapes") {
  std::mt19937_64 random(6);
  for (const Solid& shape : nasty_shapes(random)) {
    const Pair pair{&shape, &shape, {}, {}, 2 * shape.circumradius()};
    check_against_oracle(pair, 0);
  }
}

TEST_CASE("polyhedra: the manifold does not know which shape is called a, nor where it lies") {
  std::uniform_real_distribution<double> offset(-0.003, 0.003);
  with_touching_grains(7, rounds(500), [&](Pair& pair, auto& random) {
    pair.pose_b.position *= 1 + offset(random);
    const double margin = 0.0031 * pair.size;
    Manifold<S> straight, swapped, moved;
    collide(Placed<Solid>(*pair.a, pair.pose_a), Placed<Solid>(*pair.b, pair.pose_b), margin,
            straight);
    collide(Placed<Solid>(*pair.b, pair.pose_b), Placed<Solid>(*pair.a, pair.pose_a), margin,
            swapped);
    Pose<S> motion{1e3 * samples::direction<S>(random), samples::rotation(S{}, random)};
    const auto move = [&](const Pose<S>& pose) {
      return Pose<S>{motion(pose.position), motion.rotation * pose.rotation};
    };
    collide(Placed<Solid>(*pair.a, move(pair.pose_a)), Placed<Solid>(*pair.b, move(pair.pose_b)),
            margin, moved);
    check_same(straight, swapped, Pose<S>{}, true, 1e-12 * pair.size);
    check_same(straight, moved, motion, false, 1e-12 * pair.size + 16 * 2.3e-16 * 1e3);
    for (const auto& point : straight.points) {
      const bool is_there =
          std::any_of(swapped.points.begin(), swapped.points.end(),
                      [&](const auto& q) { return q.feature.swapped() == point.feature; });
      CHECK(is_there);
    }
  });
}

TEST_CASE("polyhedra: a cache changes nothing, whatever it holds") {
  std::uniform_real_distribution<double> offset(-0.01, 0.01);
  with_touching_grains(8, rounds(500), [&](Pair& pair, auto& random) {
    pair.pose_b.position *= 1 + offset(random);
    const Placed<Solid> a(*pair.a, pair.pose_a), b(*pair.b, pair.pose_b);
    Manifold<S> cold, cached;
    PairCache<S> cache;
    cache.axis = samples::direction<S>(random);
    const bool touch = collide(a, b, 0.002 * pair.size, cold);
    CHECK(collide(a, b, 0.002 * pair.size, cached, cache) == touch);
    CHECK(collide(a, b, 0.002 * pair.size, cached, cache) == touch);
    if (!touch) return;
    CHECK(cached.gap == cold.gap);
    CHECK(cached.normal == cold.normal);
    REQUIRE(cached.points.size() == cold.points.size());
    for (std::size_t k = 0; k < cold.points.size(); ++k)
      CHECK(cached.points[k].feature == cold.points[k].feature);
  });
}

TEST_CASE("polyhedra: classes of boxes that meet by face, edge and vertex") {
  const Solid box = samples::box(1., 1., 1.);
  const auto turned = [](double x, double y) {
    Eigen::Quaterniond q =
        Eigen::AngleAxisd(x, Vector::UnitX()) * Eigen::AngleAxisd(y, Vector::UnitY());
    return q;
  };
  const double quarter = std::numbers::pi / 4;
  Manifold<S> manifold;
  const auto touch = [&](const Eigen::Quaterniond& qa, const Eigen::Quaterniond& qb, double z) {
    Pose<S> below{Vector::Zero(), qa}, above{Vector(0.1, 0.07, z), qb};
    REQUIRE(collide(Placed<Solid>(box, below), Placed<Solid>(box, above), 1e-3, manifold));
    CHECK((manifold.normal - Vector::UnitZ()).norm() < 1e-12);
    CHECK(manifold.gap == doctest::Approx(1e-4).epsilon(1e-9));
  };
  const double edge = std::sqrt(0.5);
  touch(turned(0, 0), turned(0, 0), 1 + 1e-4);
  CHECK(manifold.contact_class == ContactClass::face_face);
  CHECK(manifold.points.size() == 4);
  touch(turned(0, 0), turned(quarter, 0), 0.5 + edge + 1e-4);
  CHECK(manifold.contact_class == ContactClass::edge_face);
  CHECK(manifold.points.size() == 2);
  touch(turned(quarter, 0), turned(0, quarter), 2 * edge + 1e-4);
  CHECK(manifold.contact_class == ContactClass::edge_edge);
  CHECK(manifold.points.size() == 1);
  const Eigen::Quaterniond on_vertex = rotation_between(Vector(1, 1, 1), Vector(0, 0, -1));
  touch(turned(0, 0), on_vertex, 0.5 + std::sqrt(0.75) + 1e-4);
  CHECK(manifold.contact_class == ContactClass::vertex_face);
  CHECK(manifold.points.size() == 1);
}

TEST_CASE("polyhedra: boxes apart by corner and by edge are named so") {
  const Solid box = samples::box(1., 1., 1.);
  Manifold<S> manifold;
  REQUIRE(collide(Placed<Solid>(box),
                  Placed<Solid>(box, {Vector(1.001, 1.002, 1.002), S::identity()}), 0.01,
                  manifold));
  CHECK(manifold.contact_class == ContactClass::vertex_vertex);
  CHECK(manifold.gap == doctest::Approx(0.003).epsilon(1e-12));
  CHECK((manifold.normal - Vector(1, 2, 2) / 3).norm() < 1e-12);
  CHECK(manifold.points.size() == 1);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(std::numbers::pi / 4, Vector::UnitX()));
  const Eigen::Quaterniond on_corner = rotation_between(Vector(1, 1, 1), Vector(0, -0.3, -1));
  const Vector corner = on_corner * Vector(0.5, 0.5, 0.5);
  // The corner lies beside the upper edge of a box that stands on an edge, outside both faces at
  // the upper edge.
  const Vector edge(0.1, 0, std::sqrt(0.5));
  const Vector beside = 0.003 * Vector(0, 0.1, 1).normalized();
  REQUIRE(collide(Placed<Solid>(box, {Vector::Zero(), turn}),
                  Placed<Solid>(box, {edge + beside - corner, on_corner}), 0.01, manifold));
  CHECK(manifold.contact_class == ContactClass::vertex_edge);
  CHECK(manifold.gap == doctest::Approx(0.003).epsilon(1e-12));
  CHECK((manifold.normal - beside.normalized()).norm() < 1e-10);
}

TEST_CASE("polyhedra: faces askew by half a degree keep all points within the margin") {
  const Solid box = samples::box(1., 1., 1.);
  const Eigen::Quaterniond tilt(
      Eigen::AngleAxisd(0.5 / 180 * std::numbers::pi, Vector(1, 0.3, 0.2).normalized()));
  Pose<S> below, above{Vector(0.2, 0.1, 1.0), tilt};
  const auto found = distance(Placed<Solid>(box, below), Placed<Solid>(box, above));
  above.position.z() -= found.gap;
  Manifold<S> manifold;
  REQUIRE(collide(Placed<Solid>(box, below), Placed<Solid>(box, above), 0.02, manifold));
  CHECK(manifold.contact_class == ContactClass::face_face);
  CHECK(manifold.points.size() == 4);
  REQUIRE(collide(Placed<Solid>(box, below), Placed<Solid>(box, above), 1e-4, manifold));
  CHECK(manifold.points.size() == 1);
}

TEST_CASE("polyhedra: keys of a flush stack outlive trembling below the tolerance") {
  const Solid box = samples::box(1., 1., 1.);
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> tremble(-1e-10, 1e-10);
  std::vector<FeatureKey> keys;
  for (int i = 0; i < rounds(100); ++i) {
    Pose<S> above{Vector(tremble(random), tremble(random), 1 + tremble(random)),
                  S::exp(Vector(tremble(random), tremble(random), tremble(random)))};
    Manifold<S> manifold;
    REQUIRE(collide(Placed<Solid>(box), Placed<Solid>(box, above), 1e-3, manifold));
    REQUIRE(manifold.points.size() == 4);
    if (i == 0)
      for (const auto& point : manifold.points) keys.push_back(point.feature);
    for (std::size_t k = 0; k < 4; ++k) CHECK(manifold.points[k].feature == keys[k]);
  }
}

TEST_CASE_TEMPLATE("polyhedra: flush to within roundings, no point is deeper than the pair", T,
                   double, float) {
  flush::check_pairs<T, 3>(rounds(1000), 4);
}
