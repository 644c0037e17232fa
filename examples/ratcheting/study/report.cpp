// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "moreau/io/output_file.hpp"

#include "figures.hpp"
#include "verdicts.hpp"

namespace study {

namespace {

using Shapes = std::vector<ShapeSummary>;
using Sample = SampleSummary;

std::string title_of(const std::string& shape) {
  if (shape == "polyhedron") return "3D, polyhedra";
  if (shape == "polygon") return "2D, polygons";
  return shape == "sphere" ? "3D, spheres" : "2D, disks";
}

std::string header(const std::string& first, const Shapes& shapes) {
  std::string line = "| " + first + " |", rule = "|---|";
  for (const ShapeSummary& shape : shapes) {
    line += " " + title_of(shape.shape) + " |";
    rule += "---|";
  }
  return line + "\n" + rule + "\n";
}

/// One line of a table: a value over the samples of each shape.
std::string table_line(const Shapes& shapes, const char* name,
                       const std::function<double(const Sample&)>& value) {
  std::string text = std::string("| ") + name + " |";
  for (const ShapeSummary& shape : shapes) {
    const std::string cell = text_of(over_samples(shape, value));
    text += " " + (cell.empty() ? "–" : cell) + " |";
  }
  return text + "\n";
}

std::string completeness(const std::vector<Case>& plan, const std::vector<Result>& results) {
  std::map<std::string, std::pair<std::size_t, std::size_t>> sets;
  for (const Case& c : plan)
    for (const std::string& set : c.sets) ++sets[set].second;
  for (const Result& r : results)
    for (const std::string& set : r.c.sets) ++sets[set].first;
  std::string text = std::to_string(results.size()) + " of the plan's " +
                     std::to_string(plan.size()) + " cases are done:";
  for (const auto& [set, count] : sets)
    text += " " + set + " " + std::to_string(count.first) + "/" + std::to_string(count.second) +
            (set == sets.rbegin()->first ? "." : ",");
  std::size_t steps = 0, capped = 0;
  for (const Result& r : results) {
    steps += r.facts.steps;
    capped += r.facts.capped_steps;
  }
  return text + "\nOf " + std::to_string(steps) + " steps " + std::to_string(capped) +
         " did not converge: the cap of sweeps was met first, or more than a tenth of the approach "
         "that "
         "the step would bring was left over (SolveReport::relative_approach; a heavy wall that is "
         "jammed "
         "has "
         "little of it). All others met the stopping test.\n";
}

std::string verdict_table(const std::vector<Row>& rows, const Shapes& shapes) {
  std::string text = "| quantity | paper | accepted |", rule = "|---|---|---|";
  for (const ShapeSummary& shape : shapes) {
    text += " " + title_of(shape.shape) + " |";
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  struct Tally {
    std::size_t held = 0, judged = 0;
  };
  std::vector<Tally> results(shapes.size()), settings(shapes.size());
  for (const Row& row : rows) {
    text += "| " + row.quantity + " | " + row.paper + " | " + row.accepted + " |";
    for (std::size_t k = 0; k < row.cells.size(); ++k) {
      const Cell& cell = row.cells[k];
      text += " " + (cell.value.empty() ? "–" : cell.value);
      if (cell.holds) {
        text += mark(cell.holds);
        Tally& tally = (row.is_setting ? settings : results)[k];
        ++tally.judged;
        tally.held += *cell.holds;
      }
      text += " |";
    }
    text += "\n";
  }
  text += "\nOf what comes out (rows 6 to 18) there hold";
  for (std::size_t k = 0; k < shapes.size(); ++k)
    text += (k > 0 ? ", " : " ") + std::to_string(results[k].held) + " of " +
            std::to_string(results[k].judged) + " (" + title_of(shapes[k].shape) + ")";
  text += "; of how the case is set up (rows 1 to 5)";
  for (std::size_t k = 0; k < shapes.size(); ++k)
    text += (k > 0 ? ", " : " ") + std::to_string(settings[k].held) + " of " +
            std::to_string(settings[k].judged);
  return text +
         ". Δx is judged twice, as the paper's Δx_max and without the creep of the blocked wall; "
         "row 18 twice, too. ✓ holds, ✗ misses, without mark: reported only. ± is the standard "
         "deviation over the samples, their number in brackets. Spheres and disks are judged by "
         "the ranges for grains with corners of their dimension.\n";
}

/// One line per run of a set: what was varied and what it changes.
std::string variants(const std::vector<Result>& results, const std::string& set,
                     const std::function<std::string(const Result&)>& what) {
  std::string text;
  std::vector<const Result*> runs;
  for (const Result& r : results)
    if (r.c.sets.contains(set)) runs.push_back(&r);
  std::stable_sort(runs.begin(), runs.end(),
                   [&](const Result* a, const Result* b) { return what(*a) < what(*b); });
  for (const Result* r : runs)
    text += "| " + what(*r) + " | " + r->c.parameters.shape + " | " + text_of(r->mass) + " | " +
            text_of(r->length) + " | " + text_of(r->height / r->length) + " | " +
            text_of(1e3 * r->dx_max) + " | " + text_of(1e3 * r->creep, 2) + " | " +
            text_of(r->thrust / r->weight) + " | " + text_of(r->constant) + " | " +
            text_of(r->dx_active / sine_displacement(r->push(), 1.0 / 3)) + " | " +
            text_of(r->rho_initial) + " | " + text_of(r->rate, 2) + " | " +
            text_of(1e3 * r->net_contraction, 2) + " |\n";
  return text;
}

const char* variants_header =
    "| | shape | m [kg] | L [m] | H/L | Δx_max [mm] | creep in it [mm] | f_a/mg | C | Δx / closed "
    "form, β = 1/3 | "
    "ρ "
    "at the start | rate [1/s] | x_j − x_j' [mm] "
    "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";

std::string open_parameters(const std::vector<Result>& results) {
  const auto number = [](const char* name, double Parameters::*field) {
    return
        [=](const Result& r) { return std::string(name) + " " + text_of(r.c.parameters.*field); };
  };
  std::string text =
      "Taken, where the paper is silent: \"diameter\" is twice the largest distance from "
      "barycentre "
      "to vertex, 2700 kg/m³, L = W = H, lid force 10 weights of the sample, m_w = m/2, control "
      "volume 2 d from the side walls and from 0.1 H to 0.7 H, in the plane a thickness that gives "
      "the sample its weight in space. What else would change, 5 Hz and 6 kN:\n\n";
  text += variants_header;
  text += variants(results, "reading", [](const Result& r) {
    return std::string(r.c.parameters.size_reading == moreau::SizeReading::circumradius
                           ? "size = largest distance (B)"
                           : "size = twice that (A)");
  });
  text += variants(results, "box-ratio", number("box, aimed at H/L =", &Parameters::box_ratio));
  text += variants(results, "lid-force", number("lid force / mg =", &Parameters::lid_force));
  return text;
}

/// Whether the wall does what its force asks for; nothing where that is not said.
std::optional<bool> holds_state(const Result& r, const std::vector<Result>& results) {
  const Parameters& p = r.c.parameters;
  const Result* base = find(results, "states", p.shape, p.seed, &Parameters::fmin, 0);
  if (base == nullptr || base == &r) return std::nullopt;
  if (p.fmin > base->thrust) return r.dx_max < 0.01 * base->dx_max;
  if (p.fmax < base->thrust) return r.periods.back().jam_after > 0;
  if (p.fmax < base->c.parameters.fmax && r.rest_share) return *r.rest_share < 0.05;
  return std::nullopt;
}

std::string states(const std::vector<Result>& results) {
  std::string text =
      "fmin above the active thrust: the wall must not move out (less than 1 % of its way without "
      "fmin); fmax below the passive thrust: it never jams (is at rest, slower than a hundredth of "
      "its largest speed, for less than 5 % of the period); fmax below the active thrust: it only "
      "moves out.\n\n"
      "| shape | tolerance | fmin [N] | fmax [N] | Δx_max [mm] | x at the end [mm] | at rest [%] | "
      "f_a/mg | |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const Result& r : results) {
    if (!r.c.sets.contains("states") || r.periods.empty()) continue;
    const std::optional<bool> holds = holds_state(r, results);
    const Parameters& p = r.c.parameters;
    text += "| " + p.shape + " | " + text_of(p.tolerance) + " | " + text_of(p.fmin, 5) + " | " +
            text_of(p.fmax, 5) + " | " + text_of(1e3 * r.dx_max) + " | " +
            text_of(1e3 * r.periods.back().jam_after) + " | " +
            text_of(100 * r.rest_share.value_or(std::nan("")), 2) + " | " +
            text_of(r.thrust / r.weight) + " |" + mark(holds) + " |\n";
  }
  return text;
}

std::string numerics(const std::vector<Result>& results) {
  std::string text = variants_header;
  text += variants(results, "numerics", [](const Result& r) {
    const Parameters& p = r.c.parameters;
    return text_of(p.frequency) + " Hz, h = " + text_of(p.step) + " s, tolerance " +
           text_of(p.tolerance);
  });
  text += variants(results, "uncorrected", [](const Result& r) {
    return text_of(r.c.parameters.frequency) + " Hz, no overlap correction";
  });
  return text;
}

/// Of a series the runs that have the paper's values but for one parameter.
Series varying(const Series& series, double Parameters::*parameter) {
  const Parameters paper;
  Series kept;
  for (const Result* r : series) {
    bool keeps = true;
    for (const auto other : {&Parameters::frequency, &Parameters::fmax, &Parameters::gravity,
                             &Parameters::wall_mass_ratio})
      keeps = keeps && (other == parameter || r->c.parameters.*other == paper.*other);
    if (keeps) kept.push_back(r);
  }
  return kept;
}

/// Rows 7, 8, 13 and 15, and 16 and 17 of a set that varies what they are of, from the runs of
/// another set.
std::string elsewhere(const std::string& set, const std::string& title,
                      const std::vector<Result>& results, const Shapes& shapes) {
  std::string text = header(title, shapes);
  const auto line = [&](const char* name, const std::function<std::string(const Series&)>& value) {
    text += std::string("| ") + name + " |";
    for (const ShapeSummary& shape : shapes) {
      const std::string cell = value(series_of(results, set, shape.shape, 1));
      text += " " + (cell.empty() ? "–" : cell) + " |";
    }
    text += "\n";
  };
  const auto law = [](const Series& series, double Result::*field, double low, double high,
                      double Parameters::*parameter = &Parameters::frequency) {
    std::vector<Point> points;
    for (const Result* r : varying(series, parameter))
      points.push_back({r->c.parameters.*parameter, r->*field});
    if (points.size() < 3) return std::string();
    const double exponent = fit_power_law(points).exponent;
    return text_of(exponent, 4) + mark(within(exponent, low, high));
  };
  const auto master = [](const Series& series, double Result::*field) {
    if (varying(series, &Parameters::fmax).size() < 3) return std::string();
    const Proportion fit = master_fit(series, field, 1);
    const double paper = paper_constant(series.front()->c.parameters.shape);
    return text_of(fit.factor) + mark(within(fit.factor, paper / 3, 3 * paper)) + ", scatter " +
           text_of(100 * fit.scatter) + " %" + mark(within(fit.scatter, 0, 0.2));
  };
  const auto at_five = [](const Series& series,
                          const std::function<std::string(const Result&)>& f) {
    for (const Result* r : varying(series, &Parameters::frequency))
      if (r->c.parameters.frequency == 5) return f(*r);
    return std::string();
  };
  const auto varies = [&](double Parameters::*parameter) {
    return std::any_of(results.begin(), results.end(), [&](const Result& r) {
      return r.c.sets.contains(set) && r.c.parameters.*parameter != Parameters{}.*parameter;
    });
  };
  line("7 periods in which x_j falls, 5 Hz", [&](const Series& s) {
    return at_five(s, [](const Result& r) {
      return std::to_string(r.contracting) + " of " + std::to_string(r.periods.size()) +
             mark(4 * r.contracting >= 3 * r.periods.size());
    });
  });
  line("13 compaction rate at 5 Hz [1/s]", [&](const Series& s) {
    return at_five(s, [](const Result& r) {
      return text_of(r.rate) +
             (is_plane(r.c.parameters.shape) ? "" : mark(within(r.rate, 0.0125, 0.05)));
    });
  });
  line("8 creep / Δx_max at 20 Hz", [&](const Series& s) {
    for (const Result* r : s)
      if (r->c.parameters.frequency == 20) return text_of(r->creep / r->dx_max, 2);
    return std::string();
  });
  line("14 scaled phase portraits at 5 and 10 Hz, apart by", [&](const Series& s) {
    const Series only = varying(s, &Parameters::frequency);
    const auto at = [&](double nu) {
      const auto run = std::find_if(only.begin(), only.end(), [=](const Result* r) {
        return r->c.parameters.frequency == nu && !r->loop.empty();
      });
      return run == only.end() ? nullptr : *run;
    };
    const Result *five = at(5), *ten = at(10);
    if (five == nullptr || ten == nullptr) return std::string();
    const double distance = 100 * scaled_loop_distance(*five, *ten);
    return text_of(distance) + " %" + mark(within(distance, 0, 15));
  });
  line("18 rate, whole box, first second, at 2; 5; 10; 20; 60 Hz [1e-3/s]", [&](const Series& s) {
    std::string rates;
    for (const double nu : {2.0, 5.0, 10.0, 20.0, 60.0})
      for (const Result* r : varying(s, &Parameters::frequency))
        if (r->c.parameters.frequency == nu)
          rates += (rates.empty() ? "" : "; ") + text_of(1e3 * r->early_rate(&Jam::rho_box), 2);
    return rates;
  });
  line("15 exponent of Δx_max over ν",
       [&](const Series& s) { return law(s, &Result::dx_max, -2.1, -1.9); });
  line("15 the same from where f falls below mg",
       [&](const Series& s) { return law(s, &Result::dx_active, -2.1, -1.9); });
  line("15 exponent of v_max over ν",
       [&](const Series& s) { return law(s, &Result::v_max, -1.1, -0.9); });
  const auto both = [&](const char* name, double low, double high, double Parameters::*parameter) {
    if (!varies(parameter)) return;
    line(name, [&](const Series& s) { return law(s, &Result::dx_max, low, high, parameter); });
    line("16 the same from where f falls below mg",
         [&](const Series& s) { return law(s, &Result::dx_active, low, high, parameter); });
  };
  both("16 exponent of Δx_max over fmax", -1.1, -0.9, &Parameters::fmax);
  both("16 exponent of Δx_max over g", 1.85, 2.15, &Parameters::gravity);
  if (!varies(&Parameters::fmax)) return text;
  line("17 C of all", [&](const Series& s) { return master(s, &Result::dx_max); });
  line("17 the same from where f falls below mg",
       [&](const Series& s) { return master(s, &Result::dx_active); });
  return text;
}

/// The closed form with what the force on the wall tells of the flight, and with one thrust and one
/// beta for all runs.
std::string prediction(const Shapes& shapes) {
  std::string text =
      "A constant thrust F and a moving mass m_w + βm give Δx_max = 0.228 F² / [(m_w + βm) fmax "
      "ν²], so C = 0.228 (F/mg)² (m + m_w)/(m_w + βm); here with the full sine. Measured is the "
      "way out from where f falls below mg.\n\n"
      "**F and β off the force on the wall.** While the wall moves out, f_g = F − βm a is fitted "
      "to every flight, a the wall's acceleration: the grains push with F less what it takes to "
      "accelerate those that move along. R² is what the two say of the variance of f_g. Neither is "
      "fitted to a displacement; they say how far the wall goes if it starts where f = F.\n\n" +
      header("", shapes);
  const auto line = [&](const std::string& name,
                        const std::function<double(const Sample&)>& value) {
    text += table_line(shapes, name.c_str(), value);
  };
  const auto at = [](double nu, const auto& value) {
    return [=](const Sample& x) { return x.at(nu, value); };
  };
  const auto steady = [](const Result& r) { return r.steady_thrust; };
  const auto carried = [](const Result& r) { return r.carried_share; };
  for (const double nu : {2.0, 5.0, 10.0, 20.0, 60.0})
    line("F/mg at " + text_of(nu) + " Hz", at(nu, steady));
  for (const double nu : {2.0, 5.0, 10.0, 20.0, 60.0})
    line("β at " + text_of(nu) + " Hz", at(nu, carried));
  const auto walls = [&](double ratio, double Result::*field) {
    return [=](const Sample& x) {
      for (const Result* r : x.walls)
        if (r->c.parameters.wall_mass_ratio == ratio) return r->*field;
      return std::nan("");
    };
  };
  for (const double ratio : {0.1, 0.5, 4.0})
    line("F/mg with m_w = " + text_of(ratio) + " m, 5 Hz", walls(ratio, &Result::steady_thrust));
  for (const double ratio : {0.1, 0.5, 4.0})
    line("β with m_w = " + text_of(ratio) + " m, 5 Hz", walls(ratio, &Result::carried_share));
  line("R² at 5 Hz", at(5, [](const Result& r) { return r.explained; }));
  line("measured / predicted, all of the master curve",
       [](const Sample& x) { return x.flight.factor; });
  line("scatter", [](const Sample& x) { return x.flight.scatter; });
  line("scatter of one C over the same ways out",
       [](const Sample& x) { return x.active.master.scatter; });
  text +=
      "\n**One β for all runs**, with each run's mean force f_a on the wall that moves out. From "
      "rest to rest the mean force of the grains is the mean of f, so that f_a tells how long the "
      "flight lasts; and β is nearly a common factor: that measured and predicted agree in the "
      "mean is the fit, how they scatter is not.\n\n" +
      header("", shapes);
  line("f_a/mg at the baseline", [](const Sample& x) {
    return x.base != nullptr ? x.base->thrust / x.base->weight : std::nan("");
  });
  line("β of least deviation from measured = predicted",
       [](const Sample& x) { return x.prediction.beta; });
  line("measured / predicted with it",
       [](const Sample& x) { return x.prediction.measured_over_predicted.factor; });
  line("scatter", [](const Sample& x) { return x.prediction.measured_over_predicted.scatter; });
  line("measured / predicted with β = 1/3",
       [](const Sample& x) { return x.prediction_third.factor; });
  line("scatter", [](const Sample& x) { return x.prediction_third.scatter; });
  line("β of the ways out over the wall's mass (row 16)",
       [](const Sample& x) { return x.active.wall_share.beta; });
  line("measured / predicted with it", [](const Sample& x) { return x.prediction_walls.factor; });
  line("scatter", [](const Sample& x) { return x.prediction_walls.scatter; });
  line("exponent over ν, β = 1/3", [](const Sample& x) { return x.predicted_frequency.exponent; });
  line("exponent measured", [](const Sample& x) { return x.active.frequency.exponent; });
  for (const double nu : {2.0, 5.0, 10.0, 20.0, 60.0})
    line("f_a/mg at " + text_of(nu) + " Hz",
         at(nu, [](const Result& r) { return r.thrust / r.weight; }));
  line("C measured", [](const Sample& x) { return x.whole.master.factor; });
  line("C measured, from where f falls below mg",
       [](const Sample& x) { return x.active.master.factor; });
  return text;
}

/// The plane in a box as long as that of space.
std::string same_length(const std::vector<Result>& results, const Shapes& shapes) {
  std::string text =
      "1200 grains make a box more than three times as long in the plane as in space, and the gap "
      "of 1 cm above them is as much smaller against it. The third and the sixth line are plane "
      "samples in boxes as long as those of space, with as much force per weight, H/L near 1 and "
      "a tenth of the tolerance. 5 Hz, fmax/mg as at the baseline; ± is the standard error of the "
      "mean over the samples.\n\n"
      "| | samples | L [m] | H/L | rate [1/s] | whole box, first second [1/s] | x_j − x_j' [mm] | "
      "C | C without creep | F/mg | β | jammed σxx/σzz |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  const auto line = [&](const std::string& name, const Series& runs) {
    const auto of = [&](const std::function<double(const Result&)>& value) {
      std::vector<double> values;
      for (const Result* r : runs) values.push_back(value(*r));
      Estimate e = estimate(values);
      e.spread /= std::sqrt(double(e.samples));
      const bool spreads = e.spread > 1e-9 * std::abs(e.mean);
      return spreads         ? text_of(e.mean) + " ± " + text_of(e.spread, 2)
             : e.samples > 0 ? text_of(e.mean)
                             : "–";
    };
    text += "| " + name + " | " + std::to_string(runs.size()) + " | " +
            of([](const Result& r) { return r.length; }) + " | " +
            of([](const Result& r) { return r.height / r.length; }) + " | " +
            of([](const Result& r) { return r.rate; }) + " | " +
            of([](const Result& r) { return r.early_rate(&Jam::rho_box); }) + " | " +
            of([](const Result& r) { return 1e3 * r.net_contraction; }) + " | " +
            of([](const Result& r) { return r.constant; }) + " | " +
            of([](const Result& r) { return r.dx_active / r.scaled_load(); }) + " | " +
            of([](const Result& r) { return r.steady_thrust; }) + " | " +
            of([](const Result& r) { return r.carried_share; }) + " | " +
            of([](const Result& r) { return r.behaviour.jammed_xx / r.behaviour.jammed_zz; }) +
            " |\n";
  };
  for (const ShapeSummary& shape : shapes) {
    Series bases, short_boxes;
    for (const Sample& sample : shape.samples)
      if (sample.base != nullptr) bases.push_back(sample.base);
    line(title_of(shape.shape), bases);
    if (!is_plane(shape.shape)) continue;
    for (const Result& r : results)
      if (r.c.sets.contains("same-length") && r.c.parameters.shape == shape.shape)
        short_boxes.push_back(&r);
    line(title_of(shape.shape) + ", box as in 3D", short_boxes);
  }
  return text;
}

/// Why the speed of the way back falls more slowly than 1/nu.
std::string passive_speed(const Shapes& shapes) {
  std::string text =
      "Back at its start the wall has, by the closed form, a speed that goes as 1/ν: the row below "
      "takes for each run the thrust that explains its way out. But it goes on inward as the "
      "grains compact, by the more ways out the shorter these are, and is pushed on meanwhile. "
      "Unbraked to where it jams it would have the third row's exponent; what is measured, slowed "
      "by the grains, should lie between the two.\n\n" +
      header("", shapes);
  const auto line = [&](const char* name, const std::function<double(const Sample&)>& value) {
    text += table_line(shapes, name, value);
  };
  line("exponent of the speed at its start, closed form",
       [](const Sample& x) { return x.speed_at_start.exponent; });
  line("exponent of v_max, measured", [](const Sample& x) { return x.v_frequency.exponent; });
  line("exponent of the speed where it jams, closed form without a brake",
       [](const Sample& x) { return x.speed_at_jam.exponent; });
  for (const double nu : {2.0, 5.0, 20.0, 60.0})
    line(("(x_j − x_j') / way out at " + text_of(nu) + " Hz").c_str(), [=](const Sample& x) {
      return x.at(nu, [](const Result& r) { return r.net_contraction / r.dx_active; });
    });
  return text;
}

std::string relaxation(const std::vector<Result>& results, const Shapes& shapes) {
  std::string text =
      "| shape | | √(g/d) [1/s] | ν_c [Hz] | rms of ln(rate) about the branches; about one power "
      "law | ν_c [Hz], whole box, first second | rms | mg/fmax |\n"
      "|---|---|---|---|---|---|---|---|\n";
  const auto cells = [](const CompactionLaws& laws) -> std::string {
    if (std::isnan(laws.branches.scatter)) return " |  | ";
    const bool counts = laws.branches.scatter < laws.scatter_about_law;
    return (counts ? "" : "(") + text_of(laws.branches.nu_c) +
           (laws.branches.at_edge ? ", at the edge" : "") + (counts ? "" : ")") + " | " +
           text_of(laws.branches.scatter, 2) + "; " + text_of(laws.scatter_about_law, 2) + " | ";
  };
  std::set<double> frequencies;
  const auto line = [&](const std::string& shape, const std::string& condition, double scale,
                        const Series& series) {
    text += "| " + shape + " | " + condition + " | " + text_of(scale) + " | " +
            cells(compaction_of_run(series)) + cells(early_compaction(series)) +
            text_of(series.front()->weight / series.front()->c.parameters.fmax) + " |\n";
  };
  for (const ShapeSummary& shape : shapes) {
    std::map<std::pair<double, double>, Series> conditions;
    for (const Result* r : series_of(results, "relaxation", shape.shape, 1))
      conditions[{r->c.parameters.gravity, r->c.parameters.size_scale}].push_back(r);
    for (const auto& [condition, series] : conditions) {
      line(shape.shape,
           "g = " + text_of(condition.first) + " m/s², sizes × " + text_of(condition.second),
           std::sqrt(condition.first / (0.025 * condition.second)), series);
      for (const Result* r : series) frequencies.insert(r->c.parameters.frequency);
    }
    if (conditions.empty()) continue;
    // What the other samples of the baseline give at the same frequencies.
    for (const SampleSummary& sample : shape.samples) {
      Series same;
      for (const Result* r : sample.frequencies)
        if (frequencies.contains(r->c.parameters.frequency)) same.push_back(r);
      if (sample.seed != 1 && same.size() == frequencies.size())
        line(shape.shape, "the baseline, sample " + std::to_string(sample.seed),
             std::sqrt(Parameters{}.gravity / 0.025), same);
    }
  }
  if (frequencies.size() < 3) return text;
  const auto nu_c_of_law = [&](double exponent) {
    std::vector<Point> rates;
    for (const double nu : frequencies) rates.push_back({nu, std::pow(nu, exponent)});
    return text_of(fit_compaction(rates, two_branches).nu_c);
  };
  return text + "\nAt these frequencies the two branches would put ν_c to " + nu_c_of_law(0) +
         " Hz for a rate that does not depend on ν, to " + nu_c_of_law(-0.3) +
         " Hz for one that goes as ν^−0.3: without a maximum in the data ν_c is of the "
         "frequencies.\n";
}

std::string contradictions(const Shapes& shapes) {
  std::string text =
      "- Its fitting form (eq. 6) is not its two-branch form (eq. 5): for ν ≪ ν_c it gives 1.37 "
      "times more with the same prefactor, at 5 Hz 1.42 times. Both are fitted, with prefactors of "
      "their own (rows 18).\n"
      "- Whole-box and inner solid fraction move in opposite senses as the wall moves: row 12 "
      "holds for an inner volume at most; both are reported there.\n"
      "- \"vertex-edge and edge-edge\" simple contacts must be vertex-face and edge-edge.\n"
      "- Rows 13 and 17 need not both hold: Δx_max/L, compaction and net contraction per period of "
      "the baseline:\n\n" +
      header("baseline", shapes);
  const auto line = [&](const char* name, const std::function<double(const Result&)>& value) {
    text += table_line(shapes, name, [&](const Sample& x) {
      return x.base != nullptr ? value(*x.base) : std::nan("");
    });
  };
  line("Δx_max / L", [](const Result& r) { return r.dx_max / r.length; });
  line("Δρ_1 / ρ0, paper 0.005", [](const Result& r) { return r.compaction_per_period; });
  line("(x_j − x_j') / L", [](const Result& r) { return r.net_contraction / r.length; });
  return text;
}

/// What the runs were made with; how many by each where they are not all alike.
std::string builds(const std::vector<Result>& results) {
  std::map<std::string, int> count;
  for (const Result& r : results) ++count[r.facts.versions];
  std::string text;
  for (const auto& [versions, runs] : count)
    text += (text.empty() ? "" : "; ") + versions +
            (count.size() > 1 ? " (" + std::to_string(runs) + " runs)" : "");
  return text;
}

}  // namespace

void write_report(const std::filesystem::path& folder, const std::string& plan_name,
                  const std::vector<Case>& plan, const std::vector<Result>& results,
                  const std::vector<ShapeSummary>& shapes) {
  std::string text =
      "# Granular ratcheting in 3D and 2D\n\n"
      "Written by `ratcheting_study --plan " +
      plan_name +
      "` from the runs that are done; the study "
      "is that of Azéma, Radjai, Peyroux, Richefeu and Saussine, "
      "[arXiv 0711.1081](https://arxiv.org/abs/0711.1081). " +
      builds(results) +
      ". Every run stands in [cases.csv](cases.csv), what the figures show in [data](data), the "
      "wall clock in [wall_clock.md](wall_clock.md).\n\n" +
      completeness(plan, results) + "\n## Against the paper\n\n" +
      verdict_table(judge(results, shapes), shapes) + "\n## A closed form for C\n\n" +
      prediction(shapes) + "\n## Space and plane in boxes of one length\n\n" +
      same_length(results, shapes) + "\n## The speed of the way back\n\n" + passive_speed(shapes) +
      "\n## Parameters that the paper leaves open\n\n" + open_parameters(results) +
      "\n## Numerics\n\n" + numerics(results) + "\n" +
      elsewhere("uncorrected", "without correction", results, shapes) + "\n" +
      elsewhere("half", "step 1e-4 s", results, shapes) + "\n" +
      elsewhere("fine", "step 5e-5 s", results, shapes) + "\n" +
      elsewhere("tight", "tolerance 1e-5", results, shapes) + "\n## Other states\n\n" +
      states(results) +
      "\n## What sets ν_c\n\nForce and gap stay as they are. Were they scaled with weight and "
      "size, "
      "ν_c would go with √(g/d) by dimensions alone. A ν_c counts where the branches fit "
      "better, with the smaller rms, than one power law; else it is in brackets.\n\n" +
      relaxation(results, shapes) + "\n## Where the paper contradicts itself\n\n" +
      contradictions(shapes) + "\n## Figures\n";
  for (const Figure& figure : figures())
    if (std::filesystem::exists(folder / "figures" / (std::string(figure.name) + ".png")))
      text += std::string("\n### ") + figure.caption + "\n\n![" + figure.caption + "](figures/" +
              figure.name + ".png)\n";
  moreau::write_atomically(folder / "report.md", text);
}

}  // namespace study
