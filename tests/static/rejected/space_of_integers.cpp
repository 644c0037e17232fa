// SPDX-License-Identifier: MIT
// expect: (floating_point|is_floating_point)
#include "moreau/core/space.hpp"

#ifdef MOREAU_CORRECTED
moreau::Space<3, float>::Vector x;
#else
moreau::Space<3, int>::Vector x;
#endif
