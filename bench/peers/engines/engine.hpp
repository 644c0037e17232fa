// SPDX-License-Identifier: MIT
// A scene as `bench_scenes SCENE write=FILE` describes it, run by a physics engine for games at its own defaults,
// on one thread, without sleep:
//
//   bench_ENGINE FILE [poses=FILE] [substeps=N] [settle=N] [steps=N]
//
// prints the CPU time of the steps, and writes the poses at four times for `bench_scenes SCENE check=FILE`.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace engines {

struct Wall {
  std::array<double, 3> point{}, normal{};  ///< [m]; unit, out of the solid
};
struct Body {
  std::size_t shape = 0;
  std::array<double, 3> position{};            ///< of the centre of mass [m]
  std::array<double, 4> rotation{0, 0, 0, 1};  ///< x y z w, in the plane the angle first
};
/// What the file says; in the plane the third coordinates are 0.
struct Description {
  int dim = 3, settle = 0, steps = 0;
  double gravity = 0, step = 0, friction = 0,
         density = 1000;                                   ///< [m/s^2], along the last axis; [s]
  std::vector<std::vector<std::array<double, 3>>> shapes;  ///< corners [m]
  std::vector<Wall> walls;
  std::vector<Body> bodies;

  /// Half the edges of a shape if it is a box along its axes, else 0.
  std::array<double, 3> half_edges(std::size_t shape) const {
    std::array<double, 3> half{};
    const auto& corners = shapes[shape];
    if (corners.size() != std::size_t{1} << dim) return {};
    for (int axis = 0; axis < dim; ++axis) {
      half[std::size_t(axis)] = std::abs(corners[0][std::size_t(axis)]);
      for (const auto& corner : corners)
        if (std::abs(std::abs(corner[std::size_t(axis)]) - half[std::size_t(axis)]) > 1e-9)
          return {};
    }
    return half;
  }
};

inline Description read(const std::string& path) {
  std::ifstream file(path);
  Description scene;
  const auto vector = [&](auto& x, int size) {
    for (int k = 0; k < size; ++k) file >> x[std::size_t(k)];
  };
  std::size_t count = 0;
  file >> scene.dim >> scene.gravity >> scene.step >> scene.friction >> scene.settle >>
      scene.steps >> count;
  scene.shapes.resize(count);
  for (auto& corners : scene.shapes) {
    file >> count;
    corners.resize(count);
    for (auto& corner : corners) vector(corner, scene.dim);
  }
  file >> count;
  scene.walls.resize(count);
  for (Wall& wall : scene.walls) vector(wall.point, scene.dim), vector(wall.normal, scene.dim);
  file >> count;
  scene.bodies.resize(count);
  for (Body& body : scene.bodies) {
    file >> body.shape;
    vector(body.position, scene.dim);
    vector(body.rotation, scene.dim == 3 ? 4 : 1);
  }
  if (!file) throw std::runtime_error(path + " does not describe a scene");
  return scene;
}

/// Runs an engine and prints its times.
/// @tparam Engine made of a description; step(h, substeps), pairs(), stages(), body(k)
template <class Engine>
int run(int argc, char** argv) {
  try {
    if (argc < 2) throw std::invalid_argument("a file of bench_scenes SCENE write=FILE expected");
    std::map<std::string, std::string> options;
    for (int k = 2; k < argc; ++k) {
      const std::string option = argv[k];
      const auto at = option.find('=');
      if (at == std::string::npos) throw std::invalid_argument(option + ": NAME=VALUE expected");
      options[option.substr(0, at)] = option.substr(at + 1);
    }
    const auto number = [&](const char* name, int value) {
      return options.count(name) ? std::stoi(options[name]) : value;
    };
    const Description scene = read(argv[1]);
    const int settle = number("settle", scene.settle), steps = number("steps", scene.steps);
    const int substeps = number("substeps", Engine::substeps);
    Engine engine(scene);
    for (int k = 0; k < settle; ++k) engine.step(scene.step, substeps);
    std::ofstream poses;
    if (options.count("poses")) poses.open(options["poses"]);
    poses.precision(9);
    engine.start();
    std::vector<double> times;
    double sum = 0, pairs = 0;
    for (int k = 0; k < steps; ++k) {
      const std::clock_t start = std::clock();
      engine.step(scene.step, substeps);
      times.push_back(1e3 * double(std::clock() - start) / CLOCKS_PER_SEC);
      sum += times.back(), pairs += double(engine.pairs());
      if (poses.is_open() && (k + 1) % std::max(1, steps / 4) == 0)
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
          const Body body = engine.body(i);
          for (int axis = 0; axis < scene.dim; ++axis)
            poses << body.position[std::size_t(axis)] << ' ';
          for (int j = 0; j < (scene.dim == 3 ? 4 : 1); ++j)
            poses << body.rotation[std::size_t(j)] << ' ';
          poses << '\n';
        }
    }
    std::sort(times.begin(), times.end());
    std::printf("%s: CPU ms per step %.3f, median %.3f, pairs %.0f%s\n", Engine::name,
                sum / std::max(1, steps), times.empty() ? 0 : times[times.size() / 2],
                pairs / std::max(1, steps), engine.stages(steps).c_str());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", Engine::name, error.what());
    return 1;
  }
}

}  // namespace engines
