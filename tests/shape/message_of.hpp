// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

/// What the std::invalid_argument says that the call throws.
template <class Call>
std::string message_of(Call&& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing thrown";
}
