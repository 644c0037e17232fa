// SPDX-License-Identifier: MIT
// Archetypes: policies that have exactly the functions that their concept requires. The functions
// are only declared, because code compiled with archetypes is never run.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "moreau/detect/broad_phase.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/law/regularized.hpp"
#include "moreau/motion/concepts.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/solve_report.hpp"

namespace archetypes {

/// Has exactly the functions that the concept Shape requires.
template <class S>
struct Minimal {
  using Space = S;
  moreau::MassProperties<S> mass_properties(typename S::Scalar density) const;
  moreau::Aabb<S> bounding_box(const moreau::Pose<S>& pose) const;
};

template <class S>
struct MinimalConvex : Minimal<S> {
  typename S::Vector support(const typename S::Vector& direction) const;
};

/// A contact law for three-dimensional space only.
struct MinimalLaw {
  using S = moreau::Space<3>;
  double velocity_offset(double gap, double before, double step) const;
  S::Vector solve(const moreau::LocalBlock<S>& block, const S::Vector& b,
                  const S::Vector& guess) const;
  S::Vector natural_map(const S::Vector& velocity, const S::Vector& impulse) const;
};

template <class S>
struct MinimalSprings {
  typename S::Vector force(const moreau::ContactMotion<S>& motion,
                           typename S::Vector& memory) const;
};

template <class S>
struct MinimalIntegrator {
  using Scalar = typename S::Scalar;
  using Angular = typename S::Angular;
  using Twist = typename S::Twist;
  void predict_configuration(moreau::Bodies<S>& bodies, std::span<Angular> momentum,
                             Scalar step) const;
  void free_velocity(const moreau::Bodies<S>& bodies, const typename S::Vector& gravity,
                     std::span<const Angular> momentum, std::span<Twist> free, Scalar step) const;
  void advance_configuration(moreau::Bodies<S>& bodies, std::span<const Twist> after,
                             Scalar step) const;
};

template <class S>
struct MinimalForceIntegrator {
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Loads = std::span<const typename S::Twist>;
  void predict_configuration(moreau::Bodies<S>& bodies, Loads loads, const Vector& gravity,
                             Scalar step) const;
  void advance_configuration(moreau::Bodies<S>& bodies, Loads loads, const Vector& gravity,
                             Scalar step) const;
};

template <class S>
struct MinimalBroadPhase {
  void find_pairs(std::span<const moreau::Aabb<S>> boxes, std::vector<moreau::IndexPair>& pairs);
};

struct MinimalSolver {
  template <class Operator, class Law>
  struct Workspace {};
  template <class Operator, class Law>
  moreau::SolveReport solve(moreau::ContactProblem<Operator, Law>& problem,
                            std::span<typename Operator::Vector> impulses,
                            Workspace<Operator, Law>& workspace) const;
};

}  // namespace archetypes
