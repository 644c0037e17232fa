// SPDX-License-Identifier: MIT
#include "runner.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <set>
#include <stdexcept>
#include <thread>
#include <unistd.h>
#include <utility>

#include "process.hpp"

namespace study {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

volatile std::sig_atomic_t stop = 0;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Estimated cost of a case [s], with a start of the program and a part of the shared preparation.
double cost_of(const Case& c) {
  Parameters start = c.parameters;
  start.duration = 0.05;
  return seconds_of(c.parameters) + seconds_of(start);
}

struct Running {
  pid_t process;
  const Case* c;
  FileLock lock;
  Clock::time_point begin;
};

fs::path partial(const Places& places, const Case& c) {
  return folder_of(places, c).string() + ".partial";
}

/// The checkpoint that a case starts from; empty if it starts from a packing.
fs::path start_of(const Places& places, const Case& c) {
  if (c.parameters.from.empty()) return {};
  return places.output / "cases" / c.parameters.from / "checkpoint.snapshot";
}

/// The queue of the cases that are not done, and the processes that run.
class Runner {
 public:
  Runner(const std::vector<Case>& cases, const RunOptions& options)
      : options_(options), begin_(Clock::now()), told_(begin_) {
    const RunTable table = RunTable::read(options.places.table());
    std::set<std::string> starts;  // cases whose checkpoint is needed and is not there
    std::vector<const Case*> done;
    for (const Case& c : cases)
      if (is_done(options.places, table, c)) {
        ++summary_.skipped;
        done.push_back(&c);
      } else {
        if (const fs::path start = start_of(options.places, c);
            !start.empty() && !fs::exists(start))
          starts.insert(c.parameters.from);
        waiting_.push_back(&c);
      }
    // A case that is done runs again if the table has its results and its checkpoint is gone.
    for (const Case* c : done)
      if (starts.contains(c->name)) {
        again_.insert(c->name);
        waiting_.insert(waiting_.begin(), c);
      }
    for (const Case* c : waiting_) cost_left_ += cost_of(*c);
    cost_of_all_ = cost_left_;
    tell_plan();
  }

  RunSummary run() {
    while (stop == 0 && (!waiting_.empty() || !running_.empty())) {
      while (stop == 0 && running_.size() < options_.jobs) {
        const Case* next = take_next();
        if (next == nullptr) break;
        begin(*next);
      }
      if (running_.empty() && !waiting_.empty()) give_up_waiting();
      while (const auto ending = ended_child()) finish(*ending);
      tell();
      if (!running_.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    if (stop != 0) abandon();
    return std::move(summary_);
  }

 private:
  /// Says how much is to be simulated, before the first case starts.
  void tell_plan() const {
    double steps = 0;
    for (const Case* c : waiting_) steps += c->parameters.duration / c->parameters.step;
    if (waiting_.empty()) return;
    std::printf("%zu cases to run: %.0f steps, about %.2g core-hours, and the preparations\n",
                waiting_.size(), steps, cost_left_ / 3600);
    std::fflush(stdout);
  }

  bool can_start(const Case& c) const {
    const fs::path start = start_of(options_.places, c);
    return start.empty() || fs::exists(start);
  }

  /// The next case in the order of the plan whose checkpoint is there, or nullptr. If one case would
  /// take longer than all others, spread over the processes, take together, it is this case, so that
  /// it is not the last.
  const Case* take_next() {
    double cost = 0;
    for (const Case* c : waiting_) cost += cost_of(*c);
    const auto outlasts = [&](const Case* c) {
      return cost_of(*c) * double(options_.jobs) > cost && can_start(*c);
    };
    auto next = std::find_if(waiting_.begin(), waiting_.end(), outlasts);
    if (next == waiting_.end())
      next = std::find_if(waiting_.begin(), waiting_.end(),
                          [&](const Case* c) { return can_start(*c); });
    if (next == waiting_.end()) return nullptr;
    const Case* c = *next;
    waiting_.erase(next);
    return c;
  }

  /// Nothing runs that could make the checkpoints of the cases that wait.
  void give_up_waiting() {
    for (const Case* c : waiting_) {
      std::printf("case %zu %s: its start %s has no checkpoint\n", c->number, c->name.c_str(),
                  c->parameters.from.c_str());
      summary_.failed.push_back(c->name + ": no checkpoint of " + c->parameters.from);
    }
    waiting_.clear();
  }

  void begin(const Case& c) {
    const fs::path locks = options_.places.output / "locks";
    fs::create_directories(locks);
    auto lock = FileLock::attempt(locks / c.name);
    if (!lock) {
      ++summary_.busy;
      cost_left_ -= cost_of(c);
      std::printf("case %zu %s: another study runs it\n", c.number, c.name.c_str());
      return;
    }
    if (!again_.contains(c.name) &&
        is_done(options_.places, RunTable::read(options_.places.table()),
                c)) {  // by another study, since the table was read
      ++summary_.skipped;
      cost_left_ -= cost_of(c);
      return;
    }
    const fs::path folder = partial(options_.places, c);
    if (!c.parameters.resume && fs::remove_all(folder) > 0)
      std::printf("case %zu %s: an earlier start did not finish it; it begins anew\n", c.number,
                  c.name.c_str());
    fs::create_directories(folder);
    const fs::path packing =
        options_.places.output / "packings" / (packing_name(c.parameters) + ".snapshot");
    std::vector<std::string> list = arguments(c.parameters);
    list.insert(list.end(),
                {"--snapshots", "0", "--no-pictures", "--no-plots", "--output", folder.string()});
    if (const fs::path start = start_of(options_.places, c); !start.empty())
      list.insert(list.end(), {"--from", start.string()});
    else
      list.insert(list.end(), {"--packing", packing.string()});
    const pid_t process = start(options_.program, list, folder / "log.txt");
    running_.push_back({process, &c, std::move(*lock), Clock::now()});
  }

  void finish(const Ending& ending) {
    const auto place = std::find_if(running_.begin(), running_.end(),
                                    [&](const Running& r) { return r.process == ending.process; });
    if (place == running_.end()) return;
    const Case& c = *place->c;
    const double seconds = seconds_since(place->begin);
    const fs::path from = partial(options_.places, c), to = folder_of(options_.places, c);
    cost_left_ -= cost_of(c);
    std::string problem = ending.well ? "" : ending.what;
    if (ending.well) {
      fs::remove_all(to);
      fs::rename(from, to);
      problem = keep(options_.places, c);
    }
    if (problem.empty()) {
      ++summary_.ran;
      std::printf("case %zu %s: done in %.0f s; %s\n", c.number, c.name.c_str(), seconds,
                  left().c_str());
    } else {
      std::printf("case %zu %s: %s, see %s; the next start runs it again\n", c.number,
                  c.name.c_str(), problem.c_str(), ((ending.well ? to : from) / "log.txt").c_str());
      summary_.failed.push_back(c.name + ": " + problem);
    }
    std::fflush(stdout);
    running_.erase(place);
  }

  std::string left() const {
    const double done = cost_of_all_ - cost_left_;
    char text[96];
    if (done <= 0) return "";
    const double begun = seconds_since(begin_), left = begun / done * std::max(0.0, cost_left_);
    const bool minutes = begun + left > 300;
    const double unit = minutes ? 60 : 1;
    std::snprintf(text, sizeof text, "%.0f %% in %.0f %s, about %.0f %s left",
                  100 * done / cost_of_all_, begun / unit, minutes ? "min" : "s", left / unit,
                  minutes ? "min" : "s");
    return text;
  }

  /// Prints every minute which cases are running.
  void tell() {
    if (running_.empty() || seconds_since(told_) < 60) return;
    told_ = Clock::now();
    std::printf("running:");
    for (const Running& r : running_)
      std::printf(" %zu %s (%.0f s)", r.c->number, r.c->name.c_str(), seconds_since(r.begin));
    std::printf("; %s\n", left().c_str());
    std::fflush(stdout);
  }

  void abandon() {
    for (const Running& r : running_) {
      kill(r.process, SIGKILL);
      summary_.lost += (summary_.lost.empty() ? "" : ", ") + r.c->name;
    }
    while (!running_.empty()) {
      if (const auto ending = ended_child())
        std::erase_if(running_, [&](const Running& r) { return r.process == ending->process; });
      else
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    summary_.interrupted = true;
  }

  const RunOptions& options_;
  std::vector<const Case*> waiting_;  // in the order of the plan
  std::set<std::string> again_;       // names of those whose checkpoint is needed once more
  std::vector<Running> running_;
  RunSummary summary_;
  double cost_of_all_ = 0, cost_left_ = 0;
  Clock::time_point begin_, told_;
};

}  // namespace

RunSummary run_cases(const std::vector<Case>& cases, const RunOptions& options) {
  std::signal(SIGINT, [](int) { stop = 1; });
  std::signal(SIGTERM, [](int) { stop = 1; });
  fs::create_directories(options.places.output / "cases");
  fs::create_directories(options.places.output / "packings");
  return Runner(cases, options).run();
}

}  // namespace study
