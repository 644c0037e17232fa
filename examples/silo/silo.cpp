// SPDX-License-Identifier: MIT
// Discharge of ballast from a silo, convex beside concave, in the plane and in space, and the constants C
// and k of Beverloo's law
//
//     W = C rho sqrt(g) (D - k d)^(dim - 1/2)
//
// for the rate W, the outlet D, the bulk density rho and the grain size d (W. A. Beverloo, H. A. Leniger,
// J. van de Velde, Chem. Eng. Sci. 15 (1961), 260). W^(1/(dim - 1/2)) is then linear in D; C and k follow from
// the line through all samples.
//
// Writes silo.csv (every sample), beverloo.csv (C and k of every shape) and a picture of every shape. A run
// that was stopped continues from the samples in OUTPUT/samples; delete them after a change of the program.
// run.sh builds, runs and plots it.
#include "silo.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "moreau/io/csv.hpp"
#include "moreau/io/output_file.hpp"

namespace fs = std::filesystem;

namespace {

struct Options {
  fs::path output = "silo-output";
  std::size_t plane = 500, space = 1000, samples = 3;
  std::vector<std::string> shapes{"polygon", "concave_polygon", "polyhedron", "concave_polyhedron"};
};

Options parsed(int argc, char** argv) {
  Options o;
  CLI::App app(
      "Discharge of ballast from a silo with a funnel that is a mesh, against Beverloo's law",
      "silo");
  app.option_defaults()->always_capture_default();
  app.add_option("--output", o.output, "folder for all files");
  app.add_option("--plane", o.plane, "grains in the plane")->check(CLI::Range(1, 1000000));
  app.add_option("--space", o.space, "grains in space")->check(CLI::Range(1, 1000000));
  app.add_option("--samples", o.samples, "random packings of each shape and outlet")
      ->check(CLI::Range(1, 1000));
  app.add_option("--shape", o.shapes, "the shapes to run")->check(CLI::IsMember(o.shapes));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& end) {
    std::exit(app.exit(end));
  }
  return o;
}

/// One shape: which silo, and how many grains.
struct Series {
  std::string name;
  int parts;  // convex parts of a grain
  std::size_t grains;
  double radius;                  // of the straight part [m]
  std::array<double, 3> outlets;  // [m]
};

/// The sample in this file, or, if there is no such file, a new one, which is then stored in it.
template <class Shape>
silo::Discharge stored_sample(const fs::path& path, const Series& series, double outlet,
                              std::uint64_t seed, const fs::path& picture) {
  silo::Discharge sample;
  if (std::ifstream file(path);
      file >> sample.rate >> sample.bulk_density >> sample.steps >> sample.unsolved)
    return sample;
  silo::Silo<Shape> silo(series.grains, series.radius, outlet, seed);
  sample = silo.discharge(picture);
  std::ostringstream text;
  text.precision(17);
  text << sample.rate << ' ' << sample.bulk_density << ' ' << sample.steps << ' ' << sample.unsolved
       << '\n';
  moreau::write_atomically(path, text.str());
  return sample;
}

/// A straight line y = slope (x - zero) through at least three points, by least squares, with standard
/// errors. Here x and y are lengths [m].
struct Line {
  double slope = 0, zero = 0, slope_error = 0, zero_error = 0;
};
Line line(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = double(x.size());
  double mx = 0, my = 0, xx = 0, xy = 0, rest = 0;
  for (std::size_t k = 0; k < x.size(); ++k) mx += x[k] / n, my += y[k] / n;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - mx) * (x[k] - mx);
    xy += (x[k] - mx) * (y[k] - my);
  }
  Line found;
  found.slope = xy / xx;
  found.zero = mx - my / found.slope;
  for (std::size_t k = 0; k < x.size(); ++k)
    rest += std::pow(y[k] - found.slope * (x[k] - found.zero), 2) / (n - 2);
  found.slope_error = std::sqrt(rest / xx);
  found.zero_error =
      std::sqrt(rest * (1 / n + (mx - found.zero) * (mx - found.zero) / xx)) / found.slope;
  return found;
}

/// C of each sample for k = 1.4, the value of the literature: mean and standard error.
struct Mean {
  double value = 0, error = 0;
};
Mean prefactor(const std::vector<double>& outlets, const std::vector<double>& reduced,
               double power) {
  const auto n = double(outlets.size());
  double sum = 0, square = 0;
  for (std::size_t k = 0; k < outlets.size(); ++k) {
    const double c = std::pow(reduced[k] / (outlets[k] - 1.4 * silo::size), power);
    sum += c, square += c * c;
  }
  const double mean = sum / n;
  return {mean, std::sqrt(std::max(0.0, square / n - mean * mean) / (n - 1))};
}

struct Tables {
  moreau::CsvWriter samples, fits;
};

template <class Shape>
void run(const Options& options, const Series& series, Tables& tables) {
  constexpr int dim = moreau::SpaceOf<Shape>::dim;
  constexpr double power = dim - 0.5;
  std::vector<double> outlets, reduced;
  std::size_t steps = 0, unsolved = 0, stopped = 0;
  for (const double outlet : series.outlets) {
    double rate = 0;
    std::size_t flowing = 0;
    for (std::uint64_t seed = 1; seed <= options.samples; ++seed) {
      std::ostringstream stem;
      stem << series.name << '_' << series.grains << '_' << outlet << '_' << seed << ".txt";
      const bool drawn = seed == 1 && outlet == series.outlets[1];
      const silo::Discharge sample =
          stored_sample<Shape>(options.output / "samples" / stem.str(), series, outlet, seed,
                               drawn ? options.output / (series.name + ".png") : fs::path());
      steps += sample.steps, unsolved += sample.unsolved;
      const double flux = sample.rate / (sample.bulk_density * std::sqrt(silo::gravity));
      tables.samples.row(dim, series.parts, series.grains, outlet, seed, sample.rate,
                         sample.bulk_density, std::pow(flux, 1 / power));
      if (sample.rate == 0) {
        ++stopped;
        continue;
      }
      ++flowing, rate += sample.rate;
      outlets.push_back(outlet), reduced.push_back(std::pow(flux, 1 / power));
    }
    std::cout << series.name << ", outlet " << outlet << " m: ";
    if (flowing > 0)
      std::cout << rate / double(flowing) << (dim == 2 ? " kg/(m s)" : " kg/s") << ", mean of "
                << flowing << std::endl;
    else
      std::cout << "arches stopped the flow of all samples" << std::endl;
  }
  std::cout << series.name << ": " << unsolved << " of " << steps << " steps not solved, "
            << stopped << " samples stopped flowing";
  if (outlets.size() > 2) {
    const Line fit = line(outlets, reduced);
    const double c = std::pow(fit.slope, power), c_error = c * power * fit.slope_error / fit.slope;
    const double k = fit.zero / silo::size, k_error = fit.zero_error / silo::size;
    const Mean usual = prefactor(outlets, reduced, power);
    std::cout << "; C = " << usual.value << " +- " << usual.error
              << " for k = 1.4; fitted: C = " << c << " +- " << c_error << ", k = " << k << " +- "
              << k_error;
    tables.fits.row(dim, series.parts, series.grains, options.samples, c, c_error, k, k_error,
                    usual.value, usual.error);
  }
  std::cout << std::endl;
}

}  // namespace

int main(int argc, char** argv) try {
  const Options options = parsed(argc, argv);
  fs::create_directories(options.output / "samples");
  Tables tables{{options.output / "silo.csv",
                 {"dimension",
                  "parts",
                  "grains",
                  {"outlet", "m"},
                  "seed",
                  {"rate", "kg/s"},
                  "bulk_density",
                  {"reduced_rate", "m"}}},
                {options.output / "beverloo.csv",
                 {"dimension", "parts", "grains", "samples", "C", "C_error", "k", "k_error",
                  "C_for_1.4", "C_for_1.4_error"}}};
  const std::array<double, 3> in_plane{0.13, 0.16, 0.19}, in_space{0.08, 0.10, 0.12};  // [m]
  for (const std::string& shape : options.shapes) {
    const int parts = shape.starts_with("concave") ? 4 : 1;
    const Series plane{shape, parts, options.plane, 0.2, in_plane};
    const Series space{shape, parts, options.space, 0.1, in_space};
    if (shape == "polygon") run<moreau::Polygon<double>>(options, plane, tables);
    if (shape == "concave_polygon")
      run<moreau::Compound<moreau::Polygon<double>>>(options, plane, tables);
    if (shape == "polyhedron") run<moreau::Polyhedron<double>>(options, space, tables);
    if (shape == "concave_polyhedron")
      run<moreau::Compound<moreau::Polyhedron<double>>>(options, space, tables);
  }
} catch (const std::exception& error) {
  std::cerr << "silo: " << error.what() << '\n';
  return 1;
}
