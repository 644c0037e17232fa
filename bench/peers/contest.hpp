// SPDX-License-Identifier: MIT
// A contest: every library answers the same pairs; what it says is held against the truth, and how
// long it takes is measured.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "detect/oracle.hpp"
#include "pairs.hpp"

namespace peers {

/// What a library says of a pair. A gap that is not a number was not asked for or not answered.
template <class S>
struct Answer {
  bool overlap;
  double gap = std::nan("");
  typename S::Vector normal = S::Vector::Zero();  ///< from a to b; zero if not answered
};

template <class ShapeT>
struct Case {
  using S = moreau::SpaceOf<ShapeT>;
  std::size_t a, b;  ///< shapes
  moreau::Pose<S> pose_a, pose_b;
  const moreau::Placed<ShapeT>* placed_a;
  const moreau::Placed<ShapeT>* placed_b;
  double margin, diameter;
  bool is_first;  ///< of a trajectory: nothing may be remembered
};

template <class ShapeT>
class Contest {
 public:
  using S = moreau::SpaceOf<ShapeT>;
  using Query = std::function<Answer<S>(std::size_t)>;

  Contest(std::string title, const std::vector<ShapeT>& shapes, std::vector<Case<ShapeT>> cases)
      : cases_(std::move(cases)) {
    for (const auto& c : cases_)
      truth_.push_back(oracle::signed_gap(shapes[c.a], c.pose_a, shapes[c.b], c.pose_b));
    std::printf("\n%s: %zu pairs\n%-34s %9s %7s %7s %12s %9s\n", title.c_str(), cases_.size(), "",
                "ns/pair", "ratio", "wrong", "gap error/d", "normals");
  }

  const std::vector<Case<ShapeT>>& cases() const { return cases_; }

  /// @param kind  libraries of one kind are compared with the first of it
  void enter(const std::string& name, const std::string& kind, const Query& query) {
    const double ns = time(query);
    if (kind != kind_) {
      kind_ = kind;
      reference_ = ns;
    }
    std::size_t wrong = 0, normals = 0, gaps = 0;
    double error = 0;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const Answer<S> answer = query(i);
      const double d = cases_[i].diameter;
      if (std::abs(truth_[i].gap) > 1e-12 * d) wrong += answer.overlap != (truth_[i].gap <= 0);
      if (!std::isnan(answer.gap)) {
        ++gaps;
        error = std::max(error, std::abs(answer.gap - truth_[i].gap) / d);
      }
      if (!answer.normal.isZero(0) && truth_[i].is_unique)
        normals += !((answer.normal - truth_[i].normal).norm() < 1.75e-4);
    }
    std::printf("%-34s %9.0f %7.2f %7zu ", (kind + " " + name).c_str(), ns, ns / reference_, wrong);
    if (gaps > 0)
      std::printf("%12.1e %9zu\n", error, normals);
    else
      std::printf("%12s %9s\n", "-", "-");
  }

 private:
  static double now() {
    std::timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
  }
  double time(const Query& query) const {
    double best = 1e300;
    std::size_t hits = 0;
    for (int repeat = 0; repeat < 5; ++repeat) {
      const double start = now();
      for (std::size_t i = 0; i < cases_.size(); ++i) hits += query(i).overlap;
      best = std::min(best, now() - start);
    }
    volatile std::size_t sink = hits;
    (void)sink;
    return best / static_cast<double>(cases_.size());
  }

  std::vector<Case<ShapeT>> cases_;
  std::vector<oracle::Truth<S>> truth_;
  std::string kind_;
  double reference_ = 1;
};

void enter_fcl(Contest<moreau::Polyhedron<double>>& contest,
               const std::vector<moreau::Polyhedron<double>>& shapes);
void enter_ccd(Contest<moreau::Polyhedron<double>>& contest,
               const std::vector<moreau::Polyhedron<double>>& shapes, const std::string& kind);
void enter_bullet(Contest<moreau::Polyhedron<double>>& contest,
                  const std::vector<moreau::Polyhedron<double>>& shapes);
void enter_box2d(Contest<moreau::Polygon<double>>& contest,
                 const std::vector<moreau::Polygon<double>>& shapes);

}  // namespace peers
