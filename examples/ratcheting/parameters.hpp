// SPDX-License-Identifier: MIT
// The parameters of the ratcheting study, with the paper's values (Azema et al., arXiv 0711.1081)
// and this project's choices where the paper is silent. SI units.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "moreau/boundary/drive.hpp"
#include "moreau/sample/size_distribution.hpp"
#include "moreau/solve/coloured_gauss_seidel.hpp"

namespace ratcheting {

struct Parameters {
  std::string shape = "polyhedron";  ///< polyhedron, polygon, sphere or disk
  std::size_t grains = 1200;
  double frequency = 5;          ///< nu [Hz]
  double fmax = 6000;            ///< [N]
  double fmin = 0;               ///< [N]
  double gravity = 9.81;         ///< [m/s^2]
  double density = 2700;         ///< of the grains' material [kg/m^3]
  double wall_mass_ratio = 0.5;  ///< m_w / m
  double duration = 1;           ///< of the vibration [s]
  double step = 2e-4;            ///< h [s]
  moreau::SizeReading size_reading = moreau::SizeReading::circumdiameter;
  double size_scale = 1;    ///< of all grains, against the paper's 2.5, 3.75 and 5 cm
  double box_ratio = 1;     ///< H / L aimed at
  double box_length = 0;    ///< L = W [m]; 0: from the sample's volume
  double lid_force = 10;    ///< in units of m 9.81 m/s^2
  double lid_raise = 0.01;  ///< [m]
  double friction = 0.4;    ///< grain-grain and grain-horizontal wall; vertical walls have none
  std::string method = "contact-dynamics";  ///< or springs
  double stiffness = 1e7;                   ///< of a spring, normal [N/m]
  double restitution = 0.2;                 ///< of an impact of springs [-]
  double tolerance = 1e-4;
  moreau::StopTest stop_test = moreau::StopTest::qm16;
  int max_sweeps = 5000;
  /// The preparation has a step, tolerance (QM/16) and cap of its own, so that runs which differ in
  /// the others start from the same packing.
  double preparation_step = 2e-4;  ///< [s]
  double preparation_tolerance = 1e-4;
  int preparation_sweeps = 200;
  /// After so long under the lid's force the packing is taken as it is [s]: without gravity, grains
  /// that touch nothing keep their energy for ever.
  double preparation_time = 1;
  double margin = 0.02;             ///< alert distance, relative to the smallest size
  bool correction = true;           ///< overlap correction outside the velocity problem
  std::string solver = "coloured";  ///< or plain: one contact after another, the reference
  int threads = 1;
  bool cold_start = false;  ///< of every solution, without the impulses of the step before
  /// Not 0: after the preparation the grains, and so the contacts, are put into another order, by
  /// this seed.
  std::uint64_t order = 0;
  std::uint64_t seed = 1;
  int snapshots = 20;    ///< ParaView files over the duration; 0: none
  bool pictures = true;  ///< PNG of the packing and of its force chains
  bool plots = true;
  int checkpoint_every = 0;  ///< steps of the vibration from one checkpoint to the next; 0: none
  bool resume = false;       ///< from the checkpoint in the folder, if there is one
  /// Where the packing under the lid is kept, for runs that differ in what comes after; empty:
  /// nowhere.
  std::string packing;
  std::string output = "ratcheting-output";

  /// f(t), compressive force on the moving wall [N] (paper, eq. 1).
  double force(double t) const { return moreau::HarmonicForce(fmin, fmax, frequency)(t); }
};

}  // namespace ratcheting
