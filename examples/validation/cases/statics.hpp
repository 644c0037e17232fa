// SPDX-License-Identifier: MIT
// Packings without a drive.
#pragma once

#include "heap.hpp"

namespace validation {

namespace detail {

struct Balance {
  double left;  ///< largest sum of contact forces and weight of a grain, or largest sum of torques
                ///< divided by the grain size
  double all;   ///< sum of all contact forces
};
/// Both relative to the mean weight, computed from the contacts alone.
template <class ShapeT>
Balance balance(const World<ShapeT>& world, double h) {
  using S = SpaceOf<ShapeT>;
  using Twist = typename S::Twist;
  const auto& bodies = world.bodies();
  std::vector<Twist> load(bodies.size(), Twist::Zero());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    load[i].template head<S::dim>() = bodies.grain_mass[i] * world.gravity();
  double worst = 0, all = 0;
  const auto& contacts = world.contacts();
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto& contact = contacts.points[c];
    all += contacts.impulse(c).norm() / h;
    const typename S::Vector force = contact.frame * contacts.impulse(c) / h;
    load[contact.b].template head<S::dim>() += force;
    load[contact.b].template tail<S::angular_dim>() += S::moment(contact.lever_b, force);
    load[contact.a].template head<S::dim>() -= force;
    load[contact.a].template tail<S::angular_dim>() -= S::moment(contact.lever_a, force);
  }
  for (std::size_t k = 0; k < world.grain_count(); ++k) {
    const Twist& sum = load[world.grain(k).index()];
    worst = std::max({worst, double(sum.template head<S::dim>().norm()),
                      double(sum.template tail<S::angular_dim>().norm() / world.grain_size())});
  }
  const double unit = mass(world) * gravity / double(world.grain_count());
  return {worst / unit, all / unit};
}

/// Makes steps until the packing is at rest: at least 1500, and until no velocity of a grain changes by more than
/// 1e-4 g h, so that no grain is struck. Without rolling resistance a ball can roll on for seconds, in balance until
/// it strikes the next one.
/// @param before, report out: reports of the last two steps
/// @returns whether that was within 5000 steps
template <class ShapeT>
bool come_to_rest(World<ShapeT>& world, double h, moreau::StepReport& before,
                  moreau::StepReport& report) {
  using S = SpaceOf<ShapeT>;
  constexpr int least = 1500, most = 5000;
  const double allowed = resolved<S>(1e-4, 1e5) * gravity * h;
  std::vector<typename S::Twist> old;
  for (int k = 1; k <= most; ++k) {
    old = world.bodies().velocity;
    before = report;
    report = world.step(h);
    if (k < least) continue;
    double change = 0;
    for (std::size_t grain = 0; grain < world.grain_count(); ++grain) {
      const std::size_t i = world.grain(grain).index();
      const typename S::Twist jump = world.bodies().velocity[i] - old[i];
      change = std::max({change, double(jump.template head<S::dim>().norm()),
                         double(jump.template tail<S::angular_dim>().norm() * world.grain_size())});
    }
    if (change <= allowed) return true;
  }
  return false;
}

}  // namespace detail

/// In a packing at rest the forces on every grain balance. The imbalance is the residual of this
/// step or of the last step, times the sum of all contact forces, and rounding.
template <class ShapeT>
void force_balance(Record& record, std::size_t count) {
  HeapOptions options;
  options.count = count;
  options.tolerance = 1e-6;
  Heap<ShapeT> heap(options);
  const double h = 1e-3;
  moreau::StepReport before, report;
  const bool rests = detail::come_to_rest(heap.world, h, before, report);
  const detail::Balance balance = detail::balance(heap.world, h);
  record.vanishes(
      with_shape<ShapeT>("packing at rest") + ": imbalance of forces over weight",
      SpaceOf<ShapeT>{}, balance.left,
      resolved<SpaceOf<ShapeT>>(std::max(before.solve.residual, report.solve.residual), 1) *
              balance.all +
          1e-12);
  record.vanishes(with_shape<ShapeT>("packing at rest") + ": not at rest after 5 s",
                  SpaceOf<ShapeT>{}, !rests, 0);
  record.vanishes(with_shape<ShapeT>("packing at rest") + ": last step not solved",
                  SpaceOf<ShapeT>{}, !report.solve.converged, 0);
}

template <class T>
void balance_of_forces(Record& record, Effort effort) {
  const bool quick = effort == Effort::quick || std::is_same_v<T, float>;
  force_balance<Polyhedron<T>>(record, quick ? 30 : 40);
  force_balance<Polygon<T>>(record, quick ? 12 : 40);
  force_balance<Ball<T>>(record, quick ? 20 : 60);
  force_balance<Disk<T>>(record, quick ? 12 : 40);
}

/// Largest rise of the total energy above its minimum so far [J]. Unless `raw`, the work of the
/// overlap correction is subtracted where the correction lifts grains.
template <class ShapeT>
double rise_of_energy(Heap<ShapeT>& heap, int steps, double h = 5e-4, bool raw = false) {
  double least = energy(heap.world), rise = 0, work = 0;
  for (int k = 0; k < steps; ++k) {
    const moreau::StepReport report = heap.world.step(h);
    if (!raw) work += std::max(0.0, -report.correction.work);
    const double now = energy(heap.world) - work;
    rise = std::max(rise, now - least);
    least = std::min(least, now);
  }
  return rise;
}

/// Largest relative velocity of two bodies at a contact point with an impulse [m/s].
template <class ShapeT>
double speed_of_loaded_contacts(const World<ShapeT>& world) {
  using S = SpaceOf<ShapeT>;
  const auto& velocity = world.bodies().velocity;
  const auto& contacts = world.contacts();
  double largest = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const moreau::Contact<S>& point = contacts.points[c];
    if (contacts.impulses[c][0] > 0)
      largest = std::max(
          largest,
          double(moreau::relative_velocity(point, velocity[point.a], velocity[point.b]).norm()));
  }
  return largest;
}

/// The velocity to which the residual of the last step is relative: the impulses (2-norm) times the mean of the
/// diagonal of W [m/s]. A contact strictly inside its friction cone moves with at most the residual times this.
template <class ShapeT>
double impulse_velocity(const World<ShapeT>& world) {
  using S = SpaceOf<ShapeT>;
  const auto& bodies = world.bodies();
  const auto& contacts = world.contacts();
  double trace = 0, squares = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const moreau::Contact<S>& point = contacts.points[c];
    squares += contacts.impulses[c].squaredNorm();
    const auto add = [&](std::size_t body, const typename S::Vector& lever) {
      const auto root = bodies.mobility_root(body);
      trace += root.linear.squaredNorm() + (S::lever(lever) * root.angular).squaredNorm();
    };
    add(point.a, point.lever_a);
    add(point.b, point.lever_b);
  }
  return std::sqrt(squares) * trace / double(S::dim * contacts.size());
}
/// How much faster than its contacts inside their cones a contact at the limit of friction can move: grains that are
/// held at points a fifth of their size apart, 1 + 2 * 5. Measured: up to 3.3.
constexpr double lever_of_slip = 11;

/// Without a drive and with restitution 0 the energy never grows: in the packing that grains have
/// formed after falling for a second, and over all its steps. Relative to M g d. At the end no loaded
/// contact slides or opens, beyond what the residual allows. Grains with corners are at rest then; a ball may roll or turn about the
/// normal of its only contact for ever, because friction at a point does not resist that.
template <class ShapeT>
void energy_without_drive(Record& record, std::size_t count, int steps) {
  HeapOptions options;
  options.count = count;
  options.tolerance = 1e-8;  // a residual impulse changes the energy
  Heap<ShapeT> heap(options);
  using S = SpaceOf<ShapeT>;
  const double unit = mass(heap.world) * gravity * Heap<ShapeT>::size;
  const std::string name = with_shape<ShapeT>("energy without drive");
  rise_of_energy(heap, 2000);
  record.vanishes(name + ": rise in " + std::to_string(steps) + " steps of the packing", S{},
                  rise_of_energy(heap, steps) / unit, 1e-9);
  const double residual = heap.world.step(5e-4).solve.residual;
  const double allowed = lever_of_slip * residual * impulse_velocity(heap.world);
  record.vanishes(name + ": speed of the loaded contacts at the end, over (g d)^1/2", S{},
                  speed_of_loaded_contacts(heap.world) / std::sqrt(gravity * Heap<ShapeT>::size),
                  allowed / std::sqrt(gravity * Heap<ShapeT>::size) + 1e-12);
  if constexpr (moreau::Polytope<ShapeT>)
    record.vanishes(name + ": kinetic at the end", S{}, kinetic_energy(heap.world) / unit, 1e-9);
}

/// The same while the grains fall. On contacts that rotate, the velocity before a step points out
/// of the contact frame after it, by v h/R. Grains that roll down each other therefore gain energy,
/// to first order in the step (off_a_ball() measures the order for one pair). Compared with a step
/// of 0.5 ms, and with a quarter of the step without the work of the correction.
template <class ShapeT>
void energy_of_fall(Record& record, std::size_t count) {
  HeapOptions options;
  options.count = count;
  options.tolerance = 1e-8;
  Heap<ShapeT> heap(options), coarse(options);
  const double unit = mass(heap.world) * gravity * Heap<ShapeT>::size;
  record.vanishes(
      with_shape<ShapeT>("energy without drive") + ": rise while falling, 0.5 ms, uncorrected",
      SpaceOf<ShapeT>{}, rise_of_energy(coarse, 2000, 5e-4, true) / unit, 1e-6);
  record.vanishes(with_shape<ShapeT>("energy without drive") + ": rise while falling",
                  SpaceOf<ShapeT>{}, rise_of_energy(heap, 8000, 1.25e-4) / unit, 1e-6);
}

inline void energy_falls(Record& record, Effort) {
  energy_of_fall<Disk<>>(record, 24);
  energy_of_fall<Ball<>>(record, 36);
  energy_of_fall<Polygon<>>(record, 24);
  energy_of_fall<Polyhedron<>>(record, 18);
}

inline void energy_does_not_grow(Record& record, Effort effort) {
  const bool quick = effort == Effort::quick;
  const int steps = quick ? 2000 : 100000;
  energy_without_drive<Disk<>>(record, quick ? 24 : 60, steps);
  energy_without_drive<Ball<>>(record, quick ? 36 : 90, steps);
  energy_without_drive<Polygon<>>(record, quick ? 24 : 60, steps);
  if (!quick) energy_without_drive<Polyhedron<>>(record, 54, steps);
}

}  // namespace validation
