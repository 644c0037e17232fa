// SPDX-License-Identifier: MIT
// Makes a grain of a mesh file: says what is wrong with the mesh, mends what it is asked to mend, and
// writes the hull, or convex parts, as an OBJ file with one group per part.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "moreau/io/output_file.hpp"
#include "moreau/io/read_mesh.hpp"
#include "moreau/mesh/check_mesh.hpp"
#include "moreau/mesh/convex_of_mesh.hpp"
#include "moreau/mesh/repair_mesh.hpp"
#include "moreau/shape/simplify_hull.hpp"

#include "decompose.hpp"

namespace {

struct CommandLine {
  std::string file, output;
  double unit = 1, weld = -1;
  bool drop_flat = false, orient = false, first_piece = false, hull_only = false;
  std::size_t vertices = 0;
  DecompositionLimits limits;
  bool parts = false;
};

/// Appends a polyhedron to the text of an OBJ file, as a group.
/// @param vertices that the text has already; increased
void append(std::string& text, const std::string& name, const moreau::Polyhedron<>& part,
            std::size_t& vertices) {
  text += "o " + name + "\n";
  char line[100];
  for (Eigen::Index i = 0; i < part.vertices().rows(); ++i) {
    const Eigen::Vector3d x = part.vertices().row(i).transpose() + part.centroid_of_input();
    std::snprintf(line, sizeof line, "v %.9g %.9g %.9g\n", x[0], x[1], x[2]);
    text += line;
  }
  for (std::size_t f = 0; f < part.face_count(); ++f) {
    text += "f";
    for (const std::uint32_t v : part.face(f)) {
      text += ' ';
      text += std::to_string(vertices + v + 1);
    }
    text += "\n";
  }
  vertices += part.vertex_count();
}

/// What the user can ask for if a mesh has a fault.
const char* advice(moreau::MeshDefect defect) {
  using moreau::MeshDefect;
  switch (defect) {
    case MeshDefect::degenerate:
      return "ask for --weld with a small length or for --drop-flat";
    case MeshDefect::open:
      return "ask for --weld, if rims lie close together";
    case MeshDefect::unoriented:
    case MeshDefect::inside_out:
      return "ask for --orient";
    case MeshDefect::several_pieces:
      return "ask for --first-piece";
    default:
      return "mend it in the program that made it";
  }
}

[[noreturn]] void refuse(const CommandLine& line, const moreau::MeshFault& fault) {
  throw std::invalid_argument(line.file + ": " + fault.message + ". To keep the shape, " +
                              advice(fault.defect) + "; --hull makes the convex hull of any mesh");
}

moreau::TriangleMesh<> mended(const CommandLine& line) {
  moreau::TriangleMesh<> mesh = moreau::read_mesh(line.file, line.unit);
  std::printf("triangles            %zu\n", mesh.facets.size());
  if (const auto fault = moreau::find_solid_fault(mesh))
    std::printf("first fault          %s: %s\n", name(fault->defect), fault->message.c_str());
  if (line.weld >= 0) {
    const moreau::WeldReport report = moreau::weld(mesh, line.weld);
    std::printf("welded               %zu vertices, %zu triangles removed\n",
                report.merged_vertices, report.removed_facets);
  }
  if (line.drop_flat)
    std::printf("without an area      %zu triangles removed\n", moreau::drop_flat_triangles(mesh));
  if (line.hull_only) return mesh;
  if (line.first_piece) {
    auto pieces = moreau::pieces_of(mesh);
    std::printf("pieces               %zu, the first is kept\n", pieces.size());
    mesh = pieces.at(0);
  }
  if (line.orient) {
    const auto fault = moreau::find_solid_fault(mesh);
    if (fault && fault->defect < moreau::MeshDefect::open) refuse(line, *fault);
    std::printf("turned               %zu triangles\n", moreau::orient(mesh));
  }
  if (const auto fault = moreau::find_solid_fault(mesh)) refuse(line, *fault);
  return mesh;
}

void run(const CommandLine& line) {
  const moreau::TriangleMesh<> mesh = mended(line);
  const moreau::Polyhedron<> hull = moreau::hull_of_mesh(mesh);
  const double of_mesh =
      line.hull_only ? hull.volume() : double(moreau::mass_properties(mesh, 1.0).mass);
  const char* whole = line.hull_only ? "hull" : "mesh";
  const auto worst = moreau::worst_concavity(mesh, hull);
  std::printf("volume               %.6g m^3\n", of_mesh);
  std::printf("hull                 %zu vertices, volume %.6g m^3 (%.3f of the %s)\n",
              hull.vertex_count(), hull.volume(), hull.volume() / of_mesh, whole);
  std::printf("worst concavity      %.6g m at triangle %zu\n", worst.depth, worst.facet);

  std::vector<moreau::Polyhedron<>> parts{hull};
  if (line.parts) parts = decompose(mesh, line.limits);
  double volume = 0;
  for (auto& part : parts) {
    if (line.vertices > 0) part = simplify_hull(part, line.vertices).shape;
    volume += part.volume();
  }
  std::printf("parts                %zu, volumes together %.3f of the %s\n", parts.size(),
              volume / of_mesh, whole);
  if (line.output.empty()) return;
  std::string text;
  std::size_t vertices = 0;
  for (std::size_t k = 0; k < parts.size(); ++k)
    append(text, "part_" + std::to_string(k), parts[k], vertices);
  moreau::write_atomically(line.output, text);
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line;
  CLI::App app("Makes a convex grain, or the convex parts of a grain, of a mesh file");
  app.add_option("file", line.file, "mesh: .obj, .stl or .ply")->required();
  app.add_option("--unit", line.unit, "length of one unit of the file [m]")->required();
  app.add_option("--weld", line.weld, "join vertices closer together than this [m]");
  app.add_flag("--drop-flat", line.drop_flat, "remove triangles without an area");
  app.add_flag("--orient", line.orient, "turn triangles whose outside is inside");
  app.add_flag("--first-piece", line.first_piece, "keep the first connected piece");
  app.add_option("--vertices", line.vertices, "keep at most this number of vertices of each part");
  CLI::Option* hull = app.add_flag("--hull", line.hull_only,
                                   "make the convex hull only: the mesh may have any fault");
  app.add_flag("--parts", line.parts, "divide the grain into convex parts (by HACD)")
      ->excludes(hull);
  app.add_option("--least-parts", line.limits.parts, "least number of parts");
  app.add_option("--concavity", line.limits.concavity,
                 "divide parts that are deeper than this fraction of the size");
  app.add_option("--output", line.output, "OBJ file [m], one group per part");
  CLI11_PARSE(app, argc, argv);
  try {
    run(line);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
