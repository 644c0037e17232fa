// SPDX-License-Identifier: MIT
// A gas in a cell that is periodic along all axes.
#include <cmath>
#include <doctest/doctest.h>
#include <random>

#include "boundary/grain_of_radius.hpp"
#include "world/assemblies.hpp"

using namespace moreau;

namespace {

using Law = moreau::SignoriniCoulomb<double>;

}  // namespace

TEST_CASE_TEMPLATE("gas in a cell periodic along all axes: momentum and energy stay", ShapeT,
                   Polyhedron<>, Polygon<>, moreau::Ball<>, moreau::Disk<>) {
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  scenes::World<ShapeT> gas(0.02, moreau::Materials<Law>(1, Law(0.3, 0.9)));
  std::mt19937_64 random(11);
  std::normal_distribution<double> speed(0, 0.5);
  const int side = S::dim == Space<2>::dim ? 5 : 3;
  for (int axis = 0; axis < S::dim; ++axis) gas.set_periodic(axis, -0.01, -0.01 + 0.03 * side);
  const auto shape = gas.add_shape(grain_of_radius<ShapeT>(0.008));
  for (int k = 0; k < std::pow(side, int(S::dim)); ++k) {
    Pose<S> pose;
    Vector velocity;
    for (int axis = 0, rest = k; axis < S::dim; ++axis, rest /= side) {
      pose.position[axis] = 0.03 * (rest % side);
      velocity[axis] = speed(random);
    }
    gas.set_velocity(gas.add_grain(shape, pose, 1000), velocity);
  }
  const auto momentum = [&] {
    Vector sum = Vector::Zero();
    for (std::size_t k = 0; k < gas.grain_count(); ++k)
      sum += gas.bodies().grain_mass[k] * gas.bodies().velocity[k].template head<S::dim>();
    return sum;
  };
  const Vector before = momentum();
  double scale = 0, lost = 0;
  for (std::size_t k = 0; k < gas.grain_count(); ++k)
    scale += gas.bodies().grain_mass[k] * gas.bodies().velocity[k].norm();
  std::size_t points = 0, elsewhere = 0;
  for (int k = 0; k < 1000; ++k) {
    const auto report = gas.step(2e-4);
    points += report.points;
    lost += report.dissipation;
  }
  CHECK((momentum() - before).norm() < 1e-13 * scale);
  CHECK(points > 100);
  CHECK(lost > 0);
  for (const auto& pose : gas.bodies().pose)
    elsewhere += (gas.cell().wrap(pose.position) - pose.position).norm() > 1e-9;
  CHECK(elsewhere > gas.grain_count() / 3);
}
