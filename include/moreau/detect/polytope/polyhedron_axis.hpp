// SPDX-License-Identifier: MIT
// The axis of a pair of polyhedra: a few steps of the distance algorithm, which part most pairs
// that are apart and else give vertices near the contact; then the search over faces and edges,
// exact but for shapes that are apart by vertices; for those the distance algorithm to its end, and
// where that ends on rounding, all features that can be nearest. Where a face of a parts the shapes
// without being the answer, the distance algorithm is brought to its end at once: what it ends on
// is a guess, proved like one from the step before.
#pragma once

#include <algorithm>
#include <cmath>

#include "moreau/detect/convex/gjk.hpp"
#include "moreau/detect/polytope/detail/axis_search.hpp"
#include "moreau/detect/polytope/detail/nearest_axis.hpp"
#include "moreau/detect/polytope/detail/nearest_features.hpp"
#include "moreau/detect/polytope/polyhedron_pair.hpp"
#include "moreau/detect/polytope/polyhedron_recall.hpp"
#include "moreau/detect/polytope/polyhedron_witness.hpp"

namespace moreau::detail {

template <std::floating_point T>
class PolyhedronAxis {
 public:
  using S = Space<3, T>;
  using Vector = typename S::Vector;

  PolyhedronAxis(const PolyhedronPair<T>& pair, T margin)
      : pair_(pair), simplex_(pair.support(pair.start())) {
    axis_.kind = AxisKind::none;
    const Vector start = pair.start();
    const T separation = start.dot(simplex_[0].point);
    is_beyond_ =
        separation > T(0) && separation * separation > margin * margin * start.squaredNorm();
    if (is_beyond_)
      axis_.normal = start.normalized();
    else
      find(margin);
  }

  /// Whether the gap is larger than the margin; the axis then only separates by more than that.
  bool is_beyond() const { return is_beyond_; }
  const Axis<S>& axis() const { return axis_; }
  /// The nearest points, if the axis is theirs.
  const Simplex<T>& simplex() const { return simplex_; }

 private:
  void find(T margin) {
    constexpr int first_steps = 2;
    Proximity proximity = go_on(margin, first_steps);
    if (is_beyond_) return;
    PointSet<T> points_a, points_b;
    collect(points_a, points_b);
    AxisSearch<T> search(pair_, points_a, points_b, margin);
    if (!search.is_done() && search.axis().gap > T(0)) {
      if (proximity == Proximity::undecided) proximity = go_on(margin, all_steps);
      if (is_beyond_ || (proximity == Proximity::apart && prove_end(margin))) return;
    }
    search.go_on();
    axis_ = search.axis();
    is_beyond_ = axis_.gap > margin;
    if (is_beyond_ || search.is_exact()) return;
    if (proximity == Proximity::undecided) proximity = go_on(margin, all_steps);
    if (!is_beyond_) take_nearest_points(margin);
  }
  Proximity go_on(T margin, int steps) {
    Vector direction = Vector::Zero();
    const auto proximity = gjk<T>([this](const Vector& n) { return pair_.support(n); }, simplex_,
                                  direction, margin, pair_.size, steps);
    is_beyond_ = proximity == Proximity::beyond;
    if (is_beyond_) axis_.normal = direction.normalized();
    return proximity;
  }
  /// Whether the features that the distance algorithm ended on are proved to make the axis.
  bool prove_end(T margin) {
    PairCache<S> end;
    if (simplex_.size() == 3)
      name_facet(pair_, simplex_, end);
    else
      name_features(pair_, simplex_, end);
    PolyhedronRecall<T> recall(pair_);
    if (!recall.prove(end) || !(std::abs(recall.axis().gap - margin) > pair_.rounding()))
      return false;
    axis_ = recall.axis();
    is_beyond_ = axis_.gap > margin;
    return true;
  }
  void collect(PointSet<T>& points_a, PointSet<T>& points_b) const {
    for (int i = 0; i < simplex_.size(); ++i) {
      const std::uint32_t a = simplex_[i].a, b = simplex_[i].b;
      if (!points_a.contains(a)) points_a.add(a, pair_.a.vertices()[a] - pair_.offset);
      if (!points_b.contains(b)) points_b.add(b, pair_.b.vertices()[b] + pair_.offset);
    }
  }
  /// The distance, and its direction, unless the face or edges found before lie across it just as
  /// far away, so that the nearest points are on them: theirs does not suffer from the rounding of
  /// a small difference.
  ///
  /// The distance of any two points of the shapes is an upper bound of the gap, the separation
  /// along any direction a lower one. What the distance algorithm ended on is taken where they
  /// meet; else all features are compared that can be nearest.
  void take_nearest_points(T margin) {
    constexpr T aligned = DetectionTolerance<T>::aligned;
    const T doubt = T(4) * pair_.rounding();
    if (axis_.gap <= doubt && simplex_.size() == 4) return;
    Axis<S> nearest;
    const T upper = measure_end(nearest);
    if (upper <= doubt) return;
    const auto separates = [&] { return pair_.separation(nearest.normal) >= nearest.gap - doubt; };
    bool is_exact = std::abs(upper - nearest.gap) <= doubt && separates();
    if (!is_exact) {
      const T slab = std::max(upper - axis_.gap, T(0)) + doubt;
      nearest = NearestFeatures<T>(pair_, axis_.normal, slab).axis();
      if (!std::isfinite(nearest.gap)) return;
      is_exact = separates();
    }
    const T turn = (axis_.normal - nearest.normal).norm();
    const bool is_aligned =
        turn < aligned && turn * nearest.gap < pair_.size * DetectionTolerance<T>::coincident;
    const T lacking = nearest.gap - axis_.gap;
    if (lacking > doubt || (is_exact && (lacking > pair_.rounding() || !is_aligned)))
      axis_ = nearest;
    is_beyond_ = axis_.gap > margin;
  }
  /// What the distance algorithm ended on.
  /// @returns the distance of two points of the shapes
  T measure_end(Axis<S>& nearest) const {
    if (simplex_.size() == 4) return simplex_[0].point.norm();
    nearest.normal = simplex_.direction().normalized();
    nearest.gap = simplex_.nearest().norm();
    name_features(pair_, simplex_, nearest);
    if (nearest.kind == AxisKind::nearest_points) {
      const auto points = witness_of_simplex(pair_, simplex_);
      return (points.b - points.a).norm();
    }
    measure_nearest(pair_, nearest.kind, nearest.a, nearest.b, nearest);
    return nearest.gap;
  }

  const PolyhedronPair<T>& pair_;
  Simplex<T> simplex_;
  Axis<S> axis_;
  bool is_beyond_ = false;
};

}  // namespace moreau::detail
