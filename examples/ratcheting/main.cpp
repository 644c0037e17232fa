// SPDX-License-Identifier: MIT
#include <csignal>
#include <map>
#include <stdexcept>
#include <string>

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

std::map<Runner::Name, Runner::Function>& Runner::all() {
  static std::map<Name, Function> runners;
  return runners;
}

int Runner::run(const Parameters& p) {
  const auto found = all().find({p.shape, p.method});
  if (found != all().end()) return found->second(p);
  throw std::invalid_argument("--shape: this program was built without " + p.shape +
                              "; add it to RATCHETING_SHAPES");
}

}  // namespace ratcheting

int main(int argc, char** argv) {
  int status = 0;
  const auto parameters = ratcheting::parse(argc, argv, status);
  if (!parameters) return status;
  ratcheting::catch_interrupts();
  return ratcheting::exit_status([&] { return ratcheting::Runner::run(*parameters); });
}
