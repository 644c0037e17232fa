// SPDX-License-Identifier: MIT
// The energy balance of a simulation, term by term:
//
//   kinetic - kinetic at the start = gravity + forces + drives
//                                    - impacts - friction - rolling - fracture - elastic
//                                    - correction + cell
//                                    + imbalance
//
//   EnergyBalance<S> energy(world);
//   for (...) energy.add(world, world.step(h), h);
//
// `impacts` is what is left of the work of all contacts; each other term is measured independently. The
// imbalance is the part of the kinetic energy that the other terms do not explain. Its size depends on the
// integrator, the bodies and the contact law:
//
//   - MoreauJean(1/2) in the plane, or with bodies of equal principal moments of inertia (balls,
//     cubes): rounding errors.
//   - MoreauJean(1/2) with other bodies in space: first order in the step, because the inertia
//     tensor rotates during the step.
//   - MoreauJean(theta > 1/2): in addition the numerical damping of the scheme, first order in the
//     step.
//   - A regularized contact law: the error of the assumption that forces are constant during a
//     step. `impacts` then includes the energy that the normal springs store, and `friction` that
//     of the tangential springs.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau {

/// The terms of the energy balance, summed since the balance began, with the signs of the equation
/// at the top of this file. In the plane they are energies per thickness, for the thickness to
/// which the densities refer.
struct EnergyTerms {
  double gravity = 0;  ///< work of gravity on grains: minus the increase of their potential energy
                       ///< [J]
  double forces = 0;   ///< work of the forces of set_force() on grains, and on walls along the axes
                       ///< along which they have a mass; of the torques of set_torque() [J]
  double drives = 0;   ///< work of the drives of bodies whose motion is prescribed, or prescribed
                       ///< along an axis [J]
  double impacts = 0;  ///< energy dissipated by contacts that is no friction, rolling or fracture:
                       ///< in impacts, and by implicit Euler of springs; > 0 for a loss, < 0 where
                       ///< contacts gave energy that nobody put in [J]
  double friction = 0;  ///< energy dissipated by tangential impulses, > 0 for a loss [J]
  double rolling = 0;  ///< energy dissipated by rolling and twisting resistance, > 0 for a loss [J]
  double fracture = 0;  ///< energy dissipated by bonds that yield and break, with that which their
                        ///< springs lose meanwhile and release, >= 0 [J]
  double elastic = 0;   ///< energy taken by the springs of compliant contacts, < 0 if they gave
                        ///< energy back [J]
  double correction = 0;  ///< work of gravity and forces along the displacements of the overlap
                          ///< correction, which do not change velocities; < 0 if grains are lifted
                          ///< [J]
  double cell =
      0;  ///< work of a periodic cell that deforms [J]; kinetic energies are then of velocities
          ///< relative to the cell. The work of gravity and forces is not that of these velocities

  /// See core/serialize.hpp.
  auto serialized_members() {
    return std::tie(gravity, forces, drives, impacts, friction, rolling, fracture, elastic,
                    correction, cell);
  }
  /// The increase of the kinetic energy that the terms explain [J].
  double gain() const {
    return gravity + forces + drives - impacts - friction - rolling - fracture - elastic -
           correction + cell;
  }
};

/// The energy balance of one simulation. If the user sets velocities or poses of bodies with a mass
/// between two steps, the change appears in the imbalance, or in the work of gravity and forces, unless
/// the program calls rebase() after the change. After grains were added or removed, and after
/// prescribe_motion() and release(), call rebase() before the next step. The same holds after set_wall_mass() of a
/// wall that moves, which a PressureLoad calls when it is made: the kinetic energy of a wall counts while the wall has a mass.
///
///     source.apply(world, h);
///     energy.rebase(world);
///     energy.add(world, world.step(h), h);
///
/// write_snapshot() can store the balance together with the simulation, so that a restarted run
/// continues it.
template <class S>
class EnergyBalance {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Begins the balance with the present state of the simulation.
  template <class Simulation>
  explicit EnergyBalance(const Simulation& simulation) {
    remember(simulation.bodies());
    start_ = kinetic_;
  }

  /// Adds the last step to the balance. Forces and gravity must still be those of this step.
  /// @param step length of the step [s], > 0: that of the report
  /// @throws std::invalid_argument if the step is not positive or not that of the report, or if since the start or the last
  ///                               rebase() bodies were added or removed, or a body that moves was released, its motion was
  ///                               prescribed, or it got another mass
  template <class Simulation>
  void add(const Simulation& simulation, const StepReport& report, Scalar step) {
    require_positive(step, "EnergyBalance::add", "step");
    require(std::abs(double(step) - report.step) <= 1e-6 * double(step), "EnergyBalance::add",
            "step", step, "must be the step of the report");
    add_work_of_forces(simulation.bodies(), simulation.gravity(), step);
    terms_.drives += work_of_drives(simulation.bodies(), simulation.contacts());
    add_report(report);
    remember(simulation.bodies());
  }

  /// Continues with the present bodies, positions and velocities, which the program has changed since
  /// the last step. The change of the kinetic energy is added to kinetic_at_start(). It appears in no
  /// term and not in the imbalance.
  template <class Simulation>
  void rebase(const Simulation& simulation) {
    const double before = kinetic_;
    remember(simulation.bodies());
    start_ += kinetic_ - before;
  }

  const EnergyTerms& terms() const { return terms_; }  ///< the terms, summed so far [J]
  /// kinetic energy of grains, without those whose motion is prescribed, and of walls with a mass [J]
  double kinetic() const { return kinetic_; }
  /// kinetic() when the balance began, and all changes at calls of rebase() [J]
  double kinetic_at_start() const { return start_; }
  /// The increase of the kinetic energy that the terms do not explain [J].
  double imbalance() const { return kinetic_ - start_ - terms_.gain(); }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(terms_, positions_, spins_, ids_, kinetic_, start_); }
  void deserialized() { inverse_masses_.clear(); }

  /// The component of a vector along those axes of the body along which the body has a mass.
  static Vector with_mass(const Bodies<S>& bodies, std::size_t i, const Vector& x);
  /// Kinetic energy of body i [J] along the axes along which it has a mass. Unlike kinetic_energy() of energy.hpp it counts walls
  /// with a mass, and no motion that is prescribed.
  static double kinetic_energy(const Bodies<S>& bodies, std::size_t i);
  /// Work of the impulse and couple that a body receives, along the prescribed part of its motion
  /// [J]. The drive that prescribes this motion supplies the opposite work.
  static double work_on(const Bodies<S>& bodies, std::uint32_t i, const Vector& lever,
                        const Vector& impulse, const typename S::Angular& couple);
  static double work_of_drives(const Bodies<S>& bodies, const auto& contacts) {
    double work = 0;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Contact<S>& contact = contacts.points[c];
      const Vector impulse = contact.frame * contacts.impulse(c);
      typename S::Angular couple = contacts.couple(c);
      if constexpr (std::remove_cvref_t<decltype(contacts)>::has_couples)
        couple = S::angular_frame(contact.frame) * couple;
      work -= work_on(bodies, contact.b, contact.lever_b, impulse, couple) -
              work_on(bodies, contact.a, contact.lever_a, impulse, couple);
    }
    return work;
  }

  void add_work_of_forces(const Bodies<S>& bodies, const Vector& gravity, Scalar step);
  void add_report(const StepReport& report);
  void remember(const Bodies<S>& bodies);

  EnergyTerms terms_;
  std::vector<Vector> positions_;
  std::vector<typename S::Angular> spins_;
  List<BodyId> ids_;
  double kinetic_ = 0, start_ = 0;
  std::vector<Vector> inverse_masses_;  // of bodies that move, see Bodies [1/kg]; of others < 0
};

// Outside of the class, so that moreau::instances has them compiled.

template <class S>
auto EnergyBalance<S>::with_mass(const Bodies<S>& bodies, std::size_t i, const Vector& x)
    -> Vector {
  const typename S::Matrix axes = bodies.axes(i);
  Vector along = axes.transpose() * x;
  for (int k = 0; k < S::dim; ++k)
    if (!(bodies.inverse_mass[i][k] > 0)) along[k] = 0;
  return axes * along;
}

template <class S>
double EnergyBalance<S>::kinetic_energy(const Bodies<S>& bodies, std::size_t i) {
  const Vector v = bodies.axes(i).transpose() * linear<S>(bodies.velocity[i]);
  const typename S::Angular w = angular<S>(bodies.velocity[i]);
  double energy = 0;
  if (bodies.rotates(i)) energy = double(w.dot(bodies.inertia(i, bodies.pose[i].rotation) * w)) / 2;
  for (int k = 0; k < S::dim; ++k)
    if (bodies.inverse_mass[i][k] > 0)
      energy += double(v[k] * v[k] / bodies.inverse_mass[i][k]) / 2;
  return energy;
}

template <class S>
double EnergyBalance<S>::work_on(const Bodies<S>& bodies, std::uint32_t i, const Vector& lever,
                                 const Vector& impulse, const typename S::Angular& couple) {
  if (bodies.rotates(i) && (bodies.inverse_mass[i].array() > 0).all()) return 0;
  const Vector v = linear<S>(bodies.velocity[i]);
  double work = double(impulse.dot(v - with_mass(bodies, i, v)));
  if (!bodies.rotates(i))
    work += double(angular<S>(bodies.velocity[i]).dot(S::moment(lever, impulse) + couple));
  return work;
}

template <class S>
void EnergyBalance<S>::add_work_of_forces(const Bodies<S>& bodies, const Vector& gravity,
                                          Scalar step) {
  require(
      bodies.id == ids_, "EnergyBalance::add", "simulation", "(bodies were added or removed)",
      "must have the bodies of the start of the balance or of the last rebase(): call rebase()");
  // A snapshot has no masses: after it was read, the first step is not checked.
  for (std::size_t i = 0; i < inverse_masses_.size(); ++i)
    require(inverse_masses_[i][0] < 0 || inverse_masses_[i] == bodies.inverse_mass[i],
            "EnergyBalance::add", "body", i,
            "moves, and was released, or its motion was prescribed, or it got another mass: call "
            "rebase() before the step");
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Vector way = bodies.pose[i].position - positions_[i];
    const Vector force = linear<S>(bodies.force[i]);
    if (!bodies.is_prescribed(i)) terms_.gravity += double(bodies.grain_mass[i] * gravity.dot(way));
    terms_.forces += double(with_mass(bodies, i, force).dot(way));
    if (bodies.rotates(i)) {
      const typename S::Angular spins = spins_[i] + angular<S>(bodies.velocity[i]);
      terms_.forces += double(angular<S>(bodies.force[i]).dot(spins) * step / 2);
    }
  }
}

template <class S>
void EnergyBalance<S>::add_report(const StepReport& report) {
  terms_.friction += report.friction;
  terms_.rolling += report.rolling;
  terms_.fracture += report.fracture;
  terms_.elastic += report.elastic_work;
  terms_.cell += report.cell_work;
  terms_.impacts += report.dissipation - report.friction - report.rolling - report.fracture;
  terms_.correction += report.correction.work;
}

template <class S>
void EnergyBalance<S>::remember(const Bodies<S>& bodies) {
  positions_.resize(bodies.size());
  spins_.resize(bodies.size());
  ids_ = bodies.id;
  inverse_masses_.assign(bodies.inverse_mass.begin(), bodies.inverse_mass.end());
  kinetic_ = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    positions_[i] = bodies.pose[i].position;
    spins_[i] = angular<S>(bodies.velocity[i]);
    kinetic_ += kinetic_energy(bodies, i);
    if (bodies.velocity[i].isZero(0)) inverse_masses_[i].setConstant(-1);
  }
}

}  // namespace moreau
