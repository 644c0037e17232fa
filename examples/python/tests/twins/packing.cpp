// SPDX-License-Identifier: MIT
#include "packing/packing.cpp"

#include "digits.hpp"
