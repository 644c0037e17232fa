// SPDX-License-Identifier: MIT
// Both sweep solvers under every set-valued law: what they report is what is measured afterwards, and the default
// solves all problems but one of rigid bonds at their strength.
#include <concepts>
#include <doctest/doctest.h>

#include "conformance/set_valued_laws.hpp"
#include "conformance/solver.hpp"

using namespace solve_test;

namespace {

/// @tparam S space of the assemblies
template <class S>
struct CheckSolvers {
  template <class Law>
  void operator()(const Law& law) const {
    const double tolerance = 1e-9;
    GaussSeidelOptions plain;
    plain.tolerance = tolerance;
    plain.max_sweeps = 20000;
    conformance::solver_under<S>(law, NonlinearGaussSeidel(plain), tolerance);
    conformance::solver_under<S>(law, ColouredGaussSeidel(fast<S>(tolerance, false)), tolerance);
    const int solved =
        conformance::solver_under<S>(law, ColouredGaussSeidel(fast<S>(tolerance)), tolerance);
    // Sweeps can fail for a large resistance to rolling (examples/guide/limits.md).
    CHECK(solved >= (std::same_as<Law, Bonded<>> ? 1 : 2));
  }
};

}  // namespace

TEST_CASE_TEMPLATE("both solvers under every law", S, Space<2>, Space<3>) {
  conformance::each_set_valued_law(1e6, CheckSolvers<S>());
}
