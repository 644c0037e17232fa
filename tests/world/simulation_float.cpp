// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "check_rest.hpp"

TEST_CASE_TEMPLATE("float: grains come to rest on each other, with bounded overlap", ShapeT,
                   moreau::Polyhedron<float>, moreau::Polygon<float>) {
  scenes::check_rest<ShapeT>();
}
