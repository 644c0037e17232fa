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
  json.open("", '{').open("scenes", '[');
  for (const SceneEntry& scene : scenes)
    json.open("", '{')
        .text("key", scene.key)
        .text("label", scene.label)
        .text("tryThis", scene.try_this)
        .text("action", scene.action)
        .close('}');
  json.close(']').open("shapes", '[');
  for (const ShapeEntry& shape : shapes)
    json.open("", '{')
        .text("key", shape.key)
        .text("label", shape.label)
        .number("dimension", shape.dimension)
        .close('}');
  json.close(']').open("settings", '[');
  const Settings defaults;
  for (const SettingEntry& entry : setting_table)
    json.open("", '{')
        .text("key", entry.key)
        .text("label", entry.label)
        .text("unit", entry.unit)
        .text("help", entry.help)
        .number("value", defaults.*entry.value)
        .number("low", entry.low)
        .number("high", entry.high)
        .number("logarithmic", entry.logarithmic)
        .number("whole", entry.whole)
        .number("rebuilds", entry.rebuilds)
        .number("scenes", entry.scenes)
        .close('}');
  return json.close(']').close('}').str();
}

std::string describe(const AnyScene& scene) {
  Json json;
  json.open("", '{').open("channels", '[');
  for (const Channel& channel : scene.channels())
    json.open("", '{')
        .text("key", channel.key)
        .text("label", channel.label)
        .text("unit", channel.unit)
        .number("factor", channel.factor)
        .close('}');
  json.close(']').open("plots", '[');
  for (const PlotSpec& plot : scene.plots())
    json.open("", '{')
        .text("title", plot.title)
        .number("x", plot.x)
        .number("y", plot.y)
        .number("y2", plot.y2)
        .number("logarithmic", plot.logarithmic)
        .number("isPath", plot.is_path)
        .close('}');
  json.close(']').open("bounds", '[');
  for (const double x : scene.bounds()) json.number("", x);
  return json.close(']').close('}').str();
}

}  // namespace testbed
