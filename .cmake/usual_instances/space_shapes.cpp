// SPDX-License-Identifier: MIT
#include "moreau/instances/usual.hpp"

namespace moreau {
template <>
const char detail::InstancesCompiledWithTheSameFlags<EIGEN_MAX_STATIC_ALIGN_BYTES>::yes = 1;
MOREAU_BALL_AND_POLYTOPE_INSTANCES(template, Ball<double>, Polyhedron<double>)
}  // namespace moreau
