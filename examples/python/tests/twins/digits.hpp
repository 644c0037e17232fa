// SPDX-License-Identifier: MIT
// The program that includes this header first prints numbers with all their bits.
#pragma once
#include <iostream>

const struct Digits {
  Digits() { std::cout.precision(17); }
} digits;
