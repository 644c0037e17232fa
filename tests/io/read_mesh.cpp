// SPDX-License-Identifier: MIT
// Files of meshes. The corpus of bad meshes holds what scans and CAD programs really write; each
// gives the error in the table, and the repair that is asked for, if there is one, gives a solid.
#include "moreau/io/read_mesh.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstring>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
#include <limits>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "moreau/mesh/check_mesh.hpp"
#include "moreau/mesh/convex_of_mesh.hpp"
#include "moreau/mesh/repair_mesh.hpp"
#include "moreau/sample/concave_mesh.hpp"
#include "moreau/sample/random_rotation.hpp"
#include "moreau/shape/compound.hpp"
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
  const Parts huge = with([](Parts& p) {
    p.vertices[6] *= 1e308;
    p.vertices[6] *= 10;
  });
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
      {"no_face.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "file: "},
      {"text.stl", "this is not a mesh", "file: "},
      {"text.ply", "this is not a mesh", "file: "},
      {"cut_off.stl", short_stl, "file: "},
      {"lines.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nl 2 3\n", "file: "},
      {"stone.step", cube.obj(), "path = "},
      {"not_a_number.obj", not_a_number, "file: "},
      {"infinite.stl", infinite, "file: "},
      {"too_large.ply", huge.ply(), "file: "},
      {"beyond.obj", beyond.obj(), "file: "},
      {"beyond.ply", beyond.ply(), "file: "},
      {"one_triangle.obj", one.obj(), "triangles = 1 must be at least 4"},
      {"two_triangles.stl", pair.stl(), "triangles = 2 must be at least 4"},
      {"corner_twice.obj", zero_corner.obj(), "triangle 7 = (1, 1, 5) must have different corners"},
      {"collinear.obj", collinear.obj(), "triangle 1 = (0, 8, 2) must have an area that is not 0"},
      {"sliver.ply", sliver.ply(), "triangle 0 = (0, 8, 1)"},
      {"collapsed.stl", collapsed.stl(), "triangle 4 = (0, 2, 2) must have different corners"},
      {"hole.stl", hole.binary_stl(), "triangle 3 = "},
      {"half.ply", half.ply(), "triangle 0 = (0, 2, 1) must have a neighbour at its edge (1, 2)"},
      {"t_junction.obj", t_junction.obj(), "triangle 0 = (0, 2, 8) must have a neighbour"},
      {"gap.stl", gap.stl(), "triangle 3 = (4, 6, 7) must have a neighbour", by_weld},
      {"fin.obj", fin.obj(), "triangle 12 = (0, 1, 8) must not share the edge (0, 1)"},
      {"at_an_edge.stl", at_an_edge.stl(),
       "triangle 17 = (1, 11, 6) must not share the edge (1, 6)"},
      {"at_a_corner.stl", at_a_corner.stl(),
       "triangle 12 = (6, 8, 9) must not touch triangle 2 only at the vertex 6"},
      {"repeated.obj", repeated.obj(),
       "triangle 12 = (4, 6, 7) must not have the corners of triangle 3", by_drop},
      {"back_to_back.stl", back_to_back.stl(), "triangle 12 = ", by_drop},
      {"one_turned.obj", turned.obj(), "triangle 4 = (1, 0, 5) must have its outside", by_orient},
      {"some_turned.ply", some_turned.ply(), "triangle 1 = (3, 0, 2) must have its outside",
       by_orient},
      {"inside_out.stl", cube.reversed().stl(), "volume = -1 m^3 must be positive", by_orient},
      {"inside_out_with_gap.obj", gap.reversed().obj(), "triangle ", by_weld_and_orient},
      {"two_cubes.obj", two.obj(), "triangle 12 = (8, 10, 9) must be connected to triangle 0",
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

namespace {

std::string with_line_ends(const std::string& text, const char* end) {
  std::string other;
  for (const char c : text) c == '\n' ? other += end : other += c;
  return other;
}
std::string upper_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}
std::string utf16(const std::string& text, bool has_mark) {
  std::string wide = has_mark ? "\xFF\xFE" : "";
  for (const char c : text) wide += c, wide += '\0';
  return wide;
}
/// A binary PLY file of a cube with the numbers of another byte order, if asked for.
template <class Coordinate>
std::string binary_ply(const Parts& parts, bool is_big) {
  std::string text = parts.ply();
  text.resize(text.find("end_header"));
  text.replace(text.find("ascii"), 5, is_big ? "binary_big_endian" : "binary_little_endian");
  for (std::size_t at = text.find("float"); at != std::string::npos;
       at = text.find("float", at + 1))
    text.replace(at, 5, sizeof(Coordinate) == 8 ? "double" : "float32");
  text += "end_header\n";
  const auto put = [&](const auto& value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    if (is_big) std::reverse(bytes, bytes + sizeof value);
    text.append(bytes, sizeof value);
  };
  for (const auto& x : parts.vertices)
    for (const double c : x) put(static_cast<Coordinate>(c));
  for (const auto& t : parts.triangles) {
    put(std::uint8_t(3));
    for (const int v : t) put(std::int32_t(v));
  }
  return text;
}

struct NamedText {
  const char* name;
  std::string text;
};

}  // namespace

TEST_CASE("the same cube as many programs write it") {
  const TemporaryFolder folder("mesh");
  const Parts cube = Parts::cube();
  const std::string quads =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
  const std::string faces = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  std::string solid = cube.binary_stl(), padded = cube.stl(), colours = cube.ply();
  solid.replace(0, 31, "solid made by a careless writer");
  padded.insert(0, "  \n\t");
  const std::string property = "property float z\n";
  colours.insert(colours.find(property) + property.size(), "property uchar red\n");
  for (std::size_t at = colours.find("end_header\n") + 11, k = 0; k < 8; ++k) {
    at = colours.find('\n', at);
    colours.insert(at, " 255");
    at += 5;
  }
  std::string commented = cube.ply();
  commented.insert(commented.find("element"), "comment made by hand\nobj_info 3 4 5\n");
  std::string others =
      "# a cube\nmtllib none.mtl\no cube\n" + quads + "vt 0 0\nvn 0 0 1\nusemtl red\ns off\n";
  const std::vector<NamedText> files{
      {"upper.stl", upper_case(cube.stl())},
      {"windows.stl", with_line_ends(cube.stl(), "\r\n")},
      {"windows.obj", with_line_ends(cube.obj(), "\r\n")},
      {"windows.ply", with_line_ends(cube.ply(), "\r\n")},
      {"one_line.stl", with_line_ends(cube.stl(), "\n").replace(10, 1, "\n ")},
      {"marked.obj", "\xEF\xBB\xBF" + cube.obj()},
      {"marked.stl", "\xEF\xBB\xBF" + cube.stl()},
      {"padded.stl", padded},
      {"solid.stl", solid},
      {"quads.obj", quads + faces},
      {"slashes.obj", others +
                          "f 1/1/1 4/1/1 3/1/1 2/1/1\nf 5//1 6//1 7//1 8//1\nf 1/1 2/1 6/1 5/1\n" +
                          "f 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"},
      {"counted_back.obj", quads + "f -8 -5 -6 -7\nf -4 -3 -2 -1\nf -8 -7 -3 -4\nf -7 -6 -2 -3\n" +
                               "f -6 -5 -1 -2\nf -5 -8 -4 -1\n"},
      {"comment.obj", "# exported from C:\\scans \\\n" + quads + "# end \\\n" + faces},
      {"continued.obj", quads + "f 1 4 \\\n 3 2\n" + faces.substr(faces.find('\n') + 1)},
      {"no_end.obj", (quads + faces).substr(0, quads.size() + faces.size() - 1)},
      {"tabs.obj",
       [&] {
         std::string text = quads + faces;
         std::replace(text.begin(), text.end(), ' ', '\t');
         return text;
       }()},
      {"weights.obj",
       [&] {
         std::string text;
         for (const char c : quads) c == '\n' ? text += " 1 0.5 0.5 0.5\n" : text += c;
         return text + faces;
       }()},
      {"exponents.obj", "v 0e0 +0 .0\nv 1e+0 0 0\nv 10e-1 1.000 0\nv 0 1. 0\n" +
                            quads.substr(quads.find("v 0 0 1")) + faces},
      {"colours.ply", colours},
      {"commented.ply", commented},
      {"little.ply", binary_ply<float>(cube, false)},
      {"big.ply", binary_ply<float>(cube, true)},
      {"little_double.ply", binary_ply<double>(cube, false)},
      {"big_double.PLY", binary_ply<double>(cube, true)},
  };
  for (const auto& file : files) {
    const std::string &name = file.name, &text = file.text;  // clang 14 captures no bindings
    CAPTURE(name);
    Mesh mesh;
    CHECK_NOTHROW(mesh = read_mesh(write(folder, name, text), 1.0));
    CHECK(mesh.vertices.size() == 8);
    CHECK(mesh.facets.size() == 12);
    const auto fault = find_solid_fault(mesh);
    CHECK_MESSAGE(!fault, fault->message);
    CHECK(volume_of(mesh) == doctest::Approx(1));
  }
}

TEST_CASE("polygons of any number of corners, convex or not") {
  const TemporaryFolder folder("mesh");
  for (int n = 3; n < 40; ++n)
    for (const double dent : {1.0, 0.4}) {  // a prism over a star
      std::ostringstream text;
      double area = 0;
      for (int z = 0; z < 2; ++z)
        for (int k = 0; k < n; ++k) {
          const double angle = 2 * 3.14159265358979 * k / n, r = k % 2 == 0 ? 1 : dent;
          text << "v " << r * std::cos(angle) << ' ' << r * std::sin(angle) << ' ' << z << '\n';
          const double next = (k + 1) % n % 2 == 0 ? 1 : dent;
          if (z == 0) area += r * next * std::sin(2 * 3.14159265358979 / n) / 2;
        }
      for (int k = 0; k < n; ++k)
        text << "f " << k + 1 << ' ' << (k + 1) % n + 1 << ' ' << (k + 1) % n + 1 + n << ' '
             << k + 1 + n << '\n';
      text << "f";
      for (int k = n; k > 0; --k) text << ' ' << k;
      text << "\nf";
      for (int k = 1; k <= n; ++k) text << ' ' << k + n;
      text << '\n';
      CAPTURE(text.str());
      const Mesh mesh = read_mesh(write(folder, "star.obj", text.str()), 1.0);
      CHECK(mesh.facets.size() == std::size_t(4 * n - 4));
      const auto fault = find_solid_fault(mesh);
      CHECK_MESSAGE(!fault, fault->message);
      CHECK(volume_of(mesh) == doctest::Approx(area).epsilon(1e-4));
    }
}

TEST_CASE("a file that is damaged, or is something else, gives an error with its name") {
  const TemporaryFolder folder("mesh");
  const Parts cube = Parts::cube();
  const std::string obj = cube.obj(), stl = cube.stl(), ply = cube.ply(),
                    binary = cube.binary_stl();
  const auto edited = [](std::string text, const std::string& old, const std::string& now) {
    return text.replace(text.find(old), old.size(), now);
  };
  const auto counted = [&](std::uint32_t count) {
    std::string text = binary;
    std::memcpy(&text[80], &count, 4);
    return text;
  };
  std::string noise(4000, ' '), nan = binary;
  for (std::size_t k = 0; k < noise.size(); ++k) noise[k] = char(k * k * 2654435761U >> 24);
  const float not_a_number = std::nanf("");
  std::memcpy(&nan[84 + 50 + 12], &not_a_number, 4);
  const std::string little = binary_ply<float>(cube, false);
  std::vector<NamedText> files{
      {"utf16.obj", utf16(obj, true)},
      {"utf16.stl", utf16(stl, true)},
      {"utf16.ply", utf16(ply, true)},
      {"wide.obj", utf16(obj, false)},
      {"wide.stl", utf16(stl, false)},
      {"wide.ply", utf16(ply, false)},
      {"noise.obj", noise},
      {"noise.stl", noise},
      {"noise.ply", noise},
      {"text.obj", "this is not a mesh\n"},
      {"page.obj", "<html><body>Not found</body></html>\n"},
      {"page.stl", "<html><body>Not found</body></html>" + std::string(200, '\n')},
      {"page.ply", "<html><body>Not found</body></html>\n"},
      {"empty.stl", ""},
      {"empty.ply", ""},
      {"blank.obj", "\n\n  \n"},
      {"blank.stl", "  \n"},
      {"blank.ply", "  \n"},
      {"header.stl", binary.substr(0, 84)},
      {"none.stl", counted(0).substr(0, 84)},
      {"no_facet.stl", "solid a\nendsolid a\n"},
      {"too_many.stl", counted(13)},
      {"too_few.stl", counted(11)},
      {"absurd.stl", counted(4000000000U)},
      {"nan.stl", nan},
      {"stl.obj", stl},
      {"obj.stl", obj},
      {"ply.stl", ply},
      {"stl.ply", stl},
      {"binary.obj", binary},
      {"two_corners.obj", obj + "f 1 2\n"},
      {"word.obj", edited(obj, "f 1 3 2", "f 1 x 2")},
      {"zeroth.obj", edited(obj, "f 1 3 2", "f 0 3 2")},
      {"half.obj", edited(obj, "f 1 3 2", "f 1.5 3 2")},
      {"early.obj", "f 1 2 3\n" + obj},
      {"short.obj", edited(obj, "v 1 0 0", "v 1 0")},
      {"comma.obj", edited(obj, "v 1 0 0", "v 1,0 0 0")},
      {"huge.obj", edited(obj, "v 1 0 0", "v 1e999 0 0")},
      {"comma.stl", edited(stl, "vertex 1 1 0", "vertex 1,0 1 0")},
      {"typing.stl", edited(stl, "endloop", "endlop")},
      {"four.stl", edited(stl, "endloop", "vertex 0 0 0\nendloop")},
      {"no_header_end.ply", ply.substr(0, ply.find("end_header"))},
      {"type.ply", edited(ply, "float x", "real x")},
      {"format.ply", edited(ply, "ascii", "binary")},
      {"more_vertices.ply", edited(ply, "vertex 8", "vertex 9")},
      {"many_vertices.ply", edited(ply, "vertex 8", "vertex 4000000000")},
      {"more_faces.ply", edited(ply, "face 12", "face 13")},
      {"fewer_faces.ply", edited(ply, "face 12", "face 11")},
      {"fewer_vertices.ply", edited(ply, "vertex 8", "vertex 7")},
      {"points.ply", edited(ply, "face 12", "face 0")},
      {"line.ply", edited(ply, "3 0 2 1", "2 0 2")},
      {"negative.ply", edited(ply, "3 0 2 1", "3 0 -2 1")},
      {"strips.ply", edited(ply, "element face", "element tristrips")},
      {"upper_case.ply", edited(ply, "float x", "float X")},
      {"no_height.ply", edited(ply, "float z", "float pz")},
      {"twice.ply", edited(ply, "float z", "float y")},
      {"upper_case_little.ply", edited(little, "float32 y", "float32 Y")},
      {"cut_off_little.ply", little.substr(0, little.size() - 5)},
      {"long_list.ply",
       edited(little, std::string("\3\0\0\0\0", 5), std::string("\xff\0\0\0\0", 5))},
  };
  // Cut anywhere: each gives an error, or the triangles before the cut.
  for (const auto& [name, text] : {NamedText{"cut.stl", stl},
                                   {"cut_binary.stl", binary},
                                   {"cut.ply", ply},
                                   {"cut_little.ply", little}})
    for (std::size_t size = 1; size + 14 < text.size(); size += 53)
      files.push_back({name, text.substr(0, size)});
  CHECK(files.size() > 100);
  for (const auto& file : files) {
    const std::string &name = file.name, &text = file.text;  // clang 14 captures no bindings
    CAPTURE(name);
    CAPTURE(text.size());
    const auto path = write(folder, name, text);
    for (const bool in_groups : {false, true}) {
      std::string message;
      try {
        in_groups ? void(read_mesh_groups(path, 1.0)) : void(read_mesh(path, 1.0));
      } catch (const std::runtime_error& error) {
        message = error.what();
      }
      CHECK_MESSAGE(message.find(path.string()) == 0, message);
      CHECK(message.size() < path.string().size() + 200);
    }
  }
  CHECK_THROWS_WITH_AS(read_mesh(write(folder, "a.obj", utf16(obj, true)), 1.0),
                       doctest::Contains("UTF-16"), std::runtime_error);
  CHECK_THROWS_WITH_AS(read_mesh(write(folder, "b.obj", edited(obj, "v 1 1 0", "v 1 l 0")), 1.0),
                       doctest::Contains("b.obj: line 3: 'l' must be a number"),
                       std::runtime_error);
  std::filesystem::create_directory(folder / "folder.obj");
  CHECK_THROWS_WITH_AS(read_mesh(folder / "folder.obj", 1.0),
                       doctest::Contains("folder.obj': Is a directory"), std::runtime_error);
}

TEST_CASE("numbers that no double holds are 0 or infinite") {
  const auto value_of = [](const std::string& word) {
    double value = 7;
    CHECK(detail::parse_number(word, value));
    return value;
  };
  const double infinity = std::numeric_limits<double>::infinity();
  for (const std::string& word :
       {std::string("1.5e-400"), std::string("-1e-4000"), "0." + std::string(400, '0') + "1",
        "0." + std::string(500, '0') + "1e+100", std::string("1e-99999999999999999999999")})
    CHECK(value_of(word) == 0);
  for (const std::string& word :
       {std::string("1.5e400"), std::string("+1E+4000"), "1" + std::string(400, '0') + ".5",
        "1" + std::string(500, '0') + "e-100", std::string("1e99999999999999999999999")}) {
    CHECK(value_of(word) == infinity);
    if (word.front() != '+') CHECK(value_of("-" + word) == -infinity);
  }
  CHECK(std::signbit(value_of("-1e-400")));
}

TEST_CASE("bytes changed at random give a mesh or an error") {
  const Parts cube = Parts::cube();
  std::mt19937 random(7);
  int errors = 0, meshes = 0;
  const std::vector<std::pair<std::string, detail::MeshFile (*)(std::string_view)>> files{
      {cube.obj(), detail::read_obj},
      {cube.stl(), detail::read_stl},
      {cube.binary_stl(), detail::read_stl},
      {cube.ply(), detail::PlyReader::read},
      {binary_ply<float>(cube, false), detail::PlyReader::read},
      {binary_ply<double>(cube, true), detail::PlyReader::read}};
  for (const auto& [text, read] : files)
    for (int trial = 0; trial < 3000; ++trial) {
      std::string changed = text;
      for (unsigned k = 0; k < 1 + random() % 4; ++k) {
        const std::size_t at = random() % changed.size();
        if (random() % 4 == 0)
          changed.erase(at, 1 + random() % 20);
        else
          changed[at] = random() % 2 == 0 ? "0123456789-+. \n/"[random() % 16] : char(random());
        if (changed.empty()) changed = " ";
      }
      try {
        const detail::MeshFile file = read(changed);
        for (const auto& triangle : file.triangles)
          for (const std::uint32_t v : triangle) REQUIRE(v < file.vertices.size());
        for (const auto& x : file.vertices) REQUIRE(x.allFinite());
        ++meshes;
      } catch (const std::runtime_error&) {
        ++errors;
      }
    }
  CHECK(errors > 6000);
  CHECK(meshes > 1000);
}

TEST_CASE("a hull needs only vertices: of any mesh of the corpus") {
  const TemporaryFolder folder("mesh");
  int count = 0;
  for (const BadMesh& bad : corpus()) {
    CAPTURE(bad.name);
    if (std::string(bad.error) == "file: " || std::string(bad.error) == "path = " ||
        bad.name == std::string("flat.obj") || bad.name == std::string("one_triangle.obj") ||
        bad.name == std::string("two_triangles.stl"))
      continue;
    const Mesh mesh = read_mesh(write(folder, bad.name, bad.text), 1.0);
    CHECK(hull_of_mesh(mesh).vertex_count() >= 4);
    ++count;
  }
  CHECK(count >= 20);
}

TEST_CASE("triangles without an area are removed, and the surface stays closed") {
  std::mt19937 random(1);
  for (int trial = 0; trial < 30; ++trial) {
    CAPTURE(trial);
    Mesh mesh;
    const Parts cube = Parts::cube();
    mesh.vertices.assign(cube.vertices.begin(), cube.vertices.end());
    for (const auto& t : cube.triangles)
      mesh.facets.push_back({std::uint32_t(t[0]), std::uint32_t(t[1]), std::uint32_t(t[2])});
    // Cuts edges in their middle on one side only: the gap is closed by a triangle without an area.
    for (int cut = 0; cut < 1 + trial % 4; ++cut) {
      const std::size_t f = random() % mesh.facets.size(), k = random() % 3;
      const auto facet = mesh.facets[f];
      const std::uint32_t a = facet[k], b = facet[(k + 1) % 3], c = facet[(k + 2) % 3];
      const auto m = std::uint32_t(mesh.vertices.size());
      mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]) / 2);
      mesh.facets[f] = {a, m, c};
      mesh.facets.push_back({m, b, c});
      mesh.facets.push_back({a, b, m});
    }
    const auto before = find_solid_fault(mesh);
    REQUIRE(before);
    CHECK(before->defect == MeshDefect::degenerate);
    CHECK(hull_of_mesh(mesh).vertex_count() == 8);
    CHECK(drop_flat_triangles(mesh) >= std::size_t(1 + trial % 4));
    const auto left = find_solid_fault(mesh);
    CHECK_MESSAGE(!left, left->message);
    CHECK(volume_of(mesh) == doctest::Approx(1));
    CHECK(drop_flat_triangles(mesh) == 0);
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

TEST_CASE("groups of the same name are one group within an object, not across objects") {
  const TemporaryFolder folder("mesh");
  const auto tetrahedron = [](int x) {
    std::ostringstream text;
    text << "v " << x << " 0 0\nv " << x + 1 << " 0 0\nv " << x << " 1 0\nv " << x << " 0 1\n";
    for (const char* corners : {"-4 -2 -3", "-4 -3 -1", "-3 -2 -1", "-4 -1 -2"})
      text << "f " << corners << '\n';
    return text.str();
  };
  const auto path =
      write(folder, "objects.obj",
            "o A\ng default\n" + tetrahedron(0) + "g other\n" + tetrahedron(5) + "g default\n" +
                tetrahedron(2) + "o B\ng default\n" + tetrahedron(10) + "o B\n" + tetrahedron(20));
  const auto groups = read_mesh_groups(path, 1.0);
  REQUIRE(groups.size() == 4);
  const char* names[] = {"default", "other", "default", "B"};
  const double volumes[] = {2. / 6, 1. / 6, 1. / 6, 1. / 6};
  for (std::size_t g = 0; g < groups.size(); ++g) {
    CHECK(groups[g].name == names[g]);
    CHECK(volume_of(groups[g].mesh) == doctest::Approx(volumes[g]));
  }
  CHECK(read_mesh(path, 1.0).facets.size() == 20);
  // Each solid of an STL file is complete, whatever its name.
  std::string solids = Parts::cube().stl();
  solids += Parts::cube(Vector(5, 0, 0)).stl();
  const auto of_stl = read_mesh_groups(write(folder, "solids.stl", solids), 1.0);
  REQUIRE(of_stl.size() == 2);
  for (const auto& group : of_stl) CHECK(volume_of(group.mesh) == doctest::Approx(1));
}

namespace {

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& f : mesh.facets) {
    const Vector &a = mesh.vertices[f[0]], &b = mesh.vertices[f[1]], &c = mesh.vertices[f[2]];
    area += (b - a).cross(c - a).norm() / 2;
  }
  return area;
}

/// A polygon as a file: one vertex per corner.
std::string polygon_file(const std::vector<Vector>& corners, bool reversed = false) {
  std::ostringstream text;
  text.precision(17);
  for (const Vector& x : corners) text << "v " << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
  text << 'f';
  for (std::size_t k = 0; k < corners.size(); ++k)
    text << ' ' << (reversed ? corners.size() - k : k + 1);
  text << '\n';
  return text.str();
}

}  // namespace

TEST_CASE("a polygon with holes keeps them open, also with a vertex for each corner") {
  const TemporaryFolder folder("mesh");
  // The bottom of a silo with one and with two square outlets; a cut joins the rim and each outlet.
  const std::vector<Vector> outline{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0}},
      hole{{1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}};
  std::vector<Vector> one = outline, two{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}};
  one.insert(one.end(), hole.begin(), hole.end());
  two.insert(two.end(),
             {Vector(2, 2, 0), Vector(2, 1.5, 0), Vector(1.5, 1.5, 0), Vector(1.5, 2, 0),
              Vector(2, 2, 0), Vector(3, 3, 0), Vector(0, 3, 0), Vector(0, 0, 0), Vector(1, 1, 0),
              Vector(0.5, 1, 0), Vector(0.5, 1.2, 0), Vector(1, 1.2, 0), Vector(1, 1, 0)});
  const std::pair<std::vector<Vector>, double> cases[] = {{one, 8}, {two, 9 - 0.25 - 0.1}};
  for (const auto& [corners, area] : cases)
    for (const bool reversed : {false, true})
      for (std::size_t first = 0; first < corners.size(); ++first) {
        CAPTURE(first);
        std::vector<Vector> turned = corners;
        std::rotate(turned.begin(), turned.begin() + std::ptrdiff_t(first), turned.end());
        const auto mesh =
            read_mesh(write(folder, "bottom.obj", polygon_file(turned, reversed)), 1.0);
        CHECK(area_of(mesh) == doctest::Approx(area));
        CHECK_FALSE(find_wall_fault<Space<3>>(mesh).has_value());
        for (const auto& f : mesh.facets) {
          const Vector middle =
              (mesh.vertices[f[0]] + mesh.vertices[f[1]] + mesh.vertices[f[2]]) / 3;
          if (&corners == &cases[0].first)
            CHECK_FALSE((middle[0] > 1 && middle[0] < 2 && middle[1] > 1 && middle[1] < 2));
        }
      }
}

TEST_CASE("faces with thousands of corners are divided in a time that grows as their reflex ones") {
  const TemporaryFolder folder("mesh");
  for (const bool gear : {false, true}) {
    const int teeth = gear ? 1000 : 10000, corners = gear ? 4 : 1;
    std::vector<Vector> outline;
    double area = 0;
    for (int k = 0; k < teeth; ++k)
      for (int c = 0; c < corners; ++c) {
        const double angle = 2 * 3.14159265358979323846 * (k + c / 4.) / teeth;
        outline.push_back((c == 1 || c == 2 ? 1.01 : 1.) *
                          Vector(std::cos(angle), std::sin(angle), 0));
      }
    for (std::size_t k = 0; k < outline.size(); ++k)
      area += outline[k].cross(outline[(k + 1) % outline.size()])[2] / 2;
    const auto begin = std::chrono::steady_clock::now();
    const auto mesh = read_mesh(write(folder, "cap.obj", polygon_file(outline)), 1.0);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    CHECK(mesh.facets.size() == outline.size() - 2);
    CHECK(area_of(mesh) == doctest::Approx(area));
    MESSAGE(outline.size() << " corners: " << took.count() << " s");
  }
}

TEST_CASE("curved surfaces of an OBJ file are refused: without them a wall would have openings") {
  const TemporaryFolder folder("mesh");
  const std::string patch = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\ncstype bezier\ndeg 1 1\n";
  CHECK_THROWS_WITH_AS(
      read_mesh(write(folder, "patch.obj", patch + "surf 0 1 0 1 1 2 3 4\nend\n"), 1.0),
      doctest::Contains("line 8: 'surf' is a free-form surface"), std::runtime_error);
  CHECK_THROWS_WITH_AS(read_mesh(write(folder, "curve.obj", patch + "curv 0 1 1 2\nend\n"), 1.0),
                       doctest::Contains("line 8: 'curv'"), std::runtime_error);
  CHECK(read_mesh(write(folder, "plain.obj", patch), 1.0).facets.size() == 1);
}

TEST_CASE(
    "a file of many groups: each has its own vertices and no memory for those of the others") {
  const TemporaryFolder folder("mesh");
  std::ostringstream text;
  constexpr int count = 300;
  for (int k = 0; k < count; ++k) {
    text << "o stone" << k << "\nv " << k << " 0 0\nv " << k + 0.5 << " 0 0\nv " << k << " 1 0\nv "
         << k << " 0 1\n";
    for (const char* corners : {"-4 -2 -3", "-4 -3 -1", "-3 -2 -1", "-4 -1 -2"})
      text << "f " << corners << '\n';
  }
  const auto path = write(folder, "many.obj", text.str());
  const auto groups = read_mesh_groups(path, 1.0);
  REQUIRE(groups.size() == std::size_t(count));
  std::size_t memory = 0;
  for (const auto& group : groups) {
    CHECK(group.mesh.vertices.size() == 4);
    CHECK(volume_of(group.mesh) == doctest::Approx(0.5 / 6));
    memory += group.mesh.vertices.capacity();
  }
  CHECK(memory <= 8 * std::size_t(count));
  const auto pieces = pieces_of(read_mesh(path, 1.0));
  REQUIRE(pieces.size() == std::size_t(count));
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    CHECK(pieces[k].vertices == groups[k].mesh.vertices);
    CHECK(pieces[k].facets == groups[k].mesh.facets);
  }
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

namespace {

/// A turned box in the files that programs write.
/// @param write_number function: stream, coordinate -> its text
template <class Write>
std::string box_file(const Parts& box, const std::string& kind, const Write& write_number) {
  std::ostringstream out;
  const auto corner = [&](const char* word, const Vector& x) {
    out << word;
    for (int k = 0; k < 3; ++k) write_number(out << ' ', x[k]);
    out << '\n';
  };
  if (kind == "stl") {
    out << "solid box\n";
    for (const auto& t : box.triangles) {
      out << "facet normal 0.577350269 0.577350269 0.577350269\nouter loop\n";
      for (const int v : t) corner("vertex", box.vertices[std::size_t(v)]);
      out << "endloop\nendfacet\n";
    }
    out << "endsolid box\n";
    return out.str();
  }
  if (kind == "ply")
    out << "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty "
           "float z\n"
           "element face 12\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& x : box.vertices) corner(kind == "ply" ? "" : "v", x);
  for (const auto& t : box.triangles)
    if (kind == "ply")
      out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
    else
      out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  return out.str();
}

}  // namespace

TEST_CASE("the hull of a turned box has six faces, whatever digits its file has") {
  const TemporaryFolder folder("mesh");
  std::mt19937_64 random(4);
  const auto decimals = [](auto& out, double x) { out << std::fixed << std::setprecision(6) << x; };
  const auto digits = [](auto& out, double x) {
    out << std::defaultfloat << std::setprecision(6) << x;
  };
  const auto exponents = [](auto& out, double x) {
    out << std::scientific << std::setprecision(6) << x;
  };
  const auto floats = [](auto& out, double x) {
    out << std::defaultfloat << std::setprecision(9) << float(x);
  };
  const auto doubles = [](auto& out, double x) {
    out << std::defaultfloat << std::setprecision(17) << x;
  };
  for (int k = 0; k < 10; ++k) {
    for (const double size : {0.01, 1.0, 20.0}) {
      Parts box = Parts::cube(Vector(-0.5, -0.5, -0.5));
      const auto rotation = random_rotation<Space<3>>(random);
      for (Vector& x : box.vertices) x = size * (rotation * Vector(1.5 * x[0], x[1], 0.7 * x[2]));
      CAPTURE(size);
      std::vector<std::pair<std::string, std::string>> files{{"binary.stl", box.binary_stl()}};
      for (const std::string kind : {"obj", "stl", "ply"}) {
        files.emplace_back("decimals." + kind, box_file(box, kind, decimals));
        files.emplace_back("digits." + kind, box_file(box, kind, digits));
        files.emplace_back("exponents." + kind, box_file(box, kind, exponents));
        files.emplace_back("floats." + kind, box_file(box, kind, floats));
        files.emplace_back("doubles." + kind, box_file(box, kind, doubles));
      }
      for (const auto& [name, text] : files) {
        CAPTURE(name);
        const auto path = write(folder, name, text);
        const Mesh mesh = read_mesh(path, 1e-2);
        // Half a unit of the last digit, or of the last bit of a float.
        const double error = name.starts_with("doubles")    ? 1e-15
                             : name.starts_with("decimals") ? std::max(5.1e-7 / size, 6e-8)
                                                            : 5e-6;
        CHECK(mesh.rounding <= 1e-2 * size * error);
        if (!name.starts_with("doubles")) CHECK(mesh.rounding >= 1e-2 * size * 2e-8);
        const Polyhedron<> hull = hull_of_mesh(mesh);
        CHECK(hull.face_count() == 6);
        CHECK(hull.vertex_count() == 8);
        CHECK(convex_of_mesh(mesh).face_count() == 6);
        CHECK(hull_of_mesh(scaled(mesh, 3.0)).face_count() == 6);
        CHECK(hull_of_mesh(pieces_of(mesh)[0]).face_count() == 6);
        CHECK(hull_of_mesh(read_mesh_groups(path, 1e-2)[0].mesh).face_count() == 6);
        CHECK(hull.volume() == doctest::Approx(1.05e-6 * size * size * size).epsilon(1e-3));
        const TriangleMesh<float> in_float = read_mesh(path, 1e-2f);
        CHECK(hull_of_mesh(in_float).face_count() == 6);
      }
    }
  }
}

// A corner at 0.5 is meant to be there: 2 faces of this solid differ by 0.01 of its size.
TEST_CASE("a file with few digits is taken at its word") {
  const TemporaryFolder folder("mesh");
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1.01\nv 0 1 1\n"
      "f 1 4 3 2\nf 5 6 7\nf 5 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const Mesh mesh = read_mesh(write(folder, "wedge.obj", text), 1.0);
  CHECK(hull_of_mesh(mesh).face_count() == 7);
  CHECK(mesh.rounding < 1e-7);
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
