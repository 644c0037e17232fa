// SPDX-License-Identifier: MIT
// Dense flow without walls, for disks, spheres, polygons and polyhedra from one source: grains in a periodic cell are
// sheared at a rate and compressed by a stress across the shear.
//
//   sheared_cell [--quick] [--shape NAME] [--strain X] [--out FOLDER]
//
//   --shape   disks, spheres, polygons or polyhedra; without it all of them
//   --strain  of each rate before the measurement, which takes twice as long; 4 without it, 0.2 with --quick
//   --out     folder of the tables (NAME_flow.txt, NAME_start.txt) and of a snapshot after each line of NAME_flow.txt,
//             from which a run that was stopped continues
//
// For each rate the program prints the inertial number I = rate d sqrt(rho / P), the effective friction mu = shear
// stress / normal stress, and the solid fraction (flow). Before, it shears a dense and a loose sample slowly, and prints
// strain, mu and solid fraction: both approach the critical state (start).
//
// Units: diameter d of a ball of the mean volume, density rho and stress P are 1.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <moreau/moreau.hpp>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "moreau/io/snapshot.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/sample/ballast.hpp"

namespace {

using Law = moreau::Compliant<moreau::SignoriniCoulomb<>>;
constexpr double friction = 0.4, stiffness = 2000, pressure = 1;

/// Mean values over an interval.
struct State {
  double strain = 0, normal = 0, shear = 0, fraction = 0;
};

template <class Shape>
class ShearedCell {
 public:
  using S = moreau::SpaceOf<Shape>;
  using Matrix = typename S::Matrix;

  /// Empty, to be read from a snapshot.
  ShearedCell() : simulation_(0.8, laws(friction)) {}
  /// Grains with the volumes of balls of 0.8 to 1.2 diameters, far apart on a lattice; then compressed by the same
  /// stress on all sides.
  /// @param rubbing friction of the grains during the compression: without any the sample becomes dense
  ShearedCell(int side, double rubbing) : ShearedCell() {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> radius(0.4, 0.6), jitter(-0.1, 0.1);
    const int count = S::dim == 2 ? side * side : side * side * side;
    for (int k = 0; k < count; ++k) {
      const Shape shape = moreau::Ballast<Shape>::draw(random);
      const double ball = moreau::BallIn<S>(radius(random)).mass_properties(1).mass,
                   scale = std::pow(ball / shape.mass_properties(1).mass, 1.0 / S::dim);
      moreau::Pose<S> pose;
      for (int axis = 0, rest = k; axis < S::dim; ++axis, rest /= side)
        pose.position[axis] = 1.6 * (rest % side + 0.5) + jitter(random);
      simulation_.add_grain(simulation_.add_shape(shape.scaled(scale)), pose, 1);
    }
    simulation_.set_cell(1.6 * side * Matrix::Identity());
    simulation_.set_materials(laws(rubbing));
    moreau::CellControl<S> control;
    control.mass = mass() * Matrix::Identity();
    control.stress = pressure * Matrix::Identity();
    control.damping = damping();
    simulation_.control_cell(control);
    for (int k = 0; k < 10 / damping() / step(); ++k) simulation_.step(step());
    simulation_.set_materials(laws(friction));
  }
  /// Shears along x with y. The width of the cell stays; its height has the stress.
  /// @returns means over the strain
  State shear(double rate, double strain) {
    moreau::CellControl<S> control;
    control.rate(0, 1) = rate;
    control.mass(1, 1) = mass();
    control.stress(1, 1) = pressure;
    control.damping = damping();
    simulation_.control_cell(control);
    State mean;
    const int steps = int(std::ceil(strain / rate / step()));
    for (int k = 0; k < steps; ++k) {
      simulation_.step(step());
      const Matrix stress = simulation_.cell_motion().stress();
      mean.normal += stress(1, 1) / steps;
      mean.shear -= (stress(0, 1) + stress(1, 0)) / 2 / steps;
      mean.fraction += mass() / simulation_.cell().volume() / steps;
    }
    const Matrix deformation = simulation_.cell_motion().deformation();
    mean.strain = deformation(0, 1) / deformation(1, 1);
    return mean;
  }
  /// A wave of the speed sqrt(P / rho) crosses the cell in 1 / damping.
  double damping() const { return std::pow(1 / double(simulation_.grain_count()), 1.0 / S::dim); }
  void write(const std::filesystem::path& path) const { moreau::write_snapshot(path, simulation_); }
  void read(const std::filesystem::path& path) { moreau::read_snapshot(path, simulation_); }

 private:
  static moreau::Materials<Law> laws(double friction_between) {
    return moreau::Materials<Law>(
        1, Law(moreau::SignoriniCoulomb<>(friction_between), stiffness, stiffness / 2));
  }
  double mass() const {
    double sum = 0;
    for (const double one : simulation_.bodies().grain_mass) sum += one;
    return sum;
  }
  double step() const { return 0.2 * std::sqrt(mass() / stiffness); }  // the cell is slower

  moreau::Simulation<Shape, Law> simulation_;
};

struct Options {
  bool quick = false;
  std::string shape, out;
  double strain = 4;
};

/// A table that goes to the screen and to a file of the folder.
class Table {
 public:
  Table(const Options& options, const std::string& name, const std::string& head) {
    if (options.out.empty()) {
      std::cout << "# " << name << ": " << head << '\n';
      return;
    }
    path_ = std::filesystem::path(options.out) / (name + ".txt");
    std::ifstream before(path_);
    for (std::string line; std::getline(before, line);) lines_ += line[0] != '#';
    head_ = "# " + head + '\n';
    if (!std::filesystem::exists(path_)) clear();
  }
  /// Removes all lines of numbers.
  void clear() {
    lines_ = 0;
    if (!path_.empty()) std::ofstream(path_) << head_;
  }
  std::size_t lines() const { return lines_; }  ///< of numbers that were there
  void add(double first, const State& state) {
    char line[80];
    std::snprintf(line, sizeof line, "%8.5f %8.4f %8.4f %8.4f\n", first, state.shear / state.normal,
                  state.fraction, state.normal);
    std::cout << line << std::flush;
    if (!path_.empty()) std::ofstream(path_, std::ios::app) << line;
  }

 private:
  std::filesystem::path path_;
  std::string head_;
  std::size_t lines_ = 0;
};

template <class Shape>
void run(const char* name, int side, const Options& options) {
  if (!options.shape.empty() && options.shape != name) return;
  const std::filesystem::path snapshot =
      std::filesystem::path(options.out) / (std::string(name) + ".snapshot");
  Table start(options, name + std::string("_start"), "strain, mu, solid fraction, normal stress");
  const int intervals = options.quick ? 2 : 40;
  if (start.lines() < std::size_t(2 * intervals)) {
    start.clear();
    for (const double rubbing : {0.0, friction}) {  // dense, loose
      ShearedCell<Shape> cell(side, rubbing);
      for (int k = 0; k < intervals; ++k) {
        const State state = cell.shear(0.01, 0.05);
        start.add(state.strain, state);
      }
      if (!options.out.empty()) cell.write(snapshot);
    }
  }
  Table flow(options, name + std::string("_flow"), "I, mu, solid fraction, normal stress");
  ShearedCell<Shape> cell = [&] {
    if (options.out.empty()) return ShearedCell<Shape>(side, friction);
    ShearedCell<Shape> read;
    read.read(snapshot);
    return read;
  }();
  const std::vector<double> rates =
      options.quick ? std::vector<double>{0.3, 0.1}
                    : std::vector<double>{0.3, 0.2, 0.1, 0.05, 0.03, 0.02, 0.01, 0.005, 0.003};
  for (std::size_t k = flow.lines(); k < rates.size(); ++k) {
    cell.shear(rates[k], std::max(options.strain, 5 * rates[k] / cell.damping()));
    const State state = cell.shear(rates[k], 2 * options.strain);
    flow.add(rates[k] / std::sqrt(state.normal), state);
    if (!options.out.empty()) cell.write(snapshot);
  }
}

Options options_of(int argc, char** argv) {
  Options options;
  bool has_strain = false;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    const bool has_value = k + 1 < argc;
    if (word == "--quick") {
      options.quick = true;
    } else if (word == "--shape" && has_value) {
      options.shape = argv[++k];
    } else if (word == "--out" && has_value) {
      options.out = argv[++k];
    } else if (word == "--strain" && has_value) {
      std::istringstream text(argv[++k]);
      if (!(text >> options.strain) || !(text >> std::ws).eof() || !(options.strain > 0))
        throw std::invalid_argument("--strain must be a number > 0");
      has_strain = true;
    } else {
      throw std::invalid_argument(
          "usage: sheared_cell [--quick] [--shape disks|spheres|polygons|polyhedra] [--strain X] "
          "[--out FOLDER]");
    }
  }
  if (options.quick && !has_strain) options.strain = 0.2;
  if (!options.out.empty()) std::filesystem::create_directories(options.out);
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options options = options_of(argc, argv);
    run<moreau::Disk<>>("disks", 14, options);
    run<moreau::Ball<>>("spheres", 7, options);
    run<moreau::Polygon<>>("polygons", 14, options);
    run<moreau::Polyhedron<>>("polyhedra", 7, options);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
