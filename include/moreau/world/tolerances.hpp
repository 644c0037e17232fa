// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "moreau/core/error.hpp"

namespace moreau {

/// Lengths that act as tolerances, each relative to the grain size.
struct Tolerances {
  double margin = 0.02;  ///< alert distance: a contact enters at this gap; must exceed speed x step
  double skin = 0.05;    ///< the pair list is kept until a box has moved this far
  double resolution = 1e-3;  ///< contact points of a pair closer together than this are one

  /// @throws std::invalid_argument in the name of the function if one of them is out of range
  void check(const char* function) const {
    require(std::isfinite(margin) && margin > 0, function, "margin", margin,
            "must be finite and > 0");
    require(std::isfinite(skin) && skin >= 0, function, "skin", skin, "must be finite and >= 0");
    require(std::isfinite(resolution) && resolution >= 0, function, "resolution", resolution,
            "must be finite and >= 0");
  }
};

}  // namespace moreau
