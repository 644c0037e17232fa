// SPDX-License-Identifier: MIT
// Three kinds of shapes in one simulation: spheres, dice and rods. OneOf selects the kinds of a
// pair at run time by one std::visit. A simulation of a single kind does not pay for this. Writes
// mixed_shapes.png and prints how many contact points each pair of kinds has.
#include <algorithm>
#include <cstddef>
#include <iostream>
#include <map>
#include <moreau/moreau.hpp>
#include <moreau/picture/write_picture.hpp>
#include <string>
#include <vector>

using S = moreau::Space<3>;
using Vector = S::Vector;
using Ball = moreau::BallIn<S>;
using Die = moreau::Polyhedron<double>;
using Rod = moreau::CapsuleIn<S>;
using Grain = moreau::OneOf<Ball, Die, Rod>;

int main() {
  using Law = moreau::SignoriniCoulomb<double>;
  moreau::Simulation<Grain, Law> simulation(0.02, moreau::Materials<Law>(1, Law(0.4)));
  const std::vector<Vector> corners{{0, 0, 0},       {0.02, 0, 0},      {0, 0.02, 0},
                                    {0.02, 0.02, 0}, {0, 0, 0.02},      {0.02, 0, 0.02},
                                    {0, 0.02, 0.02}, {0.02, 0.02, 0.02}};
  const moreau::ShapeId kinds[] = {simulation.add_shape(Ball(0.012)),
                                   simulation.add_shape(Die(corners)),
                                   simulation.add_shape(Rod(0.01, 0.007))};
  for (int k = 0; k < 80; ++k)
    simulation.add_grain(
        kinds[k % 3],
        {{0.02 + 0.035 * (k % 4), 0.02 + 0.035 * (k / 4 % 4), 0.02 + 0.035 * (k / 16)},
         S::exp({0.5 * k, 0.2 * k, 0.1})},
        2700);
  for (int axis = 0; axis < 3; ++axis) simulation.add_wall(Vector::Unit(axis), Vector::Zero());
  for (int axis = 0; axis < 2; ++axis)
    simulation.add_wall(-Vector::Unit(axis), 0.145 * Vector::Unit(axis));
  simulation.set_gravity({0, 0, -9.81});

  double deepest = 0;
  int unsolved = 0;
  for (int step = 0; step < 2000; ++step) {
    const moreau::StepReport report = simulation.step(5e-4);
    deepest = std::max(deepest, report.max_overlap);
    unsolved += !report.solve.converged;
  }

  const unsigned colors[] = {0xB3562E, 0xD3C1A5, 0x3F6E8C};
  moreau::write_picture(
      "mixed_shapes.png", simulation,
      [&](moreau::BodyId grain) {
        return moreau::rendering::screen_color(colors[simulation.shape(grain).index()]);
      },
      {.width = 700, .height = 700});

  // Contact points of each pair of kinds.
  const char* names[] = {"ball", "die", "rod"};
  std::map<std::string, int> points;
  const auto kind_of = [&](std::uint32_t body) -> std::string {
    if (!simulation.is_grain(body)) return "wall";
    return names[simulation.shape(simulation.body_id(body)).index()];
  };
  for (const auto& contact : simulation.contacts().points) {
    const auto [first, second] = std::minmax({kind_of(contact.a), kind_of(contact.b)});
    ++points[first + " - " + second];
  }
  for (const auto& [pair, count] : points) std::cout << pair << ": " << count << " points\n";
  std::cout << "largest overlap of all steps " << deepest << " m, " << unsolved
            << " of 2000 steps not converged\n";
  return points.size() > 6 && deepest < 1e-3 && unsolved <= 20 ? 0 : 1;
}
