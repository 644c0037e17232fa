// SPDX-License-Identifier: MIT
// Rows of bonded grains, for tests.
#pragma once

#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <type_traits>
#include <utility>
#include <vector>

#include "moreau/law/bonded.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

#include "types.hpp"

namespace bonded {

using namespace moreau;

constexpr double radius = 0.01, tension = 20, shear = 12, bending = 8, friction = 0.4;
constexpr double stiffness = 1e6, tangential = 5e5;

template <class Law>
struct Make {
  using T = decltype(std::declval<Law>().friction());
  /// @param scale of the strengths [-]
  static Law law(double energy = 0, double scale = 1) {
    const BondStrength<T> strength{T(scale * tension), T(scale * shear), T(scale * bending),
                                   T(energy)};
    if constexpr (std::is_same_v<Law, Bonded<T>>)
      return Law(strength, T(friction));
    else
      return Law(Bonded<T>(strength, T(friction)), T(stiffness), T(tangential));
  }
};

inline ColouredGaussSeidel tight(bool is_float) {
  ColouredOptions options;
  options.tolerance = is_float ? 1e-5 : 1e-11;
  options.max_sweeps = 5000;
  return ColouredGaussSeidel(options);
}

/// Whether two numbers differ by less than a share of the second one.
inline bool agree(double found, double expected, double share) {
  return std::abs(found - expected) <= share * std::abs(expected);
}

/// Grains in a row, from the origin along x; neighbours touch and are bonded, the first one is fixed.
template <class ShapeT, class Law>
struct Row {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Angular = typename S::Angular;
  static constexpr bool is_compliant = CompliantLaw<Law, S>;

  Simulation<ShapeT, Law> world;
  std::vector<BodyId> grains;
  /// Of the bonds [m].
  double effective = radius / 2;

  explicit Row(std::size_t count, double energy = 0, double density = 1000, double scale = 1)
      : world(T(2 * radius), Materials<Law>(1, Make<Law>::law(energy, scale)),
              tight(std::is_same_v<T, float>)) {
    ShapeId shape;
    if constexpr (requires(const ShapeT& s) { s.vertices(); })
      shape = world.add_shape(cuboid<ShapeT>(Vector(Vector::Constant(T(radius)))));
    else
      shape = world.add_shape(ShapeT(T(radius)));
    for (std::size_t k = 0; k < count; ++k)
      grains.push_back(world.add_grain(
          shape, Pose<S>(Vector(T(2 * radius * double(k)) * Vector::UnitX())), T(density)));
    world.prescribe_motion(grains[0]);
    CHECK(world.bond_touching(T(1e-5)) == count - 1);
  }
  BodyId last() const { return grains.back(); }
  /// The last component of an angular quantity: about z.
  static Angular about_z(double torque) {
    Angular turn = Angular::Zero();
    turn[S::angular_dim - 1] = T(torque);
    return turn;
  }
  void load(double along, double aside, double about) {
    Vector force = Vector::Zero();
    force[0] = T(along), force[1] = T(aside);
    world.set_force(last(), force);
    world.set_torque(last(), about_z(about));
  }
};

template <class ShapeT, class Law>
struct Case {
  using Shape = ShapeT;
  using LawOf = Law;
};
using Rigid = Bonded<double>;
using Soft = Compliant<Bonded<double>>;
using Circle = BallIn<Space<2>>;
using Globe = BallIn<Space<3>>;

}  // namespace bonded

#define BOND_TYPES                                                                               \
  MOREAU_TYPES(                                                                                  \
      (Case<Circle, Rigid>, Case<Globe, Soft>),                                                  \
      (Case<Circle, Soft>, Case<Globe, Rigid>, Case<Polygon<>, Rigid>, Case<Polyhedron<>, Soft>, \
       Case<Polyhedron<>, Rigid>, Case<BallIn<Space<2, float>>, Bonded<float>>))
