// SPDX-License-Identifier: MIT
// Grains that rain into basins whose floors have crests, valleys and tips: a basin keeps all of them.
#include <cmath>
#include <cstdint>
#include <doctest/doctest.h>
#include <numbers>
#include <random>
#include <vector>

#include "moreau/moreau.hpp"
#include "moreau/sample/random_rotation.hpp"

#include "detect/mesh_surfaces.hpp"
#include "world/mesh_floor.hpp"

namespace {

using namespace moreau;
using Law = SignoriniCoulomb<double>;

template <class ShapeT>
std::vector<ShapeT> shapes() {
  return mesh_surfaces::grains<ShapeT>();
}
template <>
std::vector<Rounded<Polyhedron<>>> shapes() {
  std::vector<Rounded<Polyhedron<>>> list;
  for (const auto& core : mesh_surfaces::grains<Polyhedron<>>()) list.emplace_back(core, 0.001);
  return list;
}
/// Waves of 5 cm and 6 mm, facets of a cell, in a bowl.
template <class S>
FacetMesh<S> basin(double cell) {
  const auto height = [](const auto& x) {
    const double k = 2 * std::numbers::pi / 0.05;
    const double wave = 0.006 * std::sin(k * x[0]);
    return wave * (S::dim == 3 ? std::cos(k * x[1]) : 1) + 0.4 * x.squaredNorm();
  };
  return mesh_floor::floor_of(S{}, 0.3, int(std::lround(0.6 / cell)), height);
}

/// @returns number of grains that left the basin in 0.6 s
template <class ShapeT>
int lost(std::uint64_t seed, double cell, WallSides sides = WallSides::outside) {
  using S = SpaceOf<ShapeT>;
  Simulation<ShapeT, Law> simulation(0.02, Materials<Law>(1, Law(0.3)));
  simulation.set_gravity(-9.81 * S::Vector::Unit(S::dim - 1));
  simulation.add_mesh_wall(basin<S>(cell), {}, sides);
  std::vector<ShapeId> list;
  for (const auto& shape : shapes<ShapeT>()) list.push_back(simulation.add_shape(shape));
  std::mt19937_64 random(seed);
  for (int k = 0; k < (S::dim == 3 ? 4 : 8); ++k)
    for (int i = -3; i <= 3; ++i)
      for (int j = (S::dim == 3 ? -3 : 0); j <= (S::dim == 3 ? 3 : 0); ++j) {
        typename S::Vector at = S::Vector::Constant(0.04 * j);
        at[0] = 0.04 * i;
        at[S::dim - 1] = 0.06 + 0.04 * k;
        simulation.add_grain(list[random() % list.size()], {at, random_rotation<S>(random)}, 2700);
      }
  for (int step = 0; step < 600; ++step) simulation.step(1e-3);
  int count = 0;
  for (const BodyId grain : simulation.grains()) {
    const typename S::Vector at = simulation.pose(grain).position;
    const double height = at[S::dim - 1], aside = at.template head<S::dim - 1>().norm();
    count += !(height > -0.006 && height < 0.4 && aside < 0.25);
  }
  return count;
}

}  // namespace

TEST_CASE("hulls that rain into basins with wavy floors stay in them") {
  for (std::uint64_t seed = 40; seed < 52; ++seed) {
    CAPTURE(seed);
    CHECK(lost<Polyhedron<>>(seed, 0.01) == 0);
  }
}

TEST_CASE_TEMPLATE("grains of other shapes that rain into basins stay in them", ShapeT,
                   Rounded<Polyhedron<>>, Polygon<>) {
  for (std::uint64_t seed = 40; seed < (SpaceOf<ShapeT>::dim == 2 ? 70 : 44); ++seed) {
    CAPTURE(seed);
    CHECK(lost<ShapeT>(seed, seed % 2 != 0 ? 0.01 : 0.005) == 0);
  }
}
