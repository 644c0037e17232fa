// SPDX-License-Identifier: MIT
// The biaxial test in the plane and the triaxial test in space, between rigid smooth walls. One template
// for all shapes.
//
//   1. Grains lie apart in a box, without gravity. A pressure p on the movable walls compresses them until
//      they are at rest.
//   2. The top wall moves down at a constant velocity. The pressure p stays on the lateral walls.
//
// The wall at 0 of each axis is fixed, and the other one moves. The last axis is the axis of the test.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <moreau/moreau.hpp>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "moreau/boundary/servo.hpp"
#include "moreau/io/write_paraview.hpp"
#include "moreau/measure/coordination.hpp"
#include "moreau/measure/energy_balance.hpp"
#include "moreau/measure/fabric.hpp"
#include "moreau/measure/stress.hpp"
#include "moreau/sample/ballast.hpp"
#include "moreau/sample/random_deposition.hpp"
#include "moreau/sample/size_distribution.hpp"

namespace biaxial {

using Law = moreau::SignoriniCoulomb<double>;

constexpr double size = 0.01;         // circumdiameter of the smallest grains [m]
constexpr double mean = 0.0125;       // of all grains: d [m]
constexpr double row_strain = 0.005;  // axial strain between two rows of the table [-]

/// What a test can change.
struct Parameters {
  double density = 2700;                    ///< of the grains [kg/m^3], in the plane [kg/m^2]
  double pressure = 1e4;                    ///< p [Pa], in the plane [N/m]
  double friction = 0.5;                    ///< between grains, during the shear [-]
  double h = 2.5e-4, h_compression = 1e-4;  ///< steps of shear and compression [s]
  double inertial = 1e-3;                   ///< inertial number of the shear [-]
  /// The time d sqrt(rho / p) in which the pressure moves a grain by about its diameter [s]. The inertial
  /// number is a strain rate times this time.
  double inertial_time() const { return mean * std::sqrt(density / pressure); }
};

/// One value per axis, which an int counts as in Eigen.
template <class T, int Axes>
class PerAxis {
 public:
  T& operator[](int axis) { return values_[std::size_t(axis)]; }
  const T& operator[](int axis) const { return values_[std::size_t(axis)]; }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }

 private:
  std::array<T, std::size_t(Axes)> values_;
};

/// Principal stresses [Pa], in the plane [N/m]. Compression is positive.
struct Stress {
  double axial = 0, lateral = 0;

  /// q/p: in the plane (axial - lateral) / (axial + lateral); in space q = axial - lateral and
  /// p = (axial + 2 lateral) / 3.
  double ratio(int dim) const {
    const double p = (axial + (dim - 1) * lateral) / dim;
    return (axial - lateral) / (dim == 2 ? 2 * p : p);
  }
  /// Mohr-Coulomb friction angle of a material without cohesion [degrees].
  double friction_angle() const {
    return std::asin((axial - lateral) / (axial + lateral)) * 180 / std::numbers::pi;
  }
  void add(const Stress& stress, double weight) {
    axial += weight * stress.axial;
    lateral += weight * stress.lateral;
  }
};

/// A row of the table. Stresses are means over the steps of the row. Three of them are results of
/// contact_stress() in different control volumes.
struct Row {
  double strain = 0;         ///< axial: decrease of the height / height before the shear [-]
  double volume_strain = 0;  ///< increase of the volume / volume before the shear [-]
  Stress walls;              ///< from the forces on the walls
  Stress inside;             ///< the control volume ends one grain diameter inside the walls
  Stress beyond;             ///< it ends beyond the walls; the stress is that of the box
  Stress ending;             ///< it ends on the walls: too small
  double coordination = 0;   ///< neighbours of a grain, without rattlers
  double anisotropy = 0;     ///< axial component of the anisotropy tensor of contact normals [-]
  double sweeps = 0;         ///< mean per step
  double residual = 0;       ///< largest
  std::size_t unsolved = 0;  ///< steps that the solver did not solve
  // Since the beginning of the shear [J]:
  double work = 0;         ///< of the walls
  double dissipation = 0;  ///< of the contacts
  double kinetic = 0;      ///< increase of the kinetic energy
};

/// A sample of grains between walls.
template <class Shape>
class Specimen {
 public:
  using S = moreau::SpaceOf<Shape>;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;

  /// Adds grains of three sizes that do not touch, and the walls around them.
  Specimen(std::size_t count, std::uint64_t seed, const Parameters& parameters)
      : p_(parameters), simulation_(size, materials(0), solver(), tolerances()) {
    std::mt19937_64 random(seed);
    const moreau::SizeDistribution diameters({{size, 1}, {mean, 1}, {2 * mean - size, 1}});
    std::vector<double> radii;
    double cubes = 0;  // volume of the cubes around the grains
    for (const double diameter : diameters.sample(count, random)) {
      radii.push_back(diameter / 2);
      cubes += std::pow(diameter, S::dim);
    }
    const double length = std::pow(cubes, 1.0 / S::dim);
    double top = 0;
    const auto poses = moreau::random_deposition<S>(radii, length, random);
    for (std::size_t k = 0; k < count; ++k) {
      const Shape shape = moreau::Ballast<Shape>::draw(random).scaled(radii[k]);
      simulation_.add_grain(simulation_.add_shape(shape), poses[k], p_.density);
      top = std::max(top, poses[k].position[up] + radii[k]);
    }
    for (const double grain : simulation_.bodies().grain_mass) mass_ += grain;
    for (int axis = 0; axis < S::dim; ++axis) {
      const Vector normal = Vector::Unit(axis);
      lower_[axis] = simulation_.add_wall(normal, Vector::Zero(), smooth);
      upper_[axis] = simulation_.add_wall(-normal, (axis == up ? top : length) * normal, smooth);
    }
  }
  Specimen(const Specimen&) = delete;  // loads_ refer to this object
  Specimen& operator=(const Specimen&) = delete;

  /// Compresses the grains by the same pressure on all movable walls, until 100 steps in a row are calm.
  /// @param grain_friction friction between grains: the smaller, the denser the sample becomes
  /// @param longest time [s]
  /// @returns whether the sample came to rest
  bool compress(double grain_friction, double longest) {
    simulation_.set_materials(materials(grain_friction));
    for (int axis = 0; axis < S::dim; ++axis) load_wall(axis);
    int calm = 0;
    while (calm < 100 && simulation_.time() < longest)
      calm = is_calm(step(p_.h_compression)) ? calm + 1 : 0;
    return calm >= 100;
  }

  /// Shears the compressed sample up to an axial strain of 0.005 times the number of rows.
  /// @param grain_friction friction between grains
  /// @param path beginning of the names of files for ParaView, written after every tenth row; none
  ///             if empty
  std::vector<Row> shear(double grain_friction, std::size_t rows,
                         const std::filesystem::path& path) {
    simulation_.set_materials(materials(grain_friction));
    const double rate = p_.inertial / p_.inertial_time();
    const auto steps = static_cast<int>(std::lround(row_strain / (rate * p_.h)));
    const double speed = row_strain / (steps * p_.h) * length(up);
    drive_wall(up, speed);

    const double height = length(up), before = volume();
    moreau::EnergyBalance<S> energy(simulation_);
    std::vector<Row> table(rows);
    std::optional<moreau::PvdSeries> series;
    if (!path.empty()) series.emplace(path.string() + ".pvd");
    for (std::size_t k = 0; k < rows; ++k) {
      Row& row = table[k];
      for (int i = 0; i < steps; ++i) {
        const moreau::StepReport report = step(p_.h);
        energy.add(simulation_, report, p_.h);
        measure(row, report, 1.0 / steps);
      }
      row.strain = 1 - length(up) / height;
      row.volume_strain = volume() / before - 1;
      const moreau::EnergyTerms& terms = energy.terms();
      row.work = terms.forces + terms.drives;
      row.dissipation = terms.impacts + terms.friction;
      row.kinetic = energy.kinetic() - energy.kinetic_at_start();
      if (series && k % 10 == 9) {
        const std::string name = path.filename().string() + "_" + std::to_string(k + 1);
        moreau::write_paraview(path.parent_path() / name, simulation_, p_.h);
        series->add(simulation_.time(), name + ".vtm");
      }
    }
    return table;
  }

  /// Length of the box along an axis [m].
  double length(int axis) const { return simulation_.pose(upper_[axis]).position[axis]; }
  /// Area of the walls perpendicular to an axis [m^2], in the plane their length [m].
  double area(int axis) const { return volume() / length(axis); }
  double volume() const {  ///< of the box [m^3], in the plane [m^2]
    double volume = 1;
    for (int axis = 0; axis < S::dim; ++axis) volume *= length(axis);
    return volume;
  }
  double solid_fraction() const { return mass_ / p_.density / volume(); }  ///< of the grains [-]
  std::size_t steps() const { return steps_; }                             ///< so far
  double approach() const { return approach_; }  ///< largest StepReport::approach so far
  double overlap() const { return overlap_; }    ///< largest overlap so far [m]

 private:
  static constexpr moreau::MaterialId rough{0}, smooth{1};  // grains, walls

  static moreau::Materials<Law> materials(double grain_friction) {
    moreau::Materials<Law> materials(2, Law(0));
    materials.set(rough, rough, Law(grain_friction));
    return materials;
  }
  /// With the default cap of 2000 sweeps some steps of polygons are not solved.
  static moreau::ColouredGaussSeidel solver() {
    moreau::ColouredOptions options;
    options.max_sweeps = 20000;
    return moreau::ColouredGaussSeidel(options);
  }
  /// A margin of 1 mm, because the walls move at up to 2 m/s before they meet resistance.
  static moreau::Tolerances tolerances() {
    moreau::Tolerances tolerances;
    tolerances.margin = 0.1;
    return tolerances;
  }

  /// Puts the pressure p on the movable wall of an axis.
  void load_wall(int axis) {
    loads_[axis].emplace(simulation_, upper_[axis], p_.pressure, mass_,
                         [this, axis] { return area(axis); });
  }
  /// Moves the movable wall of an axis towards the other one, at a constant speed [m/s].
  void drive_wall(int axis, double speed) {
    loads_[axis].reset();
    simulation_.set_wall_mass(upper_[axis], std::numeric_limits<double>::infinity());
    simulation_.set_force(upper_[axis], Vector::Zero());
    simulation_.set_velocity(upper_[axis], -speed * Vector::Unit(axis));
  }

  moreau::StepReport step(double duration) {
    for (const auto& load : loads_)
      if (load) load->apply(simulation_);
    const moreau::StepReport report = simulation_.step(duration);
    ++steps_;
    approach_ = std::max(approach_, report.approach);
    overlap_ = std::max(overlap_, report.max_overlap);
    return report;
  }

  /// Mean pressure on the two walls perpendicular to an axis.
  double wall_stress(int axis) {
    return (moreau::wall_pressure(simulation_, lower_[axis], p_.h, area(axis)) +
            moreau::wall_pressure(simulation_, upper_[axis], p_.h, area(axis))) /
           2;
  }

  /// Whether the step was solved, the grains carry the pressure on every wall to 1 %, and the inertial
  /// number of the motion of every wall is below a hundredth of that of the shear.
  bool is_calm(const moreau::StepReport& report) {
    bool calm = report.solve.converged;
    for (int axis = 0; axis < S::dim; ++axis) {
      for (const moreau::BodyId wall : {lower_[axis], upper_[axis]})
        calm = calm &&
               std::abs(moreau::wall_pressure(simulation_, wall, p_.h_compression, area(axis)) -
                        p_.pressure) <= 0.01 * p_.pressure;
      const double rate = simulation_.velocity(upper_[axis]).norm() / length(axis);
      calm = calm && rate * p_.inertial_time() <= 0.01 * p_.inertial;
    }
    return calm;
  }

  /// Mean stress in the box, made smaller by a length on all sides. If the length is negative, the
  /// control volume ends beyond the walls, and the stress is that of the box.
  Stress contact_stress(double inset) const {
    moreau::Aabb<S> box = control_volume(inset);
    typename S::Matrix stress = moreau::contact_stress(simulation_, p_.h, box);
    if (inset < 0) stress *= moreau::volume(box) / volume();
    return {stress(up, up), (stress.trace() - stress(up, up)) / up};
  }
  moreau::Aabb<S> control_volume(double inset) const {
    moreau::Aabb<S> box{Vector::Zero(), Vector::Zero()};
    for (int axis = 0; axis < S::dim; ++axis) box.upper[axis] = length(axis);
    return box.inflated(-inset);
  }

  /// Adds a step to a row.
  void measure(Row& row, const moreau::StepReport& report, double weight) {
    Stress walls{wall_stress(up), 0};
    for (int axis = 0; axis < up; ++axis) walls.lateral += wall_stress(axis) / up;
    row.walls.add(walls, weight);
    row.inside.add(contact_stress(mean), weight);
    row.beyond.add(contact_stress(-mean), weight);
    row.ending.add(contact_stress(0), weight);
    row.coordination += weight * moreau::coordination(simulation_, 2).neighbours;
    const moreau::Fabric<S> fabric = moreau::fabric(simulation_, p_.h, control_volume(mean));
    row.anisotropy += weight * fabric.anisotropy()(up, up);
    row.sweeps += weight * double(report.solve.sweeps);
    row.residual = std::max(row.residual, report.solve.residual);
    row.unsolved += !report.solve.converged;
  }

  Parameters p_;
  moreau::Simulation<Shape, Law> simulation_;
  PerAxis<moreau::BodyId, S::dim> lower_, upper_;
  using Load = moreau::PressureLoad<std::function<double()>>;
  PerAxis<std::optional<Load>, S::dim> loads_;  // empty: the wall is driven
  double mass_ = 0;                             // of all grains, and of a wall [kg]
  std::size_t steps_ = 0;
  double approach_ = 0, overlap_ = 0;
};

}  // namespace biaxial
