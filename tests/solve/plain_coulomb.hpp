// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/law/local_block.hpp"
#include "moreau/law/signorini_coulomb.hpp"

namespace solve_test {

using namespace moreau;

/// A contact law that has only the functions that the concept requires.
template <class T>
struct PlainCoulomb {
  SignoriniCoulomb<T> law;

  T velocity_offset(T gap, T before, T step) const {
    return law.velocity_offset(gap, before, step);
  }
  template <class S>
  typename S::Vector solve(const LocalBlock<S>& block, const typename S::Vector& b,
                           const typename S::Vector& guess) const {
    return law.solve(block, b, guess);
  }
  template <class Vector>
  Vector natural_map(const Vector& u, const Vector& r) const {
    return law.natural_map(u, r);
  }
  template <class Vector>
  Vector project(const Vector& x) const {
    return law.project(x);
  }
};

}  // namespace solve_test
