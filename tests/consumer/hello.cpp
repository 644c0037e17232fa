// SPDX-License-Identifier: MIT
// Needs the headers and Eigen, and little time.
#include <iostream>
#include <moreau/core/pose.hpp>
#include <moreau/version.hpp>

int main() {
  const moreau::Pose<moreau::Space<3>> pose;
  std::cout << "moreau " << MOREAU_VERSION_STRING << '\n';
  return pose.is_finite() ? 0 : 1;
}
