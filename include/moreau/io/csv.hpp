// SPDX-License-Identifier: MIT
// Writes tables of numbers as comma-separated values.
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "moreau/core/error.hpp"
#include "moreau/io/output_file.hpp"

namespace moreau {

/// The name of a column and the unit of its numbers. The header of {"x", "m"} is "x [m]", the
/// header of "x" is "x".
struct CsvColumn {
  std::string_view name;  ///< not empty
  std::string_view unit;  ///< if empty, no unit is written

  /// Not explicit, so that a string converts to a column without unit.
  constexpr CsvColumn(const char* name_in, const char* unit_in = "")
      : name(name_in), unit(unit_in) {}
};

/// Writes a table row by row. Each number has the smallest number of digits from which the same
/// bits are read back. NaN and infinity are written as nan and inf. The file receives only whole
/// lines, so it is a valid table even if the program is interrupted. Writing a row allocates memory
/// only if the row is longer than all earlier rows.
class CsvWriter {
 public:
  /// Creates the file and writes the header line, or continues an existing table.
  /// @param columns     names and units, e.g. {{"t", "s"}, {"x", "m"}, "contacts"}: the header is
  ///                    "t [s],x [m],contacts"
  /// @param flush_every number of rows per write to the file, > 0; 1 writes every row immediately
  /// @param keep        if > 0, an existing table is continued: its first `keep` bytes stay, the
  ///                    rest is removed, and new rows are appended. Pass a value that size()
  ///                    returned
  /// @throws std::system_error naming the path if the file cannot be created or written, or has
  ///                           fewer than `keep` bytes
  /// @throws std::invalid_argument if there are no columns; if a name is empty; if a name or unit
  ///                               contains a comma, a quote, a bracket or a line break; if
  ///                               flush_every is 0; if the existing table has a different header,
  ///                               or no line of it ends at `keep` bytes (the table is then
  ///                               unchanged)
  CsvWriter(const std::filesystem::path& path, std::initializer_list<CsvColumn> columns,
            std::size_t flush_every = 1, std::uintmax_t keep = 0)
      : columns_(columns.size()),
        flush_every_(flush_every),
        written_(keep),
        file_(checked(path, columns, flush_every, keep), keep) {
    if (keep > 0) return;
    lines_ = header(columns) + '\n';
    flush();
  }
  /// Moves the open file to the new object.
  CsvWriter(CsvWriter&&) = default;
  CsvWriter& operator=(CsvWriter&&) = delete;
  /// Writes the remaining rows and ignores errors. Call close() first if you need to know of
  /// errors.
  ~CsvWriter() {
    try {
      close();
    } catch (const std::exception&) {
    }
  }

  const std::filesystem::path& path() const { return file_.path(); }  ///< path of the file
  std::size_t rows() const { return rows_; }  ///< number of rows added to this object
  /// Size of the table so far [bytes], including rows that are not yet in the file.
  std::uintmax_t size() const { return written_ + lines_.size(); }

  /// Adds a row of numbers (floating-point, integer, or bool as 0 or 1), one per column.
  /// @throws std::system_error naming the path if the file cannot be written, e.g. on a full disk
  /// @throws std::invalid_argument if the number of values is not the number of columns
  template <class... Numbers>
  requires(std::is_arithmetic_v<Numbers>&&...) void row(Numbers... numbers) {
    require(sizeof...(numbers) == columns_, "CsvWriter::row", "number of values",
            sizeof...(numbers), "must be the number of columns");
    const std::size_t start = lines_.size();
    (append(numbers, start), ...);
    lines_ += '\n';
    if (++rows_ % flush_every_ == 0) flush();
  }

  /// Passes all rows added so far to the operating system.
  /// @throws std::system_error naming the path if the file cannot be written
  void flush() {
    if (lines_.empty()) return;
    file_.write(lines_);
    written_ += lines_.size();
    lines_.clear();
  }
  /// Calls flush() and waits until all rows are on the disk. Call it before you write a snapshot
  /// that contains size(). Then, even after a power failure, the table has at least the size in the
  /// snapshot.
  /// @throws std::system_error naming the path if the file cannot be written
  void sync() {
    flush();
    file_.sync();
  }
  /// Calls flush() and closes the file. Do not call row() afterwards.
  /// @throws std::system_error naming the path if the file cannot be written
  void close() {
    flush();
    file_.close();
  }

 private:
  static const std::filesystem::path& checked(const std::filesystem::path& path,
                                              std::initializer_list<CsvColumn> columns,
                                              std::size_t flush_every, std::uintmax_t keep) {
    require(columns.size() > 0, "CsvWriter", "columns.size()", columns.size(), "must be > 0");
    require(flush_every > 0, "CsvWriter", "flush_every", flush_every, "must be > 0");
    for (const CsvColumn& column : columns) {
      const auto is_plain = [](std::string_view text) {
        return text.find_first_of(",\"[]\r\n") == std::string_view::npos;
      };
      require(!column.name.empty() && is_plain(column.name), "CsvWriter", "column", column.name,
              "must be a name without comma, quote, bracket and line break");
      require(is_plain(column.unit), "CsvWriter", "unit", column.unit,
              "must have no comma, quote, bracket and line break");
    }
    if (keep > 0) check_table(path, header(columns), keep);
    return path;
  }

  static std::string header(std::initializer_list<CsvColumn> columns) {
    std::string line;
    for (const CsvColumn& column : columns) {
      if (!line.empty()) line += ',';
      line += column.name;
      if (!column.unit.empty()) line.append(" [").append(column.unit) += ']';
    }
    return line;
  }
  /// Checks an existing table that is to be continued. OutputFile rejects a missing or short file.
  static void check_table(const std::filesystem::path& path, const std::string& header,
                          std::uintmax_t keep) {
    std::error_code error;
    if (std::filesystem::file_size(path, error) < keep || error) return;
    std::ifstream file(path, std::ios::binary);
    std::string found(header.size() + 1, '\0');
    file.read(found.data(), static_cast<std::streamsize>(found.size()));
    if (!file.is_open() || file.bad())
      throw std::system_error(std::make_error_code(std::errc::io_error),
                              "cannot read '" + path.string() + "' to continue it");
    require(file && found == header + '\n', "CsvWriter", "columns", header,
            "must be the header of '" + path.string() + "' to continue it");
    file.seekg(static_cast<std::streamoff>(keep - 1));
    require(file.get() == '\n', "CsvWriter", "keep", keep,
            "must be the end of a line of '" + path.string() + "'");
  }

  void append(bool yes, std::size_t start) { append(yes ? 1 : 0, start); }
  void append(auto number, std::size_t start) {
    if (lines_.size() > start) lines_ += ',';
    if constexpr (std::is_floating_point_v<decltype(number)>)
      if (std::isnan(number)) {  // without the sign that a NaN may have
        lines_ += "nan";
        return;
      }
    char digits[64];  // the shortest form of a double has at most 24 characters
    const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
    lines_.append(digits, end);
  }

  std::size_t columns_, flush_every_, rows_ = 0;
  std::uintmax_t written_;
  std::string lines_;
  OutputFile file_;
};

}  // namespace moreau
