// SPDX-License-Identifier: MIT
// Random concave grains similar to railway ballast, as compounds of four polyhedra, in the plane of
// four polygons.
//
//   1. Draw a convex stone (ballast.hpp), and three directions with at least 97 degrees between any two.
//   2. Cut a cap off the stone in each direction, at 0.62 to 0.72 of the distance of its farthest point.
//      The rest of the stone is the first part.
//   3. Replace each cap by the pyramid between the cut and the farthest point of the cap. The faces of
//      the pyramid meet those of the stone around it in concave edges.
//   4. Accept the grain if no cut touches another.
//
// The pyramids lie in the caps, so the parts have common faces and do not overlap. A grain has about 0.9
// of the volume of its convex hull. As convex ballast it is scaled to a circumradius of 1.
#pragma once

#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include "moreau/sample/ballast.hpp"
#include "moreau/shape/compound.hpp"

namespace moreau {

namespace detail {

/// A convex stone that is cut by planes, by its corners.
template <class Part>
class CutStone {
 public:
  using S = SpaceOf<Part>;
  using Vector = typename S::Vector;
  using Scalar = typename S::Scalar;

  explicit CutStone(const Part& stone) {
    for (Eigen::Index i = 0; i < stone.vertices().rows(); ++i)
      corners_.push_back(stone.vertices().row(i).transpose());
  }

  /// Replaces the cap beyond a plane by a pyramid. The plane has the normal `direction`; its distance
  /// from the origin is `share` times that of the farthest corner.
  void cut(const Vector& direction, Scalar share) {
    const Vector* top = &corners_[0];
    for (const Vector& x : corners_)
      if (x.dot(direction) > top->dot(direction)) top = &x;
    const Scalar height = share * top->dot(direction);
    std::vector<Vector> left, rim;
    for (const Vector& x : corners_) {
      if (x.dot(direction) < height) left.push_back(x);
      for (const Vector& y : corners_) {
        const Scalar below = height - x.dot(direction), above = y.dot(direction) - height;
        if (below > 0 && above > 0) rim.push_back(x + below / (below + above) * (y - x));
      }
    }
    rims_.push_back(rim);
    planes_.push_back({direction, height});
    rim.push_back(*top);
    pyramids_.push_back(rim);
    rim.pop_back();
    left.insert(left.end(), rim.begin(), rim.end());
    corners_ = left;
  }
  /// Whether each cut lies behind all other planes.
  bool cuts_are_apart() const {
    for (std::size_t i = 0; i < planes_.size(); ++i)
      for (std::size_t j = 0; j < rims_.size(); ++j)
        for (const Vector& x : rims_[j])
          if (i != j && x.dot(planes_[i].normal) >= planes_[i].height) return false;
    return true;
  }
  /// The rest of the stone, and the pyramids.
  std::vector<Part> parts() const {
    std::vector<Part> parts{Part(std::span<const Vector>(corners_))};
    for (const auto& corners : pyramids_) parts.emplace_back(std::span<const Vector>(corners));
    return parts;
  }

 private:
  struct Plane {
    Vector normal;
    Scalar height;
  };
  std::vector<Vector> corners_;  // of what is left; some lie inside it
  std::vector<std::vector<Vector>> rims_, pyramids_;
  std::vector<Plane> planes_;
};

}  // namespace detail

/// Concave grains of four convex parts, as described at the top of this file.
template <class Part>
requires Polytope<Part> && BallastShape<Part>
struct Ballast<Compound<Part>> {
  /// A grain with the circumradius 1.
  static Compound<Part> draw(std::mt19937_64& random) {
    for (;;) {
      const Part stone = Ballast<Part>::draw(random);
      for (int trial = 0; trial < 100; ++trial) {
        const std::vector<Part> parts = cut(stone, random);
        if (parts.empty()) continue;
        const Compound<Part> grain{std::span<const Part>(parts)};
        return grain.scaled(1 / grain.circumradius());
      }
    }
  }

 private:
  /// Nothing if the cuts touch.
  static std::vector<Part> cut(const Part& stone, std::mt19937_64& random) {
    using S = SpaceOf<Part>;
    using Scalar = typename S::Scalar;
    constexpr std::size_t peaks = 3;
    constexpr double spacing = 1.5;  // 2 sin(97 degrees / 2)
    const auto directions = detail::spaced_directions<S::dim>(peaks, spacing, random);
    if (directions.size() < peaks) return {};
    detail::CutStone<Part> cuts(stone);
    for (const auto& direction : directions)
      cuts.cut(direction.template cast<Scalar>(), Scalar(detail::uniform(0.62, 0.72, random)));
    return cuts.cuts_are_apart() ? cuts.parts() : std::vector<Part>();
  }
};

}  // namespace moreau
