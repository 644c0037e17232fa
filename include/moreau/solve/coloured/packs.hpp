// SPDX-License-Identifier: MIT
// Contact points and pairs of bodies, one per SIMD lane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "moreau/law/concepts.hpp"
#include "moreau/law/lane_block.hpp"
#include "moreau/law/law_lanes.hpp"
#include "moreau/solve/body_chunks.hpp"

namespace moreau::detail {

/// The compliance of one contact per lane; nothing for rigid contacts.
template <class Vector, bool Compliant>
struct PackedCompliance {};
template <class Vector>
struct PackedCompliance<Vector, true> {
  Vector compliance{};  ///< diagonal of D, see BodyDelassus
};

/// The effective radius of one contact per lane, see effective_radius(); nothing for contacts without
/// couples.
template <class Values, bool HasCouples>
struct PackedRadius {};
template <class Values>
struct PackedRadius<Values, true> {
  Values radius{};  ///< [m]
};

/// One contact point per lane. Unused lanes have a zero frame and a free velocity that separates.
template <class S, class Law>
struct PointPack : PackedCompliance<typename LaneBlockOf<Law, S>::Vector, CompliantLaw<Law, S>>,
                   PackedRadius<typename LaneBlock<S>::Values, Rolls<Law>> {
  using Block = LaneBlockOf<Law, S>;
  using Values = typename LaneBlock<S>::Values;
  using Vector = typename LaneBlock<S>::Vector;
  using Row = typename Block::Vector;  ///< D numbers, or D + A with the couple / R

  std::array<Vector, S::dim> frame{};  ///< first index: world axis, second: axis of the frame
  Vector lever_a{}, lever_b{};         ///< world axes [m]
  Block block = Block::unit();
  Row free{Values{} + 1};
  LawLanes<Law, S> law{};
  Row impulse{}, before{};  ///< after the last visit and the visit before
};

/// Which body of its pairs is the hub of a group (solve/hub_share.hpp): the body that all its lanes share.
enum class Hub : std::uint8_t { none, a, b };

/// A group: one pair per lane. No two pairs share a body that can move, except the hub.
template <int Lanes>
struct PairGroup {
  std::uint32_t first, count;  ///< PointPacks
  std::uint32_t active;        ///< number of them, from the first, that the active set contains
  /// Colour; FirstFitColouring::colours or more for groups of a hub that form a phase. Groups of one
  /// phase are visited in any order; those inside a chunk of bodies in the order of their phases.
  std::uint32_t phase;
  static constexpr std::uint32_t serial = std::numeric_limits<std::uint32_t>::max();  ///< no phase
  std::uint32_t chunk;  ///< that all bodies of the group belong to, or `shared`
  static constexpr std::uint32_t shared = BodyChunks::shared;
  Hub hub;
  bool is_simple;          ///< neither a hub nor a cell that moves by its stress
  std::uint32_t matrices;  ///< index into ContactGroups::mass_matrices; isotropic: none is needed
  static constexpr std::uint32_t isotropic = std::numeric_limits<std::uint32_t>::max();

  /// Whether the hub is changed after the phase, not by the group.
  bool delays_hub() const { return hub != Hub::none && phase != serial; }
  std::array<std::uint32_t, static_cast<std::size_t>(Lanes)> a, b;  ///< numbers of LaneVelocities
};

}  // namespace moreau::detail
