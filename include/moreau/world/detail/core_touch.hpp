// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "moreau/contact/contact.hpp"
#include "moreau/core/compiler.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/world/detail/assembly.hpp"
#include "moreau/world/detail/grain_core.hpp"

namespace moreau::detail {

/// How the two bodies of a contact touch, by the cores of the grains (grain_core.hpp). One of the bodies, the wall, is a
/// half-space, a mesh wall or a grain whose rotation is prescribed.
template <class ShapeT>
struct CoreTouch {
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  static constexpr bool has_sides = has_straight_sides<moreau::PartOf<ShapeT>>;

  CoreFeature<Vector> feature_a, feature_b;
  Vector core_a, core_b;          ///< from the core of the body to the contact point [m]
  Scalar rounding_a, rounding_b;  ///< see rounding_of() [m]
  bool wall_is_a;
  bool has_face, owner_is_a;  ///< whether a face makes the contact, and whose
  bool side_is_a;             ///< whose side is followed: that of the wall, if both have one
  Scalar rounding_of_grain() const { return wall_is_a ? rounding_b : rounding_a; }
  Scalar rounding_of_wall() const { return wall_is_a ? rounding_a : rounding_b; }
  bool has_side() const { return !feature_a.side.isZero(0) || !feature_b.side.isZero(0); }
  bool has_two_sides() const { return !feature_a.side.isZero(0) && !feature_b.side.isZero(0); }

  /// Of a contact of the bodies at their present poses.
  MOREAU_INLINED static CoreTouch of(const Assembly<ShapeT>& assembly, const Contact<S>& contact,
                                     const ContactKey& key) {
    using Kind = FeatureKey::Kind;
    const std::uint32_t a = contact.a, b = contact.b;
    const Vector normal = contact.frame.col(0);
    const auto kind = key.feature.kind();
    CoreTouch touch;
    if constexpr (has_sides) {
      touch.feature_a = feature_of(assembly, a, key.part_a,
                                   kind == Kind::edge_edge || kind == Kind::edge_vertex, normal);
      touch.feature_b = feature_of(assembly, b, key.part_b,
                                   kind == Kind::edge_edge || kind == Kind::vertex_edge, -normal);
    }
    touch.core_a = from_core(assembly, a, key.part_a, normal, contact.lever_a, contact.gap);
    touch.core_b = from_core(assembly, b, key.part_b, -normal, contact.lever_b, contact.gap);
    touch.rounding_a = rounding_of(assembly, a, key.part_a, normal);
    touch.rounding_b = rounding_of(assembly, b, key.part_b, -normal);
    touch.wall_is_a = !assembly.bodies().rotates(a);
    const auto face_of_b = vertex_on_face(S{});
    const auto face_of_a = FeatureKey(face_of_b, 0, 0).swapped().kind();
    const bool face_a = touch.feature_a.is_known ? touch.feature_a.is_face : kind == face_of_a,
               face_b = touch.feature_b.is_known ? touch.feature_b.is_face : kind == face_of_b;
    // A contact without a face has that of the wall, unless the features that touch are known.
    const Scalar of_wall = touch.rounding_of_wall();
    const bool is_grain = assembly.bodies().grain_mass[touch.wall_is_a ? a : b] > 0;
    touch.has_face = face_a || face_b || of_wall < 0 || !is_grain ||
                     (of_wall == 0 && !(touch.rounding_of_grain() > 0) && !touch.has_two_sides());
    touch.owner_is_a =
        face_a != face_b ? face_a : kind == face_of_a || (kind != face_of_b && touch.wall_is_a);
    touch.side_is_a =
        touch.wall_is_a ? !touch.feature_a.side.isZero(0) : touch.feature_b.side.isZero(0);
    return touch;
  }

  /// Whether a part of a body is a ball.
  static bool is_ball(const Assembly<ShapeT>& assembly, std::size_t body,
                      [[maybe_unused]] std::size_t part) {
    const Bodies<S>& bodies = assembly.bodies();
    if (!(bodies.grain_mass[body] > 0)) return false;
    const ShapeT& shape = assembly.shape_of(bodies.id[body]);
    if constexpr (CompoundShape<ShapeT>)
      return core_is_point(shape.parts()[part].shape);
    else
      return core_is_point(shape);
  }
  /// Whether a body is a ball, or has one.
  static bool has_ball(const Assembly<ShapeT>& assembly, std::size_t body) {
    std::size_t parts = 1;
    if constexpr (CompoundShape<ShapeT>)
      if (assembly.bodies().grain_mass[body] > 0)
        parts = assembly.shape_of(assembly.bodies().id[body]).parts().size();
    for (std::size_t part = 0; part < parts; ++part)
      if (is_ball(assembly, body, part)) return true;
    return false;
  }
  /// Radius of the rounding of a body [m]; 0 for a wall; < 0 if it is not known.
  /// @param part    of the body
  /// @param outward unit, in which the body is touched, world axes
  static Scalar rounding_of(const Assembly<ShapeT>& assembly, std::uint32_t body,
                            [[maybe_unused]] std::uint32_t part, const Vector& outward) {
    const Bodies<S>& bodies = assembly.bodies();
    if (!(bodies.grain_mass[body] > 0)) return 0;
    const ShapeT& shape = assembly.shape_of(bodies.id[body]);
    const Vector local = bodies.pose[body].rotation.inverse() * outward;
    if constexpr (CompoundShape<ShapeT>)
      return core_rounding(shape.parts()[part].shape,
                           Vector(shape.parts()[part].pose.rotation.inverse() * local));
    else
      return core_rounding(shape, local);
  }
  /// From the point of the core of a body to the contact point [m]; of a grain that moves and whose core is not known
  /// the whole lever.
  /// @param part    of the body
  /// @param outward unit normal out of the body
  /// @param lever   from the centre of the body to the contact point [m]
  [[gnu::cold, gnu::noinline]] static Vector from_core(const Assembly<ShapeT>& assembly,
                                                       std::uint32_t body, std::uint32_t part,
                                                       const Vector& outward, const Vector& lever,
                                                       Scalar gap) {
    const Scalar radius = rounding_of(assembly, body, part, outward);
    if (radius < 0 && assembly.bodies().rotates(body)) return lever;
    return (std::max(Scalar(0), radius) + gap / 2) * outward;
  }
  /// How a body is touched; its side in world axes.
  [[gnu::cold, gnu::noinline]] static CoreFeature<Vector> feature_of(
      const Assembly<ShapeT>& assembly, std::uint32_t body, [[maybe_unused]] std::uint32_t part,
      bool is_edge, const Vector& outward) {
    CoreFeature<Vector> feature;
    const Bodies<S>& bodies = assembly.bodies();
    if (!(bodies.grain_mass[body] > 0)) return feature;
    const ShapeT& shape = assembly.shape_of(bodies.id[body]);
    if constexpr (CompoundShape<ShapeT>) {
      const auto rotation = bodies.pose[body].rotation * shape.parts()[part].pose.rotation;
      feature =
          core_feature(shape.parts()[part].shape, is_edge, Vector(rotation.inverse() * outward));
      feature.side = rotation * feature.side;
    } else {
      const auto& rotation = bodies.pose[body].rotation;
      feature = core_feature(shape, is_edge, Vector(rotation.inverse() * outward));
      feature.side = rotation * feature.side;
    }
    return feature;
  }
};

}  // namespace moreau::detail
