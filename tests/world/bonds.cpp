// SPDX-License-Identifier: MIT
// Bonds: how they are made, listed, written and removed; their contacts when they broke; snapshots, periodic cells, threads.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <numbers>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "moreau/io/snapshot.hpp"
#include "moreau/io/write_paraview.hpp"
#include "moreau/measure/check.hpp"
#include "moreau/measure/energy_balance.hpp"

#include "io/temporary_folder.hpp"
#include "threads/eager_team.hpp"
#include "world/bonded_rows.hpp"

using namespace moreau;
using namespace bonded;

TEST_CASE_TEMPLATE("bond: check() tells strengths that forces drown in from bonds without a load",
                   X, MOREAU_TYPES((Case<Globe, Rigid>), (Case<Circle, Rigid>))) {
  using World = Row<typename X::Shape, typename X::LawOf>;
  using S = typename World::S;
  for (const double scale : {1.0, 1e20}) {
    World row(3, 0, 1000, scale);
    row.world.set_gravity(-9.81 * S::Vector::Unit(S::dim - 1));
    StepReport report = row.world.step(1e-4);
    if (scale == 1) report.bond_load = 1e-16, report.bond_error = 1;  // as in free fall
    CHECK(report.bond_error == 1);
    const auto sentences = moreau::check(row.world, report);
    const bool says =
        std::any_of(sentences.begin(), sentences.end(), [](const std::string& sentence) {
          return sentence.find("bonds bear") != std::string::npos;
        });
    CHECK(says == (scale > 1));
  }
}

TEST_CASE_TEMPLATE(
    "bond: check() names bonds that are too long, and says nothing of those without a load", X,
    MOREAU_TYPES((Case<Globe, Rigid>, Case<Circle, Soft>), (Case<Circle, Rigid>))) {
  using World = Row<typename X::Shape, typename X::LawOf>;
  using S = typename World::S;
  World row(3);
  const auto says = [&](const StepReport& report) {
    const auto sentences = moreau::check(row.world, report);
    return std::any_of(sentences.begin(), sentences.end(), [](const std::string& sentence) {
      return sentence.find("bonds bear") != std::string::npos ||
             sentence.find("is stretched by") != std::string::npos;
    });
  };
  for (int k = 0; k < 3; ++k) CHECK(!says(row.world.step(1e-4)));
  // Between two bodies whose motions are prescribed nothing holds.
  row.world.prescribe_motion(row.grains[1]);
  row.world.set_velocity(row.grains[1], typename S::Vector(100 * S::Vector::UnitX()));
  bool said = false;
  for (int k = 0; k < 3; ++k) said = says(row.world.step(1e-4));
  CHECK(said);
}

TEST_CASE_TEMPLATE(
    "bond: check() names bonds that were not made, and strengths in kN; deep overlaps are refused",
    X,
    MOREAU_TYPES((Case<Circle, Rigid>, Case<Globe, Soft>),
                 (Case<Globe, Rigid>, Case<BallIn<Space<2, float>>, Bonded<float>>))) {
  using ShapeT = typename X::Shape;
  using Law = typename X::LawOf;
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const T gap = T(1e-4), width = T(2 * radius);
  const auto pair = [&](double scale, T distance) {
    Simulation<ShapeT, Law> world(width, Materials<Law>(1, Make<Law>::law(0, scale)),
                                  tight(std::is_same_v<T, float>));
    const ShapeId shape = world.add_shape(ShapeT(T(radius)));
    for (const T x : {T(0), distance})
      world.add_grain(shape, Pose<S>(Vector(x * Vector::UnitX())), T(1000));
    world.prescribe_motion(world.grain(0));
    world.set_gravity(Vector(T(-9.81) * Vector::Unit(S::dim - 1)));
    return world;
  };
  const auto says = [&](auto& world, const char* text) {
    const StepReport report = world.step(T(1e-5));
    for (const std::string& sentence : check(world, report))
      if (sentence.find(text) != std::string::npos) return true;
    return false;
  };
  const char *nothing = "has bonded nothing", *weak = "cannot carry the lightest grain";
  auto near = pair(1, width + gap);
  CHECK(!says(near, nothing));  // none was asked for
  CHECK(near.bond_touching(gap / 10) == 0);
  CHECK(agree(double(near.missed_gap()), double(gap), 1e-2));
  CHECK(says(near, "has bonded nothing: the smallest gap was "));
  CHECK(near.missed_points() == 0);
  const std::vector<BodyId> both{near.grain(0), near.grain(1)};
  CHECK(near.bond_touching(gap / 10, both, 2) == 0);  // too far
  CHECK(near.missed_points() == 0);
  CHECK(says(near, "has bonded nothing: the smallest gap was "));
  CHECK(near.bond_touching(2 * gap, both, 2) == 0);  // one point
  CHECK(near.missed_points() == 1);
  CHECK(says(near, "pairs within the gap have at most 1 contact points"));
  CHECK(!says(near, "smallest gap"));
  CHECK(near.bond_touching(2 * gap) == 1);
  CHECK(near.missed_gap() < 0);
  CHECK(near.missed_points() == 0);
  CHECK(near.bond_touching(gap / 10) == 0);  // there is one already
  CHECK(!says(near, nothing));
  CHECK(!says(near, weak));
  auto far = pair(1, 2 * width);
  CHECK(far.bond_touching(gap) == 0);
  CHECK(says(far, "no two bodies that it may bond were within the margin of"));
  auto kilo = pair(1e-3, width);  // 0.02 kN for 20 N
  CHECK(kilo.bond_touching(gap) == 1);
  CHECK(says(kilo, "If it was meant as kN, write tension = 20"));
  kilo.set_gravity(Vector(T(-9810) * Vector::Unit(S::dim - 1)));
  CHECK(says(kilo, weak));
  CHECK(kilo.breakages().size() == 1);
  CHECK(says(kilo, weak));  // of bonds that have broken
  kilo.set_gravity(Vector(Vector::Zero()));
  CHECK(!says(kilo, weak));
  // The laws of the pairs that are bonded count, not those of others.
  for (const bool plate_is_bonded : {false, true}) {
    Materials<Law> materials(2, Make<Law>::law());
    materials.set(MaterialId(0), MaterialId(1), Make<Law>::law(0, 1e-9));
    Simulation<ShapeT, Law> stones(width, materials, tight(std::is_same_v<T, float>));
    const Vector up = Vector::Unit(S::dim - 1);
    const ShapeId shape = stones.add_shape(ShapeT(T(radius)));
    for (const T x : {T(0), width})
      stones.add_grain(shape, Pose<S>(Vector(x * Vector::UnitX())), T(1000));
    const BodyId plate = stones.add_wall(up, Vector(T(-radius) * up), MaterialId(1));
    stones.set_gravity(Vector(T(-9.81) * up));
    stones.bond(stones.grain(0), stones.grain(1));
    if (plate_is_bonded) stones.bond(stones.grain(0), plate);
    CHECK(says(stones, weak) == plate_is_bonded);
  }
  for (const bool one : {true, false}) {  // in nearly one place
    auto same = pair(1, T(0.2 * radius));
    const BodyId a = same.grain(0), b = same.grain(1);
    const std::string text =
        one ? "Simulation::bond: overlap" : "Simulation::bond_touching: overlap";
    CHECK_THROWS_WITH_AS(one ? same.bond(a, b) : void(same.bond_touching(gap)),
                         doctest::Contains(text.c_str()), std::invalid_argument);
    CHECK(same.bonds().empty());
    CHECK_THROWS_AS(same.step(T(1e-5)), std::invalid_argument);  // as before the call
    same.allow_overlaps();
    CHECK(same.bond_touching(gap) == 1);
  }
}

TEST_CASE("bond: made as the guide shows") {
  using S = Space<2>;
  using Glue = Compliant<Bonded<double>>;
  const Bonded<double> strong({tension, shear, bending}, friction);
  Simulation<Circle, Glue> simulation(2 * radius, Materials<Glue>(1, Glue(strong, stiffness)));
  const ShapeId disk = simulation.add_shape(Circle(radius));
  const BodyId left = simulation.add_grain(disk, Pose<S>({0, 0}), 1000);
  const BodyId right = simulation.add_grain(disk, Pose<S>({2 * radius, 0}), 1000);
  simulation.bond(left, right);    // these two
  simulation.bond_touching(1e-5);  // all pairs whose gap is at most 1e-5 m
  CHECK(simulation.bonds().size() == 1);
  CHECK(simulation.bonds()[0].strength_left == 1);
}

TEST_CASE("bond: a list of pairs") {
  Row<Circle, Soft> row(1);
  const ShapeId disk = row.world.add_shape(Circle(radius));
  for (int k = 1; k < 5; ++k)
    row.grains.push_back(row.world.add_grain(disk, Pose<Space<2>>({2 * radius * k, 0}), 1000));
  const auto& grains = row.grains;
  using Pairs = std::vector<std::pair<BodyId, BodyId>>;
  CHECK_THROWS_WITH_AS(row.world.bond(Pairs{{grains[0], grains[1]}, {grains[1], grains[3]}}),
                       doctest::Contains("Simulation::bond: b = 3 must be within the margin of a"),
                       std::invalid_argument);
  CHECK(row.world.bonds().empty());
  CHECK(row.world.bond(Pairs{{grains[3], grains[2]}, {grains[0], grains[1]}}) == 2);
  CHECK(row.world.bond(Pairs{{grains[0], grains[1]}, {grains[3], grains[4]}}) == 1);
  CHECK(row.world.bond(Pairs{}) == 0);
  CHECK(row.world.bonds().size() == 3);
  CHECK(row.world.bonds()[1].a == grains[2]);
}

TEST_CASE_TEMPLATE("bond: files for ParaView have the bonds and the cell", ShapeT, Circle, Globe) {
  using Law = std::conditional_t<SpaceOf<ShapeT>::dim == 2, Rigid, Soft>;
  using S = typename Row<ShapeT, Law>::S;
  Row<ShapeT, Law> row(3);
  const TemporaryFolder folder("bonds");
  const auto has = [&](const char* file, const std::string& text) {
    return read(folder / file).find(text) != std::string::npos;
  };
  write_paraview(folder / "open", row.world);
  CHECK(has("open_bonds.vtp", "NumberOfLines=\"2\""));
  CHECK(has("open_bonds.vtp", "Name=\"strength_left\" NumberOfComponents=\"1\""));
  CHECK(has("open.vtm", "open_bonds.vtp"));
  CHECK(!has("open.vtm", "open_cell.vtp"));
  row.world.set_cell(0.2 * S::Matrix::Identity());
  write_paraview(folder / "cell", row.world);
  CHECK(has("cell_cell.vtp", S::dim == 2 ? "NumberOfLines=\"4\"" : "NumberOfLines=\"12\""));
  CHECK(has("cell_cell.vtp", "Name=\"deformation\" NumberOfComponents=\"9\""));
  CHECK(has("cell.vtm", "cell_cell.vtp"));
}

TEST_CASE("bond: a broken bond is a contact with friction") {
  Row<Circle, Rigid> row(2);
  row.load(-10, 40, -40 * radius);  // above the shear strength of 12 + 0.6 * 10
  row.world.step(1e-4);
  CHECK(row.world.breakages().size() == 1);
  row.load(-10, 3.9, -3.9 * radius);
  row.world.set_velocity(row.last(), {0, 0});
  row.world.set_spin(row.last(), 0.0);
  row.world.step(1e-4);
  const auto& contacts = row.world.contacts();
  CHECK(contacts.size() == 1);
  CHECK(contacts.variants[0] == 0);
  CHECK(agree(double(contacts.impulses[0][0]), 10e-4, 1e-3));
  CHECK(agree(double(std::abs(contacts.impulses[0][1])), 3.9e-4, 1e-2));  // 0.4 * 10 would slip
}

TEST_CASE_TEMPLATE("bond: the contact of a broken bond has no spring of the bond", X,
                   MOREAU_TYPES((Case<Circle, Soft>, Case<Globe, Soft>),
                                (Case<Polygon<>, Soft>, Case<Polyhedron<>, Soft>,
                                 Case<BallIn<Space<2, float>>, Compliant<Bonded<float>>>,
                                 Case<BallIn<Space<3, float>>, Compliant<Bonded<float>>>))) {
  using Law = typename X::LawOf;
  Row<typename X::Shape, Law> row(2);
  using T = typename decltype(row)::T;
  row.load(-10, 8, -8 * radius);  // the bond bears up to 12 + 0.6 * 10 aside, friction 0.4 * 10
  for (int k = 0; k < 200; ++k) CHECK(row.world.step(T(5e-3)).bonds == 1);
  row.world.set_materials(Materials<Law>(1, Make<Law>::law(0, 1e-6)));
  const T h = T(1e-5);  // too short for new springs
  CHECK(row.world.step(h).broken_bonds == 1);
  row.load(-10, 0, 0);
  const StepReport report = row.world.step(h);
  const auto& contacts = row.world.contacts();
  REQUIRE(contacts.size() > 0);
  double push = 0, aside = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    CHECK(contacts.variants[c] == 0);
    push += double(contacts.impulses[c][0] / h);
    aside += double(contacts.impulses[c][1] / h);
  }
  CAPTURE(push);
  CAPTURE(report.elastic_energy);
  CHECK(push > 5);
  CHECK(std::abs(aside) < 0.5);
}

TEST_CASE("bond: snapshots, removed grains, walls, periodic cells, refusals") {
  using World = Row<Circle, Soft>;
  World row(4, 1e-3), copy(4, 1e-3);
  EnergyBalance<Space<2>> energy(row.world), continued(copy.world);
  const auto step = [](World& one, EnergyBalance<Space<2>>& balance) {
    balance.add(one.world, one.world.step(1e-4), 1e-4);
  };
  row.load(19, 3, 0);
  for (int k = 0; k < 30; ++k) step(row, energy);
  restore_snapshot(snapshot(row.world, energy), copy.world, continued);
  for (int k = 0; k < 100; ++k) step(row, energy), step(copy, continued);
  CHECK(snapshot(row.world, energy) == snapshot(copy.world, continued));
  CHECK(continued.terms().fracture > 0);
  CHECK(std::abs(continued.imbalance()) < 1e-9 * continued.terms().forces);
  CHECK(copy.world.bonds().size() == row.world.bonds().size());

  World three(3);
  three.world.remove_grain(three.grains[1]);
  CHECK(three.world.bonds().empty());
  CHECK(three.world.step(1e-4).points == 0);
  CHECK(three.world.breakages().empty());

  World held(1);
  const BodyId wall = held.world.add_wall({1, 0}, {-radius, 0});
  held.world.release(held.last());
  held.world.bond(wall, held.last());
  held.world.bond(held.last(), wall);  // has one
  CHECK(held.world.bonds().size() == 1);
  CHECK(held.world.bonds()[0].b == wall);
  held.load(10, 0, 0);
  for (int k = 0; k < 100; ++k) held.world.step(1e-3);
  CHECK(agree(double(held.world.pose(held.last()).position[0]), 10 / stiffness, 1e-3));
  CHECK(held.world.bond_touching(1e-4) == 0);
  const std::vector<BodyId> alone{held.last()};
  CHECK(held.world.bond_touching(1e-4, alone) == 0);
  Simulation<Circle, Rigid> none(2 * radius, Materials<Rigid>(1, Make<Rigid>::law()));
  const ShapeId circle = none.add_shape(Circle(radius));
  for (int k = 0; k < 3; ++k) none.add_grain(circle, Pose<Space<2>>({2 * radius * k, 0}), 1000);
  CHECK(none.bond_touching(1e-4, std::vector<BodyId>{}) == 0);  // an empty list is a list
  CHECK(std::isinf(none.missed_gap()));
  CHECK(none.bond_touching(1e-4, std::vector{none.grain(1), none.grain(2)}) == 1);
  CHECK(none.bond_touching(1e-4) == 1);  // the other pair
  CHECK_THROWS_WITH(held.world.bond_touching(1),
                    doctest::Contains("Simulation::bond_touching: gap = 1"));
  CHECK_THROWS_WITH(held.world.bond(wall, wall), doctest::Contains("Simulation::bond: b"));

  // Across the boundary of a cell: the grains at 0 and at 3 diameters of a cell of 4.
  Simulation<Circle, Rigid> cell(2 * radius, Materials<Rigid>(1, Make<Rigid>::law()));
  cell.set_periodic(0, -radius, 7 * radius);
  const ShapeId shape = cell.add_shape(Circle(radius));
  const BodyId a = cell.add_grain(shape, Pose<Space<2>>({0, 0}), 1000),
               b = cell.add_grain(shape, Pose<Space<2>>({6 * radius, 0}), 1000);
  cell.bond(a, b);
  cell.prescribe_motion(a);
  cell.set_force(b, {-0.99 * tension, 0});
  for (int k = 0; k < 20; ++k) cell.step(1e-4);
  CHECK(agree(double(cell.pose(b).position[0]), 6 * radius, 1e-9));
  CHECK(cell.bonds().size() == 1);
  cell.set_force(b, {-1.01 * tension, 0});
  cell.step(1e-4);
  CHECK(cell.bonds().empty());

  // The same pair in the vectors of set_cell(): another lattice would stretch the bond, the same one does not.
  Simulation<Circle, Rigid> lattice(2 * radius, Materials<Rigid>(1, Make<Rigid>::law()));
  const ShapeId same = lattice.add_shape(Circle(radius));
  const BodyId one = lattice.add_grain(same, Pose<Space<2>>({0, 0}), 1000),
               two = lattice.add_grain(same, Pose<Space<2>>({6 * radius, 0}), 1000);
  const Space<2>::Matrix square = 8 * radius * Space<2>::Matrix::Identity();
  lattice.set_cell(square);
  lattice.bond(one, two);
  CHECK_THROWS_WITH(
      lattice.set_cell(2 * square),
      "Simulation::set_cell: vectors = (0.16, 0, 0, 0.16) must be those before: a bond "
      "reaches across them, and would be stretched by the change");
  Space<2>::Matrix oblique = square;
  oblique(0, 1) = 8 * radius;
  lattice.set_cell(oblique);
  for (int k = 0; k < 20; ++k) lattice.step(1e-4);
  CHECK(lattice.bonds().size() == 1);
  CHECK(agree(double(lattice.pose(two).position[0]), 6 * radius, 1e-9));

  // A ring across the boundary, whose force is not determined, and a row between two walls under a load across it.
  Simulation<Circle, Rigid> ring(2 * radius, Materials<Rigid>(1, Make<Rigid>::law()));
  ring.set_periodic(0, -radius, 5 * radius);
  Simulation<Circle, Rigid> held_row(2 * radius, Materials<Rigid>(1, Make<Rigid>::law()));
  const BodyId left = held_row.add_wall({1, 0}, {-radius, 0});
  const BodyId right = held_row.add_wall({-1, 0}, {5 * radius, 0});
  for (auto* one : {&ring, &held_row}) {
    const ShapeId disk = one->add_shape(Circle(radius));
    for (int k = 0; k < 3; ++k) one->add_grain(disk, Pose<Space<2>>({2 * radius * k, 0}), 1000);
    CHECK(one->bond_touching(1e-6) == (one == &ring ? 3 : 4));
  }
  for (const BodyId grain : ring.grains()) ring.set_velocity(grain, {0.1, 0.5});
  const double weight = 1000 * std::numbers::pi * radius * radius;
  for (int k = 0; k < 200; ++k) {
    CHECK(ring.step(1e-3).solve.converged);
    for (std::size_t c = 0; c < ring.contacts().size(); ++c)
      CHECK(ring.contacts().impulse(c).norm() < 1e-9 * tension * 1e-3);
    held_row.set_gravity({0, -std::min(1.0, k / 100.)});
    CHECK(held_row.step(1e-3).solve.converged);
  }
  CHECK(ring.breakages().empty());
  CHECK(held_row.breakages().empty());
  const double borne =
      double(held_row.contact_impulse(left)[1] + held_row.contact_impulse(right)[1]);
  CHECK(agree(borne, -3e-3 * weight, 1e-2));

  using doctest::Contains;
  CHECK_THROWS_WITH(Bonded<>({0, 1, 1, 0}), Contains("Bonded: tension = 0 must be finite and > 0"));
  CHECK_THROWS_WITH(Bonded<>({1, -1, 1, 0}), Contains("shear = -1"));
  CHECK_THROWS_WITH(Bonded<>({1, 1, 0, 0}), Contains("bending = 0"));
  CHECK_THROWS_WITH(Bonded<>({1, 1, 1, -1}), Contains("fracture_energy = -1"));
}

namespace {

/// Layers of grains on a row with fixed ends. The last layer falls onto the others.
template <class ShapeT, class Law>
struct Shower {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  Simulation<ShapeT, Law> world;
  std::vector<BodyId> grains;

  static Tolerances tolerances(bool narrows) {
    Tolerances some;
    some.narrows = narrows;
    return some;
  }
  Shower(const Law& law, bool narrows)
      : world(2 * radius, Materials<Law>(1, law), tight(false), tolerances(narrows)) {
    const ShapeId shape = world.add_shape(ShapeT(radius));
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> noise(-1, 1);
    for (int k = 0; k < 40; ++k) {
      Vector x = Vector::Zero(), v = Vector::Zero();
      x[0] = 2 * radius * (k % 8);
      x[1] = 2.001 * radius * (k / 8);
      if (k >= 8) x[0] += 0.1 * radius * noise(random);
      if (k >= 32) v[1] = -2 + noise(random);
      grains.push_back(world.add_grain(shape, Pose<S>(x), 1000));
      world.set_velocity(grains.back(), v);
    }
    world.prescribe_motion(grains[0]);
    world.prescribe_motion(grains[7]);
  }
};

}  // namespace

TEST_CASE_TEMPLATE("bond: without bonds, contacts are those of rolling resistance", ShapeT, Circle,
                   Globe) {
  Shower<ShapeT, Rigid> one(Rigid({tension, shear, bending}, friction, 0.1), true);
  Shower<ShapeT, RollingResistance<>> two(RollingResistance<>(friction, 0.1), true);
  // The direct method for islands solves contacts of RollingResistance, not of Bonded.
  ColouredOptions sweeps = tight(false).options();
  sweeps.islands = false;
  one.world.set_solver(ColouredGaussSeidel(sweeps));
  two.world.set_solver(ColouredGaussSeidel(sweeps));
  std::size_t points = 0;
  for (int k = 0; k < 100; ++k) {
    const StepReport a = one.world.step(1e-4), b = two.world.step(1e-4);
    CHECK(a.points == b.points);
    points += a.points;
  }
  CHECK(points > 1000);
  for (std::size_t i = 0; i < one.grains.size(); ++i)
    CHECK(one.world.velocity(one.grains[i]) == two.world.velocity(two.grains[i]));
}

TEST_CASE_TEMPLATE("bond: a step that is repeated with more contacts yields once", ShapeT, Circle,
                   Globe) {
  const Rigid law({tension, shear, bending, 2e-4});  // without friction velocities are unique
  Shower<ShapeT, Rigid> one(law, true), two(law, false);
  for (auto* each : {&one, &two})
    CHECK(each->world.bond_touching(1e-5, std::span(each->grains).first(8)) == 7);
  int repeated = 0;
  std::size_t broken = 0;
  for (int k = 0; k < 20; ++k) {
    const StepReport a = one.world.step(1e-4), b = two.world.step(1e-4);
    CHECK(a.points <= b.points);
    CHECK(a.broken_bonds == b.broken_bonds);
    repeated += a.repeated;
    broken += a.broken_bonds;
  }
  CHECK(repeated > 0);
  CHECK(broken > 0);
  double worst = 0;
  for (std::size_t i = 0; i < one.grains.size(); ++i)
    worst = std::max(
        worst,
        (one.world.pose(one.grains[i]).position - two.world.pose(two.grains[i]).position).norm());
  CHECK(worst < 1e-6 * radius);
}

TEST_CASE_TEMPLATE("bond: several threads have the bits of one while bonds soften and break",
                   ShapeT, Circle, Globe) {
  for (const int threads : {2, 3}) {
    const Rigid law({tension, shear, bending, 2e-4}, friction);
    Shower<ShapeT, Rigid> one(law, true), two(law, true);
    two.world.set_team(threads_test::eager(threads));
    for (auto* each : {&one, &two}) CHECK(each->world.bond_touching(1e-4) > 7);
    for (int k = 0; k < 40; ++k) one.world.step(1e-4), two.world.step(1e-4);
    CHECK(!one.world.breakages().empty());
    CHECK(!one.world.bonds().empty());
    CHECK(snapshot(one.world) == snapshot(two.world));
  }
}

TEST_CASE_TEMPLATE("bond: removed grains take their bonds, new grains in their place have none", X,
                   MOREAU_TYPES((Case<Circle, Rigid>, Case<Globe, Soft>),
                                (Case<Circle, Soft>, Case<Globe, Rigid>))) {
  using World = Row<typename X::Shape, typename X::LawOf>;
  using S = typename World::S;
  using Vector = typename S::Vector;
  // A disk of 1000 kg/m^2 has 80 times the mass of a ball of 1000 kg/m^3.
  const double density = S::dim == 2 ? 100 : 1000;
  World row(6, 1e-3, density);
  const double h = 1e-3, fall = 9.81;
  row.world.set_gravity(Vector(fall * Vector::UnitX()));  // the row hangs along x
  for (int k = 0; k < 200; ++k) row.world.step(h);
  const double weight = fall * double(row.world.bodies().grain_mass[1]);
  CHECK(agree(row.world.contact_impulse(row.grains[0]).norm() / h, 5 * weight, 1e-3));
  const double lowest = row.world.pose(row.last()).position[0];
  row.world.remove_grain(row.grains[3]);
  CHECK(row.world.bonds().size() == 3);
  CHECK(row.world.breakages().empty());
  for (int k = 0; k < 50; ++k) row.world.step(h);
  CHECK(agree(row.world.pose(row.last()).position[0] - lowest, fall * 2500 * h * h / 2, 1e-3));
  CHECK(agree(row.world.contact_impulse(row.grains[0]).norm() / h, 2 * weight, 1e-2));
  const Vector place = row.world.pose(row.grains[2]).position + 2 * radius * Vector::UnitX();
  const ShapeId shape = row.world.add_shape(typename X::Shape(radius));
  const BodyId fresh = row.world.add_grain(shape, Pose<S>(place), density);
  CHECK(fresh.index() == row.grains[3].index());
  CHECK(row.world.bonds().size() == 3);
  for (int k = 0; k < 50; ++k) row.world.step(h);
  CHECK(agree(row.world.pose(fresh).position[0] - place[0], fall * 2500 * h * h / 2, 1e-3));
}

TEST_CASE_TEMPLATE("bond: in a step that is repeated, a torque acts once", ShapeT, Circle, Globe) {
  Shower<ShapeT, Rigid> scene(Rigid({tension, shear, bending}, friction), true);
  using S = SpaceOf<ShapeT>;
  typename S::Vector far = S::Vector::Zero();
  far[0] = 3;
  const BodyId lone =
      scene.world.add_grain(scene.world.add_shape(ShapeT(radius)), Pose<S>(far), 1000);
  const typename S::Angular torque = S::Angular::Constant(1e-5);
  scene.world.set_torque(lone, torque);
  scene.world.set_force(lone, S::Vector::UnitX());
  const double h = 1e-4, inertia = S::dim == 2
                                       ? 1000 * std::numbers::pi * std::pow(radius, 4) / 2
                                       : 1000 * 8 * std::numbers::pi * std::pow(radius, 5) / 15;
  int repeated = 0;
  for (int k = 1; k <= 20; ++k) {
    repeated += scene.world.step(h).repeated;
    CHECK((inertia * scene.world.spin(lone) - k * h * torque).norm() <
          1e-12 * k * h * torque.norm());
  }
  CHECK(repeated > 0);
}
