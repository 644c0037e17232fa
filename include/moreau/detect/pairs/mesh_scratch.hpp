// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pairs/mesh_neighbours.hpp"

namespace moreau {

namespace detail {

/// The contacts of a shape with a mesh wall that were found so far: the features of the wall join, and
/// where two of them meet both can give the same contact.
class KnownContacts {
 public:
  /// A contact, relative to the centre of the shape, in the frame of the wall.
  template <class Vector>
  struct Contact {
    Vector x;         ///< the point of the shape [m]
    Vector to_shape;  ///< unit normal
    typename Vector::Scalar gap;
    FeatureKey feature;
    Vector on_wall() const { return x - gap * to_shape; }
  };

  void clear() { list_.clear(); }
  bool is_empty() const { return list_.empty(); }
  /// Whether a contact has a gap below a number [m].
  bool has_below(double gap) const {
    return std::any_of(list_.begin(), list_.end(), [&](const Stored& s) { return s.gap < gap; });
  }
  std::size_t size() const { return list_.size(); }
  template <class Vector>
  Contact<Vector> at(std::size_t i) const {
    const Stored& stored = list_[i];
    return {of<Vector>(stored.x), of<Vector>(stored.to_shape),
            static_cast<typename Vector::Scalar>(stored.gap), stored.feature};
  }
  /// Adds a contact, unless it is known: the points of the shape and of the wall are the same, and so
  /// is the normal.
  /// @param near points closer to each other are the same [m]
  template <class Vector, class T>
  void add(const Contact<Vector>& contact, T near) {
    const Vector on_wall = contact.on_wall();
    const T near2 = near * near;
    for (std::size_t i = 0; i < size(); ++i) {
      const auto other = at<Vector>(i);
      if ((other.x - contact.x).squaredNorm() <= near2 &&
          (other.to_shape - contact.to_shape).squaredNorm() <= T(4e-6) &&
          (other.on_wall() - on_wall).squaredNorm() <= near2)
        return;
    }
    add_new(contact);
  }
  /// Whether one of the first `count` contacts is at a point of the shape.
  template <class Vector>
  bool has(const Vector& x, std::size_t count) const {
    for (std::size_t i = 0; i < count; ++i)
      if (of<Vector>(list_[i].x) == x) return true;
    return false;
  }
  /// Adds a contact that need not be compared.
  template <class Vector>
  void add_new(const Contact<Vector>& contact) {
    Stored& stored = list_.emplace_back();
    for (int k = 0; k < contact.x.size(); ++k) {
      stored.x[std::size_t(k)] = contact.x[k];
      stored.to_shape[std::size_t(k)] = contact.to_shape[k];
    }
    stored.gap = contact.gap;
    stored.feature = contact.feature;
  }

  /// Whether a motion that ends the overlap of a shallower contact ends that of another contact, too.
  /// @param near  differences of gaps below it count as 0 [m]
  /// @param leads function of the shallower contact: whether its motion leads to the end of the overlap
  template <class Vector, class T, class Leads>
  bool frees(const Contact<Vector>& contact, T near, const Leads& leads) const {
    for (std::size_t i = 0; i < size(); ++i) {
      const auto other = at<Vector>(i);
      if (other.gap > contact.gap + near && leads(other)) return true;
    }
    return false;
  }

 private:
  struct Stored {
    std::array<double, 3> x = {}, to_shape = {};  // in the plane the last coordinate is not used
    double gap = 0;
    FeatureKey feature;
  };
  template <class Vector>
  static Vector of(const std::array<double, 3>& a) {
    Vector x;
    for (int k = 0; k < x.size(); ++k)
      x[k] = static_cast<typename Vector::Scalar>(a[std::size_t(k)]);
    return x;
  }

  std::vector<Stored> list_;
};

}  // namespace detail

/// Memory of collisions with mesh walls, used again from one to the next.
struct MeshScratch {
  std::vector<NearFacet> facets;      ///< of the present face
  std::vector<NearFacet> all;         ///< near the shape
  std::vector<std::uint32_t> ridges;  ///< convex ridges near the shape
  std::vector<std::uint32_t> low;     ///< vertices of the shape
  std::vector<std::uint32_t> passed;  ///< vertices that passed through a facet and do not touch it
  std::vector<std::pair<std::uint32_t, std::uint32_t>> tips;  ///< (vertex, facet)
  std::vector<std::size_t>
      pierced;  ///< places in `tips` of tips in the shape, without a contact there
  std::vector<std::size_t> pricked;  ///< the same for tips that are less deep in the shape
  detail::KnownContacts known;       ///< of the shape
};

}  // namespace moreau
