// SPDX-License-Identifier: MIT
// A simulation of a shape without mass properties. The message names the missing expression.
// expect: shape.mass_properties\(density\)
#include "moreau/shape/ball.hpp"

struct Bubble {
  using Space = moreau::Space<3>;
  moreau::Aabb<Space> bounding_box(const moreau::Pose<Space>& pose) const;
#ifdef MOREAU_CORRECTED
  moreau::MassProperties<Space> mass_properties(double density) const;
#endif
};

template <moreau::Shape T>
struct Grain {};

Grain<Bubble> grain;
