// SPDX-License-Identifier: MIT
// Pairs have contacts up to the gap that they can close in a step, not up to the margin. No contact is missing
// that takes part in the step: all contacts up to the margin are found by another detector at the same poses, and
// those that the step did not have must stay open at the velocities after it.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <random>
#include <span>
#include <tuple>
#include <vector>

#include "moreau/io/snapshot.hpp"
#include "moreau/mesh/facet_mesh.hpp"
#include "moreau/motion/moreau_jean.hpp"
#include "moreau/sample/random_rotation.hpp"

#include "io/temporary_folder.hpp"
#include "types.hpp"
#include "world/assemblies.hpp"

using namespace moreau;
using scenes::World;

namespace {

constexpr double size = 0.02;  // [m]
constexpr double h = 1e-3;     // [s]

Tolerances wide() {
  Tolerances tolerances;
  tolerances.margin = 0.2;
  tolerances.narrows = true;
  return tolerances;
}

/// A simulation and a second detector, which finds all contacts up to the margin.
template <class ShapeT>
struct Scene {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  using Angular = typename S::Angular;
  static constexpr int up = S::dim - 1;

  World<ShapeT> world;
  std::vector<ShapeT> shapes;
  std::size_t had = 0, all = 0;  // contacts
  int repeated = 0;
  double worst =
      0;  // deepest overlap that a contact which was left out would have had after a step / size

  explicit Scene(double friction = 0.4, const ColouredOptions& options = {},
                 const Tolerances& tolerances = wide())
      : world(size, Materials<scenes::LawOf<ShapeT>>(1, scenes::LawOf<ShapeT>(friction)),
              ColouredGaussSeidel(options), tolerances) {}
  BodyId add(const ShapeT& shape, const Pose<S>& pose, const Vector& velocity = Vector::Zero(),
             const Angular& spin = Angular::Zero()) {
    shapes.push_back(shape);
    const BodyId grain = world.add_grain(world.add_shape(shape), pose, 2700);
    world.set_velocity(grain, velocity);
    world.set_spin(grain, spin);
    return grain;
  }
  StepReport step() {
    Contacts<S> found;
    find_all(found);
    const StepReport report = world.step(h);
    CHECK(report.solve.converged);
    repeated += report.repeated;
    had += world.contacts().size();
    all += found.size();
    const auto& keys = world.contacts().keys;
    const auto& velocity = world.bodies().velocity;
    const auto shifts = world.correction().shifts();
    for (std::size_t c = 0; c < found.size(); ++c) {
      if (std::binary_search(keys.begin(), keys.end(), found.keys[c])) continue;
      const Contact<S>& contact = found.points[c];
      const auto closing = [&](const auto& twist) {
        return relative_velocity(contact, twist[contact.a], twist[contact.b])[0];
      };
      const double gap = contact.gap + closing(shifts) + h * closing(velocity);
      worst = std::max(worst, -gap / size);
    }
    return report;
  }
  /// Makes steps and checks that no contact was left out that takes part, and that others were, if so expected.
  void run(int steps, bool leaves_out = true) {
    for (int k = 0; k < steps; ++k) step();
    if (leaves_out) CHECK(had < all);
    // Rotations after the step differ from those in the contact problem by terms of second order.
    CHECK(worst < 0.01);
  }

 private:
  void find_all(Contacts<S>& found) const {
    const DetectionLengths<double> lengths = wide().lengths(size);
    Bodies<S> bodies = world.bodies();
    std::vector<Angular> momentum(bodies.size());
    MoreauJean().predict_configuration(bodies, std::span(momentum), h);
    ContactDetector<ShapeT, CellGrid<S>> detector;
    std::size_t k = 0;
    for (const BodyId grain : world.grains()) detector.add_grain(grain, shapes[k++]);
    for (const BodyId wall : world.walls()) detector.add_wall(wall, HalfSpace<S>(Vector::UnitX()));
    for (const auto& cylinder : world.cylinders()) detector.add_wall(cylinder.body, cylinder.shape);
    detector.place_walls(bodies.pose);
    detector.set_cell(world.cell(), lengths, "test");
    detector.place(bodies.pose, [&](std::size_t i) -> const ShapeT& { return shapes[i]; });
    detector.find_pairs(lengths);
    detector.detect(lengths, bodies, Contacts<S>(), found);
  }
};

/// A box, in the plane a rectangle: the last edge has another length.
template <class ShapeT>
ShapeT box_of(double length, double thickness) {
  using Vector = typename SpaceOf<ShapeT>::Vector;
  Vector half = Vector::Constant(length / 2);
  half[SpaceOf<ShapeT>::dim - 1] = thickness / 2;
  return scenes::cuboid<ShapeT>(half);
}
template <class ShapeT>
ShapeT grain_of(int k) {
  if constexpr (Polytope<ShapeT>)
    return box_of<ShapeT>(size, size / (k % 3 == 0 ? 8 : 1));
  else
    return ShapeT(size / (k % 3 == 0 ? 4 : 2));
}

/// Plates and cubes on a grid, fast and spinning.
template <class ShapeT>
void add_moving_grains(Scene<ShapeT>& scene, int per_side, double speed,
                       const typename SpaceOf<ShapeT>::Vector& from) {
  using S = SpaceOf<ShapeT>;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  const int count = S::dim == 3 ? per_side * per_side * per_side : per_side * per_side;
  for (int k = 0; k < count; ++k) {
    Pose<S> pose;
    int left = k;
    typename S::Vector velocity;
    for (int axis = 0; axis < S::dim; ++axis, left /= per_side) {
      pose.position[axis] = from[axis] + 1.6 * size * (left % per_side);
      velocity[axis] = speed * unit(random);
    }
    pose.rotation = random_rotation<S>(random);
    typename S::Angular spin;
    for (double& w : spin) w = speed / size * unit(random);
    scene.add(grain_of<ShapeT>(k), pose, velocity, spin);
  }
}

}  // namespace

TEST_CASE_TEMPLATE(
    "no contact that a step needs is left out: fast, spinning grains in a periodic cell, a moving "
    "wall",
    ShapeT, MOREAU_TYPES((Polyhedron<>, Polygon<>), (Ball<>, Disk<>))) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  for (const double speed : {0.3, 3.0}) {
    Scene<ShapeT> scene;
    add_moving_grains(scene, 4, speed, Vector::Constant(0.5 * size));
    scene.world.set_periodic(0, 0, 6.4 * size);
    const int up = S::dim - 1;
    for (int axis = 1; axis < up; ++axis) {
      scene.world.add_wall(Vector::Unit(axis), -size * Vector::Unit(axis));
      scene.world.add_wall(-Vector::Unit(axis), 7 * size * Vector::Unit(axis));
    }
    scene.world.add_wall(Vector::Unit(up), -size * Vector::Unit(up));
    const BodyId lid = scene.world.add_wall(-Vector::Unit(up), 7 * size * Vector::Unit(up));
    scene.world.set_velocity(lid, -speed * Vector::Unit(up));
    scene.world.set_gravity(-9.81 * Vector::Unit(up));
    scene.run(int(0.03 / speed / h), speed < 1);  // at 3 m/s pairs need the whole margin
  }
}

TEST_CASE_TEMPLATE("no contact that a step needs is left out: grains in a turning cylinder", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Polygon<>), (Ball<>, Disk<>))) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  Scene<ShapeT> scene;
  add_moving_grains(scene, 3, 0.5, Vector::Constant(-1.6 * size));
  typename S::Angular axis = S::Angular::Zero();
  axis[S::angular_dim - 1] = 1;
  const BodyId drum = scene.world.add_cylinder(Vector::Zero(), axis, 4 * size);
  scene.world.set_spin(drum, 20 * axis);
  scene.world.set_gravity(-9.81 * Vector::Unit(1));
  scene.run(60);
}

TEST_CASE_TEMPLATE("without friction grains move as with contacts up to the margin", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Polygon<>), (Ball<>, Disk<>))) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  for (const double rate : {20.0, 200.0}) {
    std::vector<Vector> places[2];
    for (const bool narrows : {false, true}) {
      ColouredOptions options;
      options.tolerance = 1e-10;
      Tolerances tolerances = wide();
      tolerances.narrows = narrows;
      Scene<ShapeT> scene(0, options, tolerances);
      add_moving_grains(scene, 3, 0.5, Vector::Constant(-1.6 * size));
      typename S::Angular axis = S::Angular::Zero();
      axis[S::angular_dim - 1] = 1;
      scene.world.set_spin(scene.world.add_cylinder(Vector::Zero(), axis, 4 * size), rate * axis);
      const BodyId floor = scene.world.add_wall(Vector::Unit(1), -3.5 * size * Vector::Unit(1));
      scene.world.set_spin(floor, 5 * axis);
      scene.world.set_gravity(-9.81 * Vector::Unit(1));
      for (int k = 0; k < 40; ++k) scene.world.step(h);
      for (const BodyId grain : scene.world.grains())
        places[narrows].push_back(scene.world.pose(grain).position);
    }
    double farthest = 0;
    for (std::size_t k = 0; k < places[0].size(); ++k)
      farthest = std::max(farthest, (places[0][k] - places[1][k]).norm() / size);
    CHECK(farthest < 1e-6);
  }
}

TEST_CASE_TEMPLATE(
    "a hit goes on through a row in one step: the step is solved again with all contacts", ShapeT,
    MOREAU_TYPES((Polyhedron<>, Polygon<>), (Ball<>, Disk<>))) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  Scene<ShapeT> scene(0);
  for (int k = 0; k < 7; ++k) {
    Pose<S> pose;
    pose.position[0] = k * size * 1.03;
    scene.add(grain_of<ShapeT>(1), pose);
  }
  scene.step();
  CHECK(scene.had == 0);
  CHECK(scene.all >= 6);
  const BodyId first = scene.world.grains()[0];
  scene.world.set_velocity(first, 4 * Vector::UnitX());
  scene.run(20);
  CHECK(scene.repeated > 0);
  CHECK(scene.repeated < 20);
  double momentum = 0;
  for (const BodyId grain : scene.world.grains()) momentum += scene.world.velocity(grain)[0];
  CHECK(momentum == doctest::Approx(4));
}

TEST_CASE_TEMPLATE(
    "after some calm steps pairs that hardly move have no contacts over small gaps, until a hit",
    ShapeT, MOREAU_TYPES((Polyhedron<>, Polygon<>), (Ball<>, Disk<>))) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  Scene<ShapeT> scene(0);
  constexpr std::size_t count = 5;
  for (std::size_t k = 0; k < count; ++k) {  // the gaps are a thirtieth of the margin
    Pose<S> pose;
    pose.position[0] = double(k) * size * (1 + 0.2 / 30);
    scene.add(grain_of<ShapeT>(1), pose);
  }
  World<ShapeT> copy = scene.world;
  const TemporaryFolder folder("step_margins");
  const auto has_contacts = [&] { return scene.world.contacts().size() > 0; };
  for (int k = 0; k < 8; ++k) {
    scene.step();
    CHECK(has_contacts());
    if (k != 4) continue;
    write_snapshot(folder / "state", scene.world);
    reload_snapshot(folder / "state", copy);
  }
  scene.step();
  CHECK(!has_contacts());
  for (int k = 5; k < 9; ++k) {
    copy.step(h);
    CHECK((copy.contacts().size() > 0) == (k < 8));
  }
  CHECK(scene.repeated == 0);
  // A hit goes through the row in one step, which is solved again.
  scene.world.set_velocity(scene.world.grains()[0], 2 * Vector::UnitX());
  scene.run(4);
  CHECK(scene.repeated > 0);
  CHECK(scene.world.velocity(scene.world.grains()[count - 1])[0] > 0.01);
  double momentum = 0;
  for (const BodyId grain : scene.world.grains()) momentum += scene.world.velocity(grain)[0];
  CHECK(momentum == doctest::Approx(2));
}

TEST_CASE("the far end of a lever moves faster than what hits the near end") {
  using ShapeT = Polygon<>;
  using S = SpaceOf<ShapeT>;
  using Vector = S::Vector;
  Scene<ShapeT> scene;
  const auto at = [](double along, double height) {
    Pose<S> pose;
    pose.position[0] = along * size;
    pose.position[S::dim - 1] = height * size;
    return pose;
  };
  const BodyId pivot = scene.add(box_of<ShapeT>(size / 4, size / 4), at(-1.6, -0.25));
  scene.world.prescribe_motion(pivot);
  scene.add(box_of<ShapeT>(4 * size, size / 4), at(0, 0));
  const BodyId hammer = scene.add(box_of<ShapeT>(size / 4, size / 4), at(-1.95, 0.252),
                                  -0.12 * Vector::Unit(S::dim - 1));
  scene.world.prescribe_motion(hammer);
  const BodyId above = scene.add(box_of<ShapeT>(size / 4, size / 4), at(1.85, 0.38));
  scene.step();
  CHECK(scene.repeated == 1);
  CHECK(scene.worst < 0.01);
  CHECK(scene.world.velocity(above)[S::dim - 1] > 0.1);
}

TEST_CASE_TEMPLATE("a run that is continued after repeated steps has the same bits", ShapeT,
                   Polyhedron<>) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  Scene<ShapeT> scene;
  add_moving_grains(scene, 3, 2, Vector::Zero());
  scene.world.add_wall(Vector::Unit(2), -size * Vector::Unit(2));
  scene.world.set_gravity(-9.81 * Vector::Unit(2));
  World<ShapeT> copy = scene.world;
  const TemporaryFolder folder("step_margins");
  bool same = true;
  for (int k = 0; k < 20; ++k) {
    scene.world.step(h);
    write_snapshot(folder / "state", scene.world);
    reload_snapshot(folder / "state", copy);
    scene.world.step(h);
    copy.step(h);
    for (std::size_t i = 0; i < copy.bodies().size(); ++i)
      same = same && copy.bodies().velocity[i] == scene.world.bodies().velocity[i];
  }
  CHECK(same);
}

namespace {

/// Two slopes that fall to the middle, with the outside above.
FacetMesh<Space<2>> valley(Space<2>) {
  FacetMesh<Space<2>> mesh;
  mesh.vertices = {{-0.2, 0.08}, {0, 0}, {0.2, 0.08}};
  mesh.facets = {{1, 0}, {2, 1}};
  return mesh;
}
FacetMesh<Space<3>> valley(Space<3>) {
  FacetMesh<Space<3>> mesh;
  for (const double y : {-0.2, 0.2})
    for (const double x : {-0.2, 0.0, 0.2}) mesh.vertices.push_back({x, y, 0.4 * std::abs(x)});
  mesh.facets = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  return mesh;
}

}  // namespace

TEST_CASE_TEMPLATE("contacts with a mesh that act do not depend on the margins of a step", ShapeT,
                   Polyhedron<>, Polygon<>) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::size_t points = 0, deep = 0, left_out = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Pose<S> pose;
    for (auto& x : pose.position) x = 0.01 * uniform(random);
    pose.position[S::dim - 1] = 0.012 + 0.003 * uniform(random);
    pose.rotation = random_rotation<S>(random);
    const Vector velocity = 0.01 * uniform(random) * Vector::Unit(0);
    Contacts<S> found[2];
    for (const bool narrows : {false, true}) {
      Tolerances tolerances = wide();
      tolerances.narrows = narrows;
      Scene<ShapeT> scene(0.4, {}, tolerances);
      scene.world.add_mesh_wall(valley(S{}));
      scene.add(grain_of<ShapeT>(1), pose, velocity);
      scene.world.allow_overlaps();
      scene.world.step(h);
      found[narrows] = scene.world.contacts();
    }
    // Those that are left out are open by at least the smallest margin of a pair.
    std::size_t same = 0;
    for (std::size_t c = 0; c < found[0].size(); ++c) {
      const bool is_next = same < found[1].size() && found[0].keys[c] == found[1].keys[same];
      if (is_next)
        CHECK(found[0].points[c].gap ==
              doctest::Approx(found[1].points[same].gap).scale(size).epsilon(1e-9));
      else
        CHECK(found[0].points[c].gap > 0.1 * wide().margin * size);
      same += is_next;
      left_out += !is_next;
      deep += found[0].points[c].gap < -0.02 * size;
    }
    CHECK(same == found[1].size());
    points += found[0].size();
  }
  CHECK(points > 300);
  CHECK(left_out > 0);
  CHECK(deep > 100);
}
