// SPDX-License-Identifier: MIT
// State and inertia of all bodies (grains and walls), in one array per quantity. A wall is a body
// whose inverse mass is zero along some or all axes.
#pragma once

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>

#include "moreau/core/ids.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/value.hpp"
#include "moreau/motion/mobility.hpp"

namespace moreau {

/// The inverse square root I^-1/2 of an inertia tensor I, in the axes of I, A x A [kg^-1/2 m^-1].
/// @param inertia  symmetric and positive definite [kg m^2]
template <class S>
typename S::Inertia inverse_root(const typename S::Inertia& inertia) {
  using Inertia = typename S::Inertia;
  const Eigen::SelfAdjointEigenSolver<Inertia> solver(inertia);
  const Inertia& axes = solver.eigenvectors();
  Inertia scaled;
  for (int k = 0; k < S::angular_dim; ++k) {
    const auto root = std::sqrt(1 / solver.eigenvalues()[k]);
    for (int i = 0; i < S::angular_dim; ++i) scaled(i, k) = axes(i, k) * root;
  }
  return product_with_transposed(scaled, axes);
}

/// All bodies of a simulation. Element i of each array belongs to the body whose BodyId::index() is
/// i. Indices are not checked.
template <class S>
struct Bodies {
  using Vector = typename S::Vector;
  using Inertia = typename S::Inertia;
  using Twist = typename S::Twist;

  /// Position of the centre of mass [m], and rotation from body to world axes.
  List<Pose<S>> pose;
  List<Twist> velocity;  ///< twist (v, w), world axes [m/s, rad/s]
  List<Twist> force;     ///< applied (force, torque about the centre of mass), without
                         ///< gravity and contacts, world axes [N, N m]
  /// Along each axis of the body [1/kg]; 0 if the motion along the axis is prescribed.
  List<Vector> inverse_mass;
  /// About the centre of mass, body axes [kg m^2]; 0 for walls. A grain keeps it while its motion is
  /// prescribed.
  List<Inertia> inertia_body;
  /// I^-1/2, body axes [kg^-1/2 m^-1]; 0 if the rotation is prescribed.
  List<Inertia> inverse_inertia_root_body;
  /// The mass on which gravity acts [kg]: that of a grain, also while its motion is prescribed; 0 for
  /// walls, also for a wall with a mass along its normal.
  List<typename S::Scalar> grain_mass;
  List<MaterialId> material;  ///< material of the surface
  /// The id of the body. If its generation is odd, the element belongs to no body: its grain was
  /// removed, and it will be the element of a body that is added later. Until then it is at rest and
  /// has zero mass.
  List<BodyId> id;

  /// Number of elements of each array: bodies, and elements of removed grains that no later body has
  /// taken.
  std::size_t size() const { return pose.size(); }
  /// Adds a body at rest with zero inverse mass and inertia, which no force moves. set_mass() turns
  /// it into a grain.
  void push_back(const Pose<S>& at, MaterialId of) {
    pose.push_back(at);
    velocity.push_back(Twist::Zero());
    force.push_back(Twist::Zero());
    inverse_mass.push_back(Vector::Zero());
    inertia_body.push_back(Inertia::Zero());
    inverse_inertia_root_body.push_back(Inertia::Zero());
    grain_mass.push_back(0);
    material.push_back(of);
    id.push_back(BodyId(id.size()));
  }
  /// Gives element i, whose body was removed, to a new body like that of push_back().
  void reuse(std::size_t i, const Pose<S>& at, MaterialId of) {
    pose[i] = at;
    material[i] = of;
    ++id[i].generation;
  }
  /// Removes body i: element i keeps the pose, and belongs to no body until reuse().
  void remove(std::size_t i) {
    velocity[i].setZero();
    force[i].setZero();
    inverse_mass[i].setZero();
    inertia_body[i].setZero();
    inverse_inertia_root_body[i].setZero();
    grain_mass[i] = 0;
    ++id[i].generation;
  }
  /// Turns body i into a grain: a body that forces move along all axes. Arguments are not checked.
  /// @param mass    [kg], > 0
  /// @param inertia about the centre of mass, body axes [kg m^2], positive definite
  void set_mass(std::size_t i, typename S::Scalar mass, const Inertia& inertia) {
    inverse_mass[i] = Vector::Constant(1 / mass);
    inertia_body[i] = inertia;
    inverse_inertia_root_body[i] = inverse_root<S>(inertia);
    grain_mass[i] = mass;
  }
  /// Makes grain i move at its velocity alone: neither forces nor impulses change it. set_mass() with
  /// grain_mass[i] and inertia_body[i] is the inverse.
  void prescribe_motion(std::size_t i) {
    inverse_mass[i].setZero();
    inverse_inertia_root_body[i].setZero();
  }
  /// Whether all arrays have the same size and all indices of materials are smaller than
  /// `materials`.
  bool are_valid(std::size_t materials) const {
    for (const std::size_t count :
         {velocity.size(), force.size(), inverse_mass.size(), inertia_body.size(),
          inverse_inertia_root_body.size(), grain_mass.size(), material.size(), id.size()})
      if (count != size()) return false;
    for (std::size_t i = 0; i < size(); ++i)
      if (id[i].index() != i) return false;
    return std::all_of(material.begin(), material.end(),
                       [&](MaterialId one) { return one.index() < materials; });
  }
  /// Whether torques change the angular velocity of body i.
  bool rotates(std::size_t i) const { return inverse_inertia_root_body[i](0, 0) > 0; }
  /// Whether neither forces nor impulses change the velocity of body i, along any axis.
  bool is_prescribed(std::size_t i) const { return !rotates(i) && inverse_mass[i].isZero(0); }
  /// Whether element i belongs to a body, not to a grain that was removed.
  bool exists(std::size_t i) const { return id[i].generation % 2 == 0; }

  /// The axes of body i as the columns of a D x D matrix: unit vectors in world axes.
  Value<typename S::Matrix> axes(std::size_t i) const {
    return pose[i].rotation.toRotationMatrix();
  }
  /// The inertia of body i about its centre of mass, in world axes, A x A [kg m^2], if its rotation
  /// from body to world axes is q.
  Value<Inertia> inertia(std::size_t i, const typename S::Rotation& q) const {
    const Inertia a = S::adjoint(q);
    return product_with_transposed(matrix_product(a, inertia_body[i]), a);
  }
  /// M^-1/2 of body i in world axes, at its present rotation. M is the mass matrix.
  MobilityRoot<S> mobility_root(std::size_t i) const {
    typename S::Matrix r = axes(i), linear;
    const Inertia a = S::adjoint(pose[i].rotation),
                  turned = matrix_product(a, inverse_inertia_root_body[i]);
    for (int row = 0; row < S::dim; ++row)
      for (int column = 0; column < S::dim; ++column) {
        linear(row, column) = 0;
        for (int k = 0; k < S::dim; ++k)
          linear(row, column) += r(row, k) * std::sqrt(inverse_mass[i][k]) * r(column, k);
      }
    return {linear, product_with_transposed(turned, a), grain_mass[i] > 0};
  }

  /// See core/serialize.hpp.
  auto serialized_members() {
    return std::tie(pose, velocity, force, inverse_mass, inertia_body, inverse_inertia_root_body,
                    grain_mass, material, id);
  }
};

}  // namespace moreau
