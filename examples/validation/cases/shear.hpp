// SPDX-License-Identifier: MIT
// Disks that are sheared between two rough walls.
#pragma once

#include <numbers>
#include <random>

#include "moreau/measure/stress.hpp"

#include "scene.hpp"

namespace validation {

/// Means over the steady state.
struct ShearFlow {
  double number;    ///< I = shear rate sqrt(m/P), with the shear rate in the middle half
  double friction;  ///< shear stress of the walls (mean of both) / pressure
  double bulk;      ///< shear stress / normal stress from the contacts in the middle half
  double fraction;  ///< solid fraction
  double unsolved;  ///< share of the steps that did not converge
};

namespace detail {

/// Disks with diameters of 0.8 to 1.2 in a cell that is periodic along x, between a floor at rest
/// and a lid that slides and compresses; no gravity. Units: mean diameter, mean mass, pressure of
/// the lid. The walls are rough because the disks on them neither slip nor roll.
class ShearCell {
 public:
  using S = moreau::Space<2>;
  using Vector = S::Vector;

  /// @param number I that determines the speed of the lid, for a uniform shear rate
  ShearCell(int across, int layers, double friction, double number)
      : length_(across * 1.02),
        rate_(number),
        h_(2e-3 / number),
        world_(0.8, materials(friction), solver(), {.margin = 0.08}) {
    world_.set_periodic(0, 0, length_);
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> diameter(0.8, 1.2);
    std::vector<double> radii;
    for (int k = 0; k < across * layers; ++k) radii.push_back(diameter(random) / 2);
    for (const double r : radii) area_ += std::numbers::pi * r * r;
    const double density = double(radii.size()) / area_, spacing = 1.22;
    const double height = spacing * layers;
    for (int k = 0; k < across * layers; ++k) {
      const double up = spacing * (k / across + 0.5);
      const auto disk = world_.add_grain(world_.add_shape(Disk<>(radii[std::size_t(k)])),
                                         {Vector(length_ / across * (k % across), up)}, density);
      world_.set_velocity(disk, {rate_ * up, 0});
    }
    world_.add_wall(Vector::UnitY(), Vector::Zero(), moreau::MaterialId(1));
    lid_ = world_.add_wall(-Vector::UnitY(), {0, height}, moreau::MaterialId(1));
    world_.set_wall_mass(lid_, double(across));
    world_.set_force(lid_, {0, -length_});
    world_.set_velocity(lid_, {rate_ * 0.8 * height, 0});
  }

  /// @param before,during strain before and during the averages
  ShearFlow run(double before, double during) {
    for (double strain = 0; strain < before; strain += rate_ * h_) world_.step(h_);
    ShearFlow sum{};
    S::Matrix stress = S::Matrix::Zero();
    int samples = 0;
    for (double strain = 0; strain < during; strain += rate_ * h_, ++samples) {
      sum.unsolved += !world_.step(h_).solve.converged;
      stress += stress_now();
      sum.number += shear_rate();
      sum.friction += shear_of_walls();
      sum.fraction += area_ / (length_ * height());
    }
    return {sum.number / samples, sum.friction / samples, std::abs(stress(1, 0) / stress(1, 1)),
            sum.fraction / samples, sum.unsolved / samples};
  }

 private:
  using Law = Rolling<Disk<>>;
  static moreau::ColouredGaussSeidel solver() {
    moreau::ColouredOptions options;
    options.tolerance = 1e-3;
    options.max_sweeps = 1000;
    return moreau::ColouredGaussSeidel(options);
  }
  static Materials<Law> materials(double friction) {
    Materials<Law> all(2, Law(friction));
    all.set(moreau::MaterialId(0), moreau::MaterialId(1), Law(100, 100));
    return all;
  }

  double height() const { return world_.pose(lid_).position.y(); }
  moreau::Aabb<S> middle() const {
    return {Vector(0, height() / 4), Vector(length_, 3 * height() / 4)};
  }
  double shear_of_walls() const {
    const BodyId floor = world_.walls()[0];
    return (world_.contact_impulse(floor) - world_.contact_impulse(lid_)).x() / (2 * h_ * length_);
  }
  S::Matrix stress_now() const {
    const auto& pose = world_.bodies().pose;
    return moreau::contact_stress<S>(
        world_.contacts(), h_, middle(), [&](std::size_t i) { return pose[i].position; },
        [&](std::size_t i) { return world_.is_grain(i); }, world_.cell());
  }
  /// Slope of v_x over y by least squares, grains in the middle half.
  double shear_rate() const {
    double n = 0, y = 0, v = 0, yy = 0, yv = 0;
    const auto box = middle();
    for (std::size_t k = 0; k < world_.grain_count(); ++k) {
      const double at = world_.bodies().pose[k].position.y(),
                   along = world_.bodies().velocity[k][0];
      if (at < box.lower.y() || at > box.upper.y()) continue;
      n += 1, y += at, v += along, yy += at * at, yv += at * along;
    }
    return (n * yv - y * v) / (n * yy - y * y);
  }

  double length_, rate_, h_, area_ = 0;
  World<Disk<>, Law> world_;
  BodyId lid_{0};
};

}  // namespace detail

/// The effective friction of a dense flow of disks grows with the inertial number I: mu* = 0.25 +
/// 1.1 I for 0.02 <= I <= 0.2 and a friction of 0.4 (F. da Cruz, S. Emam, M. Prochnow, J.-N. Roux
/// and F. Chevoir, Phys. Rev. E 72 (2005) 021309).
inline void plane_shear(Record& record, Effort effort) {
  Curve& curve = record.curve("shear", moreau::Space<2>{},
                              {"number", "friction", "published", "bulk", "fraction"});
  const bool quick = effort == Effort::quick;
  for (const double wanted : quick ? std::vector{0.1} : std::vector{0.02, 0.05, 0.1, 0.2}) {
    detail::ShearCell cell(20, 20, 0.4, wanted);
    const ShearFlow flow = cell.run(3, quick ? 10 : 25);
    const double published = 0.25 + 1.1 * flow.number;
    curve.rows.push_back({flow.number, flow.friction, published, flow.bulk, flow.fraction});
    char name[80];
    std::snprintf(name, sizeof name, "plane shear of disks, I = %.3f: friction", flow.number);
    record.compare(name, moreau::Space<2>{}, published, flow.friction, 0.03);
    std::snprintf(name, sizeof name, "plane shear of disks, I = %.3f: share of steps not solved",
                  flow.number);
    record.vanishes(name, moreau::Space<2>{}, flow.unsolved, 0.01);
  }
}

}  // namespace validation
