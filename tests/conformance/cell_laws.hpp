// SPDX-License-Identifier: MIT
// Laws for grains in a periodic cell that deforms, of either space: rigid, wet, and with bonds on springs.
#pragma once

#include "moreau/law/bonded.hpp"
#include "moreau/law/bridges.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/rolling_resistance.hpp"

#include "conformance/cell.hpp"

namespace conformance {

/// Checks shapes under these laws, a lattice of 4 grains along each axis.
/// @param size diameter of a ball that contains any of the shapes [m]
inline constexpr auto in_cell = [](const auto& shapes, double size) {
  using Water = moreau::CapillaryBridge<>;
  using Rolling = moreau::RollingResistance<>;
  const moreau::Bonded<> bonds({2, 1.5, 1}, 0.4, 0.1);
  cell(shapes, moreau::SignoriniCoulomb<>(0.4), size, 4);
  cell(shapes, moreau::Bridged<Water, Rolling>(Water(1e-12), Rolling(0.4, 0.1)), size, 4);
  cell(shapes, moreau::Compliant<moreau::Bonded<>>(bonds, 1e6, 5e5), size, 4);
};

}  // namespace conformance
