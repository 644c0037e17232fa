// SPDX-License-Identifier: MIT
// Compound grains for the tests, in both dimensions from one text.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "moreau/shape/compound.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace compounds {

template <class Part>
Part hull(const std::vector<typename moreau::SpaceOf<Part>::Vector>& points) {
  return Part(std::span<const typename moreau::SpaceOf<Part>::Vector>(points));
}

/// A vector with the given first and last coordinate. In space the one between is `middle`.
template <class S>
typename S::Vector point(double first, double last, double middle = 0) {
  typename S::Vector x = S::Vector::Constant(typename S::Scalar(middle));
  x[0] = typename S::Scalar(first);
  x[S::dim - 1] = typename S::Scalar(last);
  return x;
}

/// A box between two corners.
template <class Part>
Part box(const typename moreau::SpaceOf<Part>::Vector& low,
         const typename moreau::SpaceOf<Part>::Vector& high) {
  using S = moreau::SpaceOf<Part>;
  std::vector<typename S::Vector> corners;
  for (unsigned bits = 0; bits < 1u << S::dim; ++bits) {
    corners.push_back(low);
    for (int k = 0; k < S::dim; ++k)
      if ((bits >> k & 1u) != 0) corners.back()[k] = high[k];
  }
  return hull<Part>(corners);
}

/// The two halves of a convex shape on the sides of a plane through the point, where their points are
/// in the shape's frame. The plane must not pass through a vertex: to rounding, it may lie on any side.
template <class Part>
std::vector<Part> halves(const Part& shape, const typename moreau::SpaceOf<Part>::Vector& normal,
                         const typename moreau::SpaceOf<Part>::Vector& through) {
  using S = moreau::SpaceOf<Part>;
  using Vector = typename S::Vector;
  std::vector<Vector> low, high;
  const auto height = [&](const Vector& x) { return normal.dot(x - through); };
  for (Eigen::Index i = 0; i < shape.vertices().rows(); ++i) {
    const Vector x = shape.vertices().row(i).transpose();
    (height(x) < 0 ? low : high).push_back(x);
    for (Eigen::Index j = 0; j < shape.vertices().rows(); ++j) {
      const Vector y = shape.vertices().row(j).transpose();
      if (!(height(x) < 0 && height(y) > 0)) continue;
      const Vector crossing = x + height(x) / (height(x) - height(y)) * (y - x);
      low.push_back(crossing);
      high.push_back(crossing);
    }
  }
  return {hull<Part>(low), hull<Part>(high)};
}

/// A column that carries a beam, as wide as the column on one side and longer on the other: the letter
/// gamma. Column: 1 wide, 1 high; beam: `length` long, 1 high; both 1 deep.
template <class Part>
moreau::Compound<Part> gamma(double length) {
  using S = moreau::SpaceOf<Part>;
  return moreau::Compound<Part>({box<Part>(point<S>(0, 0), point<S>(1, 1, 1)),
                                 box<Part>(point<S>(0, 1), point<S>(length, 2, 1))});
}

/// A regular simplex with a leg on each of its faces: a tetrapod, in the plane a tripod. The legs
/// become narrower. One of them points up.
template <class Part>
moreau::Compound<Part> tetrapod(double size) {
  using S = moreau::SpaceOf<Part>;
  using Vector = typename S::Vector;
  // Corners of the simplex: a regular one in D - 1 dimensions below an apex.
  std::vector<Vector> corners{Vector::Zero()};
  for (int k = 0; k < S::dim; ++k) {
    Vector centre = Vector::Zero();
    for (const Vector& x : corners) centre += x / typename S::Scalar(corners.size());
    const double radius = (corners[0] - centre).norm();
    corners.push_back(centre + std::sqrt(1 - radius * radius) * Vector::Unit(k));
  }
  Vector centre = Vector::Zero();
  for (Vector& x : corners) centre += x / typename S::Scalar(corners.size());
  for (Vector& x : corners) x = size * (x - centre);
  std::vector<Part> parts{hull<Part>(corners)};
  for (std::size_t omitted = 0; omitted < corners.size(); ++omitted) {
    std::vector<Vector> leg;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if (k == omitted) continue;
      leg.push_back(corners[k]);
      leg.push_back(0.6 * corners[k] - 1.2 * corners[omitted]);
    }
    parts.push_back(hull<Part>(leg));
  }
  // The last corner is the apex: the leg opposite to it points down. Turned over, it points up.
  std::vector<Part> turned;
  for (const Part& part : parts) {
    std::vector<Vector> points;
    for (Eigen::Index i = 0; i < part.vertices().rows(); ++i)
      points.push_back(-(part.centroid_of_input() + part.vertices().row(i).transpose()));
    turned.push_back(hull<Part>(points));
  }
  return moreau::Compound<Part>(std::span<const Part>(turned));
}

/// The corners of all parts in the frame of the grain.
template <class Part>
std::vector<typename moreau::SpaceOf<Part>::Vector> corners(const moreau::Compound<Part>& grain) {
  std::vector<typename moreau::SpaceOf<Part>::Vector> points;
  for (const auto& part : grain.parts())
    for (Eigen::Index i = 0; i < part.shape.vertices().rows(); ++i)
      points.push_back(part.pose(part.shape.vertices().row(i).transpose()));
  return points;
}

}  // namespace compounds
