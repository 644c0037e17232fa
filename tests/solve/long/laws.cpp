// SPDX-License-Identifier: MIT
// Both sweep solvers under every set-valued law.
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
    const double tolerance = sizeof(typename S::Scalar) == 8 ? 1e-9 : 3e-5;
    GaussSeidelOptions plain;
    plain.tolerance = tolerance;
    plain.max_sweeps = 20000;
    conformance::solver_under<S>(law, NonlinearGaussSeidel(plain), tolerance);
    for (const bool accelerate : {false, true})
      conformance::solver_under<S>(law, ColouredGaussSeidel(fast<S>(tolerance, accelerate)),
                                   tolerance);
  }
};

}  // namespace

TEST_CASE_TEMPLATE("both solvers solve problems under every law", S, Space<2>, Space<3>) {
  conformance::each_set_valued_law(1e6, CheckSolvers<S>());
}

TEST_CASE_TEMPLATE("both solvers solve problems with couples, in single precision", S,
                   Space<2, float>, Space<3, float>) {
  conformance::each_rolling_law(1e6f, CheckSolvers<S>());
}
