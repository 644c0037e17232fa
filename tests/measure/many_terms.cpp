// SPDX-License-Identifier: MIT
// Measures add up in double precision: a million equal numbers have a sum in float that is wrong by 1 %.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <doctest/doctest.h>
#include <span>
#include <vector>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/measure/energy.hpp"
#include "moreau/measure/fabric.hpp"
#include "moreau/measure/force_distribution.hpp"
#include "moreau/measure/grid_field.hpp"
#include "moreau/measure/overlap.hpp"
#include "moreau/measure/region.hpp"
#include "moreau/measure/solid_fraction.hpp"
#include "moreau/measure/stress.hpp"
#include "moreau/measure/velocity_field.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"
#include "moreau/world/detail/cell/cell_jumps.hpp"
#include "moreau/world/simulation.hpp"

using namespace moreau;

namespace {

constexpr std::size_t many = 1000000;
constexpr double rounding = 1e-6;  // of a result in float

doctest::Approx near(double value) {
  return doctest::Approx(value).epsilon(rounding);
}

/// A box from 0 to 1.
template <class S>
Aabb<S> unit_box() {
  return {S::Vector::Zero(), S::Vector::Ones()};
}

}  // namespace

TEST_CASE_TEMPLATE("a million grains in single precision: energy, momentum, fields", S,
                   Space<2, float>, Space<3, float>) {
  using Vector = typename S::Vector;
  BodyMotion<S> body;
  body.mass = 0.1f;
  body.inertia = S::Inertia::Identity() * 0.1f;
  body.velocity = S::Twist::Ones();
  const auto motion_of = [&](std::size_t) { return body; };
  const KineticEnergy<S> energy = kinetic_energy<S>(many, motion_of), one = kinetic_energy<S>(body);
  CHECK(double(energy.translation) == near(double(one.translation) * many));
  CHECK(double(energy.rotation) == near(double(one.rotation) * many));
  const Momentum<S> sum = momentum<S>(many, motion_of), part = momentum<S>(body);
  CHECK(double(sum.linear[0]) == near(double(part.linear[0]) * many));
  CHECK(double(sum.angular[0]) == near(double(part.angular[0]) * many));

  GridField<S> grid(unit_box<S>(), Eigen::Matrix<std::size_t, S::dim, 1>::Ones());
  VelocityField<S> field(unit_box<S>(), 1, 1);
  const Vector middle = Vector::Constant(0.5f), velocity = Vector::Constant(0.3f);
  for (std::size_t k = 0; k < many; ++k) {
    grid.add(middle, velocity, 0.1f);
    field.add(middle, velocity);
  }
  CHECK(double(grid.sample(0).value[0]) == near(0.3));
  CHECK(double(grid.sample(0).weight) == near(0.1 * many));
  CHECK(double(field.sample(0, 0).velocity[1]) == near(0.3));
}

TEST_CASE_TEMPLATE("a million contacts in single precision: stress, fabric, overlaps, forces", S,
                   Space<2, float>, Space<3, float>) {
  using Vector = typename S::Vector;
  Contact<S> point{0,
                   1,
                   0,
                   -0.1f,
                   S::contact_frame(Vector::Constant(1 / std::sqrt(float(S::dim)))),
                   Vector::Constant(0.1f),
                   Vector::Constant(-0.1f)};
  Contacts<S> contacts;
  contacts.points.assign(many, point);
  for (std::uint32_t k = 0; k < many; ++k) contacts.points[k].b = k + 1;
  contacts.impulses.assign(many, Vector(0.1f * Vector::UnitX()));
  const auto position_of = [](std::uint32_t) { return Vector(Vector::Constant(0.4f)); };
  const auto is_grain = [](std::uint32_t) { return true; };
  const typename S::Matrix stress =
      contact_stress<S>(contacts, 1, unit_box<S>(), position_of, is_grain);
  CHECK(double(stress(0, 1)) == near(0.2 * 0.1 / std::sqrt(double(S::dim)) * many));
  CHECK(double(contacts.impulse_on(0)[1]) == near(-0.1 / std::sqrt(double(S::dim)) * many));

  const auto of_cell = detail::CellJumps<S>::moment_of_contacts(
      contacts, [&](std::size_t c) { return Vector(contacts.impulses[c]); }, 1);
  CHECK(double(of_cell(0, 1)) == near(0.2 * 0.1 / std::sqrt(double(S::dim)) * many));

  PairForce<S> pair{};
  pair.normal = point.frame.col(0);
  pair.lever_a = point.lever_a;
  const std::vector<PairForce<S>> pairs(many, pair);
  const Fabric<S> found =
      fabric<S>(std::span<const PairForce<S>>(pairs), unit_box<S>(), position_of, is_grain);
  CHECK(double(found.tensor(0, 1)) == near(1. / S::dim));

  const OverlapStatistics<float> overlaps =
      overlap_statistics<S>(std::span<const Contact<S>>(contacts.points));
  CHECK(double(overlaps.mean) == near(0.1));
  CHECK(double(overlaps.mean_of_pairs) == near(0.1));

  const auto forces = force_distribution<float>(
      many, [](std::size_t k) { return k % 10 == 0 ? 2.8f : 0.8f; }, 24, 2.4f);
  CHECK(double(forces.mean) == near(1));
  CHECK(double(forces.beyond) == near(0.1));
  CHECK(double(forces.density[8] * forces.width) == near(0.9));
}

TEST_CASE_TEMPLATE("a million images in single precision: solid fraction and regions", ShapeT,
                   Disk<float>, Ball<float>) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  using Law = SignoriniCoulomb<float>;
  // No step is made: the solver that takes least to compile.
  using World = Simulation<ShapeT, Law, MoreauJean, CellGrid<S>, NonlinearGaussSeidel>;
  constexpr float radius = 0.2f;
  const ShapeT shape(radius);
  // Each grain lies in the middle of a cell of 1 m.
  const int along = S::dim == 2 ? 1000 : 100;
  const Aabb<S> box{Vector::Zero(), Vector::Constant(float(along))};
  const double whole = double(shape.volume());
  ClipWorkspace<S> workspace;
  CHECK(double(solid_fraction<S>(
            box, many, [&](std::size_t) -> const ShapeT& { return shape; },
            [](std::size_t) { return Pose<S>(Vector(Vector::Constant(1))); }, workspace)) ==
        near(whole));
  World images(0.4f, Law(0.5f));
  for (int axis = 0; axis < S::dim; ++axis) images.set_periodic(axis, 0, 1);
  images.add_grain(images.add_shape(shape), Pose<S>(Vector(Vector::Constant(0.5f))), 1);
  CHECK(double(solid_fraction(images, box)) == near(whole));

  // The same along the vectors of a lattice; a grain so far away that the next cell has the same number.
  World lattice(0.4f, Law(0.5f));
  lattice.set_cell(S::Matrix::Identity());
  lattice.add_grain(lattice.add_shape(shape), Pose<S>(Vector(Vector::Constant(0.5f))), 1);
  CHECK(double(solid_fraction(lattice, box)) == near(whole));
  images.set_pose(images.grain(0), Pose<S>(Vector(Vector::Constant(0x1p25f))));
  CHECK(double(solid_fraction(images, unit_box<S>())) > 0);

  World grains(0.4f, Law(0.5f));
  const ShapeId id = grains.add_shape(shape);
  for (int k = 0; k < 100000; ++k)
    grains.set_velocity(grains.add_grain(id, Pose<S>(Vector(Vector::Constant(0.5f))), 0.1f),
                        Vector::Constant(0.3f));
  CHECK(double(measure_region(grains, 1, box).velocity[0]) == near(0.3));
}
