// SPDX-License-Identifier: MIT
// Checks that a step allocates no memory after the first steps. Calls of operator new are counted.
// Eigen calls malloc directly; its runtime check asserts that it does not.
#include <cstddef>
#include <cstdint>
#include <doctest/doctest.h>
#include <new>

#include "allocation/counted_new.hpp"
#include "sanitized.hpp"
#include "types.hpp"
#include "world/assemblies.hpp"
#include "world/compound_box.hpp"

TEST_CASE("every form of new is counted") {
  struct alignas(128) Wide {
    char bytes[128];
  };
  // The pointer is stored in a volatile variable. Otherwise the compiler may remove the pair of new
  // and delete.
  void* volatile seen = nullptr;
  const auto keep = [&](auto* p) {
    seen = p;
    return p;
  };
  const long before = allocations;
  delete keep(new int);
  delete[] keep(new int[3]);
  delete keep(new Wide);
  delete[] keep(new Wide[3]);
  delete keep(new (std::nothrow) int);
  delete[] keep(new (std::nothrow) int[3]);
  delete keep(new (std::nothrow) Wide);
  delete[] keep(new (std::nothrow) Wide[3]);
  CHECK(allocations == before + 8);
}

TEST_CASE_TEMPLATE("a packing at rest steps without allocating", ShapeT, moreau::Polyhedron<>,
                   moreau::Polygon<>, moreau::Ball<>, moreau::Disk<>) {
  scenes::BoxOfGrains<ShapeT> scene(std::size_t(rounds(27)));
  for (int k = 0; k < 1500; ++k) scene.simulation.step(5e-4);
  const long before = allocations;
  Eigen::internal::set_is_malloc_allowed(false);
  for (int k = 0; k < rounds(200); ++k) scene.simulation.step(5e-4);
  Eigen::internal::set_is_malloc_allowed(true);
  CHECK(allocations == before);
}

TEST_CASE_TEMPLATE("nor do compound grains", Part,
                   MOREAU_TYPES((moreau::Polygon<>), (moreau::Polyhedron<>))) {
  scenes::CompoundBox<Part> box(std::size_t(rounds(12)), true);
  box.run(1500);
  const long before = allocations;
  Eigen::internal::set_is_malloc_allowed(false);
  box.run(rounds(200));
  Eigen::internal::set_is_malloc_allowed(true);
  CHECK(allocations == before);
}

TEST_CASE_TEMPLATE("nor does one that drifts through a periodic cell, in a cylinder", ShapeT,
                   moreau::Polyhedron<>, moreau::Ball<>) {
  using S = moreau::Space<3>;
  using Law = scenes::LawOf<ShapeT>;
  const S::Vector drift(0, 0.5, 0);
  scenes::World<ShapeT> world(0.02, moreau::Materials<Law>(1, Law(0.4)));
  world.set_periodic(1, 0, 0.08);
  // Two shapes, of different numbers of vertices and faces.
  std::vector<moreau::ShapeId> shapes;
  if constexpr (std::is_constructible_v<ShapeT, double>) {
    shapes = {world.add_shape(ShapeT(0.01)), world.add_shape(ShapeT(0.009))};
  } else {
    shapes = {world.add_shape(scenes::cuboid<ShapeT>(S::Vector::Constant(0.008))),
              world.add_shape(moreau::regular_shape<ShapeT>(0.016))};
  }
  for (int k = 0; k < 12; ++k) {
    const S::Vector x(0.022 * (k % 3 - 1), 0.02 * (k / 3), -0.03);
    world.set_velocity(world.add_grain(shapes[std::size_t(k) % 2], {x, S::identity()}, 2700),
                       drift);
  }
  world.set_velocity(world.add_cylinder(S::Vector::Zero(), S::Vector::UnitY(), 0.06), drift);
  world.set_gravity(S::Vector(0, 0, -9.81));
  for (int k = 0; k < 1500; ++k) world.step(5e-4);
  const long before = allocations;
  Eigen::internal::set_is_malloc_allowed(false);
  for (int k = 0; k < rounds(400); ++k) world.step(5e-4);
  Eigen::internal::set_is_malloc_allowed(true);
  CHECK(allocations == before);
  CHECK(world.contacts().size() >= 12);
}

TEST_CASE_TEMPLATE("nor does one in which grains are removed and added", ShapeT,
                   moreau::Polyhedron<>, moreau::Disk<>) {
  scenes::BoxOfGrains<ShapeT> scene(std::size_t(rounds(18)));
  auto& world = scene.simulation;
  using S = typename scenes::BoxOfGrains<ShapeT>::S;
  const auto shape = world.add_shape(moreau::regular_shape<ShapeT>(0.015));
  const moreau::Pose<S> pose(S::Vector::Constant(0.04) + 0.3 * S::Vector::Unit(S::dim - 1),
                             S::identity());
  moreau::BodyId guest = world.add_grain(shape, pose, 2700);
  const auto cycle = [&] {
    for (int k = 0; k < 100; ++k) world.step(5e-4);
    world.remove_grain(guest);
    for (int k = 0; k < 10; ++k) world.step(5e-4);
    guest = world.add_grain(shape, pose, 2700);
  };
  for (int k = 0; k < 15; ++k) cycle();
  const long before = allocations;
  Eigen::internal::set_is_malloc_allowed(false);
  for (int k = 0; k < rounds(5); ++k) cycle();
  Eigen::internal::set_is_malloc_allowed(true);
  CHECK(allocations == before);
}

TEST_CASE_TEMPLATE("a mesh wall needs few bytes for a grain that is not near it", ShapeT,
                   moreau::Ball<>, moreau::Disk<>) {
  using S = moreau::SpaceOf<ShapeT>;
  using Law = scenes::LawOf<ShapeT>;
  constexpr std::size_t grains = 2000, meshes = 10;
  moreau::FacetMesh<S> mesh;  // one facet
  for (int k = 0; k < S::dim; ++k) mesh.vertices.push_back(0.1 * S::Vector::Unit(k));
  auto& facet = mesh.facets.emplace_back();
  for (std::size_t k = 0; k < facet.size(); ++k) facet[k] = std::uint32_t(k);
  const auto bytes = [&](bool has_meshes) {
    scenes::World<ShapeT> world(0.02, moreau::Materials<Law>(1, Law(0.4)));
    const auto shape = world.add_shape(ShapeT(0.01));
    for (std::size_t k = 0; k < grains; ++k)
      world.add_grain(
          shape, moreau::Pose<S>(typename S::Vector((1 + 0.1 * double(k)) * S::Vector::Unit(0))),
          2700);
    for (std::size_t k = 0; has_meshes && k < meshes; ++k) world.add_mesh_wall(mesh);
    const std::size_t before = bytes_asked_for;
    for (int k = 0; k < 3; ++k) world.step(1e-4);
    return bytes_asked_for - before;
  };
  CHECK(double(bytes(true) - bytes(false)) < 12. * grains * meshes);
}
