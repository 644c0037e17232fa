// SPDX-License-Identifier: MIT
// Functions for the vertices of polytopes in both dimensions. The vertices are stored as an N x D
// matrix whose columns (all x, all y, ...) are contiguous.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "moreau/core/aabb.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/sort_items.hpp"

namespace moreau {

/// N x D matrix with one vertex (or normal) per row.
template <class S>
using VertexMatrix = Eigen::Matrix<typename S::Scalar, Eigen::Dynamic, S::dim>;

/// Index of the first vertex that is farthest in the direction. There must be at least one vertex.
/// @param direction  in the axes of the vertices, of any length but zero
template <class S>
std::size_t farthest_vertex(const VertexMatrix<S>& vertices, const typename S::Vector& direction) {
  MOREAU_ASSERT(direction.squaredNorm() > 0);
  Eigen::Index farthest = 0;
  auto reach = vertices.row(0).dot(direction);
  for (Eigen::Index i = 1; i < vertices.rows(); ++i) {
    const auto here = vertices.row(i).dot(direction);
    if (here > reach) {
      reach = here;
      farthest = i;
    }
  }
  return static_cast<std::size_t>(farthest);
}

/// A row as a vector.
template <class S>
typename S::Vector row_of(const VertexMatrix<S>& rows, Eigen::Index i) {
  typename S::Vector row;
  for (int k = 0; k < S::dim; ++k) row[k] = rows(i, k);
  return row;
}

/// The smallest box in world axes [m] around vertices at a pose.
/// @param vertices  body coordinates [m]
template <class S>
Aabb<S> box_around(const VertexMatrix<S>& vertices, const Pose<S>& pose) {
  const typename S::Matrix rotation = pose.rotation.toRotationMatrix();
  Aabb<S> box;
  for (Eigen::Index i = 0; i < vertices.rows(); ++i) {
    box.merge(product(rotation, row_of<S>(vertices, i)));
  }
  box.lower += pose.position;
  box.upper += pose.position;
  return box;
}

/// Squared distance of a row from a point, both in the same axes and unit.
template <class S>
typename S::Scalar squared_distance(const VertexMatrix<S>& rows, Eigen::Index i,
                                    const typename S::Vector& point) {
  typename S::Scalar sum = 0;
  for (int k = S::dim - 1; k >= 0; --k) {
    const typename S::Scalar along = rows(i, k) - point[k];
    sum = along * along + sum;
  }
  return sum;
}

/// The smallest distance between two of the rows, in their unit; infinite if there is only one row.
/// The rows are sorted along an oblique direction, so that few pairs have to be compared. Along an
/// axis many rows can have the same coordinate: the normals of a prism.
template <class S>
typename S::Scalar least_distance(const VertexMatrix<S>& rows) {
  using T = typename S::Scalar;
  constexpr T direction[] = {T(0.8320502943), T(0.4803844614), T(0.2773500981)};  // unit
  struct Entry {
    T along;
    Eigen::Index row;
  };
  List<Entry> order(static_cast<std::size_t>(rows.rows()));
  T size = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = {0, static_cast<Eigen::Index>(i)};
    for (int k = 0; k < S::dim; ++k) {
      order[i].along += direction[k] * rows(order[i].row, k);
      size = std::max(size, std::abs(rows(order[i].row, k)));
    }
  }
  const T rounding = 16 * std::numeric_limits<T>::epsilon() * size;
  sort_items(order, [](const Entry& a, const Entry& b) {
    return a.along != b.along ? a.along < b.along : a.row < b.row;
  });
  T least = std::numeric_limits<T>::infinity();
  for (std::size_t i = 0; i < order.size(); ++i) {
    const typename S::Vector here = row_of<S>(rows, order[i].row);
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      if (!(order[j].along - order[i].along - rounding < least)) break;
      least = std::min(least, std::sqrt(squared_distance<S>(rows, order[j].row, here)));
    }
  }
  return least;
}

namespace detail {

/// @throws std::invalid_argument naming the first vertex that is not finite
template <class Vector>
void require_finite(std::span<const Vector> vertices, std::string_view function) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (all_finite(vertices[i])) continue;
    throw_invalid(function, "vertices[" + std::to_string(i) + "]", vertices[i], "must be finite");
  }
}

}  // namespace detail

}  // namespace moreau
