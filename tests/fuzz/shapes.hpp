// SPDX-License-Identifier: MIT
// The shapes that fuzz targets build, compiled once for all of them: under sanitizers it is most of
// their time.
#pragma once

#include <span>

#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

/// The constructor.
template <class ShapeT>
ShapeT hull_of(std::span<const typename ShapeT::Vector> points);
