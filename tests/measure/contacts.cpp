// SPDX-License-Identifier: MIT
// Measures that read the contacts: overlap, coordination, stress, force chains.
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <vector>

#include "moreau/measure/coordination.hpp"
#include "moreau/measure/force_chains.hpp"
#include "moreau/measure/overlap.hpp"
#include "moreau/measure/stress.hpp"

namespace {

using namespace moreau;

/// Bodies as points; contacts midway between them.
template <class S>
struct Assembly {
  std::vector<typename S::Vector> position;
  std::vector<bool> grain;
  Contacts<S> contacts;

  /// A contact between two bodies at a point, with the impulse that b receives in world axes.
  void add(std::uint32_t a, std::uint32_t b, const typename S::Vector& point,
           const typename S::Vector& normal, const typename S::Vector& impulse, double gap = 0) {
    const typename S::Matrix frame = S::contact_frame(normal);
    const typename S::Vector lever_a = point - position[a], lever_b = point - position[b];
    contacts.points.push_back({a, b, 0, gap, frame, lever_a, lever_b});
    contacts.keys.push_back({a, b, FeatureKey{}});
    contacts.classes.push_back(ContactClass::vertex_face);
    contacts.impulses.push_back(frame.transpose() * impulse);
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
  // A triangle 0 1 2 with every side, 3 hanging on 0, 4 hanging on 3, 5 alone, 6 a wall below.
  all.position.assign(7, V::Zero());
  all.grain = {true, true, true, true, true, true, false};
  const auto push = [&](std::uint32_t a, std::uint32_t b, double impulse) {
    all.add(a, b, V::Zero(), V::UnitX(), V(impulse, 0.5));
  };
  push(0, 1, 1);
  push(0, 1, 2);  // a second point of the same pair
  push(0, 2, 1);
  push(0, 3, 1);
  push(0, 5, 0);  // no force: no contact
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

  const Coordination core = all.coordination(2);  // 4 goes, then 3
  CHECK(core.grains == 3);
  CHECK(core.rattlers == 3);
  CHECK(core.pairs == 5);
  CHECK(core.neighbours == doctest::Approx((2 * 3 + 2) / 3.0));
  CHECK(all.coordination(3).grains == 0);  // 2 has two: then nothing holds
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
  column.add(0, 3, -0.5 * up, -up, -load * step * up);  // the wall is body b
  column.add(1, 2, 1.5 * up, up, load * step * up);
  Aabb<S> box{V::Constant(-2), V::Constant(2)};
  box.lower[S::dim - 1] = -0.5;  // from the wall to the top of grain 1: branches 0.5 + 1 + 1
  box.upper[S::dim - 1] = 2;
  const auto sigma =
      contact_stress(column.contacts, step, box, column.position_of(), column.is_grain());
  typename S::Matrix truth = S::Matrix::Zero();
  truth(S::dim - 1, S::dim - 1) = load * 2.5 / volume(box);
  CHECK((sigma - truth).norm() < 1e-12 * load);
  CHECK(truth(S::dim - 1, S::dim - 1) > 0);  // compression

  // Only the contact in the lower half; the other way round (a, b) makes no difference.
  box.upper[S::dim - 1] = 1;
  std::swap(column.contacts.points[1].a, column.contacts.points[1].b);
  std::swap(column.contacts.points[1].lever_a, column.contacts.points[1].lever_b);
  column.contacts.points[1].frame = S::contact_frame(up);
  const auto low =
      contact_stress(column.contacts, step, box, column.position_of(), column.is_grain());
  CHECK(low(S::dim - 1, S::dim - 1) == doctest::Approx(load * 1.5 / volume(box)));
}

TEST_CASE("stress of a balanced cell is that of the loads on its boundary") {
  // A grain in balance under four forces that also balance in torque: V sigma = sum x f over the
  // forces that push it from outside, with minus for compression positive.
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

TEST_CASE("force chains run from centre to centre, to the wall's contact point") {
  using S = Space<3>;
  using V = S::Vector;
  Assembly<S> all;
  all.position = {V(0, 0, 1), V(0, 0, 3), V(50, 50, 0)};
  all.grain = {true, true, false};
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

TEST_CASE("a step that is no time is refused") {
  using S = Space<2>;
  const Assembly<S> none;
  std::vector<ContactSegment<S>> segments;
  const Aabb<S> box{S::Vector::Zero(), S::Vector::Ones()};
  for (const double step : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK_THROWS_AS(
        force_chains(none.contacts, step, none.position_of(), none.is_grain(), segments),
        std::invalid_argument);
    CHECK_THROWS_AS(
        contact_segments(none.contacts, step, none.position_of(), none.is_grain(), segments),
        std::invalid_argument);
    CHECK_THROWS_AS(contact_stress(none.contacts, step, box, none.position_of(), none.is_grain()),
                    std::invalid_argument);
  }
  CHECK_THROWS_AS(
      contact_stress(none.contacts, 1.0, Aabb<S>{}, none.position_of(), none.is_grain()),
      std::invalid_argument);
}
