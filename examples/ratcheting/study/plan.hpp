// SPDX-License-Identifier: MIT
// The cases of the study: one parameter at a time around the baseline.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "../parameters.hpp"

namespace study {

using ratcheting::Parameters;

/// One run of `ratcheting`. Its name says what differs from the paper's defaults, so that two cases
/// of one name are one case.
struct Case {
  std::size_t number = 0;  ///< from 1, in the order in which they run
  std::string name;        ///< of its folder
  /// All of the run's. `from` is the name of the case whose checkpoint the run starts from.
  Parameters parameters;
  std::set<std::string> sets;  ///< the series that it belongs to
};

/// Which cases are asked for; what is empty does not restrict.
struct Selection {
  std::vector<std::string> sets, shapes;
  std::vector<std::size_t> seeds, numbers;
};

/// The names of the plans: "paper", "small", "settled" and "controls".
std::vector<std::string> plan_names();

/// The cases of a plan, the most telling first.
/// @throws std::invalid_argument for a name that is no plan's
std::vector<Case> make_plan(const std::string& name);

/// The cases of these sets, shapes, seeds and numbers; empty: all. Without numbers also the cases whose
/// jammed states they start from.
/// @throws std::invalid_argument for a set, shape or number that no case of the plan has
std::vector<Case> select(const std::vector<Case>& plan, const Selection& selection);

/// Command line of `ratcheting`, without program, --from and --output: all that differs from its
/// defaults.
std::vector<std::string> arguments(const Parameters& p);

/// The name of what the preparation makes of these parameters: cases that share it start from one
/// packing.
std::string packing_name(const Parameters& p);

/// Estimated seconds of a run on one core, without the preparation.
double seconds_of(const Parameters& p);

/// What the paper says of the baseline: 5 Hz, 6 kN, m_w = m/2, H/L = 1, 9.81 m/s^2.
Parameters baseline(const std::string& plan, const std::string& shape, std::size_t seed = 1);

}  // namespace study
