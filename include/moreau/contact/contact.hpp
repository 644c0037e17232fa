// SPDX-License-Identifier: MIT
// The contacts of one step.
//
// Conventions: the first column of the frame F is the normal, a unit vector from body a to body b
// in world axes. With the levers l_a, l_b from the centres of mass to the contact point, the
// relative velocity is u = F^T (v_b + lever(l_b) w_b - v_a - lever(l_a) w_a): u_n > 0 separates.
// The impulse r acts on b, in the frame: r_n > 0 pushes. Body a receives -F r. Under a law with couples, r has A
// more entries: the couple on b, in the angular frame.
//
// Detection writes a Contact, assign_laws() its law; from then on it stays as it is. The contact problem has tangents of
// its own (BodyDelassus::frame()): its solution is turned back into the frames of the contacts when it is stored. The gaps
// for which the problem is solved are those of the contacts with what the overlap correction has changed
// (OverlapCorrection::gap_change()).
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>

#include "moreau/core/double_sum.hpp"
#include "moreau/core/erase_at.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/space.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/core/value.hpp"
#include "moreau/detect/manifold.hpp"

namespace moreau {

/// One contact point. Across a periodic boundary, the centre of b is that of its touching image.
template <class S>
struct Contact {
  std::uint32_t a;             ///< first body, BodyId::index()
  std::uint32_t b;             ///< second body
  std::uint32_t law;           ///< index into the table of laws, Materials::laws()
  typename S::Scalar gap;      ///< along the normal at the detection configuration [m], < 0 is
                               ///< penetration
  typename S::Matrix frame;    ///< columns n (unit, from a to b), t[, s]; right-handed, world axes
  typename S::Vector lever_a;  ///< from the centre of a to the contact point, world axes [m]
  typename S::Vector lever_b;  ///< from the centre of b to the contact point, world axes [m]
};

/// Identifies a contact point from step to step. Keys are ordered by the bodies, then by their parts,
/// then by the features.
struct ContactKey {
  std::uint32_t a;           ///< first body, BodyId::index()
  std::uint32_t b;           ///< second body
  FeatureKey feature;        ///< pair of features of the parts at the point
  std::uint32_t part_a = 0;  ///< part of a that touches (Compound::parts()); 0 for a convex shape
  std::uint32_t part_b = 0;  ///< part of b that touches

  friend constexpr bool operator==(const ContactKey&, const ContactKey&) = default;
  friend constexpr std::strong_ordering operator<=>(const ContactKey& l, const ContactKey& r) {
    if (const auto order = l.a <=> r.a; order != 0) return order;
    if (const auto order = l.b <=> r.b; order != 0) return order;
    if (const auto order = l.part_a <=> r.part_a; order != 0) return order;
    if (const auto order = l.part_b <=> r.part_b; order != 0) return order;
    return l.feature <=> r.feature;
  }
  /// The pair (a, b).
  constexpr std::pair<std::uint32_t, std::uint32_t> bodies() const { return {a, b}; }
  /// Whether the key is of the same parts of the same bodies.
  constexpr bool is_of_parts_of(const ContactKey& other) const {
    return a == other.a && b == other.b && part_a == other.part_a && part_b == other.part_b;
  }
};

/// The contacts that detection finds in a step: arrays with one entry per point, sorted by (a, b, parts, feature).
template <class S>
struct DetectedContacts {
  List<Contact<S>> points;     ///< geometry and law
  List<ContactKey> keys;       ///< one per point
  List<ContactClass> classes;  ///< class of the pair, one per point

  std::size_t size() const { return points.size(); }  ///< number of points
  /// Removes points; keeps the order of the others, and the memory.
  /// @param is_gone function: index before the removal -> whether the point is removed
  void erase(const auto& is_gone) {
    erase_at(points, is_gone);
    erase_at(keys, is_gone);
    erase_at(classes, is_gone);
  }
  /// Removes all points; keeps the memory.
  void clear() {
    points.clear();
    keys.clear();
    classes.clear();
  }
};

/// The contacts of a step with their impulses and the memory of their laws.
/// @tparam Rows entries of an impulse: D, or D + A under a law with couples
template <class S, int Rows = S::dim>
struct Contacts : DetectedContacts<S> {
  static_assert(Rows == S::dim || Rows == S::dofs);
  /// Whether the law has couples.
  static constexpr bool has_couples = Rows > S::dim;
  /// Impulse on b [N s], in the contact frame, normal first, > 0 pushes; then, if has_couples, the couple of rolling and
  /// twisting resistance on b [N m s], in the angular frame.
  using Impulse = Eigen::Matrix<typename S::Scalar, Rows, 1>;

  /// One per point; zero from detection until the contact problem is solved.
  List<Impulse> impulses;
  /// One per point: index of the law's variant, see StatefulLaw; the step ends by choosing that of the next step.
  List<std::uint32_t> variants;

  using DetectedContacts<S>::size;
  using DetectedContacts<S>::points;
  /// Impulse on b without the couple, in the contact frame, normal first, > 0 pushes [N s].
  decltype(auto) impulse(std::size_t c) const {
    if constexpr (has_couples)
      return typename S::Vector(linear<S>(impulses[c]));
    else
      return (impulses[c]);
  }
  /// Couple on b, in the angular frame [N m s]; 0 of a law without couples.
  typename S::Angular couple(std::size_t c) const {
    if constexpr (has_couples)
      return angular<S>(impulses[c]);
    else
      return S::Angular::Zero();
  }
  /// Whether all arrays have one size, and bodies, laws and variants are below these numbers.
  bool are_valid(std::size_t bodies, std::size_t laws, std::size_t variant_count) const {
    if (this->keys.size() != size() || this->classes.size() != size() ||
        impulses.size() != size() || variants.size() != size())
      return false;
    return std::all_of(points.begin(), points.end(),
                       [&](const Contact<S>& point) {
                         return point.a < bodies && point.b < bodies && point.law < laws;
                       }) &&
           std::all_of(variants.begin(), variants.end(),
                       [&](std::uint32_t k) { return k < variant_count; });
  }
  /// Sum of the impulses that a body received, world axes [N s].
  Value<typename S::Vector> impulse_on(std::uint32_t body) const {
    detail::DoubleSum<typename S::Vector> sum;
    for (std::size_t c = 0; c < size(); ++c) {
      const Contact<S>& point = points[c];
      if (point.a != body && point.b != body) continue;
      const typename S::Vector impulse = point.frame * this->impulse(c);
      sum += point.b == body ? impulse : typename S::Vector(-impulse);
    }
    return sum.value();
  }
  /// Removes points, as DetectedContacts::erase(), with their impulses and variants.
  void erase(const auto& is_gone) {
    DetectedContacts<S>::erase(is_gone);
    erase_at(impulses, is_gone);
    erase_at(variants, is_gone);
  }
  /// Removes all points; keeps the memory.
  void clear() {
    DetectedContacts<S>::clear();
    impulses.clear();
    variants.clear();
  }
  /// All arrays, see core/serialize.hpp.
  auto serialized_members() {
    return std::tie(points, this->keys, this->classes, impulses, variants);
  }
};

namespace detail {

/// The first contact of the pair of bodies of contact c.
template <class S>
std::size_t first_of_pair(const DetectedContacts<S>& contacts, std::size_t c) {
  while (c > 0 && contacts.keys[c - 1].bodies() == contacts.keys[c].bodies()) --c;
  return c;
}
/// One past the last contact of the pair of bodies of contact `first`.
template <class S>
std::size_t end_of_pair(const DetectedContacts<S>& contacts, std::size_t first) {
  std::size_t last = first + 1;
  while (last < contacts.size() && contacts.keys[last].bodies() == contacts.keys[first].bodies())
    ++last;
  return last;
}

}  // namespace detail

}  // namespace moreau
