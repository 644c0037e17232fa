// SPDX-License-Identifier: MIT
// Prints what ratcheting.py writes into wall.csv, from the class Experiment of the study. Arguments: shape
// (polygon or polyhedron), number of grains, duration [s], fmax [N].
#include <cmath>
#include <cstdlib>
#include <string>

#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

#include "digits.hpp"
#include "ratcheting/experiment.hpp"

namespace ratcheting {

template <class Shape>
void run(const Parameters& p) {
  std::mt19937_64 own(p.seed), twin(p.seed);
  using Twin = typename SolidTwin<Shape>::type;
  const double volume = make_grains<Twin>(p, twin).volume;
  Experiment<Shape, ContactDynamics> experiment(p, volume / make_grains<Shape>(p, own).volume);
  experiment.compress([](const char*, const moreau::StepReport&) {});
  experiment.release();
  std::cout << "t,f,x,v,f_g\n";
  for (long k = std::lround(p.duration / p.step); k > 0; --k) {
    experiment.vibrate();
    const double t = experiment.time();
    std::cout << t << ',' << p.force(t - p.step / 2) << ',' << experiment.displacement() << ','
              << experiment.wall_velocity() << ',' << experiment.wall_force() << '\n';
  }
}

}  // namespace ratcheting

int main(int count, char** arguments) {
  if (count != 5) return 2;
  ratcheting::Parameters p;
  p.shape = arguments[1];
  p.grains = std::strtoul(arguments[2], nullptr, 10);
  p.duration = std::strtod(arguments[3], nullptr);
  p.fmax = std::strtod(arguments[4], nullptr);
  if (p.shape == "polygon")
    ratcheting::run<moreau::Polygon<double>>(p);
  else
    ratcheting::run<moreau::Polyhedron<double>>(p);
}
