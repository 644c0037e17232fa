// SPDX-License-Identifier: MIT
// Error messages for files from which a run cannot be continued. The other tests of snapshots are
// in world/restart.cpp.
#include "moreau/io/snapshot.hpp"

#include <cstring>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "moreau/law/regularized.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

#include "io/temporary_folder.hpp"

using namespace moreau;

namespace {

/// The error message for a file.
std::string said(const std::function<void()>& reads) {
  try {
    reads();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}
std::string said_of_head(const std::string& bytes) {
  return said([&] { detail::checked_head(bytes, "it"); });
}
/// The bytes of a snapshot that has a head and a checksum but no objects.
std::string smallest() {
  detail::SnapshotHead head;
  detail::ArchiveWriter archive;
  archive.bytes.resize(sizeof head);
  head.size = sizeof head + sizeof(std::uint64_t);
  std::memcpy(archive.bytes.data(), &head, sizeof head);
  archive.number(detail::crc64(archive.bytes));
  return archive.bytes;
}

}  // namespace

TEST_CASE("files that cannot be read are named, with the reason") {
  const TemporaryFolder folder("snapshot");
  const auto missing = folder / "none.snapshot";
  try {
    detail::read_file(missing, "read_snapshot");
    FAIL("did not throw");
  } catch (const std::system_error& error) {
    CHECK(error.what() ==
          "read_snapshot: cannot read '" + missing.string() + "': No such file or directory");
    CHECK(error.code() == std::errc::no_such_file_or_directory);
  }
  try {
    detail::read_file(folder / "", "read_snapshot");
    FAIL("did not throw");
  } catch (const std::system_error& error) {
    CHECK(error.what() ==
          "read_snapshot: cannot read '" + (folder / "").string() + "': Is a directory");
    CHECK(error.code() == std::errc::is_a_directory);
  }
  std::string bytes(100000, 'x');
  bytes[1] = '\0';
  std::ofstream(folder / "whole", std::ios::binary) << bytes;
  CHECK(detail::read_file(folder / "whole", "") == bytes);
  std::ofstream(folder / "empty").close();
  CHECK(detail::read_file(folder / "empty", "").empty());
}

TEST_CASE("a head that is not as it should be may be a corrupted one") {
  const std::string bytes = smallest();
  CHECK(said_of_head(bytes) == "");
  CHECK(said_of_head("") == "it is empty");
  CHECK(said_of_head(bytes.substr(0, 20)) == "it is truncated: 20 bytes");
  for (std::size_t k = 0; k < 24; ++k)
    for (int bit = 0; bit < 8; ++bit) {
      std::string flipped = bytes;
      flipped[k] = static_cast<char>(flipped[k] ^ (1 << bit));
      CHECK(said_of_head(flipped).ends_with(", or is corrupted"));
    }
  CHECK(said_of_head(bytes + "x") == "it is too long: 41 of 40 bytes, or is corrupted");
}

TEST_CASE("of other types the first that differs is named") {
  using detail::difference;
  const std::string is = "std::tuple<BallIn<Space<2, double> >, Law, Euler, Options<(Kind)1>, int>";
  CHECK(difference(is, "std::tuple<Polygon<double>, Other, Euler, Options<(Kind)1>>") ==
        "holds BallIn<Space<2, double> >, not Polygon<double>, as its shape");
  CHECK(difference(is, "std::tuple<BallIn<Space<2, double> >, Law, Euler, Options<(Kind)2>>") ==
        "holds Options<(Kind)1>, not Options<(Kind)2>, as its solver's options");
  CHECK(
      difference(is, "std::tuple<BallIn<Space<2, double> >, Law, Euler, Options<(Kind)1>, long>") ==
      "holds int, not long, as its object 1 that goes with the simulation");
  CHECK(difference(is, "std::tuple<BallIn<Space<2, double> >, Law, Euler, Options<(Kind)1> >") ==
        "holds 1 objects, not 0, that go with the simulation");
  for (const char* odd : {"", "<", ">", "><", "std::tuple<>", "tuple<A", "A, B, C, D>"})
    CHECK(difference(odd, is) != "");
}

TEST_CASE("a snapshot that cannot be read, is empty or of other types says so") {
  using Law = SignoriniCoulomb<>;
  const TemporaryFolder folder("snapshot");
  Simulation<Disk<>, Law> disks(1, Materials<Law>(1, Law(0.5)));
  const auto said_by_reading = [&](const std::filesystem::path& path) {
    return said([&] { read_snapshot(path, disks); });
  };
  CHECK(said_by_reading(folder / "none").ends_with("none': No such file or directory"));
  CHECK(said_by_reading(folder / "").ends_with("': Is a directory"));
  const auto path = folder / "run.snapshot";
  std::ofstream(path).close();
  CHECK(said_by_reading(path) == "read_snapshot: '" + path.string() + "' is empty");
  write_snapshot(path, disks, 1);
  CHECK(said_by_reading(path) == "read_snapshot: '" + path.string() +
                                     "' holds 1 objects, not 0, that go with the simulation");
}

namespace {

/// A law without members.
struct NoForce {
  using S = Space<2>;
  S::Vector force(const ContactMotion<S>&, S::Vector& memory) const {
    memory.setZero();
    return S::Vector::Zero();
  }
};

}  // namespace

TEST_CASE("laws without members can be read back") {
  using World = Simulation<Disk<>, NoForce>;
  World world(0.1, Materials<NoForce>(64));
  world.add_grain(world.add_shape(Disk<>(0.05)), {}, 1);
  world.step(1e-3);
  const std::string bytes = snapshot(world);
  World other(0.1, Materials<NoForce>(64));
  restore_snapshot(bytes, other);
  CHECK(snapshot(other) == bytes);
}
