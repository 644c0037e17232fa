// SPDX-License-Identifier: MIT
// The same experiment in the plane and in space, with angular and with round grains: the collapse of
// a column. Grains fill a box of length L0 up to the height H = a L0. Then the right wall is taken
// away, and the grains flow out over the floor until they come to rest. In space the box is
// periodic along its depth, so that the flow is plane in the mean.
//
//   plane_and_space [folder] [grains in the plane] [grains in space] [samples]
//
// The defaults are plane_and_space-output, 120, 480 and 3. The lengths L0 of the columns of the plane and of
// space then differ by a quarter at most, so that their grains have about the same time in units of
// sqrt(L0 / g). Prints the run-out (L - L0) / L0 over the aspect ratio a, with its standard error over the samples, and writes it to plane_and_space.csv in
// the folder. Each sample is stored in a file of its own in the folder samples/ when it is finished.
// A run that was stopped continues from these files; delete them after a change of the program.
// run.sh builds, runs and plots it.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <moreau/moreau.hpp>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "moreau/io/csv.hpp"
#include "moreau/io/output_file.hpp"
#include "moreau/sample/ballast.hpp"
#include "moreau/sample/random_deposition.hpp"
#include "moreau/sample/size_distribution.hpp"

namespace fs = std::filesystem;
using Law = moreau::SignoriniCoulomb<double>;

namespace setup {
constexpr double size = 0.01, depth = 0.05;  // of the smallest grain, of the box in space [m]
constexpr double gravity = 9.81, h = 5e-4;   // [m/s^2], [s]
constexpr double friction = 0.4;             // of grains with grains and with the floor [-]
constexpr double longest = 1.5;              // of the collapse, for grains that roll on [s]
}  // namespace setup

/// One column.
template <class Shape>
class Column {
 public:
  using S = moreau::SpaceOf<Shape>;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;

  /// @param aspect H / L0 of the column, about
  Column(std::size_t count, double aspect, std::uint64_t seed)
      : simulation_(setup::size, moreau::Materials<Law>(1, Law(setup::friction)), {},
                    tolerances()) {
    std::mt19937_64 random(seed);
    const moreau::SizeDistribution diameters({{setup::size, 0.5}, {1.5 * setup::size, 0.5}});
    std::vector<Shape> shapes;
    std::vector<double> radii;
    double volume = 0;
    for (const double diameter : diameters.sample(count, random)) {
      shapes.push_back(moreau::Ballast<Shape>::draw(random).scaled(diameter / 2));
      radii.push_back(diameter / 2);
      volume += shapes.back().volume();
    }
    // Solid fractions of about 0.8 in the plane and 0.55 in space.
    const double section = up == 1 ? volume / 0.8 : volume / 0.55 / setup::depth;
    length_ = std::sqrt(section / aspect);
    if (const double least = 2 * 1.5 * setup::size; length_ < least)
      throw std::invalid_argument(std::to_string(count) + " grains make a column of " +
                                  std::to_string(length_) + " m length; it must be " +
                                  std::to_string(least) + " m, two of the largest grains, or more");
    fill(shapes, radii, random);
    simulation_.add_wall(Vector::Unit(up), Vector::Zero());
    simulation_.add_wall(Vector::UnitX(), Vector::Zero());
    gate_ = simulation_.add_wall(-Vector::UnitX(), length_ * Vector::UnitX());
    for (int axis = 1; axis < up; ++axis) simulation_.set_periodic(axis, 0, setup::depth);
    simulation_.set_gravity(-setup::gravity * Vector::Unit(up));
  }

  /// Fills the box, takes the wall away and waits for rest.
  /// @returns the run-out (L - L0) / L0, where L is the length that contains 98 % of the grains [-]
  double collapse() {
    settle(1.5);
    moreau::Pose<S> pose = simulation_.pose(gate_);
    pose.position += 1000 * Vector::UnitX();
    simulation_.set_pose(gate_, pose);
    settle(setup::longest);
    std::vector<double> x;
    for (const moreau::BodyId grain : simulation_.grains())
      x.push_back(simulation_.pose(grain).position[0]);
    const auto front = x.begin() + std::ptrdiff_t(0.98 * double(x.size()));
    std::nth_element(x.begin(), front, x.end());
    return (*front - length_) / length_;
  }
  std::size_t steps() const { return steps_; }
  std::size_t unsolved() const { return unsolved_; }  ///< steps that the solver did not solve
  double duration() const { return duration_; }       ///< of the collapse [s]
  double length() const { return length_; }           ///< L0 [m]

 private:
  /// A larger margin than the default, for grains that fall at 2 m/s.
  static moreau::Tolerances tolerances() {
    moreau::Tolerances tolerances;
    tolerances.margin = 0.1;
    return tolerances;
  }
  /// Adds the grains. Their floor is a square in space, so several depositions stand side by side
  /// along the box.
  void fill(const std::vector<Shape>& shapes, const std::vector<double>& radii,
            std::mt19937_64& random) {
    const double widest = up == 1 ? length_ : setup::depth;
    const auto towers = static_cast<std::size_t>(std::ceil(length_ / widest));
    const double width = std::min(widest, length_ / double(towers));
    for (std::size_t tower = 0; tower < towers; ++tower) {
      std::vector<double> own;
      for (std::size_t k = tower; k < radii.size(); k += towers) own.push_back(radii[k]);
      auto poses = moreau::random_deposition<S>(own, width, random);
      for (std::size_t k = 0; k < poses.size(); ++k) {
        poses[k].position[0] += length_ / double(towers) * double(tower);
        simulation_.add_grain(simulation_.add_shape(shapes[tower + k * towers]), poses[k], 2500);
      }
    }
  }
  /// Steps until the fastest grain moves by less than a hundredth of its size in 0.05 s.
  /// @param longest time [s]
  void settle(double longest) {
    const double start = simulation_.time();
    double fastest = 1;
    while (simulation_.time() - start < longest &&
           (fastest > 0.2 * setup::size || simulation_.time() - start < 0.2)) {
      const moreau::StepReport report = simulation_.step(setup::h);
      ++steps_;
      unsolved_ += !report.solve.converged;
      fastest = 0;
      for (const moreau::BodyId grain : simulation_.grains())
        fastest = std::max(fastest, simulation_.velocity(grain).norm());
    }
    duration_ = simulation_.time() - start;
  }

  moreau::Simulation<Shape, Law> simulation_;
  moreau::BodyId gate_;
  double length_ = 0, duration_ = 0;
  std::size_t steps_ = 0, unsolved_ = 0;
};

/// Results of one sample.
struct Sample {
  double run_out = 0, duration = 0, length = 0;
  std::size_t steps = 0, unsolved = 0;
};

/// The sample in this file, or, if there is no such file, a new sample, which is then stored in it.
template <class Shape>
Sample stored_sample(const fs::path& path, std::size_t count, double aspect, std::uint64_t seed) {
  Sample sample;
  if (std::ifstream file(path);
      file >> sample.run_out >> sample.duration >> sample.length >> sample.steps >> sample.unsolved)
    return sample;
  Column<Shape> column(count, aspect, seed);
  sample.run_out = column.collapse();
  sample.duration = column.duration(), sample.length = column.length();
  sample.steps = column.steps();
  sample.unsolved = column.unsolved();
  std::ostringstream text;
  text.precision(17);
  text << sample.run_out << ' ' << sample.duration << ' ' << sample.length << ' ' << sample.steps
       << ' ' << sample.unsolved << '\n';
  moreau::write_atomically(path, text.str());
  return sample;
}

/// Where the samples are stored, and how many there are for each aspect ratio.
struct Series {
  fs::path folder;
  std::uint64_t samples;
};

/// All samples of one shape.
template <class Shape>
void run(const std::string& name, std::size_t count, const Series& series,
         moreau::CsvWriter& file) {
  const auto n = double(series.samples);
  for (const double aspect : {0.5, 1.0, 2.0, 4.0}) {
    double sum = 0, square = 0, duration = 0, length = 0;
    std::size_t steps = 0, unsolved = 0;
    for (std::uint64_t seed = 1; seed <= series.samples; ++seed) {
      std::ostringstream stem;
      stem << name << '_' << count << '_' << aspect << '_' << seed << ".txt";
      const Sample sample =
          stored_sample<Shape>(series.folder / "samples" / stem.str(), count, aspect, seed);
      sum += sample.run_out;
      square += sample.run_out * sample.run_out;
      duration += sample.duration / n;
      length += sample.length / n;
      steps += sample.steps;
      unsolved += sample.unsolved;
    }
    const double mean = sum / n;
    const double variance = std::max(0.0, (square - n * mean * mean) / std::max(1.0, n - 1));
    // One sample says nothing of the error.
    const double error = n > 1 ? std::sqrt(variance / n) : std::numeric_limits<double>::quiet_NaN();
    std::cout << name << ", a = " << aspect << ", L0 = " << length << " m: run-out " << mean;
    if (n > 1) std::cout << " +- " << error;
    std::cout << ", end after " << duration << " s; " << unsolved << " of " << steps
              << " steps not solved" << std::endl;
    const bool round = moreau::is_ball<Shape>;
    file.row(double(moreau::SpaceOf<Shape>::dim), double(count), aspect, mean, error, n, duration,
             length, double(round));
  }
}

/// Throws if the columns of the largest aspect ratio would be too narrow.
template <class Shape>
void check_length(std::size_t count) {
  Column<Shape>(count, 4, 1);
}

int main(int count, char** arguments) try {
  const auto number = [&](int k, int otherwise) {
    return count > k ? std::stoul(arguments[k]) : static_cast<unsigned long>(otherwise);
  };
  const Series series{count > 1 ? arguments[1] : "plane_and_space-output", number(4, 3)};
  const std::size_t plane = number(2, 120), space = number(3, 480);
  check_length<moreau::Polygon<double>>(plane);
  check_length<moreau::Polyhedron<double>>(space);
  fs::create_directories(series.folder / "samples");
  moreau::CsvWriter file(series.folder / "plane_and_space.csv", {"dimension",
                                                                 "grains",
                                                                 "aspect",
                                                                 "run_out",
                                                                 "standard_error",
                                                                 "samples",
                                                                 {"duration", "s"},
                                                                 {"length", "m"},
                                                                 "round"});
  run<moreau::Polygon<double>>("polygons", plane, series, file);
  run<moreau::Disk<double>>("disks", plane, series, file);
  run<moreau::Polyhedron<double>>("polyhedra", space, series, file);
  run<moreau::Ball<double>>("balls", space, series, file);
} catch (const std::exception& error) {
  std::cerr << "plane_and_space: " << error.what() << '\n';
  return 1;
}
