// SPDX-License-Identifier: MIT
// A position with two components for a pose in space.
// expect: (use of|call to) deleted (function|constructor).*Components
// and no other error
#include "moreau/core/pose.hpp"

#ifdef MOREAU_CORRECTED
const moreau::Pose<moreau::Space<3>> pose{{0, 0, 0}};
#else
const moreau::Pose<moreau::Space<3>> pose{{0, 0}};
#endif
