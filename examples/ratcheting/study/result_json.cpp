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

/// field(name, member) for every pair of arguments.
void each(const auto& field, const char* name, auto& member, auto&&... others) {
  field(name, member);
  if constexpr (sizeof...(others) > 0) each(field, others...);
}

// What each part is made of, named once for both directions.

void describe(Some<ratcheting::Period> auto& p, const auto& field) {
  each(field, "t_start", p.start, "t_finish", p.finish, "x_j", p.jam_before, "x_j_after",
       p.jam_after, "t_force_minimum", p.force_minimum, "dx_max", p.dx_max, "drift", p.active.drift,
       "dx_active", p.active.dx, "t_onset", p.active.onset, "t_peak", p.active.peak, "v_max_active",
       p.active.v_out, "v_max_passive", p.active.v_in, "t_v_max_passive", p.active.v_in_time,
       "f_g_active", p.active.thrust, "steady_thrust", p.active.carried.thrust, "carried_mass",
       p.active.carried.mass, "explained", p.active.carried.explained);
}

void describe(Some<Point> auto& p, const auto& field) {
  each(field, "x", p.x, "v", p.y);
}

void describe(Some<Facts> auto& f, const auto& field) {
  each(field, "versions", f.versions, "settled", f.settled, "vertices", f.vertices, "faces",
       f.faces, "circumradii", f.circumradii, "steps", f.steps, "capped_steps", f.capped_steps,
       "mean_sweeps", f.mean_sweeps, "worst_residual", f.worst_residual, "mean_overlap_over_d",
       f.mean_overlap, "max_overlap_over_d", f.max_overlap, "roll", f.roll, "roll_strength",
       f.roll_strength, "roll_agreement", f.roll_agreement);
}

void describe(Some<Jam> auto& j, const auto& field) {
  each(field, "t", j.t, "x", j.x, "rho_inner", j.rho_inner, "rho_box", j.rho_box);
}

void describe(Some<Behaviour> auto& b, const auto& field) {
  each(field, "early_share", b.early_share, "onset_lead", b.onset_lead, "passive_force",
       b.passive_force, "active_slope", b.active_slope, "passive_slope", b.passive_slope,
       "loop_work", b.loop_work, "jammed_xx", b.jammed_xx, "jammed_zz", b.jammed_zz, "active_xx",
       b.active_xx, "active_zz", b.active_zz, "roll", b.roll, "roll_strength", b.roll_strength,
       "rho_extension", b.rho_extension, "rho_contraction", b.rho_contraction, "box_extension",
       b.box_extension);
}

void describe(Some<Result> auto& r, const auto& field) {
  each(field, "facts", r.facts, "mass", r.mass, "wall_mass", r.wall_mass, "length", r.length,
       "height", r.height, "weight", r.weight, "dx_max", r.dx_max, "dx_spread", r.dx_spread,
       "v_max", r.v_max, "delay", r.delay, "dx_active", r.dx_active, "drift", r.drift, "thrust",
       r.thrust, "steady_thrust", r.steady_thrust, "carried_share", r.carried_share, "explained",
       r.explained, "rest_share", r.rest_share, "net_contraction", r.net_contraction, "contracting",
       r.contracting, "rho_initial", r.rho_initial, "rho_0", r.rho_0, "rho_final", r.rho_final,
       "rho_box_initial", r.box_initial, "rho_box_final", r.box_final, "rate", r.rate,
       "compaction_per_period", r.compaction_per_period, "C", r.constant, "behaviour", r.behaviour,
       "periods", r.periods, "jams", r.jams, "loop", r.loop, "tables", r.tables);
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
Json json_of(const Named<T>& values);
template <class T>
void read(const Json& json, std::optional<T>& value);
template <Described T>
void read(const Json& json, T& value);
template <Described T>
void read(const Json& json, std::vector<T>& rows);
void read(const Json& json, Named<Columns>& tables);

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
template <class T>
Json json_of(const Named<T>& values) {
  Json json = Json::object();
  for (const auto& [name, value] : values) json[name] = json_of(value);
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
    describe(rows[k], [&](const char* name, auto& member) {
      if (is_optional<std::remove_cvref_t<decltype(member)>> && !json.contains(name)) return;
      read(json.at(name).at(k), member);
    });
}
void read(const Json& json, Named<Columns>& tables) {
  require(json.is_object(), "no tables");
  for (const auto& [name, table] : json.items()) {
    require(table.is_object() && !table.empty(), "no columns");
    Columns& columns = tables.emplace_back(name, Columns()).second;
    for (const auto& [head, column] : table.items()) {
      std::vector<double>& values = columns.emplace_back(head, std::vector<double>()).second;
      for (const Json& value : column) read(value, values.emplace_back());
      require(values.size() == columns.front().second.size(), "columns differ in length");
    }
  }
}

}  // namespace

std::string json_line(const Result& r) {
  Json json{{"name", r.c.name}, {"parameters", ratcheting::to_json(r.c.parameters)}};
  json.update(json_of(r));
  return json.dump();
}

Result result_of(const Json& json, const Case& c) {
  Result r{};
  r.c = c;
  read(json, r);
  return r;
}

}  // namespace study
