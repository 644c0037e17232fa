// SPDX-License-Identifier: MIT
// The shapes that fuzz targets build, compiled once for all targets: with sanitizers they take most
// of the compile time.
#pragma once

#include <span>

#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

/// Calls the constructor.
template <class ShapeT>
ShapeT hull_of(std::span<const typename ShapeT::Vector> points);
