// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "moreau/shape/concepts.hpp"

namespace moreau::detail {

/// Which vertices of the parts of a grain lie in other parts of the grain. Where two parts have a
/// common face, the face and its edges are inside the grain: no other grain can touch them.
class Seams {
 public:
  /// A set of neighbours of a part, one bit each.
  using Set = std::uint64_t;

  /// Finds the vertices of each part that lie in another part, or outside by less than 1e-6 of its
  /// size (1e-4 in single precision). Of more than 64 neighbours of a part, 64 count.
  /// @param parts objects with a polytope as `shape` and a `pose`
  void find(const auto& parts) {
    neighbours_.assign(parts.size(), {});
    sets_.assign(parts.size(), {});
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto& vertices = parts[i].shape.vertices();
      sets_[i].assign(static_cast<std::size_t>(vertices.rows()), 0);
      for (std::size_t k = 0; k < parts.size() && neighbours_[i].size() < 64; ++k) {
        if (k == i) continue;
        Set any = 0;
        const Set bit = Set{1} << neighbours_[i].size();
        for (std::size_t v = 0; v < sets_[i].size(); ++v)
          if (holds(parts[k], parts[i].pose(vertices.row(Eigen::Index(v)).transpose())))
            any |= sets_[i][v] |= bit;
        if ((any & bit) != 0) neighbours_[i].push_back(static_cast<std::uint32_t>(k));
      }
    }
  }
  /// The neighbours of a part that contain one of its vertices.
  Set neighbours_at(std::size_t part, std::size_t vertex) const { return sets_[part][vertex]; }
  /// The part that a bit of a set of neighbours of `part` stands for.
  std::uint32_t neighbour(std::size_t part, std::size_t bit) const {
    return neighbours_[part][bit];
  }

 private:
  template <class Part>
  static bool holds(const Part& part, const auto& point) {
    using T = typename decltype(part.pose)::Vector::Scalar;
    constexpr T near = std::numeric_limits<T>::epsilon() > T(1e-9) ? T(1e-4) : T(1e-6);
    const auto body = part.pose.to_body(point);
    // In one expression, which refers to temporaries.
    const T height =
        ((part.shape.face_normals() * body).array() - part.shape.face_offsets()).maxCoeff();
    return height <= near * part.shape.circumradius();
  }

  std::vector<std::vector<std::uint32_t>> neighbours_;  // of each part
  std::vector<std::vector<Set>> sets_;                  // of each vertex of each part
};

}  // namespace moreau::detail
