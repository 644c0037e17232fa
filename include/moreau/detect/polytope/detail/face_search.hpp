// SPDX-License-Identifier: MIT
// The face of one polyhedron along whose normal the separation from another polyhedron is largest.
//
// For a face f of A with unit normal n_f and the plane n_f . x = offset_f, the separation is
//     s(n_f) = min over b in B of n_f . b - offset_f.
// So the height of any single point b above the plane is an upper bound of s(n_f). Algorithm:
//   1. A set of a few vertices of B gives an upper bound of s(n_f) for every face f.
//   2. The face with the largest bound is measured exactly, by the support function of B.
//   3. The vertex of B that is deepest below this face joins the set. The search returns to step 1
//      until the measured separation equals the largest bound. Usually two or three rounds are
//      needed.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "moreau/detect/polytope/detail/feature_axis.hpp"

namespace moreau::detail {

/// A few vertices of one shape, relative to the centre of the other shape, world axes [m].
template <std::floating_point T>
class PointSet {
 public:
  using Vector = typename Space<3, T>::Vector;
  static constexpr std::size_t capacity = 16;

  std::size_t size() const { return size_; }
  bool full() const { return size_ == capacity; }
  const Vector& operator[](std::size_t i) const { return points_[i]; }
  const Vector& back() const { return points_[size_ - 1]; }
  bool contains(std::uint32_t id) const { return find(id) < size_; }
  /// Position in the set of the vertex with this index; size() if the vertex is not in the set.
  std::size_t find(std::uint32_t id) const {
    std::size_t i = 0;
    while (i < size_ && ids_[i] != id) ++i;
    return i;
  }
  void add(std::uint32_t id, const Vector& point) {
    MOREAU_ASSERT(!full());
    ids_[size_] = id;
    points_[size_++] = point;
  }

 private:
  std::size_t size_ = 0;
  std::array<std::uint32_t, capacity> ids_;
  std::array<Vector, capacity> points_;
};

/// A list of indices that are smaller than `total`. If more than 64 indices are added, the list
/// stands for all indices smaller than `total`.
class ShortList {
 public:
  explicit ShortList(std::size_t total) : total_(total) {}
  std::size_t size() const { return is_all_ ? total_ : size_; }
  std::uint32_t operator[](std::size_t k) const {
    return is_all_ ? static_cast<std::uint32_t>(k) : ids_[k];
  }
  void add(std::uint32_t id) {
    if (size_ < ids_.size())
      ids_[size_++] = id;
    else
      is_all_ = true;
  }
  bool contains(std::uint32_t id) const {
    for (std::size_t k = 0; k < size(); ++k)
      if ((*this)[k] == id) return true;
    return false;
  }

 private:
  std::size_t total_, size_ = 0;
  bool is_all_ = false;
  std::array<std::uint32_t, 64> ids_;
};

/// A point set prepared for vector registers: each coordinate is repeated in all lanes of a
/// register.
template <std::floating_point T>
class WidePoints {
 public:
  using Point = std::array<typename Wide<T>::Values, 3>;
  explicit WidePoints(const PointSet<T>& points) {
    for (std::size_t k = 0; k < points.size(); ++k)
      points_[k] = PointRows<Space<3, T>>::broadcast(points[k]);
  }
  const Point& operator[](std::size_t k) const { return points_[k]; }

 private:
  std::array<Point, PointSet<T>::capacity> points_;
};

/// For each face of a shape, a mask that says which points of a set lie at most at a given height
/// above the plane of the face: bit k is set for point k.
template <std::floating_point T>
class FaceMasks {
 public:
  using Lanes = Wide<T>;

  FaceMasks(const Placed<Polyhedron<T>>& shape, const PointSet<T>& points)
      : shape_(shape), points_(points) {}

  /// Computes the masks.
  /// @param height  largest height of a point above the plane of a face [m]
  void update(T height) {
    height_ = height;
    const auto& normals = shape_.normals();
    if (normals.padded_size() > capacity) return;
    is_stored_ = true;
    const WidePoints<T> wide(points_);
    typename Lanes::Indices in_common{};
    in_common = ~in_common;
    for (Eigen::Index i = 0; i < normals.padded_size(); i += Lanes::lanes) {
      const auto level = height_ + Lanes::load(shape_.offsets() + i);
      typename Lanes::Indices mask{};
      for (std::size_t k = 0; k < points_.size(); ++k)
        mask |= (normals.dot(i, wide[k]) <= level) & (typename Lanes::Lane{1} << k);
      in_common &= mask;
      for (int l = 0; l < Lanes::lanes; ++l)
        masks_[static_cast<std::size_t>(i + l)] = static_cast<std::uint16_t>(mask[l]);
    }
    in_common_ = static_cast<std::uint32_t>(Lanes::common_bits(in_common));
  }

  std::uint32_t operator[](std::size_t face) const {
    return is_stored_ ? masks_[face] : compute(face);
  }
  /// The masks of all faces. Null if the shape has more than 512 faces; operator[] then computes
  /// the mask of a face at each call.
  const std::uint16_t* stored() const { return is_stored_ ? masks_.data() : nullptr; }
  /// Mask of the points whose height above every face is at most the given height.
  std::uint32_t in_common() const {
    if (is_stored_) return in_common_;
    std::uint32_t common = ~0U;
    for (std::size_t f = 0; f < shape_.normals().size(); ++f) common &= compute(f);
    return common;
  }

 private:
  static_assert(PointSet<T>::capacity <= 16);
  static constexpr Eigen::Index capacity = 512;

  std::uint32_t compute(std::size_t face) const {
    std::uint32_t mask = 0;
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (height_above(shape_, face, points_[k]) <= height_) mask |= 1U << k;
    return mask;
  }

  const Placed<Polyhedron<T>>& shape_;
  const PointSet<T>& points_;
  T height_ = 0;
  bool is_stored_ = false;
  std::uint32_t in_common_ = 0;
  std::array<std::uint16_t, capacity> masks_;
};

/// For each face, take the smallest height of the points above its plane. Returns the face with the
/// largest of these heights, and that height [m].
template <std::floating_point T>
Extreme<T> highest_above(const Placed<Polyhedron<T>>& shape, const PointSet<T>& points) {
  using Lanes = Wide<T>;
  const WidePoints<T> wide(points);
  WideMaximum<T> best{Lanes::broadcast(-std::numeric_limits<T>::infinity()), Lanes::iota()};
  auto index = Lanes::iota();
  for (Eigen::Index i = 0; i < shape.normals().padded_size(); i += Lanes::lanes) {
    auto lowest = shape.normals().dot(i, wide[0]);
    for (std::size_t k = 1; k < points.size(); ++k) {
      const auto h = shape.normals().dot(i, wide[k]);
      lowest = h < lowest ? h : lowest;
    }
    best.take(lowest - Lanes::load(shape.offsets() + i), index);
    index += Lanes::lanes;
  }
  return best.reduce();
}

/// The face of `own` along whose normal the separation from `other` is largest.
/// @param offset    centre of other minus centre of own, world axes [m]
/// @param points    at least one vertex of other, relative to the centre of own. Vertices are added
/// @param at_least  only separations larger than this are considered [m]. If there is none,
///                  is_found of the result is false
template <std::floating_point T>
FaceSeparation<T> search_faces(const Placed<Polyhedron<T>>& own, const Placed<Polyhedron<T>>& other,
                               const typename Space<3, T>::Vector& offset, PointSet<T>& points,
                               T at_least) {
  FaceSeparation<T> best{at_least, 0, 0, false};
  const auto measure = [&](std::uint32_t face) {
    const FaceSeparation<T> found = measure_face(own, face, other, offset);
    if (found.separation > best.separation) best = found;
    return found.vertex;
  };
  while (!points.full()) {
    const Extreme<T> bound = highest_above(own, points);
    if (!(bound.value > best.separation)) return best;
    const std::uint32_t vertex = measure(bound.index);
    if (points.contains(vertex)) return best;
    points.add(vertex, other.vertices()[vertex] + offset);
  }
  for (std::uint32_t f = 0; f < own.normals().size(); ++f) measure(f);
  return best;
}

}  // namespace moreau::detail
