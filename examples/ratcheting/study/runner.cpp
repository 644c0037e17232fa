// SPDX-License-Identifier: MIT
#include "runner.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
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

/// Estimated cost of a case relative to the others, without the preparation, which is shared.
double cost_of(const Case& c) {
  const Parameters& p = c.parameters;
  const double shape = p.shape == "polyhedron" ? 8
                       : p.shape == "sphere"   ? 2.5
                       : p.shape == "polygon"  ? 1.2
                                               : 0.6;
  return shape * double(p.grains) * (0.05 + p.duration / p.step / 5000);
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

/// The queue of the cases that are not done, and the processes that run.
class Runner {
 public:
  Runner(const std::vector<Case>& cases, const RunOptions& options)
      : options_(options), begin_(Clock::now()), told_(begin_) {
    const RunTable table = RunTable::read(options.places.table());
    for (const Case& c : cases)
      if (is_done(options.places, table, c)) {
        ++summary_.skipped;
      } else {
        waiting_.push_back(&c);
        cost_left_ += cost_of(c);
      }
    cost_of_all_ = cost_left_;
  }

  RunSummary run() {
    while (stop == 0 && (!waiting_.empty() || !running_.empty())) {
      while (stop == 0 && !waiting_.empty() && running_.size() < options_.jobs) begin(take_next());
      while (const auto ending = ended_child()) finish(*ending);
      tell();
      if (!running_.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    if (stop != 0) abandon();
    return std::move(summary_);
  }

 private:
  /// The next case in the order of the plan, unless one case would take longer than all others,
  /// spread over the processes, take together: then this case, so that it is not the last.
  const Case& take_next() {
    double cost = 0;
    for (const Case* c : waiting_) cost += cost_of(*c);
    const auto longest =
        std::max_element(waiting_.begin(), waiting_.end(),
                         [](const Case* a, const Case* b) { return cost_of(*a) < cost_of(*b); });
    const bool outlasts = cost_of(**longest) * double(options_.jobs) > cost;
    const auto next = outlasts ? longest : waiting_.begin();
    const Case& c = **next;
    waiting_.erase(next);
    return c;
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
    if (is_done(options_.places, RunTable::read(options_.places.table()),
                c)) {  // by another study, since the table was read
      ++summary_.skipped;
      cost_left_ -= cost_of(c);
      return;
    }
    const fs::path folder = partial(options_.places, c);
    if (fs::remove_all(folder) > 0)
      std::printf("case %zu %s: an earlier start did not finish it; it begins anew\n", c.number,
                  c.name.c_str());
    fs::create_directories(folder);
    const fs::path packing =
        options_.places.output / "packings" / (packing_name(c.parameters) + ".snapshot");
    std::vector<std::string> list = arguments(c.parameters);
    list.insert(list.end(), {"--snapshots", "0", "--no-pictures", "--no-plots", "--packing",
                             packing.string(), "--output", folder.string()});
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
