// SPDX-License-Identifier: MIT
// A beam of bonded grains, clamped at one end, in the plane and in space from one source. A force across the beam at
// the other end bends it; then the force grows until a bond breaks. The program prints
//
//   - the deflection of the end, beside that of the springs of the bonds and that of Euler's and Bernoulli's beam with
//     E I = k_t R^2 d, d being the diameter of a grain and R = d / 4 the effective radius of a bond;
//   - the deflection of every grain, beside that of this beam;
//   - the force at which the beam breaks, beside that at which the couple of the first bond reaches its strength, and
//     which bond broke.
#include <cstddef>
#include <cstdio>
#include <exception>
#include <iostream>
#include <moreau/moreau.hpp>
#include <vector>

#include "moreau/law/bonded.hpp"
#include "moreau/law/compliant.hpp"

namespace {

using Law = moreau::Compliant<moreau::Bonded<double>>;
constexpr std::size_t grains = 16;
constexpr double radius = 0.01, effective_radius = radius / 2;    // [m]
constexpr double mass = 0.01;                                     // of a grain [kg]
constexpr double stiffness = 1e7, tangential_stiffness = 5e6;     // [N/m]
constexpr moreau::BondStrength<double> strength{100, 80, 60, 0};  // [N], brittle
constexpr double length = 2 * radius * double(grains - 1);        // between the outer centres [m]
constexpr double step = 0.01;                                     // [s]

template <class Shape>
class Beam {
 public:
  using S = moreau::SpaceOf<Shape>;
  using Vector = typename S::Vector;

  Beam()
      : simulation_(2 * radius,
                    moreau::Materials<Law>(1, Law(moreau::Bonded<double>(strength, 0.4), stiffness,
                                                  tangential_stiffness)),
                    solver()) {
    const moreau::ShapeId shape = simulation_.add_shape(Shape(radius));
    for (std::size_t k = 0; k < grains; ++k)
      ids_.push_back(simulation_.add_grain(
          shape, moreau::Pose<S>(Vector(2 * radius * double(k) * Vector::UnitX())),
          mass / Shape(radius).mass_properties(1).mass));
    simulation_.prescribe_motion(ids_.front());
    simulation_.bond_touching(1e-6);
  }
  /// The deflection under a force on the last grain [N], after the motion has died away [m].
  double deflection(double force) {
    simulation_.set_force(ids_.back(), Vector(-force * Vector::Unit(1)));
    for (int k = 0; k < 50; ++k) simulation_.step(step);
    return -simulation_.pose(ids_.back()).position[1];
  }
  /// Prints the positions of the grains along the beam and their deflections, beside those of the beam of Euler and
  /// Bernoulli [mm].
  void print(double force, double rigidity) const {
    std::printf("# position, deflection, Euler-Bernoulli [mm]\n");
    for (const moreau::BodyId grain : ids_) {
      const Vector& at = simulation_.pose(grain).position;
      std::printf("%7.2f %9.5f %9.5f\n", 1e3 * at[0], -1e3 * at[1],
                  1e3 * force * at[0] * at[0] * (3 * length - at[0]) / 6 / rigidity);
    }
  }
  /// Whether all bonds hold.
  bool holds() const { return simulation_.breakages().empty(); }
  /// The number of the grain before the bond that broke first.
  std::size_t broken() const { return simulation_.breakages().front().a.index(); }

 private:
  static moreau::ColouredGaussSeidel solver() {
    moreau::ColouredOptions options;
    options.tolerance = 1e-11;  // errors of the bonds of a row add up
    options.max_sweeps = 20000;
    return moreau::ColouredGaussSeidel(options);
  }

  moreau::Simulation<Shape, Law> simulation_;
  std::vector<moreau::BodyId> ids_;
};

template <class Shape>
void bend_and_break(const char* name) {
  Beam<Shape> beam;
  const double couple = tangential_stiffness * effective_radius * effective_radius;  // [N m]
  const double load = 0.1;                                                           // [N]
  double springs = 0;
  for (std::size_t k = 0; k + 1 < grains; ++k) {
    const double lever = length - radius * double(2 * k + 1);
    springs += load / tangential_stiffness + load * lever * lever / couple;
  }
  const double rigidity = couple * 2 * radius,
               euler = load * length * length * length / 3 / rigidity;
  std::printf("# %s: deflection %.4f mm, springs %.4f mm, Euler-Bernoulli %.4f mm\n", name,
              1e3 * beam.deflection(load), 1e3 * springs, 1e3 * euler);
  beam.print(load, rigidity);
  const double expected = strength.bending * effective_radius / (length - radius);
  double force = load;
  while (beam.holds()) beam.deflection(force += 0.02 * expected);  // slowly: it must not swing
  std::printf("# %s: breaks at %.2f N, expected %.2f N, at bond %zu of %zu\n\n\n", name, force,
              expected, beam.broken() + 1, grains - 1);
}

}  // namespace

int main() {
  try {
    bend_and_break<moreau::Disk<>>("disks");
    bend_and_break<moreau::Ball<>>("spheres");
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
