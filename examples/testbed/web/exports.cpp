// SPDX-License-Identifier: MIT
// The scene as plain functions for WebAssembly. There is one scene. Functions that can fail return
// 1 if they did, and testbed_error() then has the text of the exception. Pointers are valid until
// the next call.
#include <array>
#include <cstddef>
#include <exception>
#include <malloc.h>
#include <memory>
#include <string>

#include "../make_scene.hpp"

#define TESTBED_EXPORT(name) extern "C" __attribute__((export_name(#name), used))

namespace {

std::unique_ptr<testbed::AnyScene> scene;
testbed::Settings settings;
std::string text, error;

/// Whether the function throws; the text of the exception is then in `error`.
template <class F>
int fails(const F& f) {
  try {
    f();
    return 0;
  } catch (const std::exception& thrown) {
    error = thrown.what();
  }
  return 1;
}
const testbed::Mesh& mesh(int k) {
  return scene->meshes()[static_cast<std::size_t>(k)];
}

}  // namespace

/// The tables of settings.hpp as JSON.
TESTBED_EXPORT(testbed_describe) const char* testbed_describe() {
  return (text = testbed::describe()).c_str();
}
/// Channels, plots and bounds of the scene as JSON.
TESTBED_EXPORT(testbed_describe_scene) const char* testbed_describe_scene() {
  return (text = testbed::describe(*scene)).c_str();
}
TESTBED_EXPORT(testbed_error) const char* testbed_error() {
  return error.c_str();
}

/// Replaces the scene by a new one. If it fails, the old one stays.
TESTBED_EXPORT(testbed_load) int testbed_load(int kind, int shape) {
  return fails([&] {
    scene = testbed::make_scene(testbed::SceneKind(kind), testbed::ShapeKind(shape), settings);
  });
}
/// Changes a setting, of a scene that exists at once. If it fails, the old value stays.
TESTBED_EXPORT(testbed_set) int testbed_set(int k, double value) {
  testbed::Settings changed = settings;
  changed.*testbed::setting_table[static_cast<std::size_t>(k)].value = value;
  return fails([&] {
    testbed::require_whole(changed);
    if (scene) scene->apply(changed);
    settings = changed;
  });
}
TESTBED_EXPORT(testbed_step) int testbed_step() {
  return fails([] { scene->step(); });
}
TESTBED_EXPORT(testbed_act) int testbed_act() {
  return fails([] { scene->act(); });
}
TESTBED_EXPORT(testbed_pull) int testbed_pull(int grain, double x, double y, double z) {
  return fails([&] { scene->pull(static_cast<std::size_t>(grain), {x, y, z}); });
}
TESTBED_EXPORT(testbed_release) void testbed_release() {
  scene->release();
}
TESTBED_EXPORT(testbed_throw) int testbed_throw(double x, double y, double z) {
  return fails([&] { scene->throw_grain({x, y, z}); });
}
TESTBED_EXPORT(testbed_add) int testbed_add() {
  return fails([] { scene->add(); });
}
TESTBED_EXPORT(testbed_remove) int testbed_remove(int grain) {
  return fails([&] { scene->remove(static_cast<std::size_t>(grain)); });
}
/// Fills the buffers of the frame.
TESTBED_EXPORT(testbed_frame) int testbed_frame() {
  return fails([] { scene->write_frame(); });
}

/// The buffers: poses, colours, walls, segments (view.hpp has their widths).
TESTBED_EXPORT(testbed_buffer) const float* testbed_buffer(int k) {
  const testbed::Frame& frame = scene->frame();
  const testbed::Floats* all[] = {&frame.poses, &frame.colours, &frame.walls, &frame.segments};
  return all[k]->data();
}
TESTBED_EXPORT(testbed_buffer_size) std::size_t testbed_buffer_size(int k) {
  const testbed::Frame& frame = scene->frame();
  const testbed::Floats* all[] = {&frame.poses, &frame.colours, &frame.walls, &frame.segments};
  return all[k]->size();
}
TESTBED_EXPORT(testbed_samples) const double* testbed_samples() {
  return scene->samples().data();
}
TESTBED_EXPORT(testbed_samples_size) std::size_t testbed_samples_size() {
  return scene->samples().size();
}
TESTBED_EXPORT(testbed_clear_samples) void testbed_clear_samples() {
  scene->clear_samples();
}

TESTBED_EXPORT(testbed_mesh_count) std::size_t testbed_mesh_count() {
  return scene->meshes().size();
}
TESTBED_EXPORT(testbed_mesh_is_round) int testbed_mesh_is_round(int k) {
  return mesh(k).is_round;
}
TESTBED_EXPORT(testbed_triangles) const float* testbed_triangles(int k) {
  return mesh(k).triangles.data();
}
TESTBED_EXPORT(testbed_triangles_size) std::size_t testbed_triangles_size(int k) {
  return mesh(k).triangles.size();
}
TESTBED_EXPORT(testbed_outline) const float* testbed_outline(int k) {
  return mesh(k).outline.data();
}
TESTBED_EXPORT(testbed_outline_size) std::size_t testbed_outline_size(int k) {
  return mesh(k).outline.size();
}
/// Placements: mesh (unsigned 32 bits) and scale (float) of each grain, alternating.
TESTBED_EXPORT(testbed_placements) const testbed::Placement* testbed_placements() {
  return scene->placements().data();
}
TESTBED_EXPORT(testbed_grain_count) std::size_t testbed_grain_count() {
  return scene->placements().size();
}

TESTBED_EXPORT(testbed_ground) const float* testbed_ground() {
  return scene->ground().data();
}
TESTBED_EXPORT(testbed_ground_size) std::size_t testbed_ground_size() {
  return scene->ground().size();
}

/// Time of stage k of the last step [ms].
TESTBED_EXPORT(testbed_ms) double testbed_ms(int k) {
  return scene->status().ms[static_cast<std::size_t>(k)];
}
TESTBED_EXPORT(testbed_version) std::size_t testbed_version() {
  return scene->status().version;
}
TESTBED_EXPORT(testbed_hash) const char* testbed_hash() {
  return scene->status().hash.c_str();
}
TESTBED_EXPORT(testbed_time) double testbed_time() {
  return scene->status().time;
}
TESTBED_EXPORT(testbed_points) std::size_t testbed_points() {
  return scene->status().points;
}
TESTBED_EXPORT(testbed_capped) std::size_t testbed_capped() {
  return scene->status().capped;
}
TESTBED_EXPORT(testbed_stage) const char* testbed_stage() {
  return scene->status().stage.c_str();
}
TESTBED_EXPORT(testbed_advice) const char* testbed_advice() {
  return scene->status().advice.c_str();
}
TESTBED_EXPORT(testbed_fault) const char* testbed_fault() {
  return scene->status().fault.c_str();
}
/// Of the grains [kg].
TESTBED_EXPORT(testbed_mass) double testbed_mass() {
  return scene->status().mass;
}
TESTBED_EXPORT(testbed_paths_from) double testbed_paths_from() {
  return scene->status().paths_from;
}
/// The bounds of the picture, which a scene can change: lower, upper [m].
TESTBED_EXPORT(testbed_bound) double testbed_bound(int k) {
  return scene->bounds()[static_cast<std::size_t>(k)];
}
TESTBED_EXPORT(testbed_can_act) int testbed_can_act() {
  return scene->status().can_act;
}
/// The force of the hand [N].
TESTBED_EXPORT(testbed_hand) double testbed_hand() {
  return scene->status().hand;
}
/// Bytes that the program has allocated.
TESTBED_EXPORT(testbed_heap_used) double testbed_heap_used() {
  return double(mallinfo().uordblks);
}
