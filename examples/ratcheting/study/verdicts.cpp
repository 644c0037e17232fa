// SPDX-License-Identifier: MIT
#include "verdicts.hpp"

#include <cmath>
#include <cstdio>
#include <functional>
#include <set>

namespace study {

namespace {

using Sample = SampleSummary;

bool plane(const ShapeSummary& s) {
  return is_plane(s.shape);
}

/// The lowest sample that has a baseline.
const Sample* first_of(const ShapeSummary& s) {
  for (const Sample& sample : s.samples)
    if (sample.base != nullptr) return &sample;
  return nullptr;
}

Cell ranged(const ShapeSummary& s, const std::function<double(const Sample&)>& value, double low,
            double high, int digits = 3) {
  const Estimate e = over_samples(s, value);
  return {text_of(e, digits), within(e.mean, low, high)};
}
Cell told(const ShapeSummary& s, const std::function<double(const Sample&)>& value,
          int digits = 3) {
  return {text_of(over_samples(s, value), digits), std::nullopt};
}
double of_base(const Sample& sample, double Result::*field) {
  return sample.base != nullptr ? sample.base->*field : std::nan("");
}

std::string range_of(const Facts::Range& range) {
  return std::to_string(range[0]) + "–" + std::to_string(range[1]);
}

Cell sample_cell(const ShapeSummary& s) {
  const Sample* first = first_of(s);
  if (first == nullptr) return {};
  const Facts& f = first->base->facts;
  Cell cell;
  cell.value = std::to_string(first->base->c.parameters.grains);
  if (f.vertices) cell.value += "; vertices " + range_of(*f.vertices);
  if (!plane(s) && f.vertices && f.faces) {
    const auto [fewest, most] = *f.vertices;
    const auto [fewest_faces, most_faces] = *f.faces;
    cell.value += ", faces " + range_of(*f.faces);
    cell.holds = fewest >= 8 && most <= 37 && fewest_faces >= 12 && most_faces <= 70;
  }
  return cell;
}

Cell sizes_cell(const ShapeSummary& s) {
  const Sample* first = first_of(s);
  if (first == nullptr || first->base->facts.circumradii.empty()) return {};
  Cell cell;
  const double grains = double(first->base->c.parameters.grains);
  const double wanted_size[] = {0.025, 0.0375, 0.05}, wanted_share[] = {0.50, 0.34, 0.16};
  bool exact = true;
  std::size_t k = 0;
  for (const auto& [radius, count] : first->base->facts.circumradii) {
    const double d = 2 * radius, share = double(count) / grains;
    cell.value += (k > 0 ? ", " : "") + text_of(100 * share, 2) + " % of " + text_of(100 * d, 3);
    exact = exact && k < 3 && std::abs(d - wanted_size[k]) < 1e-6 &&
            std::abs(share - wanted_share[k]) <= 1 / grains;
    ++k;
  }
  cell.value += " cm";
  cell.holds = exact && k == 3;
  return cell;
}

Cell method_cell(const ShapeSummary& s) {
  const Sample* first = first_of(s);
  if (first == nullptr) return {};
  const Parameters& p = first->base->c.parameters;
  return {text_of(p.friction) + "; 0; " + text_of(p.step) + " s",
          p.friction == 0.4 && p.step == 2e-4};
}

Cell preparation_cell(const ShapeSummary& s) {
  const Sample* first = first_of(s);
  if (first == nullptr) return {};
  std::size_t settled = 0, samples = 0;
  for (const Sample& sample : s.samples)
    if (sample.base != nullptr) {
      ++samples;
      settled += sample.base->facts.settled;
    }
  const double raise = first->base->c.parameters.lid_raise;
  return {std::to_string(settled) + " of " + std::to_string(samples) +
              " at rest within 1 s; lid up " + text_of(100 * raise) + " cm",
          settled == samples && raise == 0.01};
}

Cell load_cell(const std::vector<Result>& results, const ShapeSummary& s) {
  std::set<double> forces;
  for (const Result& r : results)
    if (r.c.sets.contains("fmax") && r.c.parameters.shape == s.shape)
      forces.insert(r.c.parameters.fmax);
  Cell cell;
  for (const double force : forces)
    cell.value += (cell.value.empty() ? "" : ", ") + text_of(1e-3 * force);
  if (!cell.value.empty()) cell.value += " kN";
  if (forces.size() >= 4) cell.holds = true;
  return cell;
}

Cell contraction_cell(const ShapeSummary& s) {
  Cell cell;
  for (const Sample& sample : s.samples) {
    if (sample.base == nullptr || sample.base->periods.empty()) continue;
    const std::size_t n = sample.base->periods.size(), falls = sample.base->contracting;
    cell.value += (cell.value.empty() ? "" : "; ") + std::to_string(falls) + " of " +
                  std::to_string(n) + ", " + text_of(100 * sample.behaviour.early_share) +
                  " % by 0.1 s";
    cell.holds = cell.holds.value_or(true) && 4 * falls >= 3 * n;
  }
  return cell;
}

Cell order_cell(const ShapeSummary& s) {
  const Estimate lead = over_samples(s, [](const Sample& x) { return x.behaviour.onset_lead; });
  const Estimate delay =
      over_samples(s, [](const Sample& x) { return 1e3 * of_base(x, &Result::delay); });
  const Estimate net =
      over_samples(s, [](const Sample& x) { return 1e3 * of_base(x, &Result::net_contraction); });
  if (lead.samples == 0) return {};
  return {"starts " + text_of(lead, 2) + " of a period before the minimum; δt_r " +
              text_of(delay, 3) + " ms; x_j − x_j' " + text_of(net, 2) + " mm",
          std::abs(lead.mean) < 0.125 && delay.mean > 0 && net.mean > 0};
}

Cell loop_cell(const ShapeSummary& s) {
  const auto value = [&](double Behaviour::*field) {
    return over_samples(s, [field](const Sample& x) { return x.behaviour.*field; });
  };
  const Estimate active =
      over_samples(s, [](const Sample& x) { return of_base(x, &Result::thrust); });
  const Estimate passive = value(&Behaviour::passive_force);
  const Estimate rise = value(&Behaviour::active_slope), fall = value(&Behaviour::passive_slope);
  const Estimate share = over_samples(s, [](const Sample& x) {
    return x.behaviour.active_slope * of_base(x, &Result::dx_active) / of_base(x, &Result::thrust);
  });
  if (active.samples == 0) return {};
  return {"f_g " + text_of(active.mean) + " N out, " + text_of(passive.mean) + " N in; slopes " +
              text_of(1e-3 * rise.mean) + ", " + text_of(1e-3 * fall.mean) +
              " N/mm; on the way out it rises by " + text_of(share, 2) + " times its mean",
          rise.mean > 0 && fall.mean < 0 && passive.mean > active.mean &&
              std::abs(fall.mean) > rise.mean};
}

Cell stress_cell(const ShapeSummary& s) {
  const auto value = [&](double Behaviour::*field) {
    return 1e-3 * over_samples(s, [field](const Sample& x) { return x.behaviour.*field; }).mean;
  };
  const double jx = value(&Behaviour::jammed_xx), jz = value(&Behaviour::jammed_zz);
  const double ax = value(&Behaviour::active_xx), az = value(&Behaviour::active_zz);
  if (!std::isfinite(jx)) return {};
  const auto ratio = [&](double Behaviour::*xx, double Behaviour::*zz) {
    return text_of(
        over_samples(s, [=](const Sample& x) { return x.behaviour.*xx / (x.behaviour.*zz); }));
  };
  return {"jammed " + text_of(jx) + ", " + text_of(jz) + " kPa, ratio " +
              ratio(&Behaviour::jammed_xx, &Behaviour::jammed_zz) + "; active " + text_of(ax) +
              ", " + text_of(az) + " kPa, ratio " +
              ratio(&Behaviour::active_xx, &Behaviour::active_zz),
          jx > jz && az > ax};
}

Cell roll_cell(const ShapeSummary& s) {
  const Estimate roll = over_samples(s, [](const Sample& x) { return x.behaviour.roll; });
  const Estimate strength =
      over_samples(s, [](const Sample& x) { return x.behaviour.roll_strength; });
  const Estimate agreement = over_samples(s, [](const Sample& x) {
    return 100 * (x.base == nullptr ? std::nan("") : x.base->facts.roll_agreement);
  });
  if (roll.samples == 0) return {};
  std::string value = text_of(roll, 2) + " rad/s, strength " + text_of(strength.mean, 2);
  if (agreement.samples > 0)
    value += "; at the largest speed " + text_of(agreement, 2) + " % of the cells turn alike";
  const bool undecided = std::abs(roll.mean) <= roll.spread || !(roll.mean * strength.mean > 0);
  const char* sense = undecided       ? "; no sense of its own within the spread"
                      : roll.mean < 0 ? "; clockwise, counter-clockwise with the wall at the left"
                                      : "; counter-clockwise, clockwise with the wall at the left";
  return {value + sense, within(agreement.mean, 75, 100)};
}

Cell rho_x_cell(const ShapeSummary& s) {
  const auto value = [&](double Behaviour::*field) {
    return over_samples(s, [field](const Sample& x) { return 1e4 * (x.behaviour.*field); });
  };
  const Estimate out = value(&Behaviour::rho_extension), in = value(&Behaviour::rho_contraction);
  if (out.samples == 0) return {};
  return {text_of(out, 2) + ", " + text_of(in, 2) + "; whole box " +
              text_of(value(&Behaviour::box_extension), 2) + " out",
          out.mean > 0 && in.mean < 0};
}

/// Builds a row with a cell per shape.
Row row(const std::vector<ShapeSummary>& shapes, const std::string& quantity, const char* paper,
        const char* accepted, const std::function<Cell(const ShapeSummary&)>& cell) {
  Row r{quantity, paper, accepted, {}};
  for (const ShapeSummary& shape : shapes) r.cells.push_back(cell(shape));
  return r;
}

using Rows = std::vector<Row>;
using Shapes = std::vector<ShapeSummary>;

/// What the paper says of the plane beside space: the plane's cells hold only if that does too.
/// @param more whether the plane has more of the value
void compare_dimensions(const Shapes& shapes, Row& r, bool more,
                        const std::function<double(const Sample&)>& value) {
  for (std::size_t k = 0; k + 1 < shapes.size(); k += 2) {
    if (r.cells[k].value.empty() || r.cells[k + 1].value.empty()) continue;
    const Estimate space = over_samples(shapes[k], value),
                   plane = over_samples(shapes[k + 1], value);
    Cell& cell = r.cells[k + 1];
    const double by = plane.mean - space.mean, spread = std::hypot(plane.spread, space.spread);
    const bool told_apart = !(std::abs(by) <= spread);  // one sample has no spread
    cell.value += told_apart ? by > 0 ? "; above 3D" : "; below 3D"
                             : "; not told apart from 3D by the spread";
    if (std::isnan(spread)) cell.value += " (one sample)";
    cell.holds = cell.holds.value_or(true) && told_apart && (by > 0) == more;
  }
}

void judge_setting(const std::vector<Result>& results, const Shapes& shapes, Rows& rows) {
  rows.push_back(row(shapes, "1 grains", "1200; 8–37 vertices, 12–70 faces", "exact", sample_cell));
  rows.push_back(
      row(shapes, "2 sizes", "50 % of 2.5, 34 % of 3.75, 16 % of 5 cm", "exact", sizes_cell));
  rows.push_back(
      row(shapes, "3 friction; restitution; step", "0.4; 0; 2e-4 s", "exact", method_cell));
  rows.push_back(row(shapes, "4 preparation", "by the lid, without gravity; lid up 1 cm", "exact",
                     preparation_cell));
  rows.push_back(row(shapes, "5 fmax, with fmin = 0", "four in 2–10 kN", "exact",
                     [&](const ShapeSummary& s) { return load_cell(results, s); }));
}

void judge_density(const Shapes& shapes, Rows& rows) {
  const auto rho = [&](const char* quantity, const char* paper, double Result::*field, double low,
                       double high) {
    rows.push_back(row(shapes, quantity, paper, "±0.02 (3D)", [=](const ShapeSummary& s) {
      Cell cell = ranged(
          s, [=](const Sample& x) { return of_base(x, field); }, low, high);
      if (plane(s)) cell.holds.reset();
      return cell;
    }));
  };
  rho("6 ρ at the start, inner volume", "0.50", &Result::rho_initial, 0.48, 0.52);
  rho("6 ρ0 at 0.2 s, inner volume", "0.51", &Result::rho_0, 0.49, 0.53);
  rho("6 ρ at the start, whole box", "–", &Result::box_initial, 0, 1);
  rows.back().accepted = "–";
  for (Cell& cell : rows.back().cells) cell.holds.reset();
  rows.push_back(row(shapes, "6 rise (ρ0 − ρ)/ρ", "2 %", "1–3 % (3D)", [](const ShapeSummary& s) {
    Cell cell = ranged(
        s,
        [](const Sample& x) {
          return 100 * (of_base(x, &Result::rho_0) / of_base(x, &Result::rho_initial) - 1);
        },
        1, 3);
    if (plane(s)) cell.holds.reset();
    if (!cell.value.empty()) cell.value += " %";
    return cell;
  }));
}

void judge_period(const Shapes& shapes, Rows& rows) {
  rows.push_back(row(shapes, "7 x(t): x_j falls", "in four periods; fast at first, t < 0.1 s",
                     "in ≥ 3 of 4", contraction_cell));
  rows.push_back(row(shapes, "8 one period",
                     "starts near the minimum of f, peaks later, x_j' < x_j", "order, δt_r > 0",
                     order_cell));
  rows.push_back(row(shapes, "9 f_g(x)",
                     "out: flat, slightly rising with x; in: rises fast as x falls", "signs",
                     loop_cell));
  rows.push_back(row(shapes, "10 σxx, σzz", "jammed: horizontal; active: vertical",
                     "σxx > σzz jammed, reverse active", stress_cell));
  rows.push_back(row(shapes, "11 passive velocity field (x right, z up, wall at the right)",
                     "clockwise roll, wall's side not said",
                     "one roll: ≥ 75 % of the cells turn alike; sign told", roll_cell));
  rows.push_back(row(shapes, "12 1e4 Δρ out, in; inner volume", "> 0, < 0", "signs", rho_x_cell));
}

void judge_rate(const Shapes& shapes, Rows& rows) {
  rows.push_back(row(shapes, "13 compaction rate, 5 Hz, 6 kN [1/s]", "0.025 (3D), 2D slower",
                     "×2 (3D); 2D below", [](const ShapeSummary& s) {
                       Cell cell = ranged(
                           s, [](const Sample& x) { return of_base(x, &Result::rate); }, 0.0125,
                           0.05);
                       if (plane(s)) cell.holds.reset();
                       return cell;
                     }));
  compare_dimensions(shapes, rows.back(), false,
                     [](const Sample& x) { return of_base(x, &Result::rate); });
}

void judge_scaling(const Shapes& shapes, Rows& rows) {
  rows.push_back(row(shapes, "14 phase portraits 5, 10 Hz scaled", "collapse", "< 15 %",
                     [](const ShapeSummary& s) {
                       Cell cell = ranged(
                           s, [](const Sample& x) { return 100 * x.loop_distance; }, 0, 15);
                       if (!cell.value.empty()) cell.value += " %";
                       return cell;
                     }));
  using Law = std::function<const PowerLaw&(const Sample&)>;
  const auto exponent = [&](const std::string& quantity, const char* paper, const char* accepted,
                            double low, double high, const Law& law) {
    rows.push_back(row(shapes, quantity, paper, accepted, [=](const ShapeSummary& s) {
      Cell cell = ranged(
          s, [=](const Sample& x) { return law(x).exponent; }, low, high, 4);
      const Estimate error =
          over_samples(s, [=](const Sample& x) { return law(x).exponent_error; });
      if (!cell.value.empty()) cell.value += ", fit ± " + text_of(error.mean, 1);
      return cell;
    }));
  };
  const auto displacement = [&](const char* name, Scaling Sample::*of) {
    const std::string start = name;
    exponent("15 " + start + " over ν", "−2", "−2 ± 0.1", -2.1, -1.9,
             [=](const Sample& x) -> const PowerLaw& { return (x.*of).frequency; });
    exponent("16 " + start + " over fmax", "−1", "−1 ± 0.1", -1.1, -0.9,
             [=](const Sample& x) -> const PowerLaw& { return (x.*of).fmax; });
    exponent("16 " + start + " over g", "2", "2 ± 0.15", 1.85, 2.15,
             [=](const Sample& x) -> const PowerLaw& { return (x.*of).gravity; });
    rows.push_back(row(shapes, "16 " + start + " ∝ m/(m + m_w): scatter over five wall masses", "0",
                       "< 20 %", [=](const ShapeSummary& s) {
                         return ranged(
                             s, [=](const Sample& x) { return (x.*of).paper_wall_scatter; }, 0,
                             0.2);
                       }));
    rows.push_back(
        row(shapes, "16 β of " + start + " ∝ 1/(m_w + βm)", "1", "–", [=](const ShapeSummary& s) {
          return told(s, [=](const Sample& x) { return (x.*of).wall_share.beta; });
        }));
  };
  exponent("15 v_max, passive, over ν", "−1", "−1 ± 0.1", -1.1, -0.9,
           [](const Sample& x) -> const PowerLaw& { return x.v_frequency; });
  displacement("Δx_max", &Sample::whole);
  displacement("Δx from where f falls below mg", &Sample::active);
}

/// What the wall moves while the falling force still holds it: the paper has none of it.
Row creep_row(const Shapes& shapes) {
  return row(shapes, "8 creep while blocked, (x(f = mg) − x_j)/Δx_max at 5; 20; 60 Hz", "0", "–",
             [](const ShapeSummary& s) {
               Cell cell;
               for (const double nu : {5.0, 20.0, 60.0}) {
                 const Estimate creep = over_samples(s, [=](const Sample& x) {
                   return x.at(nu, [](const Result& r) { return r.creep / r.dx_max; });
                 });
                 const std::string value = text_of(creep, 2);
                 if (!value.empty()) cell.value += (cell.value.empty() ? "" : "; ") + value;
               }
               return cell;
             });
}

void judge_constant(const Shapes& shapes, Rows& rows) {
  const auto displacement = [&](const std::string& name, Scaling Sample::*of) {
    const auto constant = [=](const Sample& x) { return (x.*of).master.factor; };
    rows.push_back(row(shapes, "17 C" + name + ", with m + m_w", "0.01 (3D), 0.05 (2D)",
                       "×3; C(2D) > C(3D)", [=](const ShapeSummary& s) {
                         const double paper = paper_constant(s.shape);
                         return ranged(s, constant, paper / 3, 3 * paper);
                       }));
    compare_dimensions(shapes, rows.back(), true, constant);
    const auto scatter = [&](const std::string& quantity,
                             const std::function<double(const Sample&)>& value) {
      rows.push_back(row(shapes, quantity, "one line", "< 20 %",
                         [=](const ShapeSummary& s) { return ranged(s, value, 0, 0.2); }));
    };
    scatter("17 scatter about that line", [=](const Sample& x) { return (x.*of).master.scatter; });
    scatter("17 scatter, with m_w + βm",
            [=](const Sample& x) { return (x.*of).master_share.measured_over_predicted.scatter; });
    rows.push_back(row(shapes, "17 that β", "1", "–", [=](const ShapeSummary& s) {
      return told(s, [=](const Sample& x) { return (x.*of).master_share.beta; });
    }));
  };
  displacement("", &Sample::whole);
  displacement(" of the way from where f falls below mg", &Sample::active);
}

/// Frequencies at which the packing loosened have no place in the fits; their number is told.
void tell_negative_rates(const Shapes& shapes, Row& r, CompactionLaws Sample::*of) {
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    std::size_t negative = 0;
    for (const Sample& sample : shapes[k].samples) negative += (sample.*of).negative;
    if (!r.cells[k].value.empty() && negative > 0)
      r.cells[k].value += "; without " + std::to_string(negative) + " where ρ fell";
  }
}

/// Row 18 of one rate over the frequency.
void judge_rate_law(const Shapes& shapes, Rows& rows, const std::string& which,
                    CompactionLaws Sample::*of) {
  const auto add = [&](const char* quantity, const char* paper, const char* accepted, double low,
                       double high, const std::function<double(const CompactionLaws&)>& value) {
    rows.push_back(
        row(shapes, "18 " + which + quantity, paper, accepted, [=](const ShapeSummary& s) {
          return ranged(
              s, [=](const Sample& x) { return value(x.*of); }, low, high);
        }));
  };
  add("ν_c [Hz], two branches", "10", "7–14; the branches fit better than one power law", 7, 14,
      [](const CompactionLaws& x) { return x.branches.nu_c; });
  Row& branches = rows.back();
  tell_negative_rates(shapes, branches, of);
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const Estimate gain = over_samples(shapes[k], [=](const Sample& x) {
      return (x.*of).scatter_about_law - (x.*of).branches.scatter;
    });
    if (branches.cells[k].holds && !(gain.mean > 0)) branches.cells[k].holds = false;
  }
  rows.push_back(row(
      shapes,
      "18 " + which + "rms of ln(rate) about the branches; about one power law; about one value",
      "–", "–", [=](const ShapeSummary& s) {
        const auto value = [&](const std::function<double(const CompactionLaws&)>& field) {
          return text_of(over_samples(s, [&](const Sample& x) { return field(x.*of); }).mean, 2);
        };
        const std::string first = value([](const CompactionLaws& x) { return x.branches.scatter; });
        if (first.empty()) return Cell{};
        return Cell{first + "; " +
                        value([](const CompactionLaws& x) { return x.scatter_about_law; }) + "; " +
                        value([](const CompactionLaws& x) { return x.scatter_about_one; }),
                    std::nullopt};
      }));
  add("slope below ν_c", "1", "1 ± 0.3, by four frequencies at least", 0.7, 1.3,
      [](const CompactionLaws& x) { return x.slopes.below.exponent; });
  add("slope above ν_c", "−1", "−1 ± 0.3, by four frequencies at least", -1.3, -0.7,
      [](const CompactionLaws& x) { return x.slopes.above.exponent; });
}

void judge_compaction(const Shapes& shapes, Rows& rows) {
  judge_rate_law(shapes, rows, "", &Sample::rate);
  const auto prefactor = [&](const char* quantity, CompactionFit CompactionLaws::*form) {
    rows.push_back(row(shapes, quantity, "0.005", "×2", [=](const ShapeSummary& s) {
      return ranged(
          s, [=](const Sample& x) { return (x.rate.*form).prefactor; }, 0.0025, 0.01);
    }));
  };
  prefactor("18 Δρ_max/ρ0, two branches", &CompactionLaws::branches);
  prefactor("18 Δρ_max/ρ0, single form", &CompactionLaws::single);
  rows.push_back(row(shapes, "18 ν_c [Hz], single form", "10", "–", [](const ShapeSummary& s) {
    return told(s, [](const Sample& x) { return x.rate.single.nu_c; });
  }));
  const auto over_frequency = [&](const char* quantity, const char* paper,
                                  const std::function<double(const Result&)>& value) {
    rows.push_back(row(shapes, quantity, paper, "–", [=](const ShapeSummary& s) {
      Cell cell;
      for (const double nu : {2.0, 5.0, 10.0, 20.0, 60.0}) {
        const Estimate e = over_samples(s, [=](const Sample& x) { return x.at(nu, value); });
        cell.value += (cell.value.empty() ? "" : "; ") + (e.samples > 0 ? text_of(e.mean, 2) : "–");
      }
      return cell;
    }));
  };
  over_frequency("18 1e4 Δρ_1/ρ0 per period at 2; 5; 10; 20; 60 Hz",
                 "50 below ν_c, falling as ν⁻² above",
                 [](const Result& r) { return 1e4 * r.compaction_per_period; });
  over_frequency("18 whole box, first second: rate at 2; 5; 10; 20; 60 Hz [1e-3/s]", "–",
                 [](const Result& r) { return 1e3 * r.early_rate(&Jam::rho_box); });
  judge_rate_law(shapes, rows, "whole box, first second: ", &Sample::early);
}

}  // namespace

std::vector<Row> judge(const std::vector<Result>& results,
                       const std::vector<ShapeSummary>& shapes) {
  Rows rows;
  judge_setting(results, shapes, rows);
  for (Row& r : rows) r.is_setting = true;
  judge_density(shapes, rows);
  judge_period(shapes, rows);
  rows.push_back(creep_row(shapes));
  judge_rate(shapes, rows);
  judge_scaling(shapes, rows);
  judge_constant(shapes, rows);
  judge_compaction(shapes, rows);
  return rows;
}

}  // namespace study
