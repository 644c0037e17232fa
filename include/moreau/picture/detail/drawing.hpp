// SPDX-License-Identifier: MIT
// A drawing of convex polygons and lines in the plane, each painted over the earlier ones. x points
// to the right, y up.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "moreau/picture/detail/rasterizer.hpp"
#include "moreau/picture/image.hpp"

namespace moreau::rendering {

using Eigen::Vector2d;

/// Coordinates in metres; widths of lines in pixels of the finished picture.
class Drawing {
 public:
  static constexpr int oversampling = 4;

  /// Shows the rectangle lower..upper with a margin, as large as possible.
  Drawing(const Vector2d& lower, const Vector2d& upper, int width, int height, double margin = 0.04)
      : image_(oversampling * width, oversampling * height, screen_color(0xFFFFFF)),
        middle_((lower + upper) / 2) {
    const Vector2d room(image_.width(), image_.height());
    scale_ = (1 - 2 * margin) * room.cwiseQuotient(upper - lower).minCoeff();
  }

  /// Fills a convex polygon.
  void fill(std::span<const Vector2d> corners, const Color& color) {
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      paint({pixel(corners[0]), pixel(corners[k]), pixel(corners[k + 1])}, color);
  }
  void outline(std::span<const Vector2d> corners, const Color& color, double width) {
    for (std::size_t k = 0; k < corners.size(); ++k)
      line(corners[k], corners[(k + 1) % corners.size()], color, width);
  }
  /// Draws a line with round ends.
  void line(const Vector2d& from, const Vector2d& to, const Color& color, double width) {
    const Vector3f a = pixel(from), b = pixel(to);
    const auto radius = static_cast<float>(width * oversampling / 2);
    const Vector3f along = b - a;
    if (along.norm() > 0) {
      const Vector3f side = radius * Vector3f(-along.y(), along.x(), 0).normalized();
      paint({a + side, b + side, b - side}, color);
      paint({a + side, b - side, a - side}, color);
    }
    disk(a, radius, color);
    disk(b, radius, color);
  }

  Image finished() const { return image_.reduced(oversampling); }

 private:
  Vector3f pixel(const Vector2d& x) const {
    const Vector2d p = scale_ * (x - middle_);
    return {static_cast<float>(image_.width()) / 2 + static_cast<float>(p.x()),
            static_cast<float>(image_.height()) / 2 - static_cast<float>(p.y()), 0};
  }
  void paint(const std::array<Vector3f, 3>& triangle, const Color& color) {
    for_each_pixel(triangle, image_.width(), image_.height(),
                   [&](int column, int row, const Vector3f&) { image_(column, row) = color; });
  }
  void disk(const Vector3f& center, float radius, const Color& color) {
    constexpr int sides = 16;
    const auto rim = [&](int k) -> Vector3f {
      const float angle = 6.2831853f * static_cast<float>(k) / sides;
      return center + radius * Vector3f(std::cos(angle), std::sin(angle), 0);
    };
    for (int k = 0; k < sides; ++k) paint({center, rim(k), rim(k + 1)}, color);
  }

  Image image_;
  Vector2d middle_;
  double scale_ = 1;
};

}  // namespace moreau::rendering
