// SPDX-License-Identifier: MIT
// Law, integrator and solver of an experiment: contact dynamics, as in the paper, contact dynamics
// with compliant contacts, or molecular dynamics with springs. Shapes, walls, force and measures are the same.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <tuple>

#include "moreau/core/serialize.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/motion/moreau_jean.hpp"
#include "moreau/motion/velocity_verlet.hpp"
#include "moreau/solve/coloured_gauss_seidel.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"
#include "moreau/world/simulation.hpp"

#include "parameters.hpp"

namespace ratcheting {

/// The default solver of the library, with two options. `cold` starts every step from zero
/// impulses, to see how unique the solutions are. `plain` solves with the reference solver instead,
/// to see what the speed costs.
class StudySolver : public moreau::ColouredGaussSeidel {
 public:
  explicit StudySolver(const Options& options = {}, bool cold = false, bool plain = false)
      : ColouredGaussSeidel(options), cold_(cold), plain_(plain) {}

  template <class Operator, class Law>
  moreau::SolveReport solve(moreau::ContactProblem<Operator, Law>& problem,
                            std::span<typename Operator::Vector> impulses,
                            Workspace<Operator, Law>& workspace) const {
    if (cold_) std::fill(impulses.begin(), impulses.end(), Operator::Vector::Zero());
    if (plain_) return reference().solve(problem, impulses);
    return ColouredGaussSeidel::solve(problem, impulses, workspace);
  }

 private:
  friend struct moreau::SerializationAccess;
  auto serialized_members() {
    return std::tie(static_cast<ColouredGaussSeidel&>(*this), cold_, plain_);
  }

  moreau::NonlinearGaussSeidel reference() const {
    moreau::GaussSeidelOptions plain;
    plain.tolerance = options().tolerance;
    plain.stop_test = options().stop_test;
    plain.max_sweeps = options().max_sweeps;
    return moreau::NonlinearGaussSeidel(plain);
  }

  bool cold_, plain_;
};

struct ContactDynamics {
  static constexpr const char* name = "contact-dynamics";  ///< of --method
  static constexpr bool solves = true;
  using Law = moreau::SignoriniCoulomb<double>;
  using Integrator = moreau::MoreauJean;
  using Solver = StudySolver;

  static Law law(const Parameters&, double friction) { return Law(friction); }
  static Parameters settled(const Parameters& p, double) { return p; }
};

struct CompliantDynamics {
  static constexpr bool solves = true;
  using Law = moreau::Compliant<moreau::SignoriniCoulomb<double>>;
  using Integrator = moreau::MoreauJean;
  using Solver = StudySolver;

  static Law law(const Parameters& p, double friction) {
    return Law(moreau::SignoriniCoulomb<double>(friction), p.stiffness);
  }
  static Parameters settled(const Parameters& p, double) { return p; }
};

struct SpringDynamics {
  static constexpr const char* name = "springs";  ///< of --method
  static constexpr bool solves = false;
  using Law = moreau::LinearSpringDashpot<double>;
  using Integrator = moreau::VelocityVerlet;
  using Solver = moreau::NoSolver;

  static Law law(const Parameters& p, double friction) {
    return Law(p.stiffness, 0.8 * p.stiffness, friction, p.restitution);
  }
  /// The parameters with time steps of at most a twentieth of the duration of an impact of the
  /// lightest grain on a wall.
  /// @param lightest mass of this grain [kg]
  static Parameters settled(const Parameters& p, double lightest) {
    Parameters out = p;
    const double longest = law(p, p.friction).duration(lightest / 2) / 20;
    out.step = std::min(p.step, longest);
    out.preparation_step = std::min(p.preparation_step, longest);
    return out;
  }
};

}  // namespace ratcheting
