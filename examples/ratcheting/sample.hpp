// SPDX-License-Identifier: MIT
// The loose sample before compression: shapes, sizes, and where the grains hang.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include "moreau/core/pose.hpp"
#include "moreau/sample/ballast.hpp"
#include "moreau/sample/size_distribution.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/sphere.hpp"

#include "parameters.hpp"

namespace ratcheting {

/// A rotation drawn uniformly.
template <class S>
typename S::Rotation random_rotation(std::mt19937_64& random) {
  // The direction of a standard normal vector is uniform on the sphere, so for unit quaternions the
  // rotation is uniform; in the plane exp of a uniform angle is.
  std::uniform_real_distribution<typename S::Scalar> angle(-std::numbers::pi, std::numbers::pi);
  std::normal_distribution<typename S::Scalar> normal;
  typename S::Rotation q = S::identity();
  // Three large random turns about random axes: uniform to far below what a packing could show.
  for (int turn = 0; turn < 3; ++turn) {
    typename S::Angular axis;
    for (int k = 0; k < S::angular_dim; ++k) axis[k] = normal(random);
    q = S::normalized(S::exp(axis.normalized() * angle(random)) * q);
  }
  return q;
}

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
struct SolidTwin<moreau::Sphere<moreau::Space<2, T>>> {
  using type = moreau::Sphere<moreau::Space<3, T>>;
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

/// Hangs the grains one by one above a floor of the given extent (last axis up): each at the lowest
/// of some random places where its circumsphere, lowered, meets floor or others. Loose, free of
/// overlap.
template <class S>
std::vector<moreau::Pose<S>> hang(const std::vector<double>& radii, double length,
                                  std::mt19937_64& random) {
  constexpr int trials = 40, up = S::dim - 1;
  std::vector<moreau::Pose<S>> poses(radii.size());
  std::uniform_real_distribution<double> unit(0, 1);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    typename S::Vector best;
    for (int trial = 0; trial < trials; ++trial) {
      typename S::Vector x;
      for (int k = 0; k < up; ++k) x[k] = radii[i] + unit(random) * (length - 2 * radii[i]);
      x[up] = radii[i];
      for (std::size_t j = 0; j < i; ++j) {
        const double reach = radii[i] + radii[j];
        const double aside =
            (poses[j].position.template head<up>() - x.template head<up>()).squaredNorm();
        if (aside >= reach * reach) continue;
        x[up] = std::max(x[up], poses[j].position[up] + std::sqrt(reach * reach - aside));
      }
      if (trial == 0 || x[up] < best[up]) best = x;
    }
    poses[i].position = best;
    poses[i].rotation = random_rotation<S>(random);
  }
  return poses;
}

}  // namespace ratcheting
