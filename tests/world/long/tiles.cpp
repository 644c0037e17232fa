// SPDX-License-Identifier: MIT
// Grains of all kinds slide over floors of flush tiles, in double and single precision.
#include "world/tiles.hpp"

#include <doctest/doctest.h>

#include "moreau/shape/ball.hpp"
#include "moreau/shape/capsule.hpp"
#include "moreau/shape/one_of.hpp"

#include "instances/compound.hpp"
#include "world/assemblies.hpp"

using namespace moreau;

namespace {

template <class ShapeT>
using WorldOf = Simulation<ShapeT, SignoriniCoulomb<typename SpaceOf<ShapeT>::Scalar>>;

}  // namespace

TEST_CASE("single precision: polyhedra and polygons slide over floors of tiles") {
  using P = Polyhedron<float>;
  tiles::check_directions<scenes::World<P>, P>(tiles::polytopes<P, P>(), 100, 1e-6);
  using Q = Polygon<float>;
  tiles::check_directions<scenes::World<Q>, Q>(tiles::polytopes<Q, Q>(), 40, 1e-6);
}

TEST_CASE("balls, capsules and polyhedra slide over floors of tiles") {
  using P = Polyhedron<>;
  using Any = OneOf<Ball<>, Capsule<>, P>;
  std::vector<tiles::Slider<Any>> sliders = tiles::polytopes<Any, P>();
  for (int k = 0; k < 4; ++k) {
    sliders.push_back({"ball", Ball<>(0.01), 0.01});
    sliders.push_back({"capsule", Capsule<>(0.01, 0.006), 0.006});
  }
  tiles::check_directions<WorldOf<Any>, P>(sliders, 100, 1e-5);
}

TEST_CASE("disks, stadia and polygons slide over blocks") {
  using P = Polygon<>;
  using Any = OneOf<Disk<>, Stadium<>, P>;
  std::vector<tiles::Slider<Any>> sliders = tiles::polytopes<Any, P>();
  sliders.push_back({"disk", Disk<>(0.01), 0.01});
  sliders.push_back({"stadium", Stadium<>(0.01, 0.006), 0.006});
  tiles::check_directions<WorldOf<Any>, P>(sliders, 80, 1e-5);
}

TEST_CASE("compound grains slide over floors of tiles") {
  using P = Polyhedron<>;
  using C = Compound<P>;
  std::vector<tiles::Slider<C>> sliders = tiles::polytopes<C, P>();
  const P half = tiles::box<P>(0.01, 0.02, 0.02), cube = tiles::box<P>(0.02, 0.02, 0.02);
  std::vector<C::Part> two, four;
  for (const double x : {-0.005, 0.005}) two.push_back({half, {{x, 0, 0}}});
  for (const double x : {-0.01, 0.01})
    for (const double y : {-0.01, 0.01}) four.push_back({cube, {{x, y, 0}}});
  for (int k = 0; k < 3; ++k) {
    sliders.push_back({"two halves", C(two), 0.01});
    sliders.push_back({"four cubes", C(four), 0.01});
  }
  tiles::check_directions<WorldOf<C>, P>(sliders, 100, 1e-6);
}
