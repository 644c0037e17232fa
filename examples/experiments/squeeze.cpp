// SPDX-License-Identifier: MIT
// Control of the impact: why does the steel ball rebound from a shallow bed with springs, and hardly with rigid
// contacts? One settled bed, the ball just above it with the velocity that it has there, rigid contacts and springs.
// Narrow bed: as deep as the published one of 25,000 balls, with 10,000 in a box of 0.06 x 0.04 m. Springs: Hertz and
// Mindlin with the published moduli (M1 1 GPa, steel 210 GPa, Poisson's ratio 0.2), and linear ones in series with the
// rigid law (Compliant). Measured: the largest velocity of the ball upwards; the energy, of which the bed's springs hold
// a part when the ball turns.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <type_traits>
#include <vector>

#include "impact_bed.hpp"
#include "session.hpp"
#include "worlds.hpp"

namespace experiments {

namespace squeeze_parts {

using namespace impact_parts;
using Ball = moreau::Ball<double>;

/// Restitution: the published one of each pair, or one for all pairs.
struct Restitution {
  double of_all = -1;
  double operator()(double published) const { return of_all < 0 ? published : of_all; }
};

constexpr double poisson = 0.2;
double young(moreau::MaterialId material) {
  return material == steel ? 210e9 : material == m1 ? 1e9 : 0.5e9;
}
/// Effective modulus of two materials, of the normal force [Pa].
double effective_young(moreau::MaterialId a, moreau::MaterialId b) {
  return 1 / ((1 - poisson * poisson) * (1 / young(a) + 1 / young(b)));
}
double effective_shear(moreau::MaterialId a, moreau::MaterialId b) {
  return 1 / ((2 - poisson) * 2 * (1 + poisson) * (1 / young(a) + 1 / young(b)));
}

/// One ball of M1 below the steel ball, see one_ball(), is compressed by 0.73 mm with this stiffness as under Hertz's law
/// [N/m].
constexpr double linear_stiffness = 6.6e5;

template <class Law>
moreau::Simulation<Ball, Law> world_of(const Restitution& restitution, const Numerics& numerics) {
  const auto laws =
      materials_of<Law>([&](moreau::MaterialId a, moreau::MaterialId b, double mu, double e) {
        if constexpr (std::is_same_v<Law, Hertz>)
          return Law(effective_young(a, b), effective_shear(a, b), mu, restitution(e));
        else if constexpr (std::is_same_v<Law, Springs>)
          return Law(Rigid(mu, restitution(e)), linear_stiffness);
        else
          return Law(mu, restitution(e));
      });
  moreau::Tolerances tolerances;
  tolerances.margin = numerics.margin;
  tolerances.skin = 0.1;
  if constexpr (std::is_same_v<Law, Hertz>) {
    return moreau::Simulation<Ball, Law>(diameter, laws, tolerances);
  } else {
    moreau::ColouredOptions options;
    options.tolerance = numerics.tolerance;
    options.max_sweeps = numerics.max_sweeps;
    return moreau::Simulation<Ball, Law>(diameter, laws, moreau::ColouredGaussSeidel(options),
                                         tolerances);
  }
}

/// Energy of the normal springs [J].
template <class Law>
double elastic_energy(const moreau::Simulation<Ball, Law>& world, double step) {
  double sum = 0;
  const auto& contacts = world.contacts();
  const std::size_t ball =
      steel_ball(world).index();  // the balls of M1 before it, the walls after it
  for (std::size_t c = 0; c < contacts.points.size(); ++c) {
    const auto& contact = contacts.points[c];
    if constexpr (std::is_same_v<Law, Hertz>) {
      if (contact.gap >= 0) continue;
      double curvature = 0;
      const auto material = [&](std::size_t body) {
        if (body <= ball) curvature += 2 / (body < ball ? diameter : impactor);
        return body < ball ? m1 : steel;
      };
      const double modulus = effective_young(material(contact.a), material(contact.b));
      sum += 8. / 15 * modulus * std::pow(-contact.gap, 2.5) / std::sqrt(curvature);
    } else if constexpr (std::is_same_v<Law, Springs>) {
      const double force = contacts.impulses[c][0] / step;
      sum += force * force / (2 * linear_stiffness);
    }
  }
  return sum;
}

/// Velocity of the ball upwards [m/s], its height [m], kinetic energy of the bed and energy of the springs [J].
template <class Law>
std::array<double, 4> look(const moreau::Simulation<Ball, Law>& world, double step) {
  const moreau::BodyId ball = steel_ball(world);
  double kinetic = 0;
  constexpr double r = diameter / 2, mass = density_m1 * 4. / 3 * std::numbers::pi * r * r * r;
  for (const moreau::BodyId grain : world.grains()) {
    const auto v = world.velocity(grain);
    if (grain != ball)
      kinetic +=
          mass / 2 *
          (v.template head<3>().squaredNorm() + 0.4 * r * r * v.template tail<3>().squaredNorm());
  }
  return {world.velocity(ball)[2], world.pose(ball).position[2], kinetic,
          elastic_energy(world, step)};
}

struct Bed {
  std::string name;
  Box box;
  Numbers state;
  double z, v;  ///< of the steel ball at the start [m], [m/s]
};

/// One ball of M1 on the floor below the steel ball, which has the velocity that it has in the published curves before it
/// turns.
Bed one_ball() {
  constexpr double r = diameter / 2;
  return {"1 ball",
          {},
          {0, 0, floor_height + r, 0, 0},
          floor_height + 2 * r + impactor / 2 + 1e-5,
          -2.4};
}

/// A run's rows of four numbers, every 0.1 ms.
template <class Law>
void run(Session& session, const Bed& bed, const std::string& law, const Numerics& numerics,
         const Restitution& restitution = {}) {
  const double until = session.quick() ? 1e-3 : 0.014, interval = 1e-4;
  const std::string e =
      restitution.of_all < 0 ? "" : ", e = " + std::to_string(restitution.of_all).substr(0, 4);
  const Result result =
      session.once(bed.name + ", " + law + e + " " + numerics.text(), [&](Run& one) {
        auto world = world_of<Law>(restitution, numerics);
        world.set_gravity({0, 0, -gravity});
        if (session.options().threads > 1)
          world.set_team(moreau::ThreadTeam(session.options().threads));
        Numbers log;
        const Sums sums = advance(
            one, world, numerics, until, interval, log,
            [&](auto& empty) { build_impact(empty, bed.box, bed.state, bed.z, bed.v); },
            [&](const auto& now) { return look(now, numerics.step); });
        sums.append_to(log);
        return log;
      });
  Numbers log(result.values.begin(), result.values.end() - 5);
  std::vector<Numbers> rows;
  std::size_t lowest = 0;
  double fastest = 0;
  for (std::size_t k = 0; 4 * k + 3 < log.size(); ++k) {
    rows.push_back(
        {double(k) * interval * 1000, log[4 * k + 1], log[4 * k], log[4 * k + 2], log[4 * k + 3]});
    if (rows[k][1] < rows[lowest][1]) lowest = k;
    fastest = std::max(fastest, rows[k][2]);
  }
  session.curve("squeeze_" + std::to_string((bed.state.size() - 2) / 3) + "_" + law +
                    (e.empty() ? "" : "_e" + e.substr(6)) + "_" +
                    std::to_string(std::lround(1e7 * numerics.step)) +
                    (numerics.tolerance < 1e-3 ? "_tight" : ""),
                {"t [ms]", "z [m]", "v [m/s]", "kinetic energy of the bed [J]", "of springs [J]"},
                rows);
  const double r = impactor / 2, mass = density_steel * 4. / 3 * std::numbers::pi * r * r * r;
  const auto kinetic = [&](const Numbers& line) { return mass / 2 * line[2] * line[2] + line[3]; };
  Row row;
  row.law = law + e;
  row.step = numerics.step;
  row.tolerance = std::is_same_v<Law, Hertz> ? 0 : numerics.tolerance;
  row.grains = (bed.state.size() - 2) / 3 + 1;
  row.seconds = result.seconds;
  row.published = "–";
  const auto add = [&](const char* figure, double value) {
    row.figure = bed.name + ": " + figure;
    row.measured = value;
    session.row(row);
  };
  add("largest velocity of the ball upwards [m/s]", fastest);
  add("lowest height of the ball [mm]", 1000 * rows[lowest][1]);
  add("kinetic energy of the ball at the start [mJ]", 500 * mass * bed.v * bed.v);
  add("of the ball at its largest velocity upwards [mJ]", 500 * mass * fastest * fastest);
  add("of the bed when the ball turns [mJ]", 1000 * rows[lowest][3]);
  double most = 0;
  for (const Numbers& line : rows) most = std::max(most, line[4]);
  add("largest energy of the normal springs [mJ]", 1000 * most);
  const std::size_t before = lowest < 10 ? 0 : lowest - 10;
  add("velocity of the ball 1 ms before it turns [m/s]", rows[before][2]);
  double gain = 0;  // of ball and bed; gravity gives at most 0.3 mJ
  for (std::size_t k = 0; k + 1 < rows.size(); ++k)
    gain = std::max(gain, kinetic(rows[k + 1]) - kinetic(rows[k]));
  add("largest gain of kinetic energy in 0.1 ms [mJ]", 1000 * gain);
  const double steps = result.values[log.size()];
  add("steps not solved", result.values[log.size() + 1]);
  add("sweeps per step", result.values[log.size() + 2] / steps);
  add("milliseconds per step", 1000 * result.values[log.size() + 4] / steps);
}

Bed bed_of(Session& session, const std::string& name, const Box& box, std::size_t count,
           std::uint64_t seed) {
  Bed bed{name, box, settled_bed(session, box, count, seed), 0, 0};
  double top = floor_height;
  for (std::size_t k = 0; k + 3 < bed.state.size(); k += 3)
    top = std::max(top, bed.state[k + 2] + diameter / 2);
  bed.z = std::min(start_height, top + impactor / 2 + 1e-4);
  bed.v = -std::sqrt(speed * speed + 2 * gravity * (start_height - bed.z));
  return bed;
}

}  // namespace squeeze_parts

void squeeze(Session& session) {
  using namespace squeeze_parts;
  const Numerics rigid{5e-5, 1e-3, 0.2}, short_steps{2e-5, 1e-3, 0.2}, hertz{1e-6, 0, 0.02},
      tight{5e-5, 1e-5, 0.2, 10000}, short_tight{2e-5, 1e-5, 0.2, 10000};
  const Bed one = one_ball();
  run<Rigid>(session, one, "SignoriniCoulomb", rigid);
  run<Hertz>(session, one, "HertzMindlin", hertz);
  run<Hertz>(session, one, "HertzMindlin", hertz, {0.2});
  for (const double step : {5e-6, 5e-5}) run<Springs>(session, one, "Compliant", {step, 1e-3, 0.2});
  if (session.quick()) {
    const Bed bed = bed_of(session, "800 balls", {0.04, 0.03}, 800, 1);
    run<Rigid>(session, bed, "SignoriniCoulomb", rigid);
    run<Hertz>(session, bed, "HertzMindlin", hertz);
    return;
  }
  if (session.wants("10000 balls")) {
    const Bed narrow = bed_of(session, "10000 balls", {0.06, 0.04}, 10000, 1);
    run<Rigid>(session, narrow, "SignoriniCoulomb", rigid);
    run<Hertz>(session, narrow, "HertzMindlin", hertz);
    run<Rigid>(session, narrow, "SignoriniCoulomb", rigid, {1});
    run<Springs>(session, narrow, "Compliant", short_steps);
    run<Rigid>(session, narrow, "SignoriniCoulomb", short_steps);
    run<Rigid>(session, narrow, "SignoriniCoulomb", tight);
    run<Rigid>(session, narrow, "SignoriniCoulomb", short_tight);
    run<Rigid>(session, narrow, "SignoriniCoulomb", tight, {1});
    run<Hertz>(session, narrow, "HertzMindlin", hertz, {0.2});
    run<Hertz>(session, narrow, "HertzMindlin", {5e-7, 0, 0.02});
  }
  if (session.wants("25000 balls")) {
    const Bed wide = bed_of(session, "25000 balls", {}, 25000, 1);
    run<Rigid>(session, wide, "SignoriniCoulomb", rigid);
    run<Springs>(session, wide, "Compliant", short_steps);
    run<Hertz>(session, wide, "HertzMindlin", hertz);
  }
}

}  // namespace experiments
