// SPDX-License-Identifier: MIT
// Writes files for ParaView: grains with their surfaces, contacts as lines, fields, boxes.
//
// In ParaView:
//  - Grains are faces. Their arrays belong to the cells.
//  - If all grains are spheres, they are points, and their arrays belong to the points. The file is
//    then about a hundred times smaller. Use the filter Glyph or the representation Point Gaussian,
//    scaled by `size`. With VtkOptions::balls_as_points = false, balls are written as faces.
//  - A contact is a line between the two centres, or from a centre to a wall. Use the filter Tube
//    and vary its radius by `normal_force`.
//  - Fields are points. Use the filter Glyph.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "moreau/core/aabb.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/io/vtk_poly_data.hpp"
#include "moreau/measure/force_chains.hpp"
#include "moreau/measure/grid_field.hpp"
#include "moreau/mesh/surface_mesh.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/concepts.hpp"

namespace moreau {

/// How grains are drawn.
struct VtkOptions {
  /// Fineness of curved surfaces, 0 to 6 (SurfaceMesher). With 2, a sphere has 320 triangles.
  int fineness = 2;
  bool balls_as_points = true;  ///< whether balls are written as points if all grains are
                                ///< balls
};

/// Writes .vtp files. Each file is written as a whole or not at all. The object uses its buffers
/// again for each file. Coordinates are in world axes [m] in single precision; in the plane z = 0.
template <class S>
class VtkWriter {
 public:
  using Vector = typename S::Vector;

  /// @throws std::invalid_argument for a fineness outside 0 to 6
  explicit VtkWriter(const VtkOptions& options = {});

  /// Writes the grains with the arrays `id` (the index k), `size` (circumdiameter [m]), `velocity`
  /// of the centre of mass [m/s], `speed` [m/s] and `spin` (magnitude of the angular velocity
  /// [rad/s]): of velocity_of, so of a simulation whose cell deforms relative to the cell.
  /// @param shape_of,pose_of,velocity_of functions: k -> shape, pose [m] and twist (v, w) [m/s,
  ///                                     rad/s] of grain k, world axes
  /// @throws std::invalid_argument if a pose is not finite
  /// @throws std::system_error naming the path if the file cannot be written
  template <class ShapeOf, class PoseOf, class VelocityOf>
  void write_grains(const std::filesystem::path& path, std::size_t grain_count,
                    const ShapeOf& shape_of, const PoseOf& pose_of, const VelocityOf& velocity_of) {
    using Shape = std::remove_cvref_t<decltype(shape_of(std::size_t{}))>;
    clear();
    bool as_points = false;
    if constexpr (std::same_as<Shape, BallIn<S>>) as_points = options_.balls_as_points;
    for (std::size_t k = 0; k < grain_count; ++k) {
      const Shape& shape = shape_of(k);
      const Pose<S>& pose = pose_of(k);
      if (!is_drawable(pose.position))
        throw_invalid("VtkWriter::write_grains", "pose_of(" + std::to_string(k) + ").position",
                      pose.position, "must be finite as float");
      if (!S::is_finite(pose.rotation))
        throw_invalid("VtkWriter::write_grains", "pose_of(" + std::to_string(k) + ").rotation",
                      pose.rotation.toRotationMatrix(), "must be finite");
      const std::size_t before = data_.cell_count();
      if (as_points)
        append_point(pose.position);
      else
        append_surface(shape, pose);
      const typename S::Twist twist = velocity_of(k);
      const Vector v = linear<S>(twist);
      const auto size = static_cast<float>(2 * reach(shape));
      const auto speed = static_cast<float>(v.norm()),
                 spin = static_cast<float>(angular<S>(twist).norm());
      for (std::size_t cell = before; cell < data_.cell_count(); ++cell) {
        numbers_.push_back(static_cast<std::int32_t>(k));
        lengths_.push_back(size);
        append_vector(v, vectors_);
        first_.push_back(speed);
        second_.push_back(spin);
      }
    }
    const auto place = as_points ? VtkPolyData::On::points : VtkPolyData::On::cells;
    add<std::int32_t>(place, "id", 1, numbers_);
    add<float>(place, "size", 1, lengths_);
    add<float>(place, "velocity", 3, vectors_);
    add<float>(place, "speed", 1, first_);
    add<float>(place, "spin", 1, second_);
    data_.write(path);
  }

  /// Writes each contact point as a line from the centre of a to the centre of b. If one of the
  /// bodies is a wall, the line ends at the contact point. In a periodic cell the line ends at the
  /// image of b that a touches. The arrays are `normal_force`
  /// and `friction_force` [N], `gap` [m], `class` (value of the ContactClass) and `point`, the
  /// position of the contact point [m].
  /// @param contacts result of force_chains() or contact_segments()
  /// @throws std::invalid_argument if an end of a segment is not finite
  /// @throws std::system_error naming the path if the file cannot be written
  void write_contacts(const std::filesystem::path& path,
                      std::span<const ContactSegment<S>> contacts);

  /// Writes the cells of a grid that contain grains as points at the centres of the cells, with the
  /// arrays `value` (mean in the unit of the field) and `grains` (number of grains in the mean).
  /// @throws std::system_error naming the path if the file cannot be written
  void write_field(const std::filesystem::path& path, const GridField<S>& field);

  /// Writes the edges of a box, world axes [m].
  /// @throws std::invalid_argument if the box is empty or not finite
  /// @throws std::system_error naming the path if the file cannot be written
  void write_box(const std::filesystem::path& path, const Aabb<S>& box);

 private:
  void clear() {
    data_.clear();
    numbers_.clear();
    lengths_.clear();
    vectors_.clear();
    first_.clear();
    second_.clear();
  }
  /// Whether a point is finite in single precision, in which files store it.
  static bool is_drawable(const Vector& x) { return x.template cast<float>().allFinite(); }
  void append_point(const Vector& position) {
    cell_.assign(1, data_.add_point(position));
    data_.add_cell(VtkPolyData::Cells::vertices, cell_);
  }
  template <class Shape>
  void append_surface(const Shape& shape, const Pose<S>& pose) {
    mesher_.mesh(shape, mesh_);
    const auto first = static_cast<std::int32_t>(data_.point_count());
    for (const Vector& x : mesh_.points) data_.add_point(pose(x));
    std::size_t corner = 0;
    for (const std::int32_t end : mesh_.ends) {
      cell_.clear();
      for (; corner < static_cast<std::size_t>(end); ++corner)
        cell_.push_back(first + mesh_.corners[corner]);
      data_.add_cell(VtkPolyData::Cells::polygons, cell_);
    }
  }
  /// The distance of the farthest point of a shape from its origin [m]: the circumradius, or, for a
  /// shape without circumradius(), the largest distance of a point of the mesh.
  template <class Shape>
  typename S::Scalar reach(const Shape& shape) const {
    if constexpr (HasCircumradius<Shape>) {
      return shape.circumradius();
    } else {
      typename S::Scalar farthest = 0;
      for (const Vector& x : mesh_.points) farthest = std::max(farthest, x.norm());
      return farthest;
    }
  }
  static void append_vector(const Vector& x, std::vector<float>& values) {
    for (int k = 0; k < 3; ++k) values.push_back(k < S::dim ? static_cast<float>(x[k]) : 0.0f);
  }
  template <class T>
  void add(VtkPolyData::On place, const char* name, std::size_t components,
           const std::vector<T>& values) {
    data_.add_array<T>(place, name, components, values);
  }

  VtkOptions options_;
  SurfaceMesher<S> mesher_;
  SurfaceMesh<S> mesh_;
  VtkPolyData data_;
  std::vector<std::int32_t> cell_, numbers_;
  std::vector<float> lengths_, vectors_, first_, second_;  // values of the arrays of one file
};

// Outside of the class, so that moreau::instances has them compiled.

template <class S>
VtkWriter<S>::VtkWriter(const VtkOptions& options) : options_(options), mesher_(options.fineness) {}

template <class S>
void VtkWriter<S>::write_contacts(const std::filesystem::path& path,
                                  std::span<const ContactSegment<S>> contacts) {
  clear();
  for (const ContactSegment<S>& contact : contacts) {
    for (const Vector& end : {contact.from, contact.to})
      require(is_drawable(end), "VtkWriter::write_contacts", "end of a contact", end,
              "must be finite as float");
    cell_.assign({data_.add_point(contact.from), data_.add_point(contact.to)});
    data_.add_cell(VtkPolyData::Cells::lines, cell_);
    numbers_.push_back(static_cast<std::int32_t>(contact.contact_class));
    lengths_.push_back(static_cast<float>(contact.gap));
    append_vector(contact.point, vectors_);
    first_.push_back(static_cast<float>(contact.normal_force));
    second_.push_back(static_cast<float>(contact.friction_force));
  }
  constexpr auto cells = VtkPolyData::On::cells;
  add<float>(cells, "normal_force", 1, first_);
  add<float>(cells, "friction_force", 1, second_);
  add<float>(cells, "gap", 1, lengths_);
  add<std::int32_t>(cells, "class", 1, numbers_);
  add<float>(cells, "point", 3, vectors_);
  data_.write(path);
}

template <class S>
void VtkWriter<S>::write_field(const std::filesystem::path& path, const GridField<S>& field) {
  clear();
  for (std::size_t k = 0; k < field.size(); ++k) {
    const GridSample<S> sample = field.sample(k);
    if (sample.grains == 0) continue;
    append_point(sample.position);
    append_vector(sample.value, vectors_);
    numbers_.push_back(static_cast<std::int32_t>(sample.grains));
  }
  add<float>(VtkPolyData::On::points, "value", 3, vectors_);
  add<std::int32_t>(VtkPolyData::On::points, "grains", 1, numbers_);
  data_.write(path);
}

template <class S>
void VtkWriter<S>::write_box(const std::filesystem::path& path, const Aabb<S>& box) {
  require(is_drawable(box.lower), "VtkWriter::write_box", "box.lower", box.lower,
          "must be finite as float");
  require(is_drawable(box.upper), "VtkWriter::write_box", "box.upper", box.upper,
          "must be finite as float");
  require((box.lower.array() <= box.upper.array()).all(), "VtkWriter::write_box", "box.upper",
          box.upper, "must be >= box.lower");
  clear();
  for (unsigned corner = 0; corner < 1u << S::dim; ++corner) {
    Vector x = box.lower;
    for (int k = 0; k < S::dim; ++k)
      if ((corner >> k & 1u) != 0) x[k] = box.upper[k];
    data_.add_point(x);
  }
  for (unsigned corner = 0; corner < 1u << S::dim; ++corner)
    for (int k = 0; k < S::dim; ++k) {
      if ((corner >> k & 1u) != 0) continue;
      cell_.assign(
          {static_cast<std::int32_t>(corner), static_cast<std::int32_t>(corner | 1u << k)});
      data_.add_cell(VtkPolyData::Cells::lines, cell_);
    }
  data_.write(path);
}

}  // namespace moreau
