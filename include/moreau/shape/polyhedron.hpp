// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "moreau/shape/convex_hull.hpp"
#include "moreau/shape/detail/face_plane.hpp"
#include "moreau/shape/detail/face_topology.hpp"
#include "moreau/shape/detail/flatten_faces.hpp"
#include "moreau/shape/detail/long_vector.hpp"
#include "moreau/shape/detail/polytope_base.hpp"

namespace moreau {

namespace detail {

struct PolyhedronNames {
  static constexpr const char* mass_properties = "Polyhedron::mass_properties";
  static constexpr const char* scaled = "Polyhedron::scaled";
  static constexpr const char* unit_of_second_moment = "m^5 must be positive and finite";
};

}  // namespace detail

/// A convex polyhedron. No two of its faces are coplanar.
template <std::floating_point T = double>
class Polyhedron : public PolytopeBase<Space<3, T>, detail::PolyhedronNames> {
  using Base = PolytopeBase<moreau::Space<3, T>, detail::PolyhedronNames>;

 public:
  using Base::vertex_count;
  using typename Base::Space, typename Base::Vector;
  using Edge = PolyhedronEdge;

  /// The convex hull of points. Points inside the hull, on a face or on an edge are removed. The
  /// others keep their order. Coplanar triangles form one face.
  /// @param vertices N points, in any order and in any frame [m]
  /// @throws std::invalid_argument for fewer than 4 points, a point that is not finite, points that
  ///                               coincide or are collinear or coplanar, or moments that the
  ///                               scalar type cannot represent
  explicit Polyhedron(std::span<const Vector> vertices);
  /// The same of points that have the rounding of a file, such as 6 decimals. Triangles whose corners lie in one plane within
  /// HullTolerance::rounded times this rounding form one face, and the vertices are moved by up to that length so that the
  /// faces are planes. Without this, most faces of a turned cube are two triangles. If there are no such vertices, or if
  /// the shape is as thin as the tolerance, the result is that without rounding.
  /// @param rounding largest error of a coordinate [m], >= 0: half a unit of the last digit
  /// @throws std::invalid_argument as above, or if the rounding is not finite or negative
  Polyhedron(std::span<const Vector> vertices, T rounding);
  /// The convex hull of a list of points: Polyhedron<double>({{0, 0, 0}, {1, 0, 0}, ..}).
  explicit Polyhedron(std::initializer_list<VectorArgument<Space>> vertices)
      : Polyhedron(std::span<const Vector>(std::vector<Vector>(vertices.begin(), vertices.end()))) {
  }

  /// A polyhedron from its vertices and faces.
  /// @param vertices N points, in any frame [m]
  /// @param faces    F cyclic lists of vertex indices, counter-clockwise seen from outside
  /// @throws std::invalid_argument unless all of these hold: there are at least 4 vertices; they
  ///                               are finite; each vertex belongs to at least 3 faces; each edge
  ///                               belongs to two faces, once in each direction; the surface is one
  ///                               piece without handles; each face is planar and has all other
  ///                               vertices strictly below it, so that coplanar neighbours must be
  ///                               one face; the scalar type can represent the moments
  static Polyhedron from_faces(std::span<const Vector> vertices,
                               std::span<const std::vector<std::uint32_t>> faces);

  std::size_t face_count() const { return topology_.faces.size(); }  ///< F
  std::size_t edge_count() const { return topology_.edges.size(); }  ///< N + F - 2
  /// Number of triangles of the surface if every face is divided into triangles: 2 N - 4.
  std::size_t triangle_count() const { return 2 * vertex_count() - 4; }

  /// The vertices of face f, for f < face_count(), counter-clockwise seen from outside.
  std::span<const std::uint32_t> face(std::size_t f) const { return topology_.faces[f]; }
  /// The edges of face f, for f < face_count(). Edge k joins face(f)[k] and face(f)[k + 1].
  std::span<const std::uint32_t> face_edges(std::size_t f) const { return topology_.face_edges[f]; }
  std::span<const Edge> edges() const { return topology_.edges; }  ///< all edges, each listed once
  /// The faces at vertex v, for v < vertex_count(), in ascending order.
  std::span<const std::uint32_t> vertex_faces(std::size_t v) const {
    return topology_.vertex_faces[v];
  }
  /// The edges at vertex v, for v < vertex_count(), in ascending order.
  std::span<const std::uint32_t> vertex_edges(std::size_t v) const {
    return topology_.vertex_edges[v];
  }

  /// Begins to load the incidences of vertices, edges and faces into the cache.
  void prefetch() const { topology_.prefetch(); }

  /// The same polyhedron with all lengths multiplied by `factor` [-], > 0.
  /// @throws std::invalid_argument unless the factor and the new moments are finite and greater
  ///                               than zero
  [[nodiscard]] Polyhedron scaled(T factor) const;

 private:
  friend struct SerializationAccess;
  using Base::vertices_, Base::face_normals_, Base::face_offsets_;
  Polyhedron() = default;
  auto serialized_members() { return std::tuple_cat(std::tie(topology_), Base::members()); }
  /// Computes the edges and the incidences from the faces that were read, and checks the number of
  /// planes.
  void deserialized() {
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::size_t f = 0; f < topology_.faces.size(); ++f)
      faces.emplace_back(topology_.faces[f].begin(), topology_.faces[f].end());
    topology_ = FaceTopology(vertex_count(), faces, "Polyhedron");
    const auto count = static_cast<Eigen::Index>(faces.size());
    require(face_normals_.rows() == count && face_offsets_.size() == count, "Polyhedron", "faces",
            count, "must each have a plane");
  }

  Vector vertex(std::size_t i) const {
    return row_of<Space>(vertices_, static_cast<Eigen::Index>(i));
  }

  /// Returns the vertices that occur in a face, in their order, and replaces the indices in the
  /// faces by indices into this result.
  static std::vector<Vector> drop_unused(std::span<const Vector> vertices,
                                         std::vector<std::vector<std::uint32_t>>& faces) {
    constexpr std::uint32_t unused = ~0U;
    std::vector<std::uint32_t> renamed(vertices.size(), unused);
    for (const auto& face : faces) {
      for (const std::uint32_t v : face) renamed[v] = 0;
    }
    std::vector<Vector> kept;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      if (renamed[v] == unused) continue;
      renamed[v] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(vertices[v]);
    }
    for (auto& face : faces) {
      for (std::uint32_t& v : face) v = renamed[v];
    }
    return kept;
  }

  void build(std::span<const Vector> vertices, std::span<const std::vector<std::uint32_t>> faces,
             std::string_view function);

  Moments<Space> sum_moments() const {
    Moments<Space> sum;
    for (std::size_t f = 0; f < face_count(); ++f) {
      const auto loop = face(f);
      for (std::size_t k = 2; k < loop.size(); ++k) {
        typename Space::Matrix corners;
        corners.col(0) = vertex(loop[0]);
        corners.col(1) = vertex(loop[k - 1]);
        corners.col(2) = vertex(loop[k]);
        sum.add_simplex(corners);
      }
    }
    return sum;
  }

  /// Computes in long double, because the area of a sliver is a small difference of large products.
  void set_planes() {
    using detail::LongVector;
    face_normals_.resize(static_cast<Eigen::Index>(face_count()), 3);
    face_offsets_.resize(face_normals_.rows());
    for (std::size_t f = 0; f < face_count(); ++f) {
      const auto row = static_cast<Eigen::Index>(f);
      const auto plane = face_plane<LongVector>(face(f).size(), [&](std::size_t k) {
        const Vector v = vertex(face(f)[k]);
        return LongVector{v[0], v[1], v[2]};
      });
      face_normals_(row, 0) = static_cast<T>(plane.normal.x);
      face_normals_(row, 1) = static_cast<T>(plane.normal.y);
      face_normals_(row, 2) = static_cast<T>(plane.normal.z);
      face_offsets_[row] = static_cast<T>(plane.normal.dot(plane.center));
    }
    this->summarize_faces();
  }

  /// Requires that each vertex lies on the planes of its own faces, and strictly below the planes
  /// of all other faces, within the rounding errors of the input. All faces are compared with all vertices
  /// only to name an error.
  void require_convex(std::span<const Vector> input, std::string_view function) const {
    T size = 0;
    for (const Vector& x : input) size = std::max(size, x.cwiseAbs().maxCoeff());
    const T flat = static_cast<T>(HullTolerance{}.flat) * std::numeric_limits<T>::epsilon() * size;
    if (is_convex(flat)) return;
    for (std::size_t f = 0; f < face_count(); ++f) {
      std::size_t bad = vertex_count();
      for (const std::uint32_t v : face(f))
        if (!(std::abs(height(v, f)) <= flat)) bad = std::min(bad, std::size_t(v));
      for (std::size_t v = 0; v < bad; ++v)
        if (!(height(v, f) < -flat) && !is_of_face(v, f)) bad = v;
      if (bad == vertex_count()) continue;
      const std::string what =
          "height of vertices[" + std::to_string(bad) + "] above faces[" + std::to_string(f) + "]";
      require(!is_of_face(bad, f), function, what, height(bad, f), "m must be 0: planar faces");
      require(false, function, what, height(bad, f),
              "m must be negative: convex, coplanar neighbours joined");
    }
  }
  bool is_of_face(std::size_t v, std::size_t f) const {
    return std::binary_search(vertex_faces(v).begin(), vertex_faces(v).end(),
                              static_cast<std::uint32_t>(f));
  }
  bool is_convex(T flat) const { return is_locally_convex(flat) && surrounds_origin_once(); }
  /// Whether the vertices of each face lie on its plane, and the vertices that edges join to them
  /// strictly below it.
  bool is_locally_convex(T flat) const {
    for (std::size_t f = 0; f < face_count(); ++f)
      for (const std::uint32_t v : face(f)) {
        if (!(std::abs(height(v, f)) <= flat)) return false;
        for (const std::uint32_t e : vertex_edges(v)) {
          const auto& ends = edges()[e].vertex;
          const std::uint32_t other = ends[0] == v ? ends[1] : ends[0];
          if (!(height(other, f) < -flat) && !is_of_face(other, f)) return false;
        }
      }
    return true;
  }
  /// Whether the origin lies below all faces, and the solid angles of the faces, seen from there, have the
  /// sum 4 pi. A closed surface that is locally convex is then convex (K. Mehlhorn et al., Comput. Geom. 12
  /// (1999) 85); star polyhedra surround their centre several times. The solid angle of a triangle is that of A. van
  /// Oosterom and J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125.
  bool surrounds_origin_once() const {
    double angle = 0;
    for (std::size_t f = 0; f < face_count(); ++f) {
      if (!(face_offsets_[static_cast<Eigen::Index>(f)] > T(0))) return false;
      const auto loop = face(f);
      const auto corner = [&](std::size_t k) -> Eigen::Vector3d {
        return vertex(loop[k]).template cast<double>().normalized();
      };
      const Eigen::Vector3d a = corner(0);
      for (std::size_t k = 2; k < loop.size(); ++k) {
        const Eigen::Vector3d b = corner(k - 1), c = corner(k);
        angle += 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
      }
    }
    return std::abs(angle / (4 * std::numbers::pi) - 1) < 0.5;
  }
  /// Height of vertex v above the plane of face f [m].
  T height(std::size_t v, std::size_t f) const {
    const auto row = static_cast<Eigen::Index>(f);
    return face_normals_.row(row).dot(vertices_.row(static_cast<Eigen::Index>(v))) -
           face_offsets_[row];
  }

  FaceTopology topology_;
};

// Defined outside of the class, so that they are compiled only once where a program declares the
// class extern.
template <std::floating_point T>
Polyhedron<T>::Polyhedron(std::span<const Vector> vertices) {
  auto faces = convex_hull(vertices, "Polyhedron");
  const std::vector<Vector> kept = drop_unused(vertices, faces);
  build(kept, faces, "Polyhedron");
}

template <std::floating_point T>
Polyhedron<T>::Polyhedron(std::span<const Vector> vertices, T rounding) : Polyhedron(vertices) {
  detail::require_rounding(rounding, "Polyhedron");
  const T flat = T(HullTolerance{}.rounded) * rounding;
  if (!(flat > 0) || !(this->inradius() > 2 * flat)) return;
  auto faces = convex_hull(vertices, "Polyhedron", double(rounding));
  if (faces.size() == face_count()) return;
  const std::vector<Vector> kept = drop_unused(vertices, faces);
  std::vector<Eigen::Vector3d> points;
  for (const Vector& x : kept) points.push_back((x - kept[0]).template cast<double>());
  if (!detail::flatten_faces(faces, points, 2 * double(flat))) return;
  Polyhedron flattened;
  std::vector<Vector> moved;
  T size = 0;
  for (const Eigen::Vector3d& x : points) {
    moved.push_back(x.template cast<T>());
    size = std::max(size, moved.back().cwiseAbs().maxCoeff());
  }
  flattened.build(moved, faces, "Polyhedron");
  detail::InputFrame::move_by(flattened, kept[0]);
  if (flattened.is_convex(T(HullTolerance{}.flat) * std::numeric_limits<T>::epsilon() * size))
    *this = std::move(flattened);
}

template <std::floating_point T>
Polyhedron<T> Polyhedron<T>::from_faces(std::span<const Vector> vertices,
                                        std::span<const std::vector<std::uint32_t>> faces) {
  constexpr std::string_view function = "Polyhedron::from_faces";
  require(vertices.size() >= 4, function, "vertices.size()", vertices.size(), "must be at least 4");
  detail::require_finite(vertices, function);
  Polyhedron polyhedron;
  polyhedron.build(vertices, faces, function);
  polyhedron.require_convex(vertices, function);
  return polyhedron;
}

template <std::floating_point T>
Polyhedron<T> Polyhedron<T>::scaled(T factor) const {
  Polyhedron copy = *this;
  copy.scale(factor);
  return copy;
}

template <std::floating_point T>
void Polyhedron<T>::build(std::span<const Vector> vertices,
                          std::span<const std::vector<std::uint32_t>> faces,
                          std::string_view function) {
  topology_ = FaceTopology(vertices.size(), faces, function);
  vertices_.resize(static_cast<Eigen::Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (int k = 0; k < 3; ++k)
      vertices_(static_cast<Eigen::Index>(i), k) = vertices[i][k] - vertices[0][k];
  }
  const Moments<Space> rough = sum_moments();
  require(std::isfinite(rough.volume), function, "volume", rough.volume, "m^3 must be finite");
  require(rough.volume > T(0), function, "volume", rough.volume,
          "m^3 must be positive: faces run counter-clockwise seen from outside");
  this->move_origin(rough, vertices[0]);
  this->set_moments(sum_moments(), function);
  set_planes();
}

}  // namespace moreau
