// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "moreau/contact/contact.hpp"
#include "moreau/solve/solve_report.hpp"
#include "moreau/world/overlap_correction.hpp"

namespace moreau {

/// Results of one step. In the plane, energies are per length if densities are.
struct StepReport {
  double step = 0;  ///< length h of the step [s]
  /// Pairs of grains in the list of the broad phase, without walls: the boxes of the grains were closer
  /// than margin + 2 skin along every axis when the list was made. The box of a grain without neighbours that has left
  /// its box before is longer along its motion.
  std::size_t candidate_pairs = 0;
  /// Pairs with at least one contact point that was detected, or with a bond; walls included. Also a pair of which all
  /// points lie at edges between obstacles that end flush, and are not among the contacts, counts.
  std::size_t pairs = 0;
  std::size_t points = 0;  ///< contact points
  /// Contact points whose key (bodies, parts and features) a contact point of the step before had, also
  /// if its impulse was 0.
  std::size_t warm_started = 0;
  /// Largest approach velocity of the contacts that were found, before the step, x step / margin [-].
  /// Above 1, surfaces can come within the margin and overlap in one step. The speed that a body gets in a step counts
  /// in the step in which it has a contact. Two bodies that pass through each other between two detections have no
  /// contact, and do not count. Under a regularized law the velocities are those at half of the step.
  double approach = 0;
  std::size_t overlapping = 0;  ///< points with gap < 0 as detected
  double max_overlap = 0;       ///< deepest point as detected, >= 0 [m]
  double mean_overlap = 0;      ///< mean depth of the points with gap < 0, >= 0 [m]
  std::uint32_t deepest_a =
      0;  ///< first body of the deepest point, BodyId::index(), if max_overlap > 0
  std::uint32_t deepest_b = 0;  ///< its second body
  /// Energy that the contact impulses and couples took from the bodies [J], without elastic_work;
  /// < 0 if they gave energy, as the springs of a regularized law do. With compliant contacts the
  /// value of a single step can be negative by h/2 F . (change of velocity) for each force F; these
  /// terms cancel over a load cycle.
  double dissipation = 0;
  double friction = 0;  ///< part of it: by tangential impulses [J]
  double rolling = 0;   ///< part of it: by couples of rolling and twisting [J]
  /// Part of it, >= 0: by bonds that yield and break, with the energy that their springs lose meanwhile and release [J].
  double fracture = 0;
  std::size_t bonds = 0;         ///< bonds that are left after the step
  std::size_t broken_bonds = 0;  ///< bonds that broke in the step
  /// Root mean square of the forces of the bonds, couples included, over that of the pushes against their strength [-]; 0
  /// without bonds.
  double bond_load = 0;
  /// Estimated relative error of the forces of the bonds [-]: solve.residual, or 32 epsilon / bond_load if that
  /// is larger, because impulses have the rounding of the strength; at most 1.
  double bond_error = 0;
  /// Work of a periodic cell that deforms on the grains in the step [J]: minus volume x trace(stress x rate) x step, with the
  /// volume at detection, CellMotion::volume(). Where the stress moves the cell, the part of the contacts has the mean of the
  /// rates before and after the step, that of the velocities the rate before it. Kinetic energies are relative to the cell.
  double cell_work = 0;
  /// Stress of a cell of set_cell() in the step, compression positive, world axes [Pa]: CellMotion::stress(). In the
  /// plane it is in the first two rows and columns [N/m]. Zero without such a cell.
  double cell_stress[3][3] = {};
  /// Its deformation gradient F since set_cell(), after the step, world axes [-]: CellMotion::deformation(). F[0][1] / F[1][1]
  /// is the shear strain along x with y; CellMotion::strain() is the strain. Identity without such a cell.
  double cell_deformation[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  /// Energy of the springs of compliant contacts after the step [J]; 0 under other laws.
  double elastic_energy = 0;
  double elastic_work = 0;         ///< energy that these springs took in the step [J]
  double max_elastic_overlap = 0;  ///< largest compression of a normal spring, >= 0 [m]
  /// Under a compliant law: the smallest C_n / (h^2 W_nn) of the loaded contacts [-], C_n being the
  /// compliance of a contact point and W_nn that of the bodies at it; 0 under other laws. The forces are
  /// known to about solve.residual over this number.
  double relative_compliance = 0;
  /// Under a compliant law: the natural-map residual of the law without its springs [-].
  double rigid_residual = 0;
  /// Whether a pair closed a gap for which it had no contact, and the step was solved again with all contacts up to
  /// the margin.
  bool repeated = false;
  SolveReport solve;                   ///< how well the contact problem was solved
  OverlapCorrectionReport correction;  ///< results of the overlap correction
  double ms_detect = 0;                ///< time for prediction and detection [ms]
  double ms_place = 0;                 ///< part of it: prediction, placing the shapes [ms]
  double ms_pairs = 0;                 ///< part of it: candidate pairs, with the broad phase [ms]
  double ms_collide = 0;               ///< part of it: contact points of the pairs [ms]
  double ms_solve = 0;                 ///< all after the detection [ms]
  double ms_assemble = 0;              ///< part of it: free velocities, operator, warm start [ms]
  double ms_correct = 0;               ///< part of it: overlap correction [ms]
  double ms_contacts = 0;              ///< part of it: the solver of the contact problem [ms]
  double ms_total = 0;                 ///< for the whole step [ms]

  /// Fills the times of the two parts of the step.
  void set_times(std::chrono::duration<double, std::milli> detect,
                 std::chrono::duration<double, std::milli> rest) {
    ms_detect = detect.count();
    ms_solve = rest.count();
    ms_total = ms_detect + ms_solve;
  }
  /// Measures the stages of a step, one after the other.
  class StageClock {
   public:
    /// Milliseconds since the last call, or since the clock was made.
    double lap() {
      const auto before = std::exchange(last_, Clock::now());
      return std::chrono::duration<double, std::milli>(last_ - before).count();
    }

   private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point last_ = Clock::now();
  };
  /// Fills the overlaps from the gaps of the contacts [m].
  template <class S>
  void measure_overlaps(const DetectedContacts<S>& contacts) {
    overlapping = 0;
    max_overlap = mean_overlap = 0;
    for (const Contact<S>& contact : contacts.points) {
      if (!(contact.gap < 0)) continue;
      if (-double(contact.gap) > max_overlap) {
        max_overlap = -double(contact.gap);
        deepest_a = contact.a, deepest_b = contact.b;
      }
      mean_overlap -= double(contact.gap);
      ++overlapping;
    }
    if (overlapping > 0) mean_overlap /= double(overlapping);
  }
};

}  // namespace moreau
