// SPDX-License-Identifier: MIT
// Simulations of compound grains. Their mechanics is tested in physics/compound.cpp, all laws in
// long/matrix_compound.cpp.
#include "moreau/shape/compound.hpp"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <random>
#include <span>
#include <vector>

#include "moreau/io/snapshot.hpp"
#include "moreau/measure/coordination.hpp"
#include "moreau/measure/pair_forces.hpp"
#include "moreau/measure/solid_fraction.hpp"
#include "moreau/parallel/thread_team.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/regular_shape.hpp"

#include "conformance/shape.hpp"
#include "conformance/world.hpp"
#include "detect/shapes.hpp"
#include "io/temporary_folder.hpp"
#include "sanitized.hpp"
#include "shape/compounds.hpp"
#include "world/compound_box.hpp"

using namespace moreau;
using scenes::CompoundBox;

TEST_CASE_TEMPLATE("momentum and energy of concave ballast", Part, Polygon<>, Polyhedron<>) {
  std::mt19937_64 random(2);
  std::vector<Compound<Part>> grains;
  for (const auto& grain : ballast_shapes<Compound<Part>>(3, random))
    grains.push_back(grain.scaled(0.005));
  conformance::world(grains, SignoriniCoulomb<>(0.4), 0.01);
}

TEST_CASE_TEMPLATE("faces between the parts of a grain make no contacts", Part, Polygon<>,
                   Polyhedron<>) {
  CompoundBox<Part> box(1);
  box.world.set_gravity(SpaceOf<Part>::Vector::Zero());
  const StepReport report = box.run(3);
  CHECK(report.candidate_pairs == 0);
  CHECK(report.points == 0);
}

TEST_CASE_TEMPLATE("contacts are sorted by distinct keys; a pair of grains counts once", Part,
                   Polygon<>, Polyhedron<>) {
  CompoundBox<Part> box(12);
  const StepReport report = box.run(rounds(800));
  const auto& keys = box.world.contacts().keys;
  CHECK(std::is_sorted(keys.begin(), keys.end()));
  CHECK(std::adjacent_find(keys.begin(), keys.end()) == keys.end());
  CHECK(std::any_of(keys.begin(), keys.end(), [](const ContactKey& k) { return k.part_a != 0; }));
  std::size_t pairs = 0;
  bool several = false;  // of a pair of grains, parts that touch
  for (std::size_t c = 0; c < keys.size(); ++c) {
    const bool same = c > 0 && keys[c].a == keys[c - 1].a && keys[c].b == keys[c - 1].b;
    pairs += !same;
    several = several || (same && !keys[c].is_of_parts_of(keys[c - 1]));
  }
  CHECK(several);
  CHECK(pairs == report.pairs);
  std::vector<PairForce<SpaceOf<Part>>> forces;
  pair_forces(box.world.contacts(), 5e-4, forces);
  CHECK(forces.size() <= pairs);
  CHECK(coordination(box.world).pairs == forces.size());
}

TEST_CASE_TEMPLATE("a ball in the notch of an L touches both arms", Part, Polygon<>, Polyhedron<>) {
  using S = SpaceOf<Part>;
  using Mixed = OneOf<Part, BallIn<S>>;
  using Grain = Compound<Mixed>;
  using Law = SignoriniCoulomb<>;
  const Part foot = compounds::box<Part>(compounds::point<S>(0, 0), compounds::point<S>(3, 1, 1));
  const Part leg = compounds::box<Part>(compounds::point<S>(0, 1), compounds::point<S>(1, 3, 1));
  const Grain l({{foot, {foot.centroid_of_input()}}, {leg, {leg.centroid_of_input()}}});
  Simulation<Grain, Law> world(1, Materials<Law>(1, Law(0.3)));
  const BodyId base = world.add_grain(world.add_shape(l), {l.centroid_of_input()}, 1);
  world.prescribe_motion(base);
  const typename S::Vector middle = compounds::point<S>(1.5, 1.5, 0.5);
  const BodyId ball = world.add_grain(world.add_shape(Grain({{BallIn<S>(0.5), {}}})), {middle}, 1);
  world.set_gravity(compounds::point<S>(-1, -1));
  for (int k = 0; k < 100; ++k) world.step(1e-2);
  CHECK((world.pose(ball).position - middle).norm() < 1e-6);
  const auto& keys = world.contacts().keys;
  REQUIRE(keys.size() == 2);
  CHECK(keys[0].part_a == 0);
  CHECK(keys[1].part_a == 1);
}

TEST_CASE_TEMPLATE("a ball that rolls down a ball of an obstacle, whatever the order of its parts",
                   Part, Polygon<>, Polyhedron<>) {
  using S = SpaceOf<Part>;
  using Mixed = OneOf<Part, BallIn<S>>;
  using Grain = Compound<Mixed>;
  using Law = SignoriniCoulomb<>;
  const Part foot =
      compounds::box<Part>(compounds::point<S>(-1, -4, -1), compounds::point<S>(1, -1.5, 1));
  const typename Grain::Part round{BallIn<S>(1), {}}, stand{foot, {foot.centroid_of_input()}};
  std::vector<typename S::Vector> ends;
  for (const bool round_first : {true, false}) {
    const Grain obstacle = round_first ? Grain({round, stand}) : Grain({stand, round});
    Simulation<Grain, Law> world(1, Materials<Law>(1, Law(0.9)));
    const BodyId base =
        world.add_grain(world.add_shape(obstacle), {obstacle.centroid_of_input()}, 1);
    world.prescribe_motion(base);
    const BodyId ball = world.add_grain(world.add_shape(Grain({{BallIn<S>(0.5), {}}})),
                                        {compounds::point<S>(0.3, std::sqrt(1.5 * 1.5 - 0.09))}, 1);
    world.set_gravity(compounds::point<S>(0, -9.81));
    for (int k = 0; k < 50; ++k) world.step(5e-3);
    ends.push_back(world.pose(ball).position);
  }
  CHECK(ends[0][0] > 0.32);
  CHECK((ends[0] - ends[1]).norm() < 1e-12);
}

TEST_CASE_TEMPLATE("a run of compound grains continues with the same bits, with any team", Part,
                   Polygon<>, Polyhedron<>) {
  for (const bool periodic : {false, true}) {
    CompoundBox<Part> box(12, periodic), other(3, periodic), threads(12, periodic);
    threads.world.set_team(ThreadTeam(2));
    box.run(rounds(300));
    const std::string half = snapshot(box.world);
    restore_snapshot(half, other.world);
    box.run(rounds(200));
    other.run(rounds(200));
    threads.run(rounds(300) + rounds(200));
    CHECK(snapshot(box.world) == snapshot(other.world));
    CHECK(snapshot(box.world) == snapshot(threads.world));
    CHECK(box.world.contacts().size() > 0);
  }
}

TEST_CASE_TEMPLATE("compound grains are removed and added", Part, Polygon<>, Polyhedron<>) {
  CompoundBox<Part> box(12, true);
  std::mt19937_64 random(1);
  std::size_t points = 0;
  for (int round = 0; round < 12; ++round) {
    box.run(rounds(80));
    const auto grains = box.world.grains();
    const std::vector<BodyId> gone{grains[random() % 5], grains[5 + random() % 5]};
    box.world.remove_grains(gone);
    points += box.run(1).points;
    for (const Contact<SpaceOf<Part>>& contact : box.world.contacts().points)
      for (const BodyId body : gone) CHECK((contact.a != body.value && contact.b != body.value));
    box.add(18 + std::size_t(round) % 9);
    box.add(27 + std::size_t(round) % 9);
    CompoundBox<Part> copy(1);
    restore_snapshot(snapshot(box.world), copy.world);
    box.run(5);
    copy.run(5);
    CHECK(snapshot(box.world) == snapshot(copy.world));
  }
  CHECK(points > 100);
  CHECK(box.world.grain_count() == 12);
}

TEST_CASE_TEMPLATE("a heap across a periodic boundary is that of the next cell", Part, Polygon<>,
                   Polyhedron<>) {
  using Vector = typename SpaceOf<Part>::Vector;
  CompoundBox<Part> box(12, true), moved(12, true);
  for (const BodyId grain : moved.world.grains()) {
    auto pose = moved.world.pose(grain);
    pose.position += 0.08 * double(grain.index() % 3) * Vector::UnitX();
    moved.world.set_pose(grain, pose);
  }
  const auto a = box.run(200), b = moved.run(200);
  CHECK(a.points == b.points);
  double apart = 0;
  for (const BodyId grain : box.world.grains())
    apart = std::max(apart, (box.world.pose(grain).position +
                             0.08 * double(grain.index() % 3) * Vector::UnitX() -
                             moved.world.pose(grain).position)
                                .norm());
  CHECK(apart < 1e-6);
}

TEST_CASE_TEMPLATE("the solid fraction of compound grains", Part, Polygon<>, Polyhedron<>) {
  using S = SpaceOf<Part>;
  std::mt19937_64 random(6);
  const Part whole = samples::grain(S{}, random);
  const auto parts = compounds::halves<Part>(whole, S::Vector::UnitX(), 0.1 * S::Vector::UnitX());
  const Compound<Part> grain{std::span<const Part>(parts)};
  ClipWorkspace<S> workspace;
  for (int k = 0; k < 20; ++k) {
    const auto pose = conformance::random_pose<S>(random);
    const Aabb<S> box{pose.position - S::Vector::Constant(0.3), pose.position + S::Vector::Ones()};
    CHECK(clipped_volume(grain, pose, box, workspace) ==
          doctest::Approx(clipped_volume(whole, pose, box, workspace)).epsilon(1e-12));
  }
}

TEST_CASE_TEMPLATE("a snapshot is read back after grains of other shapes were removed", Part,
                   Polygon<double>, Polyhedron<double>) {
  using S = SpaceOf<Part>;
  using Grain = Compound<Part>;
  using Law = SignoriniCoulomb<double>;
  const Part cube = regular_shape<Part>(0.01);
  const auto stone = [&](int count) {
    std::vector<typename Grain::Part> parts;
    for (int k = 0; k < count; ++k)
      parts.push_back({cube, {typename S::Vector(0.0101 * k * S::Vector::UnitX()), S::identity()}});
    return Grain(std::span<const typename Grain::Part>(parts));
  };
  Simulation<Grain, Law> world(0.01, Law(0.4));
  const ShapeId shapes[] = {world.add_shape(stone(2)), world.add_shape(stone(3))};
  std::vector<BodyId> grains;
  for (int k = 0; k < 6; ++k)
    grains.push_back(world.add_grain(
        shapes[k % 2],
        {typename S::Vector(0.0105 * k * S::Vector::Unit(S::dim - 1)), S::identity()}, 2500));
  world.set_gravity(-9.81 * S::Vector::Unit(S::dim - 1));
  for (int k = 0; k < 5; ++k) (void)world.step(1e-4);
  const TemporaryFolder folder("compound");
  write_snapshot(folder / "stones", world);
  for (int k = 0; k < 5; ++k) (void)world.step(1e-4);
  const auto expected = world.bodies().pose;
  world.remove_grains(std::vector<BodyId>{grains[1], grains[3], grains[4]});
  (void)world.step(1e-4);
  reload_snapshot(folder / "stones", world);
  for (int k = 0; k < 5; ++k) (void)world.step(1e-4);
  REQUIRE(world.bodies().pose.size() == expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k)
    CHECK(world.bodies().pose[k].position == expected[k].position);
}
