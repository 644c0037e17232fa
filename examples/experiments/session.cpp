// SPDX-License-Identifier: MIT
#include "session.hpp"

#include <array>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "moreau/io/output_file.hpp"
#include "moreau/version.hpp"

namespace experiments {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

namespace {

std::string number(double value) {
  if (std::isnan(value)) return "–";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

/// A name for a file.
std::string file_name(std::string key) {
  for (char& c : key)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-') c = '_';
  return key;
}

}  // namespace

double cpu_seconds() {
  return double(std::clock()) / CLOCKS_PER_SEC;
}

struct Session::Store {
  std::map<std::string, Result> done;
  std::vector<std::pair<std::string, Row>> rows;
  std::string experiment;
};

namespace {

volatile std::sig_atomic_t is_interrupted = 0;

void interrupt(int signal) {
  is_interrupted = 1;
  std::signal(signal, SIG_DFL);  // the second one ends the program at once
}

fs::path clock_of(const fs::path& snapshot) {
  return fs::path(snapshot).replace_extension("seconds");
}

}  // namespace

Run::Run(std::string name, fs::path snapshot, Time deadline)
    : name_(std::move(name)),
      snapshot_(std::move(snapshot)),
      deadline_(deadline),
      printed_(Clock::now()),
      start_(cpu_seconds()),
      stored_(start_) {
  if (std::ifstream before(clock_of(snapshot_)); before && is_started()) before >> earlier_;
}

bool Run::must_stop() const {
  return is_interrupted != 0 || Clock::now() >= deadline_;
}

void Run::note_stored() {
  stored_ = cpu_seconds();
  moreau::write_atomically(clock_of(snapshot_), std::to_string(seconds()) + '\n');
}

void Run::progress(double share) {
  if (first_share_ < 0) first_share_ = share;
  const Clock::time_point now = Clock::now();
  if (now - printed_ < std::chrono::seconds(20) || share <= first_share_) return;
  printed_ = now;
  const double left = (cpu_seconds() - start_) * (1 - share) / (share - first_share_);
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), ": %.1f %%, %.3f core-hours, about %.3f left",
                100 * share, seconds() / 3600, left / 3600);
  Session::say("  " + name_ + text.data());
}

Session::Session(const Options& options) : options_(options), store_(std::make_unique<Store>()) {
  fs::create_directories(options_.output);
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  deadline_ = options.hold < 1e9
                  ? Clock::now() + std::chrono::milliseconds(std::int64_t(1e3 * options.hold))
                  : Clock::time_point::max();
  std::ifstream file(options_.output / "results.jsonl");
  for (std::string line; std::getline(file, line);) {
    const nlohmann::json one = nlohmann::json::parse(line, nullptr, false);
    if (one.is_discarded()) continue;  // the line that a crash has cut
    store_->done[one.at("key")] = {one.at("values").get<Numbers>(), one.at("seconds")};
  }
}
Session::~Session() = default;

void Session::begin(const std::string& experiment) {
  store_->experiment = experiment;
}

Result Session::once(const std::string& name, const std::function<Numbers(Run&)>& run) {
  const std::string key =
      (quick() ? "quick/" : "") +
      (name.starts_with('/') ? name.substr(1) : store_->experiment + '/' + name);
  if (const auto found = store_->done.find(key); found != store_->done.end()) return found->second;
  const fs::path snapshot = options_.output / (file_name(key) + ".snapshot");
  Run one(key, snapshot, deadline_);
  if (one.must_stop()) throw Paused();
  Result result;
  result.values = run(one);
  result.seconds = one.seconds();
  nlohmann::json line{{"key", key}, {"values", result.values}, {"seconds", result.seconds}};
  std::ofstream(options_.output / "results.jsonl", std::ios::app) << line.dump() << '\n';
  fs::remove(snapshot);
  fs::remove(clock_of(snapshot));
  store_->done[key] = result;
  if (result.seconds > 0.2) say("  " + key + ": " + number(result.seconds) + " s");
  return result;
}

void Session::row(const Row& row) {
  store_->rows.emplace_back(store_->experiment, row);
}

void Session::curve(const std::string& name, const std::vector<std::string>& columns,
                    const std::vector<Numbers>& rows) const {
  std::string text;
  for (std::size_t k = 0; k < columns.size(); ++k) text += (k > 0 ? "," : "") + columns[k];
  text += '\n';
  for (const Numbers& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      std::array<char, 32> entry{};
      std::snprintf(entry.data(), entry.size(), "%.8g", row[k]);
      if (k > 0) text += ',';
      text += entry.data();
    }
    text += '\n';
  }
  moreau::write_atomically(options_.output / (name + ".csv"), text);
}

void Session::say(const std::string& text) {
  std::cout << text << std::endl;
}

void Session::write() const {
  std::string page = "# Experiments\n\nmoreau " MOREAU_VERSION_STRING +
                     std::string(quick() ? ", small versions of all" : "") + ".\n";
  std::string table =
      "experiment,figure,published,measured,error,samples,law,step,tolerance,grains,seconds,"
      "agrees\n";
  std::string last;
  for (const auto& [experiment, row] : store_->rows) {
    if (experiment != last)
      page += "\n## `" + experiment +
              "`\n\n| figure | published | measured | ± | samples | law | step [s] | tolerance | "
              "grains | CPU time [s] | agrees |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
    last = experiment;
    const std::array<std::string, 11> cells{row.figure,
                                            row.published,
                                            number(row.measured),
                                            number(row.error),
                                            std::to_string(row.samples),
                                            row.law,
                                            number(row.step),
                                            row.tolerance > 0 ? number(row.tolerance) : "–",
                                            std::to_string(row.grains),
                                            number(row.seconds),
                                            row.verdict};
    table += experiment;
    page += '|';
    for (const std::string& cell : cells) {
      page += ' ' + cell + " |";
      table += ",\"" + cell + '"';
    }
    page += '\n';
    table += '\n';
  }
  moreau::write_atomically(options_.output / "experiments.md", page);
  moreau::write_atomically(options_.output / "experiments.csv", table);
}

Mean mean_of(const Numbers& samples) {
  const auto n = double(samples.size());
  Mean mean;
  for (const double x : samples) mean.value += x / n;
  if (samples.size() < 2) return mean;
  double square = 0;
  for (const double x : samples) square += (x - mean.value) * (x - mean.value);
  mean.error = std::sqrt(square / (n * (n - 1)));
  return mean;
}

std::string data_path(const std::string& name) {
  return EXPERIMENTS_DATA "/" + name;
}

std::vector<Numbers> read_data(const std::string& name) {
  std::ifstream file(data_path(name));
  if (!file) throw std::runtime_error(data_path(name) + " cannot be read");
  std::vector<Numbers> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

}  // namespace experiments
