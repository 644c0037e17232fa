// SPDX-License-Identifier: MIT
#include "shapes.hpp"

template <class ShapeT>
ShapeT hull_of(std::span<const typename ShapeT::Vector> points) {
  return ShapeT(points);
}

template moreau::Polyhedron<double> hull_of(std::span<const Eigen::Vector3d>);
template moreau::Polygon<double> hull_of(std::span<const Eigen::Vector2d>);
template moreau::Polyhedron<float> hull_of(std::span<const Eigen::Vector3f>);
template moreau::Polygon<float> hull_of(std::span<const Eigen::Vector2f>);
