// SPDX-License-Identifier: MIT
// Input: arbitrary points. Expected: a convex hull that contains all points and has finite
// properties, or an error.
#include <algorithm>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include "bytes.hpp"
#include "shapes.hpp"

namespace {

using namespace moreau;

template <class Vector>
std::vector<Vector> take_points(Bytes& bytes) {
  using T = typename Vector::Scalar;
  const bool wild = bytes.between(0, 3) == 0;
  const T scale = std::ldexp(T(1), bytes.between(-40, 40));
  std::vector<Vector> points;
  while (!bytes.is_empty() && points.size() < 64) {
    Vector x;
    for (auto& coordinate : x) coordinate = scale * static_cast<T>(bytes.number(wild));
    points.push_back(x);
  }
  return points;
}

/// The properties of a shape in the coordinates of the input.
template <class ShapeT>
void check_shape(const ShapeT& shape, const std::vector<typename ShapeT::Vector>& points) {
  using T = typename ShapeT::Scalar;
  T size = 0;
  for (const auto& x : points) size = std::max(size, x.cwiseAbs().maxCoeff());
  hold(shape.vertices().allFinite(), "finite vertices");
  hold(shape.face_normals().allFinite(), "finite normals");
  hold(shape.face_offsets().allFinite(), "finite offsets");
  hold(shape.centroid_of_input().allFinite(), "finite centroid");
  hold(((shape.face_normals().rowwise().norm().array() - T(1)).abs() < T(1e-5)).all(),
       "unit normals");
  hold(std::isfinite(shape.volume()) && shape.volume() > 0, "positive volume");
  const auto mass = shape.mass_properties(1);
  hold(std::isfinite(mass.mass) && mass.inertia.allFinite(), "finite mass properties");
  hold((mass.inertia.diagonal().array() > 0).all(), "positive moments of inertia");
  hold(std::isfinite(shape.circumradius()) && shape.circumradius() > 0, "positive circumradius");
  hold(shape.inradius() <= shape.circumradius(), "inradius <= circumradius");
  // The hull may have increased its tolerance by a factor of up to 64, and the deviation may be
  // twice the tolerance. In addition the planes are rounded to the scalar type.
  const T close = T(2 * 64 + 2) * static_cast<T>(HullTolerance{}.flat) *
                  std::numeric_limits<T>::epsilon() * size;
  for (const auto& x : points) {
    const auto heights =
        ((shape.face_normals() * (x - shape.centroid_of_input())).array() - shape.face_offsets())
            .eval();
    hold(heights.maxCoeff() <= close, "all points on or below every face");
  }
}

template <std::floating_point T>
void check_faces(const Polyhedron<T>& shape) {
  hold(shape.vertex_count() + shape.face_count() == shape.edge_count() + 2, "V + F = E + 2");
  for (std::size_t f = 0; f < shape.face_count(); ++f)
    hold(shape.face(f).size() >= 3, "three vertices to a face");
}
template <std::floating_point T>
void check_faces(const Polygon<T>& shape) {
  hold(shape.vertex_count() >= 3, "three vertices");
}

template <class ShapeT>
void try_shape(Bytes& bytes) {
  const auto points = take_points<typename ShapeT::Vector>(bytes);
  try {
    const ShapeT shape = hull_of<ShapeT>(points);
    check_faces(shape);
    check_shape(shape, points);
  } catch (const std::invalid_argument&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  switch (bytes.between(0, 3)) {
    case 0:
      try_shape<Polyhedron<double>>(bytes);
      break;
    case 1:
      try_shape<Polygon<double>>(bytes);
      break;
    case 2:
      try_shape<Polyhedron<float>>(bytes);
      break;
    default:
      try_shape<Polygon<float>>(bytes);
  }
  return 0;
}
