// SPDX-License-Identifier: MIT
#include "physics/packing.hpp"

TEST_CASE_TEMPLATE("a packing of 60 grains at rest: overlap and motion do not grow in 20 s", ShapeT,
                   moreau::Polyhedron<>, moreau::Polygon<>) {
  packing::check_rests<ShapeT>(20);
}
