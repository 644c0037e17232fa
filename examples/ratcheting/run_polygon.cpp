// SPDX-License-Identifier: MIT
#include "moreau/shape/polygon.hpp"

#include "run_impl.hpp"

template int ratcheting::run<moreau::Polygon<double>>(const Parameters&);
