// SPDX-License-Identifier: MIT
// Which type models which concept, and which type an alias names, folder by folder. examples/guide/reference.md
// shows these lines.
#include <concepts>
#include <type_traits>

#include "moreau/boundary/drive.hpp"
#include "moreau/boundary/servo.hpp"
#include "moreau/detect/broad/all_pairs.hpp"
#include "moreau/detect/broad/cell_grid.hpp"
#include "moreau/detect/broad/sweep_and_prune.hpp"
#include "moreau/detect/collide.hpp"
#include "moreau/io/vtk_poly_data.hpp"
#include "moreau/law/bonded.hpp"
#include "moreau/law/bridges.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/frictionless.hpp"
#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/law/tangential_restitution.hpp"
#include "moreau/moreau.hpp"
#include "moreau/solve/gathered_problem.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"

#include "static/archetypes.hpp"

namespace {

namespace core {
using namespace moreau;

static_assert(EuclideanSpace<Space<2>> && EuclideanSpace<Space<3, float>>);
static_assert(std::same_as<SpaceOfTwist<Space<3>::Twist>, Space<3>>);
// An argument takes a vector with the right number of components, and in the plane an angle as a number.
static_assert(std::convertible_to<Space<3>::Vector, VectorArgument<Space<3>>>);
static_assert(!std::convertible_to<Space<2>::Vector, VectorArgument<Space<3>>>);
static_assert(std::convertible_to<double, AngularArgument<Space<2>>>);
static_assert(std::same_as<VectorArgument<Space<2>>, Components<2, double>>);
// What a function returns can be stored with auto: its operators compute at once.
static_assert(std::same_as<decltype(Value<Space<3>::Vector>() / 2), Value<Space<3>::Vector>>);
// An id of one kind of objects is not an id of another kind.
static_assert(!std::convertible_to<BodyId, ShapeId> && !std::convertible_to<ShapeId, MaterialId>);
}  // namespace core

namespace shape {
using namespace moreau;

static_assert(ConvexShape<Ball<>> && ConvexShape<Disk<>> && ConvexShape<Capsule<>>);
static_assert(Polytope<Polyhedron<>> && Polytope<Polygon<>> && !Polytope<Rounded<Polygon<>>>);
static_assert(ConvexCore<Segment<Space<3>>> && !Shape<Segment<Space<3>>>);  // has no mass
static_assert(HasVolume<Polyhedron<>> && HasCircumradius<Polyhedron<>> &&
              HasInradius<Polyhedron<>>);
static_assert(Scalable<Stadium<>> && HasRoundedMoments<Polygon<>>);
static_assert(std::same_as<Ball<>, BallIn<Space<3>>> && std::same_as<Disk<>, BallIn<Space<2>>>);
static_assert(std::same_as<Capsule<>, CapsuleIn<Space<3>>>);
static_assert(std::same_as<Capsule<>, Rounded<Segment<Space<3>>>>);
static_assert(std::same_as<SpaceOf<Disk<float>>, Space<2, float>>);
}  // namespace shape

namespace detect {
using namespace moreau;

using Egg = archetypes::MinimalConvex<Space<3>>;  // has a support function, but no faces
using Mixed = OneOf<Ball<>, Polyhedron<>>;

static_assert(BroadPhase<SweepAndPrune<Space<3>>, Space<3>> &&
              BroadPhase<CellGrid<Space<2>>, Space<2>>);
static_assert(BroadPhase<AllPairs<Space<3>>, Space<3>>);
static_assert(Elementary<Ball<>> && !Elementary<Rounded<Polyhedron<>>> && !Elementary<Mixed>);
static_assert(SupportOnly<Egg> && !SupportOnly<Polyhedron<>>);
static_assert(GeneralPair<Egg, Polyhedron<>>);  // by GJK and EPA
static_assert(RoundedPair<Rounded<Polyhedron<>>, Ball<>> && MixedPair<Mixed, HalfSpace<Space<3>>>);
static_assert(ReversedPair<Polyhedron<>, Ball<>> != ReversedPair<Ball<>, Polyhedron<>>);
}  // namespace detect

namespace law {
using namespace moreau;
using S = Space<3>;

static_assert(SetValuedLaw<SignoriniCoulomb<>, S> && SetValuedLaw<Frictionless<>, S>);
static_assert(PointLaw<Cohesive<>, S> && AttractiveLaw<Cohesive<>, S>);
static_assert(AttractsInRange<Cohesive<>, S> && !AttractsInRange<Bonded<>, S>);
static_assert(BridgingLaw<Bridged<CapillaryBridge<>>, S> &&
              BridgingLaw<Bridged<LinearCohesion<>>, S>);
static_assert(BondingLaw<Bonded<>, S> && RollingLaw<Bonded<>, S> && LaneLaw<Bonded<>, S>);
static_assert(RollingLaw<RollingResistance<>, S> && Rolls<RollingResistance<>>);
static_assert(RollingCoulombLaw<RollingResistance<>, S> && !CoulombLaw<RollingResistance<>, S>);
static_assert(CompliantLaw<Compliant<SignoriniCoulomb<>>, S>);
static_assert(TangentialRestitutionLaw<TangentialRestitution<>, S>);
static_assert(CoulombLaw<SignoriniCoulomb<>, S> && CoulombLaw<Frictionless<>, S>);
static_assert(FrictionLaw<RollingResistance<>> && RestitutionLaw<RollingResistance<>>);
static_assert(StatefulLaw<SignoriniCoulomb<>, S> && LaneLaw<SignoriniCoulomb<>, S> &&
              MapsLanes<SignoriniCoulomb<>, S>);
static_assert(StaticFrictionLaw<SignoriniCoulomb<>, S> && !StaticFrictionLaw<Bonded<>, S>);
static_assert(LaneLaw<RollingResistance<>, S> && LaneLaw<Frictionless<>, S>);
static_assert(ActsWhereGapsClose<RollingResistance<>> && ActsWhereGapsClose<Bonded<>>);
static_assert(!ActsWhereGapsClose<Cohesive<>> && !ActsWhereGapsClose<TangentialRestitution<>>);
static_assert(RegularizedLaw<LinearSpringDashpot<>, S> && RegularizedLaw<HertzMindlin<>, S>);
static_assert(ContactLaw<SignoriniCoulomb<>, S> && ContactLaw<HertzMindlin<>, S>);
static_assert(std::same_as<BlockOf<SignoriniCoulomb<>, S>, LocalBlock<S>>);
static_assert(std::same_as<BlockOf<RollingResistance<>, S>, RollingBlock<S>>);
static_assert(std::same_as<LaneBlockOf<RollingResistance<>, S>, RoundBlock<S>>);
}  // namespace law

namespace integrate {
using namespace moreau;

static_assert(ImpulseIntegrator<MoreauJean, Space<3>> && ForceIntegrator<VelocityVerlet, Space<3>>);
static_assert(TimeIntegrator<MoreauJean, Space<2>> && TimeIntegrator<VelocityVerlet, Space<2>>);
}  // namespace integrate

namespace solve {
using namespace moreau;
using S = Space<3>;

static_assert(ContactSolver<ColouredGaussSeidel, SignoriniCoulomb<>, S>);
static_assert(ContactSolver<ColouredGaussSeidel, RollingResistance<>, S>);
static_assert(ContactSolver<NonlinearGaussSeidel, RollingResistance<>, S>);
static_assert(std::same_as<OperatorOf<SignoriniCoulomb<>, S>, BodyDelassus<S>>);
static_assert(std::same_as<OperatorOf<RollingResistance<>, S>, BodyDelassus<S, true>>);
static_assert(std::same_as<ContactsOf<RollingResistance<>, S>, Contacts<S, S::dofs>>);
static_assert(
    std::same_as<OperatorOf<Compliant<SignoriniCoulomb<>>, S>, BodyDelassus<S, false, true>>);
}  // namespace solve

namespace world {
using namespace moreau;
using S = Space<3>;

static_assert(std::same_as<DefaultIntegrator<SignoriniCoulomb<>, S>, MoreauJean>);
static_assert(std::same_as<DefaultIntegrator<HertzMindlin<>, S>, VelocityVerlet>);
static_assert(std::same_as<DefaultSolver<SignoriniCoulomb<>, S>, ColouredGaussSeidel>);
static_assert(std::same_as<DefaultSolver<RollingResistance<>, S>, ColouredGaussSeidel>);
static_assert(std::derived_from<Simulation<Ball<>, SignoriniCoulomb<>>, BodyAccess<Ball<>>>);
}  // namespace world

namespace boundary {
using namespace moreau;

static_assert(FunctionOfTime<HarmonicForce, double>);
static_assert(PlainVector<Space<3>::Vector>);
static_assert(SimulationWithVector<Simulation<Ball<>, SignoriniCoulomb<>>, Space<3>::Vector>);
static_assert(AreaFunction<double (*)()>);
}  // namespace boundary

namespace io {
using namespace moreau;

static_assert(VtkNumber<float> && VtkNumber<std::int32_t> && !VtkNumber<bool>);
}  // namespace io

}  // namespace
