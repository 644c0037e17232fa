// SPDX-License-Identifier: MIT
#pragma once

#include "parameters.hpp"

namespace ratcheting {

/// Runs the study with one shape, by the method that is asked for, and writes all files.
/// @returns exit status: 0, or 130 if interrupted (what was written is complete)
/// @throws std::runtime_error if a file cannot be written, std::invalid_argument for values that
/// make
///         no experiment
template <class ShapeT>
int run(const Parameters& p);

/// Set by the signal handler of Ctrl-C; asked after every step.
bool interrupted();
void catch_interrupts();

}  // namespace ratcheting
