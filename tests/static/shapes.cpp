// SPDX-License-Identifier: MIT
// Which shape models which concept, for both dimensions and scalars.
#include "moreau/shape/ball.hpp"
#include "moreau/shape/compound.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/half_space.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

#include "static/archetypes.hpp"

namespace {

using moreau::ConvexShape;
using moreau::Polytope;
using moreau::Shape;

static_assert(ConvexShape<moreau::Disk<double>> && ConvexShape<moreau::Disk<float>>);
static_assert(ConvexShape<moreau::Ball<double>> && ConvexShape<moreau::Ball<float>>);
static_assert(!Polytope<moreau::Disk<double>> && !Polytope<moreau::Ball<double>>);

static_assert(Polytope<moreau::Polygon<double>> && Polytope<moreau::Polygon<float>>);
static_assert(Polytope<moreau::Polyhedron<double>> && Polytope<moreau::Polyhedron<float>>);

// A wall has no mass and no bounding box, so it is not a Shape.
static_assert(!Shape<moreau::HalfSpace<moreau::Space<2>>>);
static_assert(!Shape<moreau::HalfSpace<moreau::Space<3>>>);
static_assert(!Shape<int>);

static_assert(Shape<archetypes::Minimal<moreau::Space<2>>> &&
              !ConvexShape<archetypes::Minimal<moreau::Space<2>>>);
static_assert(Shape<archetypes::Minimal<moreau::Space<3, float>>>);
static_assert(ConvexShape<archetypes::MinimalConvex<moreau::Space<2>>>);
static_assert(ConvexShape<archetypes::MinimalConvex<moreau::Space<3>>>);
static_assert(!Polytope<archetypes::MinimalConvex<moreau::Space<3>>>);

// A simulation takes convex shapes, and compounds of convex shapes.
using moreau::Compound;
using moreau::CompoundShape;
using moreau::GrainShape;
static_assert(GrainShape<moreau::Ball<>> && !CompoundShape<moreau::Ball<>>);
static_assert(GrainShape<archetypes::MinimalConvex<moreau::Space<3>>>);
static_assert(!GrainShape<archetypes::Minimal<moreau::Space<2>>>);
static_assert(GrainShape<Compound<moreau::Polyhedron<>>> &&
              CompoundShape<Compound<moreau::Polyhedron<>>> &&
              !ConvexShape<Compound<moreau::Polyhedron<>>>);
static_assert(std::same_as<moreau::PartOf<Compound<moreau::Disk<>>>, moreau::Disk<>> &&
              std::same_as<moreau::PartOf<moreau::Disk<>>, moreau::Disk<>>);
static_assert(Shape<moreau::OneOf<moreau::Ball<>, Compound<moreau::Ball<>>>> &&
              !GrainShape<moreau::OneOf<moreau::Ball<>, Compound<moreau::Ball<>>>>);

/// Returns an Eigen expression, which refers to an object that may no longer exist when it is
/// evaluated.
template <class S>
struct LeaksExpression : archetypes::Minimal<S> {
  auto support(const typename S::Vector& direction) const { return 2 * direction; }
};
static_assert(!ConvexShape<LeaksExpression<moreau::Space<3>>>);

/// A support function that changes the shape.
template <class S>
struct SupportNotConst : archetypes::Minimal<S> {
  typename S::Vector support(const typename S::Vector& direction);
};
static_assert(!ConvexShape<SupportNotConst<moreau::Space<3>>>);

/// A shape in the plane with a bounding box in space.
struct MixedSpaces {
  using Space = moreau::Space<2>;
  moreau::MassProperties<moreau::Space<2>> mass_properties(double density) const;
  moreau::Aabb<moreau::Space<3>> bounding_box(const moreau::Pose<moreau::Space<2>>& pose) const;
};
static_assert(!Shape<MixedSpaces>);

// The space of a shape is a member type of the shape.
static_assert(std::same_as<moreau::SpaceOf<moreau::Disk<float>>, moreau::Space<2, float>>);
static_assert(std::same_as<moreau::SpaceOf<moreau::Polyhedron<double>>, moreau::Space<3>>);

}  // namespace
