// SPDX-License-Identifier: MIT
// Files for ParaView: one per process, and an index that names them.
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "moreau/distributed/write_pieces.hpp"

#include "distributed/worlds.hpp"

using namespace distributed_test;

namespace {

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
/// The number after the first `name="`.
int number_after(const std::string& text, const std::string& name) {
  const std::size_t at = text.find(name + "=\"");
  return at == text.npos ? -1 : std::atoi(text.c_str() + at + name.size() + 2);
}

}  // namespace

TEST_CASE("Each process writes its grains and contacts") {
  std::string folder = "pieces-" + std::to_string(ranks());
  if (rank() == 0) std::filesystem::create_directory(folder);
  const auto build = [] { return box_of_grains<Balls>(60); };
  DistributedSimulation<Balls> packing(MPI_COMM_WORLD, on_first_rank<Balls>(build));
  StepReport report;
  for (int k = 0; k < 200; ++k) report = packing.step(step);
  write_pieces(std::filesystem::path(folder) / "run", packing, step);
  // Without a step the forces are those of the last one.
  write_pieces(std::filesystem::path(folder) / "last", packing);
  for (const char* part : {"_grains_", "_contacts_"}) {
    const std::string end = part + std::to_string(rank()) + ".vtp";
    CHECK(!content(folder + "/run" + end).empty());
    CHECK(content(folder + "/last" + end) == content(folder + "/run" + end));
  }
  CHECK_THROWS_AS(write_pieces(std::filesystem::path(folder) / "run", packing, 1e3 * step),
                  std::invalid_argument);
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank() == 0) {
    int grains = 0, contacts = 0;
    for (int other = 0; other < ranks(); ++other) {
      const std::string end = "_" + std::to_string(other) + ".vtp";
      grains += number_after(content(folder + "/run_grains" + end), "NumberOfPoints");
      contacts += number_after(content(folder + "/run_contacts" + end), "NumberOfLines");
      CHECK(content(folder + "/run_grains.pvtp").find("\"run_grains" + end) != std::string::npos);
      CHECK(content(folder + "/run_contacts.pvtp").find("\"run_contacts" + end) !=
            std::string::npos);
    }
    CHECK(grains == 60);
    CHECK(contacts == int(report.points));
    std::filesystem::remove_all(folder);
  }
  CHECK_THROWS_AS(write_pieces("a&b", packing), std::invalid_argument);
}

TEST_CASE("Contacts of a simulation that has made no step need its length") {
  const auto build = [] { return box_of_grains<Balls>(60); };
  std::optional<DistributedSimulation<Balls>> packing;
  packing.emplace(MPI_COMM_WORLD, on_first_rank<Balls>(build));
  for (int k = 0; k < 200; ++k) packing->step(step);
  const std::optional<Balls> whole = packing->gather();
  packing.emplace(MPI_COMM_WORLD, whole ? *whole : empty_world<Balls>());
  CHECK_THROWS_AS(write_pieces("none", *packing), std::invalid_argument);
}

TEST_CASE("If one process cannot write, all throw") {
  const std::string folder = "unwritable-" + std::to_string(ranks());
  const int last = ranks() - 1;
  if (rank() == 0)  // a folder in the place of a file
    std::filesystem::create_directories(folder + "/run_grains_" + std::to_string(last) + ".vtp/in");
  const auto build = [] { return box_of_grains<Balls>(60); };
  DistributedSimulation<Balls> packing(MPI_COMM_WORLD, on_first_rank<Balls>(build));
  packing.step(step);
  CHECK_THROWS(write_pieces(std::filesystem::path(folder) / "run", packing, step));
  CHECK_THROWS_AS(write_pieces(std::filesystem::path(folder) / "run", packing, 0),
                  std::invalid_argument);
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank() == 0) std::filesystem::remove_all(folder);
}
