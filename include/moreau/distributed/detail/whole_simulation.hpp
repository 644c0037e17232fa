// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "moreau/core/ids.hpp"
#include "moreau/distributed/communicator.hpp"
#include "moreau/distributed/detail/rank_topology.hpp"
#include "moreau/distributed/detail/world_parts.hpp"

namespace moreau::detail {

/// The type of the contacts of a simulation in a message.
template <class World>
using ContactsOnTheWay =
    ContactList<std::remove_cvref_t<decltype(WorldParts<World>(std::declval<World&>()).contacts())>,
                std::remove_cv_t<typename decltype(std::declval<WorldParts<World>&>()
                                                       .energies())::element_type>>;

/// Makes the whole simulation of the parts of all processes. Rank 0 keeps what they do not have: all
/// shapes, and the places of removed bodies.
template <class World>
class WholeSimulation {
 public:
  using S = typename World::S;

  std::vector<BodyId> walls;  ///< in the order of WorldParts::for_each_wall()

  /// Notes what gather() needs.
  /// @param world on rank 0 the whole simulation, on the others its walls
  void remember(World& world, const Communicator& processes) {
    Parts parts(world);
    parts.for_each_wall([&](const BodyId& wall) { walls.push_back(wall); });
    if (processes.rank() != 0) return;
    shapes_ = parts.shapes();
    Bodies<S>& bodies = parts.bodies();
    const auto remembered = parts.remembered();
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (!bodies.exists(i)) removed_.add(bodies, remembered, i, bodies.id[i], ShapeId());
  }
  /// @param world     the part of this process
  /// @param shape_ids of the whole simulation, one per shape of the part
  /// @param own       bodies of the part that are grains of this process
  /// @param breakages of this process before those that the part has
  /// @returns the whole simulation, on rank 0
  std::optional<World> gather(World& world, Communicator& processes, const RankTopology& topology,
                              const std::vector<std::uint32_t>& shape_ids,
                              const std::vector<std::uint32_t>& own,
                              const std::vector<Breakage>& breakages);

 private:
  using Parts = WorldParts<World>;
  using ShapeT = std::remove_cvref_t<decltype(std::declval<World&>().shape_of_grain(0))>;

  static std::string packed_part(World& world, const RankTopology& topology,
                                 const std::vector<std::uint32_t>& shape_ids,
                                 const std::vector<std::uint32_t>& own,
                                 std::vector<Breakage> breakages);
  /// Replaces bodies and shapes of a copy of a part.
  /// @param list   grains, then all other bodies
  /// @param grains how many are grains
  void set_bodies(Parts& whole, BodyList<S>& list, std::size_t grains) const;

  std::deque<ShapeT> shapes_;
  BodyList<S> removed_;
};

template <class World>
std::string WholeSimulation<World>::packed_part(World& world, const RankTopology& topology,
                                                const std::vector<std::uint32_t>& shape_ids,
                                                const std::vector<std::uint32_t>& own,
                                                std::vector<Breakage> breakages) {
  Parts parts(world);
  std::vector<std::uint32_t> shape(parts.bodies().size(), 0);
  for (const auto& grain : parts.grains())
    shape[grain.body.index()] = shape_ids[grain.shape.index()];
  BodyList<S> grains;
  const auto remembered = parts.remembered();
  for (const std::uint32_t i : own)
    grains.add(parts.bodies(), remembered, i, topology.ids[i], ShapeId(shape[i]));
  ContactsOnTheWay<World> contacts;
  const auto& all = parts.contacts();
  for (std::size_t c = 0; c < all.size(); ++c)
    contacts.add(all, parts.energies(), c, topology.ids[all.points[c].a].value,
                 topology.ids[all.points[c].b].value);
  std::vector<Bond<S>> bonds = parts.bonds(topology.ids);
  for (const Breakage& one : parts.breakages(topology.ids)) breakages.push_back(one);
  return packed(grains, contacts, bonds, breakages);
}

template <class World>
void WholeSimulation<World>::set_bodies(Parts& whole, BodyList<S>& list, std::size_t grains) const {
  std::vector<std::size_t> order(list.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[list.bodies.id[k].index()] = k;
  whole.shapes() = shapes_;
  whole.grains().clear();
  BodyList<S> all;
  for (const std::size_t k : order) {
    all.add(list, k);
    if (k < grains) whole.grains().push_back({list.bodies.id[k], list.shapes[k]});
  }
  whole.bodies() = std::move(all.bodies);
  whole.set_remembered(std::move(all.remembered));
  std::size_t next = 0;
  whole.for_each_wall([&](BodyId& wall) { wall = walls[next++]; });
}

template <class World>
std::optional<World> WholeSimulation<World>::gather(World& world, Communicator& processes,
                                                    const RankTopology& topology,
                                                    const std::vector<std::uint32_t>& shape_ids,
                                                    const std::vector<std::uint32_t>& own,
                                                    const std::vector<Breakage>& breakages) {
  const std::vector<std::string> in =
      processes.gather(packed_part(world, topology, shape_ids, own, breakages));
  if (processes.rank() != 0) return std::nullopt;
  BodyList<S> list;
  ContactsOnTheWay<World> contacts;
  std::vector<Bond<S>> bonds;
  std::vector<Breakage> broken;
  for (const std::string& bytes : in) {
    BodyList<S> grains;
    ContactsOnTheWay<World> more;
    std::vector<Bond<S>> more_bonds;
    std::vector<Breakage> more_broken;
    unpack(bytes, grains, more, more_bonds, more_broken);
    bonds.insert(bonds.end(), more_bonds.begin(), more_bonds.end());
    broken.insert(broken.end(), more_broken.begin(), more_broken.end());
    list.add_all(grains);
    contacts.add_all(more);
  }
  contacts.sort();
  const std::size_t grains = list.size();
  Parts here(world);
  const auto remembered = here.remembered();
  for (const std::uint32_t i : topology.walls)
    list.add(here.bodies(), remembered, i, topology.ids[i], ShapeId());
  BodyList<S> removed = removed_;
  list.add_all(removed);

  World result = world;
  Parts whole(result);
  whole.dynamics().share_bodies(nullptr);
  whole.dynamics().forget_problem();  // that of this process
  whole.detector().set_filter(std::function<bool(std::uint32_t, std::uint32_t)>());
  set_bodies(whole, list, grains);
  whole.contacts() = std::move(contacts.contacts);
  if constexpr (Parts::has_springs) whole.spring_energies() = std::move(contacts.energies);
  whole.set_bonds(std::move(bonds), std::move(broken));
  whole.finish();
  return result;
}

}  // namespace moreau::detail
