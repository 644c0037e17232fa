// SPDX-License-Identifier: MIT
// From poses to contacts:
//
//   1. place the shapes
//   2. find the pairs of grains; the list is kept over steps until a grain has moved by the skin
//   3. collide each pair
//   4. write its contact points to the list of the step
//   5. turn or remove contacts at internal edges (detail/internal_edges.hpp)
//
// All buffers are kept: there is no allocation once they are large enough. In a periodic cell poses
// are not wrapped: each pair has a shift by whole cells that moves its second grain next to its first.
// Grains do not jump, so the shift is valid for as long as the list of pairs (detail/near_pairs.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/periodic_cell.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/detect/broad_phase.hpp"
#include "moreau/detect/collide.hpp"
#include "moreau/detect/pairs/collide_cylinder_wall.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/shape/circumradius.hpp"
#include "moreau/shape/cylinder_wall.hpp"
#include "moreau/shape/half_space.hpp"
#include "moreau/world/detail/approach_bounds.hpp"
#include "moreau/world/detail/found_contacts.hpp"
#include "moreau/world/detail/internal_edges.hpp"
#include "moreau/world/detail/mesh_walls.hpp"
#include "moreau/world/detail/near_pairs.hpp"
#include "moreau/world/detail/state_access.hpp"
#include "moreau/world/detail/step_margins.hpp"
#include "moreau/world/detail/visit_order.hpp"
#include "moreau/world/tolerances.hpp"

namespace moreau {

/// Which points of a contact between two faces are used.
enum class ContactPoints {
  few,  ///< at most D of them, those of reduce(): fewer unknowns, but three points do not support the
        ///< whole face: it can start to spin when it lands, and springs gain energy
  all,  ///< all vertices of the contact polygon: the support is the whole face
};

/// Detects the contacts of a simulation. It checks the periodic cell; Simulation checks all other
/// arguments. Arrays of bodies are indexed by BodyId::index().
/// @tparam ShapeT      of the grains
/// @tparam BroadPhaseT a BroadPhase in the space of the shape
template <class ShapeT, class BroadPhaseT>
class ContactDetector {
 public:
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Adds a grain; the shape must outlive the detector. Grains are numbered in the order of their
  /// bodies.
  void add_grain(BodyId body, const ShapeT& shape);
  /// Removes grains, those of the bodies for which is_removed is not 0; keeps the other pairs.
  void remove_grains(std::span<const unsigned char> is_removed);
  /// Adds a plane wall. The shape of a wall, in body coordinates, is copied.
  void add_wall(BodyId body, const HalfSpace<S>& shape) {
    walls_.push_back({body, shape, Placed(shape)});
  }
  /// Adds a cylinder around the grains.
  void add_wall(BodyId body, const CylinderWall<S>& shape) {
    cylinders_.push_back({body, shape, Placed(shape)});
  }
  void add_wall(BodyId body, const MeshWall<S>& shape) { meshes_.add(body, shape); }  ///< a mesh
  /// Sets the cell; the next find_pairs() finds all pairs anew. Walls are checked where the last
  /// place_walls() put them.
  /// @throws std::invalid_argument in the name of the function if the cell is too short for the
  ///         grains, or a wall bounds a periodic axis
  void set_cell(const PeriodicCell<S>& cell, const DetectionLengths<Scalar>& lengths,
                const char* function) {
    cell.require_room(widest_ + around(lengths), function);
    for (const auto& wall : walls_) cell.require_along(wall.placed.normal(), function);
    for (const auto& wall : cylinders_) cell.require_around(wall.placed.axis(), function);
    near_.set_cell(cell);
  }
  const PeriodicCell<S>& cell() const { return near_.cell(); }  ///< open unless set
  /// Deforms a cell that is a lattice. The poses must be deformed by the same increment.
  void deform_cell(const typename S::Matrix& increment) { near_.deform_cell(increment); }
  /// Half the least width of a periodic cell with a grain of this shape [m].
  Scalar room_of(const ShapeT& shape, const DetectionLengths<Scalar>& lengths) const {
    return std::max(widest_, width(shape)) + around(lengths);
  }

  /// Moves grains and walls to the poses of their bodies and computes the boxes of the grains.
  /// @param poses    one per body
  /// @param shape_of k -> shape of grain k, in the order of their bodies
  template <class ShapeOf>
  void place(std::span<const Pose<S>> poses, ShapeOf&& shape_of) {
    if (!late_.empty()) insert_late();
    boxes_.resize(grains_.size());
    team_.share(grains_.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        if constexpr (prefetches) detail::prefetch_update(std::span(grains_), shape_of, k, end);
        place_one(grains_[k], boxes_[k], shape_of(k), poses);
      }
    });
    place_walls(poses);
  }
  /// Moves the walls to the poses of their bodies, one per body.
  void place_walls(std::span<const Pose<S>> poses) {
    for (auto& wall : walls_) wall.placed.update(wall.shape, poses[wall.body.index()]);
    for (auto& wall : cylinders_) wall.placed.update(wall.shape, poses[wall.body.index()]);
    meshes_.place(poses);
  }

  /// Sets the threads that share the work.
  void set_team(const Team& team) { team_ = team; }
  /// Sets which points of a contact between faces are used, from the next detect() on.
  void keep_points(ContactPoints points) { kept_points_ = points; }
  ContactPoints kept_points() const { return kept_points_; }  ///< all unless set

  /// Examines only the pairs for which keeps(a, b) of the indices of their bodies is true, from the next
  /// find_pairs() on.
  void set_filter(const auto& keeps) { near_.set_filter(keeps); }
  /// Makes the list of the pairs of grains whose boxes are closer than margin + 2 skin along every
  /// axis, sorted by the numbers of the bodies. It keeps the list of an earlier call as long as no
  /// box has moved by the skin since; grains without a pair may move farther (EnlargedBoxes). Call
  /// place() before.
  /// @param function the public function that the caller of the library called, for error messages
  /// @throws std::invalid_argument if a cell that deforms is too short for the grains
  void find_pairs(const DetectionLengths<Scalar>& lengths,
                  const char* function = "Simulation::step");

  /// Leaves the pairs of bonds out of detect(), until the next find_pairs().
  /// @param bonds sorted by their bodies
  void leave_out(const auto& bonds) { margins_.leave_out(near_.pairs(), grains_, bonds); }
  /// Chooses the margin of each pair for the next detect(): the gap that it can close in a step, by the velocities
  /// of the bodies (detail/step_margins.hpp). Call find_pairs() before.
  /// @param step  h [s]
  /// @param share of the whole margin that each pair gets at least [-]
  void fit_margins(const DetectionLengths<Scalar>& lengths, const Bodies<S>& bodies, Scalar step,
                   double share);
  /// Gives all pairs the margin of the lengths, from the next detect() on; so it is unless fit_margins() is called.
  void use_whole_margin() { margins_.use_whole(); }
  bool has_fitted_margins() const { return margins_.are_fitted(); }  ///< of the last detect()
  /// Whether no pair approaches in a step by more than the margin of the last detect() for it, unless that is the
  /// margin of the lengths, and whether the least margins would have been enough. Call it only if has_fitted_margins().
  typename detail::StepMargins<S>::Sufficiency margins_suffice(
      const DetectionLengths<Scalar>& lengths, const Bodies<S>& bodies,
      const detail::StepMotion<S>& motion);

  /// Finds the contact points with a gap up to the margin, sorted by (a, b, parts, feature), with zero
  /// impulse, law and variant 0. Pairs of two bodies whose motion is prescribed have none: no impulse could
  /// change their relative velocity. Call find_pairs() before.
  /// @param bodies    with the poses that place() was given
  /// @param previous  contacts of the step before: where a contact between faces has more
  ///                  points than are kept, those of the step before are chosen first
  /// @param out       replaced
  template <int Rows>
  void detect(const DetectionLengths<Scalar>& lengths, const Bodies<S>& bodies,
              const Contacts<S, Rows>& previous, Contacts<S, Rows>& out) {
    detect_points(lengths, bodies, detail::PreviousContacts<S>(previous), out);
    out.impulses.assign(out.size(), Contacts<S, Rows>::Impulse::Zero());
    out.variants.assign(out.size(), 0);
  }

  /// Replaces grains and walls after their shapes have been read from a file; keeps the pairs.
  /// @param add_all adds grains and walls in the order in which they were added at first
  /// @throws std::invalid_argument if a pair is not of these grains
  void rebuild(auto&& add_all) {
    const bool stale = near_.is_stale();
    grains_.clear(), late_.clear(), spare_.clear();
    walls_.clear(), cylinders_.clear(), meshes_.clear();
    widest_ = 0;
    add_all();
    near_.set_stale(stale);
    order_.invalidate();
    require(near_.is_valid(grains_), "ContactDetector", "pairs", pair_count(),
            "must be of grains that exist");
  }

  /// Pairs of boxes, without walls.
  std::size_t pair_count() const { return near_.pairs().size(); }
  /// Pairs with at least one contact point in the last detect().
  std::size_t touching_count() const {
    std::size_t sum = 0;
    for (const Member& member : members_) sum += member.touching();
    return sum;
  }

 private:
  /// Puts the grains of late_ to their places among the others, all at once.
  void insert_late();
  friend struct SerializationAccess;
  friend struct detail::StateAccess;
  auto serialized_members() {
    if (!late_.empty()) insert_late();  // pairs are of the numbers of grains
    return near_.serialized_members_with(kept_points_);
  }

  static constexpr bool prefetches = requires(Placed<ShapeT> s) { s.prefetch_contact(); };

  struct Grain {
    BodyId body;
    const ShapeT* shape;
    Placed<ShapeT> placed;
    Scalar width;  // in any orientation [m]
  };
  template <class WallShape>
  struct Wall {
    BodyId body;
    WallShape shape;
    Placed<WallShape> placed;
  };

  /// Width of a grain in any orientation [m].
  static Scalar width(const ShapeT& shape) { return 2 * circumradius(shape); }
  /// Width that find_pairs() adds to that of a grain, both sides together [m].
  static Scalar around(const DetectionLengths<Scalar>& lengths) {
    return lengths.margin + 2 * lengths.skin;
  }

  /// The results of a member of the team, and its buffers.
  struct Member : detail::FoundContacts<S> {
    std::optional<Grain> image;  // the second grain of a pair across a periodic boundary
    detail::MeshBuffers<ShapeT> mesh;
  };

  /// The image of a grain, moved by a shift from the pose of its body.
  static const Grain& image_of(const Grain& grain, std::span<const Pose<S>> poses,
                               const Vector& shift, std::optional<Grain>& image) {
    Pose<S> pose = poses[grain.body.index()];
    pose.position += shift;
    image = grain;
    if constexpr (requires { image->placed.move_to(pose.position); })
      image->placed.move_to(pose.position);
    else
      image->placed.update(*grain.shape, pose);
    return *image;
  }

  /// Whether no point of b moves faster than this in the axes of a [m/s].
  static bool is_slow(const Grain& a, const Grain& b, const Bodies<S>& bodies, Scalar most) {
    const auto &of_a = bodies.velocity[a.body.index()], &of_b = bodies.velocity[b.body.index()];
    const Vector apart = b.placed.center() - a.placed.center();
    Vector shift = linear<S>(of_b) - linear<S>(of_a);
    shift -= S::spin(angular<S>(of_a), apart);
    return shift.norm() + b.width / 2 * (angular<S>(of_b) - angular<S>(of_a)).norm() <= most;
  }

  MOREAU_COMPILED_ONCE static void place_one(Grain& grain, Aabb<S>& box, const ShapeT& shape,
                                             std::span<const Pose<S>> poses) {
    grain.shape = &shape;
    grain.placed.update(shape, poses[grain.body.index()]);
    box = grain.placed.bounding_box();
  }
  auto bounds_of(const DetectionLengths<Scalar>& lengths, const Bodies<S>& bodies,
                 const detail::StepMotion<S>& motion) const {
    return detail::ApproachBounds<S, Grain, decltype(walls_), decltype(cylinders_),
                                  decltype(meshes_)>{
        grains_,    boxes_,  near_.pairs(), near_.shifts(), walls_,
        cylinders_, meshes_, bodies,        motion,         lengths.margin};
  }
  /// detect() without the impulses.
  void detect_points(const DetectionLengths<Scalar>& lengths, const Bodies<S>& bodies,
                     const detail::PreviousContacts<S>& previous, DetectedContacts<S>& out);
  /// Finds the contacts of grain k with later grains and with walls.
  MOREAU_COMPILED_ONCE void detect_of(std::size_t k, const DetectionLengths<Scalar>& lengths,
                                      const Bodies<S>& bodies,
                                      const detail::PreviousContacts<S>& previous, Member& found);

  std::vector<Grain> grains_;         // ascending by body
  std::vector<Grain> late_;           // further ones, which have the indices of removed grains
  std::vector<Grain> spare_;          // of removed grains; what they have allocated is used again
  List<std::uint32_t> number_after_;  // of each grain, in remove_grains()
  List<std::uint32_t> number_at_;     // number of the grain of each body, in insert_late()
  std::vector<Wall<HalfSpace<S>>> walls_;
  std::vector<Wall<CylinderWall<S>>> cylinders_;
  detail::MeshWalls<ShapeT> meshes_;
  List<Aabb<S>> boxes_;  // of the grains
  detail::NearPairs<ShapeT, BroadPhaseT> near_;
  ContactPoints kept_points_ = ContactPoints::all;
  Team team_;
  detail::VisitOrder<S> order_;
  detail::StepMargins<S> margins_;
  detail::InternalEdges<ShapeT> internal_edges_;
  std::vector<Member> members_;      // of the team
  List<typename Member::Run> runs_;  // of each grain
  List<std::size_t> place_;          // of the contacts of each grain; at the end, their number
  Scalar widest_ = 0;                // width of the grains in any orientation [m]
};

}  // namespace moreau

// Not inline: compiled once where a program declares the detector extern.
#include "moreau/world/detail/detect_points.hpp"
