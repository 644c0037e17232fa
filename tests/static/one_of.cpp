// SPDX-License-Identifier: MIT
// Which types are a OneOf, and for which lists of shapes there is no OneOf.
#include "moreau/shape/one_of.hpp"

#include "moreau/shape/ball.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace {

using moreau::OneOf;
using moreau::Space;

using Mixed = OneOf<moreau::Ball<double>, moreau::Polyhedron<double>>;
static_assert(moreau::ConvexShape<Mixed> && !moreau::Polytope<Mixed>);
static_assert(std::convertible_to<moreau::Ball<double>, Mixed>);
static_assert(!std::convertible_to<moreau::Ball<float>, Mixed>);

/// A shape with a mass and a bounding box that is not convex.
struct Minimal {
  using Space = moreau::Space<3>;
  moreau::MassProperties<Space> mass_properties(double density) const;
  moreau::Aabb<Space> bounding_box(const moreau::Pose<Space>& pose) const;
};
using WithMinimal = OneOf<moreau::Ball<double>, Minimal>;
static_assert(moreau::Shape<WithMinimal> && !moreau::ConvexShape<WithMinimal>);

template <class... Shapes>
concept CanBeMixed = requires {
  typename OneOf<Shapes...>;
};
static_assert(!CanBeMixed<moreau::Ball<double>, moreau::Disk<double>>);
static_assert(!CanBeMixed<moreau::Ball<double>, moreau::Ball<float>>);
static_assert(!CanBeMixed<>);

}  // namespace
