// SPDX-License-Identifier: MIT
// The contacts of one step, as the mechanics needs them.
//
// Conventions: the frame's first column is the normal, a unit vector from body a to body b in world
// axes. Relative velocity u = F^T (v_b + lever(r_b) w_b - v_a - lever(r_a) w_a), so u_n > 0
// separates; the impulse r is what b receives, in the frame, so r_n > 0 pushes; a receives -F r.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "moreau/core/space.hpp"
#include "moreau/detect/manifold.hpp"

namespace moreau {

/// What the solver reads of one contact point. Across a periodic boundary, the centre of b is that
/// of the image which touches.
template <class S>
struct Contact {
  std::uint32_t a;             ///< the one body, BodyId::index()
  std::uint32_t b;             ///< the other
  std::uint32_t law;           ///< index into the table of laws, Materials::laws()
  typename S::Scalar gap;      ///< along the normal [m], < 0 is penetration
  typename S::Matrix frame;    ///< columns n (unit, from a to b), t[, s]; right-handed, world axes
  typename S::Vector lever_a;  ///< from the centre of a to the contact point, world axes [m]
  typename S::Vector lever_b;  ///< from the centre of b to the contact point, world axes [m]
};

/// What makes a contact point the same one in the next step.
struct ContactKey {
  std::uint32_t a;     ///< the one body
  std::uint32_t b;     ///< the other
  FeatureKey feature;  ///< of the pair that makes the point
  friend constexpr auto operator<=>(const ContactKey&, const ContactKey&) = default;
};

/// The contacts of one step, arrays in one order, sorted by (a, b, feature).
template <class S>
struct Contacts {
  std::vector<Contact<S>> points;     ///< with their geometry
  std::vector<ContactKey> keys;       ///< one per point
  std::vector<ContactClass> classes;  ///< of the pair, one per point
  /// What b receives, in the contact frame, normal first, > 0 pushes [N s]; one per point.
  std::vector<typename S::Vector> impulses;
  /// Of rolling and twisting resistance, on b, in the contact frame [N m s]; one per point, or
  /// empty without.
  std::vector<typename S::Angular> couples;

  std::size_t size() const { return points.size(); }  ///< number of points
  /// Whether all arrays are as long (couples may be empty), and all contacts between so many bodies
  /// and of so many laws.
  bool are_valid(std::size_t bodies, std::size_t laws) const {
    if (keys.size() != size() || classes.size() != size() || impulses.size() != size() ||
        (!couples.empty() && couples.size() != size()))
      return false;
    return std::all_of(points.begin(), points.end(), [&](const Contact<S>& point) {
      return point.a < bodies && point.b < bodies && point.law < laws;
    });
  }
  /// Sum of the impulses that a body received, world axes [N s].
  typename S::Vector impulse_on(std::uint32_t body) const {
    typename S::Vector sum = S::Vector::Zero();
    for (std::size_t c = 0; c < size(); ++c) {
      const Contact<S>& point = points[c];
      if (point.a != body && point.b != body) continue;
      const typename S::Vector impulse = point.frame * impulses[c];
      sum += point.b == body ? impulse : typename S::Vector(-impulse);
    }
    return sum;
  }
  /// Takes out all points; keeps the memory.
  void clear() {
    points.clear();
    keys.clear();
    classes.clear();
    impulses.clear();
    couples.clear();
  }
};

}  // namespace moreau
