// SPDX-License-Identifier: MIT
#include "moreau/io/siconos_text.hpp"

#include <doctest/doctest.h>
#include <fstream>
#include <string>

#include "moreau/instances/friction_problems.hpp"

#include "io/temporary_folder.hpp"

using namespace moreau;

namespace {

const std::string folder = MOREAU_TEST_DATA "fclib/";

double solved_residual(const AnyFrictionProblem& problem) {
  return std::visit(
      [](const auto& p) {
        Eigen::VectorXd r;
        ProximalSolver().solve(p, r);
        return natural_map_residual(p, r);
      },
      problem);
}

std::string error_of(const std::string& text) {
  try {
    parse_siconos_text(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("dense: column by column") {
  const AnyFrictionProblem any = read_siconos_text(folder + "FrictionContact3D_1c.dat");
  const auto& problem = std::get<FrictionProblem<Space<3>>>(any);
  Eigen::Matrix3d w;
  w << 15, -1, -2, -1, 14, 1, -2, 1, 16;
  CHECK(Eigen::MatrixXd(problem.delassus) == w);
  CHECK(problem.free_velocity == Eigen::Vector3d(-1, 2, 3));
  CHECK(problem.friction[0] == 0.1);
  const AnyFrictionProblem turned =
      parse_siconos_text("2 1 0 2 2 2 2  1 0.5  0.25 3  -1 0  +0.3 0");
  const Eigen::MatrixXd skew = std::get<FrictionProblem<Space<2>>>(turned).delassus;
  CHECK(skew(1, 0) == 0.5);
  CHECK(skew(0, 1) == 0.25);
}

TEST_CASE("blocks: W comes out symmetric") {
  const AnyFrictionProblem any = read_siconos_text(folder + "FrictionContactProblem00031.dat");
  const auto& problem = std::get<FrictionProblem<Space<2>>>(any);
  CHECK(problem.size() == 11);
  const Eigen::MatrixXd w = problem.delassus;
  CHECK((w - w.transpose()).norm() <= 1e-15);
  CHECK(w(0, 0) == 4.435920e-01);
  CHECK((w.array() != 0).count() > 22);
}

TEST_CASE("sparse: columns, rows, triplets and half of a symmetric matrix") {
  const std::string head = "CSparse Version 3.1.9, May 4, 2016.  Copyright (c) Somebody\n";
  const std::string tail = "\n-1 0.5\n0.3\n";
  const std::string lists =
      "2-by-2, nzmax: 3 nnz: 3, 1-norm: 2.5\n    col 0 : locations 0 to 1\n      0 : 1\n      1 : "
      "0.5\n    col 1 : locations 2 to 2\n      1 : 2.5e+00\n";
  Eigen::Matrix2d by_columns, by_rows, symmetric;
  by_columns << 1, 0, 0.5, 2.5;
  by_rows << 1, 0.5, 0, 2.5;
  symmetric << 1, 0.5, 0.5, 2.5;
  const auto w = [&](const std::string& origin, const std::string& body) {
    const auto any = parse_siconos_text("2\n1\n2\n2\n2\n" + origin + "\n" + head + body + tail);
    return Eigen::MatrixXd(std::get<FrictionProblem<Space<2>>>(any).delassus);
  };
  CHECK(w("2", lists) == by_columns);
  CHECK(w("3", lists) == by_rows);
  const std::string triplets =
      "triplet: 2-by-2, nzmax: 9 nnz: 3\n 0 0 : 1\n 1 0 : 0.5\n 1 1 : 2.5\n";
  CHECK(w("1", triplets) == by_columns);
  CHECK(w("4", triplets) == symmetric);
}

TEST_CASE("what is read is solved") {
  for (const char* name :
       {"FrictionContact3D_1c.dat", "FrictionContactProblem00031.dat", "Rover1039.dat",
        "FC2D_SliderCrankLagrangian00000.dat", "OneObject-i1028-138.hdf5.dat"})
    CHECK_MESSAGE(solved_residual(read_siconos_text(folder + name)) <= 1e-10, name);
}

TEST_CASE("bad texts are refused by name") {
  const std::string self = "parse_siconos_text: ";
  CHECK(error_of("") == self + "dimension =  must be an integer >= 0");
  CHECK(error_of("4 1 0 4 4 4 4 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 0") ==
        self + "dimension = 4 must be 2 or 3");
  CHECK(error_of("2 1 7 2 2") == self + "storage of W = 7 must be 0, 1 or 2");
  CHECK(error_of("2 1 0 2 2 2 2 1 0 0 nan -1 0 0.3") == self + "W = nan must be a finite number");
  CHECK(error_of("2 1 0 2 2 2 2 1 0 0 -1 -1 0 0.3") ==
        self + "W(1, 1) = -1 must be finite, and >= 0 on the diagonal");
  CHECK(error_of("2 1 0 2 2 2 2 1 0 0 1 -1 0 -0.3") ==
        self + "mu[0] = -0.3 must be finite and >= 0");
  CHECK(
      error_of("2 2 0 2 2 2 2 1 0 0 1 -1 0 0.3 0.3") ==
      self +
          "rows of W = 2 must be D times the contacts, 4; a global problem (M, H, q, b, mu) is not "
          "read from text: save it with FCLIB");
  CHECK(error_of("2 1 0 2000000000 2000000000 2000000000 2000000000 1").find("W = ") !=
        std::string::npos);
  CHECK(error_of("2 1 1 2 2 1 1 1 2 2 2 1 0 9 0 0 1 0 0 1 -1 0 0.3").find("index1") !=
        std::string::npos);
  CHECK(error_of("2 2 1 4 4 2 2 2 2 4 2 4 3 2 0 1 1 0 1 0 1 0 0 1 1 2 0 0 2 0.5 0 -1 0 0.3 0.3") ==
        self + "index1 = 1 must end at the number of blocks");
  CHECK(error_of("2 1 1 2 2 1 1 1 2 2 2 1 0 1 7 0 1 0 0 1 -1 0 0.3").find("index2") !=
        std::string::npos);
  CHECK(error_of("2 1 0 2 2 2 2 1 1e-400 0 1e400 -1 0 0.3") ==
        self + "W = 1e400 must be a finite number");
  CHECK(error_of("2 1 2 2 2 2 2-by-2, nzmax: 1 nnz: 1, 1-norm: 1\ncol 0 : locations 0 to x") ==
        self + "location = x must be an integer >= -1");
  CHECK(error_of("2 1 2 2 2000000000 1 x triplet: 2-by-2, nzmax: 1 nnz: 1\n0 0 : 1\n-1 0 0.3") ==
        self + "columns of W = 2000000000 must be as many as its rows");
  CHECK(error_of("2 1 2 2 2 2 nothing here").find("sparse W") != std::string::npos);
}

TEST_CASE("a file cut before its last coefficient of friction is refused, never read beyond") {
  const TemporaryFolder temporary("siconos");
  for (const char* name : {"FrictionContact3D_1c.dat", "FrictionContactProblem00031.dat"}) {
    std::string text = read(folder + name);
    const auto is_space = [](char c) { return std::isspace(static_cast<unsigned char>(c)); };
    // The last word of the file is a flag that is ignored. The friction coefficient before it may
    // be truncated and is then still a valid coefficient.
    while (is_space(text.back())) text.pop_back();
    while (!is_space(text.back())) text.pop_back();
    while (is_space(text.back())) text.pop_back();
    const std::size_t last = text.find_last_of(" \n");
    for (std::size_t size = 0; size < last; size += size + 200 < last ? 7 : 1)
      CHECK_THROWS_AS(parse_siconos_text(std::string_view(text).substr(0, size)),
                      std::invalid_argument);
  }
  const char strange[] = "\177ELF\0\1 and no more";
  std::ofstream(temporary / "strange").write(strange, sizeof strange - 1);
  CHECK_THROWS_WITH_AS(read_siconos_text(temporary / "strange"),
                       doctest::Contains("strange: parse_siconos_text: dimension = ?ELF?? must be"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(read_siconos_text(temporary / "missing"),
                       doctest::Contains("missing': No such file or directory"), std::system_error);
  CHECK_THROWS_WITH_AS(read_siconos_text(temporary / ""), doctest::Contains("Is a directory"),
                       std::system_error);
}

TEST_CASE("a global problem is refused, whatever its size and storage") {
  const auto matrix = [](int storage, int rows, int columns) {
    const std::string r = std::to_string(rows), c = std::to_string(columns);
    std::string text = std::to_string(storage) + "\n" + r + "\n" + c + "\n";
    if (storage == 0) {
      text += r + " " + c + "\n";
      for (int k = 0; k < rows * columns; ++k) text += k % (rows + 1) == 0 ? "1 " : "0 ";
    } else {
      const std::string entries = std::to_string(std::min(rows, columns));
      text += "1\nCSparse\ntriplet: " + r + "-by-" + c + ", nzmax: " + entries +
              " nnz: " + entries + "\n";
      for (int k = 0; k < std::min(rows, columns); ++k)
        text += std::to_string(k) + " " + std::to_string(k) + " : 1\n";
    }
    return text + "\n";
  };
  const auto numbers = [](int count) {
    std::string text;
    for (int k = 0; k < count; ++k) text += "0.25 ";
    return text + "\n";
  };
  for (const int dimension : {2, 3})
    for (const int contacts : {1, 2, 5})
      for (const int freedoms : {2, 3, 4, 6, 10, 12, 15})
        for (const int storage : {0, 2}) {
          const int rows = dimension * contacts;
          const std::string head =
              std::to_string(dimension) + "\n" + std::to_string(contacts) + "\n";
          const std::string global = head + matrix(storage, freedoms, freedoms) +
                                     matrix(storage, freedoms, rows) + numbers(freedoms) +
                                     numbers(rows) + numbers(contacts);
          CAPTURE(global);
          CHECK(error_of(global).find("a global problem (M, H, q, b, mu) is not read") !=
                std::string::npos);
          const std::string local = head + matrix(storage, rows, rows) + numbers(rows);
          CHECK(error_of(local + numbers(contacts)).empty());
          CHECK(error_of(local + numbers(contacts) + "1\n").empty());
        }
  // A velocity that looks like the head of a matrix is none.
  CHECK(error_of("2 1 0 2 2 2 2 1 0 0 1  2 2 0.5  1").empty());
  CHECK(error_of("2 2 0 4 4 4 4 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1  0 4 4 4 0.5 0.5 1").empty());
}
