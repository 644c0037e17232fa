// SPDX-License-Identifier: MIT
// Reads contact problems in the text format of Siconos/Numerics (github.com/siconos/siconos). A
// file contains the dimension, the number of contacts, W in one of three storage formats, q (the
// free velocity b), and mu. In each contact the normal component comes first.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/io/detail/input_file.hpp"
#include "moreau/io/detail/parse_number.hpp"
#include "moreau/io/friction_file.hpp"

namespace moreau {

namespace detail {

/// Reads the words of a text one by one.
class TextScanner {
 public:
  TextScanner(std::string_view text, std::string_view function)
      : text_(text), function_(function) {}

  /// The next word; empty at the end of the text.
  std::string_view word() {
    const std::size_t start = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size());
    at_ = std::min(text_.find_first_of(" \t\r\n", start), text_.size());
    return text_.substr(start, at_ - start);
  }
  double number(std::string_view name) {
    const std::string_view next = word();
    double value = 0;
    if (!parse_number(next, value) || !std::isfinite(value))
      throw_invalid(function_, name, shown(next), "must be a finite number");
    return value;
  }
  int integer(std::string_view name, int least = 0) {
    std::string_view next = word();
    if (next.ends_with(',')) next.remove_suffix(1);
    double value = 0;  // large indices may be printed as 1e+06
    if (!parse_number(next, value) || value != std::floor(value) ||
        !(value >= least && value < 2147483647.))
      throw_invalid(function_, name, shown(next), "must be an integer >= " + std::to_string(least));
    return static_cast<int>(value);
  }
  void expect(std::string_view expected) {
    const std::string_view next = word();
    if (next != expected)
      throw_invalid(function_, "word", shown(next), "must be '" + std::string(expected) + "'");
  }
  /// Checks that the rest of the text is long enough for `count` numbers, so that a wrong size in a
  /// file cannot cause a huge allocation.
  void require_room(std::size_t count, std::string_view name) const {
    require(2 * count <= text_.size() - at_ + 1, function_, name, count,
            "must not exceed the numbers in the file");
  }
  void skip_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }
  std::string_view function() const { return function_; }

 private:
  std::string_view text_, function_;
  std::size_t at_ = 0;
};

inline std::vector<double> scan_numbers(TextScanner& scan, std::size_t count,
                                        std::string_view name) {
  scan.require_room(count, name);
  std::vector<double> numbers(count);
  for (double& x : numbers) x = scan.number(name);
  return numbers;
}
inline std::vector<int> scan_integers(TextScanner& scan, int count, std::string_view name) {
  scan.require_room(std::size_t(count), name);
  std::vector<int> numbers(static_cast<std::size_t>(count));
  for (int& x : numbers) x = scan.integer(name);
  return numbers;
}

struct TextMatrix {
  int rows = 0, columns = 0;
  Triplets entries;
};

/// Storage format 0: the numbers of rows and columns, then all values column by column.
inline void scan_dense(TextScanner& scan, TextMatrix& raw) {
  const int rows = scan.integer("rows"), columns = scan.integer("columns");
  require(rows == raw.rows && columns == raw.columns, scan.function(), "size of dense W", rows,
          "must be the size of W");
  scan.require_room(std::size_t(rows) * std::size_t(columns), "W");
  for (int column = 0; column < columns; ++column)
    for (int row = 0; row < rows; ++row) {
      const double value = scan.number("W");
      if (value != 0) raw.entries.emplace_back(row, column, value);
    }
}

/// The first row or column of each block, computed from the cumulative block sizes in the file.
inline std::vector<int> scan_block_starts(TextScanner& scan, int blocks, int total) {
  std::vector<int> starts = scan_integers(scan, blocks, "block size");
  starts.insert(starts.begin(), 0);
  for (std::size_t k = 1; k < starts.size(); ++k)
    require(starts[k] > starts[k - 1], scan.function(), "cumulative block size", starts[k],
            "must increase");
  require(starts.back() == total, scan.function(), "cumulative block size", starts.back(),
          "must end at the size of W");
  return starts;
}

/// Storage format 1: compressed rows of blocks. Each block has its number, then its values column
/// by column.
inline void scan_blocks(TextScanner& scan, TextMatrix& raw) {
  const int blocks = scan.integer("number of blocks");
  const int block_rows = scan.integer("block rows"), block_columns = scan.integer("block columns");
  const std::vector<int> row_start = scan_block_starts(scan, block_rows, raw.rows);
  const std::vector<int> column_start = scan_block_starts(scan, block_columns, raw.columns);
  const int filled1 = scan.integer("filled1"), filled2 = scan.integer("filled2");
  const std::vector<int> first = scan_integers(scan, filled1, "index1");
  const std::vector<int> column_of = scan_integers(scan, filled2, "index2");
  require(filled2 == blocks, scan.function(), "filled2", filled2, "must be the number of blocks");
  const int end = first.empty() ? 0 : first.back();
  require(end == blocks, scan.function(), "index1", end, "must end at the number of blocks");
  for (int row = 0; row + 1 < filled1; ++row) {
    const auto here = std::size_t(row);
    require(first[here + 1] >= first[here] && first[here + 1] <= blocks, scan.function(), "index1",
            first[here + 1], "must increase to the number of blocks");
    if (first[here + 1] > first[here])
      require(row < block_rows, scan.function(), "index1", row, "must have a row for each block");
    for (int block = first[here]; block < first[here + 1]; ++block) {
      const int column = column_of[std::size_t(block)];
      require(column < block_columns, scan.function(), "index2", column, "must be a block column");
      const int number = scan.integer("block number");
      require(number == block, scan.function(), "block number", number, "must count up from 0");
      for (int j = column_start[std::size_t(column)]; j < column_start[std::size_t(column) + 1];
           ++j)
        for (int i = row_start[here]; i < row_start[here + 1]; ++i)
          raw.entries.emplace_back(i, j, scan.number("W"));
    }
  }
}

/// Storage format 2: the output of CSparse. It contains triplets, or lists by columns (by rows if
/// `origin` is 3).
inline void scan_sparse(TextScanner& scan, TextMatrix& raw) {
  constexpr int compressed_rows = 3, half_of_symmetric = 4;
  const int origin = scan.integer("origin of sparse W");
  std::string_view word, before;
  while ((word = scan.word()).find("-by-") == std::string_view::npos) {
    require(!word.empty(), scan.function(), "sparse W", word, "must have a line with its size");
    before = word;
  }
  scan.expect("nzmax:");
  scan.word();
  scan.expect("nnz:");
  const int entries = scan.integer("nnz");
  scan.require_room(std::size_t(entries), "nnz");
  scan.skip_line();
  const auto add = [&](int row, int column, double value) {
    raw.entries.emplace_back(row, column, value);
    if (origin == half_of_symmetric && row != column) raw.entries.emplace_back(column, row, value);
  };
  if (before == "triplet:") {
    for (int k = 0; k < entries; ++k) {
      const int row = scan.integer("row"), column = scan.integer("column");
      scan.expect(":");
      add(row, column, scan.number("W"));
    }
    return;
  }
  const bool by_rows = origin == compressed_rows;
  for (int outer = 0; outer < (by_rows ? raw.rows : raw.columns); ++outer) {
    scan.expect("col");
    scan.integer("col");
    scan.expect(":");
    scan.expect("locations");
    const int first = scan.integer("location");
    scan.expect("to");
    const int last = scan.integer("location", -1);
    for (int k = first; k <= last; ++k) {
      const int inner = scan.integer("index");
      scan.expect(":");
      const double value = scan.number("W");
      by_rows ? add(outer, inner, value) : add(inner, outer, value);
    }
  }
}

/// A global problem begins with M, which has a row per degree of freedom of the bodies.
inline void require_local_size(std::string_view function, std::int64_t wanted, int rows) {
  if (rows != wanted)
    throw_invalid(
        function, "rows of W", rows,
        "must be D times the contacts, " + std::to_string(wanted) +
            "; a global problem (M, H, q, b, mu) is not read from text: save it with FCLIB");
}
/// In a global problem whose M happens to have the size of W, the matrix H follows: its storage, rows
/// and columns, and many more numbers than q and mu have.
inline void require_no_second_matrix(TextScanner scan, int rows, int contacts) {
  const std::string_view storage = scan.word();
  const std::string size = std::to_string(rows);
  const bool is_head = (storage == "0" || storage == "1" || storage == "2") &&
                       scan.word() == size && scan.word() == size;
  if (!is_head) return;
  const std::int64_t of_local = std::int64_t(rows) + contacts + 1;  // q, mu and a flag
  std::int64_t words = 3;
  while (words <= of_local && !scan.word().empty()) ++words;
  if (words > of_local)
    throw_invalid(
        scan.function(), "matrix after W", size + " x " + size,
        "must not exist: a global problem (M, H, q, b, mu) is not read from text; save it "
        "with FCLIB");
}

}  // namespace detail

/// Reads a local contact problem from a text, in the units of the text; a global problem, of the
/// matrices M and H, is refused. Text after mu is ignored, because
/// many files have a flag there. A text that is truncated inside its last number is accepted,
/// because some files have no line break at the end.
/// @throws std::invalid_argument naming the first error if the text is not a valid problem
inline AnyFrictionProblem parse_siconos_text(std::string_view text) {
  constexpr std::string_view self = "parse_siconos_text";
  constexpr int dense = 0, sparse_blocks = 1, sparse = 2;
  detail::TextScanner scan(text, self);
  detail::RawFrictionProblem raw;
  raw.rows_per_contact = scan.integer("dimension");
  const int contacts = scan.integer("contacts");
  const int storage = scan.integer("storage of W");
  detail::TextMatrix w;
  w.rows = scan.integer("rows of W");
  w.columns = scan.integer("columns of W");
  detail::require_local_size(self, std::int64_t(raw.rows_per_contact) * contacts, w.rows);
  require(w.columns == w.rows, self, "columns of W", w.columns, "must be as many as its rows");
  switch (storage) {
    case dense:
      detail::scan_dense(scan, w);
      break;
    case sparse_blocks:
      detail::scan_blocks(scan, w);
      break;
    case sparse:
      detail::scan_sparse(scan, w);
      break;
    default:
      throw_invalid(self, "storage of W", storage, "must be 0, 1 or 2");
  }
  detail::require_no_second_matrix(scan, w.rows, contacts);
  raw.free_velocity = detail::scan_numbers(scan, std::size_t(w.rows), "q");
  raw.friction = detail::scan_numbers(scan, std::size_t(contacts), "mu");
  raw.delassus = detail::checked_matrix(w.rows, w.columns, w.entries, self, "W");
  return detail::checked_problem(raw, self);
}

/// Reads a contact problem from a file; see parse_siconos_text().
/// @throws std::system_error naming the path if the file cannot be read or is empty
/// @throws std::invalid_argument naming the path and the first error if it is not a valid problem
inline AnyFrictionProblem read_siconos_text(const std::filesystem::path& path) {
  const std::string text = detail::read_file(path, "read_siconos_text");
  if (text.empty())
    throw std::system_error(std::make_error_code(std::errc::invalid_argument),
                            "read_siconos_text: '" + path.string() + "' is empty");
  try {
    return parse_siconos_text(text);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(path.string() + ": " + error.what());
  }
}

}  // namespace moreau
