// SPDX-License-Identifier: MIT
// The warm start of contacts whose features have changed names: boxes that lie on each other have the same points before
// and after one of them has moved by a hair past the corners of the other, but each point has another key.
#include "moreau/contact/warm_start.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <vector>

#include "moreau/detect/collide.hpp"

#include "types.hpp"
#include "world/assemblies.hpp"

using namespace moreau;
using scenes::World;

namespace {

/// The contacts of a box of one metre that lies on another one, shifted by the same length along all horizontal axes.
template <class ShapeT>
auto stacked_boxes(typename SpaceOf<ShapeT>::Scalar shift) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  const ShapeT box = cuboid<ShapeT>(Vector::Constant(0.5));
  Pose<S> above;
  above.position.setConstant(shift);
  above.position[S::dim - 1] = 1;
  const Placed<ShapeT> a(box), b(box, above);
  Manifold<S> manifold;
  REQUIRE(collide(a, b, typename S::Scalar(0.01), manifold));
  Contacts<S> contacts;
  for (const auto& point : manifold.points) {
    const Vector lever_b = point.position - above.position;
    contacts.points.push_back(
        {0, 1, 0, point.gap, S::contact_frame(manifold.normal), point.position, lever_b});
    contacts.keys.push_back({0, 1, point.feature});
    contacts.classes.push_back(manifold.contact_class);
    contacts.impulses.push_back(Contacts<S>::Impulse::Zero());
    contacts.variants.push_back(0);
  }
  return contacts;
}

/// An impulse of each contact, that of contact c with the normal entry c + 1.
template <class S>
void number_impulses(Contacts<S>& contacts) {
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    contacts.impulses[c].setConstant(typename S::Scalar(0.25));
    contacts.impulses[c][0] = static_cast<typename S::Scalar>(c + 1);
    contacts.variants[c] = static_cast<std::uint32_t>(c + 1);
  }
}

/// The contact of `before` nearest to a place.
template <class S>
std::size_t nearest(const Contacts<S>& before, const typename S::Vector& place) {
  std::size_t best = 0;
  for (std::size_t c = 0; c < before.size(); ++c)
    if ((before.points[c].lever_a - place).norm() < (before.points[best].lever_a - place).norm())
      best = c;
  return best;
}

}  // namespace

TEST_CASE_TEMPLATE("two boxes whose features have changed names: all points start warm", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Polygon<>), (Polyhedron<float>, Polygon<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  constexpr auto count = std::size_t(S::dim == 3 ? 4 : 2);
  auto before = stacked_boxes<ShapeT>(T(0.01)), now = stacked_boxes<ShapeT>(T(-0.01));
  REQUIRE(before.size() == count);
  REQUIRE(now.size() == count);
  number_impulses(before);
  CHECK(warm_start(before, now) == 0);  // no key is that of a point before
  CHECK(hand_over(before, now, before.impulses, now.impulses, ImpulseTurn<S>()) == count);
  for (std::size_t c = 0; c < count; ++c) {
    CAPTURE(c);
    const std::size_t from = nearest(before, now.points[c].lever_a);
    CHECK((now.points[c].lever_a - before.points[from].lever_a).norm() < T(0.03));
    const typename S::Vector given = before.points[from].frame * before.impulses[from];
    const typename S::Vector taken = now.points[c].frame * now.impulses[c];
    CHECK((taken - given).norm() < 8 * std::numeric_limits<T>::epsilon() * given.norm());
    CHECK(now.variants[c] == before.variants[from]);
  }
}

TEST_CASE_TEMPLATE(
    "keys that are still there keep their impulses, and those of lost points are added", ShapeT,
    MOREAU_TYPES((Polyhedron<>, Polygon<>), (Polyhedron<float>, Polygon<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  auto before = stacked_boxes<ShapeT>(T(0.01));
  number_impulses(before);
  // One point is gone, a second one has another key.
  auto now = before;
  now.erase([](std::size_t c) { return c == 0; });
  now.keys.back().feature.value += 1;
  now.impulses.assign(now.size(), Contacts<S>::Impulse::Zero());
  CHECK(warm_start(before, now) == now.size() - 1);
  CHECK(hand_over(before, now, before.impulses, now.impulses, ImpulseTurn<S>()) == 2);
  typename S::Vector all = S::Vector::Zero(), left = S::Vector::Zero();
  for (const auto& impulse : before.impulses) all += impulse;
  for (const auto& impulse : now.impulses) {
    left += impulse;
    CHECK(impulse[0] >= 2);
  }
  CHECK((all - left).norm() < 8 * std::numeric_limits<T>::epsilon() * all.norm());
  CHECK(now.impulses.back()[0] >= T(before.size()));
  // A pair that is no longer in contact hands nothing over.
  auto other = now;
  for (ContactKey& key : other.keys) key.b = 2;
  CHECK(warm_start(before, other) == 0);
  CHECK(hand_over(before, other, before.impulses, other.impulses, ImpulseTurn<S>()) == 0);
}

TEST_CASE_TEMPLATE(
    "a stack whose features change names in every step is solved by the impulses before", ShapeT,
    MOREAU_TYPES((Polyhedron<>, Polygon<>), (Polyhedron<float>, Polygon<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  ColouredOptions sweeps;
  sweeps.islands = false;
  World<ShapeT> world(1, Materials<scenes::LawOf<ShapeT>>(1, scenes::LawOf<ShapeT>(T(0.5))),
                      ColouredGaussSeidel(sweeps));
  world.set_gravity(T(-9.81) * Vector::Unit(up));
  world.add_wall(Vector::Unit(up), Vector::Zero());
  const ShapeId box = world.add_shape(cuboid<ShapeT>(Vector::Constant(0.5)));
  std::vector<BodyId> boxes;
  for (int k = 0; k < 3; ++k)
    boxes.push_back(world.add_grain(box, {(k + T(0.5)) * Vector::Unit(up)}, 1000));
  for (int k = 0; k < 60; ++k) world.step(T(1e-3));
  for (int k = 0; k < 20; ++k) {
    CAPTURE(k);
    auto pose = world.pose(boxes[1]);
    for (int axis = 0; axis < up; ++axis) pose.position[axis] = T(k % 2 ? 1e-4 : -1e-4);
    world.set_pose(boxes[1], pose);
    const auto report = world.step(T(1e-3));
    CHECK(report.solve.converged);
    if (k > 0) CHECK(report.solve.sweeps <= 5);
    if (k > 0) CHECK(report.warm_started < report.points);
  }
}
