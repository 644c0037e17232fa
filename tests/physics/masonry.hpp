// SPDX-License-Identifier: MIT
// Structures of dry blocks on a floor. They are defined in the vertical plane and extruded in
// space.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

namespace masonry {

using Point = std::array<double, 2>;  ///< horizontal and vertical coordinate [m]

constexpr double gravity = 9.81, density = 1000, tolerance = 1e-8;

inline moreau::ColouredOptions tight(int max_sweeps = 10000) {
  moreau::ColouredOptions options;
  options.tolerance = tolerance;
  options.max_sweeps = max_sweeps;
  return options;
}

/// @tparam Solver solver of the contact problem
template <class ShapeT, class Solver = moreau::ColouredGaussSeidel>
struct Structure {
  using S = moreau::SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Law = moreau::SignoriniCoulomb<Scalar>;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;

  moreau::Simulation<ShapeT, Law, moreau::MoreauJean, moreau::CellGrid<S>, Solver> simulation;
  double depth;            ///< extent of the blocks perpendicular to the plane [m]
  double joint = 1e9;      ///< smallest width of a joint [m]
  double diameter = 0;     ///< diameter of the structure [m]
  std::size_t joints = 1;  ///< each block is connected to the floor through at most this many
                           ///< joints

  /// @param size        size of a block [m]
  /// @param prism_depth extent of the blocks perpendicular to the plane [m]
  /// @param tilt        angle of the floor to the horizontal [rad]
  Structure(double size, double friction, double prism_depth, double tilt = 0)
      : simulation(Scalar(size), moreau::Materials<Law>(1, Law(Scalar(friction))), Solver(tight())),
        depth(prism_depth) {
    // With three of the four contact points of a rectangle, the centre of pressure would lie on a
    // side of their triangle, and the block would rock.
    simulation.set_contact_points(moreau::ContactPoints::all);
    simulation.add_wall(Vector::Unit(up), Vector::Zero());
    simulation.set_gravity(Scalar(gravity * std::sin(tilt)) * Vector::UnitX() -
                           Scalar(gravity * std::cos(tilt)) * Vector::Unit(up));
  }

  /// Adds a block with the given corners in the plane, in any order.
  void add(const std::vector<Point>& corners) {
    std::vector<Vector> vertices;
    for (const auto& [across, height] : corners)
      for (const double side : {-depth / 2, depth / 2}) {
        Vector x = Vector::Zero();
        x[1] = Scalar(side);
        x[0] = Scalar(across);
        x[up] = Scalar(height);
        if (S::dim == 3 || side > 0) vertices.push_back(x);
      }
    const ShapeT shape(vertices);
    moreau::Pose<S> pose;
    pose.position = shape.centroid_of_input();
    simulation.add_grain(simulation.add_shape(shape), pose, Scalar(density));
  }
  void add_box(double left, double bottom, double width, double height) {
    add({{left, bottom},
         {left + width, bottom},
         {left, bottom + height},
         {left + width, bottom + height}});
  }

  /// The positions of all vertices of all blocks, world axes [m].
  std::vector<Vector> vertices() const {
    std::vector<Vector> all;
    for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
      const auto& pose = simulation.pose(simulation.grain(k));
      for (const auto& row : simulation.shape_of_grain(k).vertices().rowwise())
        all.push_back(pose(Vector(row.transpose())));
    }
    return all;
  }
  double mass() const {
    double sum = 0;
    for (const double weight : simulation.bodies().grain_mass) sum += weight;
    return sum;
  }
  /// The velocity to which the residual of the last step is relative: |r| times the mean of the
  /// diagonal of W [m/s].
  double impulse_velocity() const {
    const auto& bodies = simulation.bodies();
    const auto& contacts = simulation.contacts();
    double trace = 0, squares = 0;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const auto& contact = contacts.points[c];
      squares += contacts.impulses[c].squaredNorm();
      const auto add = [&](std::size_t body, const Vector& lever) {
        const auto root = bodies.mobility_root(body);
        trace += root.linear.squaredNorm() + (S::lever(lever) * root.angular).squaredNorm();
      };
      add(contact.a, contact.lever_a);
      add(contact.b, contact.lever_b);
    }
    return std::sqrt(squares) * trace / double(S::dim * contacts.size());
  }
};

/// A column of boxes on a floor that is tilted by 0.01 rad. The resultant force leaves the base if
/// the tilt exceeds 1/count.
template <class ShapeT, class Solver = moreau::ColouredGaussSeidel>
Structure<ShapeT, Solver> column(int count) {
  Structure<ShapeT, Solver> structure(0.1, 0.5, 0.1, std::min(0.01, 0.4 / count));
  for (int k = 0; k < count; ++k) structure.add_box(-0.05, 0.1 * k, 0.1, 0.1);
  structure.joint = 0.1;
  structure.joints = std::size_t(count);
  structure.diameter = 0.1 * count;
  return structure;
}

/// Cubes of 1 cm on each other on a level floor.
/// @param jitter sideways displacements in units of the size, uniform in [-jitter, jitter]
/// @param ratio  density of every second cube from the second on, relative to that of the others
template <class ShapeT>
Structure<ShapeT> stack(int count, double friction, double jitter = 0, double ratio = 1) {
  constexpr double size = 0.01;
  using Scalar = typename Structure<ShapeT>::Scalar;
  using Vector = typename Structure<ShapeT>::Vector;
  Structure<ShapeT> structure(size, friction, size);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> aside(-jitter, jitter);
  const auto cube = structure.simulation.add_shape(moreau::regular_shape<ShapeT>(Scalar(size)));
  for (int k = 0; k < count; ++k) {
    moreau::Pose<typename Structure<ShapeT>::S> pose;
    pose.position = Vector::NullaryExpr([&] { return Scalar(size * aside(random)); });
    pose.position[structure.up] = Scalar(size * (k + 0.5));
    structure.simulation.add_grain(cube, pose, Scalar(k % 2 == 1 ? ratio * density : density));
  }
  structure.joint = size;
  structure.diameter = size * count;
  return structure;
}

/// Courses of bricks. Every second course is shifted by half a brick and completed by two half
/// bricks. All joints are dry. The floor is tilted along the wall by less than the friction angle.
template <class ShapeT, class Solver = moreau::ColouredGaussSeidel>
Structure<ShapeT, Solver> wall(int courses, int bricks) {
  constexpr double length = 0.2, height = 0.06;
  Structure<ShapeT, Solver> structure(height, 0.5, 0.1, 0.1);
  for (int course = 0; course < courses; ++course) {
    const double bottom = height * course;
    const bool shifted = course % 2 == 1;
    if (shifted) structure.add_box(0, bottom, length / 2, height);
    for (int k = 0; k < bricks - int(shifted); ++k)
      structure.add_box(length * (k + (shifted ? 0.5 : 0)), bottom, length, height);
    if (shifted) structure.add_box(length * (bricks - 0.5), bottom, length / 2, height);
  }
  structure.joint = length / 2;
  structure.joints = std::size_t(courses);
  structure.diameter = std::hypot(length * bricks, height * courses);
  return structure;
}

/// Tangent of the angle between a card and the vertical.
constexpr double card_lean = 0.36;

/// The friction coefficient that the lower storey of a card house needs, in the limit of thin
/// cards.
///
/// A leaning card of weight W carries the load Q at its top. The top is at the horizontal distance
/// a and at the height b from the base of the card. By symmetry the top transmits only a horizontal
/// thrust T. The moment about the base gives T b = W a/2 + Q a. The base carries W + Q. So mu >=
/// T/(W + Q) = (a/b)(W/2 + Q)/(W + Q). The four cards of the lower storey carry one level card and
/// one pair of cards, together 3 W. So Q = 3/4 W and mu >= 5/7 a/b. The upper storey, with Q = 0,
/// needs mu >= 1/2 a/b.
constexpr double card_friction = 5.0 / 7 * card_lean;

/// Adds a leaning card. It is cut horizontally at its base and its top, and vertically at the
/// ridge.
/// @param side -1 to the left of the ridge, 1 to the right
template <class ShapeT>
void add_card(Structure<ShapeT>& house, double ridge, double foot, double rise, double thickness,
              double side) {
  // The corners in order: along the lower face, the base, the upper face, the top and the vertical
  // cut.
  const double wide = thickness * std::hypot(1.0, card_lean);  // horizontal width of the card
  const double run = card_lean * rise;
  const double cut = wide / 2;  // horizontal width of the top
  const double plumb = (wide - cut) / card_lean;
  house.add({{ridge, foot + rise},
             {ridge + side * cut, foot + rise},
             {ridge + side * (cut + run), foot},
             {ridge + side * (cut + run - wide), foot},
             {ridge, foot + rise - plumb}});
}

/// A card house of two storeys: two pairs of cards, a level card across their ridges, and a pair of
/// cards on it.
template <class ShapeT>
Structure<ShapeT> card_house(double friction) {
  constexpr double rise = 1, thickness = 0.04;
  Structure<ShapeT> house(thickness, friction, 0.6);
  const double wide = thickness * std::hypot(1.0, card_lean);
  // Horizontal distance of the outer edge of the base from the ridge.
  const double foot = card_lean * rise + wide / 2;
  // Horizontal distance of an upper base from the upper ridge. A lower ridge lies below it.
  const double ridge = card_lean * rise;
  for (const double side : {-1.0, 1.0}) {
    for (const double lean : {-1.0, 1.0})
      add_card(house, side * (foot + 0.02), 0, rise, thickness, lean);
    add_card(house, 0, rise + thickness, rise, thickness, side);
  }
  house.add_box(-1.5 * ridge, rise, 3 * ridge, thickness);
  house.joint = wide / 2;
  house.joints = 5;
  house.diameter = 2.5;
  return house;
}

/// A semicircular arch of equal voussoirs on the floor, with the mean radius 1.
/// @param thickness relative to the mean radius; an arch stands if it is at least 0.1075 (M.
///                  Milankovitch, 1907)
template <class ShapeT>
Structure<ShapeT> arch(int voussoirs, double thickness) {
  Structure<ShapeT> structure(thickness, 0.7, 0.3);
  for (int k = 0; k < voussoirs; ++k) {
    std::vector<Point> corners;
    for (int end = 0; end < 2; ++end)
      for (const double radius : {1 - thickness / 2, 1 + thickness / 2}) {
        const double angle = std::numbers::pi * (k + end) / voussoirs;
        // sin(pi) is not exactly zero in floating point.
        const double height = k + end == voussoirs ? 0 : std::sin(angle);
        corners.push_back({-radius * std::cos(angle), radius * height});
      }
    structure.add(corners);
  }
  structure.joint = thickness;
  structure.joints = std::size_t(voussoirs + 1) / 2;
  structure.diameter = 2 + thickness;
  return structure;
}

}  // namespace masonry
