// SPDX-License-Identifier: MIT
#include "moreau/io/vtk.hpp"

#include <cstdint>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <limits>
#include <map>
#include <span>
#include <stdexcept>
#include <vector>

#include "moreau/shape/capsule.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

#include "detect/shapes.hpp"
#include "io/faults.hpp"
#include "io/temporary_folder.hpp"
#include "io/vtk_samples.hpp"
#include "io/vtp.hpp"

namespace {

using namespace moreau;
using namespace vtk_samples;
using On = VtkPolyData::On;

}  // namespace

TEST_CASE("polyhedra are written as their faces with the grain's values on each") {
  using S = Space<3>;
  const TemporaryFolder folder("vtk");
  const auto path = folder / "grains_000.vtp";
  const Polyhedron<double> shape = tetrahedron();
  const Pose<S> poses[] = {{S::Vector(0, 0, 0), S::exp({0, 0, 0.5})},
                           {S::Vector(5, 6, 7), S::exp({1, 0, 0})}};
  VtkWriter<S> writer;
  for (int again = 0; again < 2; ++again)
    writer.write_grains(
        path, 2, [&](std::size_t) -> const auto& { return shape; },
        [&](std::size_t k) { return poses[k]; },
        [](std::size_t k) -> S::Twist { return S::Twist::Constant(double(k)); });
  const Vtp file(path);
  CHECK(file.count("Points") == 8);
  CHECK(file.count("Polys") == 8);
  CHECK(file.count("Verts") == 0);
  const auto points = file.array<float>("Points", "Points");
  const auto corners = file.array<std::int32_t>("Polys", "connectivity");
  const auto ends = file.array<std::int32_t>("Polys", "offsets");
  const auto id = file.array<std::int32_t>("CellData", "id");
  const auto velocity = file.array<float>("CellData", "velocity");
  REQUIRE(points.size() == 24);
  REQUIRE(corners.size() == 24);
  CHECK(ends == std::vector<std::int32_t>{3, 6, 9, 12, 15, 18, 21, 24});
  CHECK(id == std::vector<std::int32_t>{0, 0, 0, 0, 1, 1, 1, 1});
  CHECK(velocity.size() == 24);
  CHECK(velocity[23] == 1);
  CHECK(file.array<float>("CellData", "size")[0] ==
        doctest::Approx(2 * shape.circumradius()).epsilon(1e-6));
  CHECK(file.array<float>("CellData", "speed")[7] == doctest::Approx(std::sqrt(3.0)));

  // The volume enclosed by the written surface equals the volume of each grain. This checks points,
  // faces and the orientation of the faces.
  for (int grain = 0; grain < 2; ++grain) {
    double volume = 0;
    for (int f = 4 * grain; f < 4 * grain + 4; ++f) {
      Eigen::Matrix3d x;
      for (int k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis)
          x(axis, k) = double(points[std::size_t(3 * corners[std::size_t(3 * f + k)] + axis)]);
      volume += (x.colwise() - poses[grain].position).determinant() / 6;
    }
    CHECK(volume == doctest::Approx(1.0 / 6).epsilon(1e-5));
  }
}

TEST_CASE("polygons are one cell each, disks and balls points") {
  const TemporaryFolder folder("vtk");
  const auto still = [](auto twist) { return [twist](std::size_t) { return twist; }; };
  {
    using S = Space<2, float>;
    const std::vector<S::Vector> v = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    const Polygon<float> square{std::span<const S::Vector>(v)};
    VtkWriter<S>().write_grains(
        folder / "polygons.vtp", 3, [&](std::size_t) -> const auto& { return square; },
        [](std::size_t k) {
          return Pose<S>{S::Vector(float(k), 0), S::identity()};
        },
        still(S::Twist(1, 2, 3)));
    const Vtp file(folder / "polygons.vtp");
    CHECK(file.count("Points") == 12);
    CHECK(file.count("Polys") == 3);
    CHECK(file.array<std::int32_t>("Polys", "offsets") == std::vector<std::int32_t>{4, 8, 12});
    CHECK(file.array<float>("CellData", "velocity")[4] == 2);
    CHECK(file.array<float>("CellData", "velocity")[5] == 0);
    CHECK(file.array<float>("CellData", "spin")[2] == 3);
    CHECK(file.array<float>("Points", "Points")[35] == 0);
  }
  using S = Space<3>;
  VtkWriter<S>().write_grains(
      folder / "balls.vtp", 4, [](std::size_t k) { return Ball<double>(double(k + 1)); },
      [](std::size_t k) {
        return Pose<S>{S::Vector::Constant(double(k)), S::identity()};
      },
      still(S::Twist(S::Twist::Zero())));
  const Vtp file(folder / "balls.vtp");
  CHECK(file.count("Verts") == 4);
  CHECK(file.array<std::int32_t>("Verts", "connectivity") == std::vector<std::int32_t>{0, 1, 2, 3});
  CHECK(file.array<float>("PointData", "size") == std::vector<float>{2, 4, 6, 8});
}

TEST_CASE_TEMPLATE("every shape is drawn by its surface", S, Space<2>, Space<3>) {
  using Core =
      std::remove_cvref_t<decltype(samples::grain(S{}, *std::declval<std::mt19937_64*>()))>;
  using Shape = OneOf<BallIn<S>, CapsuleIn<S>, Core, Rounded<Core>>;
  std::mt19937_64 random(4);
  const Core core = samples::grain(S{}, random);
  const Shape shapes[] = {BallIn<S>(0.7), CapsuleIn<S>(1, 0.3), core, Rounded<Core>(core, 0.2)};
  const TemporaryFolder folder("vtk");
  VtkWriter<S>({4}).write_grains(
      folder / "mixed.vtp", 4, [&](std::size_t k) -> const Shape& { return shapes[k]; },
      [](std::size_t k) {
        return Pose<S>{4 * double(k) * S::Vector::UnitX(), S::identity()};
      },
      [](std::size_t) -> typename S::Twist { return S::Twist::Zero(); });
  const Vtp file(folder / "mixed.vtp");
  const auto points = file.array<float>("Points", "Points");
  const auto corners = file.array<std::int32_t>("Polys", "connectivity");
  const auto ends = file.array<std::int32_t>("Polys", "offsets");
  const auto id = file.array<std::int32_t>("CellData", "id");
  REQUIRE(ends.size() == id.size());
  const auto x = [&](std::int32_t point, int axis) {
    return double(points[std::size_t(3 * point + axis)]);
  };
  // The enclosed volume is computed as a sum over fans of triangles, relative to an arbitrary point
  // (in the plane, line).
  double enclosed[4] = {};
  std::size_t first = 0;
  for (std::size_t f = 0; f < ends.size(); ++f) {
    const double origin = 4 * id[f];
    for (std::size_t k = first; k < std::size_t(ends[f]); ++k) {
      const auto p = corners[first], q = corners[k],
                 r = corners[k + 1 < std::size_t(ends[f]) ? k + 1 : first];
      if (S::angular_dim == 1) {
        enclosed[id[f]] += ((x(q, 0) - origin) * x(r, 1) - x(q, 1) * (x(r, 0) - origin)) / 2;
      } else {
        Eigen::Matrix3d sides;
        for (int axis = 0; axis < 3; ++axis) sides.row(axis) << x(p, axis), x(q, axis), x(r, axis);
        sides.row(0).array() -= origin;
        enclosed[id[f]] += sides.determinant() / 6;
      }
    }
    first = std::size_t(ends[f]);
  }
  for (int k = 0; k < 4; ++k) {
    // The enclosed volume is smaller than the exact volume, because the surface is inscribed.
    CHECK(enclosed[k] < shapes[k].volume() * (1 + 1e-5));
    CHECK(enclosed[k] == doctest::Approx(shapes[k].volume()).epsilon(k == 2 ? 1e-5 : 0.03));
  }
  CHECK_THROWS_AS(VtkWriter<S>({-1}), std::invalid_argument);
  CHECK_THROWS_AS(VtkWriter<S>({7}), std::invalid_argument);
}

TEST_CASE("fields are points with means, where there are grains") {
  const TemporaryFolder folder("vtk");
  using S = Space<2>;
  GridField<S> field({S::Vector(0, 0), S::Vector(2, 2)}, {2, 2});
  field.add(S::Vector(1.5, 0.5), S::Vector(3, 4));
  VtkWriter<S>().write_field(folder / "field.vtp", field);
  const Vtp file(folder / "field.vtp");
  CHECK(file.count("Verts") == 1);
  CHECK(file.array<float>("Points", "Points") == std::vector<float>{1.5, 0.5, 0});
  CHECK(file.array<float>("PointData", "value") == std::vector<float>{3, 4, 0});
  CHECK(file.array<std::int32_t>("PointData", "grains") == std::vector<std::int32_t>{1});
}

TEST_CASE("contacts are lines with their force, boxes their edges") {
  const TemporaryFolder folder("vtk");
  using S = Space<3>;
  VtkWriter<S> writer;
  const std::vector<ContactSegment<S>> contacts = {segment<S>({0, 0, 0}, {0, 0, 2}, 8),
                                                   segment<S>({1, 1, 1}, {0, 0, 2}, 0)};
  writer.write_contacts(folder / "contacts.vtp", contacts);
  const Vtp lines(folder / "contacts.vtp");
  CHECK(lines.count("Lines") == 2);
  CHECK(lines.array<float>("CellData", "normal_force") == std::vector<float>{8, 0});
  CHECK(lines.array<float>("CellData", "friction_force") == std::vector<float>{2, 0});
  CHECK(lines.array<float>("CellData", "gap")[0] == -1e-6f);
  CHECK(lines.array<std::int32_t>("CellData", "class")[1] == 5);
  CHECK(lines.array<float>("CellData", "point")[2] == 1);
  CHECK(lines.array<float>("Points", "Points")[5] == 2);

  writer.write_box(folder / "box.vtp", {S::Vector::Zero(), S::Vector(1, 2, 3)});
  const Vtp box(folder / "box.vtp");
  CHECK(box.count("Points") == 8);
  CHECK(box.count("Lines") == 12);
  writer.write_contacts(folder / "none.vtp", {});
  CHECK(Vtp(folder / "none.vtp").count("Points") == 0);
}

TEST_CASE("arrays that do not fit and folders that do not exist are refused") {
  const TemporaryFolder folder("vtk");
  VtkPolyData data;
  data.add_point(Eigen::Vector2f(1, 2));
  const std::vector<double> two = {1, 2};
  CHECK_NOTHROW(data.add_array<double>(On::points, "uv", 2, two));
  CHECK_THROWS_AS(data.add_array<double>(On::points, "u", 1, two), std::invalid_argument);
  CHECK_THROWS_AS(data.add_array<double>(On::cells, "u", 2, two), std::invalid_argument);
  CHECK_THROWS_AS(data.add_array<double>(On::points, "a<b", 2, two), std::invalid_argument);
  CHECK_THROWS_AS(data.write(folder / "missing" / "x.vtp"), std::system_error);
  data.write(folder / "x.vtp");
  CHECK(Vtp(folder / "x.vtp").array<double>("PointData", "uv") == two);
}

TEST_CASE("more points or corners than indices of 32 bits can number are refused") {
  CHECK(VtkPolyData::most == 2147483647u);
  VtkPolyData data(5);
  for (int round = 0; round < 2; ++round) {
    for (int k = 0; k < 5; ++k) CHECK(data.add_point(Eigen::Vector3d(k, 0, 0)) == k);
    CHECK_THROWS_WITH_AS(data.add_point(Eigen::Vector3d(5, 0, 0)),
                         doctest::Contains("VtkPolyData::add_point: points = 6 are more than"),
                         std::invalid_argument);
    const std::int32_t face[] = {0, 1, 2};
    data.add_cell(VtkPolyData::Cells::polygons, face);
    CHECK_THROWS_WITH_AS(data.add_cell(VtkPolyData::Cells::polygons, face),
                         doctest::Contains("VtkPolyData::add_cell: corners = 6 are more than"),
                         std::invalid_argument);
    data.add_cell(VtkPolyData::Cells::lines, std::span(face).first(2));
    CHECK(data.point_count() == 5);
    CHECK(data.cell_count() == 2);
    data.clear();
  }
}

TEST_CASE("points and cells after an array of them are refused") {
  const TemporaryFolder folder("vtk");
  for (const auto place : {VtkPolyData::On::points, VtkPolyData::On::cells}) {
    VtkPolyData data;
    const auto add = [&] {
      const std::int32_t point = data.add_point(Eigen::Vector3d(0, 0, 0));
      data.add_cell(VtkPolyData::Cells::vertices, std::span(&point, 1));
    };
    add();
    const float one = 1;
    data.add_array<float>(place, "one", 1, std::span(&one, 1));
    add();
    CHECK_THROWS_WITH_AS(data.write(folder / "a.vtp"), doctest::Contains("add arrays last"),
                         std::invalid_argument);
    CHECK_FALSE(std::filesystem::exists(folder / "a.vtp"));
  }
}

TEST_CASE("names that XML would not take are refused") {
  const TemporaryFolder folder("vtk");
  VtkPolyData data;
  for (const char* bad : {"", "a\nb", "a\tb", "a\x7f", "a\"", "a&b", "a>b"})
    CHECK_THROWS_WITH_AS(data.add_array<double>(On::points, bad, 1, {}),
                         doctest::Contains("VtkPolyData::add_array: name = "),
                         std::invalid_argument);
  CHECK_NOTHROW(data.add_array<double>(On::points, "speed \xc3\xbc", 1, {}));
  PvdSeries series(folder / "run.pvd");
  CHECK_THROWS_WITH_AS(series.add(0, ""), "PvdSeries::add: file = '' must be a name",
                       std::invalid_argument);
  CHECK_THROWS_AS(series.add(0, "a\nb.vtp"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(series.add(0, "a.vtp", -1), "PvdSeries::add: part = -1 must be >= 0",
                       std::invalid_argument);
  CHECK_FALSE(std::filesystem::exists(folder / "run.pvd"));
}

TEST_CASE_TEMPLATE("what has no place is refused and no file written", S, Space<2>, Space<3>) {
  using Vector = typename S::Vector;
  using Core =
      std::remove_cvref_t<decltype(samples::grain(S{}, *std::declval<std::mt19937_64*>()))>;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const TemporaryFolder folder("vtk");
  const auto path = folder / "x.vtp";
  std::mt19937_64 random(4);
  const Core core = samples::grain(S{}, random);
  const BallIn<S> ball(0.5);
  VtkWriter<S> writer;
  const auto write = [&](const auto& shape, const Pose<S>& pose) {
    writer.write_grains(
        path, 3, [&](std::size_t) -> const auto& { return shape; },
        [&](std::size_t k) { return k == 2 ? pose : Pose<S>{}; },
        [](std::size_t) -> typename S::Twist { return S::Twist::Zero(); });
  };
  Pose<S> turned;
  turned.rotation = S::exp(S::Angular::Constant(nan));
  for (const Pose<S>& pose : {Pose<S>{Vector::Constant(nan), S::identity()},
                              Pose<S>{Vector::Constant(1e39), S::identity()}, turned}) {
    CHECK_THROWS_WITH_AS(write(core, pose),
                         doctest::Contains("VtkWriter::write_grains: pose_of(2)."),
                         std::invalid_argument);
    CHECK_THROWS_AS(write(ball, pose), std::invalid_argument);
  }
  CHECK_THROWS_WITH_AS(writer.write_box(path, Aabb<S>{}),
                       doctest::Contains("VtkWriter::write_box: box.lower = (inf, inf"),
                       std::invalid_argument);
  CHECK_THROWS_AS(writer.write_box(path, {Vector::Zero(), Vector::Constant(nan)}),
                  std::invalid_argument);
  CHECK_THROWS_AS(writer.write_box(path, {Vector::Ones(), Vector::Zero()}), std::invalid_argument);
  const std::vector<ContactSegment<S>> contacts = {
      segment<S>(Vector::Zero(), Vector::Constant(nan), 1)};
  CHECK_THROWS_AS(writer.write_contacts(path, contacts), std::invalid_argument);
  CHECK_FALSE(std::filesystem::exists(path));
  write(core, {});  // an error does not affect the next file
  CHECK(Vtp(path).template array<std::int32_t>("CellData", "id").back() == 2);
}

TEST_CASE("the series is whole after every snapshot") {
  const TemporaryFolder folder("vtk");
  PvdSeries series(folder / "grains.pvd");
  series.add(0, "grains_0.vtp");
  CHECK(read(folder / "grains.pvd").ends_with("</Collection>\n</VTKFile>\n"));
  series.add(0.1, "grains_1.vtp");
  series.add(0.1, "contacts_1.vtp", 1);
  const std::string text = read(folder / "grains.pvd");
  CHECK(text.ends_with("</Collection>\n</VTKFile>\n"));
  CHECK(text.find("<DataSet timestep=\"0.10000000000000001\" part=\"1\" "
                  "file=\"contacts_1.vtp\"/>") != std::string::npos);
  CHECK_THROWS_AS(PvdSeries(folder / "missing" / "x.pvd").add(0, "x"), std::system_error);
  CHECK_THROWS_WITH(PvdSeries(folder / "x.pvd").add(0, "a&b.vtp"), doctest::Contains("file = a&b"));
  CHECK_THROWS_WITH(PvdSeries(folder / "x.pvd").add(1 / 0., "a.vtp"), doctest::Contains("time"));
}

TEST_CASE("full disks, closed folders and a kill leave whole files") {
  const TemporaryFolder folder("vtk");
  const auto path = folder / "field.vtp", series_path = folder / "run.pvd";
  const auto write = [&](int points) {
    VtkPolyData data;
    for (int k = 0; k < points; ++k) data.add_point(Eigen::Vector2d(k, 1));
    data.write(path);
  };
  PvdSeries series(series_path);
  write(1000);
  const std::string one = read(path);
  write(2000);
  const std::string two = read(path);
  series.add(0, "field.vtp");
  const std::string first = read(series_path);
  {
    const FullDisk full(10);
    CHECK_THROWS_WITH_AS(write(1000), doctest::Contains("cannot write"), std::system_error);
    CHECK_THROWS_WITH_AS(series.add(1, "x.vtp"), doctest::Contains("cannot write"),
                         std::system_error);
  }
  {
    const UnwritableFolder closed(folder / "");
    CHECK_THROWS_WITH_AS(write(1000), doctest::Contains(path.c_str()), std::system_error);
    CHECK_THROWS_WITH_AS(series.add(2, "x.vtp"), doctest::Contains(series_path.c_str()),
                         std::system_error);
  }
  CHECK(read(path) == two);
  CHECK(read(series_path) == first);
  series.add(2.5, "field.vtp");  // files that could not be added are not in the list
  CHECK(read(series_path).find("x.vtp") == std::string::npos);
  CHECK(read(series_path).size() > first.size());
  for (int k = 0; k < 10; ++k) {
    kill_while(std::chrono::microseconds(500 + 331 * k), [&] {
      write(1000);
      write(2000);
      series.add(3, "field.vtp");
    });
    const std::string found = read(path), listed = read(series_path);
    CHECK((found == one || found == two));
    CHECK(listed.starts_with(first.substr(0, first.find("</Collection>"))));
    CHECK(listed.ends_with("</Collection>\n</VTKFile>\n"));
  }
}
