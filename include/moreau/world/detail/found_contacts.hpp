// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/core/list.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/reduce.hpp"

namespace moreau::detail {

/// The contacts of the step before, of which detection keeps the points that pushed most.
template <class S>
struct PreviousContacts {
  std::span<const ContactKey> keys;            ///< sorted
  const typename S::Scalar* pushes = nullptr;  ///< the first entry of the first impulse [N s]
  std::size_t stride = 0;                      ///< entries of an impulse

  template <int Rows>
  explicit PreviousContacts(const Contacts<S, Rows>& contacts)
      : keys(contacts.keys), stride(std::size_t(Rows)) {
    using Impulse = typename Contacts<S, Rows>::Impulse;
    static_assert(sizeof(Impulse) == std::size_t(Rows) * sizeof(typename S::Scalar));
    if (!contacts.impulses.empty()) pushes = contacts.impulses[0].data();
  }
  /// Normal entry of the impulse of a contact [N s].
  typename S::Scalar push(std::size_t c) const { return pushes[c * stride]; }
};

/// The contacts that one thread finds in a step, with the buffers that it needs for it. Threads write
/// to neighbouring objects all the time: each has cache lines of its own.
///
/// Contacts are found grain by grain in any order of the grains. write() then writes those of one
/// grain to their place in the list of the step, which is sorted.
template <class S>
class alignas(64) FoundContacts {
 public:
  using Vector = typename S::Vector;

  /// The contacts of one grain, body a, with bodies b.
  struct Run {
    std::uint32_t finder = 0;           ///< the thread that has found them
    std::uint32_t first = 0, last = 0;  ///< its pairs
    std::size_t points = 0;             ///< contact points of these pairs
  };

  /// Forgets what was found.
  /// @param resolution distance of points that count as one [m]
  /// @param few        whether contacts between faces are reduced to D points
  void start(double resolution, bool few) {
    reduction_.resolution = reduction_.near = resolution;
    reduction_.shallower = resolution / 10;
    few_ = few;
    pairs_.clear();
    points_.clear();
    touching_ = 0;
  }
  Manifold<S>& manifold() { return manifold_; }       ///< of the present pair, for collide()
  std::size_t touching() const { return touching_; }  ///< pairs with a contact

  /// Begins the contacts of a grain.
  /// @param guess of the index of its first contact in the step before
  void begin_run(std::size_t guess) {
    run_pairs_ = pairs_.size();
    run_points_ = points_.size();
    previous_ = guess;
  }
  /// Adds the contact of a pair: the points of each manifold, reduced to D if asked for.
  /// @param a,b      body and placed shape of each side
  /// @param previous contacts of the step before; its points are kept first
  /// @param collide_each calls its argument for each manifold, returns whether there was one
  void add(const auto& a, const auto& b, const PreviousContacts<S>& previous, auto&& collide_each) {
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
  /// Ends the contacts of a grain. Sorts them by body b: the id of a wall may be lower than that of a
  /// grain.
  Run end_run(std::uint32_t finder) {
    const auto begin = pairs_.begin() + std::ptrdiff_t(run_pairs_);
    const auto before = [](const Pair& l, const Pair& r) { return l.b < r.b; };
    if (!std::is_sorted(begin, pairs_.end(), before))
      for (auto at = begin; at != pairs_.end(); ++at)  // stable, without memory
        std::rotate(std::upper_bound(begin, at, *at, before), at, at + 1);
    return {finder, std::uint32_t(run_pairs_), std::uint32_t(pairs_.size()),
            points_.size() - run_points_};
  }

  /// Makes room for the contacts of all grains.
  /// @param runs  one per grain
  /// @param place out: index of the first contact of each grain; at the end, their number
  static void make_room(const List<Run>& runs, List<std::size_t>& place, DetectedContacts<S>& out) {
    place.assign(1, 0);
    for (const Run& run : runs) place.push_back(place.back() + run.points);
    out.points.resize(place.back());
    out.keys.resize(place.back());
    out.classes.resize(place.back());
  }
  /// Writes the contacts of a grain, sorted by key.
  /// @param at index of the first of them in the list
  void write(const Run& run, std::uint32_t a, std::size_t at, DetectedContacts<S>& out) {
    const std::size_t begin = at;
    // Pointers of their own: the compiler need not expect that writing a number changes them.
    const Pair* const pairs = pairs_.data();
    const ManifoldPoint<S>* const found = points_.data();
    Contact<S>* const points = out.points.data();
    ContactKey* const keys_out = out.keys.data();
    ContactClass* const classes = out.classes.data();
    for (std::uint32_t k = run.first; k < run.last; ++k) {
      const Pair& pair = pairs[k];
      const typename S::Matrix frame = S::contact_frame(pair.normal);
      for (std::uint32_t p = pair.first; p < pair.last; ++p, ++at) {
        const ManifoldPoint<S>& point = found[p];
        Contact<S>& contact = points[at];
        contact.a = a;
        contact.b = pair.b;
        contact.law = 0;
        contact.gap = point.gap;
        contact.frame = frame;
        for (int d = 0; d < S::dim; ++d) {
          contact.lever_a[d] = point.position[d] - pair.center_a[d];
          contact.lever_b[d] = point.position[d] - pair.center_b[d];
        }
        keys_out[at] = {a, pair.b, point.feature, pair.part_a, pair.part_b};
        classes[at] = pair.contact_class;
      }
    }
    const auto keys = out.keys.begin();
    if (!std::is_sorted(keys + std::ptrdiff_t(begin), keys + std::ptrdiff_t(at)))
      sort(begin, at, out);
  }

 private:
  /// A manifold of a pair.
  struct Pair {
    std::uint32_t b;               // the second body
    std::uint32_t part_a, part_b;  // the parts that touch
    std::uint32_t first, last;     // its points
    ContactClass contact_class;
    Vector normal, center_a, center_b;  // of the placed shapes
  };

  void add_all(const auto& a, const auto& b) {
    const auto first = static_cast<std::uint32_t>(points_.size());
    points_.append(manifold_.points.data(), manifold_.points.size());
    pairs_.push_back({b.body.value, manifold_.part_a, manifold_.part_b, first,
                      static_cast<std::uint32_t>(points_.size()), manifold_.contact_class,
                      manifold_.normal, a.placed.center(), b.placed.center()});
  }
  /// Reduces the manifold of two parts to D points, if possible those of the step before.
  void keep_few(std::uint32_t a, std::uint32_t b, const PreviousContacts<S>& previous) {
    kept_.clear();
    if (manifold_.points.size() > S::dim) {
      const std::span keys = previous.keys;
      const ContactKey from{a, b, FeatureKey(), manifold_.part_a, manifold_.part_b};
      const bool is_first = previous_ <= keys.size() &&
                            (previous_ == 0 || keys[previous_ - 1].a < a) &&
                            (previous_ == keys.size() || keys[previous_].a >= a);
      if (!is_first)
        previous_ =
            std::size_t(std::lower_bound(keys.begin(), keys.end(), ContactKey{a, 0, FeatureKey()}) -
                        keys.begin());
      for (std::size_t c = previous_; c < keys.size() && keys[c].a == a && keys[c].b <= b; ++c)
        if (keys[c].is_of_parts_of(from))
          kept_.push_back({keys[c].feature, std::max(0.0, double(previous.push(c)))});
    }
    reduce(manifold_, S::dim, std::span<const KeptPoint>(kept_), reduction_);
  }
  /// Sorts by key the contacts of a pair with several manifolds.
  void sort(std::size_t begin, std::size_t end, DetectedContacts<S>& out) {
    for (std::size_t at = begin + 1; at < end; ++at)
      for (std::size_t c = at; c > begin && out.keys[c] < out.keys[c - 1]; --c) {
        std::swap(out.points[c], out.points[c - 1]);
        std::swap(out.keys[c], out.keys[c - 1]);
        std::swap(out.classes[c], out.classes[c - 1]);
      }
  }

  Manifold<S> manifold_;
  Reduction reduction_;
  bool few_ = true;
  List<KeptPoint> kept_;
  List<Pair> pairs_;
  List<ManifoldPoint<S>> points_;
  std::size_t run_pairs_ = 0, run_points_ = 0;  // first ones of the present grain
  std::size_t previous_ = 0;  // first contact of the present grain in the step before
  std::size_t touching_ = 0;
};

}  // namespace moreau::detail
