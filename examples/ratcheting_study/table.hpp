// SPDX-License-Identifier: MIT
// Columns of numbers from a CSV file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace study {

class Table {
 public:
  /// @throws std::runtime_error naming the file if it cannot be read
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
    while (std::getline(file, line)) {
      const char* text = line.c_str();
      for (std::vector<double>& column : columns_) {
        char* end = nullptr;
        column.push_back(std::strtod(text, &end));
        text = *end == ',' ? end + 1 : end;
      }
    }
  }

  std::size_t rows() const { return columns_.front().size(); }
  /// @throws std::runtime_error if there is no such column
  const std::vector<double>& operator[](const std::string& name) const {
    const auto place = std::find(names_.begin(), names_.end(), name);
    if (place == names_.end()) throw std::runtime_error(path_.string() + " has no column " + name);
    return columns_[std::size_t(place - names_.begin())];
  }

 private:
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
