// SPDX-License-Identifier: MIT
// A column of grains on a rough floor loses its walls, once dry and once wet, in the plane and in space from one source. Dry
// grains run out; wet grains of this size stand, because a bridge of water pulls with a multiple of their weight. The
// program prints the height and the radius of what is left, and the number of bridges.
//
//   wet_heap [folder for pictures]
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <moreau/moreau.hpp>
#include <random>
#include <string>
#include <vector>

#include "moreau/law/bridges.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/picture/write_picture.hpp"

namespace {

using Water = moreau::CapillaryBridge<double>;
using Law = moreau::Bridged<Water, moreau::RollingResistance<double>>;
constexpr double radius = 5e-4;                             // of a grain [m]
constexpr double mass = 1.3e-6;                             // of a grain, 2,500 kg/m^3 [kg]
constexpr double volume = 1e-3 * radius * radius * radius;  // of a bridge [m^3]
constexpr double step = 2e-4;                               // [s]

/// A column of grains, or what is left of it.
template <class Shape>
class Column {
 public:
  using S = moreau::SpaceOf<Shape>;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;
  static constexpr int half = S::dim == 2 ? 5 : 2,
                       layers = 10;  // half its width, its height in grains

  /// @param surface_tension of the liquid [N/m]; 0: dry
  explicit Column(double surface_tension)
      : simulation_(2 * radius,
                    moreau::Materials<Law>(1, Law(Water(volume, surface_tension),
                                                  moreau::RollingResistance<double>(0.5, 0.05)))) {
    simulation_.set_gravity(-9.81 * Vector::Unit(up));
    const moreau::ShapeId shape = simulation_.add_shape(Shape(radius));
    // Disks weigh as much as balls: the force of a bridge is that of two balls.
    const double density = mass / Shape(radius).mass_properties(1).mass;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> aside(-0.02 * radius, 0.02 * radius);
    lattice(8 * half, 1, [&](Vector x) {
      x[up] = -radius;
      simulation_.prescribe_motion(simulation_.add_grain(shape, moreau::Pose<S>(x), density));
    });
    lattice(half, layers, [&](Vector x) {
      for (int k = 0; k < S::dim; ++k) x[k] += aside(random);
      grains_.push_back(simulation_.add_grain(shape, moreau::Pose<S>(x), density));
    });
  }
  /// Runs for a time [s].
  void run(double time) {
    const double end = simulation_.time() + time;
    while (simulation_.time() < end) simulation_.step(step);
  }
  /// Height of the highest grain over the floor, in diameters.
  double height() const {
    double top = 0;
    for (const moreau::BodyId grain : grains_)
      top = std::max(top, simulation_.pose(grain).position[up] + radius);
    return top / (2 * radius);
  }
  /// Root mean square distance of the grains from the axis, in diameters.
  double width() const {
    double sum = 0;
    for (const moreau::BodyId grain : grains_)
      sum += simulation_.pose(grain).position.template head<up>().squaredNorm();
    return std::sqrt(sum / double(grains_.size())) / (2 * radius);
  }
  /// Contacts with a bridge.
  std::size_t bridges() const {
    const auto& variants = simulation_.contacts().variants;
    return std::size_t(std::count_if(variants.begin(), variants.end(), Law::is_bridged));
  }
  /// Grains of the floor are darker.
  void draw(const std::filesystem::path& file) const {
    moreau::rendering::Picture picture;
    picture.width = 900;
    picture.height = S::dim == 2 ? 240 : 500;
    picture.azimuth = picture.elevation = 12;
    moreau::write_picture(
        file, simulation_,
        [&](moreau::BodyId grain) {
          return moreau::rendering::stone_color(simulation_.is_prescribed(grain) ? 0.7 : 0,
                                                grain.index());
        },
        picture);
  }

 private:
  /// Calls use(center) for the places of a lattice with a spacing of 2.1 radii around the axis.
  static void lattice(int width, int height, const auto& use) {
    const int count = 2 * width + 1;
    int places = height;
    for (int k = 0; k < up; ++k) places *= count;
    for (int place = 0; place < places; ++place) {
      Vector x;
      int rest = place;
      for (int k = 0; k < up; ++k, rest /= count) x[k] = 2.1 * radius * (rest % count - width);
      x[up] = radius * (1 + 2.1 * rest);
      x.template head<up>().array() +=
          1.05 * radius * (rest % 2);  // above the gaps of the layer below
      use(x);
    }
  }

  moreau::Simulation<Shape, Law> simulation_;
  std::vector<moreau::BodyId> grains_;
};

template <class Shape>
void collapse(const std::string& name, const std::string& folder) {
  for (const double surface_tension : {0.0, 0.073}) {
    Column<Shape> column(surface_tension);
    const char* water = surface_tension > 0 ? "wet" : "dry";
    const double before = column.width();
    column.run(0.3);
    std::printf("%s, %s: height %.1f diameters, width %.2f times that of the column, %zu bridges\n",
                name.c_str(), water, column.height(), column.width() / before, column.bridges());
    if (!folder.empty()) column.draw(std::filesystem::path(folder) / (name + "_" + water + ".png"));
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string folder = argc > 1 ? argv[1] : "";
    if (!folder.empty()) std::filesystem::create_directories(folder);
    const double bond_number = Water(volume, 0.073).force(0, radius) / (mass * 9.81);
    std::printf("a bridge pulls with %.0f times the weight of a grain\n", bond_number);
    collapse<moreau::Disk<>>("disks", folder);
    collapse<moreau::Ball<>>("balls", folder);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
