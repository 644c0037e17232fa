// SPDX-License-Identifier: MIT
#include "parameters_json.hpp"

namespace ratcheting {

Json to_json(const Parameters& p) {
  Json json = {
      {"shape", p.shape},
      {"grains", p.grains},
      {"frequency", p.frequency},
      {"fmax", p.fmax},
      {"fmin", p.fmin},
      {"gravity", p.gravity},
      {"density", p.density},
      {"wall_mass_ratio", p.wall_mass_ratio},
      {"duration", p.duration},
      {"step", p.step},
      {"size_reading",
       p.size_reading == moreau::SizeReading::circumdiameter ? "circumdiameter" : "circumradius"},
      {"size_scale", p.size_scale},
      {"box_ratio", p.box_ratio},
      {"box_length", p.box_length},
      {"lid_force_weights", p.lid_force},
      {"lid_raise", p.lid_raise},
      {"friction", p.friction},
      {"method", p.method},
      {"stiffness", p.stiffness},
      {"restitution", p.restitution},
      {"tolerance", p.tolerance},
      {"stop_test", p.stop_test == moreau::StopTest::qm16 ? "qm16" : "residual"},
      {"max_sweeps", p.max_sweeps},
      {"preparation_step", p.preparation_step},
      {"preparation_tolerance", p.preparation_tolerance},
      {"preparation_sweeps", p.preparation_sweeps},
      {"preparation_time", p.preparation_time},
      {"margin", p.margin},
      {"overlap_correction", p.correction},
      {"threads", p.threads},
      {"cold_start", p.cold_start},
      {"order", p.order},
      {"seed", p.seed}};
  // The default is left out, as in the runs that were made before there was a choice.
  if (p.solver != Parameters{}.solver) json["solver"] = p.solver;
  if (p.cold_sweeps > 0) json["cold_sweeps"] = p.cold_sweeps;
  if (p.fewest_vertices > 0) json["fewest_vertices"] = p.fewest_vertices;
  if (p.most_vertices > 0) json["most_vertices"] = p.most_vertices;
  if (p.flatness != Parameters{}.flatness) json["flatness"] = p.flatness;
  if (p.wall_speed > 0) json["wall_speed"] = p.wall_speed;
  if (p.width_ratio != Parameters{}.width_ratio) json["width_ratio"] = p.width_ratio;
  if (p.side_walls != Parameters{}.side_walls) json["side_walls"] = p.side_walls;
  if (!p.from_method.empty()) json["from_method"] = p.from_method;
  if (!p.from.empty()) {
    json["from"] = p.from;
    json["hold"] = p.hold;
  }
  return json;
}

}  // namespace ratcheting
