// SPDX-License-Identifier: MIT
#include "result_json.hpp"

#include <concepts>
#include <limits>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace study {

namespace {

using ratcheting::Json;

template <class T, class Of>
concept Some = std::same_as<std::remove_const_t<T>, Of>;

// What each part is made of, named once for both directions.

void describe(Some<ratcheting::Period> auto& p, const auto& field) {
  field("t_start", p.start);
  field("t_finish", p.finish);
  field("x_j", p.jam_before);
  field("x_j_after", p.jam_after);
  field("t_force_minimum", p.force_minimum);
  field("dx_max", p.dx_max);
  field("creep", p.active.creep);
  field("dx_active", p.active.dx);
  field("t_onset", p.active.onset);
  field("t_peak", p.active.peak);
  field("v_max_active", p.active.v_out);
  field("v_max_passive", p.active.v_in);
  field("f_g_active", p.active.thrust);
  field("steady_thrust", p.active.carried.thrust);
  field("carried_mass", p.active.carried.mass);
  field("explained", p.active.carried.explained);
}

void describe(Some<Point> auto& p, const auto& field) {
  field("x", p.x);
  field("v", p.y);
}

void describe(Some<Facts> auto& f, const auto& field) {
  field("versions", f.versions);
  field("settled", f.settled);
  field("vertices", f.vertices);
  field("faces", f.faces);
  field("circumradii", f.circumradii);
  field("steps", f.steps);
  field("capped_steps", f.capped_steps);
  field("mean_sweeps", f.mean_sweeps);
  field("worst_residual", f.worst_residual);
  field("mean_overlap_over_d", f.mean_overlap);
  field("max_overlap_over_d", f.max_overlap);
  field("roll", f.roll);
  field("roll_strength", f.roll_strength);
  field("roll_agreement", f.roll_agreement);
}

void describe(Some<Jam> auto& j, const auto& field) {
  field("t", j.t);
  field("x", j.x);
  field("rho_inner", j.rho_inner);
  field("rho_box", j.rho_box);
}

void describe(Some<Behaviour> auto& b, const auto& field) {
  field("early_share", b.early_share);
  field("onset_lead", b.onset_lead);
  field("passive_force", b.passive_force);
  field("active_slope", b.active_slope);
  field("passive_slope", b.passive_slope);
  field("loop_work", b.loop_work);
  field("jammed_xx", b.jammed_xx);
  field("jammed_zz", b.jammed_zz);
  field("active_xx", b.active_xx);
  field("active_zz", b.active_zz);
  field("roll", b.roll);
  field("roll_strength", b.roll_strength);
  field("rho_extension", b.rho_extension);
  field("rho_contraction", b.rho_contraction);
  field("box_extension", b.box_extension);
}

void describe(Some<Result> auto& r, const auto& field) {
  field("facts", r.facts);
  field("mass", r.mass);
  field("wall_mass", r.wall_mass);
  field("length", r.length);
  field("height", r.height);
  field("weight", r.weight);
  field("dx_max", r.dx_max);
  field("dx_spread", r.dx_spread);
  field("v_max", r.v_max);
  field("delay", r.delay);
  field("dx_active", r.dx_active);
  field("creep", r.creep);
  field("thrust", r.thrust);
  field("steady_thrust", r.steady_thrust);
  field("carried_share", r.carried_share);
  field("explained", r.explained);
  field("rest_share", r.rest_share);
  field("net_contraction", r.net_contraction);
  field("contracting", r.contracting);
  field("rho_initial", r.rho_initial);
  field("rho_0", r.rho_0);
  field("rho_final", r.rho_final);
  field("rho_box_initial", r.box_initial);
  field("rho_box_final", r.box_final);
  field("rate", r.rate);
  field("compaction_per_period", r.compaction_per_period);
  field("C", r.constant);
  field("behaviour", r.behaviour);
  field("periods", r.periods);
  field("jams", r.jams);
  field("loop", r.loop);
}

template <class T>
concept Described = requires(T& value) {
  describe(value, [](const char*, auto&) {});
};

// Ahead of their bodies, for parts are made of parts.
template <class T>
Json json_of(const std::optional<T>& value);
template <Described T>
Json json_of(const T& value);
template <Described T>
Json json_of(const std::vector<T>& rows);
template <class T>
void read(const Json& json, std::optional<T>& value);
template <Described T>
void read(const Json& json, T& value);
template <Described T>
void read(const Json& json, std::vector<T>& rows);

template <class T>
Json json_of(const T& value) {
  return value;  // JSON has no nan: it is written as null
}
template <class T>
Json json_of(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}
template <Described T>
Json json_of(const T& value) {
  Json json = Json::object();
  describe(value, [&](const char* name, const auto& member) { json[name] = json_of(member); });
  return json;
}
/// Column by column.
template <Described T>
Json json_of(const std::vector<T>& rows) {
  Json json = Json::object();
  for (const T& row : rows)
    describe(row,
             [&](const char* name, const auto& member) { json[name].push_back(json_of(member)); });
  return json;
}

void require(bool holds, const char* what) {
  if (!holds) throw std::runtime_error(what);
}

template <class T>
void read(const Json& json, T& value) {
  value = json.get<T>();
}
void read(const Json& json, double& value) {
  require(json.is_null() || json.is_number(), "no number");
  value = json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}
void read(const Json& json, std::size_t& value) {
  require(json.is_number_unsigned(), "no count");
  value = json.get<std::size_t>();
}
template <class T>
void read(const Json& json, std::optional<T>& value) {
  if (!json.is_null()) value = json.get<T>();
}
template <class T>
constexpr bool is_optional = false;
template <class T>
constexpr bool is_optional<std::optional<T>> = true;
template <Described T>
void read(const Json& json, T& value) {
  describe(value, [&](const char* name, auto& member) {
    try {
      if (is_optional<std::remove_cvref_t<decltype(member)>> && !json.contains(name)) return;
      read(json.at(name), member);
    } catch (const std::exception& error) {
      throw std::runtime_error(std::string(name) + ": " + error.what());
    }
  });
}
template <Described T>
void read(const Json& json, std::vector<T>& rows) {
  require(json.is_object(), "no columns");
  rows.resize(json.empty() ? 0 : json.begin()->size());
  for (const Json& column : json) require(column.size() == rows.size(), "columns differ in length");
  for (std::size_t k = 0; k < rows.size(); ++k)
    describe(rows[k], [&](const char* name, auto& member) { read(json.at(name).at(k), member); });
}

}  // namespace

std::string json_text(const Result& r) {
  Json json = json_of(r);
  std::string text = "{\n\"parameters\": " + ratcheting::to_json(r.c.parameters).dump();
  for (const auto& [name, value] : json.items()) text += ",\n\"" + name + "\": " + value.dump();
  return text + "\n}\n";
}

Result result_of(const Json& json, const Case& c) {
  Result r{};
  r.c = c;
  read(json, r);
  return r;
}

}  // namespace study
