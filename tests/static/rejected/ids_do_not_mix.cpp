// SPDX-License-Identifier: MIT
// The id of a body is passed where the id of a shape is required.
// expect: (could not convert|no known conversion)
#include "moreau/core/ids.hpp"

inline std::size_t vertices_of(moreau::ShapeId shape) {
  return shape.index();
}

#ifdef MOREAU_CORRECTED
const std::size_t count = vertices_of(moreau::ShapeId(std::size_t{1}));
#else
const std::size_t count = vertices_of(moreau::BodyId(std::size_t{1}));
#endif
