// SPDX-License-Identifier: MIT
// Walls of a simulation that are no half-spaces.
#pragma once

#include "moreau/core/ids.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/mesh/mesh_wall.hpp"
#include "moreau/shape/cylinder_wall.hpp"

namespace moreau {

/// A cylinder wall of a simulation: its body, and its shape in the frame of the body.
template <class S>
struct CylinderBody {
  BodyId body;  ///< its pose places the shape
  /// In the frame of the body.
  CylinderWall<S> shape = SerializationAccess::blank<CylinderWall<S>>();
};

/// A mesh wall of a simulation: its body, and its shape in the frame of the body.
template <class S>
struct MeshBody {
  BodyId body;  ///< its pose places the shape
  /// In the frame of the body.
  MeshWall<S> shape = SerializationAccess::blank<MeshWall<S>>();
};

}  // namespace moreau
