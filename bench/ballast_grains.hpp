// SPDX-License-Identifier: MIT
// Grains of the shapes of ballast for benchmarks, and their material and load.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "moreau/law/concepts.hpp"
#include "moreau/sample/ballast.hpp"
#include "moreau/sample/size_distribution.hpp"
#include "moreau/world/contact_detector.hpp"

namespace bench {

inline constexpr double pressure = 1e4;  // on a lid [Pa]

/// Depth of a packing [m]: of the plane, or 1, so that volumes and areas of space remain as they are.
template <class S>
constexpr double depth = S::dim == 2 ? 0.05 : 1;
/// Density of the grains [kg/m^D].
template <class S>
constexpr double density = 2700 * depth<S>;

/// The contact points of the figures in README.md: at most D of a contact between faces, but all
/// with springs.
template <class S, class Law>
constexpr moreau::ContactPoints contact_points =
    moreau::CompliantLaw<Law, S> ? moreau::ContactPoints::all : moreau::ContactPoints::few;

/// Shapes of grains, their circumradii [m], and their volume, in the plane their area [m^D].
template <class ShapeT>
struct BallastGrains {
  std::vector<ShapeT> shapes;
  std::vector<double> radii;
  double volume = 0;

  BallastGrains(std::size_t count, std::mt19937_64& random) {
    for (const double diameter : moreau::SizeDistribution::azema2008().sample(count, random)) {
      shapes.push_back(moreau::Ballast<ShapeT>::draw(random).scaled(diameter / 2));
      radii.push_back(diameter / 2);
      volume += shapes.back().volume();
    }
  }
};

}  // namespace bench
