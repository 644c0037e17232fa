// SPDX-License-Identifier: MIT
#include "moreau/picture/write_picture.hpp"

#include <cstddef>
#include <doctest/doctest.h>
#include <png.h>
#include <stdexcept>
#include <string>
#include <vector>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

#include "io/temporary_folder.hpp"

using namespace moreau;

namespace {

using Law = SignoriniCoulomb<double>;

/// The pixels of a PNG file, three bytes each.
struct Pixels {
  int width = 0, height = 0;
  std::vector<unsigned char> bytes;

  explicit Pixels(const std::filesystem::path& path) {
    png_image head{};
    head.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_file(&head, path.c_str()) != 0);
    head.format = PNG_FORMAT_RGB;
    width = int(head.width), height = int(head.height);
    bytes.resize(PNG_IMAGE_SIZE(head));
    REQUIRE(png_image_finish_read(&head, nullptr, bytes.data(), 0, nullptr) != 0);
  }
  /// Whether a pixel is much more red than blue, as the grains of these tests are.
  bool is_red(int column, int row) const {
    const std::size_t at = 3 * (std::size_t(row) * std::size_t(width) + std::size_t(column));
    return bytes[at] > bytes[at + 2] + 60;
  }
  int red() const {
    int count = 0;
    for (int row = 0; row < height; ++row)
      for (int column = 0; column < width; ++column) count += is_red(column, row);
    return count;
  }
};

rendering::Picture small() {
  rendering::Picture picture;
  picture.width = 160, picture.height = 120;
  return picture;
}

rendering::Color red(BodyId) {
  return rendering::screen_color(0xC04020);
}

/// Two grains on a floor between two walls.
template <class ShapeT>
auto pair_of(const ShapeT& shape) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  Simulation<ShapeT, Law> world(0.2, Materials<Law>(1, Law(0.3)));
  const ShapeId id = world.add_shape(shape);
  for (int k = 0; k < 2; ++k)
    world.add_grain(id, {(0.2 + 0.4 * k) * Vector::UnitX() + 0.1 * Vector::Unit(up), S::identity()},
                    1000);
  world.add_wall(Vector::Unit(up), Vector::Zero());
  world.add_wall(Vector::UnitX(), Vector::Zero());
  return world;
}

template <class ShapeT>
void check_picture(const ShapeT& shape) {
  const TemporaryFolder folder("picture");
  const auto world = pair_of(shape);
  write_picture(folder / "red.png", world, red, small());
  const Pixels picture(folder / "red.png");
  CHECK(picture.width == 160);
  CHECK(picture.height == 120);
  // The grains are two of the three parts of the box's width; they fill a part of the picture.
  CHECK(picture.red() > 300);
  CHECK(picture.red() < 160 * 120 / 2);
  for (int column = 0; column < 160; ++column) CHECK_FALSE(picture.is_red(column, 0));
  write_picture(folder / "stone.png", world, small());
  CHECK(read(folder / "stone.png") != read(folder / "red.png"));
}

}  // namespace

TEST_CASE("grains of all shapes are seen") {
  check_picture(regular_shape<Polyhedron<double>>(0.2));
  check_picture(regular_shape<Polygon<double>>(0.2));
  check_picture(Ball<double>(0.1));
  check_picture(Disk<double>(0.1));
  check_picture(OneOf<Disk<double>, Polygon<double>>(Disk<double>(0.1)));
}

TEST_CASE("a grain is drawn at its place in the periodic cell, and a cylinder around the grains") {
  const TemporaryFolder folder("picture");
  Simulation<Disk<double>, Law> near(0.2, Materials<Law>(1, Law(0.3))), far = near;
  for (auto* world : {&near, &far}) {
    world->set_periodic(0, 0, 1);
    const ShapeId disk = world->add_shape(Disk<double>(0.1));
    world->add_grain(disk, {{0.3, 0.1}, Space<2>::identity()}, 1000);
    world->add_grain(disk, {{world == &far ? 3.5 : 0.5, 0.1}, Space<2>::identity()}, 1000);
  }
  write_picture(folder / "near.png", near, red, small());
  write_picture(folder / "far.png", far, red, small());
  CHECK(read(folder / "near.png") == read(folder / "far.png"));

  auto tube = pair_of(Disk<double>(0.1));
  write_picture(folder / "without.png", tube, red, small());
  tube.add_cylinder({0.4, 0.1}, Space<2>::Angular(1), 2);
  write_picture(folder / "with.png", tube, red, small());
  CHECK(Pixels(folder / "with.png").red() < Pixels(folder / "without.png").red() / 4);
}

TEST_CASE("bad arguments are errors") {
  const TemporaryFolder folder("picture");
  Simulation<Disk<double>, Law> world(0.2, Materials<Law>(1, Law(0.3)));
  CHECK_THROWS_WITH_AS(write_picture(folder / "a.png", world),
                       "write_picture: simulation.grain_count() = 0 must be > 0",
                       std::invalid_argument);
  world.add_grain(world.add_shape(Disk<double>(0.1)), {}, 1000);
  rendering::Picture none;
  none.height = 0;
  CHECK_THROWS_WITH_AS(write_picture(folder / "a.png", world, none),
                       "write_picture: picture.height = 0 must be > 0", std::invalid_argument);
  none.width = -4;
  CHECK_THROWS_WITH_AS(write_picture(folder / "a.png", world, none),
                       "write_picture: picture.width = -4 must be > 0", std::invalid_argument);
  CHECK_THROWS_WITH_AS(write_picture(folder / "missing" / "a.png", world),
                       doctest::Contains("missing"), std::system_error);
}
