// SPDX-License-Identifier: MIT
#include "store.hpp"

#include <cstdio>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "moreau/io/output_file.hpp"

#include "result_json.hpp"

namespace study {

namespace fs = std::filesystem;
using ratcheting::Json;

namespace {

/// A parameter that the run does not know is one that came later: it had its default.
bool has_parameters(const Json& had, const Case& c) {
  const Json usual = ratcheting::to_json(Parameters{}), wanted = ratcheting::to_json(c.parameters);
  for (const auto& [key, value] : wanted.items())
    if (value != (had.contains(key) ? had[key] : usual[key])) return false;
  return true;
}

fs::path file_of(const Places& places, const Case& c) {
  return places.results / "runs" / (c.name + ".json");
}

/// Says once of each path why it does not count.
void tell_unread(const fs::path& path, const std::string& why) {
  static std::set<std::string> told;
  if (told.insert(path.string()).second)
    std::fprintf(stderr, "not read: %s %s\n", path.c_str(), why.c_str());
}

/// @returns nothing without a file, or if it is none of a run with these parameters, which is told
std::optional<Result> read_kept(const Places& places, const Case& c) {
  const fs::path path = file_of(places, c);
  if (!fs::exists(path)) return std::nullopt;
  try {
    std::ifstream file(path);
    const Json json = Json::parse(file);
    if (!json.at("parameters").is_object()) throw std::runtime_error("parameters: no object");
    if (has_parameters(json["parameters"], c)) return result_of(json, c);
    tell_unread(path, "is of a run with other parameters; it does not count");
  } catch (const std::exception& error) {
    tell_unread(path,
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

void keep(const Places& places, const Result& result) {
  const fs::path path = file_of(places, result.c);
  const std::string text = json_text(result);
  std::ifstream before(path, std::ios::binary);
  if (std::string(std::istreambuf_iterator<char>(before), {}) == text) return;
  fs::create_directories(path.parent_path());
  moreau::write_atomically(path, text);
}

}  // namespace

fs::path folder_of(const Places& places, const Case& c) {
  return places.output / "cases" / c.name;
}

bool is_done(const Places& places, const Case& c) {
  if (read_kept(places, c)) return true;
  if (!has_folder(places, c)) return false;
  const auto run = measured(places, c);
  if (const auto* problem = std::get_if<std::string>(&run)) {
    tell_unread(folder_of(places, c), *problem + "; it does not count");
    return false;
  }
  return true;
}

std::string keep(const Places& places, const Case& c) {
  const auto run = measured(places, c);
  if (const auto* problem = std::get_if<std::string>(&run)) return *problem;
  keep(places, std::get<Result>(run));
  return {};
}

Kept read_results(const Places& places, const std::vector<Case>& plan) {
  Kept kept;
  for (const Case& c : plan) {
    std::optional<Result> run;
    if (has_folder(places, c)) {
      auto found = measured(places, c);
      if (const auto* problem = std::get_if<std::string>(&found)) {
        tell_unread(folder_of(places, c), *problem + "; what was kept of it before stays");
        ++kept.unread;
      } else {
        run = std::move(std::get<Result>(found));
        keep(places, *run);
      }
    }
    if (auto result = read_kept(places, c)) {
      kept.results.push_back(std::move(*result));
      if (!run) continue;
      kept.results.back().clock = run->clock;
      kept.results.back().folder = run->folder;
    } else {
      kept.unread += fs::exists(file_of(places, c));
    }
  }
  return kept;
}

}  // namespace study
