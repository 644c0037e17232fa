// SPDX-License-Identifier: MIT
// The grains of the sample: shapes and sizes.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "moreau/sample/ballast.hpp"
#include "moreau/sample/compound_ballast.hpp"
#include "moreau/sample/size_distribution.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/compound.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

#include "parameters.hpp"

namespace ratcheting {

/// The shape in space that corresponds to a shape in the plane: a sample in the plane gets the
/// weight of the sample in space. For a shape in space, the shape itself.
template <class Shape>
struct SolidTwin {
  using type = Shape;
};
template <class T>
struct SolidTwin<moreau::Polygon<T>> {
  using type = moreau::Polyhedron<T>;
};
template <class T>
struct SolidTwin<moreau::Compound<moreau::Polygon<T>>> {
  using type = moreau::Compound<moreau::Polyhedron<T>>;
};
template <class T>
struct SolidTwin<moreau::Disk<T>> {
  using type = moreau::Ball<T>;
};

/// The grains of a sample, without positions.
template <class Shape>
struct Grains {
  std::vector<Shape> shapes;        ///< one per grain, with its size
  std::vector<double> circumradii;  ///< [m]
  double volume = 0;                ///< sum [m^3], in the plane [m^2]
};

/// Grains of the sizes 2.5, 3.75 and 5 cm (50, 34 and 16 % by number), of 30 different shapes.
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
