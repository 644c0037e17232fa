// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "moreau/detect/manifold.hpp"

/// Whether two manifolds are equal bit by bit.
template <class S>
bool is_same(const moreau::Manifold<S>& one, const moreau::Manifold<S>& other) {
  if (one.gap != other.gap || one.normal != other.normal ||
      one.contact_class != other.contact_class || one.points.size() != other.points.size())
    return false;
  for (std::size_t k = 0; k < one.points.size(); ++k)
    if (one.points[k].feature != other.points[k].feature ||
        one.points[k].gap != other.points[k].gap ||
        one.points[k].position != other.points[k].position)
      return false;
  return true;
}
