// SPDX-License-Identifier: MIT
// A source: a box in which grains are added where there is room. The program applies it before each
// step:
//
//   moreau::SourceOptions<S> options;
//   options.region = {{0, 0.5}, {0.1, 0.6}};
//   options.shapes = {shape};
//   options.density = 2700;
//   options.rate = 200;
//   moreau::Source<S> source(options);
//   for (...) { source.apply(world, h); world.step(h); }
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <tuple>
#include <vector>

#include "moreau/boundary/detail/point_grid.hpp"
#include "moreau/boundary/sink.hpp"
#include "moreau/core/aabb.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/neighbour_cells.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/space.hpp"
#include "moreau/detect/pairs/behind_facet.hpp"
#include "moreau/sample/random_rotation.hpp"
#include "moreau/shape/circumradius.hpp"

namespace moreau {

/// Where a source adds grains, which, and how many.
template <EuclideanSpace S>
struct SourceOptions {
  /// The box that contains the new grains, world axes [m]; along every axis at least as long as the
  /// circumdiameter of each shape.
  Aabb<S> region;
  /// Drawn at random, each with the same probability. A shape that finds no room is the next that is added: grains that
  /// need more room are not left out.
  std::vector<ShapeId> shapes;
  typename S::Scalar density = 0;       ///< [kg/m^3], in the plane [kg/m^2], > 0
  MaterialId material = MaterialId(0);  ///< of the surface
  typename S::Vector velocity =
      S::Vector::Zero();  ///< of new grains, world axes [m/s]; relative to a cell that deforms
  /// Grains per second [1/s], > 0; infinite: as many as find room.
  double rate = std::numeric_limits<double>::infinity();
  /// The number of grains in the simulation up to which grains are added. Obstacles, grains of prescribed motion, do not
  /// count.
  std::size_t grain_limit = std::numeric_limits<std::size_t>::max();
  int trials = 20;         ///< random places and rotations that are tried for each grain, >= 1
  std::uint64_t seed = 1;  ///< of the random numbers
};

/// Adds grains at random places in a box, with random rotations and a given velocity, at a given rate
/// or up to a given number of grains. A new grain overlaps no grain and no wall: its bounding box, or
/// the ball of its circumradius, is apart from the bounding box, or the ball, of each other body. None is
/// placed inside of the solid that a closed mesh wall with one side bounds.
///
/// The same seed gives the same grains. Snapshots can contain a source: it then continues with the
/// same random numbers. The options are not part of a snapshot.
template <EuclideanSpace S>
class [[gnu::warn_unused]] Source {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// @throws std::invalid_argument for a region that is not finite or has no extent, no shapes, a
  ///         velocity that is not finite, a rate that is not positive, a rate and a limit that are both
  ///         infinite, or fewer than one trial
  explicit Source(const SourceOptions<S>& options) : options_(options), random_(options.seed) {
    constexpr const char* self = "Source";
    const Aabb<S>& region = options.region;
    require(all_finite(region.lower) && all_finite(region.upper) &&
                (region.lower.array() < region.upper.array()).all(),
            self, "region.lower", region.lower, "must be finite and below region.upper");
    require(!options.shapes.empty(), self, "shapes.size()", options.shapes.size(), "must be > 0");
    require(all_finite(options.velocity), self, "velocity", options.velocity, "must be finite");
    require(options.rate > 0, self, "rate", options.rate, "must be > 0");
    require(std::isfinite(options.rate) ||
                options.grain_limit < std::numeric_limits<std::size_t>::max(),
            self, "rate", options.rate, "must be finite if there is no grain_limit");
    require(options.trials >= 1, self, "trials", options.trials, "must be at least 1");
  }

  /// Adds the grains that are due: rate x step, up to the limit, as many as find room. Grains that do
  /// not find room are added by later calls (waiting()).
  /// @param simulation a Simulation in the space S
  /// @param step       length of the next step [s], > 0
  /// @returns number and mass of the grains that were added
  /// @throws std::invalid_argument for a step that is not finite or not positive, a shape that is
  ///         longer than the region, and as Simulation::add_grain()
  template <class Simulation>
  GrainSum apply(Simulation& simulation, Scalar step) {
    require_positive(step, "Source::apply", "step");
    GrainSum now;
    added_.clear();
    require_room(simulation);
    due_ += options_.rate * double(step);
    // Free grains are counted, one by one, only in steps that may add one or where the sum with the obstacles reaches the limit.
    const std::size_t limit = options_.grain_limit;
    std::size_t count = simulation.grain_count();
    if (count >= limit || due_ >= 1) count = free_grains(simulation);
    if (count >= limit) due_ = std::min(due_, 1.0);
    if (due_ < 1 || count >= limit) return now;
    find_obstacles(simulation);
    for (; due_ >= 1 && count < limit && add(simulation); ++count) {
      due_ -= 1;
      const auto mass = double(simulation.bodies().grain_mass[added_.back().index()]);
      for (GrainSum* sum : {&now, &total_}) {  // also if the next grain throws
        ++sum->count;
        sum->mass += mass;
      }
    }
    return now;
  }

  std::span<const BodyId> added() const { return added_; }  ///< by the last apply()
  const GrainSum& total() const { return total_; }          ///< what all calls of apply() added
  /// Number of grains that are due and have not found room; infinite for an infinite rate. While the
  /// limit is reached it does not grow above one.
  double waiting() const { return std::floor(due_); }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(random_, due_, total_, next_); }

  /// A grain that may be in the way, bounded by its box and by the ball of its circumradius.
  struct Obstacle {
    Aabb<S> box;
    Vector center;
    Scalar radius;
  };

  void require_room(const auto& simulation) const {
    const Vector length = options_.region.upper - options_.region.lower;
    for (const ShapeId shape : options_.shapes)
      require(2 * circumradius(simulation.shape(shape)) <= length.minCoeff(), "Source::apply",
              "shape", shape, "must have a circumdiameter of at most the length of the region");
  }
  static std::size_t free_grains(const auto& simulation) {
    const auto grains = simulation.grains();
    return static_cast<std::size_t>(std::count_if(grains.begin(), grains.end(), [&](BodyId grain) {
      return !simulation.bodies().is_prescribed(grain.index());
    }));
  }
  /// Collects the grains that a new grain could overlap: in a periodic cell all grains.
  void find_obstacles(const auto& simulation) {
    obstacles_.clear();
    large_.clear();
    Scalar widest = 0;
    for (const ShapeId shape : options_.shapes)
      widest = std::max(widest, circumradius(simulation.shape(shape)));
    most_ = 4 * widest;
    grid_.start(widest + most_);
    for (const BodyId grain : simulation.grains()) {
      const auto& shape = simulation.shape(grain);
      const Pose<S>& pose = simulation.pose(grain);
      const Obstacle obstacle{shape.bounding_box(pose), pose.position, circumradius(shape)};
      if (!simulation.cell().is_open() || options_.region.overlaps(obstacle.box))
        add_obstacle(simulation, obstacle);
    }
  }
  void add_obstacle(const auto& simulation, const Obstacle& obstacle) {
    const auto number = static_cast<std::uint32_t>(obstacles_.size());
    obstacles_.push_back(obstacle);
    if (!(obstacle.radius <= most_)) large_.push_back(number);
    grid_.add(simulation.cell().wrap(obstacle.center));
  }
  /// Adds a grain if there is room for it at one of the places that are tried.
  bool add(auto& simulation) {
    std::uniform_int_distribution<std::size_t> draw(0, options_.shapes.size() - 1);
    std::uniform_real_distribution<Scalar> unit(0, 1);
    // The shape that found no room comes first. If another one were drawn, the source would prefer small grains.
    if (next_ >= options_.shapes.size()) next_ = draw(random_);
    const ShapeId id = options_.shapes[next_];
    const auto& shape = simulation.shape(id);
    for (int trial = 0; trial < options_.trials; ++trial) {
      Pose<S> pose(Vector::Zero(), random_rotation<S>(random_));
      const Aabb<S> own = shape.bounding_box(pose);
      for (int k = 0; k < S::dim; ++k) {
        const Scalar lower = options_.region.lower[k] - own.lower[k];
        const Scalar upper = options_.region.upper[k] - own.upper[k];
        pose.position[k] = lower + unit(random_) * std::max(Scalar(0), upper - lower);
      }
      const Obstacle grain{shape.bounding_box(pose), pose.position, circumradius(shape)};
      if (overlaps_grain(simulation, grain) || overlaps_wall(simulation, grain)) continue;
      added_.push_back(simulation.add_grain(id, pose, options_.density, options_.material));
      simulation.set_velocity(added_.back(), options_.velocity);
      add_obstacle(simulation, grain);
      next_ = none;
      return true;
    }
    return false;
  }
  bool overlaps_grain(const auto& simulation, const Obstacle& grain) const {
    const auto overlaps = [&](std::uint32_t number) {
      const Obstacle& other = obstacles_[number];
      const Vector center = simulation.cell().nearest(other.center, grain.center);
      const Vector shift = center - other.center;
      const Aabb<S> box(other.box.lower + shift, other.box.upper + shift);
      return box.overlaps(grain.box) &&
             (center - grain.center).norm() < other.radius + grain.radius;
    };
    if (std::any_of(large_.begin(), large_.end(), overlaps)) return true;
    const auto& cell = simulation.cell();
    const Vector center = cell.wrap(grain.center);
    for (int k = 0; k < detail::neighbour_cells<S::dim>(); ++k) {
      const auto steps = detail::neighbour_cell<Vector>(k);
      if (cell.has_image(steps) && grid_.any_near(center + cell.shift(steps), overlaps))
        return true;
    }
    return false;
  }
  static bool overlaps_wall(const auto& simulation, const Obstacle& grain) {
    const Vector middle = (grain.box.lower + grain.box.upper) / 2;
    const Vector half = (grain.box.upper - grain.box.lower) / 2;
    for (const BodyId wall : simulation.walls()) {
      const Vector normal = simulation.bodies().axes(wall.index()).col(0);
      const Vector& point = simulation.pose(wall).position;
      if (normal.dot(middle - point) < normal.cwiseAbs().dot(half) &&
          normal.dot(grain.center - point) < grain.radius)
        return true;
    }
    for (const auto& cylinder : simulation.cylinders()) {
      const Pose<S>& pose = simulation.pose(cylinder.body);
      const typename S::Angular axis = cylinder.shape.axis_at(pose.rotation);
      const Vector radial = S::spin(axis, S::spin(axis, grain.center - pose.position));
      if (radial.norm() + grain.radius > cylinder.shape.radius()) return true;
    }
    for (const auto& mesh : simulation.mesh_walls()) {
      const Vector center = simulation.pose(mesh.body).to_body(grain.center);
      const Aabb<S> around = Aabb<S>(center, center).inflated(grain.radius);
      bool overlaps = false;
      mesh.shape.tree().query([&](const Aabb<S>& box) { return box.overlaps(around); },
                              [&](std::size_t k) {
                                const auto& side = mesh.shape.side(k);
                                const auto height = side.normal.dot(center) - side.offset;
                                overlaps = overlaps || std::abs(height) < grain.radius;
                              });
      if (overlaps || is_inside(mesh.shape, center)) return true;
    }
    return false;
  }

  /// Whether a point lies inside of the solid that a closed mesh with one side bounds, in its frame [m].
  static bool is_inside(const auto& wall, const Vector& x) {
    return wall.is_closed() && wall.sides() == WallSides::outside &&
           wall.tree().bounds().contains(x) &&
           detail::find_behind<S>(wall, x, std::numeric_limits<Scalar>::infinity(), Scalar(0)).is;
  }

  static constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();

  SourceOptions<S> options_;
  std::mt19937_64 random_;
  double due_ = 0;  // grains that are still to be added
  std::vector<BodyId> added_;
  std::vector<Obstacle> obstacles_;
  detail::PointGrid<S> grid_;         // of their centres, in the periodic cell
  std::vector<std::uint32_t> large_;  // those with a radius above most_
  Scalar most_ = 0;                   // [m]
  GrainSum total_;
  std::uint64_t next_ = none;  // index in options_.shapes of the shape that waits for room
};

}  // namespace moreau
