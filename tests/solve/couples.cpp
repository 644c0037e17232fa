// SPDX-License-Identifier: MIT
// Contact problems with couples, rigid and with springs: both solvers solve them, and the operator is one.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <doctest/doctest.h>
#include <span>
#include <type_traits>
#include <vector>

#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/solve/concepts.hpp"

#include "solve/assembly.hpp"
#include "types.hpp"

using namespace solve_test;

namespace {

template <class S, class Law>
void check_solvers(const Law& law) {
  const double tolerance = 1e-9;
  ColouredOptions coloured;
  GaussSeidelOptions plain;
  coloured.tolerance = plain.tolerance = tolerance;
  coloured.max_sweeps = plain.max_sweeps = 20000;
  // Forward sweeps approach a solution of one of the plane problems by a factor of 1 - 6.8e-5: two points of a pair, which
  // slide and do not roll, exchange load. They take 102,120 sweeps, those that go forward and backward in turn 3,500.
  plain.order = SweepOrder::symmetric;
  for (const std::uint64_t seed : {1u, 2u}) {
    AssemblyUnder<S, Law> assembly(seed, law);
    const auto solve = [&](const auto& solver) {
      std::vector<typename AssemblyUnder<S, Law>::Row> impulses;
      const SolveReport report = assembly.solve(solver, impulses);
      CHECK(report.converged);
      CHECK(report.residual <= tolerance);
      CHECK(std::abs(assembly.measure(impulses).residual - report.residual) <= 1e-12);
      return impulses;
    };
    const auto one = solve(ColouredGaussSeidel(coloured));
    const auto other = solve(NonlinearGaussSeidel(plain));
    if constexpr (CompliantLaw<Law, S>) {  // the solution is unique
      double square = 0, norm = 0, couples = 0;
      for (std::size_t c = 0; c < one.size(); ++c) {
        square += double((one[c] - other[c]).squaredNorm());
        norm += double(other[c].squaredNorm());
        if constexpr (Rolls<Law>) couples += double(angular<S>(other[c]).squaredNorm());
      }
      CHECK((couples > 0) == Rolls<Law>);
      CHECK(std::sqrt(square / norm) <= 1e-6);
    }
  }
}

}  // namespace

TEST_CASE_TEMPLATE("both solvers solve problems with couples", S,
                   MOREAU_TYPES((Space<3>), (Space<2>))) {
  using Rolling = RollingResistance<>;
  check_solvers<S>(Rolling(0.3, 0.1));
  check_solvers<S>(Compliant<Rolling>(Rolling(0.3, 0.1), 1e6));
#ifdef MOREAU_TEST_FURTHER_TYPES
  check_solvers<S>(Cohesive<Rolling>(Rolling(0.3, 0.1), 1));
  check_solvers<S>(Compliant<SignoriniCoulomb<>>(SignoriniCoulomb<>(0.3), 1e6));
#endif
}

TEST_CASE("the operator of points is that of couples without its last rows") {
  using S = Space<3>;
  AssemblyUnder<S, RollingResistance<>> coupled(3, RollingResistance<>(0.3, 0.1));
  AssemblyUnder<S, SignoriniCoulomb<>> points(3, SignoriniCoulomb<>(0.3));
  auto& all = coupled.problem.delassus;
  auto& some = points.problem.delassus;
  for (std::size_t c = 0; c < some.size(); ++c) {
    CHECK(all.block(c).point.matrix() == some.block(c).matrix());
    CHECK(linear<S>(all.free_velocity(c)) == some.free_velocity(c));
    CHECK(all.normal(c) == some.normal(c));
    Eigen::Matrix<double, 6, 1> impulse = Eigen::Matrix<double, 6, 1>::Zero();
    impulse.head<3>() = Eigen::Vector3d(1, 0.2, -0.3);
    all.push(c, impulse);
    some.push(c, impulse.head<3>());
  }
  all.move();
  some.move();
  for (std::size_t c = 0; c < some.size(); ++c)
    CHECK(Eigen::Vector3d(all.velocity(c).head<3>()) == some.velocity(c));
  // The block of a contact is the sum of the parts of its bodies, by impulses one after the other.
  for (std::size_t c = 0; c < all.size(); c += 7) {
    const Eigen::Matrix<double, 6, 6> sum = all.block_of_a(c) + all.block_of_b(c);
    CHECK((all.block(c).matrix() - sum).norm() <= 1e-12 * sum.norm());
    for (int k = 0; k < 6; ++k) {
      all.clear();
      all.apply(c, Eigen::Matrix<double, 6, 1>::Unit(k));
      CHECK((all.velocity(c) - all.free_velocity(c) - sum.col(k)).norm() <= 1e-12 * sum.norm());
    }
  }
}
