// SPDX-License-Identifier: MIT
// The motion of a periodic cell that deforms; world/cell_control.hpp has the equations.
#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <cstddef>
#include <tuple>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/periodic_cell.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/value.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/world/cell_control.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau {

/// The rate of a periodic cell, its stress, and how far it has deformed: Simulation::cell_motion().
template <class S>
class CellMotion {
 public:
  using Scalar = typename S::Scalar;
  using Matrix = typename S::Matrix;

  /// As control_cell() has set it.
  const CellControl<S>& control() const { return control_; }
  /// Velocity gradient L in the last step, world axes [1/s].
  const Matrix& rate() const { return rate_; }
  /// Stress of the grains in the last step, compression positive, world axes [Pa], in the plane [N/m]: that of the
  /// contacts and of the velocities relative to the cell.
  const Matrix& stress() const { return stress_; }
  /// Deformation gradient F since set_cell() [-]: a material line X has become F X. F(0, 1) is the shear strain of a
  /// cell that is only sheared.
  const Matrix& deformation() const { return deformation_; }
  /// Logarithmic strain -ln(F F^T) / 2 since set_cell(), compression positive as the stress, world axes [-]. Its trace is
  /// ln(volume at first / volume now), and that of an axis which no shear turns is ln(length at first / length now).
  /// A small shear has half of F(0, 1) as its component (0, 1), with the opposite sign.
  template <class Result = Matrix>
  Result strain() const {
    const Result square = deformation_ * deformation_.transpose();
    const Eigen::SelfAdjointEigenSolver<Result> axes(square);
    return -axes.eigenvectors() * (axes.eigenvalues().array().log() / 2).matrix().asDiagonal() *
           axes.eigenvectors().transpose();
  }
  /// Whether the cell deforms or can deform by its stress.
  MOREAU_COLD bool is_active() const { return !rate_.isZero(0) || !control_.mass.isZero(0); }

  /// For Simulation: refuses a step in which the cell could turn inside out, before anything has changed.
  MOREAU_INLINED void require_step(Scalar step) const {
    Scalar square = 0;
    for (int k = 0; k < rate_.size(); ++k) square += rate_(k) * rate_(k);
    const Scalar strain = step * std::sqrt(square);
    require(strain < 1, "Simulation::step", "step x rate of the cell", strain, "must be below 1");
  }
  /// For Simulation: sets the control. Components that keep a mass keep their rate.
  void set_control(const CellControl<S>& control) {
    for (int k = 0; k < rate_.size(); ++k)
      if (!(control.mass(k) > 0 && control_.mass(k) > 0)) rate_(k) = control.rate(k);
    control_ = control;
  }
  /// For Simulation: stress and deformation in the report of a step.
  MOREAU_INLINED void describe(StepReport& report) const {
    for (int i = 0; i < S::dim; ++i)
      for (int j = 0; j < S::dim; ++j) {
        report.cell_stress[i][j] = double(stress_(i, j));
        report.cell_deformation[i][j] = double(deformation_(i, j));
      }
  }
  /// Volume of the cell at the detection of the last step [m^3], in the plane its area [m^2].
  Scalar volume() const { return volume_; }

  /// For Simulation, before detection: deforms the cell by its rate.
  /// @param bodies   in, out: their positions
  /// @param detector ContactDetector with the cell
  /// @param step     h [s]
  /// @param theta    part of the step that comes after detection [-]
  void begin(Bodies<S>& bodies, auto& detector, Scalar step, Scalar theta, const Team& team) {
    before_ = deformation_;
    before_lost_ = lost_;
    if (!rate_.isZero(0)) {
      // (I - A)^-1 - I = (I - A)^-1 A, A = (1 - theta) h L: without the difference of nearly equal numbers.
      Matrix increment = strain_in((1 - theta) * step), lost = Matrix::Zero();
      Matrix by = inverse_of(identity_minus(Scalar(1), increment));
      for (int k = 0; k < S::dim; ++k) by(k, k) -= 1;
      grow(increment, lost, by);
      deform(bodies, detector, increment, team);
    }
    volume_ = detector.cell().volume();
  }
  /// Undoes begin(), but for the positions of the bodies; the vectors of the cell get back their values to rounding.
  MOREAU_COLD void undo_begin(auto& detector, Scalar step, Scalar theta) {
    deformation_ = before_;
    lost_ = before_lost_;
    if (!rate_.isZero(0)) detector.deform_cell(strain_in((theta - 1) * step));
    volume_ = detector.cell().volume();
  }
  /// For Simulation, after the contact problem: stores rate and stress, and deforms the cell.
  /// @param rate   L at the end of the step [1/s]; only of a cell that is active
  /// @param moment V sigma [J]
  void end(Bodies<S>& bodies, auto& detector, Scalar step, Scalar theta, const Matrix& rate,
           const Matrix& moment, const Team& team) {
    stress_ = moment / volume_;
    if (is_active()) rate_ = rate;
    if (!rate_.isZero(0)) deform(bodies, detector, strain_in(theta * step), team);
  }

 private:
  friend struct SerializationAccess;
  auto serialized_members() {
    return std::tie(control_, rate_, stress_, deformation_, lost_, volume_);
  }
  void deserialized() {
    control_.check("CellMotion");
    require(
        all_finite(rate_) && all_finite(stress_) && all_finite(deformation_) && all_finite(lost_),
        "CellMotion", "rate", rate_, "must be finite, and stress and deformation");
  }

  /// That of the rate in a time [s].
  MOREAU_INLINED Matrix strain_in(Scalar time) const {
    Matrix product;
    for (int k = 0; k < product.size(); ++k) product(k) = time * rate_(k);
    return product;
  }
  MOREAU_INLINED static void move_with_cell(Pose<S>& pose, const PeriodicCell<S>& cell,
                                            const Matrix& increment) {
    pose.position = cell.deformed(increment, pose.position);
  }
  /// Deforms the cell, and moves the bodies with it.
  void deform(Bodies<S>& bodies, auto& detector, const Matrix& increment, const Team& team) {
    team.share_each(bodies.size(), 512, [&](std::size_t i) {
      move_with_cell(bodies.pose[i], detector.cell(), increment);
    });
    detector.deform_cell(increment);
    grow(deformation_, lost_, increment);
  }

  CellControl<S> control_;
  Matrix rate_ = Matrix::Zero(), stress_ = Matrix::Zero(), deformation_ = Matrix::Identity();
  Matrix lost_ = Matrix::Zero();  // of deformation_, see grow()
  Matrix before_ = Matrix::Identity(), before_lost_ = Matrix::Zero();  // before the step
  Scalar volume_ = 0;
};

}  // namespace moreau
