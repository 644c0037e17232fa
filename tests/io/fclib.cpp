// SPDX-License-Identifier: MIT
#include "moreau/io/fclib.hpp"

#include <chrono>
#include <doctest/doctest.h>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "moreau/instances/friction_problems.hpp"
#include "moreau/io/siconos_text.hpp"

#include "io/faults.hpp"
#include "io/temporary_folder.hpp"

using namespace moreau;

namespace {

const std::string folder = MOREAU_TEST_DATA "fclib/";

template <class S>
void check_equal(const FrictionProblem<S>& a, const FrictionProblem<S>& b) {
  CHECK(Eigen::MatrixXd(a.delassus) == Eigen::MatrixXd(b.delassus));
  CHECK(a.free_velocity == b.free_velocity);
  CHECK(a.friction == b.friction);
}

using Numbers = std::vector<double>;

/// Writes a 2 x 2 matrix in any of the three storage formats.
void write_matrix(hid_t parent, const std::string& name, int nz, const std::vector<int>& p,
                  const std::vector<int>& i, const Numbers& x, int columns = 2) {
  using namespace moreau::detail;
  const auto matrix = create_hdf5_group(parent, name);
  write_hdf5(matrix, "nzmax", int(x.size()));
  write_hdf5(matrix, "m", 2);
  write_hdf5(matrix, "n", columns);
  write_hdf5(matrix, "nz", nz);
  write_hdf5(matrix, "p", std::span<const int>(p));
  write_hdf5(matrix, "i", std::span<const int>(i));
  write_hdf5(matrix, "x", std::span<const double>(x));
}
void write_vector(hid_t group, const std::string& name, const Numbers& x) {
  detail::write_hdf5(group, name, std::span<const double>(x));
}
detail::Hdf5Handle new_file(const std::filesystem::path& path) {
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), &H5Fclose, "create"};
}

/// Writes a problem with one contact in the plane.
void write_storage(const std::filesystem::path& path, int nz, const std::vector<int>& p,
                   const std::vector<int>& i, const Numbers& x, int dimension = 2,
                   int columns = 2) {
  const auto file = new_file(path);
  const auto local = detail::create_hdf5_group(file, "fclib_local");
  detail::write_hdf5(local, "spacedim", dimension);
  write_matrix(local, "W", nz, p, i, x, columns);
  const auto vectors = detail::create_hdf5_group(local, "vectors");
  write_vector(vectors, "q", {-1, 0.5});
  write_vector(vectors, "mu", {0.3});
}

Eigen::MatrixXd matrix(const std::filesystem::path& path) {
  return std::get<FrictionProblem<Space<2>>>(read_fclib(path)).delassus;
}

}  // namespace

TEST_CASE("a file of the library itself is read and solved") {
  CHECK(is_hdf5(folder + "Capsules-i125-1213.hdf5"));
  const AnyFrictionProblem any = read_fclib(folder + "Capsules-i125-1213.hdf5");
  const auto& problem = std::get<FrictionProblem<Space<3>>>(any);
  CHECK(problem.size() == 286);
  CHECK(problem.friction.minCoeff() == 0.7);
  Eigen::VectorXd r;
  CHECK(ProximalSolver().solve(problem, r).converged);
  CHECK(natural_map_residual(problem, r) <= 1e-10);
}

TEST_CASE("a problem is written and read back to the same bits") {
  const TemporaryFolder temporary("fclib");
  const auto path = temporary / "problem.hdf5";
  for (const char* name : {"FrictionContact3D_1c.dat", "FrictionContactProblem00031.dat"}) {
    const AnyFrictionProblem any = read_siconos_text(folder + name);
    std::visit(
        [&](const auto& problem) {
          using Problem = std::decay_t<decltype(problem)>;
          Eigen::VectorXd r;
          ProximalSolver().solve(problem, r);
          write_fclib(path, problem, r);
          const AnyFrictionProblem back = read_fclib(path);
          check_equal(problem, std::get<Problem>(back));
          const detail::Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT),
                                        &H5Fclose, "open");
          const auto written = detail::read_hdf5<double>(file, "solution/r");
          CHECK(Eigen::Map<const Eigen::VectorXd>(written.data(), r.size()) == r);
        },
        any);
  }
}

TEST_CASE("a full disk and a kill leave the whole file that was there") {
  const TemporaryFolder temporary("fclib");
  const auto path = temporary / "problem.hdf5";
  const AnyFrictionProblem any = read_siconos_text(folder + "FrictionContact3D_1c.dat");
  const auto& problem = std::get<FrictionProblem<Space<3>>>(any);
  const auto is_whole = [&] {
    const AnyFrictionProblem back = read_fclib(path);
    check_equal(problem, std::get<FrictionProblem<Space<3>>>(back));
  };
  write_fclib(path, problem);
  {
    const FullDisk full(1000);
    CHECK_THROWS_WITH_AS(write_fclib(path, problem), doctest::Contains(path.c_str()),
                         std::system_error);
  }
  is_whole();
  for (int k = 0; k < 5; ++k) {
    kill_while(std::chrono::microseconds(500 + 331 * k), [&] { write_fclib(path, problem); });
    is_whole();
  }
}

TEST_CASE("compressed rows, compressed columns and triplets") {
  const TemporaryFolder temporary("fclib");
  const auto path = temporary / "w.hdf5";
  Eigen::Matrix2d w;
  w << 1, 0, 0.5, 2.5;
  write_storage(path, -2, {0, 1, 3}, {0, 0, 1}, {1, 0.5, 2.5});
  CHECK(matrix(path) == w);
  write_storage(path, -1, {0, 2, 3}, {0, 1, 1}, {1, 0.5, 2.5});
  CHECK(matrix(path) == w);
  write_storage(path, 3, {0, 0, 1}, {0, 1, 1}, {1, 0.5, 2.5});
  CHECK(matrix(path) == w);
}

TEST_CASE("a global problem is condensed") {
  const TemporaryFolder temporary("fclib");
  const auto path = temporary / "global.hdf5";
  {
    const auto file = new_file(path);
    const auto global = detail::create_hdf5_group(file, "fclib_global");
    detail::write_hdf5(global, "spacedim", 2);
    write_matrix(global, "M", -1, {0, 1, 2}, {0, 1}, {2, 4});
    // The matrix with the rows (1, 0) and (2, 8).
    write_matrix(global, "H", -2, {0, 1, 3}, {0, 0, 1}, {1, 2, 8});
    const auto vectors = detail::create_hdf5_group(global, "vectors");
    write_vector(vectors, "f", {4, -8});
    write_vector(vectors, "w", {0.5, 0.25});
    write_vector(vectors, "mu", {0.3});
  }
  const AnyFrictionProblem any = read_fclib(path);
  const auto& problem = std::get<FrictionProblem<Space<2>>>(any);
  Eigen::Matrix2d w;
  w << 1.5, 4, 4, 16;
  CHECK(Eigen::MatrixXd(problem.delassus).isApprox(w, 1e-14));
  CHECK(problem.free_velocity.isApprox(Eigen::Vector2d(2 - 4 + 0.5, -16 + 0.25), 1e-14));
  CHECK(problem.friction[0] == 0.3);
}

TEST_CASE("bad files are refused") {
  const TemporaryFolder temporary("fclib");
  const auto path = temporary / "w.hdf5";
  CHECK_FALSE(is_hdf5(folder + "Rover1039.dat"));
  CHECK_THROWS_WITH_AS(read_fclib(temporary / "missing"), doctest::Contains("missing: HDF5"),
                       std::runtime_error);
  CHECK_THROWS_AS(read_fclib(folder + "Rover1039.dat"), std::runtime_error);
  write_storage(path, -2, {0, 1, 4}, {0, 0, 1}, {1, 0.5, 2.5});
  CHECK_THROWS_WITH_AS(
      read_fclib(path),
      doctest::Contains("w.hdf5: read_fclib: W/p[2] = 4 must not exceed the entries of i and x"),
      std::invalid_argument);
  write_storage(path, -2, {0, 1, 3}, {0, 0, 7}, {1, 0.5, 2.5});
  CHECK_THROWS_WITH_AS(
      read_fclib(path),
      doctest::Contains("w.hdf5: read_fclib: column of an entry of W = 7 must lie in the matrix"),
      std::invalid_argument);
  write_storage(path, 1, {0}, {0}, {1}, 2, 2000000000);
  CHECK_THROWS_WITH_AS(read_fclib(path), doctest::Contains("W/n = 2000000000 must equal the size"),
                       std::invalid_argument);
  {
    write_storage(path, 1, {0}, {0}, {1});
    const detail::Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), &H5Fclose, "");
    const hsize_t many = hsize_t(1) << 40;
    H5Ldelete(file, "fclib_local/vectors/q", H5P_DEFAULT);
    const detail::Hdf5Handle space(H5Screate_simple(1, &many, nullptr), &H5Sclose, "");
    const detail::Hdf5Handle set(H5Dcreate2(file, "fclib_local/vectors/q", H5T_NATIVE_DOUBLE, space,
                                            H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                                 &H5Dclose, "");
  }
  CHECK_THROWS_WITH_AS(read_fclib(path), doctest::Contains("q claims 1099511627776 numbers"),
                       std::runtime_error);
  write_storage(path, -3, {0, 1, 3}, {0, 0, 1}, {1, 0.5, 2.5});
  CHECK_THROWS_AS(read_fclib(path), std::invalid_argument);
  write_storage(path, -2, {0, 1, 3}, {0, 0, 1}, {1, 0.5, 2.5}, 3);
  CHECK_THROWS_WITH_AS(
      read_fclib(path),
      doctest::Contains("w.hdf5: read_fclib: W.rows() = 2 must be D times the contacts"),
      std::invalid_argument);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  CHECK_THROWS_AS(read_fclib(path), std::runtime_error);
  FrictionProblem<Space<2>> problem;
  problem.friction.setOnes(1);
  CHECK_THROWS_AS(write_fclib(path, problem), std::invalid_argument);
}
