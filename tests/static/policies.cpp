// SPDX-License-Identifier: MIT
// Contact laws and integrators: those of the library, and archetypes of those that a user may
// write.
#include "moreau/world/detail/policies.hpp"

#include <span>

#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/law/frictionless.hpp"
#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/motion/concepts.hpp"
#include "moreau/motion/moreau_jean.hpp"
#include "moreau/motion/velocity_verlet.hpp"
#include "moreau/solve/coloured_gauss_seidel.hpp"
#include "moreau/solve/concepts.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"
#include "moreau/world/defaults.hpp"
#include "moreau/world/detail/force_dynamics.hpp"

#include "static/archetypes.hpp"

namespace {

using moreau::SetValuedLaw;
using moreau::Space;
using moreau::TimeIntegrator;

static_assert(SetValuedLaw<moreau::SignoriniCoulomb<double>, Space<2>>);
static_assert(SetValuedLaw<moreau::SignoriniCoulomb<double>, Space<3>>);
static_assert(SetValuedLaw<moreau::SignoriniCoulomb<float>, Space<2, float>>);
static_assert(SetValuedLaw<moreau::SignoriniCoulomb<float>, Space<3, float>>);
static_assert(!SetValuedLaw<int, Space<3>>);

static_assert(TimeIntegrator<moreau::MoreauJean, Space<2>>);
static_assert(TimeIntegrator<moreau::MoreauJean, Space<3>>);
static_assert(TimeIntegrator<moreau::MoreauJean, Space<3, float>>);
static_assert(!TimeIntegrator<moreau::SignoriniCoulomb<double>, Space<3>>);

static_assert(moreau::ImpulseIntegrator<moreau::MoreauJean, Space<3>>);
static_assert(!moreau::ForceIntegrator<moreau::MoreauJean, Space<3>>);
static_assert(moreau::ForceIntegrator<moreau::VelocityVerlet, Space<2>>);
static_assert(moreau::ForceIntegrator<moreau::VelocityVerlet, Space<3, float>>);
static_assert(!moreau::ImpulseIntegrator<moreau::VelocityVerlet, Space<3>>);

static_assert(moreau::PointLaw<moreau::Frictionless<double>, Space<3>>);
static_assert(moreau::LaneLaw<moreau::Frictionless<float>, Space<2, float>>);
static_assert(moreau::LaneLaw<moreau::Cohesive<>, Space<3>>);
static_assert(moreau::AttractiveLaw<moreau::Cohesive<>, Space<3>>);
static_assert(!moreau::AttractiveLaw<moreau::SignoriniCoulomb<double>, Space<3>>);
static_assert(moreau::StaticFrictionLaw<moreau::SignoriniCoulomb<double>, Space<2>>);
static_assert(moreau::RollingLaw<moreau::RollingResistance<double>, Space<3>>);
static_assert(!moreau::PointLaw<moreau::RollingResistance<double>, Space<3>>);
static_assert(moreau::RegularizedLaw<moreau::LinearSpringDashpot<double>, Space<3>>);
static_assert(moreau::RegularizedLaw<moreau::HertzMindlin<float>, Space<2, float>>);
static_assert(!moreau::SetValuedLaw<moreau::HertzMindlin<double>, Space<3>>);
static_assert(!moreau::RegularizedLaw<moreau::SignoriniCoulomb<double>, Space<3>>);

using Rolling = moreau::RollingResistance<double>;
static_assert(moreau::ContactSolver<moreau::NonlinearGaussSeidel, Rolling, Space<2>>);
static_assert(moreau::ContactSolver<moreau::NonlinearGaussSeidel, moreau::Cohesive<>, Space<3>>);
static_assert(moreau::ContactSolver<moreau::ColouredGaussSeidel, moreau::Cohesive<>, Space<3>>);
static_assert(moreau::ContactSolver<moreau::ColouredGaussSeidel, Rolling, Space<2>>);
static_assert(!moreau::ContactSolver<moreau::NoSolver, moreau::Cohesive<>, Space<3>>);

// A cohesive law has the concepts of the law on which it is based.
static_assert(moreau::StaticFrictionLaw<moreau::Cohesive<>, Space<3>>);
static_assert(!moreau::StatefulLaw<moreau::Cohesive<moreau::Frictionless<>>, Space<3>>);
static_assert(moreau::RollingLaw<moreau::Cohesive<Rolling>, Space<3>>);
static_assert(moreau::AttractiveLaw<moreau::Cohesive<archetypes::MinimalLaw>, Space<3>>);

// A law for three-dimensional space satisfies the concept in this space only.
static_assert(SetValuedLaw<archetypes::MinimalLaw, Space<3>>);
static_assert(!SetValuedLaw<archetypes::MinimalLaw, Space<2>>);

/// A law with a coefficient of friction is not yet Coulomb's law: other methods than its solve() may not solve it.
struct HasFriction : archetypes::MinimalLaw {
  double friction() const;
};
struct SaysCoulomb : HasFriction {
  static constexpr bool is_coulomb = true;
  double friction() const;
  S::Vector solve(const moreau::LocalBlock<S>& block, const S::Vector& b,
                  const S::Vector& guess) const;
};
static_assert(!moreau::CoulombLaw<HasFriction, moreau::Space<3>>);
static_assert(moreau::CoulombLaw<SaysCoulomb, moreau::Space<3>>);
/// A law that derives from Coulomb's is solved like it, unless it has another solve().
struct Named : moreau::SignoriniCoulomb<> {};
template <class S>
struct OwnSolution : moreau::SignoriniCoulomb<> {
  typename S::Vector solve(const moreau::LocalBlock<S>& block, const typename S::Vector& b,
                           const typename S::Vector& guess) const;
};
static_assert(moreau::CoulombLaw<Named, Space<2>> && moreau::LaneLaw<Named, Space<2>>);
using Own = OwnSolution<Space<3>>;
static_assert(SetValuedLaw<Own, Space<3>> && moreau::PointLaw<Own, Space<3>>);
static_assert(!moreau::CoulombLaw<Own, Space<3>> && !moreau::LaneLaw<Own, Space<3>>);
static_assert(!moreau::LaneLaw<moreau::Compliant<Own>, Space<3>>);
static_assert(moreau::LaneLaw<moreau::Compliant<>, Space<3>> &&
              moreau::LaneLaw<moreau::Cohesive<Rolling>, Space<2>>);
/// A law of a user with an attraction: a contact has one attraction.
struct Sticky : archetypes::MinimalLaw {
  double attraction(double gap) const;
};
static_assert(moreau::detail::Attracts<Sticky> && !moreau::detail::Attracts<HasFriction>);
static_assert(moreau::AttractiveLaw<Sticky, Space<3>> &&
              !moreau::AttractsInRange<Sticky, Space<3>>);
static_assert(moreau::AttractsInRange<moreau::Cohesive<>, Space<2>>);
static_assert(moreau::FrictionLaw<HasFriction> && !moreau::FrictionLaw<Sticky>);
static_assert(moreau::RestitutionLaw<moreau::Frictionless<float>> &&
              !moreau::RestitutionLaw<Sticky>);
/// Functions that are not const, or of another type, are none of these concepts, and no Simulation compiles with them.
struct Changes : archetypes::MinimalLaw {
  double attraction(double gap);
  double range();
  double friction();
  double restitution();
  double normal_compliance();
  bool is_bridged(std::size_t k);
};
using Names = moreau::detail::NamesOf<Changes, Space<3>>;
static_assert(Names::attraction && Names::range && Names::friction && Names::restitution &&
              Names::springs && Names::bridges && Names::changing_friction);
static_assert(!moreau::AttractiveLaw<Changes, Space<3>> && !moreau::FrictionLaw<Changes> &&
              !moreau::RestitutionLaw<Changes>);
static_assert(moreau::detail::Attracts<Changes> && moreau::detail::HasSprings<Changes>);

struct LeaksExpression : archetypes::MinimalLaw {
  auto natural_map(const S::Vector& velocity, const S::Vector& impulse) const {
    return impulse - velocity;
  }
};
static_assert(!SetValuedLaw<LeaksExpression, Space<3>>);

static_assert(TimeIntegrator<archetypes::MinimalIntegrator<Space<2>>, Space<2>>);
static_assert(TimeIntegrator<archetypes::MinimalIntegrator<Space<3>>, Space<3>>);
static_assert(!TimeIntegrator<archetypes::MinimalIntegrator<Space<3>>, Space<2>>);

}  // namespace
