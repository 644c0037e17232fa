// SPDX-License-Identifier: MIT
// A periodic cell that deforms (world/cell_control.hpp).
#include <cmath>
#include <doctest/doctest.h>
#include <memory>
#include <random>
#include <type_traits>

#include "moreau/io/snapshot.hpp"
#include "moreau/measure/energy_balance.hpp"
#include "moreau/measure/region.hpp"
#include "moreau/mesh/facet_mesh.hpp"

#include "io/temporary_folder.hpp"
#include "threads/same_bits.hpp"
#include "types.hpp"
#include "world/gas_cell.hpp"

using namespace moreau;
using namespace gas_cell;

namespace {

/// Shears along x, and changes the volume.
template <class S>
CellControl<S> mixed(double rate) {
  CellControl<S> control;
  control.rate(0, 1) = 6 * rate;
  control.rate(1, 0) = -rate;
  for (int axis = 0; axis < S::dim; ++axis) control.rate(axis, axis) = -rate / (1 + axis);
  control.rate(S::dim - 1, 0) += rate;
  return control;
}

}  // namespace

TEST_CASE_TEMPLATE("work of a deforming cell: stress x rate, and the balance of energy", ShapeT,
                   MOREAU_TYPES((Polygon<>, Ball<>), (Disk<>))) {
  using S = SpaceOf<ShapeT>;
  Gas<ShapeT> gas;
  auto& simulation = gas.simulation;
  simulation.set_cell(Gas<ShapeT>::square());
  const CellControl<S> control = mixed<S>(1);
  simulation.control_cell(control);
  const typename S::Matrix half = S::Matrix::Identity() + h / 2 * control.rate;
  EnergyBalance<S> energy(simulation);
  double largest = 0, worst_power = 0, worst_balance = 0;
  std::size_t points = 0;
  for (int k = 0; k < 150; ++k) {
    const StepReport report = simulation.step(h);
    energy.add(simulation, report, h);
    const double volume = simulation.cell().volume() / half.determinant();
    const double power = -volume * (simulation.cell_motion().stress() * control.rate).trace() * h;
    largest = std::max(largest, std::abs(report.cell_work));
    worst_power = std::max(worst_power, std::abs(power - report.cell_work));
    worst_balance = std::max(worst_balance, std::abs(energy.imbalance()));
    points += report.points;
  }
  CHECK(points > 1000);
  CHECK(worst_power < 1e-9 * largest);
  CHECK(worst_balance < 1e-9 * largest);
  CHECK(std::abs(energy.terms().cell) > 2 * largest);
  const double volume = std::pow(side<S> * spacing, S::dim), rate = control.rate.trace();
  CHECK(simulation.cell().volume() ==
        doctest::Approx(volume * std::exp(150 * h * rate)).epsilon(1e-6));
}

TEST_CASE_TEMPLATE("forces do not depend on the vectors of a lattice or on the images", ShapeT,
                   MOREAU_TYPES((Polygon<>, Ball<>), (Polyhedron<>, Disk<>))) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;
  const Matrix vectors = Gas<ShapeT>::square();
  Matrix other = vectors;
  other.col(1) += 3 * other.col(0);
  other.col(0) -= 2 * other.col(S::dim - 1);
  Gas<ShapeT> one, two([&](int k, const Vector&x) {
    return Vector(x + vectors * Vector::Unit(k % S::dim) * double(k % 5 - 2));
  });
  one.simulation.set_cell(vectors);
  // A thin cell, which has no room for the grains, of the same lattice, which has.
  two.simulation.set_cell(other, 0.3 * spacing * Vector::Ones());
  double largest = 0, worst = 0;
  for (Gas<ShapeT>* gas : {&one, &two}) gas->simulation.control_cell(mixed<S>(1));
  for (int k = 0; k < 60; ++k) {
    const StepReport a = one.simulation.step(h), b = two.simulation.step(h);
    REQUIRE(a.points == b.points);
    for (std::size_t i = 0; i < one.grains.size(); ++i) {
      const Vector force = one.simulation.contact_impulse(one.grains[i]);
      largest = std::max(largest, force.norm());
      worst = std::max(worst, (force - two.simulation.contact_impulse(two.grains[i])).norm());
    }
  }
  CHECK(largest > 0);
  CHECK(worst < 1e-7 * largest);
}

TEST_CASE_TEMPLATE("a cell that does not deform has the bits of a periodic box", ShapeT,
                   MOREAU_TYPES((Polygon<>, Ball<>), (Polyhedron<>, Disk<>))) {
  using S = SpaceOf<ShapeT>;
  Gas<ShapeT> one, two;
  for (int axis = 0; axis < S::dim; ++axis) one.simulation.set_periodic(axis, 0, side<S> * spacing);
  two.simulation.set_cell(Gas<ShapeT>::square());
  CHECK(scenes::have_same_bits_after(150, one.simulation, two.simulation));
  CHECK(one.simulation.contacts().size() > 0);
}

TEST_CASE_TEMPLATE("a cell is sheared through several reductions", ShapeT,
                   MOREAU_TYPES((Polygon<>, Ball<>), (Disk<>))) {
  using S = SpaceOf<ShapeT>;
  Gas<ShapeT> gas;
  auto& simulation = gas.simulation;
  simulation.set_cell(Gas<ShapeT>::square());
  CellControl<S> control;
  control.rate(0, 1) = 8;
  simulation.control_cell(control);
  int reductions = 0;
  double deepest = 0;
  typename S::Matrix stress = S::Matrix::Zero();
  for (int k = 0; k < 700; ++k) {
    const double before = simulation.cell().vectors()(0, 1);
    deepest = std::max(deepest, simulation.step(h).max_overlap);
    reductions += simulation.cell().vectors()(0, 1) < before;
    stress += simulation.cell_motion().stress();
  }
  const double strain = 8 * h * 700;
  CHECK(reductions == 3);  // at the strains 1/2, 3/2 and 5/2
  CHECK(simulation.cell_motion().deformation()(0, 1) == doctest::Approx(strain));
  CHECK(simulation.cell().volume() ==
        doctest::Approx(std::pow(side<S> * spacing, S::dim)).epsilon(1e-12));
  CHECK(deepest < 0.02 * 0.02);
  // The lattice is that of the box after the shear, reduced.
  CHECK(simulation.cell().vectors()(0, 1) ==
        doctest::Approx((strain - std::round(strain)) * side<S> * spacing));
  CHECK(stress(1, 0) < 0);  // it resists
  CHECK(stress(1, 1) > -stress(1, 0));
}

TEST_CASE_TEMPLATE("control volumes that tile an oblique cell have its stress and solid fraction",
                   ShapeT, MOREAU_TYPES((Polygon<>, Ball<>), (Polyhedron<>, Disk<>))) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  Gas<ShapeT> gas;
  auto& simulation = gas.simulation;
  simulation.set_cell(Gas<ShapeT>::square());
  CellControl<S> control;
  control.rate(0, 1) = 10;
  simulation.control_cell(control);
  for (int k = 0; k < 80; ++k) simulation.step(h);
  const double length = side<S> * spacing, volume = simulation.cell().volume();
  CHECK(simulation.cell().vectors()(0, 1) == doctest::Approx(0.4 * length));
  // A box of the lengths of the cell tiles space with the lattice of a shear along x; so do its parts.
  typename S::Matrix stress = S::Matrix::Zero(), whole = S::Matrix::Zero();
  double fraction = 0, grains = 0, solid = 0;
  const int parts = 1 << S::dim;
  for (int part = 0; part < parts; ++part) {
    Aabb<S> box{Vector(Vector::Constant(0.3 * length)), Vector(Vector::Constant(0.8 * length))};
    for (int axis = 0; axis < S::dim; ++axis)
      if ((part >> axis & 1) != 0) box.lower[axis] += length / 2, box.upper[axis] += length / 2;
    const Region<S> region = measure_region(simulation, h, box);
    stress += region.stress / parts;
    fraction += region.solid_fraction / parts;
    grains += double(region.grains);
  }
  const auto& contacts = simulation.contacts();
  for (std::size_t c = 0; c < contacts.size(); ++c)
    whole += (contacts.points[c].lever_a - contacts.points[c].lever_b) *
             (contacts.points[c].frame * contacts.impulse(c)).transpose() / (h * volume);
  for (const double mass : simulation.bodies().grain_mass) solid += mass / 2700;
  CHECK(whole.norm() > 0);
  CHECK((stress - whole).norm() < 1e-9 * whole.norm());
  CHECK(fraction == doctest::Approx(solid / volume).epsilon(1e-9));
  CHECK(grains == double(simulation.grain_count()));
}

TEST_CASE_TEMPLATE("a deforming cell continues from a snapshot and with threads with the same bits",
                   ShapeT, MOREAU_TYPES((Disk<>), (Polyhedron<>, Ball<>, Polygon<>))) {
  using S = SpaceOf<ShapeT>;
  using Law = scenes::LawOf<ShapeT>;
  // Of one component; 0: all rates are prescribed.
  for (const double pressure : {0.0, S::dim == 2 ? 5e3 : 1e2}) {
    Gas<ShapeT> gas, shared;
    scenes::World<ShapeT> read(0.02, Materials<Law>(1, Law(0.4)));
    CellControl<S> control = mixed<S>(2);
    control.mass(1, 1) = pressure > 0 ? 0.3 : 0;
    control.stress(1, 1) = pressure;
    for (Gas<ShapeT>* one : {&gas, &shared}) {
      one->simulation.set_cell(Gas<ShapeT>::square());
      one->simulation.control_cell(control);
    }
    shared.simulation.set_team(Team(std::make_shared<threads_test::EagerThreads>(3)));
    for (int k = 0; k < 60; ++k) gas.simulation.step(h), shared.simulation.step(h);
    const TemporaryFolder folder("cell");
    write_snapshot(folder / "cell", gas.simulation);
    read_snapshot(folder / "cell", read);
    CHECK(scenes::have_same_bits_after(60, gas.simulation, read));
    for (int k = 0; k < 60; ++k) shared.simulation.step(h);
    CHECK(scenes::have_same_bits_after(60, read, shared.simulation));
    CHECK(read.cell_motion().rate() == shared.simulation.cell_motion().rate());
  }
}

TEST_CASE_TEMPLATE("report of a step: stress and deformation of the cell; strain", ShapeT,
                   MOREAU_TYPES((Disk<double>, Ball<double>), (Disk<float>, Ball<float>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Matrix = typename S::Matrix;
  const double near = std::is_same_v<T, float> ? 1e-5 : 1e-12;
  using Law = SignoriniCoulomb<T>;
  const T h = T(1e-4), room = T(0.03);
  Simulation<ShapeT, Law> simulation(T(0.01), Materials<Law>(1, Law(T(0.4))));
  const ShapeId shape = simulation.add_shape(ShapeT(T(0.005)));
  for (int k = 0; k < 1 << S::dim; ++k) {
    typename S::Vector x, v;
    for (int axis = 0; axis < S::dim; ++axis) {
      x[axis] = room * (T(k >> axis & 1) + T(0.5));
      v[axis] = T(0.02 * (k + axis));
    }
    simulation.set_velocity(simulation.add_grain(shape, Pose<S>(x), 1000), v);
  }
  simulation.set_cell(2 * room * Matrix::Identity());
  StepReport report = simulation.step(h);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      CHECK(report.cell_deformation[i][j] == (i == j ? 1 : 0));
      // Of the velocities; in the plane the rest is empty.
      CHECK((report.cell_stress[i][j] != 0) == (i < S::dim && j < S::dim));
    }
  const double volume = double(simulation.cell().volume());
  CellControl<S> control;
  control.rate(0, 0) = -1;
  control.rate(1, 1) = T(-0.5);
  simulation.control_cell(control);
  for (int k = 0; k < 100; ++k) report = simulation.step(h);
  const CellMotion<S>& motion = simulation.cell_motion();
  for (int i = 0; i < S::dim; ++i)
    for (int j = 0; j < S::dim; ++j) {
      CHECK(report.cell_stress[i][j] == double(motion.stress()(i, j)));
      CHECK(report.cell_deformation[i][j] == double(motion.deformation()(i, j)));
    }
  CHECK(report.cell_deformation[0][0] == doctest::Approx(std::exp(-0.01)).epsilon(1e-5));
  const Matrix strain = motion.strain();
  CHECK(double(strain(0, 0)) ==
        doctest::Approx(-std::log(report.cell_deformation[0][0])).epsilon(10 * near));
  CHECK(double(strain(0, 0)) == doctest::Approx(0.01).epsilon(1e-3));
  CHECK(double(strain.trace()) ==
        doctest::Approx(std::log(volume / double(simulation.cell().volume()))).epsilon(1e3 * near));
  // A shear turns no volume into another; its strain is that of Hencky.
  control = {};
  control.rate(0, 1) = 4;
  simulation.set_cell(simulation.cell().vectors());
  CHECK(simulation.cell_motion().strain().isZero(0));
  simulation.control_cell(control);
  for (int k = 0; k < 1000; ++k) report = simulation.step(h);
  const double gamma = report.cell_deformation[0][1];
  CHECK(gamma == doctest::Approx(0.4).epsilon(1e-3));
  const Matrix sheared = simulation.cell_motion().strain();
  const double stretch = std::asinh(gamma / 2), angle = std::atan(2 / gamma) / 2;
  CHECK(double(sheared(0, 1)) ==
        doctest::Approx(-stretch * std::sin(2 * angle)).epsilon(100 * near));
  CHECK(double(sheared(0, 0)) ==
        doctest::Approx(-stretch * std::cos(2 * angle)).epsilon(1e3 * near));
  CHECK(std::abs(double(sheared.trace())) < 100 * near);
}

TEST_CASE("grains that do not touch move with the cell") {
  using World = scenes::World<Disk<>>;
  using Vector = Space<2>::Vector;
  World world(0.02, Materials<SignoriniCoulomb<>>(1, SignoriniCoulomb<>(0.4)));
  const ShapeId disk = world.add_shape(Disk<>(0.005));
  const BodyId a = world.add_grain(disk, Pose<Space<2>>(Vector(0.02, 0.05)), 2700),
               b = world.add_grain(disk, Pose<Space<2>>(Vector(0.06, 0.09)), 2700);
  world.set_cell(0.1 * Space<2>::Matrix::Identity());
  world.control_cell(mixed<Space<2>>(-0.2));
  for (int k = 0; k < 200; ++k) world.step(h);
  const auto& map = world.cell_motion().deformation();
  CHECK((world.pose(a).position - map * Vector(0.02, 0.05)).norm() < 1e-14);
  CHECK((world.pose(b).position - map * Vector(0.06, 0.09)).norm() < 1e-14);
  CHECK(world.velocity(a).isZero(0));
}

TEST_CASE("what does not fit into a deforming cell is refused") {
  using World = scenes::World<Disk<>>;
  using Vector = Space<2>::Vector;
  const auto world = [] {
    World one(0.02, Materials<SignoriniCoulomb<>>(1, SignoriniCoulomb<>(0.4)));
    one.add_grain(one.add_shape(Disk<>(0.01)), Pose<Space<2>>(Vector(0.05, 0.05)), 2700);
    return one;
  };
  const Space<2>::Matrix unit = Space<2>::Matrix::Identity();
  const auto refuses = [](const auto& call, const char* message) {
    CHECK_THROWS_WITH_AS(call(), message, std::invalid_argument);
  };
  World one = world();
  refuses([&] { one.control_cell({}); },
          "Simulation::control_cell: cell = (none) must be one of set_cell()");
  Space<2>::Matrix mirrored = 0.1 * unit;
  mirrored(0, 0) = -0.1;
  refuses([&] { one.set_cell(mirrored); },
          "Simulation::set_cell: vectors = (-0.1, 0, 0, 0.1) must have a positive determinant");
  one.set_cell(0.1 * unit);
  refuses([&] { one.add_wall(Vector(1, 0), Vector(0, 0)); },
          "Simulation::add_wall: normal = (1, 0) must not be of a wall: the cell deforms");
  refuses([&] { one.add_cylinder(Vector(0, 0), Space<2>::Angular(1), 1); },
          "Simulation::add_cylinder: axis = (1) must not be of a cylinder: the cell deforms");
  refuses(
      [&] {
        one.add_mesh_wall(FacetMesh<Space<2>>{{{0, 0}, {0.1, 0}}, {{0, 1}}});
      },
      "Simulation::add_mesh_wall: cell = (periodic) must be open: walls have no images");
  refuses(
      [&] {
        (void)contact_stress(one, 1e-3, {{0, 0}, {0.05, 0.11}});
      },
      "contact_stress: control_volume = [(0, 0), (0.05, 0.11)] must not be longer than the "
      "periodic "
      "cell");
  refuses([&] { one.set_periodic(0, 0, 1); },
          "Simulation::set_periodic: axis = 0 must not be of a cell given by vectors");
  CellControl<Space<2>> control;
  control.mass(0, 1) = -1;
  refuses([&] { one.control_cell(control); },
          "Simulation::control_cell: mass = (0, -1, 0, 0) must be finite and >= 0");
  control.mass.setZero();
  control.stress = unit;
  refuses([&] { one.control_cell(control); },
          "Simulation::control_cell: mass = (0, 0, 0, 0) must be > 0 for components that follow a "
          "stress");
  World walled = world();
  walled.add_wall(Vector(1, 0), Vector(0, 0));
  CHECK_THROWS_AS(walled.set_cell(0.1 * unit), std::invalid_argument);
  World small = world();
  CHECK_THROWS_AS(small.set_cell(0.03 * unit), std::invalid_argument);
  small.set_cell(0.1 * unit);
  // A stress of a component that is held, and the two components of a shear.
  control = {};
  control.mass(1, 1) = 1;
  control.stress = unit;
  refuses([&] { one.control_cell(control); },
          "Simulation::control_cell: mass = (0, 0, 0, 1) must be > 0 for components that follow a "
          "stress");
  control.stress(0, 0) = 0;
  one.control_cell(control);
  control.stress(1, 1) = -1;
  refuses([&] { one.control_cell(control); },
          "Simulation::control_cell: stress = (0, 0, 0, -1) must pull no axis: compression is "
          "positive, and the law has no attraction");
  control.stress(1, 1) = 1;
  control.mass(0, 1) = 1;
  control.stress(0, 1) = control.stress(1, 0) = 2;
  one.control_cell(control);
  control.stress(1, 0) = 3;
  refuses([&] { one.control_cell(control); },
          "Simulation::control_cell: mass = (0, 1, 0, 1) must be > 0 for components that follow a "
          "stress");
  control = {};
  control.rate = -20 * unit;
  small.control_cell(control);
  const Vector before = small.pose(small.grain(0)).position;
  refuses([&] { small.step(0.1); },
          "Simulation::step: step x rate of the cell = 2.82842712 must be below 1");
  CHECK(small.pose(small.grain(0)).position == before);
  const auto crush = [&] {
    for (int k = 0; k < 1000; ++k) small.step(h);
  };
  CHECK_THROWS_AS(crush(), std::invalid_argument);
}
