// SPDX-License-Identifier: MIT
#include <box2d/box2d.h>

#include "engine.hpp"

namespace {

class Box2D {
 public:
  static constexpr const char* name = "Box2D";
  static constexpr int substeps = 4;

  explicit Box2D(const engines::Description& scene) {
    b2WorldDef def = b2DefaultWorldDef();
    def.gravity = {0, float(scene.gravity)};
    def.enableSleep = false;
    world_ = b2CreateWorld(&def);
    b2ShapeDef surface = b2DefaultShapeDef();
    surface.density = float(scene.density);
    surface.material.friction = float(scene.friction);
    for (const engines::Wall& wall : scene.walls) {
      b2BodyDef fixed = b2DefaultBodyDef();
      fixed.position = {float(wall.point[0] - wall.normal[0]),
                        float(wall.point[1] - wall.normal[1])};
      fixed.rotation = {float(wall.normal[1]), float(-wall.normal[0])};  // turns y to the normal
      const b2Polygon slab = b2MakeBox(250, 1);
      b2CreatePolygonShape(b2CreateBody(world_, &fixed), &surface, &slab);
    }
    std::vector<b2Polygon> polygons;
    for (std::size_t k = 0; k < scene.shapes.size(); ++k) {
      std::vector<b2Vec2> points;
      for (const auto& x : scene.shapes[k]) points.push_back({float(x[0]), float(x[1])});
      const auto half = scene.half_edges(k);
      const b2Hull hull = b2ComputeHull(points.data(), int(points.size()));
      if (hull.count == 0) throw std::runtime_error("a polygon was refused");
      polygons.push_back(half[0] > 0 ? b2MakeBox(float(half[0]), float(half[1]))
                                     : b2MakePolygon(&hull, 0));
    }
    for (const engines::Body& body : scene.bodies) {
      b2BodyDef moving = b2DefaultBodyDef();
      moving.type = b2_dynamicBody;
      moving.position = {float(body.position[0]), float(body.position[1])};
      moving.rotation = b2MakeRot(float(body.rotation[0]));
      bodies_.push_back(b2CreateBody(world_, &moving));
      b2CreatePolygonShape(bodies_.back(), &surface, &polygons[body.shape]);
    }
  }
  void start() { stages_ = {}; }
  void step(double h, int count) {
    b2World_Step(world_, float(h), count);
    const b2Profile profile = b2World_GetProfile(world_);
    stages_[0] += double(profile.pairs), stages_[1] += double(profile.collide);
    stages_[2] += double(profile.solve), stages_[3] += double(profile.step);
  }
  std::size_t pairs() const { return std::size_t(b2World_GetCounters(world_).contactCount); }
  std::string stages(int steps) const {
    char text[200];
    std::snprintf(text, sizeof text,
                  ", by the wall clock: broad phase %.3f, contacts %.3f, solver %.3f, step %.3f",
                  stages_[0] / steps, stages_[1] / steps, stages_[2] / steps, stages_[3] / steps);
    return text;
  }
  engines::Body body(std::size_t k) const {
    const b2WorldTransform pose = b2Body_GetTransform(bodies_[k]);
    return {0, {pose.p.x, pose.p.y, 0}, {double(b2Rot_GetAngle(pose.q)), 0, 0, 0}};
  }

 private:
  b2WorldId world_{};
  std::vector<b2BodyId> bodies_;
  std::array<double, 4> stages_{};
};

}  // namespace

int main(int argc, char** argv) {
  return engines::run<Box2D>(argc, argv);
}
