// SPDX-License-Identifier: MIT
// A picture of a simulation in one call, as a PNG file.
//
// It needs libpng (CMake: moreau::picture; else -lpng). With the macro MOREAU_WITHOUT_PNG, which
// must then be defined in all files of a program, it needs nothing and writes no pictures.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

#include "moreau/core/aabb.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/measure/wall_surface.hpp"
#include "moreau/picture/render_packing.hpp"

namespace moreau {

namespace rendering::detail {

/// Half of the diagonal of a shape's bounding box at rest [m].
template <GrainShape Shape>
double half_diagonal(const Shape& shape) {
  const auto box = shape.bounding_box(Pose<SpaceOf<Shape>>());
  return double((box.upper - box.lower).norm()) / 2;
}

/// The colours of stone, from the smallest to the largest grain.
template <class Simulation>
auto stone_colors(const Simulation& simulation) {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
    smallest = std::min(smallest, half_diagonal(simulation.shape_of_grain(k)));
    largest = std::max(largest, half_diagonal(simulation.shape_of_grain(k)));
  }
  const double range = largest - smallest, rounding = 1e-6 * largest;
  return [=, &simulation](BodyId grain) {
    const double above = half_diagonal(simulation.shape(grain)) - smallest;
    return stone_color(above > rounding ? above / range : 0, grain.index());
  };
}

/// Calls draw(shape, pose in the periodic cell, colour) for each grain.
template <class Simulation, class ColorOf, class Draw>
void for_each_grain(const Simulation& simulation, const ColorOf& color_of, const Draw& draw) {
  for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
    const BodyId grain = simulation.grain(k);
    draw(simulation.shape_of_grain(k), moreau::detail::pose_in_cell(simulation, grain),
         Color(color_of(grain)));
  }
}

/// The bounding box of the grains and the faces of the walls [m].
template <class Simulation, class Surfaces>
Aabb<typename Simulation::S> visible_box(const Simulation& simulation, const Surfaces& surfaces) {
  auto box = moreau::detail::box_of_grains(simulation);
  for (const auto& surface : surfaces)
    for (const auto& face : surface.faces)
      for (const auto& x : face) box.merge(x);
  return box;
}

/// Tints a wall and draws its edges. The long edges between the strips of a cylinder are not drawn, of a
/// mesh wall the ridges that a grain can touch.
template <class Surface>
void draw_wall(const Surface& surface, const DepthBuffer& seen, Image& image) {
  const Color wall = screen_color(0x2F6FB0), frame = screen_color(0x4A4F57);
  const bool is_strip = surface.faces.size() > 1;
  for (const auto& face : surface.faces) {
    std::vector<Vector3f> corners;
    for (const auto& x : face) corners.push_back(x.template cast<float>());
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      tint({seen.view()(corners[0]), seen.view()(corners[k]), seen.view()(corners[k + 1])}, seen,
           wall, 0.06f, image);
    for (std::size_t k = 0; k < corners.size() && surface.lines.empty(); k += is_strip ? 2 : 1)
      draw_line(corners[k], corners[(k + 1) % corners.size()], 1.5f * oversampling, seen, frame,
                image);
  }
  for (const auto& line : surface.lines)
    draw_line(line[0].template cast<float>(), line[1].template cast<float>(), 1.5f * oversampling,
              seen, frame, image);
}

/// The view of view_of(), moved and enlarged such that the given points fill the picture.
inline View fitted_view(const Aabb<Space<3>>& box, const Picture& picture,
                        const std::vector<Vector3f>& shown) {
  View view = view_of(box, picture);
  for (int pass = 0; pass < 3;
       ++pass) {  // perspective: the middle on the screen depends on the eye
    Vector3f low = view(shown[0]), high = low;
    float distance = 0;
    for (const Vector3f& x : shown) {
      low = low.cwiseMin(view(x));
      high = high.cwiseMax(view(x));
      distance += 1 / view(x).z() / static_cast<float>(shown.size());
    }
    const Vector3f aside = (low + high) / 2;
    view.eye += distance / view.focal *
                ((aside.x() - 0.5f * static_cast<float>(view.width)) * view.axes.row(0) +
                 (aside.y() - 0.5f * static_cast<float>(view.height)) * view.axes.row(1))
                    .transpose();
    view.focal *= 0.86f * std::min(static_cast<float>(view.width) / (high - low).x(),
                                   static_cast<float>(view.height) / (high - low).y());
  }
  return view;
}

/// In space: the grains on the ground, which is the first wall that faces up, and the other walls.
template <class Simulation, class ColorOf, class T>
Image render(const Simulation& simulation, const ColorOf& color_of, const Picture& picture,
             Space<3, T>) {
  std::optional<float> ground;
  auto surfaces = moreau::detail::wall_surfaces(simulation);
  std::erase_if(surfaces, [&](const auto& surface) {
    if (simulation.pose(surface.body).rotation.toRotationMatrix()(2, 0) < T(0.9999)) return false;
    if (surface.faces.size() > 1 || ground) return false;
    ground = static_cast<float>(simulation.pose(surface.body).position[2]);
    return true;
  });
  if (!picture.walls) surfaces.clear();
  const Aabb<Space<3, T>> visible = visible_box(simulation, surfaces);
  Aabb<Space<3>> box(visible.lower.template cast<double>(), visible.upper.template cast<double>());
  if (ground) box.lower.z() = std::min(box.lower.z(), double(*ground));
  const Vector3f middle = ((box.lower + box.upper) / 2).cast<float>();
  const auto size = static_cast<float>((box.upper - box.lower).norm());

  Scene scene(simulation.grain_count());
  for_each_grain(simulation, color_of,
                 [&](const auto& shape, const auto& pose, const Color& color) {
                   scene.add_grain(shape, pose, color);
                 });
  std::vector<Vector3f> shown;
  for (const Triangle& triangle : scene.triangles())
    shown.insert(shown.end(), triangle.corner.begin(), triangle.corner.end());
  for (const auto& surface : surfaces)
    for (const auto& face : surface.faces)
      for (const auto& x : face) shown.push_back(x.template cast<float>());
  if (ground)  // a little lower, so that it does not hide faces that lie on it
    scene.add_ground({middle.x(), middle.y(), *ground - 1e-3f * size}, 0.75f * size,
                     Color::Constant(0.87f));
  const View view = fitted_view(box, picture, shown);
  const DepthBuffer seen(view, scene.triangles(), true);
  Image image(view.width, view.height, screen_color(0xFFFFFF));
  shade(scene, seen, Lighting(scene, middle, 0.62f * size), oversampling, image);
  draw_edges(scene, seen, oversampling / 2, image);
  for (const auto& surface : surfaces) draw_wall(surface, seen, image);
  return image.reduced(oversampling);
}

/// In the plane: the grains and the lines of the walls.
template <class Simulation, class ColorOf, class T>
Image render(const Simulation& simulation, const ColorOf& color_of, const Picture& picture,
             Space<2, T>) {
  auto surfaces = moreau::detail::wall_surfaces(simulation);
  if (!picture.walls) surfaces.clear();
  Drawing drawing = drawing_of(visible_box(simulation, surfaces), picture);
  for_each_grain(simulation, color_of,
                 [&](const auto& shape, const auto& pose, const Color& color) {
                   draw_grain(shape, pose, color, drawing);
                 });
  for (const auto& surface : surfaces)
    for (const auto& face : surface.faces)
      drawing.line(face[0].template cast<double>(), face[1].template cast<double>(),
                   screen_color(0x4A4F57), 4);
  return drawing.finished();
}

}  // namespace rendering::detail

/// Writes a picture of a simulation: in space a scene with shadows, seen in perspective, in the
/// plane a drawing. Each grain is at its place in the periodic cell; the last axis points up.
///
///     write_picture("heap.png", simulation);
///
/// Walls are drawn as write_paraview() draws them: as far as the grains reach. In space, a floor
/// that faces up is the ground, other walls are transparent.
/// @param path       of the PNG file; an existing file is replaced
/// @param simulation a Simulation with any shape
/// @param color_of   function: BodyId of a grain -> rendering::Color. rendering::speed_color() and
///                   screen_color() make colours. By default grains have the colours of stone, by
///                   their size
/// @param picture    size of the picture in pixels, and the point of view
/// @throws std::invalid_argument for a simulation without grains, a width or height <= 0
/// @throws std::runtime_error or std::system_error naming the path if the file cannot be written
template <class Simulation, std::invocable<BodyId> ColorOf>
void write_picture(const std::filesystem::path& path, const Simulation& simulation,
                   const ColorOf& color_of, const rendering::Picture& picture = {}) {
  require(simulation.grain_count() > 0, "write_picture", "simulation.grain_count()",
          simulation.grain_count(), "must be > 0");
  require(picture.width > 0, "write_picture", "picture.width", picture.width, "must be > 0");
  require(picture.height > 0, "write_picture", "picture.height", picture.height, "must be > 0");
  rendering::write_png(
      path, rendering::detail::render(simulation, color_of, picture, typename Simulation::S{}));
}
/// The same with the colours of stone.
template <class Simulation>
void write_picture(const std::filesystem::path& path, const Simulation& simulation,
                   const rendering::Picture& picture = {}) {
  write_picture(path, simulation, rendering::detail::stone_colors(simulation), picture);
}

}  // namespace moreau
