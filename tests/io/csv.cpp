// SPDX-License-Identifier: MIT
#include "moreau/io/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <doctest/doctest.h>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <sys/mman.h>
#include <sys/stat.h>
#include <thread>

#include "io/faults.hpp"
#include "io/temporary_folder.hpp"

using namespace moreau;

TEST_CASE("a table has its header and its numbers, shortest form") {
  const TemporaryFolder folder("csv");
  const auto path = folder / "wall.csv";
  {
    CsvWriter csv(path, {"t", "f", "x", "v", "f_g"});
    CHECK(read(path) == "t,f,x,v,f_g\n");
    csv.row(2e-4, 6000.0, -0.1, 0.1f, 1u);
    CHECK(read(path) == "t,f,x,v,f_g\n2e-04,6000,-0.1,0.1,1\n");
    csv.row(std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity(), 0.0,
            -0.0, std::size_t(1) << 63);
    csv.row(true, false, 1, -1, 0);
    const double nan = std::numeric_limits<double>::quiet_NaN();  // 0 / 0 has a sign on x86
    csv.row(std::copysign(nan, -1.), float(std::copysign(nan, -1.)), nan, 0, 0);
    CHECK(csv.rows() == 4);
  }
  CHECK(read(path) ==
        "t,f,x,v,f_g\n2e-04,6000,-0.1,0.1,1\nnan,-inf,0,-0,9223372036854775808\n1,0,1,-1,0\n"
        "nan,nan,nan,0,0\n");
}

TEST_CASE("columns say their units") {
  const TemporaryFolder folder("csv");
  CsvWriter csv(folder / "units.csv", {{"t", "s"}, {"v", "m/s"}, "contacts"});
  csv.row(0.5, 2.0, 7);
  CHECK(read(folder / "units.csv") == "t [s],v [m/s],contacts\n0.5,2,7\n");
  CsvWriter one(folder / "one.csv", {{"t", "s"}});
  CHECK(read(folder / "one.csv") == "t [s]\n");
}

TEST_CASE("numbers read back to the same bits") {
  const TemporaryFolder folder("csv");
  std::mt19937_64 random(1);
  std::vector<double> numbers = {5e-324, std::numeric_limits<double>::max(), 0.1 + 0.2};
  while (numbers.size() < 2000) {
    const std::uint64_t bits = random();
    double x;
    std::memcpy(&x, &bits, sizeof x);
    if (std::isfinite(x)) numbers.push_back(x);
  }
  CsvWriter csv(folder / "bits.csv", {"x"}, 64);
  for (const double x : numbers) csv.row(x);
  csv.close();
  std::istringstream text(read(folder / "bits.csv"));
  std::string line;
  std::getline(text, line);
  for (const double x : numbers) {
    std::getline(text, line);
    double back = 0;
    std::from_chars(line.data(), line.data() + line.size(), back);
    CHECK(std::memcmp(&back, &x, sizeof x) == 0);
  }
}

TEST_CASE("rows are held back by whole lines only") {
  const TemporaryFolder folder("csv");
  const auto path = folder / "rows.csv";
  CsvWriter csv(path, {"i", "square"}, 3);
  for (int i = 0; i < 5; ++i) csv.row(i, i * i);
  CHECK(read(path) == "i,square\n0,0\n1,1\n2,4\n");
  csv.flush();
  CHECK(read(path) == "i,square\n0,0\n1,1\n2,4\n3,9\n4,16\n");
}

TEST_CASE("a table goes on where it was") {
  const TemporaryFolder folder("csv");
  const auto path = folder / "rows.csv";
  std::uintmax_t size = 0;
  {
    CsvWriter csv(path, {"i"}, 3);
    for (int i = 0; i < 5; ++i) csv.row(i);
    size = csv.size();
    csv.row(5);
  }
  {
    CsvWriter csv(path, {"i"}, 1, size);
    csv.row(7);
    CHECK(csv.size() == size + 2);
  }
  CHECK(read(path) == "i\n0\n1\n2\n3\n4\n7\n");
  CHECK_THROWS_WITH_AS(CsvWriter(path, {"i"}, 1, 1000), doctest::Contains("cannot continue"),
                       std::system_error);
  CHECK(read(path).size() == size + 2);
}

TEST_CASE("a table that cannot be continued is rejected and left unchanged") {
  const TemporaryFolder folder("csv");
  const auto path = folder / "rows.csv";
  {
    CsvWriter csv(path, {{"t", "s"}, "i"});
    for (int i = 0; i < 3; ++i) csv.row(0.5, 10 * i);
  }
  const std::string text = read(path);
  REQUIRE(text == "t [s],i\n0.5,0\n0.5,10\n0.5,20\n");
  const auto goes_on = [&](std::initializer_list<CsvColumn> columns, std::uintmax_t keep) {
    return CsvWriter(path, columns, 1, keep).size();
  };
  const std::string short_of =
      "cannot continue '" + path.string() + "': it has 28 of the 1000 bytes to keep";
  CHECK_THROWS_WITH_AS(goes_on({{"t", "s"}, "i"}, 1000), doctest::Contains(short_of.c_str()),
                       std::system_error);
  const std::string other =
      "CsvWriter: columns = t [ms],i must be the header of '" + path.string() + "'";
  CHECK_THROWS_WITH_AS(goes_on({{"t", "ms"}, "i"}, 14), doctest::Contains(other.c_str()),
                       std::invalid_argument);
  CHECK_THROWS_AS(goes_on({{"t", "s"}}, 14), std::invalid_argument);
  CHECK_THROWS_AS(goes_on({{"t", "s"}, "i", "j"}, 14), std::invalid_argument);
  CHECK_THROWS_AS(goes_on({"a column whose name is longer than the table"}, 14),
                  std::invalid_argument);
  const std::string within =
      "CsvWriter: keep = 13 must be the end of a line of '" + path.string() + "'";
  CHECK_THROWS_WITH_AS(goes_on({{"t", "s"}, "i"}, 13), doctest::Contains(within.c_str()),
                       std::invalid_argument);
  CHECK_THROWS_AS(goes_on({{"t", "s"}, "i"}, 15), std::invalid_argument);
  CHECK_THROWS_AS(goes_on({{"t", "s"}, "i"}, 3), std::invalid_argument);
  CHECK(read(path) == text);
  CHECK(goes_on({{"t", "s"}, "i"}, 28) == 28);
  CHECK(read(path) == text);
  CHECK(goes_on({{"t", "s"}, "i"}, 14) == 14);
  CHECK(read(path) == text.substr(0, 14));
  CHECK(goes_on({{"t", "s"}, "i"}, 8) == 8);
  CHECK(read(path) == "t [s],i\n");
  try {
    CsvWriter csv(folder / "none.csv", {"i"}, 1, 2);
    FAIL("did not throw");
  } catch (const std::system_error& error) {
    CHECK(error.code() == std::errc::no_such_file_or_directory);
  }
}

TEST_CASE("bad tables are refused") {
  const TemporaryFolder folder("csv");
  const auto path = folder / "bad.csv";
  CHECK_THROWS_AS(CsvWriter(path, {}), std::invalid_argument);
  CHECK_THROWS_AS(CsvWriter(path, {"a", ""}), std::invalid_argument);
  CHECK_THROWS_AS(CsvWriter(path, {"a,b"}), std::invalid_argument);
  CHECK_THROWS_AS(CsvWriter(path, {{"a", "m,s"}}), std::invalid_argument);
  CHECK_THROWS_AS(CsvWriter(path, {{"", "m"}}), std::invalid_argument);
  for (const char* bad : {"a]", "[a", "a\nb", "a\rb", "a\"b"}) {
    CHECK_THROWS_AS(CsvWriter(path, {bad}), std::invalid_argument);
    CHECK_THROWS_AS(CsvWriter(path, {{"a", bad}}), std::invalid_argument);
  }
  CHECK_THROWS_AS(CsvWriter(path, {"a"}, 0), std::invalid_argument);
  CHECK_FALSE(std::filesystem::exists(path));
  CsvWriter csv(path, {"a", "b"});
  CHECK_THROWS_AS(csv.row(1.0), std::invalid_argument);
  CHECK_THROWS_AS(csv.row(1, 2, 3), std::invalid_argument);
  CHECK(read(path) == "a,b\n");
}

TEST_CASE("files that cannot be written are named") {
  const TemporaryFolder folder("csv");
  const auto nowhere = folder / "missing" / "wall.csv";
  try {
    CsvWriter csv(nowhere, {"t"});
    FAIL("did not throw");
  } catch (const std::system_error& error) {
    CHECK(std::string(error.what()).find(nowhere.string()) != std::string::npos);
    CHECK(error.code() == std::errc::no_such_file_or_directory);
  }
  if (!std::filesystem::exists("/dev/full")) return;
  try {
    CsvWriter csv("/dev/full", {"t"});
    FAIL("did not throw");
  } catch (const std::system_error& error) {
    CHECK(std::string(error.what()).find("/dev/full") != std::string::npos);
    CHECK(error.code() == std::errc::no_space_on_device);
  }
}

TEST_CASE("a disk that fills up leaves whole lines, and the table goes on when there is room") {
  const TemporaryFolder folder("csv");
  const auto path = folder / "rows.csv";
  for (const std::size_t flush_every : {std::size_t(1), std::size_t(4)}) {
    std::string told = "i,square\n";
    CsvWriter csv(path, {"i", "square"}, flush_every);
    {
      const FullDisk full(told.size() + 50);
      std::size_t whole = 0;
      CHECK_THROWS_AS(
          [&] {
            for (int i = 0; i < 100; ++i) {
              whole = told.size();
              told += std::to_string(i) + ',' + std::to_string(i * i) + '\n';
              csv.row(i, i * i);
            }
          }(),
          std::system_error);
      const std::string found = read(path);
      CHECK(found.back() == '\n');
      CHECK(told.starts_with(found));
      if (flush_every == 1) CHECK(found.size() == whole);
      CHECK_THROWS_AS(csv.flush(), std::system_error);
      CHECK(read(path) == found);
    }
    csv.flush();
    CHECK(read(path) == told);
  }
}

TEST_CASE("a folder that may not be written to is named") {
  const TemporaryFolder folder("csv");
  const UnwritableFolder closed(folder / "");
  try {
    CsvWriter csv(folder / "wall.csv", {"t"});
    FAIL("did not throw");
  } catch (const std::system_error& error) {
    CHECK(std::string(error.what()).find((folder / "wall.csv").string()) != std::string::npos);
    CHECK(error.code() == std::errc::permission_denied);
  }
}

TEST_CASE("a run that is killed leaves all rows that it had written") {
  const TemporaryFolder folder("csv");
  const auto path = folder / "rows.csv";
  // Memory shared with the process that writes the file.
  auto* told = static_cast<volatile int*>(
      mmap(nullptr, sizeof(int), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  for (int k = 0; k < 10; ++k) {
    CsvWriter csv(path, {"i", "square"});
    *told = 0;
    kill_while(std::chrono::microseconds(500 + 331 * k), [&] {
      csv.row(*told, *told * 0.1);
      *told = *told + 1;
    });
    CsvWriter whole(folder / "whole.csv", {"i", "square"}, 1000);
    for (int i = 0; i <= *told; ++i) whole.row(i, i * 0.1);
    whole.close();
    const std::string found = read(path);
    CHECK(read(folder / "whole.csv").starts_with(found));
    CHECK(std::count(found.begin(), found.end(), '\n') > *told);
  }
}

TEST_CASE("a file is replaced as a whole or left as it was") {
  const TemporaryFolder folder("atomic");
  const auto path = folder / "series.pvd";
  write_atomically(path, "first");
  write_atomically(path, "second");
  CHECK(read(path) == "second");
  CHECK_FALSE(std::filesystem::exists(folder / "series.pvd.part"));
  std::filesystem::create_directory(folder / "taken");
  std::ofstream(folder / "taken" / "file") << "x";
  CHECK_THROWS_AS(write_atomically(folder / "taken", "x"), std::system_error);
  CHECK_FALSE(std::filesystem::exists(folder / "taken.part"));
  CHECK_THROWS_AS(write_atomically(folder / "missing" / "file", "x"), std::system_error);
}

TEST_CASE("a link stays a link, and what is no file is written to") {
  const TemporaryFolder folder("atomic");
  std::filesystem::create_directory(folder / "disk");
  std::filesystem::create_symlink("disk/run.snapshot", folder / "link");
  for (const char* text : {"first", "second"}) {
    write_atomically(folder / "link", text);
    CHECK(std::filesystem::is_symlink(folder / "link"));
    CHECK(read(folder / "disk" / "run.snapshot") == text);
  }
  const auto pipe = folder / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  std::string got;
  std::thread reader([&] { got = read(pipe); });
  write_atomically(pipe, "through");
  reader.join();
  CHECK(got == "through");
  CHECK(std::filesystem::is_fifo(pipe));
}

TEST_CASE("a file that cannot be replaced is named as the caller named it") {
  const TemporaryFolder folder("atomic");
  const auto missing = folder / "missing" / "series.pvd";
  try {
    write_atomically(missing, "x");
    FAIL("did not throw");
  } catch (const std::system_error& error) {
    CHECK(error.what() ==
          "cannot write '" + missing.string() +
              "' through 'series.pvd.part' in the same folder: No such file or directory");
    CHECK(error.code() == std::errc::no_such_file_or_directory);
  }
  const auto taken = folder / "taken";
  std::filesystem::create_directory(taken);
  const std::string says = "cannot write '" + taken.string() + "' through";
  CHECK_THROWS_WITH_AS(write_atomically(taken, "x"), doctest::Contains(says.c_str()),
                       std::system_error);
}
