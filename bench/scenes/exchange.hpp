// SPDX-License-Identifier: MIT
// Files: states, and what goes to and comes from the programs of other libraries (bench/peers/engines).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "scene.hpp"

namespace scenes {

template <class T>
Eigen::Matrix<T, 1, 1> coordinates(const Eigen::Rotation2D<T>& rotation) {
  return Eigen::Matrix<T, 1, 1>(rotation.angle());
}
template <class T>
Eigen::Matrix<T, 4, 1> coordinates(const Eigen::Quaternion<T>& rotation) {
  return rotation.coeffs();
}
template <class T>
Eigen::Rotation2D<T> rotation_of(Space<2, T>, const Eigen::Matrix<T, 1, 1>& x) {
  return Eigen::Rotation2D<T>(x[0]);
}
template <class T>
Eigen::Quaternion<T> rotation_of(Space<3, T>, const Eigen::Matrix<T, 4, 1>& x) {
  return Eigen::Quaternion<T>(x).normalized();
}

/// Poses and velocities of all bodies in a file that every version of the library can read. The
/// impulses of the contacts are not in it: the first steps after it need more sweeps.
template <class World>
class StateFile {
 public:
  using S = typename World::S;
  explicit StateFile(const std::filesystem::path& path) : path_(path) {}

  void write(const World& world) const {
    std::ofstream file(path_);
    file.precision(17);
    for (std::size_t i = 0; i < world.bodies().size(); ++i) {
      const Pose<S>& pose = world.bodies().pose[i];
      file << pose.position.transpose() << ' ' << coordinates(pose.rotation).transpose() << ' '
           << world.bodies().velocity[i].transpose() << '\n';
    }
    if (!file) throw std::runtime_error("cannot write " + path_.string());
  }
  /// @returns whether the file exists
  bool read(World& world) const {
    std::ifstream file(path_);
    if (!file) return false;
    world.allow_overlaps();
    for (std::size_t i = 0; i < world.bodies().size(); ++i) {
      const BodyId body = world.bodies().id[i];
      Pose<S> pose;
      typename S::Twist velocity;
      auto rotation = coordinates(pose.rotation);
      for (auto& x : pose.position) file >> x;
      for (auto& x : rotation) file >> x;
      for (auto& x : velocity) file >> x;
      pose.rotation = rotation_of(S{}, rotation);
      world.set_pose(body, pose);
      if (!world.bodies().is_prescribed(i) || !velocity.isZero(0)) {
        world.set_velocity(body, typename S::Vector(velocity.template head<S::dim>()));
        world.set_spin(body, typename S::Angular(velocity.template tail<S::dofs - S::dim>()));
      }
    }
    if (!file) throw std::runtime_error(path_.string() + " is not of this scene");
    return true;
  }

 private:
  std::filesystem::path path_;
};

/// Writes what another library needs to build a scene of convex grains with a density of 1000 between fixed walls:
/// dimension, gravity, step, friction, steps before and of the measurement; shapes with their corners; walls with a
/// point and the normal; grains with their shape, position and rotation (x y z w, in the plane the angle).
template <class ShapeT>
void describe(const Scene<ShapeT>& scene, const std::filesystem::path& path) {
  using S = typename Scene<ShapeT>::S;
  const auto& world = *scene.world;
  if constexpr (requires(const ShapeT& shape) { shape.vertices(); }) {
    if (scene.drive || !world.mesh_walls().empty())
      throw std::invalid_argument("this scene has more than grains and fixed walls");
    std::ofstream file(path);
    file.precision(17);
    file << S::dim << ' ' << world.gravity()[S::dim - 1] << ' ' << scene.step << ' '
         << world.materials().laws().front().friction() << ' ' << scene.settle << ' ' << scene.steps
         << '\n';
    // Grains that share a shape have equal corners.
    std::vector<std::size_t> shape_of, first;
    for (std::size_t k = 0; k < world.grain_count(); ++k) {
      std::size_t kind = 0;
      while (kind < first.size() &&
             world.shape_of_grain(k).vertices() != world.shape_of_grain(first[kind]).vertices())
        ++kind;
      if (kind == first.size()) first.push_back(k);
      shape_of.push_back(kind);
    }
    file << first.size() << '\n';
    for (const std::size_t k : first) {
      const auto& corners = world.shape_of_grain(k).vertices();
      file << corners.rows() << '\n' << corners << '\n';
    }
    file << world.walls().size() << '\n';
    for (const BodyId wall : world.walls()) {
      const Pose<S>& pose = world.pose(wall);
      file << pose.position.transpose() << ' '
           << (pose.rotation * S::Vector::UnitX()).eval().transpose() << '\n';
    }
    file << world.grain_count() << '\n';
    const auto grains = world.grains();
    for (std::size_t k = 0; k < shape_of.size(); ++k) {
      const Pose<S>& pose = world.pose(grains[k]);
      file << shape_of[k] << ' ' << pose.position.transpose() << ' '
           << coordinates(pose.rotation).transpose() << '\n';
    }
    if (!file) throw std::runtime_error("cannot write " + path.string());
  } else {
    throw std::invalid_argument("the grains of this scene are not convex polyhedra or polygons");
  }
}

/// Positions and rotations of the grains, frame by frame, in a file that the programs of other libraries write, too.
template <class World>
class PosesFile {
 public:
  explicit PosesFile(const std::filesystem::path& path) {
    if (!path.empty()) file_.open(path);
    file_.precision(17);
  }
  void write(const World& world) {
    if (!file_.is_open()) return;
    for (const BodyId grain : world.grains()) {
      const auto& pose = world.pose(grain);
      file_ << pose.position.transpose() << ' ' << coordinates(pose.rotation).transpose() << '\n';
    }
  }

 private:
  std::ofstream file_;
};

/// Prints the overlaps of the poses in a file, of whatever program: the exact contacts of this library judge all.
template <class ShapeT>
void print_overlaps(Scene<ShapeT>& scene, const std::filesystem::path& path) {
  using S = typename Scene<ShapeT>::S;
  auto& world = *scene.world;
  const double size = double(world.grain_size());
  std::ifstream file(path);
  world.allow_overlaps();
  world.set_gravity(S::Vector::Zero());
  double sum = 0, largest = 0, pairs = 0, lost = 0;
  const std::vector<BodyId> grains(world.grains().begin(), world.grains().end());
  for (int frame = 0;; ++frame) {
    std::vector<Pose<S>> poses(grains.size());
    for (Pose<S>& pose : poses) {
      auto rotation = coordinates(pose.rotation);
      for (auto& x : pose.position) file >> x;
      for (auto& x : rotation) file >> x;
      pose.rotation = rotation_of(S{}, rotation);
    }
    if (!file && frame == 0) throw std::runtime_error(path.string() + " is not of this scene");
    if (!file) {
      std::printf("frames %d, overlapping pairs %.0f, mean overlap %.2e, largest %.2e, lost %.0f\n",
                  frame, pairs / frame, sum / std::max(1.0, pairs), largest, lost / frame);
      return;
    }
    for (std::size_t k = 0; k < grains.size(); ++k) {
      if (poses[k].position[S::dim - 1] < 0) ++lost;  // all scenes have their floor at 0
      world.set_pose(grains[k], poses[k]);
      world.set_velocity(grains[k], S::Vector::Zero());
      world.set_spin(grains[k], S::Angular::Zero());
    }
    world.step(static_cast<typename S::Scalar>(1e-9));
    const auto& contacts = world.contacts();
    for (std::size_t c = 0; c < contacts.size();) {
      const auto pair = contacts.keys[c].bodies();
      double depth = 0;
      for (; c < contacts.size() && contacts.keys[c].bodies() == pair; ++c)
        depth = std::max(depth, double(-contacts.points[c].gap) / size);
      if (depth > 0) sum += depth, ++pairs, largest = std::max(largest, depth);
    }
  }
}

}  // namespace scenes
