// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>

#include "moreau/core/aabb.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/shape/concepts.hpp"

namespace moreau::detail {

/// The smallest width of a grain [m]. A step refuses overlaps at the start that are deep relative to it. For a polytope it is the smallest
/// width along the normal of a face, for a rounded polytope that of its core and twice the radius, for a compound that of its
/// thinnest part, for another shape the smallest extent of its box in body axes.
template <class ShapeT>
MOREAU_INLINED inline typename SpaceOf<ShapeT>::Scalar smallest_width(const ShapeT& shape) {
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  if constexpr (CompoundShape<ShapeT>) {
    Scalar least = std::numeric_limits<Scalar>::infinity();
    for (const auto& part : shape.parts()) least = std::min(least, smallest_width(part.shape));
    return least;
  } else if constexpr (Polytope<ShapeT>) {
    Scalar least = std::numeric_limits<Scalar>::infinity();
    for (Eigen::Index f = 0; f < shape.face_normals().rows(); ++f) {
      Scalar depth = 0;  // of the shape below the face
      for (Eigen::Index v = 0; v < shape.vertices().rows(); ++v)
        depth =
            std::max(depth, shape.face_offsets()[f] -
                                Scalar(shape.face_normals().row(f).dot(shape.vertices().row(v))));
      least = std::min(least, depth);
    }
    return least;
  } else if constexpr (requires {
                         requires Polytope<std::remove_cvref_t<decltype(shape.core())>>;
                       }) {
    return smallest_width(shape.core()) + 2 * shape.radius();
  } else if constexpr (requires { shape.visit([](const auto&) {}); }) {
    return shape.visit([](const auto& held) { return smallest_width(held); });
  } else {
    const Aabb<S> box = shape.bounding_box(Pose<S>());
    return (box.upper - box.lower).minCoeff();
  }
}

}  // namespace moreau::detail
