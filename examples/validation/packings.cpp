// SPDX-License-Identifier: MIT
#include "cases/close_packing.hpp"
#include "cases/shear.hpp"
#include "cases/silo.hpp"
#include "suite.hpp"

namespace validation {

std::vector<Case> packings() {
  return {{"close_packing", random_close_packing, true},
          {"stiff_springs", stiff_springs_are_rigid, true},
          {"janssen", janssen_silo, true},
          {"plane_shear", plane_shear, true}};
}

}  // namespace validation
