// SPDX-License-Identifier: MIT
// Both, since the header may have been precompiled without.
#define DOCTEST_CONFIG_IMPLEMENT
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>
