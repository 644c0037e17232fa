// SPDX-License-Identifier: MIT
// The requirements on every valid combination of shape, law and integrator in a simulation. A new
// policy is tested by one line:
//
//   TEST_CASE("mine") { conformance::world(MyShape(...), MyLaw(...), size); }
//
// For policies that are not the default:
//
//   using Mine = conformance::With<MyIntegrator, MyBroadPhase, MySolver>;
//   TEST_CASE("mine") { conformance::world<Mine>(MyShape(...), MyLaw(...), size); }
#pragma once

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

#include "moreau/measure/energy.hpp"
#include "moreau/world/simulation.hpp"

namespace conformance {

/// The simulation with the default policies for shape and law.
struct Defaults {
  template <class ShapeT, class Law>
  using Simulation = moreau::Simulation<ShapeT, Law>;
};
/// The simulation with these policies in place of the defaults.
template <class Integrator, class Broad = void, class Solver = void>
struct With {
  template <class Given, class Default>
  using Or = std::conditional_t<std::is_void_v<Given>, Default, Given>;
  template <class ShapeT, class Law, class S = moreau::SpaceOf<ShapeT>>
  using Simulation =
      moreau::Simulation<ShapeT, Law, Or<Integrator, moreau::DefaultIntegrator<Law, S>>,
                         Or<Broad, moreau::SweepAndPrune<S>>,
                         Or<Solver, moreau::DefaultSolver<Law, S>>>;
};

/// Eight grains on a lattice whose spacing is larger than the grains. The shapes are used in turn.
/// The orientations are random. The grains have two materials in turn, which have the same contact
/// law.
template <class Choice, class ShapeT, class Law>
class Assembly {
 public:
  using Simulation = typename Choice::template Simulation<ShapeT, Law>;
  using S = moreau::SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;
  static constexpr bool springs = moreau::RegularizedLaw<Law, S>;

  /// @param size diameter of a ball that contains any of the shapes [m]
  Assembly(const std::vector<ShapeT>& shapes, const Law& law, T size)
      : simulation(size, moreau::Materials<Law>(2, law)), size_(size), random_(11) {
    std::vector<moreau::ShapeId> ids;
    for (const ShapeT& shape : shapes) ids.push_back(simulation.add_shape(shape));
    for (int k = 0; k < 8; ++k) {
      moreau::Pose<S> pose;
      for (int axis = 0; axis < S::dim; ++axis)
        pose.position[axis] = T(1.1) * size * (T(0.5) + T(axis < up ? (k >> axis) % 2 : k >> up));
      typename S::Angular turn;
      for (auto& x : turn) x = T(uniform_(random_));
      pose.rotation = S::exp(turn);
      simulation.add_grain(ids[std::size_t(k) % ids.size()], pose, T(1000),
                           moreau::MaterialId(std::size_t(k) % 2));
    }
  }
  void add_box() {
    for (int axis = 0; axis < S::dim; ++axis) {
      simulation.add_wall(Vector::Unit(axis), Vector::Zero(), moreau::MaterialId(1));
      if (axis < up) simulation.add_wall(-Vector::Unit(axis), T(2.2) * size_ * Vector::Unit(axis));
    }
    simulation.set_gravity(T(-10) * Vector::Unit(up));
  }
  /// Sets random velocities with components up to `speed` [m/s], and angular velocities up to speed
  /// / size.
  void stir(T speed) {
    for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
      Vector v;
      typename S::Angular w;
      for (auto& x : v) x = speed * T(uniform_(random_));
      for (auto& x : w) x = speed / size_ * T(uniform_(random_));
      simulation.set_velocity(simulation.grain(k), v);
      simulation.set_spin(simulation.grain(k), w);
    }
  }
  moreau::BodyMotion<S> motion(std::size_t k) const {
    const auto& bodies = simulation.bodies();
    const std::size_t i = simulation.grain(k).index();
    return {bodies.grain_mass[i], bodies.inertia(i, bodies.pose[i].rotation),
            bodies.pose[i].position, bodies.velocity[i]};
  }
  moreau::Momentum<S> momentum() const {
    return moreau::momentum<S>(simulation.grain_count(), [&](std::size_t k) { return motion(k); });
  }
  double kinetic_energy() const { return double(moreau::kinetic_energy(simulation).total()); }
  double potential_energy() const {
    double sum = 0;
    for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
      const auto m = motion(k);
      sum -= double(m.mass * simulation.gravity().dot(m.position));
    }
    return sum;
  }
  /// Bound of the change of energy in free flight under Moreau-Jean [J]: second order in the
  /// rotation per step (case asymmetric_top of the validation), and zero if all principal moments
  /// are equal.
  double energy_error(T step) const {
    double sum = 0;
    for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
      const auto m = motion(k);
      const typename S::Angular w = m.velocity.template tail<S::angular_dim>();
      const auto moments =
          Eigen::SelfAdjointEigenSolver<typename S::Inertia>(m.inertia).eigenvalues().eval();
      const double unevenness = 1 - double(moments.minCoeff() / moments.maxCoeff());
      sum += unevenness * double(w.squaredNorm() * step * step) / 12 *
             double(w.dot(m.inertia * w)) / 2;
    }
    return sum;
  }
  /// Upper bound of the speed of all points of all grains [m/s].
  double fastest() const {
    double most = 0;
    for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
      const auto v = motion(k).velocity;
      most = std::max(most, double(v.template head<S::dim>().norm() +
                                   v.template tail<S::angular_dim>().norm() * size_ / 2));
    }
    return most;
  }
  T mass() const {
    T sum = 0;
    for (std::size_t k = 0; k < simulation.grain_count(); ++k) sum += motion(k).mass;
    return sum;
  }

  Simulation simulation;

 private:
  T size_;
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

/// Largest allowed overlap [m]. Springs are compressed. Rigid grains may overlap only by their
/// motion in one step: through a gap that was larger than the margin, or, under a law with
/// restitution, through any gap.
template <class A>
double deepest_allowed(const A& grains, typename A::T step, typename A::T size) {
  return A::springs ? 0.05 * double(size) : 2 * grains.fastest() * double(step);
}

/// Energy that a contact point can take from an attraction while it approaches [J]. The force of a step acts along the whole
/// path of the step, also if the step begins beyond the reach of the attraction: the force acts over the reach and one path.
/// @param path largest relative displacement of two points in a step [m]
template <class S, class Law>
double energy_of_attraction(const Law& law, typename S::Scalar size, double path) {
  using T = typename S::Scalar;
  if constexpr (moreau::BridgingLaw<Law, S>)
    return double(law.bridge_force(T(0), size)) * (double(law.reach()) + path);
  else if constexpr (moreau::AttractiveLaw<Law, S> && !moreau::BondingLaw<Law, S>)
    return double(law.attraction(T(0))) * (moreau::Tolerances().margin * double(size) + path);
  else
    return 0;
}

/// Grains with random velocities collide without gravity. Checks that the momentum is conserved and
/// that the energy does not increase. The overlap correction is switched off, because it moves
/// bodies without regard to their velocities and so does not conserve the angular momentum.
template <class Choice = Defaults, class ShapeT, class Law>
void cloud(const std::vector<ShapeT>& shapes, const Law& law,
           typename moreau::SpaceOf<ShapeT>::Scalar size) {
  using A = Assembly<Choice, ShapeT, Law>;
  using T = typename A::T;
  const double rounding = double(std::numeric_limits<T>::epsilon());
  A grains(shapes, law, size);
  grains.stir(T(1));
  if constexpr (!A::springs) {
    moreau::OverlapCorrectionOptions off;
    off.enabled = false;
    grains.simulation.set_correction(off);
  }
  const auto before = grains.momentum();
  const double energy = grains.kinetic_energy(), mass = double(grains.mass());
  const T step = A::springs ? T(1e-5) : T(2e-4);
  const double rise =
      A::springs ? 0.02 * energy : 1e4 * rounding * energy + grains.energy_error(step);
  std::size_t points = 0, at_once = 0;
  double most = 0, deepest = 0, allowed = deepest_allowed(grains, step, size);
  double fastest = grains.fastest();
  int unsolved = 0;
  const int steps = int(0.05 / double(step));
  for (int k = 0; k < steps; ++k) {
    const auto report = grains.simulation.step(step);
    points += report.points;
    at_once = std::max(at_once, report.points);
    unsolved += !report.solve.converged;
    deepest = std::max(deepest, report.max_overlap);
    allowed = std::max(allowed, deepest_allowed(grains, step, size));
    fastest = std::max(fastest, grains.fastest());
    most = std::max(most, grains.kinetic_energy());
  }
  const auto after = grains.momentum();
  CHECK(points > 0);
  CHECK(unsolved <= steps / 100);  // grains may block each other for a short time
  CHECK(deepest < allowed);
  CHECK(std::isfinite(grains.kinetic_energy()));
  // In float the rounding errors of the steps dominate, in double the errors of laws with small
  // constants.
  const double lost = (sizeof(T) == 4 ? double(steps) : 1e5) * rounding * mass;
  CHECK(double((after.linear - before.linear).norm()) < lost);
  CHECK(double((after.angular - before.angular).norm()) < lost * double(size));
  // Impacts without restitution take more than an attraction gives.
  double given = 0;
  if constexpr (moreau::TangentialRestitutionLaw<Law, moreau::SpaceOf<ShapeT>>)
    given = energy_of_attraction<moreau::SpaceOf<ShapeT>>(law, size, 2 * fastest * double(step)) *
            double(at_once);
  CHECK(most - energy <= rise + given);
}

/// Compares the change of the grains' momentum in a step with the impulses of the walls. Depending
/// on the integrator, these are the impulses of this step, of the previous step, or a fixed mean of
/// both.
template <class Vector>
class MomentumBalance {
 public:
  void step(const Vector& gain, const Vector& push) {
    gains_.push_back(gain - last_);
    changes_.push_back(push - last_);
    last_ = push;
  }
  /// The weight of this step's impulses in the mean for which the balance is best.
  double share() const {
    double with = 0, squares = 0;
    for (std::size_t k = 0; k < gains_.size(); ++k) {
      with += double(gains_[k].dot(changes_[k]));
      squares += double(changes_[k].squaredNorm());
    }
    return squares > 0 ? with / squares : 1;
  }
  /// The largest error of the balance in a step [N s].
  double worst(double share) const {
    double most = 0;
    for (std::size_t k = 0; k < gains_.size(); ++k)
      most = std::max(
          most,
          (gains_[k].template cast<double>() - share * changes_[k].template cast<double>()).norm());
    return most;
  }

 private:
  std::vector<Vector> gains_, changes_;
  Vector last_ = Vector::Zero();
};

/// Grains fall into a box. Checks that the momentum changes by the impulses of walls and gravity,
/// that the energy does not increase, and that overlaps stay small.
template <class Choice = Defaults, class ShapeT, class Law>
void heap(const std::vector<ShapeT>& shapes, const Law& law,
          typename moreau::SpaceOf<ShapeT>::Scalar size) {
  using A = Assembly<Choice, ShapeT, Law>;
  using T = typename A::T;
  using Vector = typename A::Vector;
  const double rounding = double(std::numeric_limits<T>::epsilon());
  A grains(shapes, law, size);
  grains.add_box();
  auto& simulation = grains.simulation;
  const double energy = grains.kinetic_energy() + grains.potential_energy();
  const double drop = double(grains.mass()) * 10 * double(size);
  // A shape with a support function only has one contact point where other shapes have two. It
  // rocks on this point. The contact of the end that moves down is detected late, when the end has
  // already moved into the other body by its motion in a step.
  constexpr bool rocks = moreau::SupportOnly<ShapeT>;
  const T step = A::springs ? T(1e-5) : rocks ? T(1e-4) : T(2e-4);
  // With restitution a contact acts once its gap is closed. A surface that meets another one has then entered it by the
  // way that both have moved in a step.
  bool bounces = false;
  if constexpr (requires { law.restitution(); }) bounces = law.restitution() > 0;
  double deepest = 0, most = energy, scale = 0, fastest = 0;
  int unsolved = 0;
  std::size_t points = 0, at_once = 0;
  MomentumBalance<Vector> balance;
  const int steps = int(0.15 / double(step));
  for (int k = 0; k < steps; ++k) {
    for (const auto grain : simulation.grains())
      fastest = std::max(fastest, double(simulation.velocity(grain).norm()) +
                                      double(simulation.spin(grain).norm() * size / 2));
    const Vector start = grains.momentum().linear;
    const auto report = simulation.step(step);
    Vector push = Vector::Zero();
    for (const auto wall : simulation.walls()) push -= simulation.contact_impulse(wall);
    const Vector pull = step * grains.mass() * simulation.gravity();
    balance.step(grains.momentum().linear - start - pull, push);
    points += report.points;
    at_once = std::max(at_once, report.points);
    unsolved += !report.solve.converged;
    scale = std::max(scale, double(push.norm() + pull.norm()));
    deepest = std::max(deepest, report.max_overlap);
    most = std::max(most, grains.kinetic_energy() + grains.potential_energy());
  }
  CHECK(std::isfinite(grains.kinetic_energy() + grains.potential_energy()));
  const double share = A::springs ? std::round(2 * balance.share()) / 2 : 1;
  CHECK(share >= 0);
  CHECK(share <= 1);
  CHECK(points > 0);
  // In float the tolerance is a hundredth of the momentum that gravity adds in a step.
  const double roundings = (sizeof(T) == 4 ? 100 : 1e4) * rounding;
  CHECK(balance.worst(share) < roundings * (scale + double(grains.mass())));
  CHECK(unsolved <= steps / 100);  // grains may block each other for a short time
  CHECK(deepest <
        (A::springs ? 0.05 : 0.01) * double(size) + (bounces ? 2 * fastest * double(step) : 0));
  const double given =
      energy_of_attraction<moreau::SpaceOf<ShapeT>>(law, size, 2 * fastest * double(step));
  CHECK(most - energy <= (A::springs ? 0.02 : 1e-3) * drop + given * double(at_once));
}

/// A grain falls on another, whose motion is prescribed, and is bonded to it; then gravity is turned round. Checks that a
/// strong bond holds it where it is, and that a weak one breaks.
/// @param law_of function: strength of a bond in tension, shear and bending [N] -> law
template <class Choice = Defaults, class ShapeT>
void bonded(const std::vector<ShapeT>& shapes, const auto& law_of,
            typename moreau::SpaceOf<ShapeT>::Scalar size) {
  using S = moreau::SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Law = std::decay_t<decltype(law_of(T(1)))>;
  for (const ShapeT& shape : shapes)
    for (const bool strong : {true, false}) {
      CAPTURE(strong);
      const typename S::Vector up = S::Vector::Unit(S::dim - 1);
      const T weight = 10 * shape.mass_properties(T(1000)).mass;
      typename Choice::template Simulation<ShapeT, Law> simulation(
          size, moreau::Materials<Law>(1, law_of((strong ? T(200) : T(0.5)) * weight)));
      const auto id = simulation.add_shape(shape);
      simulation.prescribe_motion(simulation.add_grain(id, {}, T(1000)));
      const auto grain = simulation.add_grain(
          id, {T(1.05) * size * up, S::exp(S::Angular::Constant(T(1)))}, T(1000));
      simulation.set_gravity(T(-10) * up);
      for (int k = 0; k < 300 && simulation.bond_touching(T(1e-3) * size) == 0; ++k)
        simulation.step(T(5e-4));
      REQUIRE(simulation.bonds().size() == 1);
      simulation.set_velocity(grain, S::Vector::Zero());
      simulation.set_spin(grain, S::Angular::Zero());
      simulation.set_gravity(T(10) * up);
      const typename S::Vector before = simulation.pose(grain).position;
      for (int k = 0; k < 100; ++k) simulation.step(T(5e-4));
      CHECK(simulation.bonds().size() == (strong ? 1 : 0));
      CHECK(simulation.breakages().size() == (strong ? 0 : 1));
      const double moved = double((simulation.pose(grain).position - before).norm());
      CHECK((moved < 1e-3 * double(size)) == strong);  // it would fall by 12 mm
    }
}
/// A grain falls on another, whose motion is prescribed, and hangs from it after gravity is turned
/// round. Checks that a law which attracts every contact holds it.
/// @param law_of function: attraction of a contact point [N] -> law
template <class Choice = Defaults, class ShapeT>
void hang(const std::vector<ShapeT>& shapes, const auto& law_of,
          typename moreau::SpaceOf<ShapeT>::Scalar size) {
  using S = moreau::SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Law = std::decay_t<decltype(law_of(T(1)))>;
  for (const ShapeT& shape : shapes)
    for (const T angle : {T(0), T(1), T(4)}) {
      CAPTURE(angle);
      typename S::Vector up = S::Vector::Zero();
      up[0] = std::sin(angle), up[S::dim - 1] = std::cos(angle);
      // It swings: at the lowest point it pulls with up to five times its weight.
      const T weight = 10 * shape.mass_properties(T(1000)).mass;
      typename Choice::template Simulation<ShapeT, Law> simulation(
          size, moreau::Materials<Law>(1, law_of(10 * weight)));
      const auto id = simulation.add_shape(shape);
      simulation.prescribe_motion(simulation.add_grain(id, {}, T(1000)));
      const auto grain = simulation.add_grain(
          id, {T(1.05) * size * up, S::exp(S::Angular::Constant(angle))}, T(1000));
      double farthest = 0;
      for (int k = 0; k < 700; ++k) {
        simulation.set_gravity(T(k < 300 ? -10 : 10) * up);
        simulation.step(T(5e-4));
        if (k >= 300) farthest = std::max(farthest, double(simulation.pose(grain).position.norm()));
      }
      CHECK(farthest < 1.01 * double(size));  // it would fall by 20 cm
    }
}

/// Runs all checks.
/// @param size diameter of a ball that contains any of the shapes [m]
template <class Choice = Defaults, class ShapeT, class Law>
void world(const std::vector<ShapeT>& shapes, const Law& law,
           typename moreau::SpaceOf<ShapeT>::Scalar size) {
  cloud<Choice>(shapes, law, size);
  heap<Choice>(shapes, law, size);
}
template <class Choice = Defaults, moreau::Shape ShapeT, class Law>
void world(const ShapeT& shape, const Law& law, typename moreau::SpaceOf<ShapeT>::Scalar size) {
  world<Choice>(std::vector<ShapeT>{shape}, law, size);
}

}  // namespace conformance
