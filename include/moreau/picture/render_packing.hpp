// SPDX-License-Identifier: MIT
// Pictures of grains in a box and of their force chains: in space a rendered scene, in the plane a
// drawing. World axes: x to the right, the last axis up. The moving wall is at the upper end of x.
// write_picture.hpp draws a whole simulation in one call.
//
// It needs libpng (CMake: moreau::picture; else -lpng). With the macro MOREAU_WITHOUT_PNG, which
// must then be defined in all files of a program, it needs nothing and writes no pictures.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "moreau/core/aabb.hpp"
#include "moreau/measure/force_chains.hpp"
#include "moreau/mesh/surface_mesh.hpp"
#include "moreau/picture/detail/drawing.hpp"
#include "moreau/picture/detail/lighting.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/one_of.hpp"

namespace moreau::rendering {

/// Colours of stone, from small (share 0) to large grains (1). They vary a little with the number
/// of the grain, so that neighbours can be distinguished.
inline Color stone_color(double share, std::size_t id) {
  static const std::array<Color, 3> stones = {screen_color(0xD3C1A5), screen_color(0xA9AEB4),
                                              screen_color(0x9A7A66)};
  const double at = std::clamp(share, 0.0, 1.0) * 2;
  const auto low = std::min<std::size_t>(1, static_cast<std::size_t>(at));
  const auto weight = static_cast<float>(at - double(low));
  const auto mixed = static_cast<std::uint32_t>(id) * 0x9E3779B1u;
  const float shade = 0.85f + 0.3f * static_cast<float>(mixed >> 8 & 0xFFFFu) / 65535.0f;
  return shade * ((1 - weight) * stones[low] + weight * stones[low + 1]);
}

/// Colours of speeds, from dark blue (share 0) over green to yellow (1).
inline Color speed_color(double share) {
  static const std::array<Color, 5> stops = {screen_color(0x440154), screen_color(0x3B528B),
                                             screen_color(0x21918C), screen_color(0x5EC962),
                                             screen_color(0xFDE725)};
  const double at = std::clamp(share, 0.0, 1.0) * 4;
  const auto low = std::min<std::size_t>(3, static_cast<std::size_t>(at));
  const auto weight = static_cast<float>(at - double(low));
  return (1 - weight) * stops[low] + weight * stops[low + 1];
}

/// Size and point of view of a picture.
struct Picture {
  int width = 1200;       ///< [pixels]
  int height = 1000;      ///< [pixels]
  double azimuth = 32;    ///< of the eye; at 0 it looks along +y, at 90 along -x [degrees]
  double elevation = 22;  ///< of the eye above the middle of the box [degrees]
  bool walls = true;      ///< whether the box or the walls are drawn
};

namespace detail {

constexpr int oversampling = 2;

inline Vector3f corner_of(const Aabb<Space<3>>& box, int bits) {
  Vector3f x;
  for (int k = 0; k < 3; ++k)
    x[k] = static_cast<float>((bits >> k & 1) != 0 ? box.upper[k] : box.lower[k]);
  return x;
}

/// A perspective view that shows the whole box.
inline View view_of(const Aabb<Space<3>>& box, const Picture& picture) {
  const float degree = std::numbers::pi_v<float> / 180;
  const float a = degree * static_cast<float>(picture.azimuth);
  const float e = degree * static_cast<float>(picture.elevation);
  const Vector3f middle = ((box.lower + box.upper) / 2).cast<float>();
  const auto size = static_cast<float>((box.upper - box.lower).norm());
  const Vector3f direction(std::sin(a) * std::cos(e), -std::cos(a) * std::cos(e), std::sin(e));
  const int width = oversampling * picture.width, height = oversampling * picture.height;
  View view = View::towards(middle + 2.6f * size * direction, middle, 1, false, width, height);
  Eigen::Vector2f reach(0, 0);
  for (int bits = 0; bits < 8; ++bits) {
    const Vector3f screen = view(corner_of(box, bits));
    reach = reach.cwiseMax(Eigen::Vector2f(std::abs(screen.x() - 0.5f * float(width)),
                                           std::abs(screen.y() - 0.5f * float(height))));
  }
  view.focal = 0.43f * std::min(float(width) / reach.x(), float(height) / reach.y());
  return view;
}

/// Blends the colour of a triangle with the pixels behind it.
inline void tint(const std::array<Vector3f, 3>& screen, const DepthBuffer& seen, const Color& color,
                 float opacity, Image& image) {
  const Vector3f near(screen[0].z(), screen[1].z(), screen[2].z());
  for_each_pixel(screen, image.width(), image.height(),
                 [&](int column, int row, const Vector3f& b) {
                   if (b.dot(near) < 0.999f * seen.nearness(column, row)) return;
                   Color& pixel = image(column, row);
                   pixel = (1 - opacity) * pixel + opacity * color;
                 });
}

/// Draws the visible part of a segment between two points of the world, `width` pixels of `image`
/// wide.
inline void draw_line(const Vector3f& from, const Vector3f& to, float width,
                      const DepthBuffer& seen, const Color& color, Image& image) {
  const Vector3f a = seen.view()(from), b = seen.view()(to);
  Vector3f side(a.y() - b.y(), b.x() - a.x(), 0);
  if (side.norm() == 0) return;
  side *= width / 2 / side.norm();
  tint({a + side, b + side, b - side}, seen, color, 1, image);
  tint({a + side, b - side, a - side}, seen, color, 1, image);
}

/// Draws the edges of the box and tints the moving wall.
inline void draw_box(const Aabb<Space<3>>& box, const DepthBuffer& seen, Image& image) {
  const Color wall = screen_color(0x2F6FB0), frame = screen_color(0x4A4F57);
  const auto plate = [&](int a, int b, int c) {
    tint({seen.view()(corner_of(box, a)), seen.view()(corner_of(box, b)),
          seen.view()(corner_of(box, c))},
         seen, wall, 0.10f, image);
  };
  plate(1, 3, 7);
  plate(1, 7, 5);
  for (int bits = 0; bits < 8; ++bits)
    for (int k = 0; k < 3; ++k) {
      if ((bits >> k & 1) != 0) continue;
      const bool moving = (bits & 1) != 0;
      draw_line(corner_of(box, bits), corner_of(box, bits | 1 << k),
                (moving ? 2.5f : 1.5f) * oversampling, seen, moving ? wall : frame, image);
    }
}

/// The first and the last coordinate.
template <class Vector>
Vector2d section(const Vector& x) {
  return {double(x[0]), double(x[x.size() - 1])};
}

template <class S>
Drawing drawing_of(const Aabb<S>& box, const Picture& picture) {
  return Drawing(section(box.lower), section(box.upper), picture.width, picture.height);
}

template <class S>
void draw_walls(const Aabb<S>& box, Drawing& drawing) {
  const Vector2d low = section(box.lower), high = section(box.upper);
  const std::array<Vector2d, 4> corners = {low, Vector2d(high.x(), low.y()), high,
                                           Vector2d(low.x(), high.y())};
  drawing.outline(corners, screen_color(0x4A4F57), 2.5);
  drawing.line(corners[1], corners[2], screen_color(0x2F6FB0), 7);
}

/// Draws each contact as a line whose width is proportional to its normal force: `width` pixels at
/// six times the mean force, at most twice as wide.
template <class S>
void draw_chains(std::span<const ContactSegment<S>> chains, double width, Drawing& drawing) {
  double sum = 0;
  for (const auto& chain : chains) sum += double(chain.normal_force);
  if (!(sum > 0)) return;
  const double unit = width * double(chains.size()) / (6 * sum);
  for (const auto& chain : chains)
    drawing.line(section(chain.from), section(chain.to), screen_color(0xB3261E),
                 std::min(2 * width, unit * double(chain.normal_force)));
}

template <Polytope Shape>
void draw_grain(const Shape& shape, const Pose<SpaceOf<Shape>>& pose, const Color& color,
                Drawing& drawing) {
  std::vector<Vector2d> corners;
  for (Eigen::Index i = 0; i < shape.vertices().rows(); ++i)
    corners.push_back(pose(shape.vertices().row(i).transpose()).template cast<double>());
  drawing.fill(corners, color);
  drawing.outline(corners, 0.25f * color, 1);
}

/// Draws a round shape by its support function; a disk also has a radius, which shows its rotation.
template <ConvexShape Shape>
requires(!Polytope<Shape>) void draw_grain(const Shape& shape, const Pose<SpaceOf<Shape>>& pose,
                                           const Color& color, Drawing& drawing) {
  using Vector = typename SpaceOf<Shape>::Vector;
  std::vector<Vector2d> rim;
  constexpr int count = 96;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count;
    const Vector direction =
        Vector2d(std::cos(angle), std::sin(angle)).cast<typename Vector::Scalar>();
    rim.push_back(pose(shape.support(direction)).template cast<double>());
  }
  drawing.fill(rim, color);
  drawing.outline(rim, 0.25f * color, 1);
  if constexpr (is_ball<Shape>)
    drawing.line(pose.position.template cast<double>(), rim[0], 0.45f * color, 1);
}

/// Draws all parts of a compound grain. The outlines are drawn first: only the outline of the whole
/// grain remains visible.
template <CompoundShape Shape>
void draw_grain(const Shape& shape, const Pose<SpaceOf<Shape>>& pose, const Color& color,
                Drawing& drawing) {
  SurfaceMesh<SpaceOf<Shape>> mesh;
  SurfaceMesher<SpaceOf<Shape>>(4).mesh(shape, mesh);
  std::vector<std::vector<Vector2d>> rims;
  std::size_t corner = 0;
  for (const std::int32_t end : mesh.ends)
    for (rims.emplace_back(); corner < static_cast<std::size_t>(end); ++corner)
      rims.back().push_back(pose(mesh.points[static_cast<std::size_t>(mesh.corners[corner])])
                                .template cast<double>());
  for (const auto& rim : rims) drawing.outline(rim, 0.25f * color, 2);
  for (const auto& rim : rims) drawing.fill(rim, color);
}

/// Draws the shape that a OneOf holds.
template <class... Shapes>
void draw_grain(const OneOf<Shapes...>& shape, const Pose<SpaceOf<OneOf<Shapes...>>>& pose,
                const Color& color, Drawing& drawing) {
  shape.visit([&](const auto& held) { draw_grain(held, pose, color, drawing); });
}

}  // namespace detail

/// A picture of grains in a box in space.
/// @param box      the container; its wall at the upper end of x is tinted
/// @param shape_of,pose_of,color_of k -> shape, pose, Color of grain k
template <class T, class ShapeOf, class PoseOf, class ColorOf>
Image render_packing(const Aabb<Space<3, T>>& box, std::size_t grain_count, const ShapeOf& shape_of,
                     const PoseOf& pose_of, const ColorOf& color_of, const Picture& picture = {}) {
  const Aabb<Space<3>> container{box.lower.template cast<double>(),
                                 box.upper.template cast<double>()};
  const Vector3f low = container.lower.cast<float>(), high = container.upper.cast<float>();
  const float size = (high - low).norm();
  Scene scene(grain_count);
  for (std::size_t k = 0; k < grain_count; ++k)
    scene.add_grain(shape_of(k), pose_of(k), color_of(k));
  const Vector3f middle = (low + high) / 2;
  scene.add_ground({middle.x(), middle.y(), low.z() - 1e-3f * size}, 0.75f * size,
                   Color::Constant(0.87f));

  const View view = detail::view_of(container, picture);
  const DepthBuffer seen(view, scene.triangles(), true);
  Image image(view.width, view.height, screen_color(0xFFFFFF));
  shade(scene, seen, Lighting(scene, middle, 0.62f * size), detail::oversampling, image);
  draw_edges(scene, seen, detail::oversampling / 2, image);
  if (picture.walls) detail::draw_box(container, seen, image);
  return image.reduced(detail::oversampling);
}

/// A drawing of grains in the plane, with the force chains over them.
/// @param chains may be empty
template <class T, class ShapeOf, class PoseOf, class ColorOf>
Image render_packing(const Aabb<Space<2, T>>& box, std::size_t grain_count, const ShapeOf& shape_of,
                     const PoseOf& pose_of, const ColorOf& color_of, const Picture& picture = {},
                     std::span<const ContactSegment<Space<2, T>>> chains = {}) {
  Drawing drawing = detail::drawing_of(box, picture);
  for (std::size_t k = 0; k < grain_count; ++k)
    detail::draw_grain(shape_of(k), pose_of(k), color_of(k), drawing);
  detail::draw_chains(chains, 5, drawing);
  if (picture.walls) detail::draw_walls(box, drawing);
  return drawing.finished();
}

/// The force chains alone, seen from the front.
/// @param section in space, only contacts in this share of the depth of the box about its middle
///                are shown, 0..1
template <class S>
Image render_force_chains(const Aabb<S>& box, std::span<const ContactSegment<S>> chains,
                          double section = 0.25, const Picture& picture = {}) {
  std::vector<ContactSegment<S>> shown;
  for (const auto& chain : chains) {
    bool inside = true;
    for (int k = 1; k + 1 < S::dim; ++k) {
      const double share = double((chain.point[k] - box.lower[k]) / (box.upper[k] - box.lower[k]));
      inside = inside && std::abs(share - 0.5) <= section / 2;
    }
    if (inside) shown.push_back(chain);
  }
  Drawing drawing = detail::drawing_of(box, picture);
  detail::draw_chains<S>(shown, 8, drawing);
  if (picture.walls) detail::draw_walls(box, drawing);
  return drawing.finished();
}

}  // namespace moreau::rendering
