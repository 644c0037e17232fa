// SPDX-License-Identifier: MIT
// Input: an arbitrary text. Expected: a valid problem or an error.
#include "moreau/io/siconos_text.hpp"

#include <stdexcept>
#include <string_view>

#include "bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    std::visit(
        [](const auto& problem) {
          hold(problem.delassus.rows() == problem.delassus.cols(), "square");
          hold(problem.free_velocity.size() == problem.delassus.rows(), "as many velocities");
          hold(problem.free_velocity.allFinite() && problem.friction.allFinite(), "finite");
        },
        moreau::parse_siconos_text(text));
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
