// SPDX-License-Identifier: MIT
// Two convex grains in flight that hit each other: what Simulation does in a step for one pair. It compiles in a
// fraction of the time.
#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/detect/collide.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/motion/bodies.hpp"

#include "law/vertices_on_floor.hpp"

namespace landing {

template <class S>
struct PolytopeOf;
template <>
struct PolytopeOf<Space<2>> {
  using type = Polygon<double>;
};
template <>
struct PolytopeOf<Space<3>> {
  using type = Polyhedron<double>;
};

/// Boxes and random polytopes of 2 cm, at 1 m/s.
template <class S, class Law>
class TwoGrains : public TwoBodies<S, Law> {
 public:
  using Base = TwoBodies<S, Law>;
  using Base::bodies;
  using typename Base::Vector;
  using Shape = typename PolytopeOf<S>::type;
  static constexpr double radius = 0.01;

  double longest = 0.03;  ///< [s]
  bool has_touched = false;

  /// @param trial 0 to 9: two boxes, face on face, aside by up to half of their size; beyond: at random
  /// @param spin  size of the angular velocities [rad/s]
  TwoGrains(const Law& law, int trial, double spin) : Base(law) {
    std::mt19937_64 random(unsigned(trial) + 1);
    std::normal_distribution<double> normal;
    for (const double side : {-1.0, 1.0}) {
      shapes_.push_back(trial < 10 || trial % 2 == 0
                            ? box<Shape>(Vector::Constant(-radius), Vector::Constant(radius))
                            : polytope(random));
      Pose<S> pose;
      pose.position = Vector::Zero();
      if (trial >= 10)
        for (auto& x : pose.position) x = radius / 3 * normal(random);
      if (trial < 10 && side > 0) pose.position[1] = radius * trial / 9;
      pose.position[0] = side * (trial < 10 ? radius + 1e-4 : 2 * radius);
      typename S::Angular turn = S::Angular::Zero();
      if (trial >= 10)
        for (auto& x : turn) x = normal(random);
      pose.rotation = S::exp(turn);
      bodies.push_back(pose, MaterialId(0));
      const auto mass = shapes_.back().mass_properties(S::dim == 3 ? 1000 : 20);
      bodies.set_mass(bodies.size() - 1, mass.mass, mass.inertia);
      for (int k = S::dim; k < S::dofs; ++k) bodies.velocity.back()[k] = spin * normal(random);
      bodies.velocity.back()[0] = -side;
    }
  }
  double kinetic_energy() const { return this->kinetic_energy_of(0) + this->kinetic_energy_of(1); }
  void step(double h) {
    Base::step(h, [&] {
      const Placed<Shape> a(shapes_[0], bodies.pose[0]), b(shapes_[1], bodies.pose[1]);
      if (!collide(a, b, Base::margin, manifold_)) return;
      for (const auto& point : manifold_.points)
        this->add(point.gap, manifold_.normal, point.position - bodies.pose[0].position,
                  point.position - bodies.pose[1].position, point.feature, manifold_.contact_class);
    });
    has_touched = has_touched || this->touches();
  }

 private:
  /// The hull of random points of about the radius.
  static Shape polytope(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    std::vector<Vector> points;
    for (int k = 0; k < 4 + 3 * S::dim; ++k) {
      points.emplace_back();
      for (auto& x : points.back()) x = normal(random);
      points.back() *= radius / points.back().norm();
    }
    return hull<Shape>(points);
  }
  std::vector<Shape> shapes_;
  Manifold<S> manifold_;
};

}  // namespace landing
