// SPDX-License-Identifier: MIT
// Contacts that are carried along (Tolerances::carry). The contact of two polyhedra that have hardly moved relative to each
// other since it was detected is not detected again: its points stay where they are in the bodies. The gap of a point is
// then the distance, along the normal, of the two places on the surfaces that were opposite each other.
//
// Let the pair have moved by m: the displacement of b in the axes of a, plus the largest displacement of a point of b by
// the rotation relative to a. The normal stays in the axes of a. It is wrong by an angle of at most m / R, R being the
// radius of b, and a gap by at most m times this angle; a corner of the contact polygon is wrong by m across the normal.
// Errors do not add up: m counts from the last detection. Points within Tolerances::resolution of the segment between two
// others are left out, so that boxes that lie on each other have four points and not up to six.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/space.hpp"
#include "moreau/detect/manifold.hpp"

namespace moreau::detail {

/// The contact of a pair in the axes of its bodies, as it was detected.
template <class S>
class CarriedContact {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;
  static constexpr std::size_t most = 8;  ///< contacts with more points are detected in every step

  /// The present pose of b relative to a, in the axes of a.
  struct Placing {
    Matrix axes_a;              ///< from the axes of a to those of the world
    Matrix turn;                ///< from the axes of b to those of a
    Vector center_a, center_b;  ///< world axes [m]
    Vector apart;               ///< from a to b, axes of a [m]
    Placing(const Vector& a, const typename S::Rotation& rotation_a, const Vector& b,
            const typename S::Rotation& rotation_b)
        : axes_a(rotation_a.toRotationMatrix()),
          center_a(a),
          center_b(b),
          apart(transposed_product(axes_a, b - a)) {
      const Matrix axes_b = rotation_b.toRotationMatrix();
      for (int k = 0; k < S::dim; ++k) turn.col(k) = transposed_product(axes_a, axes_b.col(k));
    }
  };

  /// Stores a contact.
  /// @param margin up to which its points are known [m]
  void store(const Placing& now, const Manifold<S>& found, Scalar margin) {
    count_ = 0;
    if (found.points.size() > most) return;
    turn_ = now.turn;
    apart_ = now.apart;
    margin_ = margin;
    contact_class_ = found.contact_class;
    normal_ = transposed_product(now.axes_a, found.normal);
    for (const ManifoldPoint<S>& point : found.points) {
      const Vector middle = transposed_product(now.axes_a, Vector(point.position - now.center_a));
      const Vector half = point.gap / 2 * normal_;
      points_[count_++] = {middle - half,
                           transposed_product(now.turn, Vector(middle + half - now.apart)),
                           point.feature};
    }
  }
  /// Forgets the contact.
  void clear() { count_ = 0; }

  /// Whether the contact is known for this margin [m].
  /// @param radius of b [m]
  /// @param carry  largest relative motion [m]
  bool holds(const Placing& now, Scalar radius, Scalar margin, Scalar carry) const {
    if (count_ == 0) return false;
    // A rotation by an angle t differs from the identity by 2 sqrt(2) sin(t / 2), in the plane and in space.
    const Scalar moved =
        (now.apart - apart_).norm() + radius * std::sqrt(squared_distance(now.turn, turn_) / 2);
    return moved <= carry && margin + moved <= margin_;
  }
  /// Fills the manifold with the points whose gap is at most the margin [m]. holds() must be true.
  /// @param out normal, class and points; without points if the function returns false
  /// @returns whether there is a point
  bool write(const Placing& now, Scalar margin, Manifold<S>& out) const {
    out.start(product(now.axes_a, normal_), margin);
    out.contact_class = contact_class_;
    for (std::size_t k = 0; k < count_; ++k) {
      const Point& point = points_[k];
      const Vector on_b = now.apart + inlined_product(now.turn, point.on_b);
      const Scalar gap = normal_.dot(on_b - point.on_a);
      if (!(gap <= margin)) continue;
      out.gap = gap < out.gap ? gap : out.gap;
      const Vector middle = (point.on_a + on_b) / 2;
      out.points.push_back(
          {now.center_a + inlined_product(now.axes_a, middle), gap, point.feature});
    }
    return !out.points.empty();
  }

 private:
  friend struct moreau::SerializationAccess;
  auto serialized_members() {
    return std::tie(turn_, apart_, normal_, margin_, contact_class_, count_, points_);
  }
  void deserialized() const {
    require(count_ <= most, "CarriedContact", "count", count_, "must be at most 8");
  }

  struct Point {
    Vector on_a, on_b;  // axes of a, of b [m]
    FeatureKey feature;
  };
  Matrix turn_ = Matrix::Identity();  // at detection
  Vector apart_ = Vector::Zero(), normal_ = Vector::Zero();
  Scalar margin_ = 0;
  ContactClass contact_class_ = ContactClass::vertex_vertex;
  std::uint32_t count_ = 0;
  std::array<Point, most> points_{};
};

}  // namespace moreau::detail
