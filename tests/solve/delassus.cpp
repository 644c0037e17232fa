// SPDX-License-Identifier: MIT
// The Delassus operator of contacts: blocks, velocities and impulses agree with one another.
#include <algorithm>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "moreau/motion/mobility.hpp"

#include "solve/assembly.hpp"
#include "types.hpp"

using namespace solve_test;

TEST_CASE_TEMPLATE("a unit impulse changes the velocity of its contact by a column of its block", S,
                   Space<2>, Space<3>) {
  Assembly<S> problem(3);
  auto& op = problem.op;
  for (std::size_t c = 0; c < op.size(); ++c) {
    const typename S::Matrix block = op.block(c).matrix();
    CHECK((op.block_of_a(c) + op.block_of_b(c) - block).norm() < 1e-14 * block.norm());
    CHECK(op.trace(c) == doctest::Approx(block.trace()).epsilon(1e-14));
    CHECK((op.frame(c).transpose() * op.frame(c)).isIdentity(1e-14));
    for (int k = 0; k < S::dim; ++k) {
      op.clear();
      op.apply(c, S::Vector::Unit(k));
      const typename S::Vector change = op.velocity(c) - op.free_velocity(c);
      CHECK((change - block.col(k)).norm() < 1e-14 * block.norm());
      CHECK(op.normal_velocity(c) == doctest::Approx(op.velocity(c)[0]).epsilon(1e-14));
    }
  }
}

TEST_CASE_TEMPLATE("impulses one after the other and all at once give the same velocities", S,
                   Space<2>, Space<3>) {
  Assembly<S> problem(4);
  auto& op = problem.op;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<typename S::Vector> impulses(op.size());
  for (auto& impulse : impulses)
    for (double& x : impulse) x = unit(random);
  for (std::size_t c = 0; c < op.size(); ++c) op.apply(c, impulses[c]);
  std::vector<typename S::Twist> expected;
  for (std::size_t i = 0; i < op.body_count(); ++i) expected.push_back(op.velocity_change(i));
  op.clear();
  for (std::size_t c = 0; c < op.size(); ++c) op.push(c, impulses[c]);
  op.move();
  for (std::size_t i = 0; i < op.body_count(); ++i)
    CHECK((op.velocity_change(i) - expected[i]).norm() < 1e-12);
}

TEST_CASE_TEMPLATE("impulses in the frames of the contacts are rows in the frames of the operator",
                   S, Space<2>, Space<3>) {
  const Assembly<S> problem(5);
  const auto& op = problem.op;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<typename S::Vector> impulses(op.size());
  for (auto& impulse : impulses)
    for (double& x : impulse) x = unit(random);
  std::vector<typename S::Vector> rows = impulses;
  op.to_rows(rows);
  for (std::size_t c = 0; c < op.size(); ++c) {
    const typename S::Vector push = problem.contacts[c].frame * impulses[c];
    CHECK((op.frame(c) * rows[c] - push).norm() < 1e-14);
    CHECK(op.turned(c, impulses[c]) == rows[c]);
    CHECK((op.turned_back(c, rows[c]) - impulses[c]).norm() < 1e-14);
  }
  std::vector<typename S::Vector> back(op.size());
  op.from_rows(rows, back);
  for (std::size_t c = 0; c < op.size(); ++c) CHECK((back[c] - impulses[c]).norm() < 1e-14);
}

TEST_CASE_TEMPLATE("relative velocities of bodies are those of the operator", S,
                   MOREAU_TYPES((Space<2>, Space<3>), (Space<2, float>, Space<3, float>))) {
  using T = typename S::Scalar;
  const Assembly<S> problem(6);
  const auto& op = problem.op;
  for (std::size_t c = 0; c < op.size(); ++c) {
    const Contact<S>& contact = problem.contacts[c];
    const typename S::Vector u =
        relative_velocity(contact, problem.free[contact.a], problem.free[contact.b]);
    const T rounding = 64 * std::numeric_limits<T>::epsilon();
    CHECK((op.turned(c, u) - op.free_velocity(c)).norm() <= rounding);
    CHECK(op.row(c, u, S::Angular::Zero()) == op.turned(c, u));
  }
}

TEST_CASE_TEMPLATE("the operator knows the islands of its contacts until it is assembled again", S,
                   MOREAU_TYPES((Space<2>, Space<3>), (Space<2, float>, Space<3, float>))) {
  Assembly<S> problem(7);
  auto& op = problem.op;
  const std::size_t floor = op.body_count() - 1;
  CHECK(op.freedoms()[floor] == 0);
  CHECK(op.freedoms()[0] == 2);
  typename S::Scalar longest = 0;
  for (const Contact<S>& contact : problem.contacts)
    for (const auto& [body, lever] :
         {std::pair(contact.a, contact.lever_a), std::pair(contact.b, contact.lever_b)})
      if (body != floor) longest = std::max(longest, lever.norm());
  CHECK(double(op.longest_lever()) == doctest::Approx(double(longest)).epsilon(1e-6));

  const auto check = [&](std::size_t count) {
    // Of the contacts of the first bodies alone, those of the bodies above `count` being gone.
    List<Contact<S>> some;
    for (const Contact<S>& contact : problem.contacts)
      if (contact.a < count && (contact.b < count || contact.b == floor)) some.push_back(contact);
    op.assemble(some, problem.roots, problem.free);
    const auto& islands = op.islands();
    CHECK(!islands.has_large());
    std::size_t contacts = 0, bodies = 0;
    for (std::size_t k = 0; k < islands.size(); ++k) {
      contacts += islands.contacts(k).size();
      bodies += islands.bodies(k);
      for (const std::uint32_t c : islands.contacts(k)) CHECK(op.bodies(c)[0] == some[c].a);
    }
    CHECK(contacts == some.size());
    CHECK(bodies <= count);
    return contacts;
  };
  const std::size_t few = check(40), more = check(100);
  CHECK(few < more);
  CHECK(check(40) == few);
}

TEST_CASE("the inverse mass of a wall that moves along one axis") {
  using S = Space<3>;
  const MobilityRoot<S> grain{S::Matrix::Identity() / 2, 3 * S::Inertia::Identity(), true};
  const InverseMass<S> of_grain(grain);
  CHECK(of_grain.velocity_of({4, 0, 8}) == S::Vector(1, 0, 2));  // impulse / mass
  CHECK(of_grain.spin_of({0, 1, 0}) == S::Angular(0, 9, 0));
  CHECK(of_grain.is_isotropic());

  const S::Vector axis = S::Vector(1, 2, 2) / 3;
  const InverseMass<S> of_wall({axis * axis.transpose(), S::Inertia::Zero()});
  CHECK((of_wall.velocity_of({3, 0, 0}) - axis).norm() < 1e-15);
  CHECK(!of_wall.is_isotropic());
  CHECK(of_wall.moves());

  const InverseMass<S> prescribed;
  CHECK(!prescribed.moves());
  CHECK(prescribed.is_isotropic());
}

// A wall that moves along one axis alone and a grain of prescribed motion touch across it: no impulse changes their
// normal velocity, however the axis lies.
TEST_CASE_TEMPLATE("a contact at which no impulse changes the normal velocity does not act", S,
                   MOREAU_TYPES((Space<2>, Space<3>), (Space<2, float>, Space<3, float>))) {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;
  using Law = SignoriniCoulomb<T>;
  const MobilityRoot<S> prescribed{Matrix::Zero(), S::Inertia::Zero()};
  std::vector<typename S::Twist> free(2, S::Twist::Zero());
  for (int k = 0; k < 100; ++k) {
    const auto turn = S::exp(S::Angular::Constant(T(0.1) * T(k)));
    const Vector x = turn * Vector::UnitX(), n = turn * Vector::UnitY();
    const std::vector<MobilityRoot<S>> roots{{x * x.transpose(), S::Inertia::Zero()}, prescribed};
    free[1].template head<S::dim>() = -n;  // they approach
    std::vector<Contact<S>> contacts{{0, 1, 0, 0, S::contact_frame(n), n, -n}};
    ContactProblem<BodyDelassus<S>, Law> problem;
    problem.delassus.assemble(contacts, roots, free);
    problem.laws = {Law(T(0.5))};
    problem.law_of = {0};
    CHECK(problem.delassus.block(0).matrix().allFinite());
    CHECK(problem.delassus.free_velocity(0)[0] == std::numeric_limits<T>::infinity());
    std::vector<Vector> impulses{Vector::Zero()};
    ColouredGaussSeidel::Workspace<BodyDelassus<S>, Law> workspace;
    const SolveReport report = ColouredGaussSeidel().solve(problem, std::span(impulses), workspace);
    CHECK(report.converged);
    CHECK(impulses[0].isZero(0));
  }
}
