// SPDX-License-Identifier: MIT
// Discharge of concave ballast from a silo through a funnel that is a mesh wall: a cone of triangles in
// space, two lines of segments in the plane. The program fills the silo, opens the outlet, and measures the rate of
// discharge for three outlets. It prints the constant C of Beverloo's law,
//
//     W = C rho sqrt(g) (D - k d)^(dim - 1/2),   k = 1.4,
//
// for the outlet D, the bulk density rho and the grain size d (W. A. Beverloo, H. A. Leniger, J. van de
// Velde, Chem. Eng. Sci. 15 (1961), 260): it should be the same for all outlets. It also writes
// silo_*.png, the grains during the discharge.
//
//   silo [grains]     default: 500
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <moreau/moreau.hpp>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "moreau/boundary/sink.hpp"
#include "moreau/io/write_picture.hpp"
#include "moreau/sample/compound_ballast.hpp"
#include "moreau/sample/random_deposition.hpp"
#include "moreau/shape/compound.hpp"

using Law = moreau::SignoriniCoulomb<double>;

namespace setup {
constexpr double size = 0.02, density = 2700, gravity = 9.81;  // of a grain [m], [kg/m^3], [m/s^2]
constexpr double h = 5e-4;                                     // [s]
constexpr double slope = 1;  // of the funnel: height over width [-]
}  // namespace setup

/// A profile (distance from the axis, height), turned about the vertical axis; the outside of the
/// surface faces the axis if the profile goes down towards it. In the plane: the profile and its mirror
/// image.
struct ProfilePoint {
  double radius, height;  // [m]
};
moreau::TriangleMesh<> revolved(const std::vector<ProfilePoint>& profile, moreau::Space<3>) {
  constexpr int count = 32;
  moreau::TriangleMesh<> mesh;
  for (const auto& [radius, height] : profile)
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * std::numbers::pi * k / count;
      mesh.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), height});
    }
  for (std::uint32_t level = 0; level + 1 < profile.size(); ++level)
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t a = level * count + k, b = level * count + (k + 1) % count;
      mesh.facets.push_back({a, b, a + count});
      mesh.facets.push_back({b, b + count, a + count});
    }
  return mesh;
}
moreau::SegmentMesh<> revolved(const std::vector<ProfilePoint>& profile, moreau::Space<2>) {
  moreau::SegmentMesh<> mesh;
  for (const auto& [radius, height] : profile) {
    mesh.vertices.push_back({radius, height});
    mesh.vertices.push_back({-radius, height});
  }
  for (std::uint32_t k = 0; k + 2 < mesh.vertices.size(); k += 2) {
    mesh.facets.push_back({k, k + 2});
    mesh.facets.push_back({k + 3, k + 1});
  }
  return mesh;
}

/// The silo with its grains, and the plate that closes the outlet.
template <class Shape>
struct Silo {
  using S = moreau::SpaceOf<Shape>;
  moreau::Simulation<Shape, Law> simulation;
  moreau::BodyId plate;
  double radius, outlet;  // [m]

  Silo(int grains, double silo_radius, double silo_outlet)
      : simulation(setup::size, moreau::Materials<Law>(1, Law(0.4)), {}, tolerances()),
        radius(silo_radius),
        outlet(silo_outlet) {
    const double rise = setup::slope * (radius - outlet / 2), top = rise + 4;
    simulation.set_gravity(-setup::gravity * S::Vector::Unit(S::dim - 1));
    simulation.add_mesh_wall(revolved({{radius, top}, {radius, rise}, {outlet / 2, 0}}, S{}));
    // A plate of two rings, from the rim of the outlet almost to its axis.
    plate =
        simulation.add_mesh_wall(revolved({{0.6 * outlet, -0.002}, {1e-4 * outlet, -0.002}}, S{}));
    fill(grains, rise);
  }
  static moreau::Tolerances tolerances() {
    moreau::Tolerances wide;
    wide.margin = 0.08;  // a grain that falls at 3 m/s moves by 1.5 mm in a step
    return wide;
  }
  void fill(int grains, double rise) {
    std::mt19937_64 random(1);
    const std::vector<double> radii(std::size_t(grains), setup::size / 2);
    const double side = S::dim == 2 ? 2 * radius : std::numbers::sqrt2 * radius;
    auto poses = moreau::random_deposition<S>(radii, 0.99 * side, random);
    for (auto& pose : poses) {
      for (int axis = 0; axis < S::dim - 1; ++axis) pose.position[axis] -= 0.495 * side;
      pose.position[S::dim - 1] += rise;
      const Shape shape = moreau::Ballast<Shape>::draw(random).scaled(setup::size / 2);
      simulation.add_grain(simulation.add_shape(shape), pose, setup::density);
    }
    for (int step = 0; step < 1600; ++step) simulation.step(setup::h);
  }
};

struct Discharge {
  double rate = 0;       // [kg/s], in the plane [kg/(m s)]
  double density = 0;    // of the bulk [kg/m^D]
  std::size_t left = 0;  // grains in the silo at the end
};

/// Opens the outlet and measures from 20 % to 70 % of the mass.
template <class Shape>
Discharge discharge(Silo<Shape>& silo, const std::string& picture) {
  using S = moreau::SpaceOf<Shape>;
  auto& simulation = silo.simulation;
  double mass = 0, highest = 0;
  for (const auto grain : simulation.grains()) {
    mass += simulation.bodies().weight[grain.index()];
    highest = std::max(highest, simulation.pose(grain).position[S::dim - 1]);
  }
  Discharge result;
  const double rise = setup::slope * (silo.radius - silo.outlet / 2);
  const double r = silo.radius, o = silo.outlet / 2;
  const double cone =
      S::dim == 2 ? rise * (r + o) : std::numbers::pi / 3 * rise * (r * r + r * o + o * o);
  const double straight = (highest - rise) * (S::dim == 2 ? 2 * r : std::numbers::pi * r * r);
  result.density = mass / (cone + straight);

  moreau::Pose<S> aside;
  aside.position[S::dim - 1] = -10;
  simulation.set_pose(silo.plate, aside);
  auto sink =
      moreau::Sink<S>::behind(S::Vector::Unit(S::dim - 1), -0.1 * S::Vector::Unit(S::dim - 1));
  double begin = 0, out_at_begin = 0;
  for (int step = 0; step < 8000; ++step) {
    simulation.step(setup::h);
    sink.apply(simulation);
    const double out = sink.total().mass;
    if (begin == 0 && out > 0.2 * mass) {
      begin = simulation.time();
      out_at_begin = out;
      moreau::write_picture(picture, simulation);
    }
    if (out > 0.7 * mass) {
      result.rate = (out - out_at_begin) / (simulation.time() - begin);
      break;
    }
  }
  result.left = simulation.grain_count();
  return result;
}

template <class Shape>
void run(const char* name, int grains, double radius, const std::vector<double>& outlets) {
  constexpr int dim = moreau::SpaceOf<Shape>::dim;
  std::printf("%s: %d grains of %g m, silo of radius %g m\n", name, grains, setup::size, radius);
  std::printf("  outlet [m]   rate [kg/s]   bulk density [kg/m^%d]   C [-]\n", dim);
  for (const double outlet : outlets) {
    Silo<Shape> silo(grains, radius, outlet);
    const Discharge found = discharge(silo, "silo_" + std::string(name) + ".png");
    const double free = outlet - 1.4 * setup::size;
    const double c =
        found.rate / (found.density * std::sqrt(setup::gravity) * std::pow(free, dim - 0.5));
    std::printf("  %-12g %-13.4g %-24.4g %.3f%s\n", outlet, found.rate, found.density, c,
                found.rate > 0 ? "" : "  (it stopped)");
    std::fflush(stdout);
  }
}

int main(int argc, char** argv) {
  const int grains = argc > 1 ? std::atoi(argv[1]) : 500;
  // Or moreau::Polygon<double>, moreau::Polyhedron<double>: convex ballast.
  run<moreau::Compound<moreau::Polygon<double>>>("plane", grains, 0.15, {0.10, 0.13, 0.16});
  run<moreau::Compound<moreau::Polyhedron<double>>>("space", grains, 0.07, {0.08, 0.095, 0.11});
}
