// SPDX-License-Identifier: MIT
// State and inertia of all bodies, grains and walls, in one array per field. A wall is a body with
// zero inverse mass along some or all axes.
#pragma once

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "moreau/body/mobility.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/pose.hpp"

namespace moreau {

/// I^-1/2, A x A [kg^-1/2 m^-1], of a symmetric positive definite inertia [kg m^2], in the same
/// axes.
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
  return scaled * axes.transpose();
}

/// All bodies of a simulation; entry i of every array is of body i, BodyId::index(). Indices are
/// not checked.
template <class S>
struct Bodies {
  using Vector = typename S::Vector;
  using Inertia = typename S::Inertia;
  using Twist = typename S::Twist;

  std::vector<Pose<S>> pose;          ///< of the centre of mass and the body's axes [m]
  std::vector<Twist> velocity;        ///< (v, w) in world axes [m/s, rad/s]
  std::vector<Twist> force;           ///< external (force, torque) in world axes [N, N m]
  std::vector<Vector> inverse_mass;   ///< along the axes of the body; 0: prescribed motion [1/kg]
  std::vector<Inertia> inertia_body;  ///< about the centre, body axes [kg m^2]; 0: prescribed
  /// I^-1/2, body axes [kg^-1/2 m^-1]; 0: prescribed rotation.
  std::vector<Inertia> inverse_inertia_root_body;
  std::vector<typename S::Scalar> weight;  ///< mass that gravity acts on, 0 for walls [kg]
  std::vector<MaterialId> material;        ///< of the surface

  std::size_t size() const { return pose.size(); }  ///< grains and walls
  /// Adds a body at rest that no force moves. set_mass() makes it a grain.
  void push_back(const Pose<S>& at, MaterialId of) {
    pose.push_back(at);
    velocity.push_back(Twist::Zero());
    force.push_back(Twist::Zero());
    inverse_mass.push_back(Vector::Zero());
    inertia_body.push_back(Inertia::Zero());
    inverse_inertia_root_body.push_back(Inertia::Zero());
    weight.push_back(0);
    material.push_back(of);
  }
  /// Makes body i a free body. The arguments are not checked.
  /// @param mass    [kg], > 0
  /// @param inertia about the centre, body axes [kg m^2], positive definite
  void set_mass(std::size_t i, typename S::Scalar mass, const Inertia& inertia) {
    inverse_mass[i] = Vector::Constant(1 / mass);
    inertia_body[i] = inertia;
    inverse_inertia_root_body[i] = inverse_root<S>(inertia);
    weight[i] = mass;
  }
  /// Whether all arrays have one size and all materials are below this number.
  bool are_valid(std::size_t materials) const {
    for (const std::size_t count :
         {velocity.size(), force.size(), inverse_mass.size(), inertia_body.size(),
          inverse_inertia_root_body.size(), weight.size(), material.size()})
      if (count != size()) return false;
    return std::all_of(material.begin(), material.end(),
                       [&](MaterialId one) { return one.index() < materials; });
  }
  /// Whether torques change the angular velocity of body i.
  bool rotates(std::size_t i) const { return inertia_body[i](0, 0) > 0; }

  /// D x D, the axes of body i as columns: unit vectors, world axes.
  typename S::Matrix axes(std::size_t i) const { return pose[i].rotation.toRotationMatrix(); }
  /// A x A, inertia about the centre in world axes at the rotation q from body to world [kg m^2].
  Inertia inertia(std::size_t i, const typename S::Rotation& q) const {
    const Inertia a = S::adjoint(q), turned = a * inertia_body[i];
    return turned * a.transpose();
  }
  /// M^-1/2 of body i in world axes, at its present rotation.
  MobilityRoot<S> mobility_root(std::size_t i) const {
    typename S::Matrix r = axes(i), linear;
    const Inertia a = S::adjoint(pose[i].rotation), turned = a * inverse_inertia_root_body[i];
    for (int row = 0; row < S::dim; ++row)
      for (int column = 0; column < S::dim; ++column) {
        linear(row, column) = 0;
        for (int k = 0; k < S::dim; ++k)
          linear(row, column) += r(row, k) * std::sqrt(inverse_mass[i][k]) * r(column, k);
      }
    return {linear, turned * a.transpose()};
  }
};

}  // namespace moreau
