// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/reduce.hpp"

namespace moreau::detail {

/// The contacts that one thread finds in a step, with the buffers that it needs for it. Threads write
/// to neighbouring objects all the time: each has cache lines of its own.
template <class S>
class alignas(64) FoundContacts {
 public:
  /// Forgets what was found.
  /// @param resolution distance of points that count as one [m]
  /// @param few        whether contacts between faces are reduced to D points
  void start(double resolution, bool few) {
    reduction_.resolution = reduction_.near = resolution;
    reduction_.shallower = resolution / 10;
    few_ = few;
    contacts_.clear();
    touching_ = 0;
  }
  Manifold<S>& manifold() { return manifold_; }       ///< of the present pair, for collide()
  std::size_t touching() const { return touching_; }  ///< pairs with a contact

  /// Adds the contact of a pair: the points of each manifold, reduced to D if asked for.
  /// @param a,b      body and placed shape of each side
  /// @param previous contacts of the step before; its points are kept first
  /// @param collide_each calls its argument for each manifold, returns whether there was one
  void add(const auto& a, const auto& b, const Contacts<S>& previous, auto&& collide_each) {
    touching_ += collide_each([&] {
      if (few_) keep_few(a.body.value, b.body.value, previous);
      add_all(a, b);
    });
  }
  /// Adds a contact of several manifolds, each as it is.
  /// @param collide_each as for add()
  void add_each(const auto& a, const auto& b, auto&& collide_each) {
    touching_ += collide_each([&] { add_all(a, b); });
  }

  /// Sorts by key: the id of a wall may be lower than that of a grain.
  void sort() {
    Contacts<S>& out = contacts_;
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
    out.points.swap(scratch_.points);
    out.keys.swap(scratch_.keys);
    out.classes.swap(scratch_.classes);
  }

  /// Makes one list of the contacts that the threads have found, in their order; zero impulses.
  /// @param found one per thread, derived from this class
  static void gather(auto& found, Contacts<S>& out) {
    out.clear();
    if (found.size() == 1) {
      out.points.swap(found[0].contacts_.points);
      out.keys.swap(found[0].contacts_.keys);
      out.classes.swap(found[0].contacts_.classes);
    } else {
      for (const FoundContacts& part : found) {
        const Contacts<S>& more = part.contacts_;
        out.points.insert(out.points.end(), more.points.begin(), more.points.end());
        out.keys.insert(out.keys.end(), more.keys.begin(), more.keys.end());
        out.classes.insert(out.classes.end(), more.classes.begin(), more.classes.end());
      }
    }
    out.impulses.assign(out.size(), S::Vector::Zero());
  }

 private:
  /// Adds the points of the manifold, with levers from the centres of the placed shapes.
  void add_all(const auto& a, const auto& b) {
    const typename S::Matrix frame = S::contact_frame(manifold_.normal);
    for (const ManifoldPoint<S>& point : manifold_.points) {
      contacts_.points.push_back({a.body.value, b.body.value, 0, point.gap, frame,
                                  point.position - a.placed.center(),
                                  point.position - b.placed.center()});
      contacts_.keys.push_back(
          {a.body.value, b.body.value, point.feature, manifold_.part_a, manifold_.part_b});
      contacts_.classes.push_back(manifold_.contact_class);
    }
  }
  /// Reduces the manifold of two parts to D points, if possible those of the step before.
  void keep_few(std::uint32_t a, std::uint32_t b, const Contacts<S>& previous) {
    kept_.clear();
    if (manifold_.points.size() > S::dim) {
      const ContactKey from{a, b, FeatureKey(), manifold_.part_a, manifold_.part_b};
      for (auto key = std::lower_bound(previous.keys.begin(), previous.keys.end(), from);
           key != previous.keys.end() && key->is_of_parts_of(from); ++key) {
        const auto& impulse = previous.impulses[std::size_t(key - previous.keys.begin())];
        kept_.push_back({key->feature, std::max(0.0, double(impulse[0]))});
      }
    }
    reduce(manifold_, S::dim, std::span<const KeptPoint>(kept_), reduction_);
  }

  Manifold<S> manifold_;
  Reduction reduction_;
  bool few_ = true;
  std::vector<KeptPoint> kept_;
  Contacts<S> contacts_, scratch_;
  std::vector<std::uint32_t> order_;
  std::size_t touching_ = 0;
};

}  // namespace moreau::detail
