// SPDX-License-Identifier: MIT
#include "plan.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace study {

namespace {

/// As short as can be, reads back to the same bits.
std::string text(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

/// The options of `ratcheting` that the plans vary, with their mark in the name of a case.
struct Option {
  std::string_view flag, mark, unit;
  std::function<double(const Parameters&)> value;
  bool prepares = false;  ///< the packing depends on it
};

const std::vector<Option>& options() {
  static const std::vector<Option> all{
      {"--frequency", "", "Hz", [](const Parameters& p) { return p.frequency; }},
      {"--fmax", "fmax", "N", [](const Parameters& p) { return p.fmax; }},
      {"--fmin", "fmin", "N", [](const Parameters& p) { return p.fmin; }},
      {"--gravity", "g", "", [](const Parameters& p) { return p.gravity; }},
      {"--wall-mass-ratio", "mw", "m", [](const Parameters& p) { return p.wall_mass_ratio; }},
      {"--box-ratio", "H", "L", [](const Parameters& p) { return p.box_ratio; }, true},
      {"--width-ratio", "W", "L", [](const Parameters& p) { return p.width_ratio; }, true},
      {"--size-scale", "size", "x", [](const Parameters& p) { return p.size_scale; }, true},
      {"--lid-force", "lid", "mg", [](const Parameters& p) { return p.lid_force; }, true},
      {"--lid-raise", "raise", "m", [](const Parameters& p) { return p.lid_raise; }},
      {"--step", "h", "s", [](const Parameters& p) { return p.step; }},
      {"--tolerance", "tol", "", [](const Parameters& p) { return p.tolerance; }},
      {"--stiffness", "k", "", [](const Parameters& p) { return p.stiffness; }, true},
      {"--max-sweeps", "sweeps", "", [](const Parameters& p) { return double(p.max_sweeps); }},
      {"--friction", "mu", "", [](const Parameters& p) { return p.friction; }, true},
      {"--flatness", "flat", "", [](const Parameters& p) { return p.flatness; }, true},
      {"--fewest-vertices", "from", "vertices",
       [](const Parameters& p) { return double(p.fewest_vertices); }, true},
      {"--most-vertices", "to", "vertices",
       [](const Parameters& p) { return double(p.most_vertices); }, true},
      {"--wall-speed", "pulled", "", [](const Parameters& p) { return p.wall_speed; }},
      {"--duration", "T", "s", [](const Parameters& p) { return p.duration; }},
      {"--grains", "N", "", [](const Parameters& p) { return double(p.grains); }, true}};
  return all;
}

/// polyhedron-s1-5Hz, then what differs from `base`. The duration is told only where it is not the
/// one that the frequency brings.
std::string name_of(const Parameters& p, const Parameters& base, double usual_duration) {
  std::string name = p.shape + "-s" + std::to_string(p.seed) + "-" + text(p.frequency) + "Hz";
  for (const Option& option : options()) {
    const double usual = option.flag == "--duration" ? usual_duration : option.value(base);
    if (option.flag == "--frequency" || option.value(p) == usual) continue;
    name += "-" + std::string(option.mark) + text(option.value(p)) + std::string(option.unit);
  }
  if (p.size_reading != base.size_reading) name += "-circumradius";
  if (p.side_walls != base.side_walls) name += "-" + p.side_walls;
  if (p.correction != base.correction) name += p.correction ? "-corrected" : "-uncorrected";
  // The plans "paper", "settled" and "controls" share their table.
  if (p.method == "compliant") name += "-compliant";
  if (!p.from.empty()) name += "-jammed";
  return name;
}

/// One second as in the paper, five periods where that is longer. In the plan "settled" each case has
/// its own.
double duration_at(const std::string& plan, double frequency) {
  if (plan == "small") return 0.6;
  if (plan == "settled") return 1;
  return std::max(1.0, 5 / frequency);
}

/// Collects cases; one that is asked for twice is there once, in both sets.
class Builder {
 public:
  explicit Builder(std::string plan) : plan_(std::move(plan)) {}

  /// Adds the baseline of a shape and seed with changes.
  void add(const std::string& set, const std::string& shape, std::size_t seed,
           const std::function<void(Parameters&)>& change) {
    add_to(plan_, set, shape, seed, change);
  }
  /// The same with the baseline of another plan.
  void add_to(const std::string& plan, const std::string& set, const std::string& shape,
              std::size_t seed, const std::function<void(Parameters&)>& change) {
    const Parameters base = baseline(plan, shape, seed);
    Parameters p = base;
    change(p);
    const double usual = duration_at(plan, p.frequency);
    if (p.duration == base.duration) p.duration = usual;
    const std::string name = name_of(p, base, usual);
    const auto [place, is_new] = place_of_.try_emplace(name, cases_.size());
    if (is_new) cases_.push_back({cases_.size() + 1, name, p, {}});
    cases_[place->second].sets.insert(set);
  }
  std::vector<Case> cases() && { return std::move(cases_); }

 private:
  std::string plan_;
  std::vector<Case> cases_;
  std::map<std::string, std::size_t> place_of_;
};

using Names = std::initializer_list<const char*>;
using Numbers = std::initializer_list<double>;

/// A series of one parameter: `field` points to it.
void series(Builder& plan, const char* set, Names shapes, std::size_t seed,
            double Parameters::*field, Numbers values) {
  for (const double value : values)
    for (const char* shape : shapes)
      plan.add(set, shape, seed, [&](Parameters& p) { p.*field = value; });
}

/// The force of the paper's case, per grain.
double usual_fmax(std::size_t grains) {
  return Parameters().fmax * double(grains) / 1200;
}

// The paper's study, in the order of what it tells.
std::vector<Case> paper_plan() {
  Builder plan("paper");
  const Names angular{"polyhedron", "polygon"}, round{"sphere", "disk"};
  const Names all{"polyhedron", "polygon", "sphere", "disk"};
  const auto nu = &Parameters::frequency;
  const auto fmax = &Parameters::fmax;
  const auto g = &Parameters::gravity;
  const auto wall = &Parameters::wall_mass_ratio;

  // Twelve frequencies: decades for the power laws, close to each other about 10 Hz for nu_c.
  series(plan, "frequencies", angular, 1, nu, {5, 10, 20, 60, 2, 7, 15, 35, 8.5, 12, 3.5});
  series(plan, "frequencies", round, 1, nu, {5, 10, 20, 60, 2, 7, 15, 35, 8.5, 12, 3.5});
  for (const Names& shapes : {angular, round}) {
    series(plan, "fmax", shapes, 1, fmax, {2000, 4000, 6000, 10000});
    series(plan, "gravity", shapes, 1, g, {2.5, 5, 9.81, 20});
    series(plan, "wall-mass", shapes, 1, wall, {0.1, 0.5, 1, 2, 4});
  }
  // f never below the active thrust, about 0.3 mg = 80 N; f never above the passive one; f never
  // above the active one.
  series(plan, "states", all, 1, &Parameters::fmin, {0, 400});
  series(plan, "states", all, 1, fmax, {300, 60});
  // A quarter of the step: the numerical drift of the jammed wall is an error of the solver.
  for (const double frequency : {5.0, 20.0, 60.0, 10.0, 2.0})
    for (const char* shape : {"polygon", "disk"})
      plan.add("fine", shape, 1, [&](Parameters& p) {
        p.frequency = frequency;
        p.step = 5e-5;
      });
  for (const char* shape : angular) {
    plan.add("reading", shape, 1, [](Parameters&) {});
    plan.add("reading", shape, 1,
             [](Parameters& p) { p.size_reading = moreau::SizeReading::circumradius; });
  }
  series(plan, "box-ratio", angular, 1, &Parameters::box_ratio, {0.7, 1, 1.5});
  series(plan, "lid-force", angular, 1, &Parameters::lid_force, {3, 10, 30});
  for (const double frequency : {5.0, 10.0, 20.0, 2.0})
    for (const char* shape : angular)
      plan.add("uncorrected", shape, 1, [&](Parameters& p) {
        p.frequency = frequency;
        p.correction = false;
      });
  for (const double frequency : {5.0, 20.0, 60.0})
    for (const char* shape : angular) {
      plan.add("numerics", shape, 1, [&](Parameters& p) { p.frequency = frequency; });
      plan.add("numerics", shape, 1, [&](Parameters& p) {
        p.frequency = frequency;
        p.step = 1e-4;
      });
      plan.add("numerics", shape, 1, [&](Parameters& p) {
        p.frequency = frequency;
        p.tolerance = 1e-5;
      });
    }
  series(plan, "frequencies", all, 1, nu, {1});
  for (const std::size_t seed : {2u, 3u}) {
    series(plan, "frequencies", all, seed, nu, {5, 10, 20, 60, 2, 7, 15, 35, 8.5, 12, 3.5});
    series(plan, "fmax", all, seed, fmax, {2000, 4000, 6000, 10000});
    series(plan, "gravity", all, seed, g, {2.5, 5, 9.81, 20});
    series(plan, "wall-mass", all, seed, wall, {0.1, 0.5, 1, 2, 4});
  }
  // Does nu_c follow sqrt(g/d)? Force, gap and everything else stay what they are.
  for (const double frequency : {5.0, 7.0, 10.0, 15.0, 20.0, 35.0, 3.5, 2.0})
    for (const char* shape : angular) {
      plan.add("relaxation", shape, 1, [&](Parameters& p) { p.frequency = frequency; });
      plan.add("relaxation", shape, 1, [&](Parameters& p) {
        p.frequency = frequency;
        p.gravity = 2.5;
      });
      plan.add("relaxation", shape, 1, [&](Parameters& p) {
        p.frequency = frequency;
        p.size_scale = 1.5;
      });
    }
  for (const char* shape : {"polygon", "polyhedron", "disk", "sphere"})
    plan.add("long", shape, 1, [](Parameters& p) {
      p.frequency = 20;
      p.duration = 5;
    });
  plan.add("long", "polygon", 1, [](Parameters& p) { p.duration = 20; });
  // The laws again at a tenth of the tolerance: how much numerical drift is left.
  const auto tight = [&](const char* shape, double Parameters::*field, Numbers values) {
    for (const double value : values)
      plan.add("tight", shape, 1, [&](Parameters& p) {
        p.tolerance = 1e-5;
        p.*field = value;
      });
  };
  for (const char* shape : angular) tight(shape, nu, {5, 10, 20, 60, 2});
  // In space the numerical drift is small at 5 Hz.
  tight("polygon", fmax, {2000, 4000, 10000});
  tight("polygon", g, {2.5, 5, 20});
  tight("polygon", wall, {0.1, 1, 2, 4});
  for (const std::size_t seed : {2u, 3u})
    for (const char* shape : angular)
      plan.add("reading", shape, seed,
               [](Parameters& p) { p.size_reading = moreau::SizeReading::circumradius; });
  // In the plane 1200 grains make a box more than three times as long as in space. So few make one
  // of the same length and, with this ratio, of the same H/L; the force keeps fmax/mg.
  for (std::size_t seed = 1; seed <= 20; ++seed)
    for (const auto& [shape, grains] : {std::pair{"polygon", 94}, std::pair{"disk", 111}})
      plan.add("same-length", shape, seed, [count = grains](Parameters& p) {
        p.grains = std::size_t(count);
        p.fmax = usual_fmax(p.grains);
        p.box_ratio = 0.9;
        p.tolerance = 1e-5;
      });
  // Does the outward drift under a force above the thrust depend on the tolerance?
  for (const char* shape : {"polygon", "disk"})
    plan.add("states", shape, 1, [](Parameters& p) {
      p.fmin = 400;
      p.tolerance = 1e-5;
    });
  tight("disk", nu, {5, 10, 20, 60, 2});
  tight("disk", fmax, {2000, 4000, 10000});
  tight("disk", g, {2.5, 5, 20});
  tight("disk", wall, {0.1, 1, 2, 4});
  // In space half the step leaves as little drift at 20 Hz as a tenth of the tolerance, for less.
  const auto half = [&](double Parameters::*field, Numbers values) {
    for (const double value : values)
      plan.add("half", "polyhedron", 1, [&](Parameters& p) {
        p.step = 1e-4;
        p.*field = value;
      });
  };
  half(g, {9.81, 2.5, 5, 20});
  half(nu, {20, 60});
  return std::move(plan).cases();
}

/// Gives the run that makes the jammed state the sample of another run. jammed_name() and the run itself both use it, so
/// that the name always fits.
void jam(Parameters& p, const Parameters& sample) {
  p.box_ratio = sample.box_ratio;
  p.width_ratio = sample.width_ratio;
  p.side_walls = sample.side_walls;
  p.size_scale = sample.size_scale;
  p.grains = sample.grains;
  p.fmax = usual_fmax(p.grains);
  p.duration = 0.35;  // to the second maximum of the force
}

/// The name of the run whose checkpoint is the jammed state of a sample, as its case's name.
std::string jammed_name(const Parameters& p) {
  Parameters start = baseline("settled", p.shape, p.seed);
  jam(start, p);
  return name_of(start, baseline("settled", p.shape, p.seed), duration_at("settled", 5));
}

/// Adds `periods` periods from the jammed state of a sample, after a hold at fmax. Adds the run that
/// makes the state, too.
/// @param contacts "settled": compliant ones; "paper": rigid ones, from the state that compliant contacts made
void add_jammed(Builder& plan, const char* set, const char* shape, std::size_t seed, int periods,
                const std::function<void(Parameters&)>& change, const char* contacts = "settled") {
  plan.add_to("settled", "jammed", shape, seed, [&](Parameters& p) {
    Parameters changed = p;
    change(changed);
    jam(p, changed);
    p.checkpoint_every = 1750;
  });
  plan.add_to(contacts, set, shape, seed, [&](Parameters& p) {
    change(p);
    p.from = jammed_name(p);
    if (p.method != "compliant") p.from_method = "compliant";
    // In whole steps.
    p.duration = std::round((p.hold + periods / p.frequency) / p.step) / std::round(1 / p.step);
  });
}

// The study at converged settings: compliant contacts, four periods from one jammed state of each
// sample. The cheapest and most telling cases come first.
std::vector<Case> settled_plan() {
  Builder plan("settled");
  const Names planar{"polygon", "disk"}, solid{"sphere", "polyhedron"};
  const auto with = [](double Parameters::*field, double value) {
    return [=](Parameters& p) { p.*field = value; };
  };
  // The paper's case from the filling on, and the flat box in which the paper's C is found.
  const auto course = [&](const Names& shapes, std::size_t seed) {
    for (const char* shape : shapes)
      plan.add("course", shape, seed, with(&Parameters::duration, 1));
  };
  const auto box = [&](std::size_t seed, double ratio, double size, double fmax) {
    plan.add("box", "polyhedron", seed, [&](Parameters& p) {
      p.box_ratio = ratio;
      p.size_scale = size;
      p.fmax = fmax;
      p.duration = 0.56;
    });
  };
  course(planar, 1);
  course(solid, 1);
  for (const std::size_t seed : {1u, 2u, 3u}) box(seed, 0.42, 1, 6000);
  // 1. The same state at all frequencies and three loads; then twenty periods, for the ageing.
  const auto one_state = [&](const Names& shapes, std::size_t seed, double fmax) {
    for (const double frequency : {5.0, 20.0, 2.0, 10.0, 60.0, 35.0, 7.0, 15.0, 3.5, 1.0})
      for (const char* shape : shapes)
        add_jammed(plan, "one-state", shape, seed, 4, [&](Parameters& p) {
          p.frequency = frequency;
          p.fmax = fmax;
        });
  };
  const auto ageing = [&](const Names& shapes, std::size_t seed) {
    for (const double frequency : {20.0, 5.0})
      for (const char* shape : shapes)
        add_jammed(plan, "ageing", shape, seed, 20, with(&Parameters::frequency, frequency));
  };
  // 3. Force, gravity and mass of the wall.
  const auto laws = [&](const Names& shapes, std::size_t seed) {
    const auto vary = [&](double Parameters::*field, const Numbers& values) {
      for (const double value : values)
        for (const char* shape : shapes)
          add_jammed(plan, "laws", shape, seed, 4, with(field, value));
    };
    vary(&Parameters::fmax, {6000, 2000, 4000, 10000});
    vary(&Parameters::gravity, {2.5, 5, 20});
    vary(&Parameters::wall_mass_ratio, {0.1, 1, 2, 4});
  };
  for (const Names& shapes : {planar, solid}) {
    for (const std::size_t seed : {2u, 3u}) course(shapes, seed);
    for (const std::size_t seed : {1u, 2u, 3u}) one_state(shapes, seed, 6000);
    for (const std::size_t seed : {1u, 2u, 3u}) laws(shapes, seed);
    for (const std::size_t seed : {1u, 2u, 3u}) ageing(shapes, seed);
    for (const std::size_t seed : {4u, 5u}) one_state(shapes, seed, 6000);
    for (const double fmax : {2000.0, 27000.0})
      for (const std::size_t seed : {1u, 2u, 3u, 4u, 5u}) one_state(shapes, seed, fmax);
  }
  // 2. The shape of the box and the size of the grains; the other forces at two flat boxes.
  for (const std::size_t seed : {1u, 2u, 3u})
    for (const double size : {1.0, 1.3, 1.5})
      for (const double ratio : {0.3, 0.42, 0.5, 0.7, 1.0, 1.5}) box(seed, ratio, size, 6000);
  for (const std::size_t seed : {1u, 2u, 3u})
    for (const double fmax : {2000.0, 4000.0, 10000.0})
      for (const double ratio : {0.42, 0.5}) box(seed, ratio, 1, fmax);
  // The sets that may meet all of the paper's figures, over one second as in the paper.
  for (const std::size_t seed : {1u, 2u, 3u})
    for (const auto& [ratio, size] : {std::pair{0.42, 1.3}, {0.42, 1.0}, {0.42, 1.5}, {0.5, 1.3}})
      plan.add("box", "polyhedron", seed, [height = ratio, scale = size](Parameters& p) {
        p.box_ratio = height;
        p.size_scale = scale;
        p.duration = 1;
      });
  // The flat box with other grains, with rigid contacts as in the paper, and with the other forces.
  const auto joint = [&](const std::function<void(Parameters&)>& change) {
    for (const std::size_t seed : {1u, 2u, 3u})
      plan.add("joint", "polyhedron", seed, [&](Parameters& p) {
        change(p);
        p.box_ratio = 0.42;
        p.duration = 1;
      });
  };
  const auto rigid = [](Parameters& p) {
    const std::size_t seed = p.seed;
    p = Parameters();
    p.seed = seed;
  };
  joint(rigid);
  joint(with(&Parameters::flatness, 0.7));
  joint([](Parameters& p) { p.fewest_vertices = 30; });
  joint([&](Parameters& p) {
    rigid(p);
    p.flatness = 0.7;
  });
  for (const double fmax : {2000.0, 4000.0, 10000.0}) joint(with(&Parameters::fmax, fmax));
  // Compaction in boxes of other shapes and lengths, and with other grain sizes, from jammed states.
  const auto in_box = [&](const char* shape, std::size_t seed, double ratio, double size,
                          double frequency, double wall) {
    add_jammed(plan, "lengths", shape, seed, 4, [&](Parameters& p) {
      p.box_ratio = ratio;
      p.size_scale = size;
      p.frequency = frequency;
      p.wall_mass_ratio = wall;
    });
  };
  for (const double frequency : {5.0, 20.0, 2.0})
    for (const std::size_t seed : {1u, 2u, 3u}) {
      for (const double ratio : {0.42, 1.5, 0.7})
        for (const char* shape : {"polygon", "polyhedron"})
          in_box(shape, seed, ratio, 1, frequency, 0.5);
      in_box("polyhedron", seed, 1, 1.5, frequency, 0.5);
    }
  for (const double wall : {0.1, 4.0})
    for (const std::size_t seed : {1u, 2u, 3u}) in_box("polyhedron", seed, 0.42, 1, 5, wall);
  // In the plane, boxes as long as those in space, see same-length.
  for (const double frequency : {5.0, 20.0})
    for (std::size_t seed = 1; seed <= 20; ++seed)
      for (const auto& [shape, grains] : {std::pair{"polygon", 94}, std::pair{"disk", 111}})
        add_jammed(plan, "lengths", shape, seed, 4, [&, count = grains](Parameters& p) {
          p.grains = std::size_t(count);
          p.fmax = usual_fmax(p.grains);
          p.box_ratio = 0.9;
          p.frequency = frequency;
        });
  // The wall masses from the filling on, to compare with those from the jammed state in `laws`.
  for (const double wall : {0.1, 4.0})
    for (const std::size_t seed : {1u, 2u, 3u})
      for (const char* shape : {"polygon", "disk", "sphere", "polyhedron"})
        plan.add("filling", shape, seed, [&](Parameters& p) {
          p.wall_mass_ratio = wall;
          p.duration = 0.96;
        });
  // 4. The wall moved slowly outward: the thrust without inertia, in boxes of other shapes, too.
  const auto pulled = [&](const char* shape, std::size_t seed, double ratio) {
    add_jammed(plan, "static", shape, seed, 4, [&](Parameters& p) {
      p.box_ratio = ratio;
      p.frequency = 5;
      p.wall_speed = 2e-3;
    });
  };
  for (const Names& shapes : {planar, solid})
    for (const std::size_t seed : {1u, 2u, 3u})
      for (const char* shape : shapes) pulled(shape, seed, 1);
  for (const std::size_t seed : {1u, 2u, 3u})
    for (const double ratio : {0.42, 0.7, 1.5}) pulled("polyhedron", seed, ratio);
  // 6. From round to angular and flat grains, and their friction; spheres are in `course`.
  const auto form = [&](const std::function<void(Parameters&)>& change) {
    for (const std::size_t seed : {1u, 2u, 3u})
      plan.add("form", "polyhedron", seed, [&](Parameters& p) {
        change(p);
        p.duration = 0.96;
      });
  };
  form([](Parameters& p) { p.fewest_vertices = 30; });
  form([](Parameters& p) { p.most_vertices = 12; });
  for (const double flatness : {0.7, 0.5, 0.4}) form([&](Parameters& p) { p.flatness = flatness; });
  for (const double friction : {0.1, 0.2, 0.7, 1.0})
    form([&](Parameters& p) { p.friction = friction; });
  // The same with concave grains of four parts, in both dimensions; `course` has the convex ones.
  for (const std::size_t seed : {1u, 2u, 3u})
    for (const char* shape : {"compound_polygon", "compound"})
      plan.add("concave", shape, seed, with(&Parameters::duration, 1));
  // 5. A thousand periods.
  for (const char* shape : {"polygon", "polyhedron"})
    add_jammed(plan, "thousand", shape, 1, 1000, [](Parameters& p) {
      p.frequency = 20;
      p.checkpoint_every = 5000;
      p.resume = true;
    });
  // 7. The method of 2008: rigid contacts, few sweeps to a wide tolerance, overlaps not corrected.
  for (const double frequency : {5.0, 20.0, 10.0, 2.0, 60.0})
    for (const char* shape : {"polygon", "polyhedron"})
      plan.add("method-2008", shape, 1, [&](Parameters& p) {
        p = Parameters();
        p.shape = shape;
        p.frequency = frequency;
        p.tolerance = 1e-3;
        p.max_sweeps = 200;
        p.correction = false;
        p.duration = std::max(1.0, 5 / frequency);
      });
  // The exponent over three frequencies again, at half the step and at a tenth of the tolerance.
  const auto converged = [&](const char* shape, std::size_t seed, Numbers frequencies) {
    for (const double frequency : frequencies)
      for (const auto& [step, tolerance] : {std::pair{1e-4, 1e-5}, {2e-4, 1e-6}})
        add_jammed(plan, "converged", shape, seed, 4,
                   [&, h = step, limit = tolerance](Parameters& p) {
                     p.frequency = frequency;
                     p.step = h;
                     p.tolerance = limit;
                   });
  };
  for (const std::size_t seed : {1u, 2u, 3u}) {
    converged("polygon", seed, {7, 3.5, 2});
    converged("polyhedron", seed, {15, 7, 3.5});
  }
  return std::move(plan).cases();
}

/// A box of the controls: so many grains and so high a box that H/L is 0.98 at the start, gap below the
/// lid included, and L/d is `length`.
struct ControlBox {
  const char* shape;
  double length;
  std::size_t grains;
  double ratio;
  std::vector<std::size_t> seeds;
};

std::vector<std::size_t> seeds_from_31(std::size_t count) {
  std::vector<std::size_t> seeds;
  for (std::size_t k = 0; k < count; ++k) seeds.push_back(31 + k);
  return seeds;
}

/// The cheapest boxes first. Samples from 31 on; 1200 grains in space are the boxes of the other plans, whose
/// samples they continue.
std::vector<ControlBox> control_boxes() {
  const auto seeds = seeds_from_31;
  return {{"polygon", 10.7, 91, 0.893, seeds(20)},  {"disk", 10.7, 54, 0.893, seeds(20)},
          {"polygon", 8, 49, 0.866, seeds(20)},     {"disk", 8, 29, 0.86, seeds(20)},
          {"sphere", 10.7, 424, 1, seeds(5)},       {"sphere", 8, 174, 0.98, seeds(5)},
          {"disk", 15.1, 112, 0.918, seeds(20)},    {"polygon", 16, 209, 0.922, seeds(10)},
          {"polyhedron", 8, 493, 0.98, seeds(5)},   {"sphere", 15.1, 1200, 1, seeds(5)},
          {"polyhedron", 10.7, 1200, 1, seeds(5)},  {"disk", 24, 291, 0.95, seeds(10)},
          {"polygon", 24, 480, 0.941, seeds(10)},   {"sphere", 24, 4876, 1.02, seeds(3)},
          {"polyhedron", 16, 4063, 1.01, seeds(3)}, {"polyhedron", 24, 13850, 1.02, seeds(1)}};
}

/// Contacts x start in boxes of one length.
void add_equal_lengths(Builder& plan, const ControlBox& box, double frequency, double force) {
  const auto change = [&](Parameters& p) {
    p.grains = box.grains;
    p.box_ratio = box.ratio;
    p.fmax = force * usual_fmax(box.grains);
    p.frequency = frequency;
  };
  for (const std::size_t seed : box.seeds) {
    for (const char* contacts : {"settled", "paper"})
      add_jammed(plan, "equal-length", box.shape, seed, 4, change, contacts);
    if (frequency != 5 || force != 1) continue;
    for (const char* contacts : {"settled", "paper"})
      plan.add_to(contacts, "equal-length", box.shape, seed, change);
  }
}

/// Depth of the box and its side walls, at L/d = 10.7.
void add_depths(Builder& plan, const char* shape, std::size_t grains) {
  const auto vary = [&](double width, const char* walls) {
    for (const std::size_t seed : seeds_from_31(5))
      add_jammed(plan, "depth", shape, seed, 4, [&](Parameters& p) {
        p.grains = std::size_t(std::lround(width * double(grains)));
        p.fmax = usual_fmax(p.grains);
        p.width_ratio = width;
        p.side_walls = walls;
      });
  };
  vary(0.5, "frictionless");
  vary(1, "periodic");
  vary(1, "frictional");
  vary(2, "frictionless");
}

// What separates causes that the other plans change together: the dimension from the length of the box,
// contacts from the start, the depth and the side walls of the box; one jammed state for each of ten
// samples; the stiffness. Samples from 31 on, which no other plan has.
std::vector<Case> controls_plan() {
  Builder plan("settled");
  for (const ControlBox& box : control_boxes())
    if (box.grains < 4000) add_equal_lengths(plan, box, 5, 1);
  add_depths(plan, "sphere", 424);
  const Names all{"disk", "polygon", "sphere", "polyhedron"};
  const auto one_state = [&](const char* set, const char* shape, std::size_t seed, double frequency,
                             double stiffness) {
    add_jammed(plan, set, shape, seed, 4, [&](Parameters& p) {
      p.frequency = frequency;
      p.stiffness = stiffness;
    });
  };
  for (const char* shape : all)
    for (const double frequency : {10.0, 15.0, 20.0, 35.0, 60.0})
      for (const double stiffness : {1e8, 1e7, 1e9})
        for (const std::size_t seed : seeds_from_31(3))
          one_state("stiffness", shape, seed, frequency, stiffness);
  for (const char* shape : all)
    for (const double frequency : {5.0, 10.0, 2.0})
      for (const std::size_t seed : seeds_from_31(10))
        one_state("ten-states", shape, seed, frequency, 1e8);
  for (const double frequency : {5.0, 2.0})
    for (const double force : {1.0, 1 / 3.0, 5 / 3.0})
      for (const ControlBox& box : control_boxes())
        if (box.grains < 4000) add_equal_lengths(plan, box, frequency, force);
  for (const ControlBox& box : control_boxes()) add_equal_lengths(plan, box, 5, 1);
  add_depths(plan, "polyhedron", 1200);
  return std::move(plan).cases();
}

// Few grains, for a look at the whole in about a minute: no result of it means anything.
std::vector<Case> small_plan() {
  Builder plan("small");
  const Names shapes{"polygon", "disk"};
  series(plan, "frequencies", shapes, 1, &Parameters::frequency, {5, 10, 20});
  series(plan, "fmax", shapes, 1, &Parameters::fmax, {250, 500});
  return std::move(plan).cases();
}

template <class Value>
bool wanted(const std::vector<Value>& asked, const Value& value) {
  return asked.empty() || std::find(asked.begin(), asked.end(), value) != asked.end();
}

/// @throws std::invalid_argument if a case with the property `of` is asked for and there is none
template <class Value>
void require_known(const std::vector<Case>& plan, const std::vector<Value>& asked, const char* what,
                   const std::function<bool(const Case&, const Value&)>& has) {
  for (const Value& value : asked)
    if (std::none_of(plan.begin(), plan.end(), [&](const Case& c) { return has(c, value); })) {
      if constexpr (std::is_same_v<Value, std::string>)
        throw std::invalid_argument(std::string(what) + ": no case of the plan has " + value);
      else
        throw std::invalid_argument(std::string(what) + ": no case of the plan has " +
                                    std::to_string(value));
    }
}

}  // namespace

std::vector<std::string> plan_names() {
  return {"paper", "small", "settled", "controls"};
}

Parameters baseline(const std::string& plan, const std::string& shape, std::size_t seed) {
  Parameters p;
  p.shape = shape;
  p.seed = seed;
  if (plan == "small") {
    p.grains = 150;
    p.fmax = 500;
    p.step = 5e-4;
  }
  if (plan == "settled") {
    p.method = "compliant";
    p.stiffness = 1e8;
    p.tolerance = 1e-5;
    p.stop_test = moreau::StopTest::natural_map;
    p.max_sweeps = 2000;
    p.cold_sweeps = 3000;
    p.correction = false;
  }
  return p;
}

std::vector<Case> make_plan(const std::string& name) {
  if (name == "paper") return paper_plan();
  if (name == "small") return small_plan();
  if (name == "settled") return settled_plan();
  if (name == "controls") return controls_plan();
  throw std::invalid_argument("--plan: there is no plan " + name);
}

std::vector<Case> select(const std::vector<Case>& plan, const Selection& s) {
  using Name = std::string;
  require_known<Name>(plan, s.sets, "--set",
                      [](const Case& c, const Name& set) { return c.sets.contains(set); });
  require_known<Name>(plan, s.shapes, "--shape",
                      [](const Case& c, const Name& shape) { return c.parameters.shape == shape; });
  require_known<std::size_t>(plan, s.seeds, "--seed", [](const Case& c, const std::size_t& seed) {
    return c.parameters.seed == seed;
  });
  require_known<std::size_t>(
      plan, s.numbers, "--case",
      [](const Case& c, const std::size_t& number) { return c.number == number; });
  const auto named = [&](const Case& c) {
    const bool in_sets =
        s.sets.empty() || std::any_of(s.sets.begin(), s.sets.end(),
                                      [&](const Name& set) { return c.sets.contains(set); });
    return in_sets && wanted(s.shapes, c.parameters.shape) &&
           wanted(s.seeds, std::size_t(c.parameters.seed)) && wanted(s.numbers, c.number);
  };
  std::set<std::string> starts;
  if (s.numbers.empty())
    for (const Case& c : plan)
      if (named(c)) starts.insert(c.parameters.from);
  std::vector<Case> selected;
  std::copy_if(plan.begin(), plan.end(), std::back_inserter(selected),
               [&](const Case& c) { return named(c) || starts.contains(c.name); });
  return selected;
}

std::string packing_name(const Parameters& p) {
  const Parameters usual;
  std::string name = p.shape + "-s" + std::to_string(p.seed);
  for (const Option& option : options())
    if (option.prepares && option.value(p) != option.value(usual))
      name += "-" + std::string(option.mark) + text(option.value(p)) + std::string(option.unit);
  if (p.size_reading != usual.size_reading) name += "-circumradius";
  if (p.side_walls != usual.side_walls) name += "-" + p.side_walls;
  if (p.method == "compliant") name += "-compliant";
  return name;
}

double seconds_of(const Parameters& p) {
  // Milliseconds of a step of 1200 grains, measured on one core: compliant contacts with k = 1e8 N/m
  // to 1e-5, rigid contacts by QM/16 to 1e-4.
  const bool compliant = p.method == "compliant";
  const double step = p.shape == "polyhedron"         ? (compliant ? 13.0 : 23.0)
                      : p.shape == "compound"         ? 20.0
                      : p.shape == "compound_polygon" ? 5.0
                      : p.shape == "sphere"           ? (compliant ? 5.0 : 14.0)
                      : p.shape == "polygon"          ? (compliant ? 2.4 : 3.3)
                                                      : (compliant ? 1.5 : 2.2);
  return 1e-3 * step * double(p.grains) / 1200 * (p.duration / p.step);
}

std::vector<std::string> arguments(const Parameters& p) {
  const Parameters usual;
  std::vector<std::string> list{"--shape", p.shape, "--seed", std::to_string(p.seed)};
  for (const Option& option : options()) {
    // Stiffness and tolerance of compliant contacts have defaults of their own.
    const bool has_other_default = option.flag == "--stiffness" || option.flag == "--tolerance";
    if (option.value(p) != option.value(usual) || (has_other_default && p.method == "compliant")) {
      list.emplace_back(option.flag);
      list.push_back(text(option.value(p)));
    }
  }
  if (p.size_reading != usual.size_reading)
    list.insert(list.end(), {"--size-reading", "circumradius"});
  if (p.method != usual.method) list.insert(list.end(), {"--method", p.method});
  if (p.cold_sweeps != usual.cold_sweeps)
    list.insert(list.end(), {"--cold-sweeps", std::to_string(p.cold_sweeps)});
  if (p.side_walls != usual.side_walls) list.insert(list.end(), {"--side-walls", p.side_walls});
  if (!p.from_method.empty()) list.insert(list.end(), {"--from-method", p.from_method});
  if (!p.correction) list.emplace_back("--no-correction");
  if (p.checkpoint_every > 0)
    list.insert(list.end(), {"--checkpoint-every", std::to_string(p.checkpoint_every)});
  if (p.resume) list.emplace_back("--resume");
  return list;
}

}  // namespace study
