// SPDX-License-Identifier: MIT
// Data for the tests of ParaView files.
#pragma once

#include <span>
#include <vector>

#include "moreau/io/vtk.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace vtk_samples {

using namespace moreau;

inline Polyhedron<double> tetrahedron() {
  using V = Space<3>::Vector;
  const std::vector<V> v = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return Polyhedron<double>(std::span<const V>(v));
}

template <class S>
ContactSegment<S> segment(const typename S::Vector& from, const typename S::Vector& to,
                          double force) {
  return {0, 1, from, to, (from + to) / 2, force, force / 4, -1e-6, ContactClass::face_face};
}

}  // namespace vtk_samples
