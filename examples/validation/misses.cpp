// SPDX-License-Identifier: MIT
#include "misses.hpp"

#include <span>

namespace validation {

namespace {

/// Comparisons whose names begin and end so, and whose error is no more than that: some twice what
/// was seen when they were listed.
struct Miss {
  const char *start, *end;
  double most;
  const char* reason;
};

constexpr const char* shear =
    "not explained: above the published line by 0.015 to 0.04 at every I, in two samples and with "
    "two steps; walls here are flat and hold the disks on them, the paper's are glued disks";

constexpr const char* lifted =
    "the correction of overlaps lifts the ball by parts of what it sank in, which changes where it "
    "is when the next impact comes";

constexpr Miss misses_in_double[] = {
    {"frame indifference, polyhedron: distance", "over size", 1.2e-4,
     "sweeps leave one step in which grains lock at a residual of 5.8e-5, and what it then gives "
     "is "
     "chosen by rounding; every step solved, the frames agree to 2e-11"},
    {"bouncing ball", "sphere: order of the time to rest", 0.5, lifted},
    {"bouncing ball", "disk: order of the time to rest", 0.5, lifted},
    {"bouncing ball", "overlaps not corrected: error of the time to rest over h", 30,
     "up to 30 is what ten impacts can come to; half of it is asked for"},
    {"energy without drive", ": rise while falling, 0.5 ms, uncorrected", 1e-5,
     "the velocity before a step points out of the frame after it by v h/R; of first order"},
    {"Janssen's silo", ": friction of the walls over mu times their push", 0.6,
     "balls roll on the walls, too"},
    {"Janssen's silo", ": lambda, from the push of the walls", 2.4,
     "its slope takes all of mu times the push for the walls' friction, of which half is there"},
    {"plane shear of disks, I = 0.08", ": friction", 0.06, shear},
    {"plane shear of disks, I = 0.09", ": friction", 0.06, shear},
};

constexpr Miss misses_in_float[] = {
    {"bouncing ball", "sphere: order of the time to rest", 0.5, lifted},
    {"bouncing ball", "disk: order of the time to rest", 0.5, lifted},
    {"bouncing ball", "overlaps not corrected: error of the time to rest over h", 30,
     "up to 30 is what ten impacts can come to; half of it is asked for"},
    {"block on an incline", "linear springs: error of the acceleration [m/s^2]", 2e-3,
     "a step of 2e-5 s adds some 1000 roundings to the velocity"},
    {"slip to roll", ": order of the final speed in the overlap", 0.3,
     "2000 roundings of the velocity are a third of the error"},
    {"asymmetric top: angular momentum", "", 2e-3, "40000 steps with a rounding each"},
    {"asymmetric top", ": order of the energy's change", 6,
     "its change is smaller than its rounding"},
    {"sliding off a ball", "error of the cosine where it leaves, over h", 400,
     "gaps are known to 2e-7 R, in a step of 1e-3 gravity closes 1e-6 R: contacts open early"},
    {"sliding off a ball", "order of the cosine where it leaves", 5, "as its error"},
    {"sliding off a ball", "linear springs: cosine where it leaves", 1e-2, "as without springs"},
    {"rolling off a ball", "error of the cosine where it leaves, over h", 400,
     "as where it slides"},
    {"rolling off a ball", "order of the cosine where it leaves", 5, "as its error"},
    {"rolling off a ball", "linear springs: cosine where it leaves", 3e-3, "as without springs"},
    {"stack of 3 boxes, 10 s, polygon: drift", "", 4e-3,
     "2000 steps move it by 8e-8 m each, a rounding of the places"},
    {"stack of 3 boxes, 1 s", "linear springs: velocity [m/s]", 2e-3,
     "a rounding of the places is a tenth of the overlaps"},
    {"static friction", ": slips on a floor that speeds up by so many (1 + 1/k) N/m", 3e-4,
     "a contact within the root of a rounding, 3.5e-4, of the static cone counts as sliding"},
    {"column of", "relative error of the impulses", 1e-3,
     "a rounding of the places over the step is 1e-3 of the velocity that gravity gives"},
    {"packing at rest", "imbalance of forces over weight", 2e-3, "as in the column"},
    {"Painleve's rod, polyhedron, pulled in the first step", "impulse over the mass [m/s]", 6e-3,
     "a gap of one rounding of the height, 3e-8 m, over g h^2 is 3e-3"},
    {"frame indifference", "distance over size", 5e-3,
     "rounding grows by 1000 and more in the collisions"},
    {"prisms against polygons", "distance over size", 2e-2,
     "rounding grows in the collisions, and on springs more"},
    {"prisms against polygons", "difference of the angles", 3e-2, "as the distance"},
    {"prisms against polygons", "tilt out of the plane", 5e-3, "as the distance"},
};

}  // namespace

const char* known_miss(const Row& row) {
  if (row.pass()) return nullptr;
  const bool is_float = row.space.ends_with("float");
  for (const Miss& miss : is_float ? std::span<const Miss>(misses_in_float) : misses_in_double)
    if (row.name.starts_with(miss.start) && row.name.ends_with(miss.end) && row.error <= miss.most)
      return miss.reason;
  return nullptr;
}

}  // namespace validation
