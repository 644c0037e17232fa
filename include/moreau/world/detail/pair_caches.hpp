// SPDX-License-Identifier: MIT
// The data that a detector keeps of the pairs of its list: a cache for each pair of convex grains, and for each
// pair of compound grains the list of their parts that are near, with a cache for each pair of parts.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "moreau/core/aabb.hpp"
#include "moreau/core/box_tree.hpp"
#include "moreau/core/erase_at.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/merge_join.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/detect/broad_phase.hpp"
#include "moreau/detect/carried_contact.hpp"
#include "moreau/detect/collide.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace moreau::detail {

/// Whether contacts of these shapes can be carried along. To detect those of polygons takes no longer.
template <class ShapeT>
inline constexpr bool can_carry = false;
template <std::floating_point T>
inline constexpr bool can_carry<Polyhedron<T>> = true;

/// The caches of pairs of convex grains.
template <class ShapeT>
class PairCaches {
 public:
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Rotation = typename S::Rotation;

  /// The list of pairs is new: pairs that are in both lists keep their cache. Both lists are sorted.
  /// The other arguments are for compound grains.
  void renew(const std::vector<IndexPair>& pairs, const std::vector<IndexPair>& old_pairs,
             const auto&, const auto&, Scalar) {
    old_.swap(caches_);
    caches_.assign(pairs.size(), PairCache<S>{});
    merge_join(pairs, old_pairs, [&](std::size_t i, std::size_t j) { caches_[i] = old_[j]; });
  }
  /// Sets whether contacts are carried along, after renew(). All are detected again.
  void set_carrying(bool carries) {
    if constexpr (can_carry<ShapeT>) {
      carried_.resize(carries ? caches_.size() : 0);
      for (CarriedContact<S>& contact : carried_) contact.clear();
    }
  }
  /// Whether the parts of grain k are where renew() left them. A convex grain has no parts.
  static constexpr bool holds(std::size_t, const auto&, Scalar) { return true; }
  /// The same in a cell that deforms.
  static constexpr bool holds(std::size_t, const auto&, Scalar, const auto&) { return true; }
  /// Erases the caches of pairs p with is_gone(p).
  void erase_pairs(const auto& is_gone) {
    erase_at(caches_, is_gone);
    if (!carried_.empty()) erase_at(carried_, is_gone);
  }
  /// Forgets grains k with is_gone(k).
  static void erase_grains(const auto&) {}
  /// Whether the caches, read from a file, are those of the pairs.
  bool are_valid(const std::vector<IndexPair>& pairs, const auto&, bool) const {
    return caches_.size() == pairs.size() && (carried_.empty() || carried_.size() == pairs.size());
  }

  /// Collides pair p.
  /// @param rotation_a,rotation_b of the bodies
  /// @param carry largest motion up to which its contact is carried along; 0: it is detected [m]
  /// @param resolution of the points of a contact that is carried along, see thin_out() [m]
  /// @param use   called if the pair is in contact, when `out` contains its points
  /// @returns whether it is
  bool collide_parts(std::size_t p, const Placed<ShapeT>& a, const Rotation& rotation_a,
                     const Placed<ShapeT>& b, const Rotation& rotation_b, Scalar margin,
                     Scalar carry, Scalar resolution, Manifold<S>& out, auto&& use) {
    const auto touch = [&] {
      if constexpr (can_carry<ShapeT>)
        if (carry > 0 && !carried_.empty())
          return carry_along(p, a, {a.center(), rotation_a, b.center(), rotation_b}, b, margin,
                             carry, resolution, out);
      return collide(a, b, margin, out, caches_[p]);
    };
    if (!touch()) return false;
    use();
    return true;
  }

 private:
  friend struct moreau::SerializationAccess;
  auto serialized_members() { return std::tie(caches_, carried_); }

  /// Collides pair p, or carries along the contact that it had.
  [[gnu::noinline]] bool carry_along(std::size_t p, const Placed<ShapeT>& a,
                                     const typename CarriedContact<S>::Placing& now,
                                     const Placed<ShapeT>& b, Scalar margin, Scalar carry,
                                     Scalar resolution,
                                     Manifold<S>& out) requires can_carry<ShapeT> {
    CarriedContact<S>& carried = carried_[p];
    if (p + 1 < carried_.size()) prefetch(&carried_[p + 1], sizeof(CarriedContact<S>));
    if (carried.holds(now, b.radius(), margin, carry)) return carried.write(now, margin, out);
    const Scalar known = margin + 2 * carry;
    carried.clear();
    if (!collide(a, b, known, out, caches_[p])) return false;
    thin_out(resolution, out);
    carried.store(now, out, known);
    erase_if(out.points, [&](const auto& point) { return !(point.gap <= margin); });
    return !out.points.empty();
  }

  /// Removes points that lie within the resolution of the segment between two others, one after the other: where faces
  /// touch, their gaps follow from those of the others. The edges of two faces that nearly coincide cross between their
  /// ends.
  static void thin_out(Scalar resolution, Manifold<S>& out) {
    constexpr std::size_t most = CarriedContact<S>::most;
    const std::size_t count = out.points.size();
    if (count <= 2 || count > most) return;
    std::array<bool, most> gone{};
    const auto is_between = [&](std::size_t k, std::size_t i, std::size_t j) {
      const auto &x = out.points[k].position, &from = out.points[i].position;
      const typename S::Vector along = out.points[j].position - from, to = x - from;
      const Scalar length2 = along.squaredNorm(), part = to.dot(along);
      if (!(part > 0 && part < length2)) return false;
      return to.squaredNorm() - part * part / length2 < resolution * resolution;
    };
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t i = 0; i < count && !gone[k]; ++i)
        for (std::size_t j = 0; j < i && !gone[k]; ++j)
          gone[k] = i != k && j != k && !gone[i] && !gone[j] && is_between(k, i, j);
    erase_at(out.points, [&](std::size_t k) { return gone[k]; });
  }

  List<PairCache<S>> caches_, old_;  // one per pair of the list
  List<CarriedContact<S>> carried_;  // the same; empty if none are carried along
};

/// The near parts and the caches of pairs of compound grains.
template <CompoundShape ShapeT>
class PairCaches<ShapeT> {
 public:
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Rotation = typename S::Rotation;

  static void set_carrying(bool) {}  ///< contacts of parts are detected in every step
  /// The list of pairs is new: lists the parts of each pair whose boxes are closer than twice `reach`,
  /// sorted. Pairs of parts that were listed before keep their cache.
  /// @param shifts of the second grain of each pair; empty in an open cell
  /// @param grains with their placed shapes
  /// @param reach  [m]
  void renew(const std::vector<IndexPair>& pairs, const std::vector<IndexPair>& old_pairs,
             const std::vector<Vector>& shifts, const auto& grains, Scalar reach) {
    inflate_boxes(grains, reach);
    plant_trees(pairs);
    old_parts_.swap(parts_);
    old_ends_.swap(ends_);
    old_.swap(caches_);
    parts_.clear();
    ends_.clear();
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      list_parts(pairs[p], shifts.empty() ? Vector(Vector::Zero()) : shifts[p]);
      ends_.push_back(parts_.size());
    }
    caches_.assign(parts_.size(), PairCache<S>{});
    merge_join(pairs, old_pairs, [&](std::size_t p, std::size_t q) {
      const std::size_t from = begin(ends_, p), old_from = begin(old_ends_, q);
      const std::span<const IndexPair> now(parts_.data() + from, ends_[p] - from);
      const std::span<const IndexPair> old(old_parts_.data() + old_from, old_ends_[q] - old_from);
      merge_join(now, old,
                 [&](std::size_t i, std::size_t j) { caches_[from + i] = old_[old_from + j]; });
    });
  }
  /// Whether the boxes of the parts of grain k, inflated by `reach` [m], lie in those that renew() was
  /// given.
  bool holds(std::size_t k, const Placed<ShapeT>& grain, Scalar reach) const {
    const std::size_t first = begin(box_ends_, k);
    for (std::size_t i = 0; i < grain.part_count(); ++i)
      if (!boxes_[first + i].contains(grain.box(i).inflated(reach))) return false;
    return true;
  }
  /// The same after the grain is moved back by a vector [m], world axes.
  bool holds(std::size_t k, const Placed<ShapeT>& grain, Scalar reach, const Vector& back) const {
    const std::size_t first = begin(box_ends_, k);
    for (std::size_t i = 0; i < grain.part_count(); ++i) {
      const Aabb<S> box = grain.box(i).inflated(reach);
      if (!boxes_[first + i].contains(box.moved(back))) return false;
    }
    return true;
  }
  /// Erases the caches of pairs p with is_gone(p).
  void erase_pairs(const auto& is_gone) {
    erase_lists(ends_, is_gone, [&](const auto& part_is_gone) {
      erase_at(parts_, part_is_gone);
      erase_at(caches_, part_is_gone);
    });
  }
  /// Forgets the boxes of grains k with is_gone(k).
  void erase_grains(const auto& is_gone) {
    erase_lists(box_ends_, is_gone,
                [&](const auto& part_is_gone) { erase_at(boxes_, part_is_gone); });
  }
  /// Whether lists and caches, read from a file, are those of the pairs.
  /// @param is_stale whether renew() comes before the next use
  bool are_valid(const std::vector<IndexPair>& pairs, const auto& grains, bool is_stale) const {
    if (caches_.size() != parts_.size() || !are_ends(ends_, pairs.size(), parts_.size()))
      return false;
    for (std::size_t p = 0; p < pairs.size(); ++p)
      for (std::size_t k = begin(ends_, p); k < ends_[p]; ++k)
        if (parts_[k].first >= grains[pairs[p].first].placed.part_count() ||
            parts_[k].second >= grains[pairs[p].second].placed.part_count())
          return false;
    if (is_stale) return true;
    if (!are_ends(box_ends_, grains.size(), boxes_.size())) return false;
    for (std::size_t k = 0; k < grains.size(); ++k)
      if (box_ends_[k] - begin(box_ends_, k) != grains[k].placed.part_count()) return false;
    return true;
  }

  /// Collides the near parts of pair p.
  /// @param use called for each pair of parts in contact, when `out` contains its points
  /// @returns whether there was one
  bool collide_parts(std::size_t p, const Placed<ShapeT>& a, const Rotation&,
                     const Placed<ShapeT>& b, const Rotation&, Scalar margin, Scalar, Scalar,
                     Manifold<S>& out, auto&& use) {
    bool touch = false;
    for (std::size_t k = begin(ends_, p); k < ends_[p]; ++k) {
      const auto [i, j] = parts_[k];
      if (!a.box(i).inflated(margin).overlaps(b.box(j)) ||
          !collide(a.part(i), b.part(j), margin, out, caches_[k]) ||
          (is_at_seam(a, i, b, j, caches_[k], out.normal) &&
           !collide_outside(a, i, b, j, margin, out)))
        continue;
      out.part_a = i;
      out.part_b = j;
      touch = true;
      use();
    }
    return touch;
  }

 private:
  friend struct moreau::SerializationAccess;
  auto serialized_members() { return std::tie(parts_, ends_, caches_, boxes_, box_ends_); }

  static std::size_t begin(const List<std::uint64_t>& ends, std::size_t list) {
    return list == 0 ? 0 : ends[list - 1];
  }
  static bool are_ends(const List<std::uint64_t>& ends, std::size_t lists, std::size_t items) {
    return ends.size() == lists && std::is_sorted(ends.begin(), ends.end()) &&
           (ends.empty() ? 0 : ends.back()) == items;
  }
  /// Erases lists of items.
  /// @param ends  one past the last item of each list
  /// @param erase is given a function: item -> whether it is erased
  void erase_lists(List<std::uint64_t>& ends, const auto& is_gone, const auto& erase) {
    gone_.clear();
    for (std::size_t list = 0; list < ends.size(); ++list)
      gone_.resize(ends[list], is_gone(list) ? 1 : 0);
    erase([&](std::size_t item) { return gone_[item] != 0; });
    std::uint64_t end = 0;
    for (std::size_t list = 0, from = 0; list < ends.size(); ++list) {
      const std::size_t to = ends[list];
      if (!is_gone(list)) end += to - from;
      from = to;
      ends[list] = end;
    }
    erase_at(ends, is_gone);
  }

  void inflate_boxes(const auto& grains, Scalar reach) {
    boxes_.clear();
    box_ends_.clear();
    for (const auto& grain : grains) {
      for (std::size_t k = 0; k < grain.placed.part_count(); ++k)
        boxes_.push_back(grain.placed.box(k).inflated(reach));
      box_ends_.push_back(boxes_.size());
    }
  }
  /// Makes trees over the boxes of grains with many parts and many pairs: without a tree each of these pairs tests all parts.
  void plant_trees(const std::vector<IndexPair>& pairs) {
    constexpr std::size_t many = 64;
    tree_of_.assign(box_ends_.size(), 0);
    for (const IndexPair& pair : pairs) ++tree_of_[pair.first], ++tree_of_[pair.second];
    std::uint32_t count = 0;
    for (std::size_t k = 0; k < tree_of_.size(); ++k) {
      const std::size_t from = begin(box_ends_, k), parts = box_ends_[k] - from;
      const bool has_tree = tree_of_[k] >= many && parts >= many;
      tree_of_[k] = has_tree ? ++count : 0;
      if (!has_tree) continue;
      if (trees_.size() < count) trees_.emplace_back();
      trees_[count - 1].rebuild(std::span<const Aabb<S>>(boxes_.data() + from, parts));
    }
  }
  /// Lists the near parts of a pair.
  void list_parts(const IndexPair& pair, const Vector& shift) {
    const std::size_t first = begin(box_ends_, pair.first), second = begin(box_ends_, pair.second);
    const std::size_t count_a = box_ends_[pair.first] - first,
                      count_b = box_ends_[pair.second] - second;
    const std::uint32_t of_a = tree_of_[pair.first], of_b = tree_of_[pair.second];
    if (of_a == 0 && of_b == 0) return compare_parts(pair, shift);
    const bool in_a = of_b == 0 || (of_a != 0 && count_a > count_b);
    const BoxTree<S>& tree = trees_[(in_a ? of_a : of_b) - 1];
    const std::size_t found = parts_.size();
    for (std::size_t k = 0; k < (in_a ? count_b : count_a); ++k) {
      const Aabb<S> box = in_a ? boxes_[second + k].moved(shift) : boxes_[first + k].moved(-shift);
      tree.query([&](const Aabb<S>& around) { return around.overlaps(box); },
                 [&](std::uint32_t place) {
                   const std::uint32_t part = tree.order()[place];
                   if (!boxes_[(in_a ? first : second) + part].overlaps(box)) return;
                   parts_.push_back(in_a ? IndexPair{part, std::uint32_t(k)}
                                         : IndexPair{std::uint32_t(k), part});
                 });
    }
    std::sort(parts_.begin() + std::ptrdiff_t(found), parts_.end());
  }
  /// Lists the near parts of a pair without a tree. Parts of a that are far from all of b cost one test each.
  void compare_parts(const IndexPair& pair, const Vector& shift) {
    const std::size_t first = begin(box_ends_, pair.first), second = begin(box_ends_, pair.second);
    Aabb<S> around;
    for (std::size_t j = second; j < box_ends_[pair.second]; ++j) {
      around.merge(boxes_[j].lower);
      around.merge(boxes_[j].upper);
    }
    for (std::size_t i = first; i < box_ends_[pair.first]; ++i) {
      const Aabb<S> box{boxes_[i].lower - shift, boxes_[i].upper - shift};
      if (!box.overlaps(around)) continue;
      for (std::size_t j = second; j < box_ends_[pair.second]; ++j)
        if (box.overlaps(boxes_[j]))
          parts_.push_back({std::uint32_t(i - first), std::uint32_t(j - second)});
    }
  }

  std::vector<IndexPair> parts_, old_parts_;  // near parts of all pairs, sorted for each pair
  List<std::uint64_t> ends_, old_ends_;       // of each pair: one past its last element of parts_
  List<PairCache<S>> caches_, old_;           // one per element of parts_
  List<Aabb<S>> boxes_;                       // of the parts of all grains, inflated
  List<std::uint64_t> box_ends_;              // of each grain: one past its last element of boxes_
  std::vector<BoxTree<S>> trees_;             // over boxes of grains
  List<std::uint32_t> tree_of_;               // of each grain: 1 + place of its tree, or 0
  List<unsigned char> gone_;
};

}  // namespace moreau::detail
