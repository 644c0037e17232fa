// SPDX-License-Identifier: MIT
// Runs a scene of the testbed without a page, for comparison with the page: the test compares positions
// of the wall, and the page of the testbed steps per second.
//
//   testbed SCENE SHAPE STEPS [key=value...]
//   testbed box polyhedron 100 packing=0 seed=2
//
// Prints the values of every step as CSV, and the steps per second on the error output.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string>

#include "make_scene.hpp"

namespace {

/// The index of a name in a table.
template <class Table>
std::size_t find(const Table& table, const std::string& key, const char* what) {
  const std::size_t k = testbed::index_of(table, key);
  if (k < table.size()) return k;
  std::string all;
  for (const auto& entry : table) all += std::string(" ") + entry.key;
  throw std::invalid_argument("no " + std::string(what) + " '" + key + "'; there are" + all);
}

void run(int count, char** arguments) {
  if (count < 4) throw std::invalid_argument("usage: testbed SCENE SHAPE STEPS [key=value...]");
  const auto kind = testbed::SceneKind(find(testbed::scenes, arguments[1], "scene"));
  const auto shape = testbed::ShapeKind(find(testbed::shapes, arguments[2], "shape"));
  const long steps = std::atol(arguments[3]);
  testbed::Settings settings;
  for (int k = 4; k < count; ++k) {
    const std::string pair = arguments[k];
    const std::size_t equals = pair.find('=');
    if (equals == std::string::npos) throw std::invalid_argument("not key=value: " + pair);
    const auto& entry =
        testbed::setting_table[find(testbed::setting_table, pair.substr(0, equals), "setting")];
    settings.*entry.value = std::stod(pair.substr(equals + 1));
  }
  const auto scene = testbed::make_scene(kind, shape, settings);
  for (std::size_t c = 0; c < scene->channels().size(); ++c)
    std::printf("%s%s", c == 0 ? "" : ",", scene->channels()[c].key);
  std::printf("\n");
  using Clock = std::chrono::steady_clock;
  std::chrono::duration<double> spent{0};
  for (long step = 0; step < steps; ++step) {
    const auto start = Clock::now();
    scene->step();
    spent += Clock::now() - start;
    for (std::size_t c = 0; c < scene->samples().size(); ++c)
      std::printf("%s%.17g", c == 0 ? "" : ",", scene->samples()[c]);
    std::printf("\n");
    scene->clear_samples();
  }
  scene->write_frame();
  std::fprintf(stderr, "%zu grains, %zu contact points, %zu steps with most sweeps, %.1f steps/s\n",
               scene->placements().size(), scene->status().points, scene->status().capped,
               double(steps) / spent.count());
}

}  // namespace

int main(int count, char** arguments) try {
  run(count, arguments);
} catch (const std::exception& error) {
  std::fprintf(stderr, "testbed: %s\n", error.what());
  return 2;
}
