// SPDX-License-Identifier: MIT
// The table of a study's runs: a text file with one line per run, a JSON object that begins with
// the name of the case (JSON Lines). result_json.hpp writes and reads a line.
//
// Lines are sorted by name, so the file has the same bytes whatever the order of the runs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace study {

class RunTable {
 public:
  struct Line {
    std::size_t number;  ///< from 1
    std::string text;    ///< without its end
  };

  /// Reads the lines without parsing what follows the name. A file that does not exist is an empty
  /// table.
  static RunTable read(const std::filesystem::path& path);

  /// @returns the line of a case, null without one
  const Line* find(const std::string& name) const;
  /// Numbers of the lines that do not begin with a name. add() leaves them out.
  const std::vector<std::size_t>& unnamed() const { return unnamed_; }

  /// Adds lines to the file, by name; a line replaces the one of the same name. Processes that add
  /// to one file at the same time wait for each other (a lock on the file .runs.lock beside it),
  /// and a reader sees the table before or after. Nothing is written if nothing changes.
  /// @throws std::system_error if the file or the lock cannot be written
  static void add(const std::filesystem::path& path,
                  const std::map<std::string, std::string>& lines);

 private:
  std::map<std::string, Line> lines_;
  std::vector<std::size_t> unnamed_;
};

}  // namespace study
