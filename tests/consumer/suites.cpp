// SPDX-License-Identifier: MIT
// The conformance suites of the installed library, each applied to one model of its concept.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include "moreau/detect/broad/cell_grid.hpp"
#include "moreau/law/frictionless.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/motion/moreau_jean.hpp"
#include "moreau/shape/ball.hpp"

#include "conformance/broad_phase.hpp"
#include "conformance/integrator.hpp"
#include "conformance/law.hpp"
#include "conformance/regularized_law.hpp"
#include "conformance/shape.hpp"
#include "conformance/solver.hpp"
#include "conformance/support_only.hpp"
#include "conformance/world.hpp"

using S = moreau::Space<2>;

TEST_CASE("a shape") {
  conformance::check_shape(moreau::BallIn<S>(1));
}
TEST_CASE("laws") {
  conformance::set_valued_law<S>(moreau::Frictionless<>(), 100);
  conformance::regularized_law<S>(moreau::LinearSpringDashpot<double>(1e4), 1e-4);
}
TEST_CASE("an integrator") {
  conformance::integrator<S>(moreau::MoreauJean());
}
TEST_CASE("a broad phase") {
  conformance::broad_phase<S>(moreau::CellGrid<S>());
}
