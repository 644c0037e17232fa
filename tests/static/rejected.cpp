// SPDX-License-Identifier: MIT
// What a user may get wrong, and the message of the compiler. The test static.rejected.NAME compiles
// the lines between #ifdef NAME and #endif  // NAME of this file twice:
//
//  1. With MOREAU_CORRECTED defined they must compile. So the mistake alone is what fails in 2.
//  2. Without it they must not compile. What the compiler says must match every regular expression
//     after "expect:". With a line "and no other error" it must report exactly one error.

/// A mistake, and what is right in its place.
#ifdef MOREAU_CORRECTED
#define EITHER(wrong, right) right
#else
#define EITHER(wrong, right) wrong
#endif

#ifdef velocity_of_two_numbers
// A velocity with two components in a simulation in space.
// expect: (use of|call to) deleted (function|constructor).*Components
// and no other error
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

using World = moreau::Simulation<moreau::Ball<double>, moreau::SignoriniCoulomb<double>>;

void push(World& world, moreau::BodyId body) {
#ifdef MOREAU_CORRECTED
  world.set_velocity(body, {1, 0, 0});
#else
  world.set_velocity(body, {1, 0});
#endif
}
#endif  // velocity_of_two_numbers

#ifdef pose_of_another_dimension
// A position with two components for a pose in space.
// expect: (use of|call to) deleted (function|constructor).*Components
// and no other error
#include "moreau/core/pose.hpp"

#ifdef MOREAU_CORRECTED
const moreau::Pose<moreau::Space<3>> pose{{0, 0, 0}};
#else
const moreau::Pose<moreau::Space<3>> pose{{0, 0}};
#endif
#endif  // pose_of_another_dimension

#ifdef ids_do_not_mix
// The id of a body is passed where the id of a shape is required.
// expect: (could not convert|no known conversion)
#include "moreau/core/ids.hpp"

inline std::size_t vertices_of(moreau::ShapeId shape) {
  return shape.index();
}

const std::size_t count = vertices_of(EITHER(moreau::BodyId, moreau::ShapeId)(std::size_t{1}));
#endif  // ids_do_not_mix

#ifdef space_of_integers
// The scalar type of a space is an integer.
// expect: (floating_point|is_floating_point)
#include "moreau/core/space.hpp"

moreau::Space<3, EITHER(int, float)>::Vector x;
#endif  // space_of_integers

#ifdef shape_of_a_space
// A space is given as template argument where a shape requires a scalar type.
// expect: (constraint failure for.*floating_point|constraints not satisfied for alias template 'Ball')
#include "moreau/shape/ball.hpp"

using Grain = moreau::Ball<EITHER(moreau::Space<3>, double)>;
Grain* grain;
#endif  // shape_of_a_space

#ifdef two_attractions
// A law with an attraction at every contact, and bridges beside it.
// expect: Bridged<Bridge, Law>: Law has an attraction of its own
#include "moreau/law/bridges.hpp"
#include "moreau/law/cohesive.hpp"

using Push = EITHER(moreau::Cohesive<>, moreau::SignoriniCoulomb<>);
const moreau::Bridged<moreau::CapillaryBridge<>, Push> wet(moreau::CapillaryBridge<>(1e-12));
#endif  // two_attractions

#ifdef cohesive_bonds
// A law with bonds, and an attraction at every contact beside them.
// expect: Cohesive<Law>: Law has an attraction of its own
#include "moreau/law/bonded.hpp"
#include "moreau/law/cohesive.hpp"

using Push = EITHER(moreau::Bonded<>, moreau::RollingResistance<>);
void glue(const moreau::Cohesive<Push>& law) {
  (void)law.adhesion();
}
#endif  // cohesive_bonds

#ifdef bridged_bonds
// A law with bonds, and bridges beside them.
// expect: Bridged<Bridge, Law>: Law has an attraction of its own
#include "moreau/law/bonded.hpp"
#include "moreau/law/bridges.hpp"

using Push = EITHER(moreau::Bonded<>, moreau::RollingResistance<>);
void wet(const moreau::Bridged<moreau::CapillaryBridge<>, Push>& law) {
  (void)law.reach();
}
#endif  // bridged_bonds

#ifdef cohesion_twice
// Two attractions at every contact.
// expect: Cohesive<Law>: Law has an attraction of its own
#include "moreau/law/cohesive.hpp"

using Push = EITHER(moreau::Cohesive<>, moreau::SignoriniCoulomb<>);
void stick(const moreau::Cohesive<Push>& law) {
  (void)law.adhesion();
}
#endif  // cohesion_twice

#ifdef springs_in_a_deforming_cell
// A regularized law in a cell that deforms.
// expect: Simulation: a cell of set_cell\(\) needs a law for impulses
// and no other error
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

using Law = EITHER(moreau::LinearSpringDashpot<>, moreau::SignoriniCoulomb<>);
void shear(moreau::Simulation<moreau::Ball<>, Law>& simulation) {
  simulation.set_cell(moreau::Space<3>::Matrix::Identity());
}
#endif  // springs_in_a_deforming_cell

#ifdef control_of_a_cell_with_springs
// The same, where the cell is controlled.
// expect: Simulation: a cell of set_cell\(\) needs a law for impulses
// and no other error
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

using Law = EITHER(moreau::LinearSpringDashpot<>, moreau::SignoriniCoulomb<>);
void shear(moreau::Simulation<moreau::Ball<>, Law>& simulation) {
  simulation.control_cell(moreau::CellControl<moreau::Space<3>>());
}
#endif  // control_of_a_cell_with_springs

#ifdef bond_of_a_law_without
// Two grains are bonded under a law without bonds.
// expect: Simulation: the law has no bonds
// and no other error
#include "moreau/law/bonded.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/world/simulation.hpp"

using Law = EITHER(moreau::LinearSpringDashpot<>, moreau::Bonded<>);
void glue(moreau::Simulation<moreau::Polygon<>, Law>& simulation) {
  simulation.bond(simulation.grain(0), simulation.grain(1));
}
#endif  // bond_of_a_law_without

#ifdef springs_with_tangential_restitution
// Springs in series with a law that has a tangential restitution.
// expect: Compliant<TangentialRestitution> would have two tangential restitutions
#include "moreau/law/compliant.hpp"
#include "moreau/law/tangential_restitution.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

using Push = EITHER(moreau::TangentialRestitution<>, moreau::SignoriniCoulomb<>);
using Law = moreau::Compliant<Push>;
const moreau::Materials<Law> materials(1, Law(Push(0.4), 1e6));
const moreau::Simulation<moreau::Ball<>, Law> world(1, materials);
#endif  // springs_with_tangential_restitution

#ifdef attraction_where_gaps_close
// A law with an attraction, which open contacts have, that claims to act where gaps close alone.
// expect: a law with springs, bridges or an attraction acts where gaps are open, too
#include "moreau/law/cohesive.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

struct Law : moreau::Cohesive<> {
  using Cohesive::Cohesive;
  using EITHER(ActsWhereGapsClose, AnotherName) = Law;
};
const moreau::Simulation<moreau::Ball<>, Law> world(
    1, moreau::Materials<Law>(1, Law(moreau::SignoriniCoulomb<>(0.4))));
#endif  // attraction_where_gaps_close

#ifdef range_that_is_not_const
// A range of the attraction that is not const: the attraction would end at the margin.
// expect: Law has range\(\), but is no AttractsInRange
#include "moreau/law/cohesive.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

struct Law : moreau::Cohesive<> {
  double range() EITHER(, const) { return 0.1; }
};
const moreau::Simulation<moreau::Ball<>, Law> world(1, moreau::Materials<Law>(1, Law()));
#endif  // range_that_is_not_const

#ifdef range_of_another_scalar
// A range of the attraction in another scalar.
// expect: Law has range\(\), but is no AttractsInRange
#include "moreau/law/cohesive.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

struct Law : moreau::Cohesive<> {
  EITHER(float, double) range() const { return 0.1f; }
};
const moreau::Simulation<moreau::Ball<>, Law> world(1, moreau::Materials<Law>(1, Law()));
#endif  // range_of_another_scalar

#ifdef attraction_that_is_not_const
// An attraction that is not const: the law would have none.
// expect: Law has attraction\(\), but is no AttractiveLaw
#include "moreau/law/cohesive.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

struct Law : moreau::SignoriniCoulomb<> {
  double attraction(double) EITHER(, const) { return 0.1; }
};
const moreau::Simulation<moreau::Ball<>, Law> world(1, moreau::Materials<Law>(1, Law()));
#endif  // attraction_that_is_not_const

#ifdef friction_that_is_not_const
// A friction that is not const.
// expect: friction\(\) of Law must be const
#include "moreau/law/cohesive.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

struct Law : moreau::SignoriniCoulomb<> {
  double friction() EITHER(, const) { return 0.5; }
};
const moreau::Simulation<moreau::Ball<>, Law> world(1, moreau::Materials<Law>(1, Law()));
#endif  // friction_that_is_not_const

#ifdef variant_that_is_not_const
// Variants that are not const: the law would have one.
// expect: Law has variant\(\), but is no StatefulLaw
#include "moreau/law/cohesive.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

struct Law : moreau::SignoriniCoulomb<> {
  static constexpr std::size_t variants = 2;
  Law variant(std::size_t) EITHER(, const) { return *this; }
  std::size_t variant_after(std::size_t, const Eigen::Vector3d&) const { return 0; }
};
const moreau::Simulation<moreau::Ball<>, Law> world(1, moreau::Materials<Law>(1, Law()));
#endif  // variant_that_is_not_const

#ifdef theta_that_is_not_const
// A theta that is not const: springs, bonds and cells would take 1/2.
// expect: theta\(\) of Integrator must be const
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/motion/moreau_jean.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

struct Late : moreau::MoreauJean {
  double theta() EITHER(, const) { return 1; }
};
const moreau::Simulation<moreau::Ball<>, moreau::SignoriniCoulomb<>, Late> world(
    1, moreau::Materials<moreau::SignoriniCoulomb<>>(1, moreau::SignoriniCoulomb<>(0.4)));
#endif  // theta_that_is_not_const

#ifdef restitution_that_is_not_const
// A restitution that is not const: the springs would take it for 0.
// expect: restitution\(\) of Law must be const
#include "moreau/law/compliant.hpp"

struct Law : moreau::SignoriniCoulomb<> {
  double restitution() EITHER(, const) { return 0.5; }
};
const moreau::Compliant<Law> soft(Law(), 1e6);
#endif  // restitution_that_is_not_const

#ifdef cohesive_bridges
// Bridges, and an attraction at every contact beside them.
// expect: Cohesive<Law>: Law has an attraction of its own
// and no other error
#include "moreau/law/bridges.hpp"
#include "moreau/law/cohesive.hpp"

using Wet = moreau::Bridged<moreau::CapillaryBridge<>>;
using Law = moreau::Cohesive<EITHER(Wet, moreau::SignoriniCoulomb<>)>;
void use(const Law& law) {
  (void)law.adhesion();
}
#endif  // cohesive_bridges

#ifdef bridges_twice
// Bridges of two kinds.
// expect: Bridged<Bridge, Law>: Law has an attraction of its own
// and no other error
#include "moreau/law/bridges.hpp"

using Wet = moreau::Bridged<moreau::LinearCohesion<>>;
using Law = moreau::Bridged<moreau::CapillaryBridge<>, EITHER(Wet, moreau::SignoriniCoulomb<>)>;
void use(const Law& law) {
  (void)law.reach();
}
#endif  // bridges_twice

#ifdef bonds_around_a_law
// Bonded is no wrapper: it has friction and rolling resistance of its own.
// expect: (constraint failure for.*Bonded|constraints not satisfied for class template 'Bonded')
#include "moreau/law/bonded.hpp"
#include "moreau/law/frictionless.hpp"

using Law = moreau::Bonded<EITHER(moreau::Frictionless<>, double)>;
void use(const Law& law) {
  (void)law.strength();
}
#endif  // bonds_around_a_law

#ifdef cohesive_forces
// A constant attraction beside a law for forces.
// expect: Cohesive<Law>: Law gives no impulses \(velocity_offset\)
// and no other error
#include "moreau/law/cohesive.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/signorini_coulomb.hpp"

using Law = moreau::Cohesive<EITHER(moreau::LinearSpringDashpot<>, moreau::SignoriniCoulomb<>)>;
void use(const Law& law) {
  (void)law.adhesion();
}
#endif  // cohesive_forces

#ifdef bridged_forces
// Bridges beside a law for forces.
// expect: Bridged<Bridge, Law>: Law gives no impulses \(velocity_offset\)
// and no other error
#include "moreau/law/bridges.hpp"
#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/signorini_coulomb.hpp"

using Law = moreau::Bridged<moreau::CapillaryBridge<>,
                            EITHER(moreau::HertzMindlin<>, moreau::SignoriniCoulomb<>)>;
void use(const Law& law) {
  (void)law.reach();
}
#endif  // bridged_forces

#ifdef compliant_forces
// Springs in series with a law for forces, which has springs of its own.
// expect: Compliant<Law>: Law gives no impulses \(velocity_offset\)
// and no other error
#include "moreau/law/compliant.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/signorini_coulomb.hpp"

using Law = moreau::Compliant<EITHER(moreau::LinearSpringDashpot<>, moreau::SignoriniCoulomb<>)>;
void use(const Law& law) {
  (void)law.stiffness();
}
#endif  // compliant_forces

#ifdef springs_twice
// Springs in series with springs.
// expect: Compliant<Law>: Law has springs of its own
// and no other error
#include "moreau/law/compliant.hpp"

using Law = moreau::Compliant<EITHER(moreau::Compliant<>, moreau::SignoriniCoulomb<>)>;
void use(const Law& law) {
  (void)law.stiffness();
}
#endif  // springs_twice

#ifdef cohesion_around_springs
// Springs inside of an attraction.
// expect: Cohesive<Law>: Law has springs; they go outside: Compliant<Cohesive<..>>
// and no other error
#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"

using Law = EITHER(moreau::Cohesive<moreau::Compliant<>>, moreau::Compliant<moreau::Cohesive<>>);
void use(const Law& law) {
  (void)law.adhesion();
}
#endif  // cohesion_around_springs

#ifdef bridges_around_springs
// Springs inside of bridges.
// expect: Bridged<Bridge, Law>: Law has springs; they go outside: Compliant<Bridged<..>>
// and no other error
#include "moreau/law/bridges.hpp"
#include "moreau/law/compliant.hpp"

using Water = moreau::CapillaryBridge<>;
using Wrong = moreau::Bridged<Water, moreau::Compliant<>>;
using Law = EITHER(Wrong, moreau::Compliant<moreau::Bridged<Water>>);
void use(const Law& law) {
  (void)law.reach();
}
#endif  // bridges_around_springs

#ifdef bridges_of_another_scalar
// Bridges in single precision of a law in double precision. Without the message the pairs would have no bridges.
// expect: Bridged<Bridge, Law>: Law gives no impulses \(velocity_offset\) in the scalar of Bridge
// and no other error
#include "moreau/law/bridges.hpp"

using Water = moreau::CapillaryBridge<EITHER(float, double)>;
using Law = moreau::Bridged<Water, moreau::SignoriniCoulomb<double>>;
void use(const Law& law) {
  (void)law.reach();
}
#endif  // bridges_of_another_scalar

#ifdef law_in_place_of_a_bridge
// The law of the push before its bridge.
// expect: Bridged<Bridge, Law>: Bridge must be CapillaryBridge, LinearCohesion or a class with their functions
// and no other error
#include "moreau/law/bridges.hpp"

using Water = moreau::CapillaryBridge<>;
using Coulomb = moreau::SignoriniCoulomb<>;
using Wrong = moreau::Bridged<Coulomb, Water>;
using Law = EITHER(Wrong, moreau::Bridged<Water>);
void use(const Law& law) {
  (void)sizeof(law);
}
#endif  // law_in_place_of_a_bridge

#ifdef volume_in_place_of_a_bridge
// The volume of the liquid in place of a bridge.
// expect: Bridged<Bridge, Law>: Bridge must be CapillaryBridge, LinearCohesion or a class with their functions
// and no other error
#include "moreau/law/bridges.hpp"

using Bridge = EITHER(double, moreau::CapillaryBridge<>);
const moreau::Bridged<Bridge> law(Bridge(1e-9));
#endif  // volume_in_place_of_a_bridge

#ifdef cohesion_of_another_scalar
// An attraction in single precision of a law in double precision.
// expect: Cohesive<Law>: Law gives no impulses \(velocity_offset\) in the scalar of Cohesive
// and no other error
#include "moreau/law/cohesive.hpp"

using Law = moreau::Cohesive<moreau::SignoriniCoulomb<double>, EITHER(float, double)>;
void use(const Law& law) {
  (void)law.adhesion();
}
#endif  // cohesion_of_another_scalar

#ifdef springs_of_another_scalar
// Springs in single precision of bonds in double precision.
// expect: Compliant<Law>: Law gives no impulses \(velocity_offset\) in the scalar of Compliant
// and no other error
#include "moreau/law/bonded.hpp"
#include "moreau/law/compliant.hpp"

using Law = moreau::Compliant<moreau::Bonded<double>, EITHER(float, double)>;
void use(const Law& law) {
  (void)law.stiffness();
}
#endif  // springs_of_another_scalar

#ifdef springs_cohesion_and_tangential_restitution
// Springs in series with a law that has an attraction and a tangential restitution.
// expect: Compliant<TangentialRestitution> would have two tangential restitutions
#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/tangential_restitution.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

using Push = EITHER(moreau::TangentialRestitution<>, moreau::SignoriniCoulomb<>);
using Law = moreau::Compliant<moreau::Cohesive<Push>>;
using World = moreau::Simulation<moreau::Ball<>, Law>;
World start(const Law& law) {
  return World(1, moreau::Materials<Law>(1, law));
}
#endif  // springs_cohesion_and_tangential_restitution

#ifdef springs_bridges_and_tangential_restitution
// Springs in series with a law that has bridges and a tangential restitution.
// expect: Compliant<TangentialRestitution> would have two tangential restitutions
#include "moreau/law/bridges.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/tangential_restitution.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

using Push = EITHER(moreau::TangentialRestitution<>, moreau::SignoriniCoulomb<>);
using Law = moreau::Compliant<moreau::Bridged<moreau::CapillaryBridge<>, Push>>;
using World = moreau::Simulation<moreau::Ball<>, Law>;
World start(const Law& law) {
  return World(1, moreau::Materials<Law>(1, law));
}
#endif  // springs_bridges_and_tangential_restitution

#ifdef bonds_of_a_law_without
// Pairs that touch are bonded under a law without bonds.
// expect: Simulation: the law has no bonds
// and no other error
#include "moreau/law/bonded.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

using Law = EITHER(moreau::SignoriniCoulomb<>, moreau::Bonded<>);
void glue(moreau::Simulation<moreau::Ball<>, Law>& simulation) {
  simulation.bond_touching(1e-5);
}
#endif  // bonds_of_a_law_without

#ifdef shape_without_mass
// A simulation of a shape without mass properties. The message names the missing expression.
// expect: shape.mass_properties\(density\)
#include "moreau/shape/ball.hpp"

struct Bubble {
  using Space = moreau::Space<3>;
  moreau::Aabb<Space> bounding_box(const moreau::Pose<Space>& pose) const;
#ifdef MOREAU_CORRECTED
  moreau::MassProperties<Space> mass_properties(double density) const;
#endif
};

template <moreau::Shape T>
struct Grain {};

Grain<Bubble> grain;
#endif  // shape_without_mass

#ifdef sphere_is_no_polytope
// A ball is given as template argument where a polytope is required.
// expect: shape.vertices\(\)
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polyhedron.hpp"

template <moreau::Polytope T>
struct Clipped {};

Clipped<EITHER(moreau::Ball<double>, moreau::Polyhedron<double>)> clipped;
#endif  // sphere_is_no_polytope

#ifdef support_leaks_expression
// A support function with the return type auto: it returns an Eigen expression of its argument.
// expect: shape.support\(direction\)
#include "moreau/shape/ball.hpp"

struct Ball : moreau::Ball<double> {
  EITHER(auto, Vector) support(const Vector& direction) const { return 2 * direction; }
};

template <moreau::ConvexShape T>
struct Grain {};

Grain<Ball> grain;
#endif  // support_leaks_expression

#ifdef simulation_of_leaking_support
// The mistake of support_leaks_expression, in a simulation.
// expect: shape.support\(direction\)
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

struct Ball : moreau::Ball<double> {
  EITHER(auto, Vector) support(const Vector& direction) const { return 2 * direction; }
};

using Simulation = moreau::Simulation<Ball, moreau::SignoriniCoulomb<double>>;
Simulation* simulation;
#endif  // simulation_of_leaking_support

#ifdef compound_in_a_one_of
// Grains that are a ball or a compound. A compound of parts that are balls or polyhedra can be both.
// expect: shape.support\(direction\)
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/compound.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/world/simulation.hpp"

using moreau::Ball, moreau::Compound, moreau::OneOf, moreau::Polyhedron;
using Wrong = OneOf<Ball<>, Compound<Polyhedron<>>>;
using Right = Compound<OneOf<Ball<>, Polyhedron<>>>;

using Simulation = moreau::Simulation<EITHER(Wrong, Right), moreau::SignoriniCoulomb<double>>;
Simulation* simulation;
#endif  // compound_in_a_one_of

#ifdef broad_phase_of_another_space
// A broad phase for the plane in a simulation of balls in space.
// expect: Broad is no BroadPhase in the space of the shape
// and no other error
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

using Broad = moreau::SweepAndPrune<moreau::Space<EITHER(2, 3)>>;

using Law = moreau::SignoriniCoulomb<double>;
moreau::Simulation<moreau::Ball<>, Law, moreau::MoreauJean, Broad> simulation(
    0.01, moreau::Materials<Law>(1));
#endif  // broad_phase_of_another_space

#ifdef law_of_another_dimension
// A law for the plane in a simulation in space. The message names the call that is not valid.
// expect: law.solve\(block, vector, vector\)
#include "moreau/law/concepts.hpp"

using S = moreau::Space<EITHER(2, 3)>;

struct Frictionless {
  double velocity_offset(double gap, double before, double step) const;
  S::Vector solve(const moreau::LocalBlock<S>& block, const S::Vector& b,
                  const S::Vector& guess) const;
  S::Vector natural_map(const S::Vector& velocity, const S::Vector& impulse) const;
};

template <class Law>
requires moreau::SetValuedLaw<Law, moreau::Space<3>>
struct Contacts {
};

Contacts<Frictionless> contacts;
#endif  // law_of_another_dimension

#ifdef law_of_another_scalar
// A law in single precision for grains in double precision.
// expect: Law offers neither the functions velocity_offset, solve and natural_map
// and no other error
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

using Law = moreau::SignoriniCoulomb<EITHER(float, double)>;
moreau::Simulation<moreau::Ball<double>, Law> simulation(0.01, moreau::Materials<Law>(1));
#endif  // law_of_another_scalar

#ifdef share_of_another_scalar
// A function of an optional concept with another type: the law would do without it.
// expect: Law has tangential_share\(\), but is no TangentialRestitutionLaw
// and no other error
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

struct Springy : moreau::SignoriniCoulomb<> {
  EITHER(float, double) tangential_share(double, double) const { return 0; }
};
const moreau::Simulation<moreau::Ball<>, Springy> simulation(0.01,
                                                             moreau::Materials<Springy>(1,
                                                                                        Springy()));
#endif  // share_of_another_scalar

#ifdef memory_of_another_type
// The memory of a law in another type: the law would do without it.
// expect: Law has variant\(\), but is no StatefulLaw
// and no other error
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

struct Aged : moreau::SignoriniCoulomb<> {
  static constexpr std::size_t variants = 2;
  Aged variant(std::size_t) const { return *this; }
  EITHER(int, std::size_t) variant_after(std::size_t, const moreau::Space<3>::Vector&) const {
    return 1;
  }
};
const moreau::Simulation<moreau::Ball<>, Aged> simulation(0.01, moreau::Materials<Aged>(1, Aged()));
#endif  // memory_of_another_type

#ifdef forces_under_moreau_jean
// A regularized law with an integrator of impulses.
// expect: a regularized law gives forces, which an integrator of impulses such as MoreauJean
// and no other error
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

using Integrator = EITHER(moreau::MoreauJean, moreau::VelocityVerlet);
using Law = moreau::LinearSpringDashpot<double>;
moreau::Simulation<moreau::Ball<double>, Law, Integrator> simulation(0.01,
                                                                     moreau::Materials<Law>(1));
#endif  // forces_under_moreau_jean

#ifdef impulses_under_verlet
// A set-valued law with an integrator of forces.
// expect: a set-valued law gives impulses, which an integrator of forces such as VelocityVerlet
// and no other error
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

using Integrator = EITHER(moreau::VelocityVerlet, moreau::MoreauJean);
using Law = moreau::SignoriniCoulomb<double>;
moreau::Simulation<moreau::Ball<double>, Law, Integrator> simulation(0.01,
                                                                     moreau::Materials<Law>(1));
#endif  // impulses_under_verlet

#ifdef springs_with_a_solver
// A regularized law, for which there is nothing to solve, with a contact solver.
// expect: a regularized law leaves nothing to solve
// and no other error
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

using Solver = EITHER(moreau::NonlinearGaussSeidel, moreau::NoSolver);
using Law = moreau::LinearSpringDashpot<double>;
using Plane = moreau::Space<2>;
moreau::Simulation<moreau::Disk<>, Law, moreau::VelocityVerlet, moreau::SweepAndPrune<Plane>,
                   Solver>
    simulation(0.01, moreau::Materials<Law>(1));
#endif  // springs_with_a_solver

#ifdef impulses_without_solver
// A set-valued law without a contact solver.
// expect: Solver cannot take this set-valued law
// and no other error
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

using Solver = EITHER(moreau::NoSolver, moreau::NonlinearGaussSeidel);
using Law = moreau::SignoriniCoulomb<double>;
using Plane = moreau::Space<2>;
moreau::Simulation<moreau::Disk<>, Law, moreau::MoreauJean, moreau::SweepAndPrune<Plane>, Solver>
    simulation(0.01, moreau::Materials<Law>(1));
#endif  // impulses_without_solver

#ifdef number_for_a_law
// The friction in place of the law.
// expect: a number in place of the law; write moreau::SignoriniCoulomb<>\(0.4\), not 0.4
// and no other error
#include "moreau/moreau.hpp"

moreau::Simulation<moreau::Ball<double>, moreau::SignoriniCoulomb<double>> world(
    0.02, EITHER(0.4, moreau::SignoriniCoulomb<double>(0.4)));
#endif  // number_for_a_law

#ifdef mesh_wall_of_a_shape_without
// A mesh wall in a simulation of grains that cannot touch one.
// expect: grains of this shape cannot touch a mesh wall
// and no other error
#include "moreau/moreau.hpp"
#include "moreau/shape/cylinder.hpp"

using Shape = EITHER(moreau::Cylinder<double>, moreau::Ball<double>);

void add(moreau::Simulation<Shape, moreau::SignoriniCoulomb<double>>& world,
         const moreau::FacetMesh<moreau::Space<3>>& mesh) {
  world.add_mesh_wall(mesh);
}
#endif  // mesh_wall_of_a_shape_without

#ifdef apply_that_is_forgotten
// Drives, servos, sources and sinks act in apply() alone: without a call they are unused variables, of which -Wall warns.
// expect: unused variable .*source
// expect: unused variable .*shake
// expect: unused variable .*lid
#include "moreau/boundary/drive.hpp"
#include "moreau/boundary/servo.hpp"
#include "moreau/boundary/source.hpp"
#include "moreau/moreau.hpp"

#pragma GCC diagnostic error "-Wunused-variable"

using World = moreau::Simulation<moreau::Ball<double>, moreau::SignoriniCoulomb<double>>;

void run(World& world, moreau::BodyId wall, const moreau::SourceOptions<World::S>& options) {
  moreau::Source<World::S> source(options);
  const moreau::VelocityDrive shake(wall, World::Vector(1, 0, 0), [](double t) { return t; });
  const moreau::PressureServo lid(wall, 1e4, 1e-4, 0.1, [] { return 1.0; });
#ifdef MOREAU_CORRECTED
  source.apply(world, 1e-3), shake.apply(world, 1e-3), lid.apply(world, 1e-3);
#endif
}
#endif  // apply_that_is_forgotten
