// SPDX-License-Identifier: MIT
// expect: shape.vertices\(\)
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polyhedron.hpp"

template <moreau::Polytope T>
struct Clipped {};

#ifdef MOREAU_CORRECTED
Clipped<moreau::Polyhedron<double>> clipped;
#else
Clipped<moreau::Ball<double>> clipped;
#endif
