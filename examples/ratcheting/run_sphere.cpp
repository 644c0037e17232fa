// SPDX-License-Identifier: MIT
#include "run_impl.hpp"

template int ratcheting::run<moreau::Sphere<moreau::Space<3>>>(const Parameters&);
