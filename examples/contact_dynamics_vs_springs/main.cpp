// SPDX-License-Identifier: MIT
// Compares contact dynamics with springs of increasing stiffness, for the same packing: height of
// the lid, solid fraction, distribution of the forces, time step, and cost of a simulated second.
// Writes contact_dynamics_vs_springs.csv and force_distribution.csv, which `gnuplot plot.gp` draws.
// With the argument --quick it stops at a moderate stiffness.
#include <cstdio>
#include <cstring>

#include "press.hpp"

namespace {

struct Files {
  std::FILE* runs;
  std::FILE* forces;
};

/// @param stiffness [N/m], 0 for contact dynamics
void write(const Files& files, double stiffness, double step, const press::Outcome& o) {
  std::printf("%-18s %8.0e %9.1e %10.6f %9.5f %8.3f %8.3f %9.1e %9.3f\n",
              stiffness > 0 ? "springs" : "contact dynamics", stiffness, step, 1e3 * o.lid, o.solid,
              o.contacts, o.strong(), o.overlap, o.seconds);
  std::fprintf(files.runs, "%g,%g,%.9g,%.9g,%g,%g,%g,%g\n", stiffness, step, o.lid, o.solid,
               o.contacts, o.strong(), o.overlap, o.seconds);
  for (std::size_t k = 0; k < o.forces.density.size(); ++k)
    std::fprintf(files.forces, "%g,%g,%g,%g\n", stiffness, step, o.forces.ratio(k),
                 o.forces.density[k]);
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
  const press::State packing = press::packed(200, quick ? 0.5 : 1.5);
  const Files files{std::fopen("contact_dynamics_vs_springs.csv", "w"),
                    std::fopen("force_distribution.csv", "w")};
  if (!files.runs || !files.forces) {
    std::perror("contact_dynamics_vs_springs.csv, force_distribution.csv");
    return 1;
  }
  std::fprintf(files.runs,
               "stiffness_N_per_m,step_s,lid_m,solid_fraction,contacts_per_grain,"
               "strong_share,mean_overlap_over_d,seconds_per_second\n");
  std::fprintf(files.forces, "stiffness_N_per_m,step_s,force_over_mean,density\n");
  std::printf("%-18s %8s %9s %10s %9s %8s %8s %9s %9s\n", "method", "k [N/m]", "h [s]", "lid [mm]",
              "solid", "contacts", "strong", "overlap/d", "cost s/s");
  for (const double step : {1e-3, 2e-4})
    write(files, 0, step, settle(packing, press::Coulomb(press::friction), step));
  for (const double stiffness : {1e5, 1e6, 1e7, 1e8, 1e9}) {
    if (quick && stiffness > 1e6) break;
    const auto [law, step] = press::springs_of(stiffness);
    write(files, stiffness, step, settle(packing, law, step));
  }
  return std::fclose(files.runs) | std::fclose(files.forces);
}
