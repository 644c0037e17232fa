// SPDX-License-Identifier: MIT
// Compound grains in exact cases: free flight, sliding, rest, thresholds of tipping and rolling.
#include "moreau/shape/compound.hpp"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <initializer_list>
#include <numbers>
#include <span>
#include <vector>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/world/simulation.hpp"

#include "instances/compound.hpp"
#include "sanitized.hpp"
#include "shape/compounds.hpp"
#include "types.hpp"

using namespace moreau;

namespace {

using Law = SignoriniCoulomb<>;

/// A grain of size about 1 on a floor, under gravity 10 tilted by an angle towards the first axis.
template <class Grain>
struct OnFloor {
  using S = SpaceOf<Grain>;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;

  Simulation<Grain, Law> world;
  BodyId grain;

  OnFloor(const Grain& shape, double lowest, double friction, double angle)
      : world(1, Materials<Law>(1, Law(friction)), options()) {
    world.set_contact_points(ContactPoints::all);
    grain = world.add_grain(world.add_shape(shape), {Vector(-lowest * Vector::Unit(up))}, 1000);
    world.add_wall(Vector::Unit(up), Vector::Zero());
    world.set_gravity(compounds::point<S>(10 * std::sin(angle), -10 * std::cos(angle)));
  }
  static ColouredGaussSeidel options() {
    ColouredOptions options;
    options.tolerance = 1e-10;
    return ColouredGaussSeidel(options);
  }
  /// The distance of the axes of the grain from those of the world: its rotation [rad] times the root
  /// of 2, if it is small.
  double turn() const {
    return (world.pose(grain).rotation.toRotationMatrix() - S::Matrix::Identity()).norm();
  }
  void run(double time, double h = 1e-3) {
    const double end = world.time() + time;
    while (world.time() < end) world.step(h);
  }
};

/// Height of the lowest corner in the frame of the grain [m].
template <class Part>
double lowest(const Compound<Part>& grain) {
  double least = 1;
  for (const auto& x : compounds::corners(grain)) least = std::min(least, x[x.size() - 1]);
  return least;
}

/// A cube with edges of 1 m.
template <class Part>
Part unit_cube() {
  using Vector = typename SpaceOf<Part>::Vector;
  return compounds::box<Part>(Vector::Constant(-0.5), Vector::Constant(0.5));
}

/// A convex shape as a grain of two parts, cut by the plane through a point with the normal (0.6, 0.8)
/// in the plane of the first and the last axis.
template <class Part>
Compound<Part> cut_in_two(const Part& shape, const typename SpaceOf<Part>::Vector& through) {
  const auto parts =
      compounds::halves<Part>(shape, compounds::point<SpaceOf<Part>>(0.6, 0.8), through);
  return Compound<Part>{std::span<const Part>(parts)};
}

/// Checks for each share that a grain on a floor stands if the share is below 1, and tips if it is
/// above: scene_of(share) is the OnFloor.
template <class SceneOf>
void check_tips_above_one(std::initializer_list<double> shares, const SceneOf& scene_of) {
  for (const double share : shares) {
    auto scene = scene_of(share);
    scene.run(2.0 / sanitizer_share);
    CAPTURE(share);
    if (share < 1)
      CHECK(scene.turn() < 1e-7);
    else
      CHECK(scene.turn() > 0.01);
  }
}

}  // namespace

TEST_CASE_TEMPLATE("a cube cut in two flies as the cube", Part,
                   MOREAU_TYPES((Polygon<>), (Polyhedron<>))) {
  using S = SpaceOf<Part>;
  const Part cube = unit_cube<Part>();
  const Compound<Part> cut = cut_in_two(cube, compounds::point<S>(0.1, 0.02));
  OnFloor<Part> whole(cube, -100, 0.5, 0);
  OnFloor<Compound<Part>> halves(cut, -100, 0.5, 0);
  whole.world.set_spin(whole.grain, S::Angular::Constant(2));
  halves.world.set_spin(halves.grain, S::Angular::Constant(2));
  whole.run(1);
  halves.run(1);
  const auto &a = whole.world.pose(whole.grain), &b = halves.world.pose(halves.grain);
  CHECK((a.position - b.position).norm() < 1e-12 * a.position.norm());
  CHECK((a.rotation.toRotationMatrix() - b.rotation.toRotationMatrix()).norm() < 1e-12);
}

// With the contact points of the two halves the problem has more unknowns, and the same motion.
TEST_CASE_TEMPLATE("a cube cut in two slides as the cube", Part,
                   MOREAU_TYPES((Polygon<>), (Polyhedron<>))) {
  using S = SpaceOf<Part>;
  const Part cube = unit_cube<Part>();
  const Compound<Part> cut = cut_in_two(cube, compounds::point<S>(0.1, 0.02));
  OnFloor<Part> whole(cube, -0.5, 0.3, 0.1);
  OnFloor<Compound<Part>> halves(cut, -0.5, 0.3, 0.1);
  whole.world.set_velocity(whole.grain, compounds::point<S>(1, 0));
  halves.world.set_velocity(halves.grain, compounds::point<S>(1, 0));
  for (int k = 0; k < rounds(800); ++k) {
    whole.world.step(1e-3);
    halves.world.step(1e-3);
  }
  const auto &a = whole.world.pose(whole.grain), &b = halves.world.pose(halves.grain);
  CHECK((a.position - b.position).norm() < 1e-8);
  CHECK(a.position[0] > 0.2);
  CHECK(halves.turn() < 1e-8);
}

// A letter gamma with a column of width 1 and a beam of length b, both 1 high, tips over the edge of
// the column if its centre of mass lies beyond: (1 + b^2) / (2 (1 + b)) = 1, b = 1 + sqrt(2).
TEST_CASE_TEMPLATE("a gamma stands or tips as its centre of mass says", Part,
                   MOREAU_TYPES((Polygon<>), (Polyhedron<>))) {
  check_tips_above_one({0.99, 1.01}, [](double share) {
    const auto gamma = compounds::gamma<Part>(share * (1 + std::numbers::sqrt2));
    return OnFloor<Compound<Part>>(gamma, lowest(gamma), 0.8, 0);
  });
}

// On a slope an L tips about the edge of its foot as soon as the direction of gravity from its centre
// of mass passes outside of it.
TEST_CASE_TEMPLATE("an L stands on a slope or tips", Part,
                   MOREAU_TYPES((Polygon<>), (Polyhedron<>))) {
  using S = SpaceOf<Part>;
  const Compound<Part> l(
      {compounds::box<Part>(compounds::point<S>(0, 0), compounds::point<S>(2, 1, 1)),
       compounds::box<Part>(compounds::point<S>(0, 1), compounds::point<S>(1, 3, 1))});
  const auto centre = l.centroid_of_input();
  const double angle = std::atan2(2 - centre[0], centre[S::dim - 1]);
  check_tips_above_one({0.99, 1.01}, [&](double share) {
    return OnFloor<Compound<Part>>(l, lowest(l), 2, share * angle);
  });
}

// A tetrapod (in the plane a tripod) stands on its lower feet. It tips over the edge between two of
// their corners that the slope points to.
TEST_CASE_TEMPLATE("a tetrapod stands on a slope or tips", Part,
                   MOREAU_TYPES((Polygon<>), (Polyhedron<>))) {
  using S = SpaceOf<Part>;
  const auto tetrapod = compounds::tetrapod<Part>(0.3);
  const double low = lowest(tetrapod);
  // Where gravity through the centre of mass leaves the hull of the feet, along the first axis.
  double reach = 0;
  std::vector<typename S::Vector> feet;
  for (const auto& x : compounds::corners(tetrapod))
    if (x[S::dim - 1] < low + 1e-9) feet.push_back(x);
  for (const auto& x : feet)
    for (const auto& y : feet) {
      if (x[1] * y[1] > 0 && S::dim > 2) continue;
      const double share = S::dim > 2 && x[1] != y[1] ? x[1] / (x[1] - y[1]) : 0;
      reach = std::max(reach, x[0] + share * (y[0] - x[0]));
    }
  const double angle = std::atan2(reach, -low);
  REQUIRE(angle > 0.1);
  check_tips_above_one({0.0, 0.98, 1.02}, [&](double share) {
    return OnFloor<Compound<Part>>(tetrapod, low, 3, share * angle);
  });
}

// A regular hexagon (in space a prism) of two halves rolls down a slope steeper than 30 degrees, over
// one edge after the other, and stays on a slope less steep.
TEST_CASE_TEMPLATE("a hexagon of two halves rolls on a slope of more than 30 degrees", Part,
                   MOREAU_TYPES((Polygon<>), (Polyhedron<>))) {
  using S = SpaceOf<Part>;
  std::vector<typename S::Vector> corners;
  for (int k = 0; k < 6; ++k)
    for (const double depth : {-0.5, 0.5}) {
      const double angle = std::numbers::pi / 3 * k;
      corners.push_back(compounds::point<S>(0.5 * std::cos(angle), 0.5 * std::sin(angle), depth));
      if (S::dim == 2) break;
    }
  const Part hexagon = compounds::hull<Part>(corners);
  const Compound<Part> grain = cut_in_two(hexagon, compounds::point<S>(0.1, 0));
  for (const double share : {0.99, 1.01}) {
    OnFloor<Compound<Part>> scene(grain, lowest(grain), 2, share * std::numbers::pi / 6);
    scene.run(4.0 / sanitizer_share);
    CAPTURE(share);
    if (share < 1)
      CHECK(scene.turn() < 1e-7);
    else
      CHECK(std::abs(scene.world.pose(scene.grain).position[0]) >
            (sanitizer_share > 1 ? 0.01 : 0.5));
  }
}

/// A roof along the second axis with its ridge at the origin.
template <class S>
FacetMesh<S> roof(double width, double slope) {
  if constexpr (S::dim == 2)
    return {{{-width, -slope * width}, {0, 0}, {width, -slope * width}}, {{1, 0}, {2, 1}}};
  else
    return {{{-width, -2, -slope * width},
             {0, -2, 0},
             {width, -2, -slope * width},
             {-width, 2, -slope * width},
             {0, 2, 0},
             {width, 2, -slope * width}},
            {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}}};
}

// A block glides without friction over the ridge of a roof. Cut in two, it moves as in one piece: the
// corners of the cut do not touch the slopes.
TEST_CASE_TEMPLATE("a block cut in two glides over a ridge as the whole block", Part,
                   MOREAU_TYPES((Polygon<>), (Polyhedron<>))) {
  using S = SpaceOf<Part>;
  using Grain = Compound<Part>;
  const Part block =
      compounds::box<Part>(compounds::point<S>(-2, -0.5, -1), compounds::point<S>(2, 0.5, 1));
  const auto parts = compounds::halves<Part>(block, S::Vector::UnitX(), S::Vector::Zero());
  const auto glide = [&](const Grain& grain, bool on_wall, double slope, double gap) {
    Simulation<Grain, Law> world(1, Materials<Law>(1, Law(0.0)));
    const auto mesh = roof<S>(2, slope);
    if (on_wall) {
      world.add_mesh_wall(mesh);
    } else {
      const Part house = compounds::hull<Part>(mesh.vertices);
      world.prescribe_motion(
          world.add_grain(world.add_shape(Grain({house})), {house.centroid_of_input()}, 1000));
    }
    const BodyId body =
        world.add_grain(world.add_shape(grain), {compounds::point<S>(-1, 0.5 + gap)}, 1000);
    world.set_velocity(body, compounds::point<S>(10, 0));
    for (int k = 0; k < 200; ++k) world.step(1e-3);
    return world.velocity(body);
  };
  for (const bool on_wall : {true, false})
    for (const double slope : {0.3, 2.0})
      for (const double gap : {1e-4, 0.0, -1e-3}) {
        const auto whole = glide(Grain({block}), on_wall, slope, gap);
        const auto cut = glide(Grain(std::span<const Part>(parts)), on_wall, slope, gap);
        CAPTURE(on_wall);
        CAPTURE(slope);
        CAPTURE(gap);
        CHECK(std::abs(whole[0] - 10) < 1e-4);
        CHECK((cut - whole).norm() < 1e-7);
      }
}

// The arm of a grain lies on a block beside which its other part hangs down: the corner between the
// two is inside the grain, the arm touches all the same.
TEST_CASE_TEMPLATE("an arm rests beside the part that hangs down", Part,
                   MOREAU_TYPES((Polygon<>), (Polyhedron<>))) {
  using S = SpaceOf<Part>;
  using Grain = Compound<Part>;
  const Part arm =
      compounds::box<Part>(compounds::point<S>(-3, 0, -0.5), compounds::point<S>(1, 1, 0.5));
  const Part hanging =
      compounds::box<Part>(compounds::point<S>(0, -2, -0.5), compounds::point<S>(1, 0, 0.5));
  const Part table =
      compounds::box<Part>(compounds::point<S>(-4, -4, -2), compounds::point<S>(0, 0, 2));
  for (const double beside : {0.0, 1e-3}) {
    Simulation<Grain, Law> world(1, Materials<Law>(1, Law(0.5)));
    const Grain hook({arm, hanging});
    world.prescribe_motion(
        world.add_grain(world.add_shape(Grain({table})), {table.centroid_of_input()}, 1000));
    const typename S::Vector start = hook.centroid_of_input() + compounds::point<S>(beside, 0);
    const BodyId body = world.add_grain(world.add_shape(hook), {start}, 1000);
    world.set_gravity(compounds::point<S>(0, -10));
    for (int k = 0; k < 300; ++k) world.step(1e-3);
    CAPTURE(beside);
    CHECK((world.pose(body).position - start).norm() < 1e-4);
    CHECK(world.velocity(body).norm() < 1e-4);
  }
}

// A small block slides without friction over the seam of a block cut in two as over the whole block:
// the edges of the cut make no contacts.
TEST_CASE_TEMPLATE("a block slides over the seam between two parts", Part,
                   MOREAU_TYPES((Polygon<>), (Polyhedron<>))) {
  using S = SpaceOf<Part>;
  using Grain = Compound<Part>;
  const Part floor =
      compounds::box<Part>(compounds::point<S>(-4, -1, -4), compounds::point<S>(4, 0, 4));
  const auto parts = compounds::halves<Part>(floor, S::Vector::UnitX(), S::Vector::Zero());
  const Grain cut{std::span<const Part>(parts)};
  const Grain block(
      {compounds::box<Part>(compounds::point<S>(-0.5, 0, -0.5), compounds::point<S>(0.5, 1, 0.5))});
  for (const double overlap : {0.0, 1e-6, 1e-4}) {
    Simulation<Grain, Law> world(1, Materials<Law>(1, Law(0.0)));
    OverlapCorrectionOptions off;
    off.enabled = false;
    world.set_correction(off);
    world.set_contact_points(ContactPoints::all);
    world.prescribe_motion(
        world.add_grain(world.add_shape(cut), {floor.centroid_of_input()}, 1000));
    const BodyId grain = world.add_grain(world.add_shape(block),
                                         {compounds::point<S>(-0.9, 0.5 - overlap, 0)}, 1000);
    world.set_gravity(compounds::point<S>(0, -10));
    world.set_velocity(grain, compounds::point<S>(1, 0));
    for (int k = 0; k < 1800; ++k) world.step(1e-3);
    CAPTURE(overlap);
    CHECK((world.velocity(grain) - compounds::point<S>(1, 0)).norm() < 1e-7);
    CHECK(std::abs(world.pose(grain).position[0] - 0.9) < 1e-6);
  }
}
