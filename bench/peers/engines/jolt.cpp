// SPDX-License-Identifier: MIT
// clang-format off
#include <Jolt/Jolt.h>  // before all else of Jolt
#include <Jolt/Core/Factory.h>
#include <Jolt/Core/JobSystemSingleThreaded.h>
#include <Jolt/Core/TempAllocator.h>
#include <Jolt/Physics/Body/BodyCreationSettings.h>
#include <Jolt/Physics/Collision/BroadPhase/BroadPhaseLayerInterfaceTable.h>
#include <Jolt/Physics/Collision/BroadPhase/ObjectVsBroadPhaseLayerFilterTable.h>
#include <Jolt/Physics/Collision/ObjectLayerPairFilterTable.h>
#include <Jolt/Physics/Collision/Shape/BoxShape.h>
#include <Jolt/Physics/Collision/Shape/ConvexHullShape.h>
#include <Jolt/Physics/PhysicsSystem.h>
#include <Jolt/RegisterTypes.h>
// clang-format on

#include <memory>

#include "engine.hpp"

namespace {

enum : JPH::ObjectLayer { fixed_layer, moving_layer };

class Jolt {
 public:
  static constexpr const char* name = "Jolt";
  static constexpr int substeps = 1;  // its steps have 10 + 2 iterations

  explicit Jolt(const engines::Description& scene)
      : memory_(64 << 20), jobs_(JPH::cMaxPhysicsJobs), layers_(2, 2), pairs_(2) {
    pairs_.EnableCollision(fixed_layer, moving_layer);
    pairs_.EnableCollision(moving_layer, moving_layer);
    layers_.MapObjectToBroadPhaseLayer(fixed_layer, JPH::BroadPhaseLayer(0));
    layers_.MapObjectToBroadPhaseLayer(moving_layer, JPH::BroadPhaseLayer(1));
    filter_ = std::make_unique<JPH::ObjectVsBroadPhaseLayerFilterTable>(layers_, 2, pairs_, 2);
    const auto count = JPH::uint(scene.bodies.size());
    world_.Init(count + 16, 0, 32 * count + 1024, 16 * count + 1024, layers_, *filter_, pairs_);
    world_.SetGravity(JPH::Vec3(0, 0, float(scene.gravity)));
    auto& bodies = world_.GetBodyInterface();
    for (const engines::Wall& wall : scene.walls) {
      if (wall.normal[2] < 1) throw std::runtime_error("only a floor is known in space");
      JPH::BodyCreationSettings fixed(
          new JPH::BoxShape(JPH::Vec3(250, 250, 1)),
          JPH::RVec3(float(wall.point[0]), float(wall.point[1]), float(wall.point[2] - 1)),
          JPH::Quat::sIdentity(), JPH::EMotionType::Static, fixed_layer);
      fixed.mFriction = float(scene.friction);
      bodies.CreateAndAddBody(fixed, JPH::EActivation::DontActivate);
    }
    std::vector<JPH::ShapeRefC> shapes;
    for (std::size_t k = 0; k < scene.shapes.size(); ++k) {
      const auto half = scene.half_edges(k);
      if (half[0] > 0) {
        auto* box = new JPH::BoxShape(JPH::Vec3(float(half[0]), float(half[1]), float(half[2])));
        box->SetDensity(float(scene.density));
        shapes.emplace_back(box);
        continue;
      }
      JPH::Array<JPH::Vec3> points;
      for (const auto& x : scene.shapes[k])
        points.push_back(JPH::Vec3(float(x[0]), float(x[1]), float(x[2])));
      JPH::ConvexHullShapeSettings hull(points);
      hull.SetDensity(float(scene.density));
      const auto made = hull.Create();
      if (made.HasError()) throw std::runtime_error(made.GetError().c_str());
      shapes.push_back(made.Get());
    }
    for (const engines::Body& body : scene.bodies) {
      const auto& q = body.rotation;
      JPH::BodyCreationSettings moving(
          shapes[body.shape],
          JPH::RVec3(float(body.position[0]), float(body.position[1]), float(body.position[2])),
          JPH::Quat(float(q[0]), float(q[1]), float(q[2]), float(q[3])).Normalized(),
          JPH::EMotionType::Dynamic, moving_layer);
      moving.mFriction = float(scene.friction);
      moving.mAllowSleeping = false;
      ids_.push_back(bodies.CreateAndAddBody(moving, JPH::EActivation::Activate));
    }
    world_.OptimizeBroadPhase();
  }
  void start() {}
  void step(double h, int count) {
    if (world_.Update(float(h), count, &memory_, &jobs_) != JPH::EPhysicsUpdateError::None)
      throw std::runtime_error("a buffer is full");
  }
  /// Jolt does not count them.
  std::size_t pairs() const { return 0; }
  std::string stages(int) const { return ""; }
  engines::Body body(std::size_t k) {
    JPH::RVec3 x;
    JPH::Quat q;
    world_.GetBodyInterface().GetPositionAndRotation(ids_[k], x, q);
    return {0, {x.GetX(), x.GetY(), x.GetZ()}, {q.GetX(), q.GetY(), q.GetZ(), q.GetW()}};
  }

 private:
  /// Before all else of Jolt.
  struct Library {
    Library() {
      JPH::RegisterDefaultAllocator();
      JPH::Factory::sInstance = new JPH::Factory();
      JPH::RegisterTypes();
    }
  } library_;
  JPH::TempAllocatorImplWithMallocFallback memory_;
  JPH::JobSystemSingleThreaded jobs_;
  JPH::BroadPhaseLayerInterfaceTable layers_;
  JPH::ObjectLayerPairFilterTable pairs_;
  std::unique_ptr<JPH::ObjectVsBroadPhaseLayerFilterTable> filter_;
  JPH::PhysicsSystem world_;
  std::vector<JPH::BodyID> ids_;
};

}  // namespace

int main(int argc, char** argv) {
  return engines::run<Jolt>(argc, argv);
}
