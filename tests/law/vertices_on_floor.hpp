// SPDX-License-Identifier: MIT
// One grain on a floor, with a contact at each vertex near the floor: what Simulation does in a step, without
// detection. A floor touches polytopes at their vertices, so a simulation finds the same contacts. It compiles
// in a fraction of the time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/law/materials.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/motion/moreau_jean.hpp"
#include "moreau/motion/velocity_verlet.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"
#include "moreau/world/detail/force_dynamics.hpp"
#include "moreau/world/detail/impulse_dynamics.hpp"

namespace landing {

using namespace moreau;

/// A grain as its mass and its vertices about the centre of mass, body axes [m].
template <class S>
struct Grain {
  std::string name;
  typename S::Scalar mass = 0;                           // [kg]
  typename S::Inertia inertia = S::Inertia::Identity();  // body axes [kg m^2]
  std::vector<typename S::Vector> vertices;

  /// The least height of a vertex over the centre, turned by q [m].
  double lowest(const typename S::Rotation& q) const {
    double low = std::numeric_limits<double>::infinity();
    for (const auto& x : vertices) low = std::min(low, double((q * x)[S::dim - 1]));
    return low;
  }
};

/// The grain of convex parts that do not overlap.
template <class Part>
auto grain_of(const char* name, const std::vector<Part>& parts) {
  using S = SpaceOf<Part>;
  Grain<S> grain;
  grain.name = name;
  typename S::Vector center = S::Vector::Zero();
  for (const Part& part : parts) {
    const auto of = part.mass_properties(S::dim == 3 ? 1000 : 20);
    grain.mass += of.mass;
    center += of.mass * of.center;
  }
  center /= grain.mass;
  grain.inertia.setZero();
  for (const Part& part : parts) {
    const auto of = part.mass_properties(S::dim == 3 ? 1000 : 20);
    const typename S::Lever arm = S::lever(of.center - center);
    grain.inertia += of.inertia + of.mass * arm.transpose() * arm;
    for (Eigen::Index i = 0; i < part.vertices().rows(); ++i)
      grain.vertices.push_back(part.vertices().row(i).transpose() - center);
  }
  return grain;
}

template <class Part>
Part hull(const std::vector<typename SpaceOf<Part>::Vector>& points) {
  return Part(std::span<const typename SpaceOf<Part>::Vector>(points));
}

/// A box between two corners.
template <class Part>
Part box(const typename SpaceOf<Part>::Vector& low, const typename SpaceOf<Part>::Vector& high) {
  constexpr int dim = SpaceOf<Part>::dim;
  std::vector<typename SpaceOf<Part>::Vector> corners;
  for (unsigned bits = 0; bits < 1u << dim; ++bits) {
    corners.push_back(low);
    for (int k = 0; k < dim; ++k)
      if ((bits >> k & 1u) != 0) corners.back()[k] = high[k];
  }
  return hull<Part>(corners);
}

/// Points on a circle of radius r [m] in the first two axes.
inline std::vector<Eigen::Vector2d> circle(int n, double r) {
  std::vector<Eigen::Vector2d> points;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.5) / n;
    points.emplace_back(r * std::sin(angle), -r * std::cos(angle));
  }
  return points;
}

inline Polyhedron<double> prism(int n, double r, double half) {
  std::vector<Eigen::Vector3d> points;
  for (const auto& x : circle(n, r))
    for (const double z : {-half, half}) points.emplace_back(x[0], x[1], z);
  return hull<Polyhedron<double>>(points);
}

/// Grains whose lowest face lies below the centre of mass. The last ones are concave.
inline std::vector<Grain<Space<3>>> flat_grains(Space<3>) {
  using P = Polyhedron<double>;
  using V = Eigen::Vector3d;
  std::vector<Grain<Space<3>>> grains;
  const double a = 0.01;
  const auto cuboid = [&](double x, double y, double z) {
    return box<P>(V(-x, -y, -z), V(x, y, z));
  };
  grains.push_back(grain_of<P>("cube", {cuboid(a, a, a)}));
  for (const int n : {3, 6, 20}) grains.push_back(grain_of<P>("prism", {prism(n, a, 0.7 * a)}));
  grains.push_back(grain_of<P>("plate", {cuboid(a, 0.8 * a, a / 6)}));
  grains.push_back(grain_of<P>("rod upright", {cuboid(a / 5, a / 5, a)}));
  grains.push_back(grain_of<P>("rod", {cuboid(a, a / 5, a / 5)}));
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 3;
       ++trial) {  // random points, turned by half turns about the vertical
    std::vector<V> points;
    for (int k = 0; k < 4 + 3 * trial; ++k) {
      const V x = a * V(normal(random), normal(random), normal(random)).normalized();
      points.insert(points.end(), {x, V(-x[0], -x[1], x[2])});
    }
    for (const auto& x : circle(2 + 2 * trial, a)) points.emplace_back(x[0], 0.6 * x[1], -1.1 * a);
    grains.push_back(grain_of<P>("hull", {hull<P>(points)}));
  }
  std::vector<P> eight, table{box<P>(V(-a, -a, 0), V(a, a, a / 3))};
  for (int k = 0; k < 8; ++k) {
    const V low((k & 1) != 0 ? 0 : -a, (k & 2) != 0 ? 0 : -a, (k & 4) != 0 ? 0 : -a);
    eight.push_back(box<P>(low, low + V(a, a, a)));
    const V leg((k & 1) != 0 ? 0.6 * a : -a, (k & 2) != 0 ? 0.6 * a : -a, -a);
    if (k < 4) table.push_back(box<P>(leg, leg + V(0.4 * a, 0.4 * a, a)));
  }
  grains.push_back(grain_of<P>("cube of eight parts", eight));
  grains.push_back(grain_of<P>("table", table));
  return grains;
}
inline std::vector<Grain<Space<2>>> flat_grains(Space<2>) {
  using P = Polygon<double>;
  using V = Eigen::Vector2d;
  std::vector<Grain<Space<2>>> grains;
  const double a = 0.01;
  const auto cuboid = [&](double x, double y) { return box<P>(V(-x, -y), V(x, y)); };
  grains.push_back(grain_of<P>("square", {cuboid(a, a)}));
  for (const int n : {3, 6, 20})
    grains.push_back(grain_of<P>("regular polygon", {hull<P>(circle(n, a))}));
  grains.push_back(grain_of<P>("rod", {cuboid(a, a / 5)}));
  grains.push_back(grain_of<P>("rod upright", {cuboid(a / 5, a)}));
  grains.push_back(
      grain_of<P>("square of two parts", {box<P>(V(-a, -a), V(0, a)), box<P>(V(0, -a), V(a, a))}));
  grains.push_back(
      grain_of<P>("table", {box<P>(V(-a, 0), V(a, a)), box<P>(V(-a, -a), V(-0.6 * a, 0)),
                            box<P>(V(0.6 * a, -a), V(a, 0))}));
  return grains;
}

template <class S, class Law>
struct DynamicsOf {
  using type = detail::ImpulseDynamics<S, Law, MoreauJean, NonlinearGaussSeidel>;
  static type make() {
    GaussSeidelOptions options;
    options.tolerance = 1e-10;
    return type(NonlinearGaussSeidel(options), type::default_correction(), MoreauJean());
  }
};
template <class S, class Law>
requires RegularizedLaw<Law, S>
struct DynamicsOf<S, Law> {
  using type = detail::ForceDynamics<S, Law, VelocityVerlet>;
  static type make() { return type(); }
};

/// Two bodies and the contacts between them, which the caller detects.
template <class S, class Law>
class TwoBodies {
 public:
  using Vector = typename S::Vector;
  using Twist = typename S::Twist;
  static constexpr double margin = 4e-4;  ///< [m]

  Bodies<S> bodies;
  Vector gravity = Vector::Zero();
  Contacts<S> contacts, previous;
  StepReport report;
  double time = 0;  ///< [s]

  bool touches() const {
    return std::any_of(contacts.impulses.begin(), contacts.impulses.end(),
                       [](const Vector& r) { return r[0] > 0; });
  }
  double kinetic_energy_of(std::size_t i) const {  ///< [J]
    const auto w = angular<S>(bodies.velocity[i]);
    return (bodies.grain_mass[i] * linear<S>(bodies.velocity[i]).squaredNorm() +
            w.dot(bodies.inertia(i, bodies.pose[i].rotation) * w)) /
           2;
  }

 protected:
  explicit TwoBodies(const Law& law) : materials_(1, law) {}

  /// @param find adds the contacts of the poses by add()
  void step(double h, const auto& find) {
    const detail::StepContext<S, Law> context{bodies,   gravity, materials_, previous,
                                              contacts, 0.02,    h,          margin};
    const auto detect = [&] {
      std::swap(contacts, previous);
      contacts.clear();
      find();
    };
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
      dynamics_.predict_configuration(bodies, h);
      detect();
      dynamics_.find_free_velocities(context, report);
      dynamics_.solve_contacts(context, report);
      dynamics_.finish(context, report);
    }
    time += h;
  }
  /// @param normal from body 0 to body 1, world axes
  /// @param lever_a,lever_b from the centres of the bodies to the point, world axes [m]
  void add(double gap, const Vector& normal, const Vector& lever_a, const Vector& lever_b,
           FeatureKey feature, ContactClass its_class) {
    contacts.points.push_back({0, 1, 0, gap, S::contact_frame(normal), lever_a, lever_b});
    contacts.keys.push_back({0, 1, feature});
    contacts.classes.push_back(its_class);
    contacts.impulses.push_back(Vector::Zero());
  }

 private:
  Materials<Law> materials_;
  typename DynamicsOf<S, Law>::type dynamics_ = DynamicsOf<S, Law>::make();
};

template <class S, class Law>
class OnFloor : public TwoBodies<S, Law> {  // body 0 is the floor, body 1 the grain
 public:
  using Base = TwoBodies<S, Law>;
  using Base::bodies;
  using typename Base::Twist;
  using typename Base::Vector;
  static constexpr int up = S::dim - 1;

  /// The grain turned by q, its lowest vertex at the height above the floor [m].
  OnFloor(const Grain<S>& grain, const Law& law, const typename S::Rotation& q, double height)
      : Base(law), grain_(grain) {
    Pose<S> pose;
    bodies.push_back(pose, MaterialId(0));
    pose.rotation = q;
    pose.position[up] = height - grain.lowest(q);
    bodies.push_back(pose, MaterialId(0));
    bodies.set_mass(1, grain.mass, grain.inertia);
  }
  Twist& velocity() { return bodies.velocity[1]; }
  double rise() const { return bodies.velocity[1][up]; }  // upward velocity of the centre [m/s]
  double kinetic_energy() const { return this->kinetic_energy_of(1); }
  /// Kinetic energy and that of gravity [J].
  double energy() const {
    return kinetic_energy() - grain_.mass * this->gravity.dot(bodies.pose[1].position);
  }
  void step(double h) {
    Base::step(h, [&] {
      const Pose<S>& pose = bodies.pose[1];
      for (std::size_t i = 0; i < grain_.vertices.size(); ++i) {
        const Vector lever_b = pose.rotation * grain_.vertices[i];
        const Vector lever_a = lever_b + pose.position - bodies.pose[0].position;
        if (lever_a[up] <= Base::margin)
          this->add(lever_a[up], Vector::Unit(up), lever_a, lever_b,
                    FeatureKey(FeatureKey::Kind::face_vertex, 0, i), ContactClass::vertex_face);
      }
    });
  }

 private:
  Grain<S> grain_;
};

/// Kinetic energy of a body of which the angular momentum is that at the end of the step, in the pose [J].
template <class S>
double energy_at(const Bodies<S>& bodies, std::size_t i, const typename S::Rotation& q,
                 const typename S::Twist& v, const typename S::Rotation& end) {
  const typename S::Angular momentum = bodies.inertia(i, end) * angular<S>(v);
  return (bodies.grain_mass[i] * linear<S>(v).squaredNorm() +
          momentum.dot(bodies.inertia(i, q).inverse() * momentum)) /
         2;
}

/// A step, and the kinetic energy that the impulses of the bodies from `first` on add in it, in the configuration in
/// which they act, also as the overlap correction turns it: that the inertia turns before and after changes the
/// energy by (h w)^2.
template <class S>
double gain_of_step(auto& world, std::size_t first, double h) {
  const Bodies<S> before = world.bodies;
  world.step(h);
  const Bodies<S>& after = world.bodies;
  const auto energy = [](const Bodies<S>& bodies, std::size_t i, double time) {
    Pose<S> middle = bodies.pose[i];
    advance_pose<S>(middle, bodies.velocity[i], time);
    return energy_at<S>(bodies, i, middle.rotation, bodies.velocity[i], bodies.pose[i].rotation);
  };
  double gain = 0;
  for (std::size_t i = first; i < before.size(); ++i)
    gain += energy(after, i, -h / 2) - energy(before, i, h / 2);
  return gain;
}

}  // namespace landing
