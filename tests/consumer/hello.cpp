// SPDX-License-Identifier: MIT
// A small program that needs only the headers and Eigen and runs in a short time.
#include <iostream>
#include <moreau/core/pose.hpp>
#include <moreau/version.hpp>

int main() {
  const moreau::Pose<moreau::Space<3>> pose;
  std::cout << "moreau " << MOREAU_VERSION_STRING << '\n';
  return pose.is_finite() ? 0 : 1;
}
