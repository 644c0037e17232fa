// SPDX-License-Identifier: MIT
#include "make_scene.hpp"

#include <cstdio>
#include <string>

namespace testbed {

std::unique_ptr<AnyScene> make_scene(SceneKind kind, ShapeKind shape, const Settings& settings) {
  switch (shape) {
    case ShapeKind::polyhedron:
      return make_scene_of<moreau::Polyhedron<double>>(kind, settings);
    case ShapeKind::polygon:
      return make_scene_of<moreau::Polygon<double>>(kind, settings);
    case ShapeKind::ball:
      return make_scene_of<moreau::Ball<double>>(kind, settings);
    case ShapeKind::disk:
      return make_scene_of<moreau::Disk<double>>(kind, settings);
    case ShapeKind::concave_polyhedron:
      return make_scene_of<moreau::Compound<moreau::Polyhedron<double>>>(kind, settings);
    case ShapeKind::concave_polygon:
      return make_scene_of<moreau::Compound<moreau::Polygon<double>>>(kind, settings);
  }
  return nullptr;
}

namespace {

/// Writes objects of JSON; no text here has quotes or control characters.
class Json {
 public:
  Json& text(const char* key, const char* value) {
    begin(key);
    out_ += '"';
    out_ += value;
    out_ += '"';
    return *this;
  }
  Json& number(const char* key, double value) {
    begin(key);
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.17g", value);
    out_ += digits;
    return *this;
  }
  Json& open(const char* key, char bracket) {
    begin(key);
    out_ += bracket;
    return *this;
  }
  Json& close(char bracket) {
    out_ += bracket;
    return *this;
  }
  /// A list of objects, one for each entry of the range: write(entry) writes the members of its object.
  template <class Range, class Write>
  Json& list(const char* key, const Range& range, const Write& write) {
    open(key, '[');
    for (const auto& entry : range) {
      open("", '{');
      write(entry);
      close('}');
    }
    return close(']');
  }
  const std::string& str() const { return out_; }

 private:
  void begin(const char* key) {
    if (!out_.empty() && out_.back() != '[' && out_.back() != '{') out_ += ',';
    if (*key == '\0') return;
    out_ += '"';
    out_ += key;
    out_ += "\":";
  }
  std::string out_;
};

}  // namespace

std::string describe() {
  Json json;
  json.open("", '{').list("scenes", scenes, [&](const SceneEntry& scene) {
    json.text("key", scene.key)
        .text("label", scene.label)
        .text("tryThis", scene.try_this)
        .text("action", scene.action);
  });
  json.list("shapes", shapes, [&](const ShapeEntry& shape) {
    json.text("key", shape.key).text("label", shape.label).number("dimension", shape.dimension);
  });
  const Settings defaults;
  json.list("settings", setting_table, [&](const SettingEntry& entry) {
    json.text("key", entry.key)
        .text("label", entry.label)
        .text("unit", entry.unit)
        .text("help", entry.help)
        .number("value", defaults.*entry.value)
        .number("low", entry.low)
        .number("high", entry.high)
        .number("logarithmic", entry.logarithmic)
        .number("whole", entry.whole)
        .number("rebuilds", entry.rebuilds)
        .number("scenes", entry.scenes);
  });
  json.list("stages", stages, [&](const char* stage) { json.text("label", stage); });
  json.list("inSpace", space_defaults, [&](const SpaceDefault& entry) {
    json.text("key", entry.key).number("value", entry.value);
  });
  return json.close('}').str();
}

std::string describe(const AnyScene& scene) {
  Json json;
  json.open("", '{').list("channels", scene.channels(), [&](const Channel& channel) {
    json.text("key", channel.key)
        .text("label", channel.label)
        .text("unit", channel.unit)
        .number("factor", channel.factor);
  });
  json.list("plots", scene.plots(), [&](const PlotSpec& plot) {
    json.text("title", plot.title)
        .number("x", plot.x)
        .number("y", plot.y)
        .number("y2", plot.y2)
        .number("logarithmic", plot.logarithmic)
        .number("isPath", plot.is_path);
  });
  json.open("bounds", '[');
  for (const double x : scene.bounds()) json.number("", x);
  return json.close(']').close('}').str();
}

}  // namespace testbed
