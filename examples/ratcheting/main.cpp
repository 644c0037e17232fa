// SPDX-License-Identifier: MIT
#include <csignal>
#include <cstdio>
#include <exception>

#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/sphere.hpp"

#include "command_line.hpp"
#include "run.hpp"

namespace ratcheting {

namespace {
volatile std::sig_atomic_t stop = 0;
}

bool interrupted() {
  return stop != 0;
}

void catch_interrupts() {
  std::signal(SIGINT, [](int) { stop = 1; });
  std::signal(SIGTERM, [](int) { stop = 1; });
}

namespace {

int dispatch(const Parameters& p) {
  if (p.shape == "polygon") return run<moreau::Polygon<double>>(p);
  if (p.shape == "sphere") return run<moreau::Sphere<moreau::Space<3>>>(p);
  if (p.shape == "disk") return run<moreau::Sphere<moreau::Space<2>>>(p);
  return run<moreau::Polyhedron<double>>(p);
}

}  // namespace

}  // namespace ratcheting

int main(int argc, char** argv) {
  int status = 0;
  const auto parameters = ratcheting::parse(argc, argv, status);
  if (!parameters) return status;
  ratcheting::catch_interrupts();
  try {
    return ratcheting::dispatch(*parameters);
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
