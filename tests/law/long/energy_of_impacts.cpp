// SPDX-License-Identifier: MIT
// Energy and restitution of impacts, by law, step and what hits what: a grain on a floor, and two grains in flight.
// Prints the table of examples/guide/laws.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <doctest/doctest.h>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "moreau/law/compliant.hpp"
#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"

#include "law/two_grains.hpp"
#include "law/vertices_on_floor.hpp"

using namespace landing;

namespace {

using Rigid = SignoriniCoulomb<double>;
using Linear = LinearSpringDashpot<double>;
using Hertz = HertzMindlin<double>;
using Soft = Compliant<Rigid>;

/// What of the grain is lowest.
struct Landing {
  const char* name;
  double tilt, part;
  int least_points(int dim) const { return tilt == 0 ? dim : part == 0 ? dim - 1 : 1; }
};
constexpr Landing landings[] = {{"faces", 0, 0}, {"edges", 0.3, 0}, {"vertices", 0.3, 0.7}};

template <class S>
typename S::Rotation turn_of(const Landing& landing) {
  typename S::Angular w = S::Angular::Zero();
  w[0] = landing.tilt;
  if constexpr (S::angular_dim > 1) w[1] = landing.part * landing.tilt;
  return S::exp(w);
}

/// Duration of an impact [s]: of an eighth of the mass on a vertex.
double duration(double stiffness, double mass) {
  return std::numbers::pi * std::sqrt(mass / 8 / stiffness);
}

/// A value in its rank: the mean, the mean of the amounts, the least and the greatest.
struct Values {
  int count = 0;
  double sum = 0, amount = 0, most = -1e9, least = 1e9;
  void add(double x) {
    ++count, sum += x, amount += std::abs(x);
    most = std::max(most, x), least = std::min(least, x);
  }
  double mean() const { return sum / count; }
  double worst() const { return std::max(std::abs(most), std::abs(least)); }
};

/// The energy of a grain on a floor after an impact over that before, and the restitution of the points that touched.
template <class S, class Law>
std::array<double, 2> land(const Grain<S>& grain, const Law& law, const Landing& landing,
                           double speed, double h, double most_time) {
  OnFloor<S, Law> world(grain, law, turn_of<S>(landing), 1e-9);
  world.velocity()[world.up] = -speed;
  const double before = world.energy();
  std::vector<ContactKey> touched;
  double restitution = 0;
  while (world.time < most_time) {
    world.step(h);
    if (touched.empty())
      for (std::size_t c = 0; c < world.contacts.size(); ++c)
        if (world.contacts.impulses[c][0] > 0) touched.push_back(world.contacts.keys[c]);
    if (!touched.empty() && !world.touches()) break;
    if constexpr (!RegularizedLaw<Law, S> && std::is_same_v<Law, Rigid>)
      if (!touched.empty()) break;
  }
  for (std::size_t c = 0; c < world.contacts.size(); ++c)
    if (std::find(touched.begin(), touched.end(), world.contacts.keys[c]) != touched.end())
      restitution += relative_velocity(world.contacts.points[c], world.bodies.velocity[0],
                                       world.bodies.velocity[1])[0];
  return {world.energy() / before, restitution / (speed * double(touched.size()))};
}

template <class S>
void print(const char* what, const char* law, const std::string& rest) {
  std::printf("| %s | %s | %s | %s |\n", S::dim == 2 ? "plane" : "space", what, law, rest.c_str());
  std::fflush(stdout);
}
std::string text(const char* format, double x) {
  char out[32];
  std::snprintf(out, sizeof out, format, x);
  return out;
}

/// Largest deviation of the restitution from e, of faces, edges and vertices.
template <class S, class MakeLaw>
double restitution(const char* name, const MakeLaw& law_of, bool is_rigid) {
  double worst = 0;
  std::string row;
  for (const Landing& landing : landings) {
    Values error;
    for (const Grain<S>& grain : flat_grains(S())) {
      if (landing.tilt > 0 && landing.part == 0 && grain.name == "hull")
        continue;  // its edges lie askew
      for (const double e : {0.2, 0.5, 0.9, 1.0}) {
        const double time = is_rigid ? 1e-3 : duration(1e7, grain.mass);
        error.add(land<S>(grain, law_of(e), landing, 0.01, time / 200, 50 * time)[1] - e);
      }
    }
    row += (row.empty() ? "" : " | ") + text("%.1e", error.worst());
    worst = std::max(worst, error.worst());
  }
  print<S>("largest error of the restitution: faces, edges, vertices", name, row);
  return worst;
}

/// Grains that land on a floor with spin: the largest gain of a step, over the energy at first.
template <class S, class Law>
double gain_on_floor(const Law& law, double h, double spin) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  double most = 0;
  for (const Grain<S>& grain : flat_grains(S()))
    for (const double tilt : {0.0, 1e-4, 0.02, 0.3, 1.0}) {
      typename S::Angular turn;
      for (auto& x : turn) x = tilt * normal(random);
      OnFloor<S, Law> world(grain, law, S::exp(turn), -1e-6);
      for (int k = 0; k < S::dofs; ++k)
        world.velocity()[k] = normal(random) * (k < S::dim ? 1 : spin);
      world.velocity()[world.up] = -1;
      const double first = world.kinetic_energy();
      for (int k = 0; k < 40; ++k) most = std::max(most, gain_of_step<S>(world, 1, h) / first);
    }
  return most;
}
/// Two grains that fly towards each other: the same.
template <class S, class Law>
double gain_in_flight(const Law& law, double h, double spin) {
  double most = 0;
  for (int trial = 0; trial < 60; ++trial) {
    TwoGrains<S, Law> world(law, trial, spin);
    const double first = world.kinetic_energy();
    while (world.time < world.longest) most = std::max(most, gain_of_step<S>(world, 0, h) / first);
  }
  return most;
}

/// The error of the energy after impacts without loss, with its sign.
template <class S, class Law>
Values error_on_floor(const Law& law, double stiffness, double parts) {
  Values error;
  for (const Grain<S>& grain : flat_grains(S()))
    for (const double tilt : {0.0, 1e-3, 0.02, 0.1, 0.3}) {
      const double time = duration(stiffness, grain.mass);
      error.add(land<S>(grain, law, Landing{"", tilt, 0.7}, 1, time / parts, 50 * time)[0] - 1);
    }
  return error;
}
template <class S, class Law>
Values error_in_flight(const Law& law, double stiffness, double parts, double spin) {
  Values error;
  for (int trial = 0; trial < 60; ++trial) {
    TwoGrains<S, Law> world(law, trial, spin);
    const double first = world.kinetic_energy(),
                 h = duration(stiffness, world.bodies.grain_mass[0]) / parts;
    while (world.time < world.longest && world.contacts.size() == 0) world.step(5e-5);
    while (world.time < world.longest && !(world.has_touched && !world.touches())) world.step(h);
    error.add(world.kinetic_energy() / first - 1);
  }
  return error;
}
template <class S, class Law>
std::array<Values, 6> springs(const char* name, const Law& law, double stiffness, double spin = 0) {
  std::array<Values, 6> all;
  for (const int where : {0, 1}) {
    std::string mean, worst;
    for (const int k : {0, 1, 2}) {
      const double parts = 50 << 2 * k;
      auto& values = all[std::size_t(3 * where + k)];
      values = where == 0 ? error_on_floor<S>(law, stiffness, parts)
                          : error_in_flight<S>(law, stiffness, parts, spin);
      worst += (k == 0 ? "" : " | ") + text("%.1e", values.least) + text(" to %.1e", values.most);
      mean += (k == 0 ? "" : " | ") + text("%.1e", values.mean());
    }
    const char* what = where == 0 ? "floor" : "two grains";
    print<S>((std::string(what) + ", least and greatest error of the energy: T/50, T/200, T/800")
                 .c_str(),
             name, worst);
    print<S>((std::string(what) + ", mean").c_str(), name, mean);
  }
  return all;
}

}  // namespace

TEST_CASE_TEMPLATE("rigid laws make no energy in an impact", S, Space<2>, Space<3>) {
  for (const double e : {0.0, 0.5, 1.0})
    for (const double friction : {0.0, 0.4}) {
      const Rigid law(friction, e);
      double most[4] = {};
      for (const int k : {0, 1}) {
        most[k] = gain_on_floor<S>(law, k == 0 ? 1e-4 : 1e-6, 50);
        most[2 + k] = gain_in_flight<S>(law, k == 0 ? 1e-4 : 2e-5, 50);
      }
      CAPTURE(e);
      CAPTURE(friction);
      print<S>("largest gain of a step: floor h = 1e-4, 1e-6 s; two grains 1e-4, 2e-5 s",
               ("rigid, e " + text("%.1f", e) + ", friction " + text("%.1f", friction)).c_str(),
               text("%.1e", most[0]) + " | " + text("%.1e", most[1]) + " | " +
                   text("%.1e", most[2]) + " | " + text("%.1e", most[3]));
      for (const double gain : most) CHECK(gain <= 1e-9);
    }
}

TEST_CASE_TEMPLATE("faces, edges and vertices have the restitution of the law", S, Space<2>,
                   Space<3>) {
  CHECK(restitution<S>(
            "rigid", [](double e) { return Rigid(0, e); }, true) <= 0.01);
  CHECK(restitution<S>(
            "linear", [](double e) { return Linear(1e7, 0, 0, e); }, false) <= 0.01);
}

TEST_CASE_TEMPLATE("springs without loss keep the energy to the order of the step", S, Space<2>,
                   Space<3>) {
  const auto linear = springs<S>("linear", Linear(1e6, 0, 0, 1), 1e6);
  const auto hertz = springs<S>("Hertz", Hertz(1e9, 0, 0, 1), 1e6);
  const auto soft = springs<S>("compliant", Soft(Rigid(0, 1), 1e6), 1e6);
  for (const int k : {0, 1, 2}) {
    const std::size_t floor = std::size_t(k), flight = std::size_t(3 + k);
    CAPTURE(k);
    // Of second order on a floor. Between two grains the number of points changes: errors of both signs stay.
    CHECK(linear[floor].worst() <= 3e-3 / (1 << 3 * k));
    CHECK(hertz[floor].worst() <= 3e-3 / (1 << 3 * k));
    CHECK(soft[floor].most <= 1e-9);
    CHECK(soft[floor].worst() <= 0.1 / (1 << k));
    CHECK(soft[flight].most <= 1e-9);
  }
}

// Friction takes energy; the tangential springs give back what they store.
TEST_CASE_TEMPLATE("springs with friction make no energy", S, Space<2>, Space<3>) {
  const auto linear = springs<S>("linear, friction 0.4", Linear(1e6, 7e5, 0.4, 1), 1e6, 50);
  const auto hertz = springs<S>("Hertz, friction 0.4", Hertz(1e9, 3e8, 0.4, 1), 1e6, 50);
  const auto soft = springs<S>("compliant, friction 0.4", Soft(Rigid(0.4, 1), 1e6, 7e5), 1e6, 50);
  for (const int k : {0, 1, 2}) {
    CAPTURE(k);
    for (const std::size_t where : {std::size_t(0), std::size_t(3)}) {
      CHECK(linear[where + std::size_t(k)].mean() <= 0);
      CHECK(hertz[where + std::size_t(k)].mean() <= 0);
      CHECK(soft[where + std::size_t(k)].most <= 1e-9);
    }
    CHECK(linear[std::size_t(k)].most <= 3e-3 / (1 << 3 * k));
    CHECK(hertz[std::size_t(k)].most <= 3e-3 / (1 << 3 * k));
  }
}
