// SPDX-License-Identifier: MIT
// The types of a test case that is compiled in two programs:
//
//   TEST_CASE_TEMPLATE("a name", T, MOREAU_TYPES((double), (float))) { ... }
//
// The program of the folder has the first types. moreau_test_FOLDER_types, which has the label long, has the
// further types: CMakeLists.txt compiles each file that uses this macro a second time, with
// MOREAU_TEST_FURTHER_TYPES defined. A test case of another type that only the long program has stands between
// #ifdef MOREAU_TEST_FURTHER_TYPES and #endif.
#pragma once

#define MOREAU_TYPES_OF(...) __VA_ARGS__
#ifdef MOREAU_TEST_FURTHER_TYPES
#define MOREAU_TYPES(first, further) MOREAU_TYPES_OF further
#else
#define MOREAU_TYPES(first, further) MOREAU_TYPES_OF first
#endif
