// SPDX-License-Identifier: MIT
// The number of threads has no influence on the results, under any law and for any shape.
#include <cmath>
#include <doctest/doctest.h>
#include <vector>

#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/frictionless.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/capsule.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

#include "threads/same_bits.hpp"

using namespace threads_test;

TEST_CASE_TEMPLATE("1, 2, 3, 4 and 8 threads: other shapes", ShapeT, Ball<double>,
                   Polygon<double>) {
  check_bits<ShapeT>(SignoriniCoulomb<>(0.4));
}

namespace {

/// 12 x 12 x 9 balls, polyhedra and capsules fall on a wavy floor of triangles in a cylinder: enough for
/// two blocks of bodies.
std::vector<double> mixed(const Team& team) {
  using S = Space<3>;
  using Vector = S::Vector;
  using Mixed = OneOf<Ball<>, Polyhedron<>, Capsule<>>;
  using Law = SignoriniCoulomb<>;
  const Lattice<S> lattice{12, 9, 0.024, 0.1};
  Simulation<Mixed, Law> world(grain_size, Materials<Law>(1, Law(0.4)));
  world.set_team(team);
  const ShapeId shapes[] = {world.add_shape(Mixed(Ball<>(grain_size / 2))),
                            world.add_shape(Mixed(regular_shape<Polyhedron<>>(grain_size))),
                            world.add_shape(Mixed(Capsule<>(grain_size / 4, grain_size / 4)))};
  constexpr int fields = 20;
  TriangleMesh<> floor;
  for (int i = 0; i <= fields; ++i)
    for (int j = 0; j <= fields; ++j)
      floor.vertices.push_back({0.02 * i - 0.05, 0.02 * j - 0.05,
                                0.004 * std::sin(0.9 * i) * std::cos(0.7 * j) - 0.004});
  for (unsigned i = 0; i < fields; ++i)
    for (unsigned j = 0; j < fields; ++j) {
      const unsigned a = i * (fields + 1) + j, b = a + fields + 1;
      floor.facets.push_back({a, b, b + 1});
      floor.facets.push_back({a, b + 1, a + 1});
    }
  world.add_mesh_wall(floor);
  world.add_cylinder(lattice.width() / 2 * Vector(1, 1, 0), Vector::UnitZ(),
                     0.75 * lattice.width());
  lattice.for_each([&](const Vector& centre, int i, int j, int k) {
    world.add_grain(shapes[(i + j + k) % 3],
                    {centre, S::exp(S::Angular::Constant(0.1 * k + 0.3 * i))}, 2700);
  });
  world.set_gravity(-9.81 * Vector::UnitZ());
  std::vector<double> results;
  for (int step = 0; step < steps; ++step) results.push_back(world.step(5e-4).solve.residual);
  append_positions(world, results);
  return results;
}

}  // namespace

TEST_CASE("1, 2, 3, 4 and 8 threads: shapes mixed, walls of triangles, a cylinder, blocks") {
  const auto alone = mixed(Team());
  for (const int threads : team_sizes) CHECK(mixed(eager(threads)) == alone);
}

TEST_CASE_TEMPLATE("1, 2, 3, 4 and 8 threads: every law", ShapeT, Disk<double>, Ball<double>,
                   Polyhedron<double>) {
  check_bits<ShapeT>(Frictionless<>(0.2));
  check_bits<ShapeT>(SignoriniCoulomb<>(0.4, 0.1, 0.5));
  check_bits<ShapeT>(Cohesive<SignoriniCoulomb<>>(SignoriniCoulomb<>(0.4), 0.5, 1e-4));
  check_bits<ShapeT>(RollingResistance<>(0.4, 0.05));
  check_bits<ShapeT>(LinearSpringDashpot<>(1e3));
}
