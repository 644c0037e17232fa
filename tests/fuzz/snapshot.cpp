// SPDX-License-Identifier: MIT
// Input: arbitrary bytes, or the bytes of a snapshot in which some bytes are changed and the
// checksum is correct. Expected: a simulation whose own snapshot can be read again, or an error.
// The simulation makes no step, because the format does not protect against carefully forged files.
#include "moreau/io/snapshot.hpp"

#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "moreau/moreau.hpp"

#include "bytes.hpp"
#include "shapes.hpp"

namespace {

using namespace moreau;

using Law = SignoriniCoulomb<>;
using Shapes = OneOf<Ball<>, Polyhedron<>, moreau::Capsule<>>;
using World = Simulation<Shapes, Law>;

World small_world() {
  World world(1, Materials<Law>(2, Law(0.5)));
  const std::vector<Eigen::Vector3d> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}};
  world.allow_overlaps();
  for (const Shapes& shape : {Shapes(Ball<>(0.5)), Shapes(hull_of<Polyhedron<>>(corners)),
                              Shapes(moreau::Capsule<>(0.5, 0.1))})
    world.add_grain(world.add_shape(shape), {}, 1000, MaterialId(1));
  world.add_wall({0, 1, 0}, {0, 0, 0});
  world.add_cylinder({0, 0, 0}, {0, 0, 1}, 5);
  world.set_periodic(2, 0, 10);
  world.set_gravity({0, -9.81, 0});
  for (int k = 0; k < 3; ++k)
    // After three steps the simulation has contacts, impulses and cached pairs.
    world.step(1e-3);
  return world;
}

template <class Number>
void put(std::string& bytes, std::size_t place, Number number) {
  if (place + sizeof number <= bytes.size()) std::memcpy(&bytes[place], &number, sizeof number);
}
void put_right(std::string& bytes) {
  put(bytes, 16, std::uint64_t(bytes.size()));
  const std::size_t end = bytes.size() - std::min(bytes.size(), sizeof(std::uint64_t));
  put(bytes, end, detail::crc64(std::string_view(bytes).substr(0, end)));
}

/// Changes, removes and repeats some of the bytes.
std::string changed(std::string bytes, Bytes& how) {
  while (!how.is_empty() && !bytes.empty()) {
    const std::size_t place = how.raw<std::uint16_t>() % bytes.size();
    switch (how.between(0, 4)) {
      case 0:
        put(bytes, place, how.raw<std::uint8_t>());
        break;
      case 1:
        put(bytes, place, how.raw<std::uint64_t>());
        break;
      case 2:
        put(bytes, place, std::uint64_t(how.raw<std::uint8_t>()));
        break;
      case 3:
        bytes.erase(place, std::size_t(how.between(1, 64)));
        break;
      default:
        if (bytes.size() < 20000)
          bytes.insert(place, bytes, place, std::size_t(how.between(1, 64)));
    }
  }
  return bytes;
}

void try_bytes(const std::string& bytes, const World& world) {
  World read = world, again = world;
  std::mt19937_64 random, random_again;
  try {
    restore_snapshot(bytes, read, random);
  } catch (const std::runtime_error&) {
    return;
  }
  const std::string own = snapshot(read, random);
  restore_snapshot(own, again, random_again);
  hold(snapshot(again, random_again) == own, "what is read is written and read back");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const World world = small_world();
  Bytes how(data, size);
  std::string bytes;
  if (how.between(0, 3) == 0) {
    while (!how.is_empty()) bytes.push_back(how.raw<char>());
  } else {
    bytes = changed(snapshot(world, std::mt19937_64(1)), how);
    put_right(bytes);
  }
  try_bytes(bytes, world);
  return 0;
}
