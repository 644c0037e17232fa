// SPDX-License-Identifier: MIT
// Columns of numbers from a CSV file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace study {

/// Values with their names, in the order of a file.
template <class T>
using Named = std::vector<std::pair<std::string, T>>;
using Columns = Named<std::vector<double>>;

/// Rounded to six digits: what a figure can show.
inline double six(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return std::strtod(text, nullptr);
}

class Table {
 public:
  /// @throws std::runtime_error naming the file, and the line that has not one number for every
  ///         column or no end
  explicit Table(const std::filesystem::path& path) : path_(path) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line)) throw std::runtime_error("cannot read " + path.string());
    for (std::size_t at = 0; at <= line.size();) {
      const std::size_t end = std::min(line.find(',', at), line.size());
      names_.push_back(line.substr(at, end - at));
      at = end + 1;
    }
    columns_.resize(names_.size());
    while (std::getline(file, line))
      if (file.eof() || !add_row(line))
        throw std::runtime_error(path.string() + ": line " + std::to_string(rows() + 2) + ", '" +
                                 line.substr(0, 40) + "', is not " + std::to_string(names_.size()) +
                                 " numbers");
  }

  std::size_t rows() const { return columns_.front().size(); }
  /// @throws std::runtime_error if there is no such column
  const std::vector<double>& operator[](const std::string& name) const {
    const auto place = std::find(names_.begin(), names_.end(), name);
    if (place == names_.end()) throw std::runtime_error(path_.string() + " has no column " + name);
    return columns_[std::size_t(place - names_.begin())];
  }

 private:
  /// @returns whether the line is one number for every column
  bool add_row(const std::string& line) {
    std::vector<double> values;
    for (const char* text = line.c_str();; ++text) {
      char* end = nullptr;
      values.push_back(std::strtod(text, &end));
      if (end == text || (*end != ',' && *end != '\0')) return false;
      text = end;
      if (*end == '\0') break;
    }
    if (values.size() != columns_.size()) return false;
    for (std::size_t k = 0; k < values.size(); ++k) columns_[k].push_back(values[k]);
    return true;
  }

  std::filesystem::path path_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> columns_;
};

/// Value of a column at the first row whose t is not before the given time; the last one's after
/// the end. t rises.
inline double value_at(const Table& table, const std::string& column, double t) {
  const std::vector<double>& time = table["t"];
  const auto row = std::lower_bound(time.begin(), time.end(), t - 1e-9);
  return table[column][row == time.end() ? time.size() - 1 : std::size_t(row - time.begin())];
}

}  // namespace study
