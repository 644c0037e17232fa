// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "moreau/mesh/facet_mesh.hpp"
#include "moreau/shape/polyhedron.hpp"

/// Limits of a convex decomposition.
struct DecompositionLimits {
  unsigned parts = 8;      ///< the least number of parts
  unsigned vertices = 40;  ///< the largest number of vertices of a part
  double concavity =
      0.05;  ///< parts are divided while they are deeper than this [1/size of the mesh]
};

/// Whether the program was built with a library for convex decompositions.
bool can_decompose();

/// Convex parts that together are about the solid that a mesh bounds, by the library HACD (K. Mamou, F.
/// Ghorbel, ICIP 2009), which Debian has in libbullet-extras-dev. The parts may overlap slightly.
/// @param mesh a solid (require_solid())
/// @returns the parts, in the frame of the mesh: centroid_of_input() is the place of each
/// @throws std::runtime_error if the program was built without the library, or if it finds no parts
std::vector<moreau::Polyhedron<>> decompose(const moreau::TriangleMesh<>& mesh,
                                            const DecompositionLimits& limits);
