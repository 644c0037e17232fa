// SPDX-License-Identifier: MIT
// Rasterizes triangles: projects them to the screen, finds the pixels that they cover, and finds the
// nearest triangle at each pixel with a depth buffer.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace moreau::rendering {

using Eigen::Vector3f;

/// A triangle of a surface, with corners counter-clockwise seen from outside, world axes [m].
struct Triangle {
  std::array<Vector3f, 3> corner;
  std::array<Vector3f, 3> normal;  ///< at the corners
  std::uint32_t object;            ///< number of the grain or wall
  std::uint32_t face;              ///< of the object: edges are drawn between faces

  /// Unit normal at a point of the triangle.
  Vector3f normal_at(const Vector3f& x) const {
    const Vector3f area = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    const auto share = [&](int k) {
      const Vector3f& a = corner[static_cast<std::size_t>(k + 1) % 3];
      const Vector3f& b = corner[static_cast<std::size_t>(k + 2) % 3];
      return (a - x).cross(b - x).dot(area);
    };
    return (share(0) * normal[0] + share(1) * normal[1] + share(2) * normal[2]).normalized();
  }
};

/// Maps world points to (column, row, nearness). Nearness is larger for nearer points, and linear
/// on the screen along a plane.
struct View {
  Eigen::Matrix3f axes;  ///< rows: right, down, forward
  Vector3f eye;          ///< any point in front of the scene for a parallel view
  float focal;           ///< pixels per unit of x/z; pixels per metre for a parallel view
  bool parallel;
  int width, height;

  /// The view from `eye` towards `target`, with z up where possible.
  static View towards(const Vector3f& eye, const Vector3f& target, float focal, bool parallel,
                      int width, int height) {
    View view{{}, eye, focal, parallel, width, height};
    const Vector3f forward = (target - eye).normalized();
    const Vector3f up = std::abs(forward.z()) > 0.999f ? Vector3f::UnitY() : Vector3f::UnitZ();
    const Vector3f right = forward.cross(up).normalized();
    view.axes.row(0) = right.transpose();
    view.axes.row(1) = forward.cross(right).transpose();
    view.axes.row(2) = forward.transpose();
    return view;
  }

  Vector3f operator()(const Vector3f& world) const {
    const Vector3f x = axes * (world - eye);
    const float scale = parallel ? focal : focal / x.z();
    return {0.5f * static_cast<float>(width) + scale * x.x(),
            0.5f * static_cast<float>(height) + scale * x.y(), parallel ? -x.z() : 1 / x.z()};
  }
  /// The world point at a pixel with this nearness: the inverse of operator().
  Vector3f world(const Vector3f& screen) const {
    const float depth = parallel ? -screen.z() : 1 / screen.z();
    const float scale = (parallel ? 1.0f : depth) / focal;
    const Vector3f x((screen.x() - 0.5f * static_cast<float>(width)) * scale,
                     (screen.y() - 0.5f * static_cast<float>(height)) * scale, depth);
    return eye + axes.transpose() * x;
  }
};

/// Calls fragment(column, row, b) for the pixels whose centres lie in a triangle in screen
/// coordinates of either orientation. b are the barycentric coordinates.
template <class Fragment>
void for_each_pixel(const std::array<Vector3f, 3>& screen, int width, int height,
                    const Fragment& fragment) {
  const auto& [p, q, r] = screen;
  const float whole = (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
  if (whole == 0 || !std::isfinite(whole)) return;
  const auto pixels = [](float from, float to, int count) {
    const float last = static_cast<float>(count);
    return std::pair(static_cast<int>(std::clamp(std::ceil(from - 0.5f), 0.0f, last)),
                     static_cast<int>(std::clamp(std::floor(to + 0.5f), 0.0f, last)));
  };
  const auto [left, right] =
      pixels(std::min({p.x(), q.x(), r.x()}), std::max({p.x(), q.x(), r.x()}), width);
  const auto [top, bottom] =
      pixels(std::min({p.y(), q.y(), r.y()}), std::max({p.y(), q.y(), r.y()}), height);
  // The coordinates of the first and the second corner, linear in column and row.
  const Eigen::Array2f by_column = Eigen::Array2f(q.y() - r.y(), r.y() - p.y()) / whole;
  const Eigen::Array2f by_row = Eigen::Array2f(r.x() - q.x(), p.x() - r.x()) / whole;
  for (int row = top; row < bottom; ++row) {
    const float y = static_cast<float>(row) + 0.5f - r.y();
    for (int column = left; column < right; ++column) {
      const float x = static_cast<float>(column) + 0.5f - r.x();
      const Eigen::Array2f b = by_column * x + by_row * y;
      const float last = 1 - b[0] - b[1];
      if (b[0] >= 0 && b[1] >= 0 && last >= 0) fragment(column, row, Vector3f(b[0], b[1], last));
    }
  }
}

/// The nearest surface at each pixel.
class DepthBuffer {
 public:
  static constexpr std::uint32_t nothing = 0xFFFFFFFFu;

  /// @param keep_triangles also remember which triangle is seen at each pixel
  DepthBuffer(const View& view, const std::vector<Triangle>& triangles, bool keep_triangles)
      : view_(view),
        nearness_(std::size_t(view.width) * std::size_t(view.height),
                  -std::numeric_limits<float>::infinity()),
        triangle_(keep_triangles ? nearness_.size() : 0, nothing) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const auto& corner = triangles[t].corner;
      const std::array<Vector3f, 3> screen = {view(corner[0]), view(corner[1]), view(corner[2])};
      const Vector3f near(screen[0].z(), screen[1].z(), screen[2].z());
      if (!view.parallel && near.minCoeff() <= 0) continue;  // behind the eye
      for_each_pixel(screen, view.width, view.height, [&](int column, int row, const Vector3f& b) {
        const std::size_t i = index(column, row);
        if (!(b.dot(near) > nearness_[i])) return;
        nearness_[i] = b.dot(near);
        if (keep_triangles) triangle_[i] = t;
      });
    }
  }

  const View& view() const { return view_; }
  float nearness(int column, int row) const { return nearness_[index(column, row)]; }
  /// Number of the visible triangle at a pixel, or `nothing`.
  std::uint32_t triangle(int column, int row) const { return triangle_[index(column, row)]; }
  /// The visible world point at a pixel.
  Vector3f point(int column, int row) const {
    return view_.world(
        {static_cast<float>(column) + 0.5f, static_cast<float>(row) + 0.5f, nearness(column, row)});
  }

  /// If the view is that of a parallel light: the share of the light that reaches a point, 0 to 1,
  /// interpolated between four pixels. Surfaces less than `slack` [m] in front cast no shadow.
  float reaches(const Vector3f& world, float slack) const {
    const Vector3f at = view_(world);
    const float x = at.x() - 0.5f, y = at.y() - 0.5f;
    const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
    if (column < 0 || row < 0 || column + 1 >= view_.width || row + 1 >= view_.height) return 1;
    const float right = x - static_cast<float>(column), down = y - static_cast<float>(row);
    const auto lit = [&](int c, int r) {
      return nearness(column + c, row + r) <= at.z() + slack ? 1.0f : 0.0f;
    };
    return (1 - down) * ((1 - right) * lit(0, 0) + right * lit(1, 0)) +
           down * ((1 - right) * lit(0, 1) + right * lit(1, 1));
  }

 private:
  std::size_t index(int column, int row) const {
    return std::size_t(row) * std::size_t(view_.width) + std::size_t(column);
  }
  View view_;
  std::vector<float> nearness_;
  std::vector<std::uint32_t> triangle_;
};

}  // namespace moreau::rendering
