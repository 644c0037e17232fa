// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/core/aabb.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pairs/collide_compound.hpp"
#include "moreau/detect/pairs/collide_mesh_wall.hpp"
#include "moreau/detect/pairs/mesh_neighbours.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/mesh/mesh_wall.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/world/detail/found_contacts.hpp"
#include "moreau/world/detail/pair_filter.hpp"

namespace moreau::detail {

/// The buffers with which one thread collides grains with mesh walls.
template <class ShapeT>
struct MeshBuffers {
  using S = SpaceOf<ShapeT>;
  std::optional<Placed<ShapeT>> local;  ///< the grain in the frame of the wall
  MeshScratch scratch;
  // Of a compound grain, in the frame of the wall:
  std::vector<typename S::Vector> kept;  ///< contact points [m]
  std::vector<Manifold<S>> at_seams;     ///< contacts that were left out, first `left_out` of them
  std::size_t left_out = 0;
};

/// A grain: its shape, and the shape placed in the world.
template <class ShapeT>
struct GrainInWorld {
  BodyId body;
  const ShapeT& shape;
  const Placed<ShapeT>& placed;
  const Aabb<SpaceOf<ShapeT>>& box;  ///< world axes [m]
};

/// The facets of a mesh near each body. Memory is held of bodies near the mesh alone, but for 8 bytes.
template <class S>
class NearFacetsOfBodies {
 public:
  void resize(std::size_t bodies) { of_.resize(bodies); }
  /// The list of a body, which one thread uses at a time.
  MeshNeighbours<S>& of(std::size_t body) {
    if (!of_[body].list) of_[body].list = std::make_unique<MeshNeighbours<S>>();
    return *of_[body].list;
  }
  /// The facets of a body as it was found last; none of one that has left.
  std::span<const NearFacet> facets(std::size_t body) const {
    return of_[body].list ? of_[body].list->facets() : std::span<const NearFacet>();
  }
  void leave(std::size_t body) { of_[body].list.reset(); }  ///< frees the memory of the body

 private:
  struct Of {
    std::unique_ptr<MeshNeighbours<S>> list;

    Of() = default;
    Of(Of&&) noexcept = default;
    Of& operator=(Of&&) noexcept = default;
    Of(const Of& other)
        : list(other.list ? std::make_unique<MeshNeighbours<S>>(*other.list) : nullptr) {}
    Of& operator=(const Of& other) { return *this = Of(other); }
    ~Of() = default;
  };
  std::vector<Of> of_;
};

/// The mesh walls of a ContactDetector. A program that adds none does not compile their collisions.
template <class ShapeT>
class MeshWalls {
 public:
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  void add(BodyId body, const MeshWall<S>& shape) {
    walls_.push_back({body, shape, {}, {}, {}});
    detect_ = &MeshWalls::detect_all;
  }
  void clear() { walls_.clear(); }
  std::size_t size() const { return walls_.size(); }
  /// Moves the walls to the poses of their bodies.
  void place(std::span<const Pose<S>> poses) {
    for (Wall& wall : walls_) {
      wall.placed.pose = poses[wall.body.index()];
      wall.box = box_around(wall.shape.tree().bounds(), wall.placed.pose);
      wall.near.resize(poses.size());
    }
  }
  /// Calls use(body) for each wall whose box comes as near to a box as the margin [m].
  void for_each_near(const Aabb<S>& box, Scalar margin, const auto& use) const {
    for (const Wall& wall : walls_)
      if (wall.box.overlaps(box.inflated(margin))) use(wall.body);
  }
  bool has(std::uint32_t body) const {
    return find(body);
  }  ///< whether the body is one of the meshes
  /// How far the face, ridge or vertex of a mesh that a grain touches reaches from the centre of the mesh along a unit
  /// vector [m]; nothing if the wall is no mesh. Only those facets of a face count that are near the grain.
  /// @param wall,grain indices of the bodies
  /// @param feature    of the contact, with the mesh as b
  std::optional<Scalar> reach(std::uint32_t wall, std::uint32_t grain, FeatureKey feature,
                              const Vector& direction) const {
    const Wall* mesh = find(wall);
    if (!mesh) return std::nullopt;
    return mesh->reach(grain, feature, mesh->placed.pose.rotation.inverse() * direction);
  }
  /// How far from a grain a mesh counts.
  struct Reach {
    Scalar margin;   ///< facets up to this gap decide which of them holds the grain [m]
    Scalar largest;  ///< gap of a contact point, <= margin [m]
  };
  /// Finds the contacts of a grain.
  void detect(const GrainInWorld<ShapeT>& grain, const Reach& reach, const Bodies<S>& bodies,
              const PairFilter& filter, const PreviousContacts<S>& previous,
              MeshBuffers<ShapeT>& buffers, FoundContacts<S>& found) {
    if (!walls_.empty()) detect_(*this, grain, reach, bodies, filter, previous, buffers, found);
  }

 private:
  struct PlacedFrame {
    Pose<S> pose;
    const Vector& center() const { return pose.position; }
  };
  struct Wall {
    BodyId body;
    MeshWall<S> shape;
    PlacedFrame placed;
    Aabb<S> box;  // world axes [m]
    NearFacetsOfBodies<S> near;

    // As reach() of MeshWalls, along a unit vector in the frame of the wall.
    [[gnu::cold, gnu::noinline]] Scalar reach(std::uint32_t grain, FeatureKey feature,
                                              const Vector& direction) const {
      using Kind = FeatureKey::Kind;
      Scalar most = -std::numeric_limits<Scalar>::infinity();
      const auto add = [&](std::size_t v) {
        most = std::max(most, Scalar(direction.dot(shape.vertex(v))));
      };
      if (feature.kind() == vertex_on_face(S{})) {
        for (const NearFacet& facet : near.facets(grain))
          if (facet.face == feature.b())
            for (const std::uint32_t v : shape.facet(facet.place)) add(v);
      } else if (feature.kind() == Kind::edge_edge || feature.kind() == Kind::vertex_edge) {
        for (const std::uint32_t v : shape.ridge(feature.b()).vertices) add(v);
      } else {
        add(feature.b());
      }
      return most;
    }
  };

  const Wall* find(std::uint32_t body) const {
    const auto found = std::find_if(walls_.begin(), walls_.end(),
                                    [&](const Wall& wall) { return wall.body.index() == body; });
    return found != walls_.end() ? &*found : nullptr;
  }
  static void detect_all(MeshWalls& self, const GrainInWorld<ShapeT>& grain, const Reach& reach,
                         const Bodies<S>& bodies, const PairFilter& filter,
                         const PreviousContacts<S>& previous, MeshBuffers<ShapeT>& buffers,
                         FoundContacts<S>& found) {
    const std::size_t body = grain.body.index();
    for (Wall& wall : self.walls_) {
      if (!wall.box.overlaps(grain.box.inflated(reach.margin))) {
        wall.near.leave(body);
        continue;
      }
      if (bodies.is_prescribed(body) && bodies.is_prescribed(wall.body.index())) continue;
      if (filter.leaves_out(grain.body, wall.body)) continue;
      if constexpr (MeshCollidable<ShapeT>)
        detect_at(grain, bodies.pose[body], wall, reach, previous, buffers, found);
    }
  }
  /// Takes the points at seams out of a contact of a part; of those that overlap it keeps a copy.
  /// @returns whether points are left
  static bool leave_out_seams(std::uint32_t part, Manifold<S>& manifold,
                              MeshBuffers<ShapeT>& buffers) {
    const auto is_kept = [&] { return !manifold.points.empty(); };
    if (manifold.gap < 0) {
      if (buffers.at_seams.size() == buffers.left_out) buffers.at_seams.emplace_back();
      buffers.at_seams[buffers.left_out] = manifold;
    }
    const auto dropped =
        drop_points_at_seams(*buffers.local, part, manifold.points, manifold.normal);
    if (dropped != 0 && !is_kept() && manifold.gap < 0) ++buffers.left_out;
    if (dropped != 0 && is_kept())
      manifold.contact_class = class_at_plane(S{}, manifold.points.size());
    for (const auto& point : manifold.points) buffers.kept.push_back(point.position);
    return is_kept();
  }
  /// Whether no contact point that was kept lies near those of a contact at a seam. This occurs at a tip in a concave corner
  /// where the seam ends.
  static bool is_alone(const Manifold<S>& manifold, const MeshBuffers<ShapeT>& buffers) {
    const Scalar beside = Scalar(seam_tolerance) * buffers.local->part(manifold.part_a).radius();
    return std::none_of(buffers.kept.begin(), buffers.kept.end(), [&](const Vector& x) {
      return std::any_of(manifold.points.begin(), manifold.points.end(), [&](const auto& point) {
        return (x - point.position).squaredNorm() < beside * beside;
      });
    });
  }
  static void detect_at(const GrainInWorld<ShapeT>& grain, const Pose<S>& pose, Wall& wall,
                        const Reach& reach, const PreviousContacts<S>& previous,
                        MeshBuffers<ShapeT>& buffers, FoundContacts<S>& found) {
    const Pose<S>& frame = wall.placed.pose;
    const Pose<S> local(frame.to_body(pose.position),
                        S::normalized(frame.rotation.inverse() * pose.rotation));
    if (buffers.local)
      buffers.local->update(grain.shape, local);
    else
      buffers.local.emplace(grain.shape, local);
    MeshNeighbours<S>& near = wall.near.of(grain.body.index());
    near.update(wall.shape, buffers.local->bounding_box().inflated(reach.margin));
    Manifold<S>& manifold = found.manifold();
    found.add(grain, wall, previous, [&](const auto& add) {
      bool touches = false;
      const auto add_in_world = [&] {
        touches = true;
        manifold.normal = frame.rotation * manifold.normal;
        for (auto& point : manifold.points) point.position = frame(point.position);
        add();
      };
      buffers.kept.clear();
      buffers.left_out = 0;
      for_each_part(*buffers.local, [&](std::uint32_t part, const auto& placed) {
        collide_each(placed, wall.shape, reach.margin, reach.largest, near, buffers.scratch,
                     manifold, [&](std::uint32_t face) {
                       manifold.part_a = part;
                       manifold.part_b = face;  // so that each face is reduced on its own
                       if constexpr (CompoundShape<ShapeT>)
                         if (!leave_out_seams(part, manifold, buffers)) return;
                       add_in_world();
                     });
      });
      if constexpr (CompoundShape<ShapeT>)
        for (std::size_t k = 0; k < buffers.left_out; ++k)
          if (is_alone(buffers.at_seams[k], buffers)) {
            manifold = buffers.at_seams[k];
            add_in_world();
          }
      return touches;
    });
    manifold.part_a = manifold.part_b = 0;
  }

  std::vector<Wall> walls_;
  void (*detect_)(MeshWalls&, const GrainInWorld<ShapeT>&, const Reach&, const Bodies<S>&,
                  const PairFilter&, const PreviousContacts<S>&, MeshBuffers<ShapeT>&,
                  FoundContacts<S>&) = nullptr;
};

}  // namespace moreau::detail
