// SPDX-License-Identifier: MIT
#include "store.hpp"

#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "result_json.hpp"

namespace study {

namespace fs = std::filesystem;
using ratcheting::Json;

namespace {

/// A parameter that the run does not know is one that came later: it had its default.
bool has_parameters(const Json& had, const Case& c) {
  const Json usual = ratcheting::to_json(Parameters{}), wanted = ratcheting::to_json(c.parameters);
  for (const auto& [key, value] : wanted.items()) {
    if (key == "from") continue;
    if (value != (had.contains(key) ? had[key] : usual[key])) return false;
  }
  // A run tells the checkpoint's path, a case and its line the name of the case that made it.
  const fs::path from = had.value("from", "");
  return c.parameters.from ==
         (from.has_parent_path() ? from.parent_path().filename() : from).string();
}

/// Says once of each line and each folder why it does not count.
void tell_unread(const std::string& place, const std::string& why) {
  static std::set<std::string> told;
  if (told.insert(place).second)
    std::fprintf(stderr, "not read: %s %s\n", place.c_str(), why.c_str());
}

/// @returns nothing without a line, or if it is not of a run with these parameters, which is told
std::optional<Result> read_line(const Places& places, const RunTable& table, const Case& c) {
  const RunTable::Line* line = table.find(c.name);
  if (line == nullptr) return std::nullopt;
  const std::string place =
      places.table().string() + ", line " + std::to_string(line->number) + " (" + c.name + "),";
  try {
    const Json json = Json::parse(line->text);
    if (!json.at("parameters").is_object()) throw std::runtime_error("parameters: no object");
    if (has_parameters(json["parameters"], c)) return result_of(json, c);
    tell_unread(place, "is of a run with other parameters; it does not count");
  } catch (const std::exception& error) {
    tell_unread(place,
                std::string("is no result of a run (") + error.what() + "); it does not count");
  }
  return std::nullopt;
}

/// Whether the case's folder says that it has a complete run with its parameters.
bool has_folder(const Places& places, const Case& c) {
  std::ifstream file(folder_of(places, c) / "run.json");
  if (!file) return false;
  const auto json = Json::parse(file, nullptr, false);
  return json.is_object() && !json.value("interrupted", true) && json.contains("parameters") &&
         has_parameters(json["parameters"], c);
}

/// The run in the case's folder, or what is wrong with it.
std::variant<Result, std::string> measured(const Places& places, const Case& c) {
  if (!has_folder(places, c)) return std::string("its run.json tells of another case, or of none");
  try {
    return measure(folder_of(places, c), c);
  } catch (const std::exception& error) {
    return std::string("is damaged (") + error.what() + ")";
  }
}

}  // namespace

fs::path folder_of(const Places& places, const Case& c) {
  return places.output / "cases" / c.name;
}

bool is_done(const Places& places, const RunTable& table, const Case& c) {
  if (read_line(places, table, c)) return true;
  if (!has_folder(places, c)) return false;
  const auto run = measured(places, c);
  if (const auto* problem = std::get_if<std::string>(&run)) {
    tell_unread(folder_of(places, c).string(), *problem + "; it does not count");
    return false;
  }
  return true;
}

std::string keep(const Places& places, const Case& c) {
  const auto run = measured(places, c);
  if (const auto* problem = std::get_if<std::string>(&run)) return *problem;
  RunTable::add(places.table(), {{c.name, json_line(std::get<Result>(run))}});
  return {};
}

Kept read_results(const Places& places, const std::vector<Case>& plan) {
  Kept kept;
  std::map<std::string, std::string> lines;
  std::map<std::string, WallClock> clocks;
  for (const Case& c : plan) {
    if (!has_folder(places, c)) continue;
    const auto found = measured(places, c);
    if (const auto* problem = std::get_if<std::string>(&found)) {
      tell_unread(folder_of(places, c).string(), *problem + "; its line in the table stays");
      ++kept.unread;
    } else {
      const Result& run = std::get<Result>(found);
      lines[c.name] = json_line(run);
      if (run.clock) clocks[c.name] = *run.clock;
    }
  }
  RunTable::add(places.table(), lines);
  const RunTable table = RunTable::read(places.table());
  for (const std::size_t number : table.unnamed()) {
    tell_unread(places.table().string() + ", line " + std::to_string(number) + ",",
                "does not begin with the name of a case; it does not count");
    ++kept.unread;
  }
  for (const Case& c : plan) {
    if (auto result = read_line(places, table, c)) {
      if (const auto clock = clocks.find(c.name); clock != clocks.end())
        result->clock = clock->second;
      kept.results.push_back(std::move(*result));
    } else {
      kept.unread += table.find(c.name) != nullptr;
    }
  }
  return kept;
}

}  // namespace study
