// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "moreau/detect/pairs/mesh_neighbours.hpp"

namespace moreau {

namespace detail {

/// The contacts of a shape with a mesh wall that were found so far: the features of the wall join, and
/// where two of them meet both can give the same contact.
class KnownContacts {
 public:
  void clear() { list_.clear(); }
  bool is_empty() const { return list_.empty(); }
  /// Adds a contact, unless it is known: the points of the shape and of the wall are the same, and so
  /// is the normal.
  /// @param x        the point of the shape [m]
  /// @param to_shape normal
  /// @param near     points closer to each other are the same [m]
  /// @returns whether it was added
  template <class Vector, class T>
  bool add(const Vector& x, const Vector& to_shape, T gap, T near) {
    const Vector on_wall = x - gap * to_shape;
    const T near2 = near * near;
    for (const Contact& other : list_) {
      const Vector y = of<Vector>(other.x), normal = of<Vector>(other.to_shape);
      if ((y - x).squaredNorm() <= near2 && (normal - to_shape).squaredNorm() <= T(4e-6) &&
          (y - T(other.gap) * normal - on_wall).squaredNorm() <= near2)
        return false;
    }
    add_new(x, to_shape, gap);
    return true;
  }
  /// Adds a contact that need not be compared.
  template <class Vector, class T>
  void add_new(const Vector& x, const Vector& to_shape, T gap) {
    Contact& contact = list_.emplace_back();
    for (int k = 0; k < x.size(); ++k) {
      contact.x[std::size_t(k)] = x[k];
      contact.to_shape[std::size_t(k)] = to_shape[k];
    }
    contact.gap = gap;
  }

 private:
  struct Contact {
    std::array<double, 3> x = {}, to_shape = {};  // in the plane the last coordinate is not used
    double gap = 0;
  };
  template <class Vector>
  static Vector of(const std::array<double, 3>& a) {
    Vector x;
    for (int k = 0; k < x.size(); ++k)
      x[k] = static_cast<typename Vector::Scalar>(a[std::size_t(k)]);
    return x;
  }

  std::vector<Contact> list_;
};

}  // namespace detail

/// Memory of collisions with mesh walls, used again from one to the next.
struct MeshScratch {
  std::vector<NearFacet> facets;      ///< of the present face
  std::vector<NearFacet> all;         ///< near the shape, if not known before
  std::vector<std::uint32_t> ridges;  ///< convex ridges near the shape
  std::vector<std::uint32_t> low;     ///< vertices of the shape
  std::vector<std::pair<std::uint32_t, std::uint32_t>> tips;  ///< (vertex, facet)
  detail::KnownContacts known;                                ///< of the shape
};

}  // namespace moreau
