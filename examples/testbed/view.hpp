// SPDX-License-Identifier: MIT
// What a scene shows: buffers of plain numbers, the same for the plane and for space.
//
// Data flow, from the scene to the screen:
//
//   once per scene   Mesh (triangles of each base shape), Placement (base shape and size of each
//                    grain), Wall and PlotSpec
//   once per step    one row of plot values is added to `samples`
//   once per frame   Scene::write_frame() fills `poses`, `colours`, `walls`, `segments`. The web
//                    layer (web/exports.cpp) hands out pointers to these buffers. The worker
//                    (web/worker.js) copies them into transferable arrays and empties `samples`. The
//                    page (web/view.js, web/plots.js) draws them and sends the arrays back.
//
// The page draws in space with z up. The plane is drawn as the plane y = 0: (x, y) becomes (x, 0, z).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "moreau/core/space.hpp"
#include "moreau/mesh/surface_mesh.hpp"

namespace testbed {

using Floats = std::vector<float>;

inline void push(Floats& to, const moreau::Space<3>::Vector& x) {
  for (int k = 0; k < 3; ++k) to.push_back(static_cast<float>(x[k]));
}
inline void push(Floats& to, const moreau::Space<2>::Vector& x) {
  push(to, moreau::Space<3>::Vector(x[0], 0, x[1]));
}
/// A rotation as a quaternion x, y, z, w.
inline void push(Floats& to, const moreau::Space<3>::Rotation& q) {
  for (const double part : {q.x(), q.y(), q.z(), q.w()}) to.push_back(static_cast<float>(part));
}
/// In the plane y = 0 of space, a rotation from x to z turns about -y.
inline void push(Floats& to, const moreau::Space<2>::Rotation& q) {
  const double half = q.angle() / 2;
  push(to, moreau::Space<3>::Rotation(std::cos(half), 0, -std::sin(half), 0));
}
/// The point of the scene at a point of the page.
template <class Vector>
Vector from_page(const std::array<double, 3>& x) {
  Vector v;
  v[0] = x[0];
  for (int k = 1; k < Vector::RowsAtCompileTime; ++k)
    v[k] = x[std::size_t(k + 3 - Vector::RowsAtCompileTime)];
  return v;
}

/// The surface of a base shape of circumradius 1 or, in the arch, of its own size.
struct Mesh {
  Floats
      triangles;  ///< 9 numbers per triangle, counter-clockwise seen from outside; in the plane from -y
  Floats outline;  ///< 6 numbers per segment: the edges of all faces
  bool is_round = false;
};

/// Fills the triangles of a mesh: fans of its faces.
template <class S>
void triangulate(const moreau::SurfaceMesh<S>& surface, Mesh& mesh) {
  std::size_t begin = 0;
  for (const std::int32_t end : surface.ends) {
    const auto corner = [&](std::size_t k) -> const auto& {
      return surface.points[std::size_t(surface.corners[k])];
    };
    const auto last = static_cast<std::size_t>(end);
    for (std::size_t k = begin + 1; k + 1 < last; ++k) {
      push(mesh.triangles, corner(begin));
      push(mesh.triangles, corner(k));
      push(mesh.triangles, corner(k + 1));
    }
    for (std::size_t k = begin; k < last; ++k) {
      push(mesh.outline, corner(k));
      push(mesh.outline, corner(k + 1 < last ? k + 1 : begin));
    }
    begin = last;
  }
}

/// The base shape and the size of a grain.
struct Placement {
  std::uint32_t mesh;
  float scale;
};

/// A quantity that every step records.
struct Channel {
  const char* key;
  const char* label;
  const char* unit;
  double factor;  ///< the plot shows the value times this
};

/// A plot of one or two channels over another.
struct PlotSpec {
  const char* title;
  int x, y, y2;      ///< channels; y2 = -1: none
  bool logarithmic;  ///< the axis of y2, or of y if there is none
  bool is_path;      ///< y over x as a curve that may turn back, not a function of x
};

/// Numbers per element of the buffers.
inline constexpr std::size_t pose_width = 7;    ///< position, quaternion x y z w
inline constexpr std::size_t colour_width = 3;  ///< speed [m/s], force [N], residual [m/s]
inline constexpr std::size_t wall_width =
    8;  ///< kind, centre, half lengths (or radius, half depth, angle), moves
inline constexpr std::size_t segment_width =
    14;  ///< from, to, point, normal force [N], whether it slides, unit normal

/// The buffers of a frame. They keep their memory.
struct Frame {
  Floats poses;    ///< of all grains
  Floats colours;  ///< of all grains
  Floats walls;
  Floats segments;  ///< of all contact points with a force

  void clear() {
    poses.clear();
    colours.clear();
    walls.clear();
    segments.clear();
  }
};

/// Stages of a step whose times Status::ms has.
inline constexpr std::array<const char*, 6> stages{{"broad phase and placing", "contact points",
                                                    "operator and warm start", "contact solver",
                                                    "overlaps", "whole step"}};

/// How the last step went, for the line below the picture.
struct Status {
  double time = 0;         ///< [s]
  std::size_t points = 0;  ///< contact points
  std::size_t capped = 0;  ///< steps, since the scene began, that ended with most sweeps
  double hand = 0;         ///< force with which the hand pulls [N]
  bool can_act = true;     ///< whether the button of the scene has an effect
  double mass = 0;         ///< of the grains [kg]
  double paths_from = 0;   ///< a plot that is a path shows the steps from this time on [s]
  std::array<double, stages.size()> ms{};  ///< of the last step [ms]
  std::size_t version = 0;                 ///< increases when grains are added or removed
  std::string hash;                        ///< of the state, 16 hexadecimal digits
  std::string fault;   ///< a clause, if the state was one that grains cannot have
  std::string stage;   ///< of the scene, e.g. "packing"
  std::string advice;  ///< sentences of moreau::check() on the last step
};

}  // namespace testbed
