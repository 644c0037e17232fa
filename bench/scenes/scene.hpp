// SPDX-License-Identifier: MIT
// A scene is a simulation with what happens to it in time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "moreau/moreau.hpp"
#include "moreau/sample/spatial_order.hpp"

namespace scenes {

using namespace moreau;

/// What the user asks for; 0 or an empty string: as the scene has it.
struct Options {
  std::string scene;
  std::string scalar = "double", points = "all", order = "added", state;
  std::string write, poses,
      check;          ///< files for the comparison with other libraries (exchange.hpp)
  double margin = 0;  ///< relative to the grain size
  int size = 0, threads = 1, settle = -1, steps = 0;
  Tolerances tolerances;
  ColouredOptions solver = [] {
    ColouredOptions coloured;
    coloured.tolerance = 1e-3;
    return coloured;
  }();
  OverlapCorrectionOptions correction;
};

/// A simulation and its time loop. Grains are numbered in the order in which they were added.
template <class ShapeT>
struct Scene {
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Law = SignoriniCoulomb<Scalar>;
  using World = Simulation<ShapeT, Law>;
  using Vector = typename S::Vector;

  std::unique_ptr<World> world;
  Scalar step;                               ///< [s]
  int settle, steps;                         ///< before the measurement, and of it
  std::function<void(World&)> prepare = {};  ///< makes the state from which the settling begins
  std::function<void(World&)> begin = {};    ///< after prepare(), or after the state of a file
  /// Sets forces before a measured step, at the time since the measurement began [s].
  std::function<void(World&, double)> drive = {};
};

/// The grains of a scene, to be added in the order that the user asks for.
template <class ShapeT>
struct Grains {
  using S = SpaceOf<ShapeT>;
  std::vector<ShapeT> shapes;         ///< one per grain, or those that they share
  std::vector<Pose<S>> poses;         ///< of the grains
  std::vector<std::size_t> shape_of;  ///< per grain, the shape that it shares; empty: one each

  void add_to(auto& world, typename S::Scalar density, const Options& options) const {
    std::vector<std::size_t> order(poses.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (options.order == "random") {
      std::mt19937_64 random(3);
      std::shuffle(order.begin(), order.end(), random);
    } else if (options.order == "curve") {
      std::vector<typename S::Vector> points;
      for (const auto& pose : poses) points.push_back(pose.position);
      order = spatial_order<S>(points);
    }
    std::vector<ShapeId> shared;
    if (!shape_of.empty())
      for (const ShapeT& shape : shapes) shared.push_back(world.add_shape(shape));
    for (const std::size_t k : order)
      world.add_grain(shape_of.empty() ? world.add_shape(shapes[k]) : shared[shape_of[k]], poses[k],
                      density);
  }
};

/// The tolerances of a scene: those of the options, with the margin of the scene unless the user names one.
/// @param margin of the scene, relative to the grain size
inline Tolerances tolerances(double margin, const Options& options) {
  Tolerances tolerances = options.tolerances;
  tolerances.margin = options.margin > 0 ? options.margin : margin;
  return tolerances;
}
inline ColouredGaussSeidel solver(const Options& options) {
  return ColouredGaussSeidel(options.solver);
}

/// Runs the scene that the options name, if there is one of these shapes.
/// @returns whether there was
bool run_polyhedra(const Options& options);
bool run_polyhedra_float(const Options& options);
bool run_polygons(const Options& options);
bool run_polygons_float(const Options& options);
bool run_compounds(const Options& options);

}  // namespace scenes
