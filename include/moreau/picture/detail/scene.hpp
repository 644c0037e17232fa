// SPDX-License-Identifier: MIT
// Grains and the ground in space, as triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "moreau/core/pose.hpp"
#include "moreau/picture/detail/rasterizer.hpp"
#include "moreau/picture/image.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/one_of.hpp"

namespace moreau::rendering {

/// The objects of a picture.
class Scene {
 public:
  /// @param grains their number: the more there are, the fewer triangles has a round one
  explicit Scene(std::size_t grains) {
    while (meridians_ > 8 && grains * std::size_t(meridians_ * meridians_) > most_triangles)
      meridians_ /= 2;
  }
  /// Adds a grain of any shape.
  template <GrainShape Shape>
  void add_grain(const Shape& shape, const Pose<SpaceOf<Shape>>& pose, const Color& color) {
    faces_ = 0;
    add_surface(shape, pose);
    colors_.push_back(color);
  }

  /// Adds the ground: a square at the height of `middle` that fades into the background between the
  /// distances `radius` and 2 `radius` [m] from it.
  void add_ground(const Vector3f& middle, float radius, const Color& color) {
    const float reach = 2 * radius;
    const Vector3f n = Vector3f::UnitZ();
    const auto corner = [&](float x, float y) -> Vector3f {
      return middle + reach * Vector3f(x, y, 0);
    };
    triangles_.push_back({{corner(-1, -1), corner(1, -1), corner(1, 1)}, {n, n, n}, object(), 0});
    triangles_.push_back({{corner(-1, -1), corner(1, 1), corner(-1, 1)}, {n, n, n}, object(), 0});
    ground_ = {object(), middle, radius};
    colors_.push_back(color);
  }
  /// Opacity of an object at a point: 1, except for the ground.
  float opacity(std::uint32_t object, const Vector3f& point) const {
    if (object != ground_.object) return 1;
    const float way = (point - ground_.middle).norm() / ground_.radius;
    const float share = std::clamp(way - 1, 0.0f, 1.0f);
    return 1 - share * share * (3 - 2 * share);
  }
  bool is_ground(std::uint32_t object) const { return object == ground_.object; }

  const std::vector<Triangle>& triangles() const { return triangles_; }
  const Color& color(std::uint32_t object) const { return colors_[object]; }

 private:
  std::uint32_t object() const { return static_cast<std::uint32_t>(colors_.size()); }

  /// A polyhedron of any scalar type.
  template <Polytope Shape>
  void add_surface(const Shape& shape, const Pose<SpaceOf<Shape>>& pose) {
    std::vector<Vector3f> corner;
    for (Eigen::Index i = 0; i < shape.vertices().rows(); ++i)
      corner.push_back(pose(shape.vertices().row(i).transpose()).template cast<float>());
    for (std::uint32_t f = 0; f < shape.face_count(); ++f) {
      const auto face = shape.face(f);
      const Vector3f normal =
          (pose.rotation * shape.face_normals().row(f).transpose()).template cast<float>();
      for (std::size_t k = 1; k + 1 < face.size(); ++k)
        triangles_.push_back({{corner[face[0]], corner[face[k]], corner[face[k + 1]]},
                              {normal, normal, normal},
                              object(),
                              faces_});
      ++faces_;
    }
  }

  /// A round body, by its support function.
  template <ConvexShape Shape>
  requires(!Polytope<Shape>) void add_surface(const Shape& shape,
                                              const Pose<SpaceOf<Shape>>& pose) {
    using Vector = typename Shape::Vector;
    const int meridians = meridians_, parallels = meridians_ / 2;
    const auto corner = [&](int i, int j) -> std::array<Vector3f, 2> {
      const float phi =
          2 * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(meridians);
      const float theta =
          std::numbers::pi_v<float> * static_cast<float>(j) / static_cast<float>(parallels);
      const Vector3f n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                       std::cos(theta));
      const Vector direction = n.cast<typename Shape::Space::Scalar>();
      return {pose(shape.support(direction)).template cast<float>(),
              (pose.rotation * direction).template cast<float>()};
    };
    const auto add = [&](const auto& a, const auto& b, const auto& c) {
      triangles_.push_back({{a[0], b[0], c[0]}, {a[1], b[1], c[1]}, object(), faces_});
    };
    for (int i = 0; i < meridians; ++i)
      for (int j = 0; j < parallels; ++j) {
        if (j > 0) add(corner(i, j), corner(i, j + 1), corner(i + 1, j));
        if (j + 1 < parallels) add(corner(i + 1, j), corner(i, j + 1), corner(i + 1, j + 1));
      }
    ++faces_;
  }

  /// The shape that a OneOf holds.
  template <class... Shapes>
  void add_surface(const OneOf<Shapes...>& shape, const Pose<SpaceOf<OneOf<Shapes...>>>& pose) {
    shape.visit([&](const auto& held) { add_surface(held, pose); });
  }

  /// All parts of a compound grain.
  template <CompoundShape Shape>
  void add_surface(const Shape& shape, const Pose<SpaceOf<Shape>>& pose) {
    for (const auto& part : shape.parts()) add_surface(part.shape, pose * part.pose);
  }

  struct Ground {
    std::uint32_t object = 0xFFFFFFFFu;
    Vector3f middle = Vector3f::Zero();
    float radius = 1;
  };

  /// A triangle takes 88 bytes, and each lamp visits all of them.
  static constexpr std::size_t most_triangles = 4'000'000;
  int meridians_ = 32;  // of a round grain

  std::vector<Triangle> triangles_;
  Ground ground_;
  std::vector<Color> colors_;
  std::uint32_t faces_ = 0;  // of the grain that is being added
};

}  // namespace moreau::rendering
