// SPDX-License-Identifier: MIT
// Tables of numbers as comma-separated values.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
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

/// The name of a column and the unit of its numbers: {"x", "m"} is headed "x [m]", "x" alone "x".
struct CsvColumn {
  std::string_view name;  ///< not empty
  std::string_view unit;  ///< empty: none is written

  /// Not explicit, so that a name alone is a column.
  constexpr CsvColumn(const char* name_in, const char* unit_in = "")
      : name(name_in), unit(unit_in) {}
};

/// Writes one row at a time. Numbers are as short as they can be and still read back to the same
/// bits; nan and inf are written so. Only whole lines go to the file, so an interrupted run leaves
/// a valid one. No allocation per row once the longest has been written.
class CsvWriter {
 public:
  /// Creates the file and writes the header line, or goes on with a table that is there.
  /// @param columns     names and units, e.g. {{"t", "s"}, {"x", "m"}, "contacts"}: the header is
  ///                    "t [s],x [m],contacts"
  /// @param flush_every rows that may be held back, > 0; 1 writes every row at once
  /// @param keep        > 0: goes on with a table that is there behind so many bytes, as size()
  ///                    gave them, and cuts off what follows them
  /// @throws std::system_error naming the path if the file cannot be created or written, or has
  ///         less than `keep`
  /// @throws std::invalid_argument without columns, for a name that is empty, a name or unit that
  ///         holds a comma, a quote, a bracket or a line break, for flush_every = 0, or if the
  ///         table that is there has another header or no line that ends at `keep`; it is then as
  ///         it was
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
  /// Hands the file on.
  CsvWriter(CsvWriter&&) = default;
  CsvWriter& operator=(CsvWriter&&) = delete;
  /// Writes what is held back; an error then goes unseen: call close() to see it.
  ~CsvWriter() {
    try {
      close();
    } catch (const std::exception&) {
    }
  }

  const std::filesystem::path& path() const { return file_.path(); }  ///< of the file
  std::size_t rows() const { return rows_; }                          ///< given to this object
  /// Bytes of the table so far, with those that are held back.
  std::uintmax_t size() const { return written_ + lines_.size(); }

  /// Adds a row of numbers (floating-point or integers), as many as there are columns.
  /// @throws std::system_error naming the path if the file cannot be written, e.g. for a full disk
  /// @throws std::invalid_argument for another number of values
  template <class... Numbers>
  requires(std::is_arithmetic_v<Numbers>&&...) void row(Numbers... numbers) {
    require(sizeof...(numbers) == columns_, "CsvWriter::row", "number of values",
            sizeof...(numbers), "must be the number of columns");
    const std::size_t start = lines_.size();
    (append(numbers, start), ...);
    lines_ += '\n';
    if (++rows_ % flush_every_ == 0) flush();
  }

  /// Hands all rows so far to the operating system.
  /// @throws std::system_error naming the path if the file cannot be written
  void flush() {
    if (lines_.empty()) return;
    file_.write(lines_);
    written_ += lines_.size();
    lines_.clear();
  }
  /// flush(), then waits until all of it is on the disk: before a snapshot that says how long the
  /// table is, so that it is no shorter even where the power fails.
  /// @throws std::system_error naming the path if the file cannot be written
  void sync() {
    flush();
    file_.sync();
  }
  /// flush(), then closes the file. No row() after it.
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
  /// Of a table to go on with. One that is missing or too short is for OutputFile to refuse.
  static void check_table(const std::filesystem::path& path, const std::string& header,
                          std::uintmax_t keep) {
    std::error_code error;
    if (std::filesystem::file_size(path, error) < keep || error) return;
    std::ifstream file(path, std::ios::binary);
    std::string found(header.size() + 1, '\0');
    file.read(found.data(), static_cast<std::streamsize>(found.size()));
    if (!file.is_open() || file.bad())
      throw std::system_error(std::make_error_code(std::errc::io_error),
                              "cannot read '" + path.string() + "' to go on with it");
    require(file && found == header + '\n', "CsvWriter", "columns", header,
            "must be the header of '" + path.string() + "' to go on with it");
    file.seekg(static_cast<std::streamoff>(keep - 1));
    require(file.get() == '\n', "CsvWriter", "keep", keep,
            "must be where a line of '" + path.string() + "' ends");
  }

  void append(auto number, std::size_t start) {
    if (lines_.size() > start) lines_ += ',';
    char digits[64];  // the longest shortest form of a double has 24
    const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
    lines_.append(digits, end);
  }

  std::size_t columns_, flush_every_, rows_ = 0;
  std::uintmax_t written_;
  std::string lines_;
  OutputFile file_;
};

}  // namespace moreau
