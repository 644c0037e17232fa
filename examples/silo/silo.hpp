// SPDX-License-Identifier: MIT
// A silo with a funnel that is a mesh wall: a cone of triangles in space, two segments in the plane. One
// template for all shapes in both dimensions.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <moreau/moreau.hpp>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "moreau/boundary/sink.hpp"
#include "moreau/picture/write_picture.hpp"
#include "moreau/sample/ballast.hpp"
#include "moreau/sample/compound_ballast.hpp"
#include "moreau/sample/random_deposition.hpp"

namespace silo {

using Law = moreau::SignoriniCoulomb<double>;

constexpr double size = 0.02, density = 2700, gravity = 9.81;  // of a grain [m], [kg/m^3], [m/s^2]
constexpr double friction = 0.4;                               // with grains and with walls [-]
constexpr double h = 5e-4;                                     // [s]
constexpr double longest = 3;                                  // filling [s]
constexpr double still = 1;  // an arch has formed if no grain leaves for so long [s]

/// A corner of the profile that is turned about the vertical axis.
struct ProfilePoint {
  double radius, height;  // [m]
};

/// The surface of revolution of a profile. Its outside faces the axis if the profile goes down towards
/// the axis. In the plane: the profile and its mirror image.
inline moreau::TriangleMesh<> revolved(const std::vector<ProfilePoint>& profile, moreau::Space<3>) {
  constexpr std::uint32_t count = 32;
  moreau::TriangleMesh<> mesh;
  for (const auto& [radius, height] : profile)
    for (std::uint32_t k = 0; k < count; ++k) {
      const double angle = 2 * std::numbers::pi * k / count;
      mesh.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), height});
    }
  for (std::uint32_t level = 0; level + 1 < profile.size(); ++level)
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t a = level * count + k, b = level * count + (k + 1) % count;
      mesh.facets.push_back({a, b, a + count});
      mesh.facets.push_back({b, b + count, a + count});
    }
  return mesh;
}
inline moreau::SegmentMesh<> revolved(const std::vector<ProfilePoint>& profile, moreau::Space<2>) {
  moreau::SegmentMesh<> mesh;
  for (const auto& [radius, height] : profile) {
    mesh.vertices.push_back({radius, height});
    mesh.vertices.push_back({-radius, height});
  }
  for (std::uint32_t k = 0; k + 2 < mesh.vertices.size(); k += 2) {
    mesh.facets.push_back({k, k + 2});
    mesh.facets.push_back({k + 3, k + 1});
  }
  return mesh;
}

/// What a discharge came to.
struct Discharge {
  double rate = 0;  ///< from 20 to 70 % of the mass [kg/s], in the plane [kg/(m s)]; 0: it stopped
  double bulk_density = 0;  ///< above the funnel, before the outlet is opened [kg/m^D]
  std::size_t steps = 0;
  std::size_t unsolved = 0;  ///< steps that the solver did not solve
};

/// A silo with grains of one shape, closed by a plate.
template <class Shape>
class Silo {
 public:
  using S = moreau::SpaceOf<Shape>;
  static constexpr int up = S::dim - 1;

  /// Fills the silo.
  /// @param grains their number
  /// @param radius half the width of the straight part [m]
  /// @param outlet width of the opening [m]
  Silo(std::size_t grains, double radius, double outlet, std::uint64_t seed)
      : simulation_(size, moreau::Materials<Law>(1, Law(friction)), {}, tolerances()),
        radius_(radius),
        funnel_(radius - outlet / 2) {
    simulation_.set_gravity(-gravity * S::Vector::Unit(up));
    const double top = add_grains(grains, seed) + size;
    const std::vector<ProfilePoint> inside{{radius, top}, {radius, funnel_}, {outlet / 2, 0}};
    simulation_.add_mesh_wall(revolved(inside, S{}));
    // From beyond the rim of the outlet almost to the axis.
    const std::vector<ProfilePoint> plate{{0.6 * outlet, -0.002}, {1e-4 * outlet, -0.002}};
    plate_ = simulation_.add_mesh_wall(revolved(plate, S{}));
    settle();
  }

  /// Opens the outlet and measures the rate.
  /// @param picture a PNG file, written when 20 % of the mass have left; none if empty
  Discharge discharge(const std::filesystem::path& picture) {
    double mass = 0;
    for (const auto grain : simulation_.grains())
      mass += simulation_.bodies().grain_mass[grain.index()];
    result_.bulk_density = bulk_density();
    moreau::Pose<S> lowered;  // below the sink
    lowered.position[up] = -0.15;
    simulation_.set_pose(plate_, lowered);
    auto sink = moreau::Sink<S>::behind(S::Vector::Unit(up), -0.1 * S::Vector::Unit(up));
    double begin = 0, before = 0, last = simulation_.time();  // last: a grain left
    while (simulation_.time() - last < still) {
      step();
      if (sink.apply(simulation_).count > 0) last = simulation_.time();
      const double out = sink.total().mass;
      if (begin == 0 && out > 0.2 * mass) {
        begin = simulation_.time(), before = out;
        if (!picture.empty()) moreau::write_picture(picture, simulation_);
      }
      if (out > 0.7 * mass) {
        result_.rate = (out - before) / (simulation_.time() - begin);
        break;
      }
    }
    return result_;
  }

 private:
  /// A margin of 1.6 mm: a grain that falls at 3 m/s moves by 1.5 mm in a step.
  static moreau::Tolerances tolerances() {
    moreau::Tolerances wide;
    wide.margin = 0.08;
    return wide;
  }
  /// @returns the height of the highest one [m]
  double add_grains(std::size_t grains, std::uint64_t seed) {
    double top = 0;
    std::mt19937_64 random(seed);
    const std::vector<double> radii(grains, size / 2);
    const double side = S::dim == 2 ? 2 * radius_ : std::numbers::sqrt2 * radius_;
    for (auto pose : moreau::random_deposition<S>(radii, 0.99 * side, random)) {
      for (int axis = 0; axis < up; ++axis) pose.position[axis] -= 0.495 * side;
      pose.position[up] += funnel_;
      const Shape shape = moreau::Ballast<Shape>::draw(random).scaled(size / 2);
      simulation_.add_grain(simulation_.add_shape(shape), pose, density);
      top = std::max(top, pose.position[up]);
    }
    return top;
  }
  void step() {
    const moreau::StepReport report = simulation_.step(h);
    ++result_.steps;
    result_.unsolved += !report.solve.converged;
  }
  /// Until the fastest grain moves by its size in half a second.
  void settle() {
    double fastest = 0;
    do {
      step();
      fastest = 0;
      for (const auto grain : simulation_.grains())
        fastest = std::max(fastest, simulation_.velocity(grain).norm());
    } while (simulation_.time() < longest && (fastest > 2 * size || simulation_.time() < 0.2));
  }
  /// From the lower four fifths of the grains in the straight part.
  /// @throws std::runtime_error for fewer than 30 grains there
  double bulk_density() const {
    std::vector<std::pair<double, double>> grains;  // height, mass
    for (const auto grain : simulation_.grains())
      if (const double z = simulation_.pose(grain).position[up]; z > funnel_)
        grains.emplace_back(z, simulation_.bodies().grain_mass[grain.index()]);
    if (grains.size() < 30)
      throw std::runtime_error(
          "fewer than 30 grains above the funnel: no bulk density; add grains");
    std::sort(grains.begin(), grains.end());
    const std::size_t lower = 4 * grains.size() / 5;
    double mass = 0;
    for (std::size_t k = 0; k < lower; ++k) mass += grains[k].second;
    const double section = S::dim == 2 ? 2 * radius_ : std::numbers::pi * radius_ * radius_;
    return mass / ((grains[lower].first - funnel_) * section);
  }

  moreau::Simulation<Shape, Law> simulation_;
  moreau::BodyId plate_;
  double radius_, funnel_;  // half width, height of the funnel [m]
  Discharge result_;
};

}  // namespace silo
