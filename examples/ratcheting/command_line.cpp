// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <string>

#include "moreau/version.hpp"

namespace ratcheting {

namespace {

const CLI::Validator positive(
    [](std::string& text) {
      double value = 0;
      if (!CLI::detail::lexical_cast(text, value) || !(value > 0) || !std::isfinite(value))
        return std::string("must be a finite number above 0, not ") + text;
      return std::string();
    },
    "> 0");
const CLI::Validator not_negative(
    [](std::string& text) {
      double value = 0;
      if (!CLI::detail::lexical_cast(text, value) || !(value >= 0) || !std::isfinite(value))
        return std::string("must be a finite number, 0 or above, not ") + text;
      return std::string();
    },
    ">= 0");

const CLI::Validator below_one(
    [](std::string& text) {
      double value = 0;
      if (!CLI::detail::lexical_cast(text, value) || !(value > 0 && value < 1))
        return std::string("must lie between 0 and 1, not ") + text;
      return std::string();
    },
    "> 0, < 1");
const CLI::Validator whole(
    [](std::string& text) {
      if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos)
        return std::string("must be a whole number, 0 or above, not ") + text;
      return std::string();
    },
    ">= 0");

}  // namespace

std::optional<Parameters> parse(int argc, char** argv, int& exit_status) {
  Parameters p;
  CLI::App app{
      "Simulates grains in a box whose right wall is pushed inward by a harmonic force, by contact "
      "dynamics: the experiment of Azema et al. (arXiv 0711.1081). The defaults are the paper's.",
      "ratcheting"};
  app.set_version_flag("--version", MOREAU_VERSION_STRING);
  app.option_defaults()->always_capture_default();
  app.add_option(
         "--shape", p.shape,
         "shape of the grains; polygon, disk and compound_polygon are simulated in the plane; "
         "a compound has four parts and is concave")
      ->check(CLI::IsMember(
          {"polyhedron", "polygon", "sphere", "disk", "compound", "compound_polygon"}));
  app.add_option("--grains", p.grains, "number of grains")->check(CLI::Range(4, 1000000));
  app.add_option("--frequency", p.frequency, "frequency of the force [Hz]")->check(positive);
  app.add_option("--fmax", p.fmax, "maximum of the force on the wall [N]")->check(positive);
  app.add_option("--fmin", p.fmin, "minimum of the force on the wall [N]")->check(not_negative);
  app.add_option("--gravity", p.gravity, "acceleration of gravity [m/s^2]")->check(not_negative);
  app.add_option("--density", p.density, "density of the grains [kg/m^3]")->check(positive);
  app.add_option(
         "--fewest-vertices", p.fewest_vertices,
         "only polyhedra (8 to 37) or polygons (5 to 7) with at least so many vertices; 0: all")
      ->check(CLI::Range(0, 37));
  app.add_option("--most-vertices", p.most_vertices,
                 "only polyhedra or polygons with at most so many vertices; 0: all")
      ->check(CLI::Range(0, 37));
  app.add_option("--flatness", p.flatness,
                 "factor by which one axis of all polyhedra or polygons is shortened")
      ->check(CLI::Range(0.1, 1.0));
  app.add_option("--friction", p.friction,
                 "coefficient of friction of grains with grains and with horizontal walls")
      ->check(not_negative);
  app.add_option("--wall-mass-ratio", p.wall_mass_ratio, "mass of the wall / mass of all grains")
      ->check(positive);
  app.add_option("--duration", p.duration,
                 "duration of the simulation under the harmonic force [s]")
      ->check(positive);
  app.add_option("--step", p.step, "time step [s]")->check(positive);
  const std::map<std::string, moreau::SizeReading> readings{
      {"circumdiameter", moreau::SizeReading::circumdiameter},
      {"circumradius", moreau::SizeReading::circumradius}};
  std::string reading = "circumdiameter";
  app.add_option("--size-reading", reading,
                 "meaning of the sizes 2.5, 3.75 and 5 cm: twice the largest distance from the "
                 "barycentre to a vertex (circumdiameter), or this distance (circumradius)")
      ->check(CLI::IsMember({"circumdiameter", "circumradius"}));
  app.add_option("--size-scale", p.size_scale,
                 "factor by which the sizes of all grains are multiplied")
      ->check(positive);
  app.add_option("--box-ratio", p.box_ratio, "height / length of the box")->check(positive);
  app.add_option("--box-length", p.box_length,
                 "length of the box [m]; 0: computed from the volume of the grains")
      ->check(not_negative);
  app.add_option("--width-ratio", p.width_ratio, "width / length of the box, in space")
      ->check(positive);
  app.add_option(
         "--side-walls", p.side_walls,
         "walls parallel to the motion of the moving wall, in space: without friction, with "
         "that of the grains, or none and a periodic axis")
      ->check(CLI::IsMember({"frictionless", "frictional", "periodic"}));
  app.add_option("--lid-force", p.lid_force,
                 "force on the lid in the preparation / weight of the grains at 9.81 m/s^2")
      ->check(positive);
  app.add_option("--lid-raise", p.lid_raise,
                 "distance by which the lid is raised after the preparation [m]")
      ->check(not_negative);
  app.add_option(
         "--method", p.method,
         "contact-dynamics: rigid contacts; compliant: contact dynamics with implicit springs in "
         "series; springs: molecular dynamics with springs and dashpots, whose time step is at "
         "most a twentieth of the duration of an impact")
      ->check(CLI::IsMember({"contact-dynamics", "compliant", "springs"}));
  const auto* stiffness =
      app.add_option("--stiffness", p.stiffness,
                     "normal stiffness of springs and of compliant contacts, there 1e8 unless set "
                     "[N/m]")
          ->check(positive);
  app.add_option("--restitution", p.restitution,
                 "coefficient of restitution of springs and dashpots")
      ->check(CLI::Range(0.0, 1.0));
  const auto* tolerance = app.add_option("--tolerance", p.tolerance,
                                         "tolerance of the stopping test; of compliant contacts "
                                         "1e-5 unless set")
                              ->check(below_one);
  std::string test = "qm16";
  const auto* stop_test =
      app.add_option("--stop-test", test,
                     "stopping test. qm16: change of the relative velocities in a sweep, as in "
                     "LMGC90; residual: "
                     "natural map of the contact law, for compliant contacts unless set")
          ->check(CLI::IsMember({"qm16", "residual"}));
  app.add_option("--max-sweeps", p.max_sweeps,
                 "largest number of sweeps in a step; run.json counts the steps that reach it")
      ->check(CLI::Range(1, 100000000));
  app.add_option("--cold-sweeps", p.cold_sweeps,
                 "largest number of sweeps in a second attempt, from zero impulses, at a step that "
                 "reaches --max-sweeps; 0: no second attempt")
      ->check(CLI::Range(0, 100000000));
  app.add_option("--preparation-step", p.preparation_step, "time step of the preparation [s]")
      ->check(positive);
  app.add_option("--preparation-tolerance", p.preparation_tolerance,
                 "tolerance of the stopping test (qm16) in the preparation")
      ->check(below_one);
  app.add_option("--preparation-sweeps", p.preparation_sweeps,
                 "largest number of sweeps in a step of the preparation")
      ->check(CLI::Range(1, 100000000));
  app.add_option(
         "--preparation-time", p.preparation_time,
         "longest time under the force on the lid [s]; run.json says whether the grains came to "
         "rest")
      ->check(positive);
  app.add_option("--margin", p.margin,
                 "distance at which contacts are detected / size of the smallest grain")
      ->check(positive);
  bool no_correction = false;
  app.add_flag("--no-correction", no_correction, "do not correct overlaps");
  app.add_option(
         "--solver", p.solver,
         "coloured: sweeps by colours with Nesterov momentum; plain: nonlinear Gauss-Seidel, the "
         "reference. The preparation always uses coloured")
      ->check(CLI::IsMember({"coloured", "plain"}));
  app.add_option("--threads", p.threads,
                 "threads that share the work; the results do not depend on it")
      ->check(CLI::Range(1, 1024));
  app.add_flag(
      "--cold-start", p.cold_start,
      "start the solver from zero impulses in every step, to see how unique the solutions are");
  app.add_option(
         "--order", p.order,
         "seed of a random order of grains and contacts after the preparation, for the same "
         "purpose; 0: order of the preparation")
      ->check(whole);
  app.add_option("--seed", p.seed, "seed of the random numbers that make the sample")->check(whole);
  app.add_option("--snapshots", p.snapshots, "number of ParaView files in the simulation; 0: none")
      ->check(CLI::Range(0, 100000));
  bool no_pictures = false;
  app.add_flag("--no-pictures", no_pictures, "do not draw pictures of the grains and force chains");
  bool no_plots = false;
  app.add_flag("--no-plots", no_plots, "do not draw plots with gnuplot");
  app.add_option("--checkpoint-every", p.checkpoint_every,
                 "number of steps between two checkpoints, from which --resume continues; 0: none")
      ->check(CLI::Range(0, 1000000000));
  app.add_flag("--resume", p.resume,
               "continue from the checkpoint in the output folder, if there is one; the parameters "
               "must be the same, and the results are");
  app.add_option(
      "--packing", p.packing,
      "file of the prepared packing: read if it exists, else written, so that simulations "
      "which differ only after the preparation share it");
  app.add_option("--from", p.from,
                 "checkpoint of another run at a maximum of its force, of the same sample and "
                 "method: start from it in place of a packing")
      ->check(CLI::ExistingFile);
  app.add_option(
         "--from-method", p.from_method,
         "method of the run that made the checkpoint of --from, for contact-dynamics; unset: "
         "that of this run")
      ->check(CLI::IsMember({"compliant"}));
  app.add_option("--hold", p.hold,
                 "time at fmax before the harmonic force begins at a maximum, for --from [s]")
      ->check(not_negative);
  app.add_option(
         "--wall-speed", p.wall_speed,
         "outward speed at which the wall is moved after the hold of --from, in place of the "
         "harmonic force [m/s]; 0: the force")
      ->check(not_negative);
  app.add_option("--output", p.output,
                 "folder of the results, created if missing; files in it are overwritten");

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    app.exit(success);
    exit_status = 0;
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    exit_status = 2;
    return std::nullopt;
  }
  if (p.fmin > p.fmax) {
    std::cerr << "--fmin: " << p.fmin << " must not exceed --fmax " << p.fmax << '\n';
    exit_status = 2;
    return std::nullopt;
  }
  if (p.wall_speed > 0 && p.from.empty()) {
    std::cerr << "--wall-speed: needs --from\n";
    exit_status = 2;
    return std::nullopt;
  }
  const bool planar = p.shape == "polygon" || p.shape == "disk" || p.shape == "compound_polygon";
  if (planar && (p.width_ratio != 1 || p.side_walls != "frictionless")) {
    std::cerr << "--width-ratio, --side-walls: a box of the plane has no side walls\n";
    exit_status = 2;
    return std::nullopt;
  }
  const int fewest = p.shape == "polygon" ? 5 : 8, most = p.shape == "polygon" ? 7 : 37;
  if (p.fewest_vertices > most ||
      (p.most_vertices > 0 && p.most_vertices < std::max(fewest, p.fewest_vertices))) {
    std::cerr << "--fewest-vertices, --most-vertices: no " << p.shape << " has "
              << p.fewest_vertices << " to " << p.most_vertices << " vertices\n";
    exit_status = 2;
    return std::nullopt;
  }
  if (p.method == "compliant") {
    if (stiffness->empty()) p.stiffness = 1e8;
    if (tolerance->empty()) p.tolerance = 1e-5;
    if (stop_test->empty()) test = "residual";
    no_correction = true;
  }
  p.size_reading = readings.at(reading);
  p.stop_test = test == "qm16" ? moreau::StopTest::qm16 : moreau::StopTest::natural_map;
  p.correction = !no_correction;
  p.pictures = !no_pictures;
  p.plots = !no_plots;
  return p;
}

}  // namespace ratcheting
