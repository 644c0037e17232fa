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
class TwoGrains {
 public:
  using Vector = typename S::Vector;
  using Shape = typename PolytopeOf<S>::type;
  static constexpr double radius = 0.01, margin = 4e-4;

  Bodies<S> bodies;
  Contacts<S> contacts, previous;
  StepReport report;
  double time = 0, longest = 0.03;  ///< [s]
  bool has_touched = false;

  /// @param trial 0 to 9: two boxes, face on face, aside by up to half of their size; beyond: at random
  /// @param spin  size of the angular velocities [rad/s]
  TwoGrains(const Law& law, int trial, double spin) : materials_(1, law) {
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
  double kinetic_energy() const {
    double sum = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto w = angular<S>(bodies.velocity[i]);
      sum += (bodies.grain_mass[i] * linear<S>(bodies.velocity[i]).squaredNorm() +
              w.dot(bodies.inertia(i, bodies.pose[i].rotation) * w)) /
             2;
    }
    return sum;
  }
  bool touches() const {
    return std::any_of(contacts.impulses.begin(), contacts.impulses.end(),
                       [](const Vector& r) { return r[0] > 0; });
  }
  void step(double h) {
    const Vector gravity = Vector::Zero();
    const detail::StepContext<S, Law> context{bodies,   gravity, materials_, previous,
                                              contacts, 0.02,    h,          margin};
    report = {};
    if constexpr (RegularizedLaw<Law, S>) {
      if (!dynamics_.has_loads_of(2)) {
        detect();
        dynamics_.evaluate(context, 0, report);
      }
      dynamics_.predict(bodies, gravity, h);
      detect();
      dynamics_.evaluate(context, h, report);
      dynamics_.advance(context);
    } else {
      dynamics_.predict(bodies, h);
      detect();
      dynamics_.advance(context, report);
    }
    has_touched = has_touched || touches();
    time += h;
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
  void detect() {
    std::swap(contacts, previous);
    contacts.clear();
    const Placed<Shape> a(shapes_[0], bodies.pose[0]), b(shapes_[1], bodies.pose[1]);
    if (!collide(a, b, margin, manifold_)) return;
    for (const auto& point : manifold_.points) {
      Contact<S> contact{};
      contact.a = 0;
      contact.b = 1;
      contact.gap = point.gap;
      contact.frame = S::contact_frame(manifold_.normal);
      contact.lever_a = point.position - bodies.pose[0].position;
      contact.lever_b = point.position - bodies.pose[1].position;
      contacts.points.push_back(contact);
      contacts.keys.push_back({0, 1, point.feature});
      contacts.classes.push_back(manifold_.contact_class);
      contacts.impulses.push_back(Vector::Zero());
    }
  }

  std::vector<Shape> shapes_;
  Materials<Law> materials_;
  Manifold<S> manifold_;
  typename DynamicsOf<S, Law>::type dynamics_ = DynamicsOf<S, Law>::make();
};

}  // namespace landing
