// SPDX-License-Identifier: MIT
#include "digits.hpp"
#include "plane_and_space/plane_and_space.cpp"
