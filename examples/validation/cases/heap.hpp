// SPDX-License-Identifier: MIT
// Grains that fall into an open box, anywhere in the world and added in any order.
#pragma once

#include <numeric>
#include <random>

#include "moreau/sample/ballast.hpp"

#include "scene.hpp"

namespace validation {

struct HeapOptions {
  std::size_t count = 9;
  double friction = 0.4;
  double tolerance = 1e-12;  ///< tolerance of the solver
  std::uint64_t seed = 1;
};

/// @tparam Law    set-valued or regularized
/// @tparam Solver for a set-valued law
template <class ShapeT, class Law = Coulomb<ShapeT>,
          class Solver = moreau::DefaultSolver<Law, SpaceOf<ShapeT>>>
struct Heap {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;
  static constexpr double size = 0.02;  ///< [m]

  World<ShapeT, Law, Solver> world;
  std::vector<std::size_t> place;  ///< place[k]: position of grain k in the order of addition

  /// @param frame moves the experiment together with its gravity
  /// @param order order in which the grains are added; if empty, as they are drawn
  explicit Heap(const HeapOptions& options, const Pose<S>& frame = {},
                std::vector<std::size_t> order = {})
      : world(
            world_of<ShapeT, Law, Solver>(size, law(options.friction), sweeps(options.tolerance))),
        place(options.count) {
    // With few contact points, springs appear and disappear with rounding.
    if (!is_rigid<ShapeT, Law>) world.set_contact_points(moreau::ContactPoints::all);
    if (order.empty()) {
      order.resize(options.count);
      std::iota(order.begin(), order.end(), std::size_t(0));
    }
    const auto grains = draw(options);
    for (std::size_t k = 0; k < order.size(); ++k) {
      place[order[k]] = k;
      const auto& [shape, pose] = grains[order[k]];
      world.add_grain(world.add_shape(shape),
                      {frame(pose.position), frame.rotation * pose.rotation}, 2700);
    }
    for (int axis = 0; axis < up; ++axis) {
      const Vector n = Vector::Unit(axis);
      world.add_wall(frame.rotation * n, frame(Vector::Zero()));
      world.add_wall(-(frame.rotation * n), frame(0.08 * n));
    }
    world.add_wall(frame.rotation * Vector::Unit(up), frame(Vector::Zero()));
    world.set_gravity(frame.rotation * (-gravity * Vector::Unit(up)));
  }

  /// Pose of grain k in the order in which the grains are drawn.
  const Pose<S>& pose(std::size_t k) const { return world.pose(world.grain(place[k])); }

 private:
  static Law law(double friction) {
    if constexpr (is_rigid<ShapeT, Law>)
      return Law(friction);
    else
      return Law(1e5, 2e5 / 7, friction, 0.5);  // overlaps by less than a thousandth of a grain
  }
  static moreau::ColouredOptions sweeps(double tolerance) {
    moreau::ColouredOptions options = tight(tolerance);
    options.max_sweeps = 2000;  // for the few steps in which grains lock
    return options;
  }
  struct Drawn {
    ShapeT shape;
    Pose<S> pose;
  };
  static std::vector<Drawn> draw(const HeapOptions& options) {
    std::mt19937_64 random(options.seed);
    std::uniform_real_distribution<double> jitter(-1e-3, 1e-3), share(0.8, 1);
    std::vector<Drawn> grains;
    for (std::size_t k = 0; k < options.count; ++k) {
      Pose<S> pose;
      std::size_t rest = k;
      for (int axis = 0; axis < up; ++axis) {
        pose.position[axis] = 0.016 + 0.024 * double(rest % 3) + jitter(random);
        rest /= 3;
      }
      pose.position[up] = 0.011 + 0.022 * double(rest) + jitter(random);
      pose.rotation = S::exp(S::Angular::Constant(1000 * jitter(random)));
      if constexpr (is_round<ShapeT>)
        grains.push_back({ShapeT(share(random) * size / 2), pose});
      else
        grains.push_back({moreau::Ballast<ShapeT>::draw(random).scaled(size / 2), pose});
    }
    return grains;
  }
};

}  // namespace validation
