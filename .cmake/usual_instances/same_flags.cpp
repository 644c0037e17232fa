// SPDX-License-Identifier: MIT
#include "moreau/instances/usual.hpp"

namespace moreau::detail {
template <int AlignBytes>
const char InstancesCompiledWithTheSameFlags<AlignBytes>::yes = 1;
template struct InstancesCompiledWithTheSameFlags<EIGEN_MAX_STATIC_ALIGN_BYTES>;
}  // namespace moreau::detail
