// SPDX-License-Identifier: MIT
// The number of threads has no influence on the results.
#include "moreau/core/thread_team.hpp"

#include <atomic>
#include <doctest/doctest.h>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "moreau/law/compliant.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

#include "conformance/solver.hpp"

using namespace solve_test;

namespace {

// The thread sanitizer makes everything some fifty times slower.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define MOREAU_TEST_FEW_STEPS
#endif
#endif
#ifdef MOREAU_TEST_FEW_STEPS
constexpr int steps = 30;
constexpr int team_sizes[] = {2, 3};
#else
constexpr int steps = 150;
constexpr int team_sizes[] = {2, 3, 4, 8};
#endif

/// Lets a team share its work from now on, without measuring whether this is faster.
class EagerThreads final : public TeamThreads {
 public:
  explicit EagerThreads(int size) : pool_(size) { shares = true; }
  int size() const override { return pool_.size(); }
  void run(const Work& work) override { pool_.run(work); }
  bool begin(TimedWork) override { return true; }
  void end(TimedWork, std::size_t) override {}

 private:
  detail::ThreadPool pool_;
};
Team eager(int size) {
  return Team(std::make_shared<EagerThreads>(size));
}

/// 6 x 6 x 8 (in the plane 20 x 20) grains fall into a box, which is periodic along x.
template <class ShapeT, class Law>
std::vector<double> fall(const Law& law, const Team& team) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1, wide = up == 1 ? 20 : 6, high = up == 1 ? 20 : 8;
  constexpr double size = 0.02, cell = 0.024;
  Simulation<ShapeT, Law> world(size, Materials<Law>(1, law));
  world.set_team(team);
  const ShapeId shape = world.add_shape(regular_shape<ShapeT>(size));
  world.set_periodic(0, 0.0, wide * cell);
  for (int axis = 1; axis < S::dim; ++axis) world.add_wall(Vector::Unit(axis), Vector::Zero());
  if (up > 1) world.add_wall(-Vector::Unit(1), wide * cell * Vector::Unit(1));
  for (int k = 0; k < high; ++k)
    for (int i = 0; i < wide; ++i)
      for (int j = 0; j < (up > 1 ? wide : 1); ++j) {
        Vector position = Vector::Constant(cell * (j + 0.5));
        position[0] = cell * (i + 0.5 + 0.1 * (k % 2));
        position[up] = cell * (k + 0.5);
        world.add_grain(shape, {position, S::exp(S::Angular::Constant(0.1 * k + 0.3 * i))}, 2700);
      }
  world.set_gravity(-9.81 * Vector::Unit(up));
  std::vector<double> results;
  for (int step = 0; step < steps; ++step) {
    const StepReport report = world.step(5e-4);
    if (step % 10 != 9) continue;
    results.push_back(report.solve.residual);
    results.push_back(report.dissipation);
    results.push_back(double(report.points));
  }
  for (const Pose<S>& pose : world.bodies().pose)
    for (const double x : pose.position) results.push_back(x);
  return results;
}

}  // namespace

TEST_CASE("every member works, and waits for the others") {
  for (const int size : {1, 2, 3}) {
    const Team team = eager(size);
    CHECK(team.size() == size);
    std::vector<int> before(std::size_t(size), 0), after(std::size_t(size), 0);
    for (int round = 1; round <= 20; ++round)
      team.run([&](int rank, int count, auto&& wait) {
        before[std::size_t(rank)] = round;
        wait();
        int sum = 0;
        for (const int value : before) sum += value;
        after[std::size_t(rank)] = sum;
        if (count != size) after[0] = -1;
      });
    for (const int sum : after) CHECK(sum == 20 * size);
  }
}

namespace {

/// What `pieces` pieces of work cost that take the time 1 alone, as a tuner decides, relative to alone.
/// @param shared function: number of the piece -> its time if it is shared
template <class Shared>
double cost(int pieces, const Shared& shared) {
  detail::ShareTuner tuner;
  double sum = 0;
  for (int k = 0; k < pieces; ++k) {
    const double time = tuner.shares() ? shared(k) : 1;
    tuner.measured(time);
    sum += time;
  }
  return sum / pieces;
}

}  // namespace

TEST_CASE("work is shared while this is faster, by times that are given") {
  CHECK(cost(10000, [](int) { return 0.6; }) < 0.62);
  CHECK(cost(10000, [](int) { return 2.0; }) < 1.05);
  // A member that does not run for a while makes some pieces very slow.
  CHECK(cost(100000, [](int k) { return k % 100 == 7 ? 400.0 : 0.6; }) < 1.1);
  CHECK(cost(100000, [](int k) { return k % 10 == 7 ? 400.0 : 0.6; }) < 1.1);
  // The other programs end.
  CHECK(cost(100000, [](int k) { return k < 1000 ? 2.0 : 0.6; }) < 0.7);
}

TEST_CASE("little work is not shared") {
  const Team team = eager(2);
  const auto size_of = [&](std::size_t amount) {
    std::atomic<int> size{0};
    team.run_timed(TimedWork::sweep, amount, 1000, [&](int rank, int count, auto&&) {
      if (rank == 0) size = count;
    });
    return size.load();
  };
  CHECK(size_of(1000) == 2);
  CHECK(size_of(999) == 1);
}

TEST_CASE("an exception of a member is thrown again") {
  const Team team = eager(3);
  for (int round = 0; round < 3; ++round)
    CHECK_THROWS_WITH_AS(team.run([](int rank, int, auto&&) {
      if (rank == 1) throw std::runtime_error("member 1");
    }),
                         "member 1", std::runtime_error);
  // The others do not wait for a member that has thrown.
  for (int round = 0; round < 3; ++round)
    CHECK_THROWS_WITH_AS(team.run([&](int rank, int, auto&& wait) {
      wait();
      if (rank == round) throw std::runtime_error("between two barriers");
      for (int k = 0; k < 3; ++k) wait();
    }),
                         "between two barriers", std::runtime_error);
  CHECK_THROWS_WITH_AS(team.share(3, 1,
                                  [](std::size_t begin, std::size_t) {
                                    throw std::runtime_error("part " + std::to_string(begin));
                                  }),
                       "part 0", std::runtime_error);
  std::atomic<int> members{0};
  team.share(3, 1, [&](std::size_t, std::size_t) {
    team.run([&](int rank, int size, auto&&) { members += rank == 0 && size == 1 ? 0 : 100; });
  });
  CHECK(members == 0);
}

TEST_CASE_TEMPLATE("one, two and three threads solve to the same bits", S, Space<2>, Space<3>) {
  Assembly<S> problem(6);
  std::vector<typename S::Vector> alone;
  const SolveReport report = problem.solve(ColouredGaussSeidel(fast<S>(1e-6)), problem.laws, alone);
  CHECK(report.converged);
  for (const int threads : {1, 2, 3}) {
    std::vector<typename S::Vector> impulses;
    ColouredGaussSeidel solver(fast<S>(1e-6));
    solver.set_team(eager(threads));
    const SolveReport parallel = problem.solve(solver, problem.laws, impulses);
    CHECK(parallel.sweeps == report.sweeps);
    CHECK(parallel.residual == report.residual);
    for (std::size_t c = 0; c < alone.size(); ++c) CHECK(impulses[c] == alone[c]);
  }
}

TEST_CASE_TEMPLATE("1, 2, 3, 4 and 8 threads simulate to the same bits", ShapeT, Disk<double>,
                   Polyhedron<double>) {
  const SignoriniCoulomb<> coulomb(0.4);
  const auto alone = fall<ShapeT>(coulomb, Team());
  const auto springs = fall<ShapeT>(Compliant<>(coulomb, 1e6), Team());
  for (const int threads : team_sizes) {
    CHECK(fall<ShapeT>(coulomb, eager(threads)) == alone);
    CHECK(fall<ShapeT>(Compliant<>(coulomb, 1e6), eager(threads)) == springs);
  }
  CHECK(fall<ShapeT>(coulomb, ThreadTeam(2)) == alone);
}

TEST_CASE("a team without members is refused") {
  CHECK_THROWS_WITH_AS(ThreadTeam(0), doctest::Contains("threads"), std::invalid_argument);
}
