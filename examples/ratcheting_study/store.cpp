// SPDX-License-Identifier: MIT
#include "store.hpp"

#include <cstdio>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>

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

/// @returns nothing without a file, or if it is of a run with other parameters
std::optional<Result> read_kept(const Places& places, const Case& c) {
  const fs::path path = file_of(places, c);
  if (!fs::exists(path)) return std::nullopt;
  try {
    std::ifstream file(path);
    const Json json = Json::parse(file);
    if (!json.at("parameters").is_object()) throw std::runtime_error("parameters: no object");
    if (!has_parameters(json["parameters"], c)) return std::nullopt;
    return result_of(json, c);
  } catch (const std::exception& error) {
    throw std::runtime_error(path.string() + " is no result of a run (" + error.what() +
                             "); without it the case runs again");
  }
}

}  // namespace

fs::path folder_of(const Places& places, const Case& c) {
  return places.output / "cases" / c.name;
}

bool has_folder(const Places& places, const Case& c) {
  std::ifstream file(folder_of(places, c) / "run.json");
  if (!file) return false;
  const auto json = Json::parse(file, nullptr, false);
  return json.is_object() && !json.value("interrupted", true) && json.contains("parameters") &&
         has_parameters(json["parameters"], c);
}

bool is_done(const Places& places, const Case& c) {
  return has_folder(places, c) || read_kept(places, c).has_value();
}

void keep(const Places& places, const Case& c) {
  const fs::path path = file_of(places, c);
  const std::string text = json_text(measure(folder_of(places, c), c));
  std::ifstream before(path, std::ios::binary);
  if (std::string(std::istreambuf_iterator<char>(before), {}) == text) return;
  fs::create_directories(path.parent_path());
  moreau::write_atomically(path, text);
}

std::vector<Result> read_results(const Places& places, const std::vector<Case>& plan) {
  std::vector<Result> results;
  for (const Case& c : plan) {
    if (has_folder(places, c)) keep(places, c);
    if (auto result = read_kept(places, c))
      results.push_back(std::move(*result));
    else if (fs::exists(file_of(places, c)))
      std::fprintf(stderr, "not read: %s is of a run with other parameters\n",
                   file_of(places, c).c_str());
  }
  return results;
}

}  // namespace study
