// SPDX-License-Identifier: MIT
// A run that is stopped and continued has the same bits as an uninterrupted run, and an incomplete
// file is rejected.
#include <doctest/doctest.h>
#include <memory>
#include <random>
#include <vector>

#include "moreau/boundary/drive.hpp"
#include "moreau/boundary/servo.hpp"
#include "moreau/io/snapshot.hpp"

#include "io/faults.hpp"
#include "io/temporary_folder.hpp"
#include "types.hpp"
#include "world/assemblies.hpp"

using namespace moreau;
using scenes::BoxOfGrains;
using scenes::World;

namespace {

/// Makes steps with a harmonic force on the right wall.
template <class ShapeT>
StepReport shake(World<ShapeT>& world, int steps) {
  using Vector = typename SpaceOf<ShapeT>::Vector;
  const ForceDrive drive(world.walls()[1], -Vector::UnitX(), HarmonicForce(1, 30, 20));
  StepReport report;
  for (int k = 0; k < steps; ++k) {
    drive.apply(world, 5e-4);
    report = world.step(5e-4);
  }
  return report;
}
template <class ShapeT>
BoxOfGrains<ShapeT> shaken_box(int steps) {
  BoxOfGrains<ShapeT> box(12);
  box.simulation.set_wall_mass(box.walls[1], 0.1);
  shake(box.simulation, steps);
  return box;
}
/// Objects of a user: an aggregate with public members, and a class that lists its members.
struct Note {
  std::vector<double> numbers;
  std::string text;
};
class Tally {
 public:
  void add(int n) { count_ += n; }
  int count() const { return count_; }

 private:
  friend struct moreau::SerializationAccess;
  auto serialized_members() { return std::tie(count_); }

  int count_ = 0;
};

/// A simulation of the same type whose content is different.
template <class ShapeT>
World<ShapeT> other_world() {
  using Law = scenes::LawOf<ShapeT>;
  return World<ShapeT>(0.1, Materials<Law>(3, Law(0.1)));
}

/// A simulation of a few disks that have touched each other.
const World<Disk<>>& disks() {
  static const BoxOfGrains<Disk<>> box = shaken_box<Disk<>>(200);
  return box.simulation;
}

std::string refusal(const std::string& bytes) {
  World<Disk<>> world = other_world<Disk<>>();
  try {
    restore_snapshot(bytes, world);
  } catch (const std::runtime_error& error) {
    CHECK(world.bodies().size() == 0);
    return error.what();
  }
  return "";
}
/// The bytes with different bytes at one position and a correct checksum.
template <class Number>
std::string with(std::string bytes, std::size_t place, Number number) {
  std::memcpy(&bytes[place], &number, sizeof number);
  const std::size_t end = bytes.size() - sizeof(std::uint64_t);
  const std::uint64_t checksum = detail::crc64(std::string_view(bytes).substr(0, end));
  std::memcpy(&bytes[end], &checksum, sizeof checksum);
  return bytes;
}

}  // namespace

TEST_CASE_TEMPLATE("N + M steps are N steps, a restart and M steps", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Disk<>), (Polygon<>, moreau::Ball<>))) {
  const TemporaryFolder folder("restart");
  const auto path = folder / "run.snapshot";
  BoxOfGrains<ShapeT> box = shaken_box<ShapeT>(150);
  write_snapshot(path, box.simulation);
  World<ShapeT> other = other_world<ShapeT>();
  read_snapshot(path, other);
  REQUIRE(snapshot(other) == snapshot(box.simulation));
  const StepReport one = shake(box.simulation, 150), two = shake(other, 150);
  CHECK(snapshot(other) == snapshot(box.simulation));
  CHECK(one.points > 10);
  CHECK(one.warm_started == two.warm_started);
  CHECK(one.candidate_pairs == two.candidate_pairs);
  CHECK(one.solve.sweeps == two.solve.sweeps);
  CHECK(one.dissipation == two.dissipation);
}

TEST_CASE_TEMPLATE("a wall under pressure goes on with the same bits", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Disk<>), (Polygon<>, moreau::Ball<>))) {
  const TemporaryFolder folder("restart-load");
  const auto path = folder / "run.snapshot";
  const double width = 0.08, area_of_wall = SpaceOf<ShapeT>::dim == 2 ? width : width * width;
  const auto area = [&] { return area_of_wall; };
  BoxOfGrains<ShapeT> box(12);
  PressureLoad before(box.simulation, box.walls[1], 2e3, 0.1, area);
  const auto run = [](auto& world, const auto& load, int steps) {
    for (int k = 0; k < steps; ++k) load.apply(world), world.step(5e-4);
  };
  run(box.simulation, before, 20);
  CHECK(box.simulation.velocity(box.walls[1]).norm() > 1e-3);
  write_snapshot(path, box.simulation);
  World<ShapeT> simulation = other_world<ShapeT>();
  read_snapshot(path, simulation);
  const PressureLoad load(simulation, simulation.walls()[1], 2e3, 0.1, area);  // the same mass
  CHECK(snapshot(simulation) == snapshot(box.simulation));
  run(simulation, load, 100), run(box.simulation, before, 100);
  CHECK(snapshot(simulation) == snapshot(box.simulation));
}

TEST_CASE_TEMPLATE("a copy goes on with the same bits after its source is gone", ShapeT,
                   Polygon<double>, Polyhedron<double>) {
  auto box = std::make_unique<BoxOfGrains<ShapeT>>(shaken_box<ShapeT>(20));
  World<ShapeT> other = box->simulation, copy = box->simulation;
  shake(box->simulation, 10);
  const auto expected = box->simulation.bodies().pose;
  // The memory of the source is used again by something else.
  box.reset();
  const std::vector<std::vector<double>> rubbish(100, std::vector<double>(40, 1e300));
  std::vector<World<ShapeT>> runs;
  runs.push_back(copy);
  runs.push_back(other);  // moves or copies the first
  for (auto* world : {&copy, &runs[0], &runs[1]}) {
    shake(*world, 10);
    REQUIRE(world->bodies().pose.size() == expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k)
      CHECK(world->bodies().pose[k].position == expected[k].position);
  }
}

TEST_CASE("a snapshot has whether deep overlaps are allowed") {
  World<Disk<>> allowed = other_world<Disk<>>(), refused = allowed;
  allowed.allow_overlaps();
  for (const bool allows : {true, false}) {
    World<Disk<>> world = other_world<Disk<>>();
    world.allow_overlaps(!allows);
    restore_snapshot(snapshot(allows ? allowed : refused), world);
    const ShapeId disk = world.add_shape(Disk<>(0.05));
    for (const double x : {0.0, 0.01}) world.add_grain(disk, Pose<Space<2>>({x, 0}), 1000);
    if (allows)
      CHECK_NOTHROW(world.step(1e-3));
    else
      CHECK_THROWS_AS(world.step(1e-3), std::invalid_argument);
  }
}

TEST_CASE_TEMPLATE("steps of two lengths in turn start from the same forces", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Disk<>), (Polygon<>, moreau::Ball<>))) {
  BoxOfGrains<ShapeT> box = shaken_box<ShapeT>(0);
  // Until all rest, but for disks and balls that roll.
  for (int k = 0; k < 2000; ++k) box.simulation.step(5e-4);
  World<ShapeT> steady = box.simulation, other = box.simulation;
  int sweeps = 0, sweeps_of_other = 0;
  double error = 0, error_of_other = 0;
  for (int k = 0; k < 40; ++k) {
    const StepReport one = steady.step(5e-4), two = other.step(k % 2 == 0 ? 1e-4 : 5e-4);
    sweeps += one.solve.sweeps, sweeps_of_other += two.solve.sweeps;
    error = std::max(error, one.solve.velocity_error);
    error_of_other = std::max(error_of_other, two.solve.velocity_error);
    CHECK(two.solve.converged);
    if (k == 20) {  // the length of the last step belongs to the state
      World<ShapeT> copy = other_world<ShapeT>(), next = other;
      restore_snapshot(snapshot(other), copy);
      copy.step(1e-4), next.step(1e-4);
      CHECK(snapshot(copy) == snapshot(next));
    }
  }
  CHECK(sweeps_of_other <= sweeps + 40);
  // An error within the tolerance is any number below it; that of an island whose attempt failed is twice the tolerance.
  CHECK(error_of_other <= 2 * std::max(error, moreau::ColouredOptions().velocity_tolerance));
}

TEST_CASE("what else belongs to a run goes with it") {
  std::mt19937_64 random(1), random_back;
  random.discard(1000);
  const int steps = 200;
  const Note note{{1, 2.5}, "at rest"};
  Tally tally, tally_back;
  tally.add(7);
  const std::string bytes = snapshot(disks(), random, steps, note, tally);
  World<Disk<>> world = other_world<Disk<>>();
  int steps_back = 0;
  Note note_back;
  restore_snapshot(bytes, world, random_back, steps_back, note_back, tally_back);
  CHECK(random_back == random);
  CHECK(steps_back == 200);
  CHECK(note_back.numbers == note.numbers);
  CHECK(note_back.text == "at rest");
  CHECK(tally_back.count() == 7);
  CHECK_THROWS_WITH_AS(restore_snapshot(bytes, world), doctest::Contains("holds 4 objects, not 0"),
                       std::runtime_error);
}

TEST_CASE("any flipped byte and any cut is refused") {
  const std::string bytes = snapshot(disks());
  CHECK(refusal(bytes) == "");
  for (std::size_t k = 0; k < bytes.size(); k += k < 300 ? 1 : 7) {
    std::string flipped = bytes;
    flipped[k] = static_cast<char>(flipped[k] ^ (1 << k % 8));
    CHECK(refusal(flipped) != "");
    CHECK(refusal(bytes.substr(0, k)).find(k > 0 ? "is truncated" : "is empty") !=
          std::string::npos);
  }
  CHECK(detail::crc64("123456789") == 0x995dc9bbdf1939fa);
}

TEST_CASE("a refusal says why") {
  const TemporaryFolder folder("restart");
  const std::string bytes = snapshot(disks());
  CHECK(refusal("t,f,x\n0,0,0\n") ==
        "restore_snapshot: what is given is no snapshot of moreau, or is corrupted");
  CHECK(refusal(with(bytes, 8, std::uint32_t(0x04030201))).find("order of bytes") !=
        std::string::npos);
  CHECK(refusal(with(bytes, 12, std::uint32_t(7)))
            .find("has format 7, moreau " MOREAU_VERSION_STRING " reads 1") != std::string::npos);
  CHECK(refusal(bytes + "x").find("is too long: ") != std::string::npos);
  CHECK(
      refusal(with(bytes, 24, std::uint64_t(0))).find("written by moreau " MOREAU_VERSION_STRING) !=
      std::string::npos);
  std::string corrupted = bytes;
  corrupted[corrupted.size() / 2] ^= 1;
  CHECK(refusal(corrupted) ==
        "restore_snapshot: what is given is corrupted: its checksum does not fit");

  const auto path = folder / "disks.snapshot";
  write_snapshot(path, disks());
  World<Polyhedron<>> polyhedra = other_world<Polyhedron<>>();
  CHECK_THROWS_WITH_AS(read_snapshot(path, polyhedra), doctest::Contains("holds moreau::BallIn<"),
                       std::runtime_error);
  CHECK_THROWS_WITH_AS(read_snapshot(path, polyhedra), doctest::Contains(path.c_str()),
                       std::runtime_error);
  CHECK_THROWS_WITH_AS(read_snapshot(folder / "none", polyhedra), doctest::Contains("cannot read"),
                       std::system_error);
}

TEST_CASE("a disk that is full and a folder that is missing or closed leave the old file") {
  const TemporaryFolder folder("restart");
  const auto path = folder / "run.snapshot";
  write_snapshot(path, disks());
  const std::string before = read(path);
  CHECK_THROWS_AS(write_snapshot(folder / "missing" / "run.snapshot", disks()), std::system_error);
  CHECK_THROWS_AS(write_snapshot(path / "below", disks()), std::system_error);
  {
    const FullDisk full(before.size() / 2);
    CHECK_THROWS_WITH_AS(write_snapshot(path, disks()), doctest::Contains("cannot write"),
                         std::system_error);
  }
  {
    const UnwritableFolder closed(folder / "");
    CHECK_THROWS_WITH_AS(write_snapshot(path, disks()), doctest::Contains(path.c_str()),
                         std::system_error);
  }
  CHECK(read(path) == before);
  CHECK_FALSE(std::filesystem::exists(folder / "run.snapshot.part"));
}

TEST_CASE("a run that is killed while it writes leaves a whole snapshot") {
  const TemporaryFolder folder("restart");
  const auto path = folder / "run.snapshot";
  const std::string one = snapshot(disks(), 1), two = snapshot(disks(), 2);
  write_atomically(path, one);
  for (int k = 0; k < 20; ++k) {
    kill_while(std::chrono::microseconds(500 + 331 * k), [&] {
      write_atomically(path, two);
      write_atomically(path, one);
    });
    const std::string found = read(path);
    CHECK((found == one || found == two));
  }
  std::ofstream(folder / "run.snapshot.part") << "half";
  write_snapshot(path, disks(), 3);
  World<Disk<>> world = other_world<Disk<>>();
  int number = 0;
  read_snapshot(path, world, number);
  CHECK(number == 3);
}
