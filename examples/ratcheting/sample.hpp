// SPDX-License-Identifier: MIT
// The grains of the sample: shapes and sizes.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "moreau/sample/ballast.hpp"
#include "moreau/sample/size_distribution.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

#include "parameters.hpp"

namespace ratcheting {

/// The shape in space whose sample weighs what a plane sample is meant to weigh; in space, itself.
template <class Shape>
struct SolidTwin {
  using type = Shape;
};
template <class T>
struct SolidTwin<moreau::Polygon<T>> {
  using type = moreau::Polyhedron<T>;
};
template <class T>
struct SolidTwin<moreau::Disk<T>> {
  using type = moreau::Ball<T>;
};

/// Shapes and sizes of the study, without places.
template <class Shape>
struct Grains {
  std::vector<Shape> shapes;        ///< one per grain, to size
  std::vector<double> circumradii;  ///< [m]
  double volume = 0;                ///< sum [m^3], in the plane [m^2]
};

/// 50 / 34 / 16 % of 2.5 / 3.75 / 5 cm, each grain one of 30 base shapes. Seeded by the parameters.
template <class Shape>
Grains<Shape> make_grains(const Parameters& p, std::mt19937_64& random) {
  const std::vector<Shape> bases = moreau::ballast_shapes<Shape>(30, random);
  const moreau::SizeDistribution distribution = moreau::SizeDistribution::azema2008();
  const std::vector<double> sizes = distribution.sample(p.grains, random);
  Grains<Shape> grains;
  for (std::size_t i = 0; i < p.grains; ++i) {
    const double radius = moreau::circumradius_of(p.size_scale * sizes[i], p.size_reading);
    grains.shapes.push_back(bases[i % bases.size()].scaled(radius));
    grains.circumradii.push_back(radius);
    grains.volume += grains.shapes.back().volume();
  }
  return grains;
}

}  // namespace ratcheting
