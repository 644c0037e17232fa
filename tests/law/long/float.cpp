// SPDX-License-Identifier: MIT
// Every law in single precision.
#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"

#include "conformance/law.hpp"
#include "conformance/regularized_law.hpp"
#include "conformance/set_valued_laws.hpp"

using namespace moreau;

namespace {

template <class S>
struct CheckLaw {
  template <class Law>
  void operator()(const Law& law) const {
    if constexpr (StatefulLaw<Law, S>)
      conformance::stateful_law<S>(law);
    else
      conformance::set_valued_law<S>(law);
    if constexpr (LaneLaw<Law, S>) conformance::lane_law<S>(law, RollingLaw<Law, S> ? 400 : 50);
  }
};

}  // namespace

TEST_CASE_TEMPLATE("set-valued laws, in single precision", S, Space<2, float>, Space<3, float>) {
  conformance::each_set_valued_law(1e8f, CheckLaw<S>());
}

TEST_CASE_TEMPLATE("regularized laws, in single precision", S, Space<2, float>, Space<3, float>) {
  using T = typename S::Scalar;
  conformance::regularized_law<S>(LinearSpringDashpot<T>(T(1e5), T(8e4), T(0.4), T(0.5)), 1e-5);
  conformance::regularized_law<S>(HertzMindlin<T>::of_material(T(1e8), T(0.3), T(0.4), T(0.5)),
                                  1e-5);
}
