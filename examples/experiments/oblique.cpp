// SPDX-License-Identifier: MIT
// Oblique impacts of two equal spheres. S. F. Foerster, M. Y. Louge, H. Chang and K. Allia (Phys. Fluids 6 (1994) 1108)
// describe theirs by three constants: restitution e, friction mu, tangential restitution beta0. With psi = u_t / u_n^-
// before (1) and after (2) the impact their two branches are
//
//   psi_2 = -beta0 psi_1                              the contact sticks,
//   psi_2 = psi_1 - 7/2 (1 + e) mu                    it slides.
//
// The experiment lets spheres collide in a simulation, with and without beta0, and reads the three constants off.
#include <cmath>
#include <moreau/moreau.hpp>
#include <random>

#include "moreau/law/tangential_restitution.hpp"

#include "session.hpp"

namespace experiments {

namespace oblique_parts {

using S = moreau::Space<3>;
using Vector = S::Vector;
using Coulomb = moreau::SignoriniCoulomb<double>;
using Walton = moreau::TangentialRestitution<double>;

struct Spheres {
  const char* name;
  double diameter, restitution, friction, tangential;  // [m], [-]
};

/// u of the contact point of two spheres that touch along x; b minus a.
template <class World>
Vector relative_velocity(const World& world, double radius) {
  const auto a = world.grain(0), b = world.grain(1);
  return world.velocity(b) + world.spin(b).cross(Vector(-radius, 0, 0)) - world.velocity(a) -
         world.spin(a).cross(Vector(radius, 0, 0));
}

struct Impact {
  double psi1, psi2, restitution, energy;  // energy: of the impact, over that before, less 1
};
/// An impact with a random spin of both spheres.
template <class Law>
Impact impact_of(const Spheres& spheres, const Law& law, double psi, std::mt19937_64& random) {
  constexpr double speed = 1, step = 1e-6;
  const double radius = spheres.diameter / 2;
  moreau::Simulation<moreau::Ball<double>, Law> world(spheres.diameter,
                                                      moreau::Materials<Law>(1, law));
  const auto shape = world.add_shape(moreau::Ball<double>(radius));
  const auto a = world.add_grain(shape, {Vector(0, 0, 0)}, 2500);
  const auto b = world.add_grain(shape, {Vector(2 * radius - 1e-9, 0, 0)}, 2500);
  std::normal_distribution<double> normal;
  world.set_spin(a, Vector(normal(random), normal(random), normal(random)) * 100);
  world.set_spin(b, Vector(normal(random), normal(random), normal(random)) * 100);
  // The velocity of b gives the impact its psi.
  const Vector rest = relative_velocity(world, radius);
  world.set_velocity(b, Vector(-speed, psi * speed - rest[1], -rest[2]));
  const auto energy = [&] {
    double sum = 0;
    for (const moreau::BodyId grain : world.grains()) {
      const double mass = world.bodies().grain_mass[grain.index()];
      sum += mass *
             (world.velocity(grain).squaredNorm() +
              0.4 * radius * radius * world.spin(grain).squaredNorm()) /
             2;
    }
    return sum;
  };
  const Vector before = relative_velocity(world, radius);
  const double energy_before = energy();
  world.step(step);
  const Vector after = relative_velocity(world, radius);
  return {before[1] / -before[0], after[1] / -before[0], after[0] / -before[0],
          energy() / energy_before - 1};
}

/// The constants of the two branches, and the largest energy gained.
struct Constants {
  double restitution = 0, friction = 0, tangential = 0, gain = -1;
};
template <class Law>
Numbers measure(const Spheres& spheres, const Law& law, std::vector<Numbers>& curve) {
  std::mt19937_64 random(1);
  Constants c;
  // Where the sticking branch ends.
  const double end = 3.5 * spheres.friction * (1 + spheres.restitution) / (1 + spheres.tangential);
  constexpr int count = 60;
  double sliding = 0, top = 0, bottom = 0;
  for (int k = 1; k <= count; ++k) {
    const double psi = 3 * end * k / count;
    const Impact impact = impact_of(spheres, law, psi, random);
    curve.push_back({impact.psi1, impact.psi2});
    c.restitution += impact.restitution / count;
    c.gain = std::max(c.gain, impact.energy);
    if (psi < 0.95 * end) top -= impact.psi2 * impact.psi1, bottom += impact.psi1 * impact.psi1;
    if (psi > 1.5 * end) {
      c.friction += (impact.psi1 - impact.psi2) / (3.5 * (1 + spheres.restitution));
      ++sliding;
    }
  }
  c.friction /= sliding;
  c.tangential = top / bottom;
  return {c.restitution, c.friction, c.tangential, c.gain};
}

}  // namespace oblique_parts

void oblique(Session& session) {
  using namespace oblique_parts;
  for (const Spheres& spheres :
       {Spheres{"glass", 0.003, 0.97, 0.092, 0.44}, Spheres{"acetate", 0.006, 0.87, 0.25, 0.43}}) {
    for (const bool walton : {true, false}) {
      std::vector<Numbers> curve;
      const Result result =
          session.once(std::string(spheres.name) + (walton ? ", beta0" : ", Coulomb"), [&](Run&) {
            return walton
                       ? measure(spheres,
                                 Walton(spheres.friction, spheres.restitution, spheres.tangential),
                                 curve)
                       : measure(spheres, Coulomb(spheres.friction, spheres.restitution), curve);
          });
      if (!curve.empty())
        session.curve(std::string("oblique_") + spheres.name + (walton ? "" : "_coulomb"),
                      {"psi1", "psi2"}, curve);
      Row row;
      row.law = walton ? "TangentialRestitution" : "SignoriniCoulomb";
      row.step = 1e-6;
      row.tolerance = 1e-4;
      row.grains = 2;
      row.samples = 60;
      row.seconds = result.seconds;
      // During the step the line of the centres turns, by up to 1e-3.
      const auto compare = [&](const char* figure, double published, double measured) {
        row.figure = std::string(spheres.name) + ": " + figure;
        row.published = std::to_string(published).substr(0, 5);
        row.measured = measured;
        row.verdict = std::abs(measured - published) <= 1e-3 ? "yes, by construction" : "no";
        session.row(row);
      };
      compare("restitution e", spheres.restitution, result.values[0]);
      compare("friction μ, from impacts that slide", spheres.friction, result.values[1]);
      compare("tangential restitution β0, from impacts that stick", spheres.tangential,
              result.values[2]);
      row.figure =
          std::string(spheres.name) + ": largest gain of energy in an impact, over the energy";
      row.published = "≤ 0";
      row.measured = result.values[3];
      row.verdict = row.measured <= 1e-12 ? "yes" : "no";
      session.row(row);
    }
  }
}

}  // namespace experiments
