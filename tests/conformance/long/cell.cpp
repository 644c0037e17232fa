// SPDX-License-Identifier: MIT
// Laws for impulses in a periodic cell that deforms, in turn with the kinds of shapes.
#include "conformance/cell.hpp"

#include "moreau/law/bonded.hpp"
#include "moreau/law/bridges.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/frictionless.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/law/tangential_restitution.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"

using namespace moreau;

namespace {

using Coulomb = SignoriniCoulomb<>;
using Rolling = RollingResistance<>;
using Walton = TangentialRestitution<>;
using Water = CapillaryBridge<>;

const Coulomb coulomb(0.4);
const Rolling rolling(0.4, 0.1);
const Walton walton(0.3, 0.8, 0.4);
const Water water(1e-12);
constexpr double size = 0.01, stiffness = 1e6;  // [m], [N/m]

const Disk<> disk(0.005);
const Ball<> ball(0.005);
const std::vector<Polygon<>> polygons{cuboid<Polygon<>>({0.004, 0.0028}),
                                      cuboid<Polygon<>>({0.0033, 0.0033})};
const std::vector<Polyhedron<>> polyhedra{cuboid<Polyhedron<>>({0.0035, 0.0028, 0.002}),
                                          cuboid<Polyhedron<>>({0.0027, 0.0027, 0.0027})};

template <class Law>
Compliant<Law> with_springs(const Law& law) {
  return Compliant<Law>(law, stiffness, stiffness / 2);
}

}  // namespace

TEST_CASE("cell: friction of polyhedra; with static friction and restitution") {
  conformance::cell(polyhedra, coulomb, size);
  conformance::cell(polyhedra, Coulomb(0.3, 0.5, 0.4), size);
}
TEST_CASE("cell: plain sweeps") {
  using Plain = conformance::With<void, void, NonlinearGaussSeidel>;
  conformance::cell<Plain>(disk, coulomb, size);
}
TEST_CASE("cell: tangential restitution") {
  conformance::cell(ball, walton, size);
}
TEST_CASE("cell: cohesion of grains with a tangential restitution") {
  conformance::cell(disk, Cohesive<Walton>(walton, 1e-3), size);
}
TEST_CASE("cell: bridges of grains with a tangential restitution") {
  conformance::cell(ball, Bridged<Water, Walton>(water, walton), size);
}
TEST_CASE("cell: bonds of polygons, brittle and with a fracture energy") {
  conformance::cell(polygons, Bonded<>({2, 1.5, 1}, 0.4, 0.1), size);
  conformance::cell(polygons, Bonded<>({2, 1.5, 1, 1e-4}, 0.4, 0.1), size);
}
TEST_CASE("cell: springs, of polygons without friction") {
  conformance::cell(polygons, with_springs(Frictionless<>()), size);
}
TEST_CASE("cell: springs of polyhedra") {
  conformance::cell(polyhedra, with_springs(coulomb), size);
}
TEST_CASE("cell: springs and rolling resistance") {
  conformance::cell(ball, with_springs(rolling), size);
}
TEST_CASE("cell: springs and cohesion") {
  conformance::cell(disk, with_springs(Cohesive<Coulomb>(coulomb, 1e-3)), size);
}
TEST_CASE("cell: springs and bridges") {
  conformance::cell(ball, with_springs(Bridged<Water, Coulomb>(water, coulomb)), size);
}
TEST_CASE("cell: springs and bonds of balls") {
  conformance::cell(ball, with_springs(Bonded<>({2, 1.5, 1}, 0.4, 0.1)), size);
}
