// SPDX-License-Identifier: MIT
#include "run_table.hpp"

#include <fstream>
#include <string_view>

#include "moreau/io/output_file.hpp"

#include "process.hpp"

namespace study {

namespace {

/// @returns the name that a line begins with, empty without one
std::string name_of(std::string_view line) {
  constexpr std::string_view before = "{\"name\":\"";
  if (!line.starts_with(before)) return {};
  line.remove_prefix(before.size());
  const std::size_t end = line.find('"');
  return end == line.npos ? std::string() : std::string(line.substr(0, end));
}

}  // namespace

RunTable RunTable::read(const std::filesystem::path& path) {
  RunTable table;
  std::ifstream file(path);
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    const std::string name = name_of(line);
    if (name.empty())
      table.unnamed_.push_back(number);
    else
      table.lines_[name] = {number, line};
  }
  return table;
}

const RunTable::Line* RunTable::find(const std::string& name) const {
  const auto found = lines_.find(name);
  return found == lines_.end() ? nullptr : &found->second;
}

void RunTable::add(const std::filesystem::path& path,
                   const std::map<std::string, std::string>& lines) {
  if (lines.empty()) return;
  std::filesystem::create_directories(path.parent_path());
  const FileLock lock = FileLock::wait(path.parent_path() / ".runs.lock");
  RunTable table = read(path);
  bool changed = false;
  for (const auto& [name, text] : lines) {
    Line& line = table.lines_[name];
    changed = changed || line.text != text;
    line.text = text;
  }
  if (!changed) return;
  std::string all;
  for (const auto& [name, line] : table.lines_) all += line.text + "\n";
  moreau::write_atomically(path, all);
}

}  // namespace study
