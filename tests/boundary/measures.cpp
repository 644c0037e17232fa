// SPDX-License-Identifier: MIT
// Measures that use the branches between grains, across a periodic boundary.
#include <doctest/doctest.h>
#include <vector>

#include "moreau/measure/coordination.hpp"
#include "moreau/measure/force_chains.hpp"
#include "moreau/measure/stress.hpp"
#include "moreau/measure/velocity_field.hpp"

#include "world/assemblies.hpp"

using moreau::Aabb;
using moreau::Pose;
using moreau::Space;
using moreau::Sphere;

namespace {

using Law = moreau::SignoriniCoulomb<double>;

template <class S>
auto position_of(const auto& simulation) {
  return [&](std::uint32_t body) ->
         typename S::Vector { return simulation.bodies().pose[body].position; };
}

}  // namespace

TEST_CASE_TEMPLATE("measures see contacts across the boundary", ShapeT, Sphere<Space<3>>,
                   Sphere<Space<2>>) {
  // A chain of three balls that closes through the boundary, squeezed by a shorter cell.
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  const double h = 1e-3, radius = 0.1, overlap = 1e-4;
  moreau::OverlapCorrectionOptions off;
  off.enabled = false;
  scenes::World<ShapeT> ring(0.2, moreau::Materials<Law>(1, Law(0.3)),
                             moreau::ColouredGaussSeidel(), {}, off);
  const double length = 3 * (2 * radius - overlap);
  ring.set_periodic(0, 0, length);
  const auto shape = ring.add_shape(ShapeT(radius));
  for (int k = 0; k < 3; ++k) {
    Pose<S> pose;
    pose.position[0] = 0.05 + (k - 4) * length / 3;  // outside of the cell
    ring.add_grain(shape, pose, 1000);
  }
  // Each pushes on the next: the velocities close all three contacts.
  ring.step(h);
  REQUIRE(ring.contacts().size() == 3);
  auto contacts = ring.contacts();
  for (Vector& impulse : contacts.impulses) impulse = 2 * Vector::UnitX();
  const auto is_grain = [](std::uint32_t) { return true; };
  Aabb<S> volume;
  volume.lower.setConstant(-0.5);
  volume.upper.setConstant(0.5);
  volume.lower[0] = 0.3;  // not the cell's own bounds
  volume.upper[0] = 0.3 + length;
  const auto stress =
      moreau::contact_stress(contacts, h, volume, position_of<S>(ring), is_grain, ring.cell());
  // A chain that carries the force f: f per cross-section.
  CHECK(stress(0, 0) == doctest::Approx(2 / h));
  moreau::CoordinationCounter<S> counter;
  CHECK(counter.count(contacts.points, contacts.impulses, 3, is_grain).neighbours == 2);
  std::vector<moreau::ContactSegment<S>> segments;
  moreau::force_chains(contacts, h, position_of<S>(ring), is_grain, segments, ring.cell());
  REQUIRE(segments.size() == 3);
  for (const auto& segment : segments) {
    CHECK((segment.to - segment.from).norm() == doctest::Approx(length / 3));
    CHECK((segment.from - segment.point).norm() < radius);
    CHECK((segment.to - segment.point).norm() < radius);
  }
  moreau::VelocityField<S> field(volume, 3, 1);
  for (std::uint32_t k = 0; k < 3; ++k)
    field.add(ring.bodies().pose[k].position, Vector::UnitX(), ring.cell());
  for (std::size_t column = 0; column < 3; ++column) CHECK(field.sample(column, 0).grains == 1);
}
