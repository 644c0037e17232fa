// SPDX-License-Identifier: MIT
#include <box3d/box3d.h>

#include "engine.hpp"

namespace {

class Box3D {
 public:
  static constexpr const char* name = "Box3D";
  static constexpr int substeps = 4;

  explicit Box3D(const engines::Description& scene) {
    b3WorldDef def = b3DefaultWorldDef();
    def.gravity = {0, 0, float(scene.gravity)};
    def.enableSleep = false;
    world_ = b3CreateWorld(&def);
    b3ShapeDef surface = b3DefaultShapeDef();
    surface.density = float(scene.density);
    surface.baseMaterial.friction = float(scene.friction);
    for (const engines::Wall& wall : scene.walls) {
      if (wall.normal[2] < 1) throw std::runtime_error("only a floor is known in space");
      b3BodyDef fixed = b3DefaultBodyDef();
      fixed.position = {float(wall.point[0]), float(wall.point[1]), float(wall.point[2] - 1)};
      const b3BoxHull floor = b3MakeBoxHull(250, 250, 1);
      b3CreateHullShape(b3CreateBody(world_, &fixed), &surface, &floor.base);
    }
    std::vector<b3HullData*> hulls;
    std::vector<b3BoxHull> boxes(scene.shapes.size());
    for (std::size_t k = 0; k < scene.shapes.size(); ++k) {
      std::vector<b3Vec3> points;
      for (const auto& x : scene.shapes[k])
        points.push_back({float(x[0]), float(x[1]), float(x[2])});
      const auto half = scene.half_edges(k);
      boxes[k] =
          half[0] > 0 ? b3MakeBoxHull(float(half[0]), float(half[1]), float(half[2])) : b3BoxHull{};
      hulls.push_back(half[0] > 0
                          ? &boxes[k].base
                          : b3CreateHull(points.data(), int(points.size()), int(points.size())));
      if (hulls.back() == nullptr) throw std::runtime_error("a hull was refused");
    }
    for (const engines::Body& body : scene.bodies) {
      b3BodyDef moving = b3DefaultBodyDef();
      moving.type = b3_dynamicBody;
      moving.position = {float(body.position[0]), float(body.position[1]), float(body.position[2])};
      const auto& q = body.rotation;
      moving.rotation = b3NormalizeQuat({{float(q[0]), float(q[1]), float(q[2])}, float(q[3])});
      bodies_.push_back(b3CreateBody(world_, &moving));
      b3CreateHullShape(bodies_.back(), &surface, hulls[body.shape]);
    }
  }
  void start() { stages_ = {}; }
  void step(double h, int count) {
    b3World_Step(world_, float(h), count);
    const b3Profile profile = b3World_GetProfile(world_);
    stages_[0] += double(profile.pairs), stages_[1] += double(profile.collide);
    stages_[2] += double(profile.solve), stages_[3] += double(profile.step);
    recycled_ = b3World_GetCounters(world_).recycledContactCount;
  }
  std::size_t pairs() const { return std::size_t(b3World_GetCounters(world_).contactCount); }
  std::string stages(int steps) const {
    char text[200];
    std::snprintf(text, sizeof text,
                  ", by the wall clock: broad phase %.3f, contacts %.3f, solver %.3f, step %.3f; "
                  "recycled pairs in the last step %d",
                  stages_[0] / steps, stages_[1] / steps, stages_[2] / steps, stages_[3] / steps,
                  recycled_);
    return text;
  }
  engines::Body body(std::size_t k) const {
    const b3WorldTransform pose = b3Body_GetTransform(bodies_[k]);
    return {0, {pose.p.x, pose.p.y, pose.p.z}, {pose.q.v.x, pose.q.v.y, pose.q.v.z, pose.q.s}};
  }

 private:
  b3WorldId world_{};
  std::vector<b3BodyId> bodies_;
  std::array<double, 4> stages_{};
  int recycled_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  return engines::run<Box3D>(argc, argv);
}
