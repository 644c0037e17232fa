// SPDX-License-Identifier: MIT
// A support function with the return type auto: it returns an Eigen expression of its argument.
// expect: shape.support\(direction\)
#include "moreau/shape/ball.hpp"

struct Ball : moreau::Ball<double> {
#ifdef MOREAU_CORRECTED
  Vector support(const Vector& direction) const {
    return 2 * direction;
  }
#else
  auto support(const Vector& direction) const {
    return 2 * direction;
  }
#endif
};

template <moreau::ConvexShape T>
struct Grain {};

Grain<Ball> grain;
