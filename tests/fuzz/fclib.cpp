// SPDX-License-Identifier: MIT
// Input: a well-formed HDF5 file in which FCLIB's numbers and sizes are arbitrary. Expected: a
// valid problem or an error. The target does not search for errors of the HDF5 library in malformed
// files.
#include "moreau/io/fclib.hpp"

#include <filesystem>
#include <stdexcept>
#include <stdlib.h>
#include <string>
#include <unistd.h>
#include <vector>

#include "bytes.hpp"

namespace {

using namespace moreau::detail;

/// An integer: mostly close to zero, sometimes arbitrary.
int take_integer(Bytes& bytes) {
  const int value = bytes.between(-3, 200);
  return value < 180 ? value % 12 : bytes.raw<int>();
}
std::vector<int> take_integers(Bytes& bytes) {
  std::vector<int> numbers(static_cast<std::size_t>(bytes.between(0, 12)));
  for (int& x : numbers) x = take_integer(bytes);
  return numbers;
}
std::vector<double> take_numbers(Bytes& bytes) {
  std::vector<double> numbers(static_cast<std::size_t>(bytes.between(0, 12)));
  for (double& x : numbers) x = bytes.number(true);
  return numbers;
}

void put(Bytes& bytes, hid_t group, const char* name, const std::vector<int>& numbers) {
  if (bytes.between(0, 63) > 0) write_hdf5(group, name, std::span<const int>(numbers));
}
void put(Bytes& bytes, hid_t group, const char* name, const std::vector<double>& numbers) {
  if (bytes.between(0, 63) > 0) write_hdf5(group, name, std::span<const double>(numbers));
}
void put_matrix(Bytes& bytes, hid_t parent, const char* name) {
  const auto matrix = create_hdf5_group(parent, name);
  for (const char* size : {"m", "n", "nz"})
    put(bytes, matrix, size, std::vector<int>{take_integer(bytes)});
  for (const char* list : {"p", "i"}) put(bytes, matrix, list, take_integers(bytes));
  put(bytes, matrix, "x", take_numbers(bytes));
}

void put_file(Bytes& bytes, const std::filesystem::path& path) {
  const Hdf5Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), &H5Fclose,
                        "create");
  const bool is_local = bytes.between(0, 1) == 0;
  const auto group = create_hdf5_group(file, is_local ? "fclib_local" : "fclib_global");
  put(bytes, group, "spacedim", std::vector<int>{bytes.between(1, 4)});
  for (const char* name : {"W", "M", "H"})
    if (is_local == (*name == 'W')) put_matrix(bytes, group, name);
  const auto vectors = create_hdf5_group(group, "vectors");
  for (const char* name : {"q", "f", "w", "mu"}) put(bytes, vectors, name, take_numbers(bytes));
}

/// The path of the file, which is the same for all inputs.
const std::filesystem::path& path() {
  static const std::filesystem::path path = [] {
    std::string name = std::filesystem::temp_directory_path() / "moreau_fuzz_XXXXXX";
    const int file = mkstemp(name.data());
    hold(file >= 0, "a temporary file");
    close(file);
    std::atexit([] { std::filesystem::remove(::path()); });
    return std::filesystem::path(name);
  }();
  return path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  put_file(bytes, path());
  try {
    std::visit(
        [](const auto& problem) {
          hold(problem.delassus.rows() == problem.delassus.cols(), "square");
          hold(problem.free_velocity.size() == problem.delassus.rows(), "as many velocities");
          hold(problem.free_velocity.allFinite() && problem.friction.allFinite(), "finite");
        },
        moreau::read_fclib(path()));
  } catch (const std::invalid_argument&) {
  } catch (const std::runtime_error&) {
  }
  return 0;
}
