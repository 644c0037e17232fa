// SPDX-License-Identifier: MIT
#include "moreau/motion/moreau_jean.hpp"
#include "moreau/motion/velocity_verlet.hpp"

#include "conformance/integrator.hpp"

using moreau::Space;

TEST_CASE_TEMPLATE("integrators, in single precision", S, Space<2, float>, Space<3, float>) {
  conformance::integrator<S>(moreau::MoreauJean());
  conformance::integrator<S>(moreau::MoreauJean(1));
  conformance::integrator<S>(moreau::VelocityVerlet());
}
