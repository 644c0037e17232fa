// SPDX-License-Identifier: MIT
// The wall's way out is measured alike in a run and in the study.
#pragma once

#include "../ratcheting/active_phase.hpp"

namespace study {

using ratcheting::active_phase;
using ratcheting::ActivePhase;
using ratcheting::time_before_minimum;

}  // namespace study
