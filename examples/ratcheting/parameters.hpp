// SPDX-License-Identifier: MIT
// The parameters of an experiment. The defaults are the paper's (Azema et al., arXiv 0711.1081),
// and this project's choices where the paper says nothing. SI units.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "moreau/boundary/drive.hpp"
#include "moreau/sample/size_distribution.hpp"
#include "moreau/solve/coloured_gauss_seidel.hpp"

namespace ratcheting {

struct Parameters {
  std::string shape = "polyhedron";  ///< one of those that --help lists
  std::size_t grains = 1200;
  double frequency = 5;          ///< nu [Hz]
  double fmax = 6000;            ///< [N]
  double fmin = 0;               ///< [N]
  double gravity = 9.81;         ///< [m/s^2]
  double density = 2700;         ///< of the grains' material [kg/m^3]
  double wall_mass_ratio = 0.5;  ///< m_w / m
  double duration = 1;           ///< of the simulation under the force [s]
  double step = 2e-4;            ///< h [s]
  moreau::SizeReading size_reading = moreau::SizeReading::circumdiameter;
  double size_scale = 1;   ///< factor on the paper's sizes 2.5, 3.75 and 5 cm
  double box_ratio = 1;    ///< intended H / L
  double box_length = 0;   ///< L [m]; 0: from the sample's volume
  double width_ratio = 1;  ///< W / L, in space
  /// The two walls that are parallel to the motion of the wall, in space: frictionless, frictional
  /// (the friction of the grains), or periodic (no walls).
  std::string side_walls = "frictionless";
  double lid_force = 10;    ///< / (m 9.81 m/s^2)
  double lid_raise = 0.01;  ///< [m]
  int fewest_vertices = 0;  ///< of a polyhedron or polygon; 0: no limit
  int most_vertices = 0;    ///< of a polyhedron or polygon; 0: no limit
  double flatness = 1;      ///< factor on one axis of all polyhedra and polygons
  double friction = 0.4;  ///< of grains with grains and horizontal walls; vertical walls have none
  std::string method = "contact-dynamics";  ///< or compliant or springs
  double stiffness = 1e7;                   ///< of springs and of compliant contacts, normal [N/m]
  double restitution = 0.2;                 ///< of an impact of springs [-]
  double tolerance = 1e-4;
  moreau::StopTest stop_test = moreau::StopTest::qm16;
  int max_sweeps = 5000;
  int cold_sweeps = 0;  ///< cap of a second attempt from zero impulses; see ColouredOptions
  /// The preparation has its own time step, tolerance (QM/16) and limit of sweeps, so that runs
  /// with other values in the experiment start from the same packing.
  double preparation_step = 2e-4;  ///< [s]
  double preparation_tolerance = 1e-4;
  int preparation_sweeps = 200;
  /// The preparation ends after this time under the lid force [s], because without gravity grains
  /// that touch nothing keep their kinetic energy for ever.
  double preparation_time = 1;
  double margin = 0.02;    ///< distance at which contacts are detected / size of the smallest grain
  bool correction = true;  ///< whether overlaps are corrected, outside the velocity problem
  std::string solver = "coloured";  ///< or plain: nonlinear Gauss-Seidel, the reference
  int threads = 1;
  bool cold_start = false;  ///< whether every step starts from zero impulses
  /// If not 0, the seed of a random order into which the grains, and so the contacts, are put after
  /// the preparation.
  std::uint64_t order = 0;
  std::uint64_t seed = 1;
  int snapshots = 20;    ///< number of ParaView files; 0: none
  bool pictures = true;  ///< whether pictures of the grains and force chains are drawn
  bool plots = true;
  int checkpoint_every = 0;  ///< steps between two checkpoints; 0: none
  bool resume = false;  ///< whether to continue from the checkpoint in the folder, if there is one
  /// File of the prepared packing, which runs that differ only after the preparation share. Empty:
  /// none.
  std::string packing;
  std::string output = "ratcheting-output";
  /// Checkpoint of another run, to start from in place of a packing. Empty: none.
  std::string from;
  /// Method of that run, if it is another one: the grains and walls start with its positions and
  /// velocities. Empty: the same.
  std::string from_method;
  /// Outward speed at which the wall is moved after the hold, in place of the harmonic force [m/s].
  /// 0: the force.
  double wall_speed = 0;
  double hold = 0.05;  ///< time at fmax before the harmonic force of such a run begins [s]

  double first_maximum() const { return 0.75 / frequency; }  ///< time of the first f = fmax [s]
  /// Time at which the run begins [s]: 0, or `hold` before the first maximum of the force.
  double begin() const { return from.empty() ? 0 : first_maximum() - hold; }
  /// f(t), compressive force on the moving wall [N] (paper, eq. 1); fmax during the hold.
  double force(double t) const {
    return moreau::HarmonicForce(fmin, fmax,
                                 frequency)(from.empty() ? t : std::max(t, first_maximum()));
  }
};

}  // namespace ratcheting
