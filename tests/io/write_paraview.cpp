// SPDX-License-Identifier: MIT
#include "moreau/io/write_paraview.hpp"

#include <algorithm>
#include <doctest/doctest.h>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>

#include "moreau/io/snapshot.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/mesh/mesh_wall.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

#include "io/temporary_folder.hpp"
#include "io/vtp.hpp"
#include "types.hpp"

using namespace moreau;

namespace {

using Law = SignoriniCoulomb<double>;

/// Two balls of radius 0.1 m, one on the other, on a floor between two walls 0.4 m apart. A third
/// wall is 1 km away.
template <class ShapeT>
struct Stack {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;
  Simulation<ShapeT, Law> world{0.2, Materials<Law>(1, Law(0.3))};

  Stack() {
    const ShapeId shape = world.add_shape(ShapeT(0.1));
    for (int k = 0; k < 2; ++k)
      world.add_grain(
          shape, {0.2 * Vector::UnitX() + (0.1 + 0.2 * k) * Vector::Unit(up), S::identity()}, 1000);
    world.add_wall(Vector::Unit(up), Vector::Zero());
    world.add_wall(Vector::UnitX(), Vector::Zero());
    world.add_wall(-Vector::UnitX(), 0.4 * Vector::UnitX());
    world.add_wall(-Vector::Unit(up), 1000 * Vector::Unit(up));
    world.set_gravity(-9.81 * Vector::Unit(up));
  }
};

std::string count(const std::filesystem::path& path, const std::string& what) {
  const std::string text = read(path), name = "NumberOf" + what + "=\"";
  const auto at = text.find(name);
  REQUIRE(at != std::string::npos);
  return text.substr(at + name.size(), text.find('"', at + name.size()) - at - name.size());
}

}  // namespace

TEST_CASE_TEMPLATE("one call writes grains, walls and contacts", ShapeT, Ball<>, Disk<>) {
  const TemporaryFolder folder("paraview");
  Stack<ShapeT> stack;
  stack.world.step(1e-3);
  write_paraview(folder / "run_0001", stack.world, 1e-3);
  CHECK(count(folder / "run_0001_grains.vtp", "Verts") == "2");
  CHECK(count(folder / "run_0001_contacts.vtp", "Lines") == "2");
  const bool plane = Stack<ShapeT>::up == 1;
  CHECK(count(folder / "run_0001_walls.vtp", plane ? "Lines" : "Polys") == "3");
  const std::string list = read(folder / "run_0001.vtm");
  for (const std::string part : {"grains", "walls", "contacts"})
    CHECK(list.find("name=\"" + part + "\" file=\"run_0001_" + part + ".vtp\"") != list.npos);

  write_paraview(folder / "named.vtm", stack.world, 1e-3, {2, false});
  CHECK(count(folder / "named_grains.vtp", "Polys") == (plane ? "2" : "640"));
  CHECK(std::filesystem::exists(folder / "named.vtm"));
}

TEST_CASE("walls end at one another, and cylinders are drawn around the grains") {
  Stack<Ball<>> stack;
  auto surfaces = detail::wall_surfaces(stack.world);
  REQUIRE(surfaces.size() == 3);
  // The box of the grains is [0.1, 0.3] x [-0.1, 0.1] x [0, 0.4] m; it is extended by 0.2 m.
  Aabb<Space<3>> floor;
  for (const auto& x : surfaces[0].faces[0]) floor.merge(x);
  CHECK(floor.lower.isApprox(Eigen::Vector3d(0, -0.3, 0), 1e-5));
  CHECK(floor.upper.isApprox(Eigen::Vector3d(0.4, 0.3, 0), 1e-5));
  const auto& face = surfaces[0].faces[0];
  REQUIRE(face.size() == 4);
  CHECK((face[1] - face[0]).cross(face[2] - face[1]).z() > 0);  // counter-clockwise from above

  const BodyId cylinder = stack.world.add_cylinder({0.2, 0, 0.2}, {0, 1, 0}, 0.5);
  surfaces = detail::wall_surfaces(stack.world);
  REQUIRE(surfaces.size() == 4);
  CHECK(surfaces[3].body == cylinder);
  Aabb<Space<3>> tube;
  for (const auto& strip : surfaces[3].faces) {
    REQUIRE(strip.size() == 4);
    for (const auto& x : strip) tube.merge(x);
  }
  CHECK(tube.lower.isApprox(Eigen::Vector3d(-0.3, -0.3, -0.3)));
  CHECK(tube.upper.isApprox(Eigen::Vector3d(0.7, 0.3, 0.7)));

  Stack<Disk<>> flat;
  flat.world.add_cylinder({0.2, 0.2}, Space<2>::Angular(1), 0.5);
  const auto lines = detail::wall_surfaces(flat.world);
  REQUIRE(lines.size() == 4);
  CHECK(lines[0].faces[0].size() == 2);
  CHECK(lines[3].faces.size() == 64);
  for (const auto& segment : lines[3].faces) {
    REQUIRE(segment.size() == 2);
    CHECK((segment[0] - Eigen::Vector2d(0.2, 0.2)).norm() == doctest::Approx(0.5));
  }
}

TEST_CASE("a grain and its contacts are drawn at their place in the periodic cell") {
  using S = Space<2>;
  Simulation<Disk<>, Law> world(0.2, Materials<Law>(1, Law(0.3)));
  world.set_periodic(0, 0, 1);
  world.add_grain(world.add_shape(Disk<>(0.1)), {{3.25, 0.1}, S::identity()}, 1000);
  const Aabb<S> box = detail::box_of_grains(world);
  CHECK(box.lower.isApprox(Eigen::Vector2d(0.15, 0)));
  CHECK(box.upper.isApprox(Eigen::Vector2d(0.35, 0.2)));
}

TEST_CASE_TEMPLATE("forces are those of the last step; a step in ms is refused", ShapeT,
                   MOREAU_TYPES((Disk<>), (Ball<>))) {
  const TemporaryFolder folder("paraview");
  Stack<ShapeT> stack;
  auto& world = stack.world;
  write_paraview(folder / "before", world);  // no contacts yet
  for (int k = 0; k < 20; ++k) world.step(1e-4);
  write_paraview(folder / "rest", world);
  const double weight = 9.81 * world.bodies().grain_mass[world.grain(0).index()];
  auto force = Vtp(folder / "rest_contacts.vtp").array<float>("CellData", "normal_force");
  std::sort(force.begin(), force.end());
  REQUIRE(force.size() == 2);
  CHECK(double(force[0]) == doctest::Approx(weight).epsilon(1e-3));
  CHECK(double(force[1]) == doctest::Approx(2 * weight).epsilon(1e-3));
  write_paraview(folder / "given", world, 1e-4);
  CHECK(read(folder / "given_contacts.vtp") == read(folder / "rest_contacts.vtp"));
  CHECK_THROWS_WITH_AS(write_paraview(folder / "ms", world, 0.1),
                       doctest::Contains("write_paraview: step / last step"),
                       std::invalid_argument);
  CHECK_FALSE(std::filesystem::exists(folder / "ms.vtm"));
  // A snapshot does not contain the length of the step.
  restore_snapshot(snapshot(world), world);
  CHECK(world.last_step() == 0);
  CHECK_THROWS_WITH_AS(
      write_paraview(folder / "read", world),
      doctest::Contains("write_paraview: contacts = 2 need the length of the step"),
      std::invalid_argument);
  write_paraview(folder / "read", world, 1e-4);
  CHECK(read(folder / "read_contacts.vtp") == read(folder / "rest_contacts.vtp"));
}

TEST_CASE("a simulation without grains is written; bad arguments are errors") {
  const TemporaryFolder folder("paraview");
  Simulation<Disk<>, Law> world(0.2, Materials<Law>(1, Law(0.3)));
  world.add_wall({0, 1}, {0, 0});
  write_paraview(folder / "empty", world);
  CHECK(count(folder / "empty_walls.vtp", "Lines") == "0");
  // Mesh walls have bounds of their own: the first file of a run that a source fills shows them.
  FacetMesh<Space<2>> mesh;
  mesh.vertices = {{0, 0}, {1, 0}, {1, 1}};
  mesh.facets = {{0, 1}, {1, 2}};
  world.add_mesh_wall(mesh, {}, WallSides::both);
  write_paraview(folder / "empty", world);
  CHECK(count(folder / "empty_walls.vtp", "Lines") == "2");
  CHECK_THROWS_WITH_AS(write_paraview(folder / "a<b", world), doctest::Contains("write_paraview"),
                       std::invalid_argument);
  CHECK_THROWS_AS(write_paraview(folder / "", world), std::invalid_argument);
  CHECK_THROWS_WITH_AS(write_paraview(folder / "a", world, 0), doctest::Contains("step = 0"),
                       std::invalid_argument);
  CHECK_THROWS_AS(write_paraview(folder / "a", world, 1, {-1}), std::invalid_argument);
  CHECK_THROWS_WITH_AS(write_paraview(folder / "missing" / "a", world),
                       doctest::Contains("missing"), std::system_error);
}
