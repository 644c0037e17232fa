// SPDX-License-Identifier: MIT
// A block that topples or rocks about its edges.
#pragma once

#include <numbers>

#include "scene.hpp"

namespace validation {

namespace detail {

/// Half the base and half the height of the blocks [m].
constexpr double half_base = 0.03, half_height = 0.05;

template <class ShapeT>
ShapeT block() {
  using Vector = typename SpaceOf<ShapeT>::Vector;
  Vector half = Vector::Constant(half_base);
  half[SpaceOf<ShapeT>::dim - 1] = half_height;
  return cuboid<ShapeT>(half);
}

/// Whether a block on a tilted floor rotates by more than one degree within a second. It starts at
/// rest. The angle grows as exp(t sqrt(3 g/4 R)), by a factor of 1e4 and more.
template <class ShapeT>
bool tips(double tilt) {
  OnFloor<ShapeT> scene(block<ShapeT>(), half_height, Coulomb<ShapeT>(1), tilt);
  scene.world.set_contact_points(moreau::ContactPoints::all);
  double turned = 0;
  while (scene.world.time() < 1 && turned < 0.02) {
    scene.world.step(1e-3);
    turned += 1e-3 * scene.spin();
  }
  return turned >= 0.02;
}

/// Ratio of the angular velocities after and before the moment at which a block that rocks about
/// its left edge lands on its base.
template <class ShapeT>
double housner() {
  using S = SpaceOf<ShapeT>;
  const double h = 1e-3, spin = 1;
  const auto velocity = in_plane<S>(half_height * spin, -half_base * spin);  // clockwise
  // At the next detection, half a step later, the block lies flat on the floor.
  const Pose<S> pose{in_plane<S>(0, half_height) - h / 2 * velocity, S::exp(turn<S>(h / 2 * spin))};
  OnFloor<ShapeT> scene(block<ShapeT>(), pose, Coulomb<ShapeT>(10));
  scene.world.set_contact_points(moreau::ContactPoints::all);
  scene.world.set_gravity(S::Vector::Zero());
  scene.world.set_velocity(scene.grain, velocity);
  scene.world.set_spin(scene.grain, turn<S>(-spin));
  scene.world.step(h);
  return scene.twist().template tail<S::angular_dim>().dot(turn<S>(-1)) / spin;
}

}  // namespace detail

/// A block of base b and height h on an incline with mu > b/h topples iff tan(tilt) > b/h.
template <class ShapeT>
void toppling(Record& record) {
  const double exact = std::atan(detail::half_base / detail::half_height),
               degree = std::numbers::pi / 180;
  const double found = threshold(exact - degree, exact + degree, 7, detail::tips<ShapeT>);
  record.compare(with_shape<ShapeT>("toppling block") + ": tips from [degrees]", SpaceOf<ShapeT>{},
                 exact / degree, found / degree, 0.05);
}

/// A block that rocks from one edge to the other without a bounce keeps the share 1 - 3/2
/// sin^2(alpha) of its angular velocity, tan(alpha) = b/h (G. W. Housner, Bull. Seismol. Soc. Am.
/// 53 (1963) 403).
template <class ShapeT>
void rocking(Record& record) {
  const double sine = std::sin(std::atan(detail::half_base / detail::half_height));
  record.compare(with_shape<ShapeT>("rocking block") + ": spin after over before",
                 SpaceOf<ShapeT>{}, 1 - 1.5 * sine * sine, detail::housner<ShapeT>(), 1e-6);
}

template <class T>
void toppling_block(Record& record, Effort) {
  toppling<Polyhedron<T>>(record);
  toppling<Polygon<T>>(record);
}

template <class T>
void rocking_block(Record& record, Effort) {
  rocking<Polyhedron<T>>(record);
  rocking<Polygon<T>>(record);
}

}  // namespace validation
