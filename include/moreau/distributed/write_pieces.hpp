// SPDX-License-Identifier: MIT
// Grains and contacts of a distributed simulation for ParaView: one file per process, and an index.
#pragma once

#include <cstddef>
#include <exception>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/distributed/communicator.hpp"
#include "moreau/distributed/distributed_simulation.hpp"
#include "moreau/io/output_file.hpp"
#include "moreau/io/vtk.hpp"
#include "moreau/measure/force_chains.hpp"

namespace moreau {

namespace detail {

/// Does this process' part of a work. If one process throws, all do: none waits for another.
/// @throws the exception of this process; else std::runtime_error if another process threw
template <class Work>
void together(Communicator& processes, const Work& work) {
  std::exception_ptr error;
  try {
    work();
  } catch (...) {
    error = std::current_exception();
  }
  const double failed = processes.sum(error ? 1 : 0);
  if (error) std::rethrow_exception(error);
  if (failed > 0) throw std::runtime_error("write_pieces: another process cannot write");
}

/// An array of the files, as the index declares it.
struct PieceArray {
  const char *type, *name;
  int components;
};

/// The text of a .pvtp file.
/// @param on     PointData or CellData
/// @param pieces names of the files of the processes
inline std::string piece_index(const std::string& on, std::span<const PieceArray> arrays,
                               std::span<const std::string> pieces) {
  const auto element = [](const char* type, const std::string& name, int components) {
    return std::string("<PDataArray type=\"") + type + "\" Name=\"" + name +
           "\" NumberOfComponents=\"" + std::to_string(components) + "\"/>\n";
  };
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PPolyData\" version=\"1.0\">\n"
      "<PPolyData GhostLevel=\"0\">\n<PPoints>\n" +
      element("Float32", "Points", 3) + "</PPoints>\n<P" + on + ">\n";
  for (const PieceArray& array : arrays) text += element(array.type, array.name, array.components);
  text += "</P" + on + ">\n";
  for (const std::string& piece : pieces) text += "<Piece Source=\"" + piece + "\"/>\n";
  return text + "</PPolyData>\n</VTKFile>\n";
}

}  // namespace detail

/// Writes the grains and contacts of a distributed simulation. With the path `out/run_0010` and two
/// processes it writes
///
/// | file                                             | content                                    |
/// |--------------------------------------------------|--------------------------------------------|
/// | out/run_0010_grains.pvtp, run_0010_contacts.pvtp | the files to open: indices of the next     |
/// | out/run_0010_grains_0.vtp, run_0010_grains_1.vtp | VtkWriter::write_grains() of each process; |
/// |                                                  | `id` is a number within the file           |
/// | out/run_0010_contacts_0.vtp, ..                  | VtkWriter::write_contacts() of each        |
///
/// All processes call it, and see the same folder, which must exist. Poses are not moved to their
/// place in a periodic cell. If a process cannot write, the function throws in all processes, so that
/// none waits for another.
/// @param step length of the last step [s], by which impulses are divided
/// @throws std::invalid_argument for a name that XML cannot hold, a step that is not positive, or a hundred times longer or
///         shorter than the last one
/// @throws std::runtime_error if a file of this process or of another one cannot be written
template <class World>
void write_pieces(const std::filesystem::path& path, DistributedSimulation<World>& simulation,
                  double step, const VtkOptions& options = {}) {
  using S = typename World::S;
  const World& local = simulation.local();
  const int rank = simulation.processes().rank(), size = simulation.processes().size();
  const std::string name = path.filename().string();
  require(!name.empty() && detail::is_plain_xml(name), "write_pieces", "path", path.string(),
          "must end in a name without control characters and without \" < &");
  const auto piece = [](const std::string& stem, const char* part, int number) {
    return stem + "_" + part + "_" + std::to_string(number) + ".vtp";
  };
  std::vector<std::size_t> own;
  for (std::size_t k = 0; k < local.grain_count(); ++k)
    if (simulation.owns(local.grain(k))) own.push_back(k);
  const auto body = [&](std::size_t k) { return local.grain(own[k]).index(); };

  require_positive(step, "write_pieces", "step");
  local.require_unit_of_step(static_cast<typename S::Scalar>(step), "write_pieces");
  Communicator& processes = simulation.processes();
  detail::together(processes, [&] {
    VtkWriter<S> writer(options);
    writer.write_grains(
        piece(path.string(), "grains", rank),
        own.size(), [&](std::size_t k) -> const auto& { return local.shape_of_grain(own[k]); },
        [&](std::size_t k) -> const Pose<S>& { return local.bodies().pose[body(k)]; },
        [&](std::size_t k) { return local.bodies().velocity[body(k)]; });
    std::vector<ContactSegment<S>> segments;
    contact_segments<S>(
        local.contacts(), static_cast<typename S::Scalar>(step),
        [&](std::size_t i) { return local.bodies().pose[i].position; },
        [&](std::size_t i) { return local.is_grain(i); }, segments, local.cell());
    writer.write_contacts(piece(path.string(), "contacts", rank), segments);
  });
  // The index is written last, when the files that it names exist.
  detail::together(processes, [&] {
    if (rank != 0) return;
    using Shape = std::remove_cvref_t<decltype(local.shape_of_grain(0))>;
    bool as_points = false;
    if constexpr (std::same_as<Shape, BallIn<S>>) as_points = options.balls_as_points;
    constexpr detail::PieceArray of_grains[] = {{"Int32", "id", 1},
                                                {"Float32", "size", 1},
                                                {"Float32", "velocity", 3},
                                                {"Float32", "speed", 1},
                                                {"Float32", "spin", 1}};
    constexpr detail::PieceArray of_contacts[] = {{"Float32", "normal_force", 1},
                                                  {"Float32", "friction_force", 1},
                                                  {"Float32", "gap", 1},
                                                  {"Int32", "class", 1},
                                                  {"Float32", "point", 3}};
    std::vector<std::string> grains, contacts;
    for (int other = 0; other < size; ++other) {
      grains.push_back(piece(name, "grains", other));
      contacts.push_back(piece(name, "contacts", other));
    }
    write_atomically(path.string() + "_grains.pvtp",
                     detail::piece_index(as_points ? "PointData" : "CellData", of_grains, grains));
    write_atomically(path.string() + "_contacts.pvtp",
                     detail::piece_index("CellData", of_contacts, contacts));
  });
}
/// The same with the length of the last step of the simulation.
/// @throws std::invalid_argument, std::runtime_error in the same way, and if there are contacts but no step since the
///         simulation was read from a snapshot or distributed
template <class World>
void write_pieces(const std::filesystem::path& path, DistributedSimulation<World>& simulation) {
  const World& local = simulation.local();
  const double contacts = simulation.processes().sum(double(local.contacts().size()));
  write_pieces(path, simulation, detail::known_step(local, contacts, "write_pieces"));
}

}  // namespace moreau
