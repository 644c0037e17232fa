// SPDX-License-Identifier: MIT
// Measures that are computed from contacts: overlap, coordination, stress, force chains, fabric,
// force distribution.
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <vector>

#include "moreau/measure/contact_classes.hpp"
#include "moreau/measure/coordination.hpp"
#include "moreau/measure/fabric.hpp"
#include "moreau/measure/force_chains.hpp"
#include "moreau/measure/force_distribution.hpp"
#include "moreau/measure/overlap.hpp"
#include "moreau/measure/pair_forces.hpp"
#include "moreau/measure/stress.hpp"

namespace {

using namespace moreau;

/// Bodies without shape at given positions, and contacts between them.
template <class S>
struct Assembly {
  std::vector<typename S::Vector> position;
  std::vector<bool> grain;
  Contacts<S> contacts;

  /// Adds a contact point between two bodies, with the impulse on b in world axes.
  void add(std::uint32_t a, std::uint32_t b, const typename S::Vector& point,
           const typename S::Vector& normal, const typename S::Vector& impulse, double gap = 0) {
    const typename S::Matrix frame = S::contact_frame(normal);
    const typename S::Vector lever_a = point - position[a], lever_b = point - position[b];
    contacts.points.push_back({a, b, 0, gap, frame, lever_a, lever_b});
    contacts.keys.push_back({a, b, FeatureKey{}});
    contacts.classes.push_back(ContactClass::vertex_face);
    contacts.impulses.push_back(frame.transpose() * impulse);
  }
  std::vector<PairForce<S>> pairs(double step = 1) const {
    std::vector<PairForce<S>> found;
    pair_forces(contacts, step, found);
    return found;
  }
  Fabric<S> fabric_in(const Aabb<S>& box) const {
    return fabric<S>(pairs(), box, position_of(), is_grain());
  }
  auto position_of() const {
    return [this](std::uint32_t body) { return position[body]; };
  }
  auto is_grain() const {
    return [this](std::uint32_t body) { return bool(grain[body]); };
  }
  Coordination coordination(std::size_t fewest) const {
    return CoordinationCounter<S>().count(contacts.points, contacts.impulses, position.size(),
                                          is_grain(), fewest);
  }
};

template <class S>
Contact<S> touching(std::uint32_t a, std::uint32_t b, double gap) {
  return {a, b, 0, gap, S::Matrix::Identity(), S::Vector::Zero(), S::Vector::Zero()};
}

}  // namespace

TEST_CASE("overlap statistics count points and pairs") {
  using S = Space<3>;
  std::vector<Contact<S>> points = {touching<S>(0, 1, -0.25), touching<S>(0, 1, -0.5),
                                    touching<S>(0, 1, 0.5),   touching<S>(0, 2, 0),
                                    touching<S>(1, 2, 0.125), touching<S>(1, 3, -0.75)};
  const auto found = overlap_statistics<S>(points);
  CHECK(found.points == 3);
  CHECK(found.pairs == 2);
  CHECK(found.mean == 0.5);
  CHECK(found.mean_of_pairs == 0.625);
  CHECK(found.max == 0.75);

  auto merged = overlap_statistics<S>(std::span(points).first(3));
  merged.merge(overlap_statistics<S>(std::span(points).subspan(3)));
  CHECK(merged.points == 3);
  CHECK(merged.mean == 0.5);
  CHECK(merged.mean_of_pairs == 0.625);
  CHECK(merged.max == 0.75);

  auto nothing = overlap_statistics<S>({});
  nothing.merge({});
  CHECK(nothing.points == 0);
  CHECK(nothing.mean == 0);
}

TEST_CASE("coordination counts neighbours that push, and rattlers fall away in turn") {
  using S = Space<2>;
  using V = S::Vector;
  Assembly<S> all;
  // Grains 0, 1, 2 touch each other. Grain 3 touches 0 only, grain 4 touches 3 only, and grain 5
  // carries no force. Body 6 is a wall, which 0 and 1 touch.
  all.position.assign(7, V::Zero());
  all.grain = {true, true, true, true, true, true, false};
  const auto push = [&](std::uint32_t a, std::uint32_t b, double impulse) {
    all.add(a, b, V::Zero(), V::UnitX(), V(impulse, 0.5));
  };
  push(0, 1, 1);
  push(0, 1, 2);  // a second point of the same pair
  push(0, 2, 1);
  push(0, 3, 1);
  push(0, 5, 0);  // no impulse, so it does not count
  push(0, 6, 1);
  push(1, 2, 1);
  push(1, 6, 1);
  push(3, 4, 1);

  const Coordination every = all.coordination(0);
  CHECK(every.grains == 6);
  CHECK(every.rattlers == 0);
  CHECK(every.points == 8);
  CHECK(every.pairs == 7);
  CHECK(every.neighbours == doctest::Approx((2 * 5 + 2) / 6.0));
  CHECK(every.points_per_grain == doctest::Approx((2 * 6 + 2) / 6.0));

  const Coordination core = all.coordination(2);  // rattlers: 5 and 4, then 3
  CHECK(core.grains == 3);
  CHECK(core.rattlers == 3);
  CHECK(core.pairs == 5);
  CHECK(core.neighbours == doctest::Approx((2 * 3 + 2) / 3.0));
  CHECK(all.coordination(3).grains == 0);  // 2 has two neighbours and is removed; then all others
  CHECK(all.coordination(3).neighbours == 0);

  CHECK_THROWS_AS(
      CoordinationCounter<S>().count(all.contacts.points, std::span(all.contacts.impulses).first(2),
                                     7, all.is_grain()),
      std::invalid_argument);
}

TEST_CASE_TEMPLATE("stress of a column under a weight is the weight over the section", S, Space<2>,
                   Space<3>) {
  using V = typename S::Vector;
  const V up = V::Unit(S::dim - 1);
  const double step = 1e-3, load = 7;
  Assembly<S> column;
  column.position = {V::Zero(), up, 2 * up, -0.5 * up};
  column.grain = {true, true, true, false};
  column.add(0, 1, 0.5 * up, up, load * step * up);
  column.add(0, 3, -0.5 * up, -up, -load * step * up);  // here the wall is body b
  column.add(1, 2, 1.5 * up, up, load * step * up);
  Aabb<S> box{V::Constant(-2), V::Constant(2)};
  // Height 2.5: the box contains the contacts with branches 0.5, 1 and 1.
  box.lower[S::dim - 1] = -0.5;
  box.upper[S::dim - 1] = 2;
  const auto sigma =
      contact_stress(column.contacts, step, box, column.position_of(), column.is_grain());
  typename S::Matrix truth = S::Matrix::Zero();
  truth(S::dim - 1, S::dim - 1) = load * 2.5 / volume(box);
  CHECK((sigma - truth).norm() < 1e-12 * load);
  CHECK(truth(S::dim - 1, S::dim - 1) > 0);  // positive for compression

  // Only the two lower contacts are in the box. Exchanging a and b makes no difference.
  box.upper[S::dim - 1] = 1;
  std::swap(column.contacts.points[1].a, column.contacts.points[1].b);
  std::swap(column.contacts.points[1].lever_a, column.contacts.points[1].lever_b);
  column.contacts.points[1].frame = S::contact_frame(up);
  const auto low =
      contact_stress(column.contacts, step, box, column.position_of(), column.is_grain());
  CHECK(low(S::dim - 1, S::dim - 1) == doctest::Approx(load * 1.5 / volume(box)));
}

TEST_CASE("stress of a balanced cell is that of the loads on its boundary") {
  // A grain in equilibrium of forces and torques under four forces. V sigma = sum x f over the
  // forces from outside, with a minus sign because compression is positive.
  using S = Space<2>;
  using V = S::Vector;
  Assembly<S> cell;
  cell.position = {V(3, 4), V(9, 9)};
  cell.grain = {true, false};
  Eigen::Matrix2d outside = Eigen::Matrix2d::Zero();
  const auto load = [&](V arm, V force) {
    cell.add(1, 0, cell.position[0] + arm, -arm.normalized(), force * 0.5);
    outside -= arm * force.transpose();
  };
  load({1, 0}, {-3, 1});
  load({-1, 0}, {3, -1});
  load({0, 1}, {1, -2});
  load({0, -1}, {-1, 2});
  const Aabb<S> box{V(0, 0), V(10, 10)};
  const auto sigma = contact_stress(cell.contacts, 0.5, box, cell.position_of(), cell.is_grain());
  CHECK((sigma * volume(box) - outside).norm() < 1e-13);
  CHECK(sigma(0, 0) > 0);
  CHECK(sigma(0, 1) == doctest::Approx(sigma(1, 0)));
}

/// Two grains at these positions, and a wall (body 2).
Assembly<Space<3>> two_grains_and_wall(const Space<3>::Vector& first,
                                       const Space<3>::Vector& second) {
  Assembly<Space<3>> all;
  all.position = {first, second, Space<3>::Vector(50, 50, 0)};
  all.grain = {true, true, false};
  return all;
}

TEST_CASE("force chains run from centre to centre, to the wall's contact point") {
  using S = Space<3>;
  using V = S::Vector;
  auto all = two_grains_and_wall(V(0, 0, 1), V(0, 0, 3));
  all.add(0, 1, V(0, 0.25, 2), V::UnitZ(), V(0.3, 0.4, 2), -0.01);
  all.add(0, 2, V(0.5, 0, 0), -V::UnitZ(), V(0, 0, -4));
  all.add(1, 2, V(0.5, 0, 0), -V::UnitZ(), V::Zero());
  std::vector<ContactSegment<S>> segments;
  force_chains(all.contacts, 0.5, all.position_of(), all.is_grain(), segments);
  REQUIRE(segments.size() == 2);
  CHECK(segments[0].from == V(0, 0, 1));
  CHECK(segments[0].to == V(0, 0, 3));
  CHECK((segments[0].point - V(0, 0.25, 2)).norm() < 1e-15);
  CHECK(segments[0].normal_force == doctest::Approx(4));
  CHECK(segments[0].friction_force == doctest::Approx(1));
  CHECK(segments[0].gap == -0.01);
  CHECK(segments[1].from == V(0, 0, 1));
  CHECK((segments[1].to - V(0.5, 0, 0)).norm() < 1e-15);
  CHECK(segments[1].normal_force == doctest::Approx(8));
  contact_segments(all.contacts, 0.5, all.position_of(), all.is_grain(), segments);
  CHECK(segments.size() == 3);
  CHECK(segments[2].normal_force == 0);
}

TEST_CASE("the points of a pair carry one force") {
  using S = Space<3>;
  using V = S::Vector;
  auto all = two_grains_and_wall(V(0, 0, 0), V(0, 0, 2));
  all.add(0, 1, V(1, 0, 1), V::UnitZ(), V(0, 1, 3));
  all.add(0, 1, V(-1, 0, 1), V::UnitZ(), V(4, -1, 1));
  all.add(0, 1, V(0, 1, 1), V::UnitZ(), V::Zero());  // a point without force
  all.add(0, 2, V(0, 0, -1), -V::UnitZ(), V(0, 0, -4));
  all.add(1, 2, V(0, 0, 1), -V::UnitZ(), V(0, 0, 0));
  const auto pairs = all.pairs(0.5);
  REQUIRE(pairs.size() == 2);
  CHECK(pairs[0].points == 2);
  CHECK((pairs[0].normal - V::UnitZ()).norm() < 1e-15);
  CHECK((pairs[0].force - V(8, 0, 8)).norm() < 1e-14);
  CHECK(pairs[0].normal_force == doctest::Approx(8));
  CHECK(pairs[0].friction_force == doctest::Approx(8));
  // The centre of pressure: one of four units of normal force acts at x = -1, three at x = 1.
  CHECK((pairs[0].lever_a - V(0.5, 0, 1)).norm() < 1e-15);
  CHECK((pairs[0].lever_b - V(0.5, 0, -1)).norm() < 1e-15);
  CHECK(pairs[1].b == 2);
  CHECK(pairs[1].normal_force == doctest::Approx(8));
  CHECK(pairs[1].friction_force == 0);
}

TEST_CASE_TEMPLATE("the fabric of a lattice is isotropic, that of chains their direction", S,
                   Space<2>, Space<3>) {
  using V = typename S::Vector;
  using M = typename S::Matrix;
  // Makes one pair of grains for each given normal.
  const auto with = [](const std::vector<V>& normals) {
    Assembly<S> all;
    for (const V& n : normals) {
      const auto a = static_cast<std::uint32_t>(all.position.size());
      all.position.push_back(V::Zero());
      all.position.push_back(n);
      all.grain.insert(all.grain.end(), {true, true});
      all.add(a, a + 1, n / 2, n, n);
      all.add(a, a + 1, n / 2, n, 3 * n);  // a second point must not change the fabric
    }
    all.position.push_back(V::Zero());
    all.grain.push_back(false);
    const auto wall = static_cast<std::uint32_t>(all.position.size() - 1);
    // A contact with a wall must not change the fabric.
    all.add(0, wall, V::Zero(), V::UnitX(), V::UnitX());
    return all;
  };
  const Aabb<S> box{V::Constant(-1), V::Constant(1)};
  std::vector<V> axes;
  for (int k = 0; k < S::dim; ++k) axes.push_back(V::Unit(k));
  const auto lattice = with(axes).fabric_in(box);
  CHECK(lattice.pairs == std::size_t{S::dim});
  CHECK((lattice.tensor - M::Identity() / S::dim).norm() < 1e-15);
  CHECK(lattice.anisotropy().norm() < 1e-14);

  // Three normals along x and one along the last axis.
  const auto chains =
      with({V::UnitX(), -V::UnitX(), V::UnitX(), V::Unit(S::dim - 1)}).fabric_in(box);
  M expected = M::Zero();
  expected(0, 0) = 0.75;
  expected(S::dim - 1, S::dim - 1) = 0.25;
  CHECK((chains.tensor - expected).norm() < 1e-15);
  CHECK(chains.anisotropy()(0, 0) ==
        doctest::Approx(S::dim * (S::dim + 2) / 2.0 * (0.75 - 1.0 / S::dim)));
  CHECK(std::abs(chains.anisotropy().trace()) < 1e-14);

  // Pairs whose centre of pressure lies outside of the control volume are not counted.
  Aabb<S> above = box;
  above.lower[0] = 0.25;
  CHECK(with(axes).fabric_in(above).pairs == 1);
  above.lower[0] = 0.75;
  CHECK(with(axes).fabric_in(above).pairs == 0);
  CHECK(with(axes).fabric_in(above).anisotropy().norm() == 0);
  CHECK_THROWS_AS(with(axes).fabric_in({}), std::invalid_argument);
}

TEST_CASE("the anisotropy of a density of normals is read off its fabric") {
  // Normals with the density E(theta) = (1 + a cos 2(theta - c)) / 2 pi, one at each quantile.
  using S = Space<2>;
  const double pi = std::acos(-1.0), a = 0.6, c = 0.4;
  const int count = 20000;
  std::vector<PairForce<S>> pairs;
  for (int k = 0; k < count; ++k) {
    const double share = 2 * pi * (k + 0.5) / count;
    double theta = share;
    for (int i = 0; i < 100; ++i) theta = share - a / 2 * std::sin(2 * theta);
    const S::Vector n(std::cos(theta + c), std::sin(theta + c));
    pairs.push_back({0, 1, 1, ContactClass::edge_edge, n, n, -n, n, 1, 0});
  }
  const Aabb<S> box{S::Vector(-2, -2), S::Vector(2, 2)};
  const auto origin = [](std::uint32_t) { return S::Vector(0, 0); };
  const auto found = fabric<S>(pairs, box, origin, [](std::uint32_t) { return true; });
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(c).toRotationMatrix();
  const Eigen::Matrix2d expected = turn * Eigen::Vector2d(a, -a).asDiagonal() * turn.transpose();
  CHECK((found.anisotropy() - expected).norm() < 1e-6);
}

TEST_CASE("the distribution of forces is a density of their ratio to the mean") {
  const std::vector<double> forces = {1, 1, 3, 3, 3, 7, 10, 4};  // the mean is 4
  const auto of = [&](std::size_t k) { return forces[k]; };
  const auto found = force_distribution<double>(forces.size(), of, 4, 2.0);
  CHECK(found.count == 8);
  CHECK(found.mean == 4);
  CHECK(found.width == 0.5);
  CHECK(found.density == std::vector<double>{0.5, 0.75, 0.25, 0.25});
  CHECK(found.beyond == 0.125);
  CHECK(found.ratio(1) == 0.75);
  double all = found.beyond;
  for (const double p : found.density) all += p * found.width;
  CHECK(all == 1);

  // Exponentially distributed forces, P = exp(-f/<f>), one at each quantile.
  const std::size_t many = 100000;
  const auto quantile = [&](std::size_t k) { return -3 * std::log((double(k) + 0.5) / many); };
  const auto decay = force_distribution<double>(many, quantile, 20, 5.0);
  CHECK(decay.mean == doctest::Approx(3).epsilon(1e-4));
  for (std::size_t k = 0; k < 20; ++k) {
    const double mean = (std::exp(-0.25 * double(k)) - std::exp(-0.25 * double(k + 1))) / 0.25;
    CHECK(decay.density[k] == doctest::Approx(mean).epsilon(5e-3));
  }

  const auto none = force_distribution<double>(3, [](std::size_t) { return 0.0; });
  CHECK(none.mean == 0);
  CHECK(none.density[0] == 0);
  CHECK(force_distribution<double>(0, of).count == 0);
  const auto negative = [](std::size_t) { return -1.0; };
  CHECK_THROWS_AS(force_distribution<double>(1, negative), std::invalid_argument);
  CHECK_THROWS_AS(force_distribution<double>(8, of, 0), std::invalid_argument);
  CHECK_THROWS_AS(force_distribution<double>(8, of, 4, 0.0), std::invalid_argument);
}

TEST_CASE("classes of contacts share the coordination and the force") {
  using S = Space<3>;
  using V = S::Vector;
  Assembly<S> all;
  all.position.assign(4, V::Zero());
  all.grain = {true, true, true, false};
  const auto push = [&](std::uint32_t a, std::uint32_t b, double impulse, ContactClass c) {
    all.add(a, b, V::Zero(), V::UnitX(), V(impulse, 0, 0));
    all.contacts.classes.back() = c;
  };
  for (int point = 0; point < 3; ++point) push(0, 1, 1, ContactClass::face_face);
  push(0, 2, 2, ContactClass::vertex_face);
  push(0, 3, 4, ContactClass::vertex_face);
  push(1, 2, 0, ContactClass::edge_edge);  // carries no force
  push(2, 3, 1, ContactClass::edge_face);
  const auto found = contact_classes<S>(all.pairs(), 3, all.is_grain());
  CHECK(found[ContactClass::face_face].pairs == 1);
  CHECK(found[ContactClass::face_face].points == 3);
  CHECK(found[ContactClass::face_face].neighbours == doctest::Approx(2.0 / 3));
  CHECK(found[ContactClass::face_face].force == doctest::Approx(0.3));
  CHECK(found[ContactClass::vertex_face].pairs == 2);
  CHECK(found[ContactClass::vertex_face].neighbours == doctest::Approx(1));
  CHECK(found[ContactClass::vertex_face].force == doctest::Approx(0.6));
  CHECK(found[ContactClass::edge_edge].pairs == 0);
  double neighbours = 0;
  for (const auto& share : found.shares) neighbours += share.neighbours;
  CHECK(neighbours == doctest::Approx(all.coordination(0).neighbours));
  CHECK(contact_classes<S>({}, 0, all.is_grain())[ContactClass::face_face].force == 0);
}

TEST_CASE_TEMPLATE("stress of a lattice under pressure is the pressure on every axis", S, Space<2>,
                   Space<3>) {
  // A periodic cell of size 1 with one grain, which touches its neighbouring images. Each contact
  // carries the pressure times a cross-section of 1.
  using V = typename S::Vector;
  const double pressure = 5, step = 1e-2;
  Assembly<S> lattice;
  lattice.position = {V::Constant(0.5)};
  lattice.grain = {true};
  PeriodicCell<S> cell;
  for (int k = 0; k < S::dim; ++k) {
    cell.set(k, 0, 1);
    // The neighbouring image along axis k.
    lattice.position.push_back(lattice.position[0] + V::Unit(k));
    lattice.grain.push_back(true);
    lattice.add(0, std::uint32_t(k + 1), lattice.position[0] + V::Unit(k) / 2, V::Unit(k),
                pressure * step * V::Unit(k));
  }
  const Aabb<S> box{V::Zero(), V::Ones()};
  const auto sigma =
      contact_stress(lattice.contacts, step, box, lattice.position_of(), lattice.is_grain(), cell);
  CHECK((sigma - pressure * S::Matrix::Identity()).norm() < 1e-13);
}

TEST_CASE("a step that is no time is refused") {
  using S = Space<2>;
  const Assembly<S> none;
  std::vector<ContactSegment<S>> segments;
  const Aabb<S> box{S::Vector::Zero(), S::Vector::Ones()};
  using Limits = std::numeric_limits<double>;
  for (const double step : {0.0, -1.0, Limits::infinity(), Limits::quiet_NaN()}) {
    CHECK_THROWS_AS(
        force_chains(none.contacts, step, none.position_of(), none.is_grain(), segments),
        std::invalid_argument);
    CHECK_THROWS_AS(
        contact_segments(none.contacts, step, none.position_of(), none.is_grain(), segments),
        std::invalid_argument);
    CHECK_THROWS_AS(none.pairs(step), std::invalid_argument);
    CHECK_THROWS_AS(contact_stress(none.contacts, step, box, none.position_of(), none.is_grain()),
                    std::invalid_argument);
  }
  CHECK_THROWS_WITH_AS(
      moreau::contact_segment(none.contacts, 3, 1.0, none.position_of(), none.is_grain()),
      "contact_segment: c = 3 must be below the number of contacts", std::invalid_argument);
  CHECK_THROWS_AS(
      contact_stress(none.contacts, 1.0, Aabb<S>{}, none.position_of(), none.is_grain()),
      std::invalid_argument);
}
