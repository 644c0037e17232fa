// SPDX-License-Identifier: MIT
#pragma once

#include <random>

#include "scene.hpp"

namespace validation {

namespace detail {

/// Spheres of slightly different sizes in a square silo (in the plane a channel) with rough walls
/// and a smooth floor.
template <class ShapeT>
struct Silo {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;
  static constexpr double h = 5e-4, size = 0.02;  ///< step [s], mean diameter [m]
  static constexpr double mu = 0.5;  ///< friction between grains, and between grains and walls

  double width;  ///< [m]
  World<ShapeT> world;
  std::vector<BodyId> sides;

  Silo(int across, int layers, std::uint64_t seed)
      : width(across * size * 1.12),
        world(0.9 * size, materials(),
              moreau::ColouredGaussSeidel({.tolerance = 1e-4, .max_sweeps = 5000}),
              {.margin = 0.08}) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> share(0.9, 1.1), jitter(-0.005, 0.005);
    const int per_layer = S::dim == 3 ? across * across : across;
    for (int k = 0; k < per_layer * layers; ++k) {
      Vector x;
      int rest = k;
      for (int axis = 0; axis < S::dim; ++axis) {
        const int n = axis == up ? rest : rest % across;
        x[axis] = size * (1.12 * (n + 0.5) + jitter(random));
        rest /= across;
      }
      world.add_grain(world.add_shape(ShapeT(share(random) * size / 2)), {x}, 2500);
    }
    for (int axis = 0; axis < up; ++axis) {
      const Vector n = Vector::Unit(axis);
      sides.push_back(world.add_wall(n, Vector::Zero()));
      sides.push_back(world.add_wall(-n, width * n));
    }
    world.add_wall(Vector::Unit(up), Vector::Zero(), moreau::MaterialId(1));
    world.set_gravity(tilted_gravity<S>(0));
  }

  static Materials<Coulomb<ShapeT>> materials() {
    Materials<Coulomb<ShapeT>> all(2, Coulomb<ShapeT>(mu));
    all.set(moreau::MaterialId(0), moreau::MaterialId(1), Coulomb<ShapeT>(0));
    return all;
  }

  int unsolved = 0;  ///< steps that did not converge

  void run(double time) {
    for (const double end = world.time() + time; world.time() < end;)
      unsolved += !world.step(h).solve.converged;
  }
  /// Moves the walls upwards until their friction is fully mobilised.
  void lift_walls(double speed) {
    for (const BodyId wall : sides) world.set_velocity(wall, speed * Vector::Unit(up));
  }

  /// Adds the weight of the grains, the friction of the walls and the push of the walls above the
  /// height j x `spacing` to weight[j], friction[j] and push[j] [N].
  void add_forces(double spacing, std::vector<double>& weight, std::vector<double>& friction,
                  std::vector<double>& push) const {
    const auto& bodies = world.bodies();
    const auto add = [&](std::vector<double>& sum, double height, double force) {
      for (std::size_t j = 0; j < sum.size() && double(j) * spacing < height; ++j) sum[j] += force;
    };
    for (std::size_t k = 0; k < world.grain_count(); ++k) {
      const std::size_t i = world.grain(k).index();
      add(weight, bodies.pose[i].position[up], bodies.grain_mass[i] * gravity);
    }
    const auto& contacts = world.contacts();
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const auto& contact = contacts.points[c];
      if (world.is_grain(contact.b) || std::abs(contact.frame(up, 0)) > 0.5) continue;
      const Vector force = contact.frame * contacts.impulse(c) / -h;
      const double height = bodies.pose[contact.a].position[up] + contact.lever_a[up];
      add(friction, height, force[up]);
      add(push, height, contacts.impulses[c][0] / h);
    }
  }
};

}  // namespace detail

/// If wall friction is fully mobilised, the mean vertical stress at the depth z is rho g lambda (1
/// - exp(-z/lambda)) (H. A. Janssen, Z. Ver. dt. Ing. 39 (1895) 1045). rho g z is the weight above
/// per area, and lambda is the only fitted parameter. The stress is computed from the weight above
/// and the friction of the walls. The formula is for a mean: in one packing, eight grains wide, the
/// stress fluctuates by a tenth about the profile. Several packings are averaged while the walls
/// slide from a quarter of a diameter to one diameter. The floor is smooth, because a rough floor
/// shears the lowest two widths, which the formula ignores.
///
/// lambda also follows from the walls. If their friction is fully mobilised and their push is K s,
/// a slice loses mu K s P/A per height to them, with the perimeter P and the area A. With s as a
/// function of the weight w above, in forces, lambda = s dw / (mu dN), where dN is the push of the
/// walls per slice. Here the sum is over all slices: sum(s dw) / (mu N). Both comparisons are known
/// misses: spheres also roll on the walls, whose friction is half of mu times their push.
template <class ShapeT>
void janssen(Record& record, int across, int layers, int packings) {
  using S = SpaceOf<ShapeT>;
  using Silo = detail::Silo<ShapeT>;
  std::vector<double> weight(std::size_t(1.2 * layers)), friction(weight.size()),
      push(weight.size());
  int samples = 0, unsolved = 0;
  for (int seed = 1; seed <= packings; ++seed) {
    Silo silo(across, layers, std::uint64_t(seed));
    const double speed = Silo::size;  // [m/s]
    silo.run(0.8);
    silo.lift_walls(speed);
    silo.run(0.25);
    silo.unsolved = 0;  // count only during the measurement
    for (int k = 0; k < 150; ++k, ++samples) {
      silo.run(10 * Silo::h);
      silo.add_forces(Silo::size, weight, friction, push);
    }
    unsolved += silo.unsolved;
  }
  // In units of the weight of the grains over the whole area: depth w, stress s.
  std::vector<double> w, s;
  for (std::size_t j = 0; j < weight.size(); ++j) {
    if (weight[j] == 0) break;
    w.push_back(weight[j] / samples);
    s.push_back((weight[j] - friction[j]) / samples);
  }
  const auto misfit = [&](double lambda) {
    double sum = 0;
    for (std::size_t j = 0; j < w.size(); ++j)
      sum += std::pow(s[j] - lambda * (1 - std::exp(-w[j] / lambda)), 2);
    return sum;
  };
  double low = w[0] / 50, high = 5 * w[0];  // golden section
  for (int k = 0; k < 80; ++k) {
    const double a = high - 0.618 * (high - low), b = low + 0.618 * (high - low);
    (misfit(a) < misfit(b) ? high : low) = misfit(a) < misfit(b) ? b : a;
  }
  const double lambda = (low + high) / 2;
  double mean = 0, spread = 0;
  for (const double value : s) mean += value / double(s.size());
  for (const double value : s) spread += std::pow(value - mean, 2);
  Curve& curve = record.curve("janssen", S{}, {"weight_above", "stress", "exact"});
  for (std::size_t j = 0; j < w.size(); ++j)
    curve.rows.push_back({w[j] / lambda, s[j] / lambda, 1 - std::exp(-w[j] / lambda)});
  const std::string name = with_shape<ShapeT>("Janssen's silo");
  record.compare(name + ": R^2 of the profile", S{}, 1, 1 - misfit(lambda) / spread, 0.02);
  record.vanishes(name + ": lambda over the depth", S{}, lambda / w[0], 0.5);
  double slices = 0;  // sum of s dw
  for (std::size_t j = 0; j + 1 < w.size(); ++j)
    slices += (s[j] + s[j + 1]) / 2 * (w[j] - w[j + 1]);
  record.compare(name + ": friction of the walls over mu times their push", S{}, 1,
                 friction[0] / (Silo::mu * push[0]), 0.05);
  record.compare_relative(name + ": lambda, from the push of the walls", S{},
                          slices * samples / (Silo::mu * push[0]), lambda, 0.1);
  record.vanishes(name + ": share of steps not solved", S{}, unsolved / (10.0 * samples), 0.01);
}

inline void janssen_silo(Record& record, Effort effort) {
  const bool quick = effort == Effort::quick;
  janssen<Disk<>>(record, 8, quick ? 40 : 60, quick ? 1 : 8);
  if (!quick) janssen<Ball<>>(record, 5, 30, 4);
}

}  // namespace validation
