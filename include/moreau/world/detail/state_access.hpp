// SPDX-License-Identifier: MIT
#pragma once

namespace moreau::detail {

/// Names the members of a simulation for one in several processes (distributed/detail/world_parts.hpp). The classes whose
/// members it names declare it as their friend.
struct StateAccess;

}  // namespace moreau::detail
