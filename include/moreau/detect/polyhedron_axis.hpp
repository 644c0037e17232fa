// SPDX-License-Identifier: MIT
// The axis of a pair of polyhedra: a few steps of the distance algorithm, which part most pairs
// that are apart and else give vertices near the contact; then the search over faces and edges,
// exact but for shapes that are apart by vertices; for those the distance algorithm to its end.
// Where a face of a parts the shapes without being the answer, the distance algorithm is brought to
// its end at once: what it ends on is a guess, proved like one from the step before.
#pragma once

#include "moreau/detect/axis_search.hpp"
#include "moreau/detect/gjk.hpp"
#include "moreau/detect/nearest_axis.hpp"
#include "moreau/detect/polyhedron_pair.hpp"
#include "moreau/detect/polyhedron_recall.hpp"

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
    if (is_beyond_) return;
    if (proximity != Proximity::touching) take_nearest_points(margin);
  }
  Proximity go_on(T margin, int steps) {
    Vector direction;
    const auto proximity = approach<T>([this](const Vector& n) { return pair_.support(n); },
                                       simplex_, direction, margin, pair_.size, steps);
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
  /// far away: theirs does not suffer from the rounding of a small difference.
  void take_nearest_points(T margin) {
    constexpr T aligned = DetectionTolerance<T>::aligned;
    Axis<S> nearest{simplex_.direction().normalized(), simplex_.nearest().norm(),
                    AxisKind::nearest_points, 0, 0};
    name_features(pair_, simplex_, nearest);
    if (nearest.kind != AxisKind::nearest_points)
      measure_nearest(pair_, nearest.kind, nearest.a, nearest.b, nearest);
    is_beyond_ = nearest.gap > margin;
    if (axis_.gap >= nearest.gap - pair_.rounding() &&
        (axis_.normal - nearest.normal).squaredNorm() < aligned * aligned)
      return;
    axis_ = nearest;
  }

  const PolyhedronPair<T>& pair_;
  Simplex<T> simplex_;
  Axis<S> axis_;
  bool is_beyond_ = false;
};

}  // namespace moreau::detail
