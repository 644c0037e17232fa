// SPDX-License-Identifier: MIT
// Files of meshes. The corpus of bad meshes holds what scans and CAD programs really write; each
// gives the error in the table, and the repair that is asked for, if there is one, gives a solid.
#include "moreau/io/read_mesh.hpp"

#include <cstring>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "moreau/sample/concave_mesh.hpp"
#include "moreau/shape/check_mesh.hpp"
#include "moreau/shape/compound.hpp"
#include "moreau/shape/convex_of_mesh.hpp"
#include "moreau/shape/repair_mesh.hpp"
#include "moreau/shape/simplify_hull.hpp"

#include "io/temporary_folder.hpp"

namespace {

using namespace moreau;
using Mesh = TriangleMesh<double>;
using Vector = Eigen::Vector3d;

/// A cube of edge 1 with a corner at `x`, and its triangles shifted to the vertices from `first`.
struct Parts {
  std::vector<Vector> vertices;
  std::vector<std::array<int, 3>> triangles;

  static Parts cube(const Vector& x = Vector::Zero(), double edge = 1) {
    Parts parts;
    for (const auto& c : {Vector(0, 0, 0), Vector(1, 0, 0), Vector(1, 1, 0), Vector(0, 1, 0),
                          Vector(0, 0, 1), Vector(1, 0, 1), Vector(1, 1, 1), Vector(0, 1, 1)})
      parts.vertices.push_back(x + edge * c);
    parts.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                       {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
    return parts;
  }
  Parts& operator+=(const Parts& other) {
    const int first = int(vertices.size());
    vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
    for (auto t : other.triangles) triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return *this;
  }
  Parts reversed() const {
    Parts parts = *this;
    for (auto& t : parts.triangles) std::swap(t[1], t[2]);
    return parts;
  }

  /// @param first number of vertices before these in the file
  std::string obj(int first = 0) const {
    std::ostringstream out;
    out.precision(9);
    for (const auto& x : vertices) out << "v " << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
    for (const auto& t : triangles)
      out << "f " << first + t[0] + 1 << ' ' << first + t[1] + 1 << ' ' << first + t[2] + 1 << '\n';
    return out.str();
  }
  std::string ply() const {
    std::ostringstream out;
    out.precision(9);
    out << "ply\nformat ascii 1.0\nelement vertex " << vertices.size()
        << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
        << triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const auto& x : vertices) out << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
    for (const auto& t : triangles) out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
    return out.str();
  }
  std::string stl() const {
    std::ostringstream out;
    out.precision(9);
    out << "solid cube\n";
    for (const auto& t : triangles) {
      out << "facet normal 0 0 0\nouter loop\n";
      for (const int v : t) {
        const Vector& x = vertices[std::size_t(v)];
        out << "vertex " << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
      }
      out << "endloop\nendfacet\n";
    }
    out << "endsolid cube\n";
    return out.str();
  }
  std::string binary_stl() const {
    std::string out(80, ' ');
    const auto put = [&](const auto& value) {
      char bytes[sizeof value];
      std::memcpy(bytes, &value, sizeof value);
      out.append(bytes, sizeof value);
    };
    put(std::uint32_t(triangles.size()));
    for (const auto& t : triangles) {
      for (int k = 0; k < 3; ++k) put(0.f);
      for (const int v : t)
        for (int k = 0; k < 3; ++k) put(float(vertices[std::size_t(v)][k]));
      put(std::uint16_t(0));
    }
    return out;
  }
};

std::filesystem::path write(const TemporaryFolder& folder, const std::string& name,
                            const std::string& text) {
  const auto path = folder / name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

void by_weld(Mesh& mesh) {
  weld(mesh, 1e-3);
}
void by_orient(Mesh& mesh) {
  orient(mesh);
}
void by_drop(Mesh& mesh) {
  drop_repeated_facets(mesh);
}
void by_weld_and_orient(Mesh& mesh) {
  weld(mesh, 1e-3);
  orient(mesh);
}
void by_first_piece(Mesh& mesh) {
  mesh = pieces_of(mesh)[0];
}

/// A file, the beginning of its error after the name of the function or file, and a repair.
struct BadMesh {
  const char* name;
  std::string text;
  const char* error;
  std::function<void(Mesh&)> repair = {};
};

std::vector<BadMesh> corpus() {
  const Parts cube = Parts::cube();
  const auto with = [&](const std::function<void(Parts&)>& change) {
    Parts parts = cube;
    change(parts);
    return parts;
  };
  const Parts fin = with([](Parts& p) {
    p.vertices.push_back({0.5, -1, 0});
    p.triangles.push_back({0, 1, 8});
  });
  const Parts at_an_edge = with([](Parts& p) { p += Parts::cube({1, 1, 0}); });
  const Parts at_a_corner = with([](Parts& p) { p += Parts::cube({1, 1, 1}); });
  const Parts hole = with([](Parts& p) { p.triangles.pop_back(); });
  const Parts half = with([](Parts& p) { p.triangles.resize(6); });
  const Parts gap = with([](Parts& p) {
    p.vertices.push_back({1, 1, 1.0001});
    p.triangles[9] = {2, 7, 8};
  });
  const Parts t_junction = with([](Parts& p) {
    p.vertices.push_back({0.5, 0, 0});
    p.triangles[0] = {0, 2, 8};
    p.triangles.push_back({8, 2, 1});
  });
  const Parts cavity = with([](Parts& p) { p += Parts::cube({0.25, 0.25, 0.25}, 0.5).reversed(); });
  const Parts two = with([](Parts& p) { p += Parts::cube({3, 0, 0}); });
  const Parts tower = with([](Parts& p) { p += Parts::cube({0, 0, 1}); });
  const Parts turned = with([](Parts& p) { std::swap(p.triangles[4][0], p.triangles[4][1]); });
  const Parts some_turned = with([](Parts& p) {
    for (std::size_t k : {1u, 4u, 7u, 11u}) std::swap(p.triangles[k][0], p.triangles[k][1]);
  });
  const Parts repeated = with([](Parts& p) { p.triangles.push_back(p.triangles[3]); });
  const Parts back_to_back = with([](Parts& p) { p += Parts::cube().reversed(); });
  const Parts zero_corner = with([](Parts& p) { p.triangles[7] = {1, 1, 5}; });
  const Parts collinear = with([](Parts& p) {
    p.vertices.push_back({0.5, 0.5, 0});
    p.triangles[1] = {0, 8, 2};
  });
  const Parts collapsed = with([](Parts& p) { p.vertices[5] = p.vertices[1]; });
  const Parts beyond = with([](Parts& p) { p.triangles[5] = {0, 5, 40}; });
  const Parts huge = with([](Parts& p) { p.vertices[6] *= 1e39; });
  const Parts sliver = with([](Parts& p) {
    p.vertices.push_back({0.5, 1e-9, 0});
    p.triangles[0] = {0, 8, 1};
  });
  Parts flat;
  flat.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  flat.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  Parts tetrahedron;
  tetrahedron.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  Parts one, pair;
  one.vertices = tetrahedron.vertices;
  one.triangles = {{0, 1, 2}};
  pair.vertices = tetrahedron.vertices;
  pair.triangles = {{0, 1, 2}, {0, 2, 1}};
  std::string not_a_number = cube.obj();
  not_a_number.replace(0, 7, "v nan 0 0");
  std::string infinite = cube.stl();
  infinite.replace(infinite.find("vertex 1 1 0"), 12, "vertex inf 1 0");
  std::string short_stl = cube.binary_stl();
  short_stl.resize(300);
  return {
      {"empty.obj", "", "file: "},
      {"comment_only.obj", "# nothing\n", "file: "},
      {"no_face.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "triangles = 0 must be at least 1"},
      {"text.stl", "this is not a mesh", "file: "},
      {"text.ply", "this is not a mesh", "file: "},
      {"cut_off.stl", short_stl, "file: "},
      {"lines.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nl 2 3\n", "file: "},
      {"stone.step", cube.obj(), "path = "},
      {"not_a_number.obj", not_a_number, "vertex 0 = (nan, 0, 0) of triangle 0 must be finite"},
      {"infinite.stl", infinite, "vertex 1 = (inf, 1, 0) of triangle 0 must be finite"},
      {"too_large.ply", huge.ply(), "vertex 6 = (inf, inf, inf) of triangle 2 must be finite"},
      {"beyond.obj", beyond.obj(), "file: "},
      {"beyond.ply", beyond.ply(), "file: "},
      {"one_triangle.obj", one.obj(), "triangles = 1 must be at least 4"},
      {"two_triangles.stl", pair.stl(), "triangles = 2 must be at least 4"},
      {"corner_twice.obj", zero_corner.obj(), "triangle 7 = (2, 2, 5) must have different corners"},
      {"collinear.obj", collinear.obj(), "triangle 1 = (0, 3, 1) must have an area that is not 0"},
      {"sliver.ply", sliver.ply(), "triangle 0 = (0, 8, 1)"},
      {"collapsed.stl", collapsed.stl(), "triangle 4 = (0, 2, 2) must have different corners"},
      {"hole.stl", hole.binary_stl(), "triangle 3 = "},
      {"half.ply", half.ply(), "triangle 0 = (0, 2, 1) must have a neighbour at its edge (1, 2)"},
      {"t_junction.obj", t_junction.obj(), "triangle 0 = (0, 1, 2) must have a neighbour"},
      {"gap.stl", gap.stl(), "triangle 3 = (4, 6, 7) must have a neighbour", by_weld},
      {"fin.obj", fin.obj(), "triangle 12 = (0, 2, 8) must not share the edge (0, 2)"},
      {"at_an_edge.stl", at_an_edge.stl(),
       "triangle 17 = (1, 11, 6) must not share the edge (1, 6)"},
      {"at_a_corner.stl", at_a_corner.stl(),
       "triangle 12 = (6, 8, 9) must not touch triangle 2 only at the vertex 6"},
      {"repeated.obj", repeated.obj(),
       "triangle 12 = (4, 6, 7) must not have the corners of triangle 3", by_drop},
      {"back_to_back.stl", back_to_back.stl(), "triangle 12 = ", by_drop},
      {"one_turned.obj", turned.obj(), "triangle 4 = (2, 0, 5) must have its outside", by_orient},
      {"some_turned.ply", some_turned.ply(), "triangle 1 = (3, 0, 2) must have its outside",
       by_orient},
      {"inside_out.stl", cube.reversed().stl(), "volume = -1 m^3 must be positive", by_orient},
      {"inside_out_with_gap.obj", gap.reversed().obj(), "triangle ", by_weld_and_orient},
      {"two_cubes.obj", two.obj(), "triangle 12 = (8, 9, 10) must be connected to triangle 0",
       by_first_piece},
      {"cavity.ply", cavity.ply(), "triangle 12 = (8, 9, 10) must be connected to triangle 0",
       by_first_piece},
      {"wall_between.stl", tower.stl(), "triangle 12 = "},
      {"flat.obj", flat.obj(), "volume = "},
  };
}

std::string error_of(const std::filesystem::path& path, Mesh& mesh) {
  try {
    mesh = read_mesh(path, 1.0);
    require_solid(mesh, "f");
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    return message.substr(message.find(": ") + 2);
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    CHECK(message.find(path.string()) == 0);
    return "file: " + message;
  }
  return "none";
}

}  // namespace

TEST_CASE("the same cube in four formats") {
  const TemporaryFolder folder("mesh");
  const Parts cube = Parts::cube({1, 2, 3});
  for (const auto& [name, text] : {std::pair<const char*, std::string>{"a.obj", cube.obj()},
                                   {"a.stl", cube.stl()},
                                   {"b.STL", cube.binary_stl()},
                                   {"a.ply", cube.ply()}}) {
    const std::string path = write(folder, name, text);
    CAPTURE(path);
    const Mesh mesh = read_mesh(path, 1e-3);
    CHECK(mesh.vertices.size() == 8);
    CHECK(mesh.facets.size() == 12);
    CHECK(!find_solid_fault(mesh));
    CHECK(volume_of(mesh) == doctest::Approx(1e-9));
    CHECK((mass_properties(mesh, 1.0).center - Vector(1.5e-3, 2.5e-3, 3.5e-3)).norm() < 1e-9);
    CHECK(convex_of_mesh(mesh).face_count() == 6);
  }
}

TEST_CASE("from a scan to a grain") {
  const TemporaryFolder folder("mesh");
  const auto path = write(folder, "stone.stl", [] {
    const auto stone = moreau::ballast_mesh<moreau::Space<3>>(20, 3, 7);  // 20 mm
    Parts parts;
    for (const auto& x : stone.vertices) parts.vertices.push_back(x);
    for (const auto& f : stone.facets) parts.triangles.push_back({int(f[0]), int(f[1]), int(f[2])});
    return parts.binary_stl();
  }());
  moreau::TriangleMesh<> mesh = moreau::read_mesh(path, 1e-3);  // the file is in millimetres
  moreau::weld(mesh, 1e-6);                   // corners closer than 1 um become one
  moreau::orient(mesh);                       // the outside of each triangle is outside
  moreau::require_solid(mesh, "my program");  // throws, and names the triangle, if it is not closed
  const moreau::MassProperties<moreau::Space<3>> mass = moreau::mass_properties(mesh, 2700.0);

  const moreau::Polyhedron<> hull = moreau::hull_of_mesh(mesh);
  const moreau::Concavity<moreau::Space<3>> worst = moreau::worst_concavity(mesh, hull);
  const moreau::SimplifiedHull<moreau::Polyhedron<>> grain = moreau::simplify_hull(hull, 40);
  CHECK(mass.mass < 2700 * hull.volume());
  CHECK(worst.depth > 0.002);
  CHECK(grain.shape.vertex_count() == 40);
  CHECK(grain.volume_error < 0.05);
  CHECK_THROWS_AS(moreau::convex_of_mesh(mesh), std::invalid_argument);
}

TEST_CASE("quadrilaterals are divided, groups are read one by one") {
  const TemporaryFolder folder("mesh");
  const std::string text =
      "o left\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
      "o right\nv 1 0 0\nv 2 0 0\nv 1 1 0\nv 1 0 1\nf 9 11 10\nf 9 10 12\nf 10 11 12\nf 9 12 11\n";
  const auto path = write(folder, "parts.obj", text);
  const auto groups = read_mesh_groups(path, 1.0);
  REQUIRE(groups.size() == 2);
  CHECK(groups[0].name == "left");
  CHECK(groups[1].name == "right");
  CHECK(volume_of(groups[0].mesh) == doctest::Approx(1));
  CHECK(volume_of(groups[1].mesh) == doctest::Approx(1. / 6));
  CHECK(read_mesh(path, 1.0).facets.size() == 16);
}

TEST_CASE("a grain of the groups of a file, with the mass properties of a mesh") {
  const TemporaryFolder folder("mesh");
  const auto cube = [](const char* name, double x, int first) {  // in millimetres
    std::ostringstream text;
    text << "o " << name << '\n' << Parts::cube({x, 0, 0}, 20).obj(first);
    return text.str();
  };
  const auto path = write(folder, "parts.obj",
                          cube("left", 0, 0) + cube("middle", 10, 8) + cube("right", 40, 16));
  Mesh mesh = read_mesh(write(folder, "whole.obj", Parts::cube({0, 0, 0}, 20).obj()), 1e-3);
  for (auto& x : mesh.vertices) x[0] *= 3;
  std::vector<moreau::Polyhedron<>> parts;
  for (const moreau::MeshGroup<>& group : moreau::read_mesh_groups(path, 1e-3))
    parts.push_back(moreau::hull_of_mesh(group.mesh));
  const moreau::Compound<moreau::Polyhedron<>> stone(parts, moreau::mass_properties(mesh, 1.0));
  CHECK(parts.size() == 3);
  CHECK(parts[0].volume() == doctest::Approx(2e-2 * 2e-2 * 2e-2));
  CHECK(stone.volume() == doctest::Approx(6e-2 * 2e-2 * 2e-2));
  CHECK_THROWS_WITH_AS(Compound<Polyhedron<>>(parts, mass_properties(mesh, 2700.0)),
                       doctest::Contains("at density 1"), std::invalid_argument);
}

TEST_CASE("a mesh far from the origin is refused, its digits are lost") {
  const TemporaryFolder folder("mesh");
  const auto far = write(folder, "far.obj", Parts::cube({1e6, 0, 0}, 20).obj());
  CHECK_THROWS_WITH_AS(read_mesh(far, 1e-3), doctest::Contains("move it to the origin"),
                       std::runtime_error);
  CHECK_THROWS_AS(read_mesh_groups(far, 1e-3), std::runtime_error);
  CHECK_NOTHROW(read_mesh(write(folder, "near.obj", Parts::cube({1e3, 0, 0}, 20).obj()), 1e-3));
}

TEST_CASE("bad arguments of the reader") {
  const TemporaryFolder folder("mesh");
  const auto path = write(folder, "a.obj", Parts::cube().obj());
  CHECK_THROWS_AS(read_mesh(path, 0.0), std::invalid_argument);
  CHECK_THROWS_AS(read_mesh_groups(path, -1.0), std::invalid_argument);
  CHECK_THROWS_AS(read_mesh(folder / "missing.obj", 1.0), std::runtime_error);
}

TEST_CASE("each mesh of the corpus gives its error, and the repair that was asked for") {
  const TemporaryFolder folder("mesh");
  const auto meshes = corpus();
  CHECK(meshes.size() >= 30);
  for (const BadMesh& bad : meshes) {
    CAPTURE(bad.name);
    Mesh mesh;
    const std::string error = error_of(write(folder, bad.name, bad.text), mesh);
    CHECK_MESSAGE(error.find(bad.error) == 0, error);
    if (!bad.repair) continue;
    bad.repair(mesh);
    const auto left = find_solid_fault(mesh);
    CHECK_MESSAGE(!left, left->message);
  }
}
