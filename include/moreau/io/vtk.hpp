// SPDX-License-Identifier: MIT
// Snapshots that ParaView opens: grains with their surfaces, contacts as lines, the box around.
//
// In ParaView: a polyhedron is its faces, a polygon one cell; their arrays lie on the cells. A
// sphere is a point, its arrays on the points: show it with the filter Glyph, scaled by `size`.
// Contacts: the filter Tube, its radius varying with `normal_force`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <type_traits>
#include <vector>

#include "moreau/core/aabb.hpp"
#include "moreau/io/vtk_poly_data.hpp"
#include "moreau/measure/force_chains.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/sphere.hpp"

namespace moreau {

namespace detail {

/// Where the arrays of a shape lie, how many values each grain has there, and its cells.
template <class Shape>
struct VtkShape;

template <class S>
struct VtkShape<Sphere<S>> {
  static constexpr auto arrays_on = VtkPolyData::On::points;
  static std::size_t values(const Sphere<S>&) { return 1; }
  static void append(VtkPolyData& data, const Sphere<S>&, const Pose<S>& pose,
                     std::vector<std::int32_t>& cell) {
    cell.assign(1, data.add_point(pose.position));
    data.add_cell(VtkPolyData::Cells::vertices, cell);
  }
};

template <Polytope Shape>
struct VtkShape<Shape> {
  using S = SpaceOf<Shape>;
  static constexpr auto arrays_on = VtkPolyData::On::cells;

  static std::size_t values(const Shape& shape) { return face_count(shape, S{}); }
  static void append(VtkPolyData& data, const Shape& shape, const Pose<S>& pose,
                     std::vector<std::int32_t>& cell) {
    const auto first = static_cast<std::int32_t>(data.point_count());
    for (Eigen::Index i = 0; i < shape.vertices().rows(); ++i)
      data.add_point(pose(shape.vertices().row(i).transpose()));
    for (std::size_t f = 0; f < face_count(shape, S{}); ++f) {
      cell.clear();
      append_face(shape, f, cell, S{});
      for (std::int32_t& vertex : cell) vertex += first;
      data.add_cell(VtkPolyData::Cells::polygons, cell);
    }
  }

 private:
  // A polygon is its own and only face.
  template <class T>
  static std::size_t face_count(const Shape&, Space<2, T>) {
    return 1;
  }
  template <class T>
  static std::size_t face_count(const Shape& shape, Space<3, T>) {
    return shape.face_count();
  }
  template <class T>
  static void append_face(const Shape& shape, std::size_t, std::vector<std::int32_t>& cell,
                          Space<2, T>) {
    for (Eigen::Index i = 0; i < shape.vertices().rows(); ++i)
      cell.push_back(static_cast<std::int32_t>(i));
  }
  template <class T>
  static void append_face(const Shape& shape, std::size_t f, std::vector<std::int32_t>& cell,
                          Space<3, T>) {
    for (const auto vertex : shape.face(f)) cell.push_back(static_cast<std::int32_t>(vertex));
  }
};

}  // namespace detail

/// Writes .vtp files, each whole or not at all; keeps its buffers from snapshot to snapshot.
/// All methods throw std::system_error naming the path if the file cannot be written.
template <class S>
class VtkWriter {
 public:
  using Vector = typename S::Vector;

  /// The grains, with `id` (the number k), `size` (circumdiameter [m]), `velocity` of the centre
  /// [m/s], `speed` and `spin` (magnitude of the angular velocity [rad/s]).
  /// @param shape_of,pose_of,velocity_of k -> shape, pose, twist (v, w) of grain k, world axes
  template <class ShapeOf, class PoseOf, class VelocityOf>
  void write_grains(const std::filesystem::path& path, std::size_t grain_count,
                    const ShapeOf& shape_of, const PoseOf& pose_of, const VelocityOf& velocity_of) {
    using Shape = std::remove_cvref_t<decltype(shape_of(std::size_t{}))>;
    using Vtk = detail::VtkShape<Shape>;
    clear();
    for (std::size_t k = 0; k < grain_count; ++k) {
      const Shape& shape = shape_of(k);
      Vtk::append(data_, shape, pose_of(k), cell_);
      const typename S::Twist twist = velocity_of(k);
      const Vector v = twist.template head<S::dim>();
      for (std::size_t value = 0; value < Vtk::values(shape); ++value) {
        numbers_.push_back(static_cast<std::int32_t>(k));
        lengths_.push_back(static_cast<float>(2 * shape.circumradius()));
        append_vector(v, vectors_);
        first_.push_back(static_cast<float>(v.norm()));
        second_.push_back(static_cast<float>(twist.template tail<S::angular_dim>().norm()));
      }
    }
    add<std::int32_t>(Vtk::arrays_on, "id", 1, numbers_);
    add<float>(Vtk::arrays_on, "size", 1, lengths_);
    add<float>(Vtk::arrays_on, "velocity", 3, vectors_);
    add<float>(Vtk::arrays_on, "speed", 1, first_);
    add<float>(Vtk::arrays_on, "spin", 1, second_);
    data_.write(path);
  }

  /// Contact points as lines between the centres of their bodies, with `normal_force` and
  /// `friction_force` [N], `gap` [m], `class` (the number of the ContactClass) and `point`, where
  /// it is [m].
  void write_contacts(const std::filesystem::path& path,
                      std::span<const ContactSegment<S>> contacts) {
    clear();
    for (const ContactSegment<S>& contact : contacts) {
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

  /// The edges of a box.
  void write_box(const std::filesystem::path& path, const Aabb<S>& box) {
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

 private:
  void clear() {
    data_.clear();
    numbers_.clear();
    lengths_.clear();
    vectors_.clear();
    first_.clear();
    second_.clear();
  }
  static void append_vector(const Vector& x, std::vector<float>& values) {
    for (int k = 0; k < 3; ++k) values.push_back(k < S::dim ? static_cast<float>(x[k]) : 0.0f);
  }
  template <class T>
  void add(VtkPolyData::On place, const char* name, std::size_t components,
           const std::vector<T>& values) {
    data_.add_array<T>(place, name, components, values);
  }

  VtkPolyData data_;
  std::vector<std::int32_t> cell_, numbers_;
  std::vector<float> lengths_, vectors_, first_, second_;  // values of the arrays to be added
};

}  // namespace moreau
