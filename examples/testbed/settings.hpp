// SPDX-License-Identifier: MIT
// What the user of the page can set: the one table of scenes, shapes and sliders. The page draws its
// controls from it (describe() writes it as JSON), and the native program reads key=value by it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "moreau/core/error.hpp"

namespace testbed {

/// The scenes, in the order of `scenes`.
enum class SceneKind : std::uint8_t { box, column, drum, arch, pyramid, dominoes, plate };

struct SceneEntry {
  const char* key;
  const char* label;
  const char* try_this;  ///< what the page proposes to try
  const char* action;    ///< label of the button that calls AnyScene::act()
};
inline constexpr std::array<SceneEntry, 7> scenes{{
    {"box", "Ratcheting box",
     "A lid packs the grains, then the wall on the right is pushed by the force f(t). x > 0 is "
     "outwards. In each period the wall comes in while f is large and is pushed out while f is "
     "small. With a small fmax the grains push it out far. Lower fmax, or pull a grain out of a "
     "force chain.",
     "End the packing now"},
    {"column", "Column collapse",
     "A column stands behind a gate, which opens by itself at 0.7 s. Then the grains run out over "
     "the floor. Compare angular with round grains: round grains roll farther.",
     "Open the gate now"},
    {"drum", "Rotating drum",
     "At first the bed turns with the drum; then it slides, and the surface keeps about the angle "
     "of repose. The large grains begin below, so that you see how the drum mixes them with the "
     "small ones. Change friction and shape and watch the angle; make the drum faster until the "
     "grains are thrown.",
     "Turn the other way"},
    {"arch", "Arch",
     "The blocks carry one another by contact and friction alone. Pull a block out by hand, or "
     "lower the friction until the arch slides apart. Concave blocks have teeth.",
     "Pull out the keystone"},
    {"pyramid", "Pyramid",
     "Blocks stand on one another; round grains lie between walls that hold the lowest layer. "
     "Shoot a "
     "block at it, pull one out, or lower the friction.",
     "Shoot a block"},
    {"dominoes", "Dominoes",
     "The first domino is pushed at 0.5 s and the row falls. Change the friction. Round grains do "
     "not "
     "fall: they roll.",
     "Push the first"},
    {"plate", "Plate of triangles",
     "The plate is a wall of triangles, in the plane of segments. It has an edge, over which "
     "grains fall "
     "to the floor. Change the friction, and add grains.",
     "Tilt gravity for 1 s"},
}};

/// The shapes, in the order of `shapes`.
enum class ShapeKind : std::uint8_t {
  polyhedron,
  polygon,
  ball,
  disk,
  concave_polyhedron,
  concave_polygon
};

struct ShapeEntry {
  const char* key;
  const char* label;
  int dimension;
};
inline constexpr std::array<ShapeEntry, 6> shapes{{
    {"polyhedron", "angular", 3},
    {"polygon", "angular", 2},
    {"ball", "round", 3},
    {"disk", "round", 2},
    {"concave_polyhedron", "concave", 3},
    {"concave_polygon", "concave", 2},
}};

/// The values of all sliders. SI units.
struct Settings {
  double grains = 300;      ///< number of grains
  double seed = 1;          ///< of shapes, sizes and positions
  double friction = 0.4;    ///< of grains with grains and with the walls that have friction [-]
  double gravity = 9.81;    ///< [m/s^2]
  double stiffness = 2e6;   ///< of a pair of grains, normal and tangential [N/m]
  double step = 5e-4;       ///< h [s]
  double tolerance = 1e-3;  ///< of the solver, on the natural-map residual [-]
  double sweeps = 200;      ///< most sweeps in a step
  double frequency = 3;     ///< nu of the force on the wall [Hz]
  double fmax = 300;        ///< largest force on the wall [N]
  double wall_mass = 0.5;   ///< mass of the wall / mass of the grains [-]
  double packing = 1;       ///< 1: the lid packs the grains first; 0: the wall is free at once
  double aspect = 2;        ///< height / length of the column [-]
  double drum_speed = 8;    ///< [revolutions/min]
  double hand = 100;        ///< largest force of the hand [N]
};

/// One slider. `scenes` has bit k for scene k.
struct SettingEntry {
  const char* key;
  const char* label;
  const char* unit;
  double Settings::*value;
  double low, high;  ///< ends of the slider; other values can be typed in
  bool logarithmic;  ///< of the slider
  bool whole;        ///< whether it is a whole number
  bool rebuilds;     ///< whether a change begins the scene anew
  unsigned scenes;
  const char* help;
};
inline constexpr unsigned in_box = 1, in_column = 2, in_drum = 4, in_arch = 8, in_pyramid = 16,
                          in_dominoes = 32, in_plate = 64, in_all = 127,
                          of_grains = in_box | in_column | in_drum | in_plate;
inline constexpr std::array<SettingEntry, 15> setting_table{{
    {"frequency", "Frequency ν", "Hz", &Settings::frequency, 0.5, 20, true, false, false, in_box,
     "of the force on the wall, f = fmax (1 - sin 2πνt)/2"},
    {"fmax", "Largest force fmax", "N", &Settings::fmax, 10, 10000, true, false, false, in_box,
     "on the wall, inward"},
    {"wall_mass", "Wall mass / grains", "-", &Settings::wall_mass, 0.05, 5, true, false, false,
     in_box, "mass of the wall over the mass of all grains"},
    {"packing", "Pack by the lid first", "", &Settings::packing, 0, 1, false, true, true, in_box,
     "1: a lid packs the grains without gravity, then the wall is set free; 0: grains fall into "
     "the "
     "box and the wall is free at once"},
    {"aspect", "Height / length", "-", &Settings::aspect, 0.5, 5, false, false, true, in_column,
     "of the column before the gate opens"},
    {"drum_speed", "Drum speed", "rev/min", &Settings::drum_speed, 0, 80, false, false, false,
     in_drum, "of the drum"},
    {"friction", "Friction μ", "-", &Settings::friction, 0, 1.2, false, false, false, in_all,
     "of grains with grains, floor, lid and drum; side walls have none"},
    {"gravity", "Gravity g", "m/s²", &Settings::gravity, 0, 20, false, false, false, in_all,
     "downward"},
    {"hand", "Strength of the hand", "N", &Settings::hand, 0.1, 10000, true, false, false, in_all,
     "largest force with which the pointer pulls a grain"},
    {"grains", "Grains", "", &Settings::grains, 20, 1000, true, true, true, of_grains,
     "a change begins the scene anew"},
    {"seed", "Seed", "", &Settings::seed, 1, 100, false, true, true, of_grains,
     "of shapes, sizes and positions; a change begins the scene anew"},
    {"step", "Time step h", "s", &Settings::step, 1e-4, 2e-3, true, false, false, in_all,
     "a shorter step is more exact and slower"},
    {"stiffness", "Contact stiffness k", "N/m", &Settings::stiffness, 1e5, 1e8, true, false, false,
     in_all,
     "contacts are springs in series with Coulomb's law; stiffer contacts take more sweeps"},
    {"tolerance", "Tolerance", "-", &Settings::tolerance, 1e-6, 1e-2, true, false, false, in_all,
     "the solver sweeps until the residual is below"},
    {"sweeps", "Most sweeps per step", "", &Settings::sweeps, 20, 2000, true, true, false, in_all,
     "then the step is left with the residual that it has"},
}};

/// Other defaults of the scenes in space: steps of a millisecond, so that 300 polyhedra run at a tenth of real time.
/// Stiffness and tolerance are such that the residual stays below a tenth of 1 / (k h^2 W_nn): forces are then
/// known to a tenth (moreau::check()).
struct SpaceDefault {
  const char* key;
  double value;
};
inline constexpr std::array<SpaceDefault, 3> space_defaults{
    {{"step", 1e-3}, {"stiffness", 1e6}, {"tolerance", 5e-5}}};

/// Throws what the library does not check: whole numbers, and numbers of grains that would fill the
/// memory of a page. Force, friction, gravity, ... are checked by the types that they are given to.
/// @throws std::invalid_argument naming the setting and its value
inline void require_whole(const Settings& settings) {
  for (const SettingEntry& entry : setting_table) {
    const double x = settings.*entry.value;
    moreau::require(std::isfinite(x), "testbed", entry.key, x, "must be finite");
    if (entry.whole)
      moreau::require(x == std::floor(x), "testbed", entry.key, x, "must be a whole number");
  }
  moreau::require(settings.grains >= 1 && settings.grains <= 5000, "testbed", "grains",
                  settings.grains, "must lie in [1, 5000]");
  moreau::require(settings.seed >= 0 && settings.seed < 4294967296., "testbed", "seed",
                  settings.seed, "must lie in [0, 2^32)");
  moreau::require(settings.packing == 0 || settings.packing == 1, "testbed", "packing",
                  settings.packing, "must be 0 or 1");
  moreau::require(settings.aspect >= 0.1 && settings.aspect <= 20, "testbed", "aspect",
                  settings.aspect, "must lie in [0.1, 20]");
  moreau::require(settings.hand >= 0, "testbed", "hand", settings.hand, "must be >= 0");
  moreau::require(settings.step > 0 && settings.step <= 0.02, "testbed", "step", settings.step,
                  "must lie in (0, 0.02] s");
  moreau::require(settings.sweeps >= 1 && settings.sweeps <= 1e6, "testbed", "sweeps",
                  settings.sweeps, "must lie in [1, 1e6]");
}

/// Index of the entry with this key; the size of the table if there is none.
template <class Table>
std::size_t index_of(const Table& table, std::string_view key) {
  std::size_t k = 0;
  while (k < table.size() && key != table[k].key) ++k;
  return k;
}

}  // namespace testbed
