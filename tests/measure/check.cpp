// SPDX-License-Identifier: MIT
// Wrong settings that give results which look right are reported.
#include "moreau/measure/check.hpp"

#include <doctest/doctest.h>
#include <string>
#include <vector>

#include "moreau/law/compliant.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/world/simulation.hpp"

using namespace moreau;

namespace {

using Law = SignoriniCoulomb<>;
using World = Simulation<Polyhedron<double>, Law>;

/// A cube with edges of 2 cm.
Polyhedron<double> cube_shape() {
  std::vector<Eigen::Vector3d> corners;
  for (const double x : {-0.01, 0.01})
    for (const double y : {-0.01, 0.01})
      for (const double z : {-0.01, 0.01}) corners.emplace_back(x, y, z);
  return Polyhedron<double>(corners);
}

/// The cube above a floor.
World cube(double grain_size, double height) {
  World world(grain_size, Materials<Law>(1, Law(0.5)));
  Pose<Space<3>> pose;
  pose.position = {0, 0, height};
  world.add_grain(world.add_shape(cube_shape()), pose, 2000);
  world.add_wall({0, 0, 1}, {0, 0, 0});
  world.set_gravity({0, 0, -9.81});
  return world;
}

/// All sentences of a run.
std::vector<std::string> run(World& world, double step, int steps) {
  std::vector<std::string> all;
  for (int k = 0; k < steps; ++k)
    for (const std::string& sentence : check(world, world.step(step))) all.push_back(sentence);
  return all;
}

bool one_contains(const std::vector<std::string>& all, const char* text) {
  for (const std::string& sentence : all)
    if (sentence.find(text) != std::string::npos) return true;
  return false;
}

}  // namespace

TEST_CASE("check: nothing is said about a cube that falls on a floor in short steps") {
  World world = cube(0.02, 0.02);
  CHECK(run(world, 5e-4, 400).empty());
}

TEST_CASE("check: a step too long for the speeds") {
  World world = cube(0.02, 0.5);
  const auto all = run(world, 0.05, 10);
  CHECK(one_contains(all, "step too long"));
  CHECK(one_contains(all, "overlap of"));
}

TEST_CASE("check: a grain size in millimetres") {
  World world = cube(20, 0.02);
  CHECK(one_contains(run(world, 1e-3, 1), "grain size 20 m, but the smallest grain"));
}

TEST_CASE("check: a grain inside another") {
  World world = cube(0.02, 0.01);
  Pose<Space<3>> pose;
  pose.position = {0, 0, 0.025};
  world.add_grain(world.add_shape(cube_shape()), pose, 2000);
  CHECK(one_contains(run(world, 1e-3, 1), "overlap of 0.005 m"));
}

TEST_CASE("check: a tolerance that says little about the forces of stiff contacts") {
  using Soft = Compliant<Law>;
  ColouredOptions options;
  options.tolerance = 1e-2;
  Simulation<Polyhedron<double>, Soft> world(0.02, Materials<Soft>(1, Soft(Law(0.5), 1e9)),
                                             ColouredGaussSeidel(options));
  const ShapeId shape = world.add_shape(cube_shape());
  for (int k = 0; k < 12; ++k) {
    Pose<Space<3>> pose;
    pose.position = {0.002 * (k % 3), 0, 0.01 + 0.0201 * k};
    world.add_grain(shape, pose, 2000);
  }
  world.add_wall({0, 0, 1}, {0, 0, 0});
  world.set_gravity({0, 0, -9.81});
  std::vector<std::string> all;
  for (int k = 0; k < 50; ++k)
    for (const std::string& sentence : check(world, world.step(1e-3))) all.push_back(sentence);
  CHECK(one_contains(all, "of the relative compliance"));
}
