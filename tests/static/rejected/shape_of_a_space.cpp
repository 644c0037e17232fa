// SPDX-License-Identifier: MIT
// A space where a shape takes a scalar.
// expect: (constraint failure for.*floating_point|constraints not satisfied for alias template 'Ball')
#include "moreau/shape/ball.hpp"

#ifdef MOREAU_CORRECTED
using Grain = moreau::Ball<double>;
#else
using Grain = moreau::Ball<moreau::Space<3>>;
#endif
Grain* grain;
