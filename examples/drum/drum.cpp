// SPDX-License-Identifier: MIT
// Grains in a slowly turning drum: how steep is the surface they flow down? Writes drum.csv, the
// dynamic angle of repose over time, and drum.vtp, the grains at the end; prints the mean angle.
//
//   gnuplot -p -e 'set datafile separator ","; plot "drum.csv" using 1:2 skip 1 with lines'
//   ParaView opens drum.vtp.
//
// Polygons in a circle; another shape is another template argument: run<moreau::Polyhedron<double>>
// fills a slice of a cylinder, periodic along its axis.
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <moreau/moreau.hpp>
#include <numbers>
#include <random>

#include "moreau/io/csv.hpp"
#include "moreau/io/vtk.hpp"
#include "moreau/sample/ballast.hpp"

constexpr double radius = 0.1, size = 0.01, slice = 0.03;  // of the drum, of a grain, depth [m]
constexpr double turn = 0.6;                               // of the drum [rad/s]
constexpr double h = 1e-3, warm_up = 2, duration = 8;      // [s]

/// Grains of a size on a grid, as many as find place in the middle of the drum, at random angles.
template <class Simulation, class Shapes>
void fill(Simulation& world, const Shapes& shapes, std::mt19937_64& random) {
  using S = typename Simulation::S;
  constexpr int up = S::dim - 1;
  std::uniform_real_distribution<double> angle(-3, 3);
  const double depth = S::dim * slice - 2 * slice;  // none in the plane
  for (double z = -radius; z < radius; z += size)
    for (double y = size / 2; y < std::max(depth, size); y += size)
      for (double x = -radius; x < radius; x += size) {
        if (std::hypot(x, z) > radius - size || z > 0.3 * radius) continue;
        moreau::Pose<S> pose;
        pose.position[1] = y;
        pose.position[0] = x;
        pose.position[up] = z;
        pose.rotation = S::exp(S::Angular::Constant(angle(random)));
        const auto shape = world.add_shape(shapes[world.grain_count() % shapes.size()]);
        world.add_grain(shape, pose, 2500);
      }
}
