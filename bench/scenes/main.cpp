// SPDX-License-Identifier: MIT
// Scenes as users run them: the time of each stage of a step, per pair and per point, the sweeps, the residual
// that was reached and the largest overlap. Seeded; a scene takes some seconds to some minutes.
//
//   bench_scenes SCENE [NAME=VALUE]...      prints a line of the table
//   bench_scenes                            prints the head of the table
//
//   pressed        1,200 hulls, each with a shape of its own, poured into a box and pressed by a wall of 50 kg
//                  under 3 + 3 sin(2 pi 5 t) kN; h = 2e-4 s
//   concave        the same with 400 concave grains of four parts; to compare with pressed size=400
//   falling        1,000 hulls of 32 vertices fall onto a floor; h = 1/60 s, as all scenes below
//   resting        the same at rest
//   convex_pile    1,280 equal hulls of 32 points (radius 2 m) fall from a grid of 8 x 8 x 20, as in Box3D's
//                  benchmark of this name (there 80 layers)
//   pyramid        820 boxes in 40 rows
//   mesh           1,000 hulls on a wavy mesh of 20,000 triangles
//   plane_pressed, plane_falling, plane_resting, plane_pyramid   1,200 and 2,000 polygons, 820 squares in the plane
//
//   scalar=float   single precision (default double)
//   points=few     at most D points of a contact between faces (default all)
//   tolerance=R    of the residual (default 1e-3)
//   stop=qm16      LMGC90's stopping test in place of the residual
//   narrows=no     contacts of all pairs within the margin (default: up to the gap that a pair can close in a step)
//   islands=no     small islands by sweeps, too, also those of the overlap correction (default: by the direct method)
//   interval=N, cap=N, accelerate=no    ColouredOptions::check_interval, max_sweeps, accelerate
//   correct=no     without overlap correction; correction_sweeps=N, slop=S, rate=R: its options
//   skin=S, carry=C, resolution=R    Tolerances::skin, carry, resolution
//   setting=games  the options of examples/guide/choosing.md for the accuracy of physics engines for games
//   margin=M       of detection, relative to the grain size (default: that of the scene)
//   order=O        of the grains: added (default; the order of pouring), curve or random
//   size=N         grains, or rows of a pyramid
//   threads=N      of the team (default 1). More than one: also prints how long a cache line takes from
//                  one core to another
//   settle=N, steps=N   steps before the measurement, and of it
//   state=FILE     poses and velocities at the beginning of the measurement: read, or made and written. So
//                  versions are compared from one state
//   write=FILE     only writes what bench/peers/engines need to build the scene
//   poses=FILE     writes the poses of the grains at four times of the measurement
//   check=FILE     only prints the overlaps of such poses, of whatever program
#include <atomic>
#include <chrono>
#include <cstdio>
#include <exception>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>

#include "measure.hpp"

namespace {

using scenes::Options;

/// One-way time of a cache line between two threads that hand it to each other [ns]: of ten rounds, the median.
double time_of_cache_line() {
  constexpr int turns = 20000;
  alignas(64) std::atomic<int> line{0};
  scenes::Series times;
  for (int round = 0; round < 10; ++round) {
    line = 0;
    std::thread other([&] {
      for (int k = 0; k < turns; ++k) {
        while (line.load(std::memory_order_acquire) != 2 * k + 1) {
        }
        line.store(2 * k + 2, std::memory_order_release);
      }
    });
    const auto start = std::chrono::steady_clock::now();
    for (int k = 0; k < turns; ++k) {
      line.store(2 * k + 1, std::memory_order_release);
      while (line.load(std::memory_order_acquire) != 2 * k + 2) {
      }
    }
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    other.join();
    times.add(time.count() / (2.0 * turns));
  }
  return times.median();
}

/// As accurate as physics engines for games, and as fast for piles.
void set_as_for_games(moreau::ColouredOptions& sweeps, moreau::Tolerances& tolerances,
                      moreau::OverlapCorrectionOptions& correction) {
  tolerances.carry = 5e-3;
  sweeps.tolerance = 1e-2;
  sweeps.check_interval = 12;
  sweeps.islands = correction.islands = false;
  correction.slop = 5e-3;
  correction.sweeps = 4;
}

void set(Options& options, const std::string& argument) {
  const auto at = argument.find('=');
  if (at == std::string::npos) throw std::invalid_argument(argument + ": NAME=VALUE expected");
  const std::string name = argument.substr(0, at), value = argument.substr(at + 1);
  const auto number = [&] { return std::stod(value); };
  const auto count = [&] { return std::stoi(value); };
  const bool yes = value != "no";
  const std::map<std::string, std::function<void()>> setters{
      {"scalar", [&] { options.scalar = value; }},
      {"points", [&] { options.points = value; }},
      {"order", [&] { options.order = value; }},
      {"state", [&] { options.state = value; }},
      {"write", [&] { options.write = value; }},
      {"poses", [&] { options.poses = value; }},
      {"check", [&] { options.check = value; }},
      {"setting",
       [&] {
         if (value != "games") throw std::invalid_argument(value + ": no such setting");
         set_as_for_games(options.solver, options.tolerances, options.correction);
       }},
      {"narrows", [&] { options.tolerances.narrows = yes; }},
      {"carry", [&] { options.tolerances.carry = number(); }},
      {"skin", [&] { options.tolerances.skin = number(); }},
      {"resolution", [&] { options.tolerances.resolution = number(); }},
      {"islands", [&] { options.solver.islands = options.correction.islands = yes; }},
      {"tolerance", [&] { options.solver.tolerance = number(); }},
      {"stop",
       [&] {
         if (value != "qm16") throw std::invalid_argument(value + ": no such stopping test");
         options.solver.stop_test = moreau::StopTest::qm16;
       }},
      {"interval", [&] { options.solver.check_interval = count(); }},
      {"cap", [&] { options.solver.max_sweeps = count(); }},
      {"accelerate", [&] { options.solver.accelerate = yes; }},
      {"correct", [&] { options.correction.enabled = yes; }},
      {"correction_sweeps", [&] { options.correction.sweeps = count(); }},
      {"slop", [&] { options.correction.slop = number(); }},
      {"rate", [&] { options.correction.rate = number(); }},
      {"margin", [&] { options.margin = number(); }},
      {"size", [&] { options.size = count(); }},
      {"threads", [&] { options.threads = count(); }},
      {"settle", [&] { options.settle = count(); }},
      {"steps", [&] { options.steps = count(); }},
  };
  const auto setter = setters.find(name);
  if (setter == setters.end()) throw std::invalid_argument(name + ": no such option");
  setter->second();
}

void run(const Options& options) {
  const bool in_float = options.scalar == "float";
  if (options.threads > 1 && options.write.empty() && options.check.empty())
    std::printf("a cache line takes %.0f ns from one core to another\n", time_of_cache_line());
  const bool done =
      in_float ? scenes::run_polyhedra_float(options) || scenes::run_polygons_float(options)
               : scenes::run_polyhedra(options) || scenes::run_polygons(options) ||
                     scenes::run_compounds(options);
  if (!done) throw std::invalid_argument(options.scene + ": no such scene in " + options.scalar);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2) {
      scenes::print_header();
      return 0;
    }
    Options options;
    options.scene = argv[1];
    for (int k = 2; k < argc; ++k) set(options, argv[k]);
    run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_scenes: %s\n", error.what());
    return 1;
  }
}
