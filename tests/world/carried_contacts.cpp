// SPDX-License-Identifier: MIT
// Contacts that are carried along (Tolerances::carry): as exact as the head of detect/carried_contact.hpp says, structures
// stand, and restart, threads and removed grains change no bit.
#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <memory>
#include <random>

#include "moreau/detect/carried_contact.hpp"
#include "moreau/detect/collide.hpp"
#include "moreau/io/snapshot.hpp"

#include "detect/shapes.hpp"
#include "threads/same_bits.hpp"
#include "types.hpp"
#include "world/assemblies.hpp"

using namespace moreau;
using scenes::World;

namespace {

/// Two shapes that touch.
template <class ShapeT>
struct Touching {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;

  ShapeT shape_a, shape_b;
  Pose<S> pose_a, pose_b;
  Placed<ShapeT> a, b;

  explicit Touching(std::mt19937_64& random)
      : shape_a(samples::grain(S{}, random)),
        shape_b(samples::grain(S{}, random)),
        a(shape_a),
        b(shape_b) {
    pose_a.rotation = samples::rotation(S{}, random);
    pose_b.rotation = samples::rotation(S{}, random);
    const Vector line = samples::direction<S>(random);
    T inside = 0, outside = 4;
    for (int k = 0; k < 30; ++k) {
      pose_b.position = (inside + outside) / 2 * line;
      place();
      (overlap(a, b) ? inside : outside) = (inside + outside) / 2;
    }
  }
  void place() {
    a.update(shape_a, pose_a);
    b.update(shape_b, pose_b);
  }
  /// Moves both as one body, and b by `m` and a turn of m / R relative to a.
  void move(T m, std::mt19937_64& random) {
    typename S::Angular turn;
    for (auto& w : turn) w = samples::direction<S>(random)[0];
    const auto rotation = S::normalized(S::exp(turn));
    const Vector shift = samples::direction<S>(random);
    for (Pose<S>* pose : {&pose_a, &pose_b}) {
      pose->position = rotation * pose->position + shift;
      pose->rotation = S::normalized(rotation * pose->rotation);
    }
    for (auto& w : turn) w = samples::direction<S>(random)[0] * m / shape_b.circumradius();
    pose_b.rotation = S::normalized(S::exp(turn) * pose_b.rotation);
    pose_b.position += m * samples::direction<S>(random);
    place();
  }
  typename detail::CarriedContact<S>::Placing placing() const {
    return {a.center(), pose_a.rotation, b.center(), pose_b.rotation};
  }
};

template <class S>
typename S::Scalar least_gap(const Manifold<S>& manifold) {
  auto least = std::numeric_limits<typename S::Scalar>::infinity();
  for (const auto& point : manifold.points) least = std::min(least, point.gap);
  return least;
}

/// Boxes of one metre in rows on a floor, each row shorter by one.
template <class ShapeT>
World<ShapeT> pyramid(int rows, double carry) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  const double h = 1. / 60;
  World<ShapeT> world(1, Materials<scenes::LawOf<ShapeT>>(1, scenes::LawOf<ShapeT>(0.5)), {},
                      {.margin = 0.05, .carry = carry});
  world.set_gravity(-9.81 * Vector::Unit(up));
  world.add_wall(Vector::Unit(up), Vector::Zero());
  const ShapeId box = world.add_shape(cuboid<ShapeT>(Vector::Constant(0.5)));
  for (int row = 0; row < rows; ++row)
    for (int k = 0; k < rows - row; ++k) {
      Vector x = Vector::Zero();
      x[0] = 1.1 * (k + 0.5 * row);
      x[up] = 0.5 + row;
      world.add_grain(box, {x}, 1000);
    }
  for (int k = 0; k < 30; ++k) world.step(h);
  return world;
}
template <class ShapeT>
void run(World<ShapeT>& world, int steps) {
  for (int k = 0; k < steps; ++k) world.step(1. / 60);
}

}  // namespace

TEST_CASE_TEMPLATE("a carried contact is that of the detection but for errors of second order",
                   ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Polygon<>), (Polyhedron<float>, Polygon<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  constexpr T rounding = std::is_same_v<T, double> ? T(1e-12) : T(2e-5);
  std::mt19937_64 random(4);
  int same = 0, kinks = 0;
  for (int pair = 0; pair < 2000; ++pair) {
    Touching<ShapeT> touching(random);
    PairCache<S> cache;
    Manifold<S> found, carried, exact;
    const T margin = T(0.05);
    REQUIRE(collide(touching.a, touching.b, margin, found, cache));
    detail::CarriedContact<S> contact;
    contact.store(touching.placing(), found, margin);
    const PairCache<S> before = cache;
    const T m = T(5e-3) * std::pow(T(10), -T(pair % 3));
    touching.move(m, random);
    // m, its turn by at most sqrt(3) m / R at R, and rounding
    REQUIRE(contact.holds(touching.placing(), touching.shape_b.circumradius(), margin / 2,
                          T(2.8) * m + rounding));
    REQUIRE(contact.write(touching.placing(), margin / 2, carried));
    REQUIRE(collide(touching.a, touching.b, margin / 2, exact, cache));
    CAPTURE(pair);
    const T radius = touching.shape_b.circumradius();
    const bool is_face =
        cache.kind == detail::AxisKind::face_a || cache.kind == detail::AxisKind::face_b;
    const T error = std::abs(least_gap(carried) - least_gap(exact));
    if (is_face && before.kind == cache.kind && before.a == cache.a && before.b == cache.b) {
      ++same;
      CHECK((carried.normal - exact.normal).norm() <= 2 * m / radius + rounding);
      CHECK(error <= 8 * m * m / radius + rounding);
    } else {
      ++kinks;
      CHECK(error <= 3 * m + rounding);
    }
  }
  CHECK(same > 800);
  CHECK(kinks > 0);
}

TEST_CASE_TEMPLATE("a pyramid whose contacts are carried along stands as with exact contacts",
                   ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Polygon<>), (Polyhedron<float>, Polygon<float>))) {
  World<ShapeT> exact = pyramid<ShapeT>(6, 0), carried = pyramid<ShapeT>(6, 5e-3);
  run(exact, 300);
  run(carried, 300);
  for (std::size_t k = 0; k < exact.bodies().size(); ++k)
    CHECK((exact.bodies().pose[k].position - carried.bodies().pose[k].position).norm() < 5e-3);
}

TEST_CASE_TEMPLATE("carried contacts: restart, threads, removed grains", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Polygon<>), (Polyhedron<float>, Polygon<float>))) {
  World<ShapeT> one = pyramid<ShapeT>(5, 5e-3), two = one,
                other(1, Materials<scenes::LawOf<ShapeT>>(1));
  restore_snapshot(snapshot(one), other);
  two.set_team(Team(std::make_shared<threads_test::EagerThreads>(3)));
  for (World<ShapeT>* world : {&one, &two, &other}) {
    run(*world, 30);
    const std::array<BodyId, 2> lost{world->grains()[3], world->grains()[9]};
    world->remove_grains(lost);
    run(*world, 60);
  }
  CHECK(snapshot(one) == snapshot(two));
  CHECK(snapshot(one) == snapshot(other));
}
