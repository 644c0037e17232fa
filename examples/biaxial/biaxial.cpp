// SPDX-License-Identifier: MIT
// Biaxial compression of polygons and disks, triaxial compression of polyhedra and balls: the friction angle
// of the material, its dilation, and the fabric of its contacts. A sample is compressed without friction
// (dense) or with the friction of the shear (loose), and then sheared.
//
// Writes:
//  - biaxial.csv: stresses, volume strain, coordination, anisotropy over the axial strain, every sample
//  - summary.csv: friction angles and checks of every sample
//  - SHAPE.pvd: the first dense sample of every shape during the shear, for ParaView
//
// Returns 0 if all checks hold. run.sh builds, runs and plots it.
#include "biaxial.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "moreau/io/csv.hpp"

namespace fs = std::filesystem;

namespace {

struct Options {
  fs::path output = "biaxial-output";
  std::size_t plane = 600, space = 500, samples = 3, rows = 40;
  std::vector<std::string> shapes{"disk", "polygon", "ball", "polyhedron"};
  std::vector<std::string> preparations{"dense", "loose"};
  biaxial::Parameters parameters;
};

Options parsed(int argc, char** argv) {
  Options o;
  bool quick = false;
  CLI::App app("Biaxial test in the plane, triaxial test in space, with constant lateral pressure",
               "biaxial");
  app.option_defaults()->always_capture_default();
  app.add_option("--output", o.output, "folder for all files");
  app.add_option("--plane", o.plane, "grains in the plane")->check(CLI::Range(50, 1000000));
  app.add_option("--space", o.space, "grains in space")->check(CLI::Range(50, 1000000));
  app.add_option("--samples", o.samples, "random samples of each shape and preparation")
      ->check(CLI::Range(1, 1000));
  app.add_option("--rows", o.rows, "rows of the table; one for each 0.005 of axial strain")
      ->check(CLI::Range(1, 100));
  app.add_option("--shape", o.shapes, "the shapes to run")->check(CLI::IsMember(o.shapes));
  app.add_option("--preparation", o.preparations, "dense: compressed without friction")
      ->check(CLI::IsMember(o.preparations));
  biaxial::Parameters& p = o.parameters;
  app.add_option("--pressure", p.pressure, "lateral pressure [Pa], in the plane [N/m]")
      ->check(CLI::PositiveNumber);
  app.add_option("--friction", p.friction, "friction between grains during the shear")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--density", p.density, "of the grains [kg/m^3], in the plane [kg/m^2]")
      ->check(CLI::PositiveNumber);
  app.add_option("--inertial-number", p.inertial, "of the shear")->check(CLI::PositiveNumber);
  app.add_option("--step", p.h, "time step of the shear [s]")->check(CLI::PositiveNumber);
  app.add_option("--compression-step", p.h_compression, "time step of the compression [s]")
      ->check(CLI::PositiveNumber);
  app.add_flag("--quick", quick, "a small sample of disks and one of balls, as a test");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& end) {
    std::exit(app.exit(end));
  }
  if (quick) {
    o.plane = 200, o.space = 150, o.samples = 1, o.rows = 8;
    o.shapes = {"disk", "ball"};
    o.preparations = {"dense"};
  }
  return o;
}

struct Tables {
  moreau::CsvWriter rows, samples;
};

/// The mean of a quantity of the rows, from one row to the end.
double mean_of(const std::vector<biaxial::Row>& rows, std::size_t first, const auto& quantity) {
  double sum = 0;
  for (std::size_t k = first; k < rows.size(); ++k) sum += quantity(rows[k]);
  return sum / double(rows.size() - first);
}

/// The two components of a stress, relative to those of the stress from the wall forces.
struct Ratio {
  double axial = 0, lateral = 0;
};
Ratio mean_ratio(const std::vector<biaxial::Row>& rows, biaxial::Stress biaxial::Row::*stress) {
  return {
      mean_of(rows, 0, [&](const auto& row) { return (row.*stress).axial / row.walls.axial; }),
      mean_of(rows, 0, [&](const auto& row) { return (row.*stress).lateral / row.walls.lateral; })};
}

/// Results of a sample.
struct Summary {
  double peak = 0;        ///< friction angle of the row with the largest one [degrees]
  double end = 0;         ///< mean of the last quarter of the rows [degrees]
  double end_inside = 0;  ///< the same from the stress in the control volume inside
  double dilation = 0;    ///< volume strain at the end [-]
  Ratio inside, beyond, ending;
  double beyond_worst = 0;  ///< largest relative difference of Row::beyond and Row::walls of a row
  double energy_error = 0;  ///< (work - dissipation - kinetic energy) / work, at the end
  double sweeps = 0;        ///< mean
  std::size_t unsolved = 0;
};
Summary summary_of(const std::vector<biaxial::Row>& rows) {
  Summary s;
  for (const biaxial::Row& row : rows) {
    s.peak = std::max(s.peak, row.walls.friction_angle());
    s.unsolved += row.unsolved;
    s.beyond_worst = std::max({s.beyond_worst, std::abs(row.beyond.axial / row.walls.axial - 1),
                               std::abs(row.beyond.lateral / row.walls.lateral - 1)});
  }
  const std::size_t last_quarter = 3 * rows.size() / 4;
  s.end = mean_of(rows, last_quarter, [](const auto& row) { return row.walls.friction_angle(); });
  s.end_inside =
      mean_of(rows, last_quarter, [](const auto& row) { return row.inside.friction_angle(); });
  s.sweeps = mean_of(rows, 0, [](const auto& row) { return row.sweeps; });
  s.inside = mean_ratio(rows, &biaxial::Row::inside);
  s.beyond = mean_ratio(rows, &biaxial::Row::beyond);
  s.ending = mean_ratio(rows, &biaxial::Row::ending);
  const biaxial::Row& end = rows.back();
  s.dilation = end.volume_strain;
  s.energy_error = (end.work - end.dissipation - end.kinetic) / end.work;
  return s;
}

/// Prints a sentence if a check does not hold.
bool holds(bool condition, const char* sentence) {
  if (!condition) std::cout << "  MISS: " << sentence << '\n';
  return condition;
}

/// The checks that every sample has to pass.
bool passes(const Summary& s, bool at_rest, bool dense) {
  bool good = holds(at_rest, "the sample came to rest under the pressure");
  good &= holds(s.unsolved == 0, "every step was solved");
  good &= holds(std::abs(s.beyond.axial - 1) <= 0.01 && std::abs(s.beyond.lateral - 1) <= 0.01,
                "the mean stress of all contacts is that of the walls to 1 %");
  good &= holds(s.peak > 10 && s.peak < 60, "the friction angle is between 10 and 60 degrees");
  good &= holds(!dense || s.dilation > 0, "a dense sample dilates");
  good &= holds(std::abs(s.energy_error) <= 0.02,
                "the work of the walls is the dissipation and the kinetic energy to 2 %");
  return good;
}

/// One sample. Returns whether it passes the checks.
template <class Shape>
bool run_sample(const Options& options, const std::string& name, const std::string& preparation,
                std::uint64_t seed, Tables& tables) {
  constexpr int dim = moreau::SpaceOf<Shape>::dim;
  constexpr bool round = moreau::is_ball<Shape>;
  const bool dense = preparation == "dense";
  biaxial::Specimen<Shape> specimen(dim == 2 ? options.plane : options.space, seed,
                                    options.parameters);
  const bool at_rest = specimen.compress(dense ? 0 : options.parameters.friction, 5);
  const double fraction = specimen.solid_fraction();
  const std::vector<biaxial::Row> rows =
      specimen.shear(options.parameters.friction, options.rows,
                     dense && seed == 1 ? options.output / name : fs::path());
  for (const biaxial::Row& r : rows)
    tables.rows.row(dim, int{round}, int{dense}, seed, r.strain, r.volume_strain, r.walls.axial,
                    r.walls.lateral, r.inside.axial, r.inside.lateral, r.beyond.axial,
                    r.beyond.lateral, r.ending.axial, r.ending.lateral, r.walls.ratio(dim),
                    r.inside.ratio(dim), r.coordination, r.anisotropy, r.sweeps, r.residual,
                    r.unsolved, r.work, r.dissipation, r.kinetic);
  const Summary s = summary_of(rows);
  tables.samples.row(dim, int{round}, int{dense}, seed, fraction, s.peak, s.end, s.end_inside,
                     s.dilation, s.inside.axial, s.inside.lateral, s.beyond.axial, s.beyond.lateral,
                     s.beyond_worst, s.ending.axial, s.ending.lateral, s.energy_error, s.sweeps,
                     s.unsolved, specimen.steps(), specimen.approach(),
                     specimen.overlap() / biaxial::size);
  std::cout << name << ", " << preparation << ", seed " << seed << ": solid fraction " << fraction
            << "; friction angle at the peak " << s.peak << ", at the end " << s.end
            << " degrees; volume strain " << s.dilation
            << "; stress over that of the walls: " << s.inside.axial << " (axial), "
            << s.inside.lateral << " (lateral) inside, " << s.beyond.axial << ", "
            << s.beyond.lateral << " beyond the walls, " << s.ending.axial << ", "
            << s.ending.lateral << " if the volume ends on the walls; energy error "
            << s.energy_error << "; " << s.unsolved << " of " << specimen.steps()
            << " steps not solved\n";
  const bool good = passes(s, at_rest, dense);
  std::cout << std::flush;
  return good;
}

}  // namespace

int main(int argc, char** argv) try {
  const Options options = parsed(argc, argv);
  fs::create_directories(options.output);
  Tables tables{{options.output / "biaxial.csv",
                 {"dimension",
                  "round",
                  "dense",
                  "seed",
                  "strain",
                  "volume_strain",
                  {"axial_walls", "Pa"},
                  {"lateral_walls", "Pa"},
                  {"axial_inside", "Pa"},
                  {"lateral_inside", "Pa"},
                  {"axial_beyond", "Pa"},
                  {"lateral_beyond", "Pa"},
                  {"axial_ending", "Pa"},
                  {"lateral_ending", "Pa"},
                  "ratio_walls",
                  "ratio_inside",
                  "coordination",
                  "anisotropy",
                  "sweeps",
                  "residual",
                  "unsolved",
                  {"work", "J"},
                  {"dissipation", "J"},
                  {"kinetic", "J"}}},
                {options.output / "summary.csv",
                 {"dimension",
                  "round",
                  "dense",
                  "seed",
                  "solid_fraction",
                  {"peak", "degrees"},
                  {"end", "degrees"},
                  {"end_inside", "degrees"},
                  "volume_strain",
                  "axial_inside",
                  "lateral_inside",
                  "axial_beyond",
                  "lateral_beyond",
                  "worst_beyond",
                  "axial_ending",
                  "lateral_ending",
                  "energy_error",
                  "sweeps",
                  "unsolved",
                  "steps",
                  "approach",
                  "overlap"}}};
  bool good = true;
  for (const std::string& shape : options.shapes)
    for (const std::string& preparation : options.preparations)
      for (std::uint64_t seed = 1; seed <= options.samples; ++seed) {
        const auto run = [&]<class Shape>() {
          good &= run_sample<Shape>(options, shape, preparation, seed, tables);
        };
        if (shape == "disk") run.template operator()<moreau::Disk<double>>();
        if (shape == "polygon") run.template operator()<moreau::Polygon<double>>();
        if (shape == "ball") run.template operator()<moreau::Ball<double>>();
        if (shape == "polyhedron") run.template operator()<moreau::Polyhedron<double>>();
      }
  return good ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << "biaxial: " << error.what() << '\n';
  return 1;
}
