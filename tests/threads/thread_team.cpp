// SPDX-License-Identifier: MIT
// The number of threads has no influence on the results.
#include "moreau/parallel/thread_team.hpp"

#include <atomic>
#include <barrier>
#include <cstddef>
#include <doctest/doctest.h>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include "moreau/law/compliant.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polyhedron.hpp"

#include "conformance/solver.hpp"
#include "conformance/support_only.hpp"
#include "threads/same_bits.hpp"
#include "types.hpp"

using namespace solve_test;
using namespace threads_test;
using Vector3 = Space<3>::Vector;

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

namespace {

/// A ball that is known by its support function, which throws on the main thread on demand.
struct Brittle : Ball<> {
  using Vector = Vector3;
  static inline bool breaks = false;
  static inline const auto main_thread = std::this_thread::get_id();

  using Ball<>::Ball;
  Vector support(const Vector& direction) const {
    if (breaks && std::this_thread::get_id() == main_thread) throw std::runtime_error("broken");
    return Ball<>::support(direction);
  }
};

}  // namespace

TEST_CASE_TEMPLATE("a shape that throws ends the step, not the simulation", Law, SignoriniCoulomb<>,
                   LinearSpringDashpot<>) {
  const auto law = [] {
    if constexpr (std::is_same_v<Law, SignoriniCoulomb<>>)
      return Law(0.4);
    else
      return Law(1e4, 5e3, 0.4, 0.5);
  }();
  for (const int size : {1, 2, 3}) {
    Simulation<conformance::SupportOnly<Brittle>, Law> world(grain_size, Materials<Law>(1, law));
    world.set_team(eager(size));
    const ShapeId shape = world.add_shape(conformance::SupportOnly(Brittle(grain_size / 2)));
    world.add_wall(Vector3::UnitZ(), Vector3::Zero());
    world.set_gravity(-9.81 * Vector3::UnitZ());
    const Lattice<Space<3>> lattice{7, 7, 0.0199};
    lattice.for_each(
        [&](const Vector3& centre, int, int, int) { world.add_grain(shape, {centre}, 2700); });
    std::size_t points = 0;
    for (int step = 0; step < 6; ++step) {
      Brittle::breaks = step % 2 == 0;
      const std::size_t before = world.contacts().size();
      if (Brittle::breaks) {
        CHECK_THROWS_WITH_AS(world.step(1e-5), "broken", std::runtime_error);
        // The contacts are those to which the memory of the laws belongs.
        CHECK(world.contacts().size() == before);
      } else {
        points = world.step(1e-5).points;
      }
      if (step == 3) world.set_velocity(world.grain(3), Vector3(0, 0, 20));  // loses its contacts
    }
    Brittle::breaks = false;
    CHECK(points > 343);
  }
}

/// Teams of all sizes: the same bits as one thread.
template <class S>
void check_solution(Assembly<S>& problem, double tolerance) {
  std::vector<typename S::Vector> alone;
  const SolveReport report =
      problem.solve(ColouredGaussSeidel(fast<S>(tolerance)), problem.laws, alone);
  CHECK(report.converged);
  for (const int threads : team_sizes) {
    std::vector<typename S::Vector> impulses;
    ColouredGaussSeidel solver(fast<S>(tolerance));
    solver.set_team(eager(threads));
    const SolveReport parallel = problem.solve(solver, problem.laws, impulses);
    CHECK(parallel.sweeps == report.sweeps);
    CHECK(parallel.residual == report.residual);
    for (std::size_t c = 0; c < alone.size(); ++c) CHECK(impulses[c] == alone[c]);
  }
}

TEST_CASE_TEMPLATE("teams of all sizes solve to the same bits", S, Space<2>, Space<3>) {
  Assembly<S> chains(6), blocks = Assembly<S>::lattice(36, 1);
  check_solution(chains, 1e-6);
  check_solution(blocks, 1e-3);
}

TEST_CASE_TEMPLATE("1, 2, 3, 4 and 8 threads simulate to the same bits", ShapeT,
                   MOREAU_TYPES((Polyhedron<double>), (Disk<double>))) {
  const SignoriniCoulomb<> coulomb(0.4);
  check_bits<ShapeT>(coulomb);
  CHECK(fall<ShapeT>(coulomb, ThreadTeam(2)) == fall<ShapeT>(coulomb, Team()));
}

TEST_CASE_TEMPLATE("1, 2, 3, 4 and 8 threads simulate compliant contacts to the same bits", ShapeT,
                   MOREAU_TYPES((Disk<double>), (Polyhedron<double>))) {
  check_bits<ShapeT>(Compliant<>(SignoriniCoulomb<>(0.4), 1e6));
}

namespace {

/// Starts its threads for each piece of work. Exact, and slow: a pool would keep them.
class FreshThreads final : public moreau::TeamThreads {
 public:
  explicit FreshThreads(int size) : size_(size) { shares = true; }
  int size() const override { return size_; }
  void run(const Work& work) override {
    if (busy_.exchange(true)) return work(0, 1, moreau::TeamBarrier());  // the members work
    std::barrier<> barrier(size_);
    const moreau::TeamBarrier wait(
        &barrier, [](void* all) { static_cast<std::barrier<>*>(all)->arrive_and_wait(); });
    std::vector<std::exception_ptr> errors(static_cast<std::size_t>(size_));
    const auto take_part = [&](int rank) {
      try {
        work(rank, size_, wait);
      } catch (...) {
        errors[static_cast<std::size_t>(rank)] = std::current_exception();
        barrier.arrive_and_drop();  // the others do not wait for this member
      }
    };
    std::vector<std::thread> threads;
    for (int rank = 1; rank < size_; ++rank) threads.emplace_back(take_part, rank);
    take_part(0);
    for (std::thread& thread : threads) thread.join();
    busy_ = false;
    for (const std::exception_ptr& error : errors)
      if (error) std::rethrow_exception(error);
  }
  bool begin(moreau::TimedWork) override { return true; }  // shares every piece of work
  void end(moreau::TimedWork, std::size_t) override {}

 private:
  int size_;
  std::atomic<bool> busy_{false};
};

}  // namespace

TEST_CASE("threads of one's own") {
  const Team team(std::make_shared<FreshThreads>(3));
  CHECK_THROWS_WITH_AS(team.run([](int rank, int, auto&& wait) {
    if (rank == 1) throw std::runtime_error("member 1");
    wait();
  }),
                       "member 1", std::runtime_error);
  Assembly<Space<2>> chains(6);
  std::vector<Space<2>::Vector> alone, shared;
  ColouredGaussSeidel solver(fast<Space<2>>(1e-6));
  chains.solve(solver, chains.laws, alone);
  solver.set_team(team);
  chains.solve(solver, chains.laws, shared);
  CHECK(shared == alone);
}

TEST_CASE("simulations that run at the same time may share a team") {
  using Grain = Disk<double>;
  const SignoriniCoulomb<> coulomb(0.4);
  const auto alone = fall<Grain>(coulomb, Team());
  for (const Team& team :
       {Team(ThreadTeam(2)), eager(2), Team(std::make_shared<FreshThreads>(2))}) {
    std::vector<std::vector<double>> results(3);
    std::vector<std::thread> threads;
    for (auto& result : results) threads.emplace_back([&] { result = fall<Grain>(coulomb, team); });
    for (std::thread& thread : threads) thread.join();
    for (const auto& result : results) CHECK(result == alone);
  }
}

TEST_CASE(
    "a team that works for one simulation lets the others work alone, also after an exception") {
  const ThreadTeam team(2);
  std::thread([&] {
    CHECK_THROWS(team.run_timed(TimedWork::sweep, 1, 0,
                                [](int, int, auto&&) { throw std::runtime_error("broken"); }));
  }).join();
  int shared = 0;
  for (int piece = 0; piece < 12; ++piece)
    team.run_timed(TimedWork::sweep, 1, 0, [&](int rank, int size, auto&&) {
      if (rank == 0) shared += size == 2;
    });
  CHECK(shared > 0);  // the trial of the tuner: the thread that threw no longer holds the team
}

TEST_CASE("a team without members is refused") {
  CHECK_THROWS_WITH_AS(ThreadTeam(0), doctest::Contains("threads"), std::invalid_argument);
}
