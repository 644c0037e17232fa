// SPDX-License-Identifier: MIT
#include "moreau/instances/usual.hpp"

namespace moreau {
template <>
const char detail::InstancesCompiledWithTheSameFlags<EIGEN_MAX_STATIC_ALIGN_BYTES>::yes = 1;
}  // namespace moreau
