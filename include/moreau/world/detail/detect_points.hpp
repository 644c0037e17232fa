// SPDX-License-Identifier: MIT
// The functions of ContactDetector that take most of its time: the list of grains, and their contact points.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/erase_at.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/detect/collide.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/world/contact_detector.hpp"
#include "moreau/world/detail/found_contacts.hpp"
#include "moreau/world/detail/step_margins.hpp"
#include "moreau/world/tolerances.hpp"

namespace moreau {

template <class ShapeT, class BroadPhaseT>
void ContactDetector<ShapeT, BroadPhaseT>::add_grain(BodyId body, const ShapeT& shape) {
  auto& list = grains_.empty() || grains_.back().body < body ? grains_ : late_;
  if (spare_.empty()) {
    list.push_back(Grain{body, &shape, Placed<ShapeT>(shape), width(shape)});
  } else {
    spare_.back().body = body;
    spare_.back().shape = &shape;
    spare_.back().width = width(shape);
    list.push_back(std::move(spare_.back()));
    spare_.pop_back();
  }
  widest_ = std::max(widest_, width(shape));
  near_.set_stale(true);
}

template <class ShapeT, class BroadPhaseT>
void ContactDetector<ShapeT, BroadPhaseT>::insert_late() {
  const auto grain_of = [this](std::size_t k) -> Grain& {
    return k < grains_.size() ? grains_[k] : late_[k - grains_.size()];
  };
  constexpr std::uint32_t none = decltype(near_)::none;
  const std::size_t count = grains_.size() + late_.size();
  std::size_t bodies = 0;
  for (std::size_t k = 0; k < count; ++k)
    bodies = std::max(bodies, grain_of(k).body.index() + std::size_t{1});
  number_at_.assign(bodies, none);
  for (std::size_t k = 0; k < count; ++k)
    number_at_[grain_of(k).body.index()] = static_cast<std::uint32_t>(k);
  number_after_.resize(grains_.size());
  std::vector<Grain> all;
  all.reserve(count);
  for (const std::uint32_t k : number_at_) {
    if (k == none) continue;
    if (k < grains_.size()) number_after_[k] = static_cast<std::uint32_t>(all.size());
    all.push_back(std::move(grain_of(k)));
  }
  near_.renumber(number_after_);
  grains_.swap(all);
  late_.clear();
}

template <class ShapeT, class BroadPhaseT>
void ContactDetector<ShapeT, BroadPhaseT>::remove_grains(
    std::span<const unsigned char> is_removed) {
  constexpr std::uint32_t none = decltype(near_)::none;
  if (!late_.empty()) insert_late();
  number_after_.clear();
  std::uint32_t left = 0;
  for (Grain& grain : grains_) {
    const bool goes = is_removed[grain.body.index()] != 0;
    number_after_.push_back(goes ? none : left++);
    if (goes) spare_.push_back(std::move(grain));
  }
  erase_at(grains_, [&](std::size_t k) { return number_after_[k] == none; });
  near_.remove_grains(number_after_);
  order_.invalidate();
  // The width of all grains that are left: the same as after a restart from a snapshot.
  widest_ = 0;
  for (const Grain& grain : grains_) widest_ = std::max(widest_, grain.width);
}

template <class ShapeT, class BroadPhaseT>
void ContactDetector<ShapeT, BroadPhaseT>::find_pairs(const DetectionLengths<Scalar>& lengths,
                                                      const char* function) {
  if (near_.find(grains_, boxes_, lengths, widest_, function)) order_.invalidate();
  margins_.take_all();
}

template <class ShapeT, class BroadPhaseT>
void ContactDetector<ShapeT, BroadPhaseT>::detect_points(
    const DetectionLengths<Scalar>& lengths, const Bodies<S>& bodies,
    const detail::PreviousContacts<S>& previous, DetectedContacts<S>& out) {
  members_.resize(std::size_t(team_.size()));
  for (Member& member : members_)
    member.start(double(lengths.resolution), kept_points_ == ContactPoints::few);
  if (!order_.is_valid()) order_.assign(std::span<const Aabb<S>>(boxes_), near_.pairs());
  runs_.resize(grains_.size());
  // If the work is not shared, one member finds all contacts, and the others keep the empty lists of start().
  const std::size_t work = grains_.size() + pair_count();
  constexpr std::size_t least = 200;  // less is not worth a barrier
  team_.run_timed(TimedWork::detection, work, least, [&](int rank, int size, const TeamBarrier&) {
    Member& member = members_[std::size_t(rank)];
    order_.for_each(rank, size, [&](std::size_t k, const auto& later) {
      if constexpr (prefetches)
        order_.prefetch(later, grains_, near_.pairs(),
                        [&](std::size_t p) { return margins_.is_near(p); });
      member.begin_run(k < place_.size() ? place_[k] : 0);
      detect_of(k, lengths, bodies, previous, member);
      runs_[k] = member.end_run(std::uint32_t(rank));
    });
  });
  // In pieces of their own: a member whose shape has thrown has found nothing that could be written.
  Member::make_room(runs_, place_, out);
  team_.share_each(grains_.size(), least, [&](std::size_t k) {
    members_[runs_[k].finder].write(runs_[k], grains_[k].body.value, place_[k], out);
  });
  const bool has_walls =
      meshes_.size() > 0 && meshes_.size() + walls_.size() + cylinders_.size() > 1;
  internal_edges_.replace(grains_, meshes_, has_walls, bodies, lengths.resolution, lengths.margin,
                          out);
}

template <class ShapeT, class BroadPhaseT>
void ContactDetector<ShapeT, BroadPhaseT>::fit_margins(const DetectionLengths<Scalar>& lengths,
                                                       const Bodies<S>& bodies, Scalar step,
                                                       double share) {
  const detail::StepMotion<S> motion{bodies.velocity, {}, step};
  margins_.fit(team_, bounds_of(lengths, bodies, motion), share);
}

template <class ShapeT, class BroadPhaseT>
auto ContactDetector<ShapeT, BroadPhaseT>::margins_suffice(const DetectionLengths<Scalar>& lengths,
                                                           const Bodies<S>& bodies,
                                                           const detail::StepMotion<S>& motion) ->
    typename detail::StepMargins<S>::Sufficiency {
  return margins_.suffice(team_, bounds_of(lengths, bodies, motion));
}

template <class ShapeT, class BroadPhaseT>
void ContactDetector<ShapeT, BroadPhaseT>::detect_of(std::size_t k,
                                                     const DetectionLengths<Scalar>& lengths,
                                                     const Bodies<S>& bodies,
                                                     const detail::PreviousContacts<S>& previous,
                                                     Member& found) {
  const Scalar margin = lengths.margin;
  Manifold<S>& manifold = found.manifold();
  const std::span<const Pose<S>> poses(bodies.pose);
  const Grain& a = grains_[k];
  const bool prescribed = bodies.is_prescribed(a.body.index());
  const auto ignores = [&](BodyId b) {
    return (prescribed && bodies.is_prescribed(b.index())) || near_.filter().leaves_out(a.body, b);
  };
  for (std::size_t p = order_.first_pair(k); p < order_.first_pair(k + 1); ++p) {
    if (!margins_.is_near(p)) continue;
    const std::size_t second = near_.pairs()[p].second;
    const Scalar of_pair = margins_.of_pair(k, second, margin);
    const Aabb<S> reach = boxes_[k].inflated(of_pair);
    const bool crosses = near_.crosses(p);
    if (!(crosses ? reach.overlaps(boxes_[second].moved(near_.shifts()[p]))
                  : reach.overlaps(boxes_[second])) ||
        ignores(grains_[second].body))
      continue;
    const Grain& b = crosses ? image_of(grains_[second], poses, near_.shifts()[p], found.image)
                             : grains_[second];
    const Scalar carry =
        lengths.slow > 0 && is_slow(a, b, bodies, lengths.slow) ? lengths.carry : 0;
    found.add(a, b, previous, [&](auto&& add) {
      return near_.caches().collide_parts(p, a.placed, poses[a.body.index()].rotation, b.placed,
                                          poses[b.body.index()].rotation, of_pair, carry,
                                          lengths.resolution, manifold, add);
    });
  }
  const Scalar of_walls = margins_.of_walls(k, margin);
  for (const auto& wall : walls_) {
    if (!wall.placed.reaches(boxes_[k], of_walls) || ignores(wall.body)) continue;
    found.add(a, wall, previous, [&](auto&& add) {
      return collide_parts(a.placed, wall.placed, of_walls, manifold, add);
    });
  }
  for (const auto& wall : cylinders_)
    if (!ignores(wall.body) && wall.placed.reaches(boxes_[k], of_walls))
      found.add_each(a, wall, [&](auto&& add) {
        return collide_each(a.placed, wall.placed, of_walls, manifold, add);
      });
  meshes_.detect({a.body, *a.shape, a.placed, boxes_[k]}, {margin, of_walls}, bodies,
                 near_.filter(), previous, found.mesh, found);
}

}  // namespace moreau
