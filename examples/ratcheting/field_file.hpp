// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "moreau/io/csv.hpp"
#include "moreau/measure/velocity_field.hpp"

namespace ratcheting {

/// Cells of the fields of the study, in each direction.
inline constexpr std::size_t field_cells = 10;

/// Writes a field of field_cells² cells of the section, x to the right and z up: position and mean
/// vector of each cell, and the number of grains that were added to it.
/// @param name of the vector, for the titles of the columns
template <class S>
void write_field(const std::filesystem::path& path, const std::string& name,
                 const moreau::VelocityField<S>& field) {
  const std::string x = name + "_x", z = name + "_z";
  moreau::CsvWriter file(path, {"x", "z", x.c_str(), z.c_str(), "grains"});
  for (std::size_t row = 0; row < field_cells; ++row)
    for (std::size_t column = 0; column < field_cells; ++column) {
      const auto sample = field.sample(column, row);
      file.row(sample.position.x(), sample.position.y(), sample.velocity.x(), sample.velocity.y(),
               sample.grains);
    }
  file.close();
}

}  // namespace ratcheting
