// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include <CLI/CLI.hpp>
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
      "Grains in a box whose right wall is pushed by a harmonic force: the ratcheting study of "
      "Azema "
      "et al. (arXiv 0711.1081), by contact dynamics. Defaults are the paper's."};
  app.set_version_flag("--version", MOREAU_VERSION_STRING);
  app.option_defaults()->always_capture_default();
  app.add_option("--shape", p.shape, "shape of the grains; polygon and disk run in the plane")
      ->check(CLI::IsMember({"polyhedron", "polygon", "sphere", "disk"}));
  app.add_option("--grains", p.grains, "number of grains")->check(CLI::Range(4, 1000000));
  app.add_option("--frequency", p.frequency, "of the force [Hz]")->check(positive);
  app.add_option("--fmax", p.fmax, "largest force on the wall [N]")->check(positive);
  app.add_option("--fmin", p.fmin, "smallest force on the wall [N]")->check(not_negative);
  app.add_option("--gravity", p.gravity, "[m/s^2]")->check(not_negative);
  app.add_option("--density", p.density, "of the material [kg/m^3]")->check(positive);
  app.add_option("--wall-mass-ratio", p.wall_mass_ratio, "mass of the wall / mass of the grains")
      ->check(positive);
  app.add_option("--duration", p.duration, "of the vibration [s]")->check(positive);
  app.add_option("--step", p.step, "time step [s]")->check(positive);
  const std::map<std::string, moreau::SizeReading> readings{
      {"circumdiameter", moreau::SizeReading::circumdiameter},
      {"circumradius", moreau::SizeReading::circumradius}};
  std::string reading = "circumdiameter";
  app.add_option(
         "--size-reading", reading,
         "what the sizes 2.5, 3.75 and 5 cm are: twice the largest distance from barycentre "
         "to vertex, or that distance")
      ->check(CLI::IsMember({"circumdiameter", "circumradius"}));
  app.add_option("--size-scale", p.size_scale, "factor on the sizes of all grains")
      ->check(positive);
  app.add_option("--box-ratio", p.box_ratio, "height / length of the box")->check(positive);
  app.add_option("--box-length", p.box_length, "length and width [m]; 0: from the volume")
      ->check(not_negative);
  app.add_option("--lid-force", p.lid_force, "of the preparation, in weights of the sample at 9.81")
      ->check(positive);
  app.add_option("--lid-raise", p.lid_raise, "of the lid after the preparation [m]")
      ->check(not_negative);
  app.add_option("--method", p.method,
                 "contact-dynamics, or springs and dashpots over the same grains, whose steps are "
                 "no longer than a twentieth of an impact")
      ->check(CLI::IsMember({"contact-dynamics", "springs"}));
  app.add_option("--stiffness", p.stiffness, "of a spring [N/m]")->check(positive);
  app.add_option("--restitution", p.restitution, "of an impact of springs, 0 to 1")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--tolerance", p.tolerance, "of the stopping test, below 1")->check(below_one);
  std::string test = "qm16";
  app.add_option(
         "--stop-test", test,
         "qm16: change per sweep, as in LMGC90; residual: the natural map of the contact law")
      ->check(CLI::IsMember({"qm16", "residual"}));
  app.add_option("--max-sweeps", p.max_sweeps, "cap per step; capped steps are counted")
      ->check(CLI::Range(1, 100000000));
  app.add_option("--preparation-step", p.preparation_step, "time step of the preparation [s]")
      ->check(positive);
  app.add_option("--preparation-tolerance", p.preparation_tolerance, "of its stopping test, qm16")
      ->check(below_one);
  app.add_option("--preparation-sweeps", p.preparation_sweeps, "its cap per step")
      ->check(CLI::Range(1, 100000000));
  app.add_option("--preparation-time", p.preparation_time,
                 "longest time under the lid's force [s]; run.json says whether the sample settled")
      ->check(positive);
  app.add_option("--margin", p.margin, "alert distance / smallest size")->check(positive);
  bool no_correction = false;
  app.add_flag("--no-correction", no_correction, "leave overlaps as they are");
  app.add_option("--solver", p.solver,
                 "coloured sweeps with momentum, or plain ones, the reference; the preparation "
                 "takes the first")
      ->check(CLI::IsMember({"coloured", "plain"}));
  app.add_option("--threads", p.threads, "threads of the solver; they do not change the results")
      ->check(CLI::Range(1, 1024));
  app.add_flag("--cold-start", p.cold_start,
               "solve every step from zero: how unique are the solutions?");
  app.add_option("--order", p.order,
                 "not 0: seed of another order of grains and contacts after the preparation, for "
                 "the same question")
      ->check(whole);
  app.add_option("--seed", p.seed, "of the sample")->check(whole);
  app.add_option("--snapshots", p.snapshots, "ParaView files over the run; 0: none")
      ->check(CLI::Range(0, 100000));
  bool no_pictures = false;
  app.add_flag("--no-pictures", no_pictures, "do not draw the packing and its force chains");
  bool no_plots = false;
  app.add_flag("--no-plots", no_plots, "do not call gnuplot");
  app.add_option("--checkpoint-every", p.checkpoint_every,
                 "steps after which all is written down, to be taken up by --resume; 0: never")
      ->check(CLI::Range(0, 1000000000));
  app.add_flag("--resume", p.resume,
               "go on from the checkpoint in the output folder, if there is one: same parameters, "
               "same results");
  app.add_option(
      "--packing", p.packing,
      "file of the packing that the lid makes: read if it is there, else written, so that "
      "runs which differ in what comes after prepare once");
  app.add_option("--output", p.output, "folder, made if missing; its files are overwritten");

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
  p.size_reading = readings.at(reading);
  p.stop_test = test == "qm16" ? moreau::StopTest::qm16 : moreau::StopTest::natural_map;
  p.correction = !no_correction;
  p.pictures = !no_pictures;
  p.plots = !no_plots;
  return p;
}

}  // namespace ratcheting
