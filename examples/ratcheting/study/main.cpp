// SPDX-License-Identifier: MIT
// Runs a plan of cases, draws the figures and writes the report.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "../command_line.hpp"
#include "figures.hpp"
#include "plan.hpp"
#include "report.hpp"
#include "runner.hpp"
#include "store.hpp"

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string plan = "paper";
  study::Selection selection;
  std::vector<std::string> figures;
  bool list = false, report_only = false, no_report = false;
  std::size_t jobs = std::max(1u, std::thread::hardware_concurrency());
  std::string output = "ratcheting-study", results, program, plots = STUDY_PLOTS;

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

/// Sets of the figures that are asked for, if no sets are.
void add_sets_of_figures(Options& o) {
  for (const study::Figure& figure : study::figures())
    if (std::find(o.figures.begin(), o.figures.end(), figure.name) != o.figures.end())
      o.selection.sets.insert(o.selection.sets.end(), figure.sets.begin(), figure.sets.end());
}

/// @returns whether all that is kept was read
bool report(const Options& o, const std::vector<study::Case>& plan) {
  const fs::path folder = o.results;
  fs::create_directories(folder);
  const auto [results, unread] = study::read_results(o.places(), plan);
  std::vector<study::ShapeSummary> shapes;
  for (const char* shape : {"polyhedron", "polygon", "sphere", "disk"})
    shapes.push_back(study::summarize(results, shape));
  study::write_figure_data(folder, results, shapes);
  const auto missing = study::draw_figures(folder, o.plots, results, o.figures);
  for (const std::string& figure : missing) std::printf("not drawn: %s\n", figure.c_str());
  study::write_cases(folder, results);
  study::write_wall_clock(folder, results);
  study::write_report(folder, o.plan, plan, results, shapes);
  std::printf("%zu of %zu cases are done; report and figures: %s\n", results.size(), plan.size(),
              (folder / "report.md").c_str());
  return unread == 0;
}

int run(Options& o) {
  const std::vector<study::Case> plan = study::make_plan(o.plan);
  const study::Selection& s = o.selection;
  if (o.report_only &&
      !(s.sets.empty() && s.shapes.empty() && s.seeds.empty() && s.numbers.empty()))
    throw std::invalid_argument(
        "--report-only: --set, --shape, --seed and --case choose what runs; the report is of all");
  add_sets_of_figures(o);
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
                 "paper: the whole study; small: few grains, takes about a minute")
      ->check(CLI::IsMember(study::plan_names()));
  app.add_option("--set", o.selection.sets,
                 "run only the cases of these series, e.g. frequencies, fmax");
  app.add_option("--shape", o.selection.shapes, "run only the cases of these shapes")
      ->check(CLI::IsMember({"polyhedron", "polygon", "sphere", "disk"}));
  app.add_option("--seed", o.selection.seeds, "run only the cases of these samples");
  app.add_option("--case", o.selection.numbers,
                 "run only the cases of these numbers and write no report, for job arrays")
      ->check(CLI::Range(1, 100000));
  std::vector<std::string> names;
  for (const study::Figure& figure : study::figures()) names.emplace_back(figure.name);
  app.add_option("--figure", o.figures,
                 "run only the series that these figures need, and draw only these figures")
      ->check(CLI::IsMember(names));
  app.add_flag("--list", o.list, "list number, state, name and series of the cases, and exit");
  app.add_flag("--report-only", o.report_only, "run no case; write tables, figures and report");
  app.add_flag("--no-report", o.no_report, "write no tables, figures and report");
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
  app.add_option("--plots", o.plots, "folder of the gnuplot scripts of the figures")
      ->default_str("examples/ratcheting/study/plots");
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
