// SPDX-License-Identifier: MIT
// From poses to contacts: place the shapes, find the pairs (kept over steps within a skin), collide
// each pair, write its points down. Every buffer is kept; nothing is allocated once they have
// grown.
//
// In a periodic cell poses are never wrapped: each pair carries the whole cells that bring its
// second grain as it lies next to its first. As grains do not jump, these stay the same for as long
// as the list of pairs is kept.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/periodic_cell.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/detect/broad/periodic_images.hpp"
#include "moreau/detect/broad/sweep_and_prune.hpp"
#include "moreau/detect/broad_phase.hpp"
#include "moreau/detect/collide.hpp"
#include "moreau/detect/pairs/collide_cylinder_wall.hpp"
#include "moreau/detect/reduce.hpp"
#include "moreau/law/materials.hpp"
#include "moreau/shape/cylinder_wall.hpp"
#include "moreau/shape/half_space.hpp"

namespace moreau {

/// The alert distance and the other lengths of detection.
template <class T>
struct DetectionLengths {
  T margin;      ///< contacts enter at this gap, >= 0 [m]
  T skin;        ///< the pair list outlives motions of this size, >= 0 [m]
  T resolution;  ///< contact points closer together than this are one, >= 0 [m]
};

/// Which points of a contact between two faces are kept.
enum class ContactPoints {
  few,  ///< 1, 2 or 3 of them (2D: 2), as in the paper: fewer unknowns per step
  all,  ///< the whole polygon of contact: any pressure on it can be carried, blocks stand exactly
};

/// From where the bodies stand to their contacts: pairs, manifolds, the list of the step. What it
/// is given is not checked, but for the cell: Simulation does that. Arrays of bodies are
/// indexed by BodyId::index().
/// @tparam ShapeT      of the grains
/// @tparam BroadPhaseT a BroadPhase in its space
template <class ShapeT, class BroadPhaseT>
class ContactDetector {
 public:
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Takes up a grain; the shape must outlive the detector.
  void add_grain(BodyId body, const ShapeT& shape) {
    grains_.push_back({body, &shape, Placed<ShapeT>(shape)});
    widest_ = std::max(widest_, width(shape));
    stale_ = true;
  }
  /// Takes up a plane wall; the shape is copied, in body coordinates.
  void add_wall(BodyId body, const HalfSpace<S>& shape) {
    walls_.push_back({body, shape, Placed<HalfSpace<S>>(shape)});
  }
  /// Takes up a cylinder around the grains; the shape is copied, in body coordinates.
  void add_wall(BodyId body, const CylinderWall<S>& shape) {
    cylinders_.push_back({body, shape, Placed<CylinderWall<S>>(shape)});
  }
  /// Takes another cell; pairs are found anew. Walls are judged where place_walls() put them.
  /// @param function the public name the caller used
  /// @throws std::invalid_argument in the name of the function if the cell is too short for the
  ///         grains there are, or a wall bounds a periodic axis where it is placed
  void set_cell(const PeriodicCell<S>& cell, const DetectionLengths<Scalar>& lengths,
                const char* function) {
    cell.require_room(widest_ + around(lengths), function);
    for (const auto& wall : walls_) cell.require_along(wall.placed.normal(), function);
    for (const auto& wall : cylinders_) cell.require_around(wall.placed.axis(), function);
    cell_ = cell;
    shifts_.clear();
    stale_ = true;
  }
  const PeriodicCell<S>& cell() const { return cell_; }  ///< open unless set
  /// The width that the cell must have twice, at least, with a grain of this shape [m].
  Scalar room_of(const ShapeT& shape, const DetectionLengths<Scalar>& lengths) const {
    return std::max(widest_, width(shape)) + around(lengths);
  }

  /// Refreshes the world-frame shapes of grains and walls, and the boxes of grains.
  /// @param poses    one per body
  /// @param shape_of k -> shape of grain k, in the order they were added
  template <class ShapeOf>
  void place(std::span<const Pose<S>> poses, ShapeOf&& shape_of) {
    boxes_.resize(grains_.size());
    for (std::size_t k = 0; k < grains_.size(); ++k) {
      const Pose<S>& pose = poses[grains_[k].body.index()];
      grains_[k].shape = &shape_of(k);
      grains_[k].placed.update(*grains_[k].shape, pose);
      boxes_[k] = grains_[k].placed.bounding_box();
    }
    place_walls(poses);
  }
  /// Moves the walls to where their bodies are.
  /// @param poses one per body
  void place_walls(std::span<const Pose<S>> poses) {
    for (auto& wall : walls_) wall.placed.update(wall.shape, poses[wall.body.index()]);
    for (auto& wall : cylinders_) wall.placed.update(wall.shape, poses[wall.body.index()]);
  }

  /// Which points of a contact between faces act from the next detect() on.
  void keep_points(ContactPoints points) { kept_points_ = points; }

  /// Pairs of grains whose boxes come within the margin, sorted; recomputed only when a box has
  /// left its skin. After place().
  void find_pairs(const DetectionLengths<Scalar>& lengths);

  /// Contact points of all pairs with a gap up to the margin, sorted by (a, b, feature), with zero
  /// impulse. After find_pairs().
  /// @param poses     one per body, those that place() was given
  /// @param materials one per body
  /// @param laws      numbers the law of each pair of materials: Contact::law
  /// @param previous  contacts of the step before, sorted alike: the memory of the choice of points
  /// @param out       filled anew; frames, levers and gaps as Contact says
  void detect(const DetectionLengths<Scalar>& lengths, std::span<const Pose<S>> poses,
              std::span<const MaterialId> materials, const MaterialPairs& laws,
              const Contacts<S>& previous, Contacts<S>& out);

  /// Takes the bodies anew, once their shapes have been read from a file; the pairs stay.
  /// @param add_all adds grains and walls in the order in which they were added before
  /// @throws std::invalid_argument if the pairs are not of the grains there are then
  void rebuild(auto&& add_all) {
    const bool stale = stale_;
    grains_.clear();
    walls_.clear();
    cylinders_.clear();
    widest_ = 0;
    add_all();
    stale_ = stale;
    bool valid = caches_.size() == pairs_.size();
    valid = valid && shifts_.size() == (cell_.is_open() ? 0 : pairs_.size());
    for (const IndexPair& pair : pairs_)
      valid = valid && pair.first < pair.second && pair.second < grains_.size();
    require(valid, "ContactDetector", "pairs", pairs_.size(), "must be of grains there are");
  }

  std::size_t pair_count() const { return pairs_.size(); }  ///< of boxes, without the walls
  /// Pairs with at least one contact point in the last detect().
  std::size_t touching_count() const { return touching_; }

 private:
  friend struct SerializationAccess;
  auto serialized_members() {
    return std::tie(cell_, kept_points_, stale_, fat_, pairs_, shifts_, caches_);
  }

  struct Grain {
    BodyId body;
    const ShapeT* shape;
    Placed<ShapeT> placed;
  };
  template <class WallShape>
  struct Wall {
    BodyId body;
    WallShape shape;
    Placed<WallShape> placed;
  };

  /// Of a grain however it is turned [m].
  static Scalar width(const ShapeT& shape) {
    if constexpr (requires { shape.circumradius(); }) {
      return 2 * shape.circumradius();
    } else {
      const Aabb<S> box = shape.bounding_box(Pose<S>{});
      return 2 * box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()).norm();
    }
  }
  /// What find_pairs() keeps around a grain, on both sides together [m].
  static Scalar around(const DetectionLengths<Scalar>& lengths) {
    return lengths.margin + 2 * lengths.skin;
  }

  static Aabb<S> moved(const Aabb<S>& box, const Vector& shift) {
    return {box.lower + shift, box.upper + shift};
  }
  /// Where the grain's image is.
  static void place(Grain& grain, std::span<const Pose<S>> poses, const Vector& shift) {
    Pose<S> pose = poses[grain.body.index()];
    pose.position += shift;
    if constexpr (requires { grain.placed.move_to(pose.position); })
      grain.placed.move_to(pose.position);
    else
      grain.placed.update(*grain.shape, pose);
  }

  static bool reaches(const Aabb<S>& box, const Placed<HalfSpace<S>>& wall, Scalar margin) {
    const Vector center = (box.lower + box.upper) / 2 - wall.center();
    const Vector half = (box.upper - box.lower) / 2;
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

  void detect_in_cylinders(std::size_t k, Scalar margin, std::span<const MaterialId> materials,
                           const MaterialPairs& laws, Contacts<S>& out) {
    const Grain& a = grains_[k];
    for (const auto& wall : cylinders_) {
      if (!wall.placed.reaches(boxes_[k], margin)) continue;
      touching_ += collide_each(a.placed, wall.placed, margin, manifold_,
                                [&] { write(a, wall, materials, laws, out); });
    }
  }

  void emit(const Grain& a, const auto& b, std::span<const MaterialId> materials,
            const MaterialPairs& laws, const Contacts<S>& previous, Contacts<S>& out) {
    ++touching_;
    keep_few(a.body.value, b.body.value, previous);
    write(a, b, materials, laws, out);
  }

  /// The points of the manifold, seen from the centres of where the two are placed.
  void write(const Grain& a, const auto& b, std::span<const MaterialId> materials,
             const MaterialPairs& laws, Contacts<S>& out) {
    const typename S::Matrix frame = S::contact_frame(manifold_.normal);
    const auto law = static_cast<std::uint32_t>(
        laws.law_index(materials[a.body.index()], materials[b.body.index()]));
    for (const ManifoldPoint<S>& point : manifold_.points) {
      out.points.push_back({a.body.value, b.body.value, law, point.gap, frame,
                            point.position - a.placed.center(),
                            point.position - b.placed.center()});
      out.keys.push_back({a.body.value, b.body.value, point.feature});
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
           key != previous.keys.end() && key->a == a && key->b == b; ++key) {
        const auto& impulse = previous.impulses[std::size_t(key - previous.keys.begin())];
        kept_.push_back({key->feature, std::max(0.0, double(impulse[0]))});
      }
    }
    reduce(manifold_, S::dim, std::span<const KeptPoint>(kept_), reduction_);
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
  std::vector<Wall<HalfSpace<S>>> walls_;
  std::vector<Wall<CylinderWall<S>>> cylinders_;
  PeriodicCell<S> cell_;
  std::vector<Aabb<S>> boxes_, fat_;
  BroadPhaseT broad_phase_;
  PeriodicImages<S> images_;
  std::vector<IndexPair> pairs_, old_pairs_;
  std::vector<Vector> shifts_;  // of the second of each pair to the first; none in an open cell
  std::vector<PairCache<S>> caches_, old_caches_;
  Manifold<S> manifold_;
  ContactPoints kept_points_ = ContactPoints::few;
  Reduction reduction_;
  std::vector<KeptPoint> kept_;
  Contacts<S> scratch_;
  std::vector<std::uint32_t> order_;
  std::size_t touching_ = 0;
  Scalar widest_ = 0;  // of the grains, however they turn [m]
  bool stale_ = true;
};

// Outside of the class: compiled once where a program declares the detector extern.
template <class ShapeT, class BroadPhaseT>
void ContactDetector<ShapeT, BroadPhaseT>::find_pairs(const DetectionLengths<Scalar>& lengths) {
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
  if (cell_.is_open())
    broad_phase_.find_pairs(std::span<const Aabb<S>>(fat_), pairs_);
  else
    images_.find_pairs(cell_, std::span<const Aabb<S>>(fat_), broad_phase_, pairs_, shifts_);
  carry_caches();
}

template <class ShapeT, class BroadPhaseT>
void ContactDetector<ShapeT, BroadPhaseT>::detect(const DetectionLengths<Scalar>& lengths,
                                                  std::span<const Pose<S>> poses,
                                                  std::span<const MaterialId> materials,
                                                  const MaterialPairs& laws,
                                                  const Contacts<S>& previous, Contacts<S>& out) {
  out.clear();
  touching_ = 0;
  reduction_.resolution = static_cast<double>(lengths.resolution);
  reduction_.shallower = reduction_.resolution / 10;
  reduction_.near = reduction_.resolution;
  std::size_t p = 0;
  for (std::size_t k = 0; k < grains_.size(); ++k) {
    const auto& a = grains_[k];
    const Aabb<S> reach = boxes_[k].inflated(lengths.margin);
    for (; p < pairs_.size() && pairs_[p].first == k; ++p) {
      const std::size_t second = pairs_[p].second;
      auto& b = grains_[second];
      const bool crosses = !shifts_.empty() && !shifts_[p].isZero(0);
      if (!(crosses ? reach.overlaps(moved(boxes_[second], shifts_[p]))
                    : reach.overlaps(boxes_[second])))
        continue;
      if (crosses) place(b, poses, shifts_[p]);
      if (collide(a.placed, b.placed, lengths.margin, manifold_, caches_[p]))
        emit(a, b, materials, laws, previous, out);
      if (crosses) place(b, poses, Vector::Zero());
    }
    for (const auto& wall : walls_) {
      if (!reaches(boxes_[k], wall.placed, lengths.margin)) continue;
      PairCache<S> none;
      if (collide(a.placed, wall.placed, lengths.margin, manifold_, none))
        emit(a, wall, materials, laws, previous, out);
    }
    if (!cylinders_.empty()) detect_in_cylinders(k, lengths.margin, materials, laws, out);
  }
  sort(out);
}

}  // namespace moreau
