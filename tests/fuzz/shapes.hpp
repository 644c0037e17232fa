// SPDX-License-Identifier: MIT
// The shapes that fuzz targets construct. They are compiled once for all targets, because with
// sanitizers they take most of the compile time.
#pragma once

#include <span>

#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

/// Calls the constructor of the shape.
template <class ShapeT>
ShapeT hull_of(std::span<const typename ShapeT::Vector> points);
