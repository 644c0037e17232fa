// SPDX-License-Identifier: MIT
// From poses to contacts: place the shapes, find the pairs (kept over steps within a skin), collide
// each pair, write its points down. Every buffer is kept; nothing is allocated once they have
// grown.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/detect/broad_phase.hpp"
#include "moreau/detect/collide.hpp"
#include "moreau/detect/reduce.hpp"
#include "moreau/detect/sweep_and_prune.hpp"
#include "moreau/law/materials.hpp"
#include "moreau/shape/half_space.hpp"

namespace moreau {

/// The alert distance and the skin, in metres.
template <class T>
struct DetectionLengths {
  T margin;      ///< contacts enter at this gap
  T skin;        ///< the pair list outlives motions of this size
  T resolution;  ///< contact points closer together than this are one
};

/// Which points of a contact between two faces are kept.
enum class ContactPoints {
  few,  ///< 1, 2 or 3 of them (2D: 2), as in the paper: fewer unknowns per step
  all,  ///< the whole polygon of contact: any pressure on it can be carried, blocks stand exactly
};

template <class ShapeT, class BroadPhaseT>
class ContactDetector {
 public:
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;

  void add_grain(BodyId body, const ShapeT& shape) {
    grains_.push_back({body, Placed<ShapeT>(shape)});
    stale_ = true;
  }
  void add_wall(BodyId body, const HalfSpace<S>& shape) {
    walls_.push_back({body, shape, Placed<HalfSpace<S>>(shape)});
  }

  /// Refreshes the world-frame shapes and their boxes.
  /// @param shape_of shape of grain k, in the order they were added
  template <class ShapeOf>
  void place(std::span<const Pose<S>> poses, ShapeOf&& shape_of) {
    boxes_.resize(grains_.size());
    for (std::size_t k = 0; k < grains_.size(); ++k) {
      const Pose<S>& pose = poses[grains_[k].body.index()];
      grains_[k].placed.update(shape_of(k), pose);
      boxes_[k] = grains_[k].placed.bounding_box();
    }
    for (Wall& wall : walls_) wall.placed.update(wall.shape, poses[wall.body.index()]);
  }

  void keep_points(ContactPoints points) { kept_points_ = points; }

  /// Pairs whose boxes come within the margin, sorted; recomputed only when a box has left its
  /// skin.
  void find_pairs(const DetectionLengths<Scalar>& lengths) {
    const Scalar reach = lengths.margin / 2;
    bool left = stale_ || fat_.size() != boxes_.size();
    for (std::size_t k = 0; k < boxes_.size() && !left; ++k)
      left = !fat_[k].contains(boxes_[k].inflated(reach));
    if (!left) return;
    stale_ = false;
    fat_.resize(boxes_.size());
    for (std::size_t k = 0; k < boxes_.size(); ++k)
      fat_[k] = boxes_[k].inflated(reach + lengths.skin);
    old_pairs_.swap(pairs_);
    old_caches_.swap(caches_);
    broad_phase_.find_pairs(std::span<const Aabb<S>>(fat_), pairs_);
    carry_caches();
  }

  /// Contact points of all pairs, sorted by (a, b, feature), with zero impulse.
  /// @param previous contacts of the step before, sorted alike: the memory of the choice of points
  template <class Law>
  void detect(const DetectionLengths<Scalar>& lengths, std::span<const Pose<S>> poses,
              std::span<const MaterialId> materials, const Materials<Law>& laws,
              const Contacts<S>& previous, Contacts<S>& out) {
    out.clear();
    touching_ = 0;
    reduction_.resolution = static_cast<double>(lengths.resolution);
    std::size_t p = 0;
    for (std::size_t k = 0; k < grains_.size(); ++k) {
      const auto& a = grains_[k];
      const Aabb<S> reach = boxes_[k].inflated(lengths.margin);
      for (; p < pairs_.size() && pairs_[p].first == k; ++p) {
        const auto& b = grains_[pairs_[p].second];
        if (!reach.overlaps(boxes_[pairs_[p].second])) continue;
        if (collide(a.placed, b.placed, lengths.margin, manifold_, caches_[p]))
          emit(a.body, b.body, poses, materials, laws, previous, out);
      }
      for (const Wall& wall : walls_) {
        if (!reaches(boxes_[k], wall.placed, lengths.margin)) continue;
        PairCache<S> none;
        if (collide(a.placed, wall.placed, lengths.margin, manifold_, none))
          emit(a.body, wall.body, poses, materials, laws, previous, out);
      }
    }
    sort(out);
  }

  std::size_t pair_count() const { return pairs_.size(); }
  /// Pairs with at least one contact point in the last detect().
  std::size_t touching_count() const { return touching_; }

 private:
  struct Grain {
    BodyId body;
    Placed<ShapeT> placed;
  };
  struct Wall {
    BodyId body;
    HalfSpace<S> shape;
    Placed<HalfSpace<S>> placed;
  };

  static bool reaches(const Aabb<S>& box, const Placed<HalfSpace<S>>& wall, Scalar margin) {
    const typename S::Vector center = (box.lower + box.upper) / 2 - wall.center();
    const typename S::Vector half = (box.upper - box.lower) / 2;
    return wall.normal().dot(center) - wall.normal().cwiseAbs().dot(half) <= margin;
  }

  /// Pairs that stay keep what their cache knows. Both lists are sorted.
  void carry_caches() {
    caches_.assign(pairs_.size(), PairCache<S>{});
    for (std::size_t i = 0, j = 0; i < pairs_.size() && j < old_pairs_.size();) {
      if (pairs_[i] < old_pairs_[j]) {
        ++i;
      } else if (old_pairs_[j] < pairs_[i]) {
        ++j;
      } else {
        caches_[i++] = old_caches_[j++];
      }
    }
  }

  template <class Law>
  void emit(BodyId a, BodyId b, std::span<const Pose<S>> poses,
            std::span<const MaterialId> materials, const Materials<Law>& laws,
            const Contacts<S>& previous, Contacts<S>& out) {
    ++touching_;
    keep_few(a.value, b.value, previous);
    const typename S::Matrix frame = S::contact_frame(manifold_.normal);
    const auto law =
        static_cast<std::uint32_t>(laws.law_index(materials[a.index()], materials[b.index()]));
    for (const ManifoldPoint<S>& point : manifold_.points) {
      out.points.push_back({a.value, b.value, law, point.gap, frame,
                            point.position - poses[a.index()].position,
                            point.position - poses[b.index()].position});
      out.keys.push_back({a.value, b.value, point.feature});
      out.classes.push_back(manifold_.contact_class);
    }
  }

  /// At most as many points as there are dimensions, the same as the step before where they do.
  void keep_few(std::uint32_t a, std::uint32_t b, const Contacts<S>& previous) {
    if (kept_points_ == ContactPoints::all) return;
    kept_.clear();
    if (manifold_.points.size() > S::dim) {
      const ContactKey from{a, b, FeatureKey()};
      for (auto key = std::lower_bound(previous.keys.begin(), previous.keys.end(), from);
           key != previous.keys.end() && key->a == a && key->b == b; ++key)
        kept_.push_back(key->feature);
    }
    reduce(manifold_, S::dim, std::span<const FeatureKey>(kept_), reduction_);
  }

  /// Walls may carry lower ids than grains that came later; the order of the keys must not care.
  void sort(Contacts<S>& out) {
    out.impulses.assign(out.size(), S::Vector::Zero());
    if (std::is_sorted(out.keys.begin(), out.keys.end())) return;
    order_.resize(out.size());
    for (std::size_t c = 0; c < order_.size(); ++c) order_[c] = static_cast<std::uint32_t>(c);
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t i, std::uint32_t j) { return out.keys[i] < out.keys[j]; });
    scratch_.clear();
    for (const std::uint32_t c : order_) {
      scratch_.points.push_back(out.points[c]);
      scratch_.keys.push_back(out.keys[c]);
      scratch_.classes.push_back(out.classes[c]);
    }
    std::swap(out.points, scratch_.points);
    std::swap(out.keys, scratch_.keys);
    std::swap(out.classes, scratch_.classes);
  }

  std::vector<Grain> grains_;
  std::vector<Wall> walls_;
  std::vector<Aabb<S>> boxes_, fat_;
  BroadPhaseT broad_phase_;
  std::vector<IndexPair> pairs_, old_pairs_;
  std::vector<PairCache<S>> caches_, old_caches_;
  Manifold<S> manifold_;
  ContactPoints kept_points_ = ContactPoints::few;
  Reduction reduction_;
  std::vector<FeatureKey> kept_;
  Contacts<S> scratch_;
  std::vector<std::uint32_t> order_;
  std::size_t touching_ = 0;
  bool stale_ = true;
};

}  // namespace moreau
