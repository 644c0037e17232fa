// SPDX-License-Identifier: MIT
// Numbers and judgements as they stand in the report.
#pragma once

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "estimate.hpp"

namespace study {

/// Whether a value lies in a range, bounds included; nothing for one that is not finite.
inline std::optional<bool> within(double value, double low, double high) {
  if (!std::isfinite(value)) return std::nullopt;
  return value >= low && value <= high;
}

inline bool is_plane(const std::string& shape) {
  return shape == "polygon" || shape == "disk";
}
/// The paper's C of row 17, for grains with corners.
inline double paper_constant(const std::string& shape) {
  return is_plane(shape) ? 0.05 : 0.01;
}

/// As it stands behind a value.
inline const char* mark(const std::optional<bool>& holds) {
  return holds ? *holds ? " **✓**" : " **✗**" : "";
}

/// To so many significant digits; empty if it is not finite.
inline std::string text_of(double value, int digits = 3) {
  if (!std::isfinite(value)) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  std::string out = text;
  if (out.front() == '-') out.replace(0, 1, "−");
  return out;
}

/// "1.23 ± 0.04 (3)": mean, spread and number of samples; empty for none.
inline std::string text_of(const Estimate& e, int digits = 3) {
  if (e.samples == 0) return "";
  if (e.samples == 1) return text_of(e.mean, digits);
  return text_of(e.mean, digits) + " ± " + text_of(e.spread, 2) + " (" + std::to_string(e.samples) +
         ")";
}

}  // namespace study
