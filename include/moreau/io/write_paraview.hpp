// SPDX-License-Identifier: MIT
// Writes all that ParaView shows of a simulation in one call: grains, walls and contacts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/io/output_file.hpp"
#include "moreau/io/vtk.hpp"
#include "moreau/io/vtk_poly_data.hpp"
#include "moreau/measure/force_chains.hpp"
#include "moreau/measure/wall_surface.hpp"
#include "moreau/world/bond.hpp"

namespace moreau {

namespace detail {

/// Writes walls as polygons (in the plane as lines) with the arrays `id` (BodyId) and `velocity` of
/// the origin of the wall [m/s].
template <class Simulation>
void write_walls(const std::filesystem::path& path, const Simulation& simulation) {
  VtkPolyData data;
  std::vector<std::int32_t> cell, ids;
  std::vector<float> velocities;
  for (const auto& surface : wall_surfaces(simulation))
    for (const auto& face : surface.faces) {
      cell.clear();
      for (const auto& x : face) cell.push_back(data.add_point(x));
      data.add_cell(face.size() > 2 ? VtkPolyData::Cells::polygons : VtkPolyData::Cells::lines,
                    cell);
      ids.push_back(static_cast<std::int32_t>(surface.body.value));
      const auto v = simulation.velocity(surface.body);
      for (int k = 0; k < 3; ++k)
        velocities.push_back(k < v.size() ? static_cast<float>(v[k]) : 0.0f);
    }
  data.add_array<std::int32_t>(VtkPolyData::On::cells, "id", 1, ids);
  data.add_array<float>(VtkPolyData::On::cells, "velocity", 3, velocities);
  data.write(path);
}

/// Writes bonds as lines with the arrays `strength_left`, `dissipated` and `elastic` [J], `a` and `b` (BodyId).
template <class Simulation>
void write_bonds(const std::filesystem::path& path, const Simulation& simulation) {
  using S = typename Simulation::S;
  VtkPolyData data;
  std::vector<float> strengths, dissipated, elastic;
  std::vector<std::int32_t> a, b;
  for (const Bond<S>& bond : simulation.bonds()) {
    const Pose<S>& pose = simulation.bodies().pose[bond.a.index()];
    const typename S::Vector from = simulation.cell().wrap(pose.position),
                             point = from + pose.rotation * bond.anchor_a;
    typename S::Vector to = point;
    if (simulation.is_grain(bond.b.index()))
      to = simulation.cell().nearest(simulation.bodies().pose[bond.b.index()].position, point);
    const std::int32_t ends[] = {data.add_point(from), data.add_point(to)};
    data.add_cell(VtkPolyData::Cells::lines, ends);
    strengths.push_back(static_cast<float>(bond.strength_left));
    dissipated.push_back(static_cast<float>(bond.dissipated));
    elastic.push_back(static_cast<float>(bond.elastic));
    a.push_back(static_cast<std::int32_t>(bond.a.value));
    b.push_back(static_cast<std::int32_t>(bond.b.value));
  }
  constexpr auto cells = VtkPolyData::On::cells;
  data.add_array<float>(cells, "strength_left", 1, strengths);
  data.add_array<float>(cells, "dissipated", 1, dissipated);
  data.add_array<float>(cells, "elastic", 1, elastic);
  data.add_array<std::int32_t>(cells, "a", 1, a);
  data.add_array<std::int32_t>(cells, "b", 1, b);
  data.write(path);
}

/// Writes the edges of a deforming cell with the arrays `stress` [Pa], `rate` [1/s] and `deformation`: matrices of 3 by
/// 3 numbers, row by row.
template <class Simulation>
void write_cell(const std::filesystem::path& path, const Simulation& simulation) {
  using S = typename Simulation::S;
  VtkPolyData data;
  const typename S::Matrix vectors = simulation.cell().vectors();
  for (unsigned corner = 0; corner < 1u << S::dim; ++corner) {
    typename S::Vector x = simulation.cell().lower();
    for (int k = 0; k < S::dim; ++k)
      if ((corner >> k & 1u) != 0) x += vectors.col(k);
    data.add_point(x);
  }
  for (unsigned corner = 0; corner < 1u << S::dim; ++corner)
    for (int k = 0; k < S::dim; ++k) {
      if ((corner >> k & 1u) != 0) continue;
      const std::int32_t ends[] = {static_cast<std::int32_t>(corner),
                                   static_cast<std::int32_t>(corner | 1u << k)};
      data.add_cell(VtkPolyData::Cells::lines, ends);
    }
  const auto add = [&](const char* name, const typename S::Matrix& matrix) {
    std::vector<float> values;
    for (std::size_t edge = 0; edge < data.cell_count(); ++edge)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          values.push_back(i < S::dim && j < S::dim ? static_cast<float>(matrix(i, j)) : 0.0f);
    data.add_array<float>(VtkPolyData::On::cells, name, 9, values);
  };
  add("stress", simulation.cell_motion().stress());
  add("rate", simulation.cell_motion().rate());
  add("deformation", simulation.cell_motion().deformation());
  data.write(path);
}

}  // namespace detail

/// Writes a simulation for ParaView into files that begin with the same path:
///
///     write_paraview("out/run_0010", simulation, h);
///
/// | file                       | content                                                         |
/// |----------------------------|-----------------------------------------------------------------|
/// | out/run_0010.vtm           | names the others: open this file in ParaView                    |
/// | out/run_0010_grains.vtp    | surfaces with the arrays of VtkWriter::write_grains()           |
/// | out/run_0010_walls.vtp     | all walls with the arrays `id` and `velocity`                   |
/// | out/run_0010_contacts.vtp  | lines with the arrays of VtkWriter::write_contacts()            |
/// | out/run_0010_bonds.vtp     | under a law with bonds: lines with `strength_left`, `dissipated` and `elastic` [J], `a`, `b` |
/// | out/run_0010_cell.vtp      | with a cell of set_cell(): its edges with `stress` [Pa], `rate` [1/s], `deformation` |
///
/// The array `id` of the grains is their position in grains(), not a BodyId. It changes when a grain with a lower id
/// is removed.
///
/// ParaView shows the files run_0000.vtm, run_0001.vtm, ... as one series. PvdSeries::add() adds
/// the time to such a file.
///
/// Coordinates are in world axes [m]. Each grain is at its place in the periodic cell. A mesh wall is
/// written as it is. Other walls have no bounds: a half-space is drawn as far as the bounding box of the grains, extended by a grain
/// size, reaches along it, and it ends at the other half-spaces. A half-space farther from the
/// grains than the diagonal of this box is left out. The contacts are all contact points of the
/// last step, also those without force; the positions are those after the step.
///
/// @param path       of the files, without extension; an extension .vtm is removed. Its folder must
///                   exist
/// @param simulation a Simulation
/// @param step       length of the last step [s], by which impulses are divided to obtain
///                   `normal_force` and `friction_force` [N]
/// @param options    how grains are drawn
/// @throws std::invalid_argument for a path whose last part is empty or contains one of " < & or a
///         control character, a step that is not finite, not positive, or a hundred times longer or shorter than the
///         last one, options out of range
/// @throws std::system_error naming the path of a file that cannot be written
template <class Simulation>
void write_paraview(const std::filesystem::path& path, const Simulation& simulation, double step,
                    const VtkOptions& options = {}) {
  using S = typename Simulation::S;
  const std::filesystem::path stem =
      path.extension() == ".vtm" ? std::filesystem::path(path).replace_extension() : path;
  const std::string name = stem.filename().string();
  require(!name.empty() && detail::is_plain_xml(name), "write_paraview", "path", path.string(),
          "must end in a name without control characters and without \" < &");
  require_positive(step, "write_paraview", "step");
  simulation.require_unit_of_step(static_cast<typename S::Scalar>(step), "write_paraview");
  const auto& cell = simulation.cell();
  std::vector<Pose<S>> poses;
  for (const BodyId grain : simulation.grains())
    poses.push_back(detail::pose_in_cell(simulation, grain));
  std::vector<ContactSegment<S>> segments;
  contact_segments<S>(
      simulation.contacts(), static_cast<typename S::Scalar>(step),
      [&](std::size_t body) { return cell.wrap(simulation.bodies().pose[body].position); },
      [&](std::size_t body) { return simulation.is_grain(body); }, segments, cell);

  VtkWriter<S> writer(options);
  writer.write_grains(
      stem.string() + "_grains.vtp", simulation.grain_count(),
      [&](std::size_t k) -> const auto& { return simulation.shape_of_grain(k); },
      [&](std::size_t k) -> const Pose<S>& { return poses[k]; },
      [&](std::size_t k) { return simulation.bodies().velocity[simulation.grain(k).index()]; });
  detail::write_walls(stem.string() + "_walls.vtp", simulation);
  writer.write_contacts(stem.string() + "_contacts.vtp", segments);

  std::string list =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\">\n"
      "<vtkMultiBlockDataSet>\n";
  std::vector<std::string> parts{"grains", "walls", "contacts"};
  if constexpr (requires { simulation.bonds(); }) {
    detail::write_bonds(stem.string() + "_bonds.vtp", simulation);
    parts.push_back("bonds");
  }
  if (cell.is_lattice()) {
    detail::write_cell(stem.string() + "_cell.vtp", simulation);
    parts.push_back("cell");
  }
  int index = 0;
  for (const std::string& part : parts)
    list += "<DataSet index=\"" + std::to_string(index++) + "\" name=\"" + part + "\" file=\"" +
            name + "_" + part + ".vtp\"/>\n";
  write_atomically(stem.string() + ".vtm", list + "</vtkMultiBlockDataSet>\n</VTKFile>\n");
}
/// The same with the length of the last step of the simulation.
/// @throws std::invalid_argument, std::system_error in the same way, and if there are contacts but no step since the
///         simulation was read from a snapshot
template <class Simulation>
void write_paraview(const std::filesystem::path& path, const Simulation& simulation) {
  write_paraview(
      path, simulation,
      detail::known_step(simulation, double(simulation.contacts().size()), "write_paraview"));
}

}  // namespace moreau
