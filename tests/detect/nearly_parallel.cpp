// SPDX-License-Identifier: MIT
// Edges and faces that are exactly or nearly parallel. The common normal of lines and their nearest
// points are then dominated by rounding errors, but their distance is not.
#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>

#include "moreau/detect/collide.hpp"
#include "moreau/shape/capsule.hpp"

#include "detect/shapes.hpp"
#include "sanitized.hpp"
#include "types.hpp"

using namespace moreau;

namespace {

/// The signed distance of a point from the surface of a shape, negative inside.
template <class T>
T above(const Placed<Polyhedron<T>>& shape, const typename Space<3, T>::Vector& x) {
  T height = -std::numeric_limits<T>::infinity();
  for (std::size_t f = 0; f < shape.normals().size(); ++f)
    height = std::max(height, shape.normals()[f].dot(x - shape.center()) - shape.offset(f));
  return height;
}

/// Checks that the witness points lie on the surfaces, and that overlap() agrees with the gap.
template <class T>
void check_answers(const Placed<Polyhedron<T>>& a, const Placed<Polyhedron<T>>& b, T size) {
  const auto found = distance(a, b);
  const T near = T(2) * DetectionTolerance<T>::coincident * size;
  CHECK(std::abs(above(a, found.witness_a)) < near);
  CHECK(std::abs(above(b, found.witness_b)) < near);
  PairCache<Space<3, T>> empty;
  const bool together = overlap(a, b);
  CHECK(overlap(a, b, empty) == together);
  if (std::abs(found.gap) > T(16) * DetectionTolerance<T>::rounding * size)
    CHECK(together == (found.gap <= 0));
  Manifold<Space<3, T>> manifold;
  const T margin = std::max(found.gap, T(0)) + T(1e-3);
  REQUIRE(collide(a, b, margin, manifold));
  for (const auto& point : manifold.points) {
    const auto half = (point.gap / 2 * manifold.normal).eval();
    CHECK(above(a, typename Space<3, T>::Vector(point.position - half)) < T(20) * near + T(1e-6));
    CHECK(above(b, typename Space<3, T>::Vector(point.position + half)) < T(20) * near + T(1e-6));
  }
}

}  // namespace

TEST_CASE_TEMPLATE("boxes turned alike: the gap is that of intervals", T,
                   MOREAU_TYPES((double), (float))) {
  using S = Space<3, T>;
  using Vector = typename S::Vector;
  const std::array<std::array<T, 3>, 4> edges = {
      {{1, 1, 1}, {1, 1, T(.01)}, {1, T(.01), T(.01)}, {2, 1, T(.5)}}};
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < rounds(20000); ++i) {
    const auto &edges_a = edges[random() % 4], &edges_b = edges[random() % 4];
    const auto shape_a = samples::box<T>(edges_a[0], edges_a[1], edges_a[2]);
    const auto shape_b = samples::box<T>(edges_b[0], edges_b[1], edges_b[2]);
    Pose<S> pose_a, pose_b;
    if (i % 2) pose_a.rotation = samples::rotation(S{}, random);
    pose_b.rotation = pose_a.rotation;
    Eigen::Vector3d between;
    for (std::size_t k = 0; k < 3; ++k) {
      const double half = double(edges_a[k] + edges_b[k]) / 2;
      const double least = double(std::min(edges_a[k], edges_b[k]));
      const std::array<double, 4> beyond = {0, std::pow(10., -6 * unit(random)),
                                            -unit(random) * half,
                                            -least * std::pow(10., -6 * unit(random))};
      between[Eigen::Index(k)] = (random() % 2 ? 1 : -1) * (half + beyond[random() % 4]);
    }
    pose_b.position = pose_a.rotation * Vector(between.cast<T>());
    // The displacement that the pose has after rounding.
    const Eigen::Vector3d apart = (pose_a.rotation.template cast<double>().inverse() *
                                   pose_b.position.template cast<double>())
                                      .cwiseAbs();
    Eigen::Vector3d separation;
    for (Eigen::Index k = 0; k < 3; ++k)
      separation[k] = apart[k] - double(edges_a[std::size_t(k)] + edges_b[std::size_t(k)]) / 2;
    const double gap =
        separation.maxCoeff() <= 0 ? separation.maxCoeff() : separation.cwiseMax(0.).norm();
    const Placed<Polyhedron<T>> a(shape_a, pose_a), b(shape_b, pose_b);
    const T size = shape_a.circumradius() + shape_b.circumradius();
    const double rounding =
        64 * double(std::numeric_limits<T>::epsilon()) * (double(size) + apart.norm());
    CHECK(std::abs(double(distance(a, b).gap) - gap) < rounding);
    check_answers(a, b, size);
  }
}

TEST_CASE("all but parallel: the gap does not know how the pair is turned") {
  using S = Space<3>;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto a = samples::box<double>(1, 1, 1);
  for (const auto& b : {samples::box<double>(1, 1, 1), samples::box<double>(1, 1, .01)})
    for (int i = 0; i < rounds(20000); ++i) {
      const double turn = std::pow(10., -1. - double(random() % 14));
      Pose<S> pose_a, pose_b;
      S::Vector axis = samples::direction<S>(random);
      if (i % 2) axis = S::Vector::Unit(Eigen::Index(random() % 3));
      pose_b.rotation = S::exp(turn * axis);
      pose_b.position = (0.5 + 2.5 * unit(random)) * samples::direction<S>(random);
      const auto found = distance(Placed(a, pose_a), Placed(b, pose_b));
      const std::array<double, 4> gaps = {found.gap, std::pow(10., -12 * unit(random)),
                                          -std::pow(10., -2 - 10 * unit(random)), 0};
      pose_b.position -= (found.gap - gaps[random() % 4]) * found.normal;
      const double gap = distance(Placed(a, pose_a), Placed(b, pose_b)).gap;
      check_answers(Placed(a, pose_a), Placed(b, pose_b), 2.);
      pose_a.rotation = samples::rotation(S{}, random);
      pose_b.rotation = pose_a.rotation * pose_b.rotation;
      pose_b.position = pose_a.rotation * pose_b.position;
      // For angles between 1e-11 and 1e-8 rad, the gap along an axis of two edges is accurate only
      // to 3e-11 of the size.
      const double known = turn < 2e-8 && turn > 5e-13 ? 6e-11 : 1e-12;
      CHECK(std::abs(distance(Placed(a, pose_a), Placed(b, pose_b)).gap - gap) < known);
    }
}

TEST_CASE("capsules in the plane, in line or not: the gap separates along the normal") {
  using S = Space<2>;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < rounds(20000); ++i) {
    const CapsuleIn<S> one(1, .01 + unit(random)), other(1, .01 + unit(random));
    Pose<S> pose;
    if (i % 2) pose.rotation = Eigen::Rotation2D<double>(3 * unit(random));
    if (i % 4 == 3) pose.rotation = Eigen::Rotation2D<double>(std::pow(10., -12 * unit(random)));
    pose.position = {3 * unit(random) - 1.5, 3 * unit(random) - 1.5};
    if (i % 8 == 7) pose.position = {1 + std::pow(10., -12 * unit(random)), 0};
    const Placed<CapsuleIn<S>> a(one), b(other, pose);
    const auto found = distance(a, b);
    const auto separation = found.normal.dot(b.center() + b.support(-found.normal) - a.center() -
                                             a.support(found.normal));
    CHECK(std::abs(separation - found.gap) < 1e-12);
  }
}
