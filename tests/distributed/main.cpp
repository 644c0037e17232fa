// SPDX-License-Identifier: MIT
// The program of the tests with several processes. Every process runs every test.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "moreau/distributed/communicator.hpp"

int main(int argc, char** argv) {
  const moreau::MpiSession mpi(argc, argv);
  doctest::Context context(argc, argv);
  return context.run();
}
