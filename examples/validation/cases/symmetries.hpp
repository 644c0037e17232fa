// SPDX-License-Identifier: MIT
// What must not change an experiment: its place and direction in the world, the order of its
// bodies. And what a collision must not change: momentum.
#pragma once

#include "heap.hpp"

namespace validation {

namespace detail {

/// A tenth of a second of a heap: grains come down on the floor and on each other.
template <class ShapeT>
void fall(Heap<ShapeT>& heap) {
  // Ten sweeps of the correction of overlaps do not converge and depend on the order of the bodies.
  moreau::OverlapCorrectionOptions off;
  off.enabled = false;
  heap.world.set_correction(off);
  for (int k = 0; k < 100; ++k) heap.world.step(1e-3);
}

/// Largest distance of places, the second brought back from its frame [m].
template <class ShapeT>
double distance(const Heap<ShapeT>& one, const Heap<ShapeT>& other,
                const Pose<SpaceOf<ShapeT>>& frame) {
  double most = 0;
  for (std::size_t k = 0; k < one.place.size(); ++k)
    most = std::max(most, (one.pose(k).position - frame.to_body(other.pose(k).position)).norm());
  return most;
}

}  // namespace detail

/// The experiment moved and turned gives the result moved and turned; the bodies in another order
/// give the same, without friction: with it a step can have several solutions, and which of them is
/// found goes by the order. Rounding grows with each collision of rough bodies, by less than a
/// hundred in those of a tenth of a second: 1e-9 of a grain for 1e-12 in the velocities.
template <class ShapeT>
void symmetries(Record& record) {
  using S = SpaceOf<ShapeT>;
  Heap<ShapeT> reference{HeapOptions{}};
  detail::fall(reference);
  Pose<S> frame{S::Vector::Constant(0.7), S::exp(S::Angular::Constant(0.8))};
  Heap<ShapeT> moved(HeapOptions{}, frame);
  detail::fall(moved);
  HeapOptions smooth;
  smooth.friction = 0;
  std::vector<std::size_t> order(smooth.count);
  std::iota(order.rbegin(), order.rend(), std::size_t(0));
  Heap<ShapeT> first(smooth), permuted(smooth, {}, order);
  detail::fall(first);
  detail::fall(permuted);
  const double size = Heap<ShapeT>::size;
  record.vanishes(with_shape<ShapeT>("frame indifference") + ": distance over size", S::dim,
                  detail::distance(reference, moved, frame) / size, 1e-9);
  record.vanishes(with_shape<ShapeT>("permuted bodies") + ": distance over size", S::dim,
                  detail::distance(first, permuted, {}) / size, 1e-9);
}

inline void symmetries_of_experiments(Record& record, Effort) {
  symmetries<Polyhedron>(record);
  symmetries<Polygon>(record);
  symmetries<Ball>(record);
  symmetries<Disk>(record);
}

/// A cloud of random grains flies together, with friction and restitution, and apart: linear and
/// angular momentum stay. (The correction of overlaps, off here, moves bodies without regard to
/// their velocities and so does not keep the angular one.)
template <class ShapeT>
void momentum_in_collisions(Record& record) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  moreau::Tolerances tolerances;
  tolerances.margin = 0.1;
  auto world = world_of<ShapeT, Coulomb>(0.02, Coulomb(0.3, 0.3), tight(1e-8), tolerances);
  moreau::OverlapCorrectionOptions off;
  off.enabled = false;
  world.set_correction(off);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&](auto x) {
    for (auto& entry : x.reshaped()) entry = any(random);
    return x;
  };
  for (int k = 0; k < (S::dim == 2 ? 9 : 27); ++k) {
    const Vector place =
        0.03 * Vector(Eigen::Vector3d(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1).template head<S::dim>());
    const Pose<S> pose{place + 0.003 * vector(Vector()), S::exp(3 * vector(typename S::Angular()))};
    ShapeT shape = moreau::Ballast<ShapeT>::draw(random).scaled(0.01);
    const BodyId grain = world.add_grain(world.add_shape(shape), pose, 2700);
    world.set_velocity(grain, -20 * place + 0.2 * vector(Vector()));
    world.set_spin(grain, 20 * vector(typename S::Angular()));
  }
  const auto start = momentum(world);
  const double before = kinetic_energy(world);
  double turn = 0, push = 0;
  for (std::size_t k = 0; k < world.grain_count(); ++k) {
    const auto part = moreau::momentum<S>(motion_of(world, k));
    push += part.linear.norm();
    turn += part.angular.norm();
  }
  double linear = 0, angular = 0;
  for (int k = 0; k < 400; ++k) {
    world.step(5e-4);
    const auto now = momentum(world);
    linear = std::max(linear, (now.linear - start.linear).norm() / push);
    angular = std::max(angular, (now.angular - start.angular).norm() / turn);
  }
  const std::string name = with_shape<ShapeT>("collisions") + ": ";
  record.vanishes(name + "relative change of linear momentum", S::dim, linear, 1e-12);
  record.vanishes(name + "relative change of angular momentum", S::dim, angular, 1e-11);
  record.vanishes(name + "energy kept, at most", S::dim, kinetic_energy(world) / before, 0.95);
}

inline void momentum_is_kept(Record& record, Effort) {
  momentum_in_collisions<Polyhedron>(record);
  momentum_in_collisions<Polygon>(record);
  momentum_in_collisions<Ball>(record);
  momentum_in_collisions<Disk>(record);
}

}  // namespace validation
