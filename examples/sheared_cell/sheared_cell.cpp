// SPDX-License-Identifier: MIT
// Dense flow without walls, in the plane and in space from one source: grains in a periodic cell are sheared at a
// rate and compressed by a stress across the shear. For each rate the program prints the inertial number
// I = rate d sqrt(rho / P), the effective friction mu = shear stress / normal stress, and the solid fraction.
//
//   sheared_cell [least strain per rate before the measurement, default 1]
//
// Units: diameter d, density rho and stress P are 1.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <iostream>
#include <moreau/moreau.hpp>
#include <random>
#include <sstream>
#include <stdexcept>

#include "moreau/law/compliant.hpp"

namespace {

using Law = moreau::Compliant<moreau::SignoriniCoulomb<>>;
constexpr double friction = 0.4, stiffness = 2000, pressure = 1;

template <class Shape>
class ShearedCell {
 public:
  using S = moreau::SpaceOf<Shape>;
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;

  /// Grains of 0.8 to 1.2 diameters, far apart on a lattice.
  explicit ShearedCell(int side)
      : simulation_(0.8, moreau::Materials<Law>(1, Law(moreau::SignoriniCoulomb<>(friction),
                                                       stiffness, stiffness / 2))) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> radius(0.4, 0.6), jitter(-0.1, 0.1);
    const int count = S::dim == 2 ? side * side : side * side * side;
    for (int k = 0; k < count; ++k) {
      const Shape shape(radius(random));
      moreau::Pose<S> pose;
      for (int axis = 0, rest = k; axis < S::dim; ++axis, rest /= side)
        pose.position[axis] = 1.5 * (rest % side + 0.5) + jitter(random);
      simulation_.add_grain(simulation_.add_shape(shape), pose, 1);
      mass_ += shape.mass_properties(1).mass;
    }
    step_ = 0.2 * std::sqrt(mass_ / stiffness);  // the cell is slower than this
    damping_ = 1. / side;  // a wave of sqrt(P / rho) crosses the cell in 1 / damping
    simulation_.set_cell(1.5 * side * Matrix::Identity());
  }
  /// Compresses the cell by the same stress on all sides.
  void compress() {
    moreau::CellControl<S> control;
    control.mass = mass_ * Matrix::Identity();
    control.stress = pressure * Matrix::Identity();
    control.damping = damping_;
    simulation_.control_cell(control);
    for (int k = 0; k < 10 / damping_ / step_; ++k) simulation_.step(step_);
  }
  /// Shears along x with y. The width of the cell stays; its height has the stress.
  void shear(double rate, double strain) {
    moreau::CellControl<S> control;
    control.rate(0, 1) = rate;
    control.mass(1, 1) = mass_;
    control.stress(1, 1) = pressure;
    control.damping = damping_;
    simulation_.control_cell(control);
    const int steps = int(std::ceil(std::max(strain / rate, 10 / damping_) / step_));
    for (int k = 0; k < steps; ++k) simulation_.step(step_);
    Matrix stress = Matrix::Zero();
    double fraction = 0;
    for (int k = 0; k < 2 * steps; ++k) {
      simulation_.step(step_);
      stress += simulation_.cell_motion().stress() / (2 * steps);
      fraction += mass_ / simulation_.cell().volume() / (2 * steps);
    }
    std::printf("%7.4f %8.4f %8.4f %8.4f\n", rate / std::sqrt(stress(1, 1)),
                -(stress(0, 1) + stress(1, 0)) / (2 * stress(1, 1)), fraction, stress(1, 1));
  }

 private:
  moreau::Simulation<Shape, Law> simulation_;
  double mass_ = 0, step_ = 0, damping_ = 0;
};

template <class Shape>
void flow(const char* name, int side, double strain) {
  std::printf("# %s: I, mu, solid fraction, normal stress\n", name);
  ShearedCell<Shape> cell(side);
  cell.compress();
  for (const double rate : {0.3, 0.1, 0.03, 0.01}) cell.shear(rate, strain);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    double strain = 1;
    std::istringstream text(argc > 1 ? argv[1] : "1");
    if (argc > 2 || !(text >> strain) || !(text >> std::ws).eof() || !(strain > 0))
      throw std::invalid_argument("usage: sheared_cell [strain per rate, > 0]");
    flow<moreau::Disk<>>("disks", 14, strain);
    flow<moreau::Ball<>>("spheres", 6, strain);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
