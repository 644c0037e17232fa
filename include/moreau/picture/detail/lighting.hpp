// SPDX-License-Identifier: MIT
// Shading of a scene under a sun and an overcast sky, with the edges of its surfaces drawn.
//
// The lights are parallel lights, each with its own depth buffer for the shadows: one sun, and many
// weak lights spread over the upper hemisphere. They represent the sky and leave the gaps between
// grains dark (ambient occlusion).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "moreau/picture/detail/scene.hpp"

namespace moreau::rendering {

class Lighting {
 public:
  /// @param center,radius of a ball around everything that casts shadows [m]
  Lighting(const Scene& scene, const Vector3f& center, float radius)
      : texel_(2 * radius / sky_pixels) {
    sun_.push_back(lamp(scene, center, radius, sun_direction(), 3 * sky_pixels));
    for (int i = 0; i < sky_lamps; ++i) {  // a spiral of equal areas over the hemisphere
      const float z = (static_cast<float>(i) + 0.5f) / sky_lamps;
      const float turn = static_cast<float>(i) * std::numbers::pi_v<float> * (3 - std::sqrt(5.0f));
      const float flat = std::sqrt(1 - z * z);
      sky_.push_back(lamp(scene, center, radius, {flat * std::cos(turn), flat * std::sin(turn), z},
                          sky_pixels));
    }
  }

  /// The light that a point with this normal receives; about 1 in the open, facing up.
  float at(const Vector3f& point, const Vector3f& normal) const {
    float sky = 0;
    const Vector3f raised = point + 1.5f * texel_ * normal;
    for (const Lamp& lamp : sky_) {
      const float slope = lamp.direction.dot(normal);
      if (slope > 0) sky += slope * lamp.depth.reaches(raised, texel_);
    }
    const float slope = std::max(0.0f, sun_[0].direction.dot(normal));
    const float sun = slope > 0 ? slope * sun_[0].depth.reaches(raised, texel_ / 2) : 0;
    const float ground = 0.5f - 0.5f * normal.z();
    return 0.66f * sky * (2.0f / sky_lamps) + 0.62f * sun + 0.12f * ground;
  }

 private:
  static constexpr int sky_lamps = 48, sky_pixels = 500;
  struct Lamp {
    Vector3f direction;  ///< towards the light
    DepthBuffer depth;
  };

  static Vector3f sun_direction() { return Vector3f(-0.25f, -0.55f, 0.8f).normalized(); }
  static Lamp lamp(const Scene& scene, const Vector3f& center, float radius,
                   const Vector3f& direction, int pixels) {
    const View view =
        View::towards(center + 2 * radius * direction, center,
                      static_cast<float>(pixels) / (2 * radius), true, pixels, pixels);
    return {direction, DepthBuffer(view, scene.triangles(), false)};
  }

  float texel_;
  std::vector<Lamp> sun_, sky_;
};

/// Paints the visible surfaces. The light is computed once for each triangle in a square of
/// `block` x `block` pixels.
inline void shade(const Scene& scene, const DepthBuffer& seen, const Lighting& light, int block,
                  Image& image) {
  const auto& triangles = scene.triangles();
  const auto paint_block = [&](int left, int top) {
    std::uint32_t known = DepthBuffer::nothing;
    Color color = Color::Zero();
    float opacity = 1;
    for (int row = top; row < std::min(top + block, image.height()); ++row)
      for (int column = left; column < std::min(left + block, image.width()); ++column) {
        const std::uint32_t t = seen.triangle(column, row);
        if (t == DepthBuffer::nothing) continue;
        if (t != known) {
          const Vector3f point = seen.point(column, row);
          const std::uint32_t object = triangles[t].object;
          opacity = scene.opacity(object, point);
          if (opacity > 0)
            color = light.at(point, triangles[t].normal_at(point)) * scene.color(object);
          known = t;
        }
        Color& pixel = image(column, row);
        pixel = (1 - opacity) * pixel + opacity * color;
      }
  };
  for (int top = 0; top < image.height(); top += block)
    for (int left = 0; left < image.width(); left += block) paint_block(left, top);
}

/// Draws edges, `width` pixels wide, where the visible surface changes: dark between objects, less
/// dark between faces of one object.
inline void draw_edges(const Scene& scene, const DepthBuffer& seen, int width, Image& image) {
  const auto& triangles = scene.triangles();
  const auto differ = [&](std::uint32_t a, std::uint32_t b) {
    if (a == b) return 0;
    const auto empty = [&](std::uint32_t t) {
      return t == DepthBuffer::nothing || scene.is_ground(triangles[t].object);
    };
    if (empty(a) && empty(b)) return 0;
    if (empty(a) || empty(b)) return 2;
    if (triangles[a].object != triangles[b].object) return 2;
    return triangles[a].face != triangles[b].face ? 1 : 0;
  };
  for (int row = 0; row + width < image.height(); ++row)
    for (int column = 0; column + width < image.width(); ++column) {
      const std::uint32_t here = seen.triangle(column, row);
      int edge = 0;
      for (int k = 1; k <= width; ++k)
        edge = std::max({edge, differ(here, seen.triangle(column + k, row)),
                         differ(here, seen.triangle(column, row + k))});
      if (edge > 0) image(column, row) *= edge == 2 ? 0.32f : 0.62f;
    }
}

}  // namespace moreau::rendering
