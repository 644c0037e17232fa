// SPDX-License-Identifier: MIT
// Changes that must not affect an experiment: its position and orientation in the world and the
// order of its bodies. Momentum, which a collision must not change.
#pragma once

#include "heap.hpp"

namespace validation {

namespace detail {

/// A heap for 0.1 s (on springs 0.05 s): grains fall on the floor and on each other.
struct Fall {
  std::size_t pushes = 0;    ///< pairs of grains in compression, summed over the steps
  std::size_t unsolved = 0;  ///< steps that did not converge
};
template <class ShapeT, class Law, class Solver>
Fall fall(Heap<ShapeT, Law, Solver>& heap) {
  without_correction(heap.world);
  constexpr bool rigid = is_rigid<ShapeT, Law>;
  Fall seen;
  for (int k = 0; k < (rigid ? 100 : 1000); ++k) {
    seen.unsolved += !heap.world.step(rigid ? 1e-3 : 5e-5).solve.converged;
    const auto& contacts = heap.world.contacts();
    for (std::size_t c = 0; c < contacts.size(); ++c)
      seen.pushes += heap.world.is_grain(contacts.points[c].a) &&
                     heap.world.is_grain(contacts.points[c].b) && contacts.impulses[c][0] > 0;
  }
  return seen;
}

/// Largest distance between positions relative to the grain size, after the second experiment is
/// moved back from its frame.
template <class HeapT>
double distance(const HeapT& one, const HeapT& other, const Pose<typename HeapT::S>& frame) {
  double most = 0;
  for (std::size_t k = 0; k < one.place.size(); ++k)
    most = std::max(most,
                    double((one.pose(k).position - frame.to_body(other.pose(k).position)).norm()));
  return most / HeapT::size;
}

/// Growth of rounding errors: the largest distance from `reference`, relative to the grain size, in
/// four experiments whose grains are displaced by four roundings of a metre.
template <class HeapT>
double growth_of_rounding(const HeapT& reference, const HeapOptions& options) {
  using S = typename HeapT::S;
  using T = typename S::Scalar;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  double most = 0;
  for (int sample = 0; sample < 4; ++sample) {
    HeapT aside{options};
    for (std::size_t k = 0; k < aside.place.size(); ++k) {
      Pose<S> pose = aside.pose(k);
      for (auto& x : pose.position) x += T(4 * any(random)) * std::numeric_limits<T>::epsilon();
      aside.world.set_pose(aside.world.grain(aside.place[k]), pose);
    }
    fall(aside);
    most = std::max(most, distance(reference, aside, {}));
  }
  return most;
}

/// The largest distance, relative to the grain size, of a heap from itself in several frames; the
/// number of steps that did not converge.
struct Frames {
  double distance = 0;
  Fall seen;
};
template <class HeapT>
Frames in_frames(const HeapOptions& options, std::initializer_list<double> turns) {
  using S = typename HeapT::S;
  Frames frames;
  HeapT reference(options);
  frames.seen = fall(reference);
  for (const double turn : turns) {
    using T = typename S::Scalar;
    const Pose<S> frame{S::Vector::Constant(T(0.7)), S::exp(S::Angular::Constant(T(turn)))};
    HeapT elsewhere(options, frame);
    frames.seen.unsolved += fall(elsewhere).unsolved;
    frames.distance = std::max(frames.distance, distance(reference, elsewhere, frame));
  }
  return frames;
}

/// Distances, relative to the grain size, of a heap that is moved and rotated, and of a heap whose
/// bodies have another order; and the distances that they are compared with. Rigid polyhedra lock in
/// some steps, which sweeps alone do not solve: the result would depend on rounding, and so on the
/// compiler.
template <class ShapeT, class Law>
struct SymmetricHeaps {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  static constexpr bool locks = is_rigid<ShapeT, Law> && std::is_same_v<ShapeT, Polyhedron<double>>;
  using Solver =
      std::conditional_t<locks, moreau::ProximalFallback<>, moreau::DefaultSolver<Law, S>>;
  using HeapT = Heap<ShapeT, Law, Solver>;
  HeapOptions rough, smooth;
  HeapT reference, first;
  Fall seen;
  double moved, permuted;

  explicit SymmetricHeaps(std::size_t count)
      : rough{count},
        smooth{count, is_rigid<ShapeT, Law> ? 0 : 0.4},
        reference(rough),
        first(smooth) {
    seen = fall(reference);
    fall(first);
    const Pose<S> frame{S::Vector::Constant(0.7), S::exp(S::Angular::Constant(0.8))};
    HeapT elsewhere(rough, frame);
    fall(elsewhere);
    std::vector<std::size_t> order(count);
    std::iota(order.rbegin(), order.rend(), std::size_t(0));
    HeapT reordered(smooth, {}, order);
    fall(reordered);
    moved = distance(reference, elsewhere, frame);
    if (std::is_same_v<T, double> && is_rigid<ShapeT, Law>)
      moved = std::max(moved, in_frames<HeapT>(rough, {0.3, 1.1, -0.7, 2.0}).distance);
    permuted = distance(first, reordered, {});
  }
};

}  // namespace detail

/// An experiment that is moved and rotated gives the moved and rotated result. Another order of the
/// bodies gives the same result, for rigid bodies without friction: with friction a step can have
/// several solutions, and the order decides which one is found.
///
/// Rounding errors grow with each collision of rough bodies. In a heap of two layers they grow by
/// less than a hundred in 0.1 s: to 1e-9 of a grain for 1e-12 in the velocities. In three layers
/// they grow more. There the result is compared with the largest difference of several experiments
/// whose grains are displaced by some roundings of a metre: at most ten times as much, and at most
/// 1e-6. In float, rounding leaves nothing to compare there.
template <class ShapeT, class Law>
void symmetries(Record& record) {
  using S = SpaceOf<ShapeT>;
  const auto name = [](const char* text) { return with_law<Law>(with_shape<ShapeT>(text)); };
  const detail::SymmetricHeaps<ShapeT, Law> heaps(S::dim == 3 ? 12 : 9);  // more than one layer
  record.vanishes(name("frame indifference") + ": no grain pushed another", S{},
                  heaps.seen.pushes == 0, 0);
  record.vanishes(name("frame indifference") + ": distance over size", S{}, heaps.moved, 1e-9);
  record.vanishes(name("permuted bodies") + ": distance over size", S{}, heaps.permuted, 1e-9);
  if constexpr (S::dim == 3 && std::is_same_v<typename S::Scalar, double>) {
    const detail::SymmetricHeaps<ShapeT, Law> high(27);
    const double grown = detail::growth_of_rounding(high.reference, high.rough);
    record.vanishes(name("heap of 27") + ": what rounding of the places grows to, over size", S{},
                    grown, 1e-6);
    record.vanishes(name("heap of 27") + ": frame, distance over size", S{}, high.moved,
                    std::min(10 * grown, 1e-6));
    record.vanishes(name("heap of 27") + ": order, distance over size", S{}, high.permuted,
                    std::min(10 * detail::growth_of_rounding(high.first, high.smooth), 1e-6));
  }
}

/// With sweeps alone, some steps in which rough polyhedra lock do not converge, and their result
/// depends on rounding. With the proximal point method after the sweeps every step converges, and
/// heaps of 12, 13, 14 and 27 grains agree in five frames.
inline void solved_frames(Record& record, Effort effort) {
  using ShapeT = Polyhedron<double>;
  using S = SpaceOf<ShapeT>;
  using HeapT = Heap<ShapeT, Coulomb<ShapeT>, moreau::ProximalFallback<>>;
  const bool quick = effort == Effort::quick;
  const std::vector<std::size_t> counts =
      quick ? std::vector<std::size_t>{12} : std::vector<std::size_t>{12, 13, 14, 27};
  for (const std::size_t count : counts) {
    const std::string name = "frame indifference, " + std::to_string(count) + " polyhedra, solved";
    const detail::Frames frames =
        detail::in_frames<HeapT>(HeapOptions{count}, {0.8, 0.3, 1.1, -0.7, 2.0});
    record.vanishes(name + ": steps that are not", S{}, double(frames.seen.unsolved), 0);
    record.vanishes(name + ": no grain pushed another", S{}, frames.seen.pushes == 0, 0);
    record.vanishes(name + ": distance over size", S{}, frames.distance, 1e-9);
  }
}

template <class ShapeT>
void symmetries_of(Record& record) {
  symmetries<ShapeT, Coulomb<ShapeT>>(record);
  symmetries<ShapeT, Springs<ShapeT>>(record);
}

template <class T>
void symmetries_of_experiments(Record& record, [[maybe_unused]] Effort effort) {
  symmetries_of<Polyhedron<T>>(record);
  if constexpr (std::is_same_v<T, double>) solved_frames(record, effort);
  symmetries_of<Polygon<T>>(record);
  symmetries_of<Ball<T>>(record);
  symmetries_of<Disk<T>>(record);
}

/// A cloud of random grains moves together, collides with friction and restitution, and moves
/// apart. Linear and angular momentum are conserved without the overlap correction.
template <class ShapeT, class Law>
void momentum_in_collisions(Record& record, const Law& law, double theta = 0.5) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  moreau::Tolerances tolerances;
  tolerances.margin = 0.1;
  auto world = world_of<ShapeT>(0.02, law, tight(1e-8), tolerances, theta);
  without_correction(world);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&](auto x) {
    for (auto& entry : x.reshaped()) entry = any(random);
    return x;
  };
  for (int k = 0; k < (S::dim == 2 ? 9 : 27); ++k) {
    const Vector place = 0.03 * Eigen::Vector3i(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1)
                                    .template head<S::dim>()
                                    .template cast<typename S::Scalar>();
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
  const int steps = is_rigid<ShapeT, Law> ? 400 : 8000;
  for (int k = 0; k < steps; ++k) {
    world.step(0.2 / steps);
    const auto now = momentum(world);
    linear = std::max(linear, double((now.linear - start.linear).norm()) / push);
    angular = std::max(angular, double((now.angular - start.angular).norm()) / turn);
  }
  const std::string name =
      with_theta(theta, with_law<Law>(with_shape<ShapeT>("collisions"))) + ": ";
  record.vanishes(name + "relative change of linear momentum", S{}, linear, 1e-12);
  record.vanishes(name + "relative change of angular momentum", S{}, angular, 1e-11);
  // Restitution 0.3 leaves 0.09 of the energy of approach, which is most of the energy. A value
  // below 0.95 shows that the grains collided.
  record.vanishes(name + "energy left, at most 0.95 of it", S{}, kinetic_energy(world) / before,
                  0.95);
}

template <class ShapeT>
void collisions_of(Record& record) {
  momentum_in_collisions<ShapeT>(record, Coulomb<ShapeT>(0.3, 0.3));
  momentum_in_collisions<ShapeT>(record, Coulomb<ShapeT>(0.3, 0.3), 1);
  momentum_in_collisions<ShapeT>(record, Springs<ShapeT>(1e5, 2e5 / 7, 0.3, 0.3));
  if constexpr (is_round<ShapeT>)
    momentum_in_collisions<ShapeT>(record, Hertz<ShapeT>(1e7, 2e6, 0.3, 0.3));
}

template <class T>
void momentum_is_kept(Record& record, Effort) {
  collisions_of<Polyhedron<T>>(record);
  collisions_of<Polygon<T>>(record);
  collisions_of<Ball<T>>(record);
  collisions_of<Disk<T>>(record);
}

}  // namespace validation
