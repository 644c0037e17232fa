// SPDX-License-Identifier: MIT
// A space is given as template argument where a shape requires a scalar type.
// expect: (constraint failure for.*floating_point|constraints not satisfied for alias template 'Ball')
#include "moreau/shape/ball.hpp"

#ifdef MOREAU_CORRECTED
using Grain = moreau::Ball<double>;
#else
using Grain = moreau::Ball<moreau::Space<3>>;
#endif
Grain* grain;
