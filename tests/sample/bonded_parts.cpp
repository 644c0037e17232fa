// SPDX-License-Identifier: MIT
// Stones of bonded parts: which parts get a bond.
#include "moreau/sample/bonded_parts.hpp"

#include <cstddef>
#include <doctest/doctest.h>
#include <vector>

#include "moreau/law/bonded.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/compound.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

#include "types.hpp"

using namespace moreau;

namespace {

/// Equal squares or cubes of the edge 2, `count` along each axis: those beside each other have a common face.
template <class Part>
std::vector<typename Compound<Part>::Part> blocks(const Part& block, int count) {
  using S = SpaceOf<Part>;
  std::vector<typename Compound<Part>::Part> parts;
  int all = 1;
  for (int k = 0; k < S::dim; ++k) all *= count;
  for (int number = 0; number < all; ++number) {
    typename S::Vector x;
    for (int k = 0, rest = number; k < S::dim; ++k, rest /= count)
      x[k] = typename S::Scalar(2 * (rest % count));
    parts.push_back({block, Pose<S>(x)});
  }
  return parts;
}

template <class Part>
std::size_t bonds_of(const Compound<Part>& stone, const Pose<SpaceOf<Part>>& pose) {
  using T = typename SpaceOf<Part>::Scalar;
  using Law = Bonded<T>;
  Simulation<Part, Law> world(T(2), Law(BondStrength<T>{1, 1, 1, 1}, T(0.5)));
  add_bonded_parts(world, stone, pose, T(2700), MaterialId(0), T(1e-4));
  return world.bonds().size();
}

}  // namespace

TEST_CASE_TEMPLATE("parts that touch at an edge or a corner alone get no bond", Part,
                   MOREAU_TYPES((Polygon<>, Polyhedron<>), (Polygon<float>, Polyhedron<float>))) {
  using S = SpaceOf<Part>;
  using T = typename S::Scalar;
  const Part block = cuboid<Part>(S::Vector::Constant(T(1)));
  for (const int count : {2, 3}) {
    std::size_t faces = std::size_t(S::dim * (count - 1));
    for (int k = 1; k < S::dim; ++k) faces *= std::size_t(count);
    const Compound<Part> stone{blocks(block, count)};
    CHECK(bonds_of(stone, Pose<S>()) == faces);
    const Pose<S> turned(typename S::Vector(S::Vector::Constant(T(1))),
                         S::exp(S::Angular::Constant(T(0.7))));
    CHECK(bonds_of(stone, turned) == faces);
  }
}

TEST_CASE("parts whose common faces differ, and round parts, are bonded") {
  using Plane = Space<2>;
  using Volume = Space<3>;
  // A brick on two, of which it covers a half each, or a hundredth of the one and the rest of the other.
  for (const double share : {0.5, 0.01}) {
    const auto brick = cuboid<Polygon<>>(Plane::Vector(1, 1));
    const Compound<Polygon<>> wall({{brick, Pose<Plane>(Plane::Vector(-1, 0))},
                                    {brick, Pose<Plane>(Plane::Vector(1, 0))},
                                    {brick, Pose<Plane>(Plane::Vector(1 - 2 * share, 2))}});
    CHECK(bonds_of(wall, {}) == 3);
    const auto stone = cuboid<Polyhedron<>>(Volume::Vector(1, 1, 1));
    const Compound<Polyhedron<>> pile(
        {{stone, {}}, {stone, Pose<Volume>(Volume::Vector(2 - 2 * share, 2 - 2 * share, 2))}});
    CHECK(bonds_of(pile, {}) == 1);
  }
  const Compound<Ball<>> dumbbell(
      {{Ball<>(1), {}}, {Ball<>(1), Pose<Volume>(Volume::Vector(2, 0, 0))}});
  CHECK(bonds_of(dumbbell, {}) == 1);
}
