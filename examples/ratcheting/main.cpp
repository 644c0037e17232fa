// SPDX-License-Identifier: MIT
#include <algorithm>
#include <csignal>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

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

std::map<std::pair<std::string, std::string>, Runner::Function>& Runner::all() {
  static std::map<std::pair<std::string, std::string>, Function> runners;
  return runners;
}

int Runner::run(const Parameters& p) {
  std::string method = p.method;
  std::replace(method.begin(), method.end(), '-', '_');
  const auto found = all().find({p.shape, method});
  if (found != all().end()) return found->second(p);
  throw std::invalid_argument("--shape, --method: this program was built without " + p.shape +
                              " and " + p.method +
                              "; add them to RATCHETING_SHAPES and RATCHETING_METHODS");
}

}  // namespace ratcheting

int main(int argc, char** argv) {
  int status = 0;
  const auto parameters = ratcheting::parse(argc, argv, status);
  if (!parameters) return status;
  ratcheting::catch_interrupts();
  return ratcheting::exit_status([&] { return ratcheting::Runner::run(*parameters); });
}
