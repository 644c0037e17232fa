// SPDX-License-Identifier: MIT
// What every experiment needs of its runner: results that are stored when they are finished, long runs
// that continue after a stop, rows of the table, curves.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace experiments {

using Numbers = std::vector<double>;

/// Thrown where a run must stop because its time is over. Its state is in a file.
struct Paused : std::runtime_error {
  Paused() : std::runtime_error("stopped; the same command continues") {}
};

/// A row of the table.
struct Row {
  std::string figure;     ///< what is compared, with its unit
  std::string published;  ///< value and source's spread, as text
  double measured = 0;    ///< the mean of the samples
  /// Standard error of the mean of the samples; not a number for one sample.
  double error = std::numeric_limits<double>::quiet_NaN();
  std::size_t samples = 1;
  std::string law;       ///< contact law, or solver
  double step = 0;       ///< [s]
  double tolerance = 0;  ///< of the solver, relative; 0: none
  std::size_t grains = 0;
  double seconds = 0;   ///< CPU time of all samples, of all threads [s]
  std::string verdict;  ///< "yes", "no", or why there is no comparison
};

/// A stored result.
struct Result {
  Numbers values;
  double seconds = 0;  ///< CPU time of all threads, with all earlier pieces of the run [s]
};

/// CPU time of the program, all threads [s]: what others do on the machine hardly changes it.
double cpu_seconds();

struct Options {
  std::filesystem::path output = "experiments-output";
  std::vector<std::string> only;
  std::string
      part;  ///< only the runs of silo, drum, impact, dice, heap and columns whose names contain this
  bool quick = false;
  double hold = std::numeric_limits<double>::infinity();  ///< stop after this wall-clock time [s]
  int threads = 1;                                        ///< of the long runs
};

/// A run that may be stopped and continued.
class Run {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// @param snapshot file of the state, and without its extension of the CPU time so far
  Run(std::string name, std::filesystem::path snapshot, Time deadline);

  /// File of the state of the run, whether it exists or not.
  const std::filesystem::path& snapshot() const { return snapshot_; }
  bool is_started() const { return std::filesystem::exists(snapshot_); }
  /// Whether the time is over, or the user has asked for the end (SIGINT, SIGTERM).
  bool must_stop() const;
  /// Whether the state has not been stored for a minute of CPU time.
  bool must_store() const { return cpu_seconds() - stored_ > 60; }
  /// To be called after the state was stored: stores the CPU time that belongs to it.
  void note_stored();
  /// Prints the share that is done and the core-hours that are left, at most every 20 seconds.
  /// @param share from 0 to 1
  void progress(double share);
  /// CPU time of all threads, with all earlier pieces of the run [s].
  double seconds() const { return earlier_ + cpu_seconds() - start_; }

 private:
  std::string name_;
  std::filesystem::path snapshot_;
  Time deadline_, printed_;
  double earlier_ = 0, start_, stored_;  // CPU times [s]
  double first_share_ = -1;              // of this piece
};

/// The results of the runner.
class Session {
 public:
  explicit Session(const Options& options);
  ~Session();

  bool quick() const { return options_.quick; }
  const Options& options() const { return options_; }
  /// Whether a run of silo, drum, impact, dice, heap or columns is one of those that are asked for.
  bool wants(const std::string& name) const {
    return name.find(options_.part) != std::string::npos;
  }
  /// The experiment to which the following rows belong.
  void begin(const std::string& experiment);

  /// The numbers of a run: stored ones, if the run has finished before, else those that it returns.
  /// @param key of the run within the experiment; with a / in front it is of all experiments
  /// @throws Paused if the time is over
  Result once(const std::string& key, const std::function<Numbers(Run&)>& run);
  void row(const Row& row);
  /// Writes a curve as CSV into the output folder.
  void curve(const std::string& name, const std::vector<std::string>& columns,
             const std::vector<Numbers>& rows) const;
  /// A line of text on the terminal.
  static void say(const std::string& text);
  /// Writes experiments.md and experiments.csv from the rows so far.
  void write() const;

 private:
  struct Store;
  Options options_;
  std::chrono::steady_clock::time_point deadline_;
  std::unique_ptr<Store> store_;
};

/// Mean and standard error of some samples.
struct Mean {
  double value = 0;
  double error = std::numeric_limits<double>::quiet_NaN();  ///< not a number for one sample
};
Mean mean_of(const Numbers& samples);

/// The k-th column of a table in data/, between commas, without its head.
std::vector<Numbers> read_data(const std::string& name);
/// Path of a file in data/.
std::string data_path(const std::string& name);

/// An experiment.
struct Experiment {
  const char* name;
  const char* what;
  const char* source;  ///< of the published figures
  void (*run)(Session&);
  double core_seconds,
      quick_core_seconds;  ///< about, on one core of the machine named in the guide
};
std::vector<Experiment> all_experiments();

void sticking(Session& session);
void rebound(Session& session);
void oblique(Session& session);
void columns(Session& session);
void heap(Session& session);
void dice(Session& session);
void silo(Session& session);
void drum(Session& session);
void impact(Session& session);
void squeeze(Session& session);

}  // namespace experiments
