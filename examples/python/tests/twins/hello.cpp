// SPDX-License-Identifier: MIT
#include "hello/hello.cpp"

#include "digits.hpp"
