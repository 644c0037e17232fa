// SPDX-License-Identifier: MIT
// Runs a plan of cases and writes the tables of their results; report/write.py draws the figures and writes the pages.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "../command_line.hpp"
#include "plan.hpp"
#include "runner.hpp"
#include "store.hpp"
#include "tables.hpp"

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string plan = "paper";
  study::Selection selection;
  bool list = false, report_only = false, no_report = false, no_figures = false;
  std::size_t jobs = std::max(1u, std::thread::hardware_concurrency());
  std::string output = "ratcheting-study", results, program, writer = STUDY_WRITER;

  study::Places places() const { return {output, results}; }
};

void list_cases(const std::vector<study::Case>& cases, const study::Places& places) {
  const auto table = study::RunTable::read(places.table());
  for (const study::Case& c : cases) {
    std::printf("%4zu %s %-44s", c.number, study::is_done(places, table, c) ? "done" : "    ",
                c.name.c_str());
    for (const std::string& set : c.sets) std::printf(" %s", set.c_str());
    std::printf("\n");
  }
}

/// Draws the figures and, of plans with all series, writes the pages of which the folder has templates, by
/// report/write.py.
/// @returns whether it ran without an error
bool write_report(const Options& o) {
  const std::string only = o.plan == "small" ? " --figures-only" : "";
  const std::string command = "python3 '" + o.writer + "' '" + o.results + "'" + only;
  return std::system(command.c_str()) == 0;
}

/// @returns whether all that is kept was read
bool report(const Options& o, const std::vector<study::Case>& plan) {
  const fs::path folder = o.results;
  fs::create_directories(folder);
  // The plans but "small" share a table of runs. A case may be in two of them.
  std::vector<study::Case> all = plan;
  std::set<std::string> names;
  for (const study::Case& c : all) names.insert(c.name);
  if (o.plan != "small")
    for (const char* other : {"paper", "settled", "controls"})
      for (study::Case& c : study::make_plan(other))
        if (names.insert(c.name).second) all.push_back(std::move(c));
  const auto [results, unread] = study::read_results(o.places(), all);
  study::write_cases(folder, results);
  study::write_wall_clock(folder, results);
  if (o.plan != "small")
    for (const char* name : {"paper", "settled", "controls"})
      study::write_remaining(folder, name, study::make_plan(name), results);
  std::printf("%zu of %zu cases are done; tables: %s\n", results.size(), all.size(),
              folder.c_str());
  std::fflush(stdout);
  const bool written = o.no_figures || write_report(o);
  if (!written) std::printf("no report: it needs python3 and gnuplot\n");
  return unread == 0;
}

int run(Options& o) {
  const std::vector<study::Case> plan = study::make_plan(o.plan);
  const study::Selection& s = o.selection;
  if (o.report_only &&
      !(s.sets.empty() && s.shapes.empty() && s.seeds.empty() && s.numbers.empty()))
    throw std::invalid_argument(
        "--report-only: --set, --shape, --seed and --case choose what runs; the report is of all");
  const std::vector<study::Case> cases = study::select(plan, o.selection);
  if (o.list) {
    list_cases(cases, o.places());
    return 0;
  }
  study::RunSummary summary;
  if (!o.report_only) {
    if (!fs::exists(o.program)) throw std::invalid_argument("--program: there is no " + o.program);
    summary = study::run_cases(cases, {o.program, o.places(), o.jobs});
    std::printf("%zu ran, %zu were done before, %zu run elsewhere, %zu failed\n", summary.ran,
                summary.skipped, summary.busy, summary.failed.size());
    for (const std::string& failure : summary.failed) std::printf("  %s\n", failure.c_str());
  }
  if (summary.interrupted) {
    std::printf(
        "interrupted: %s; the same command goes on, --report-only reports what is done\n",
        summary.lost.empty() ? "nothing was running" : (summary.lost + " will run again").c_str());
    return 130;
  }
  const bool read = o.no_report || report(o, plan);
  return summary.failed.empty() && read ? 0 : 1;
}

void add_options(CLI::App& app, Options& o) {
  app.option_defaults()->always_capture_default();
  app.add_option("--plan", o.plan,
                 "paper: the whole study with rigid contacts; settled: with compliant contacts, "
                 "from jammed states; controls: dimension, length of the box, contacts and start "
                 "changed one at a time; small: few grains, takes about a minute")
      ->check(CLI::IsMember(study::plan_names()));
  app.add_option("--set", o.selection.sets,
                 "run only the cases of these series, e.g. frequencies, fmax, and those that make "
                 "the jammed states they start from");
  app.add_option("--shape", o.selection.shapes, "run only the cases of these shapes")
      ->check(CLI::IsMember(
          {"polyhedron", "polygon", "sphere", "disk", "compound", "compound_polygon"}));
  app.add_option("--seed", o.selection.seeds, "run only the cases of these samples");
  app.add_option("--case", o.selection.numbers,
                 "run only the cases of these numbers and write no report, for job arrays")
      ->check(CLI::Range(1, 100000));
  app.add_flag("--list", o.list, "list number, state, name and series of the cases, and exit");
  app.add_flag("--report-only", o.report_only, "run no case; write tables, figures and report");
  app.add_flag("--no-report", o.no_report, "write no tables, figures and report");
  app.add_flag("--no-figures", o.no_figures, "write tables, but no figures and no pages");
  app.add_option("--jobs", o.jobs, "number of cases that run at the same time")
      ->check(CLI::Range(1, 1024))
      ->default_str("all cores");
  app.add_option("--output", o.output, "folder of the runs, created if missing");
  app.add_option(
      "--results", o.results,
      "folder of the table of the runs (runs.jsonl), figures and report; a study continues from "
      "this folder alone. Default: OUTPUT/results");
  app.add_option("--program", o.program,
                 "program that runs a case. Default: ratcheting in the folder of this program");
  app.add_option("--writer", o.writer,
                 "script that draws the figures and writes the pages of which RESULTS has "
                 "templates (*.md.in)")
      ->default_str("examples/ratcheting/study/report/write.py");
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  CLI::App app{
      "The whole ratcheting study (Azema et al., arXiv 0711.1081): runs its cases, several at "
      "once, "
      "continues where it was stopped, draws every figure and writes the report.",
      "ratcheting_study"};
  add_options(app, o);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  o.no_report = o.no_report || !o.selection.numbers.empty();
  if (o.results.empty()) o.results = (fs::path(o.output) / "results").string();
  if (o.program.empty())
    o.program = (fs::read_symlink("/proc/self/exe").parent_path() / "ratcheting").string();
  return ratcheting::exit_status([&] { return run(o); });
}
