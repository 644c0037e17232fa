// SPDX-License-Identifier: MIT
// Moves grains and their contacts from process to process, and finds ghosts (lend_grains.hpp). The slack that each
// centre may move before the next redistribution includes half of what the longest bond is stretched.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/distributed/communicator.hpp"
#include "moreau/distributed/detail/ghost_motion.hpp"
#include "moreau/distributed/detail/lend_grains.hpp"
#include "moreau/distributed/detail/rank_topology.hpp"
#include "moreau/distributed/detail/shape_store.hpp"
#include "moreau/distributed/detail/whole_simulation.hpp"
#include "moreau/distributed/detail/world_parts.hpp"
#include "moreau/distributed/domain_decomposition.hpp"
#include "moreau/world/bond.hpp"

namespace moreau::detail {

/// @tparam World a Simulation
template <class World>
class Redistribution {
 public:
  using S = typename World::S;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// All arguments must outlive the object.
  Redistribution(Communicator& processes, DomainDecomposition<S>& decomposition,
                 RankTopology& topology, World& world)
      : processes_(processes),
        decomposition_(decomposition),
        topology_(topology),
        world_(world),
        ids_(topology.ids) {}

  /// Distributes the simulation of rank 0.
  void begin();
  /// Before a step: redistributes grains if one of them may move too far in it.
  /// @param step      h [s]
  /// @param imbalance work of a rank over the mean above which space is cut anew
  void update(Scalar step, double imbalance);
  /// After a step: takes the motion of ghosts from their owners.
  void refresh_ghosts() { ghost_motion_.refresh(Parts(world_).bodies(), topology_, processes_); }
  /// The whole simulation, on rank 0.
  std::optional<World> gather() {
    return whole_.gather(world_, processes_, topology_, shape_ids_, own_, breakages_);
  }

  std::size_t own_grains() const { return own_.size(); }
  std::size_t ghost_count() const { return world_.grain_count() - own_.size(); }
  std::size_t count() const { return count_; }
  std::size_t partitions() const { return partitions_; }
  /// Half-spaces: the first of all walls.
  std::span<const BodyId> half_spaces() const {
    return std::span(whole_.walls).first(world_.walls().size());
  }
  BodyId id(std::size_t local) const { return ids_[local]; }
  /// The id that a wall of the whole simulation has in this process.
  /// @throws std::invalid_argument for another body
  BodyId local_wall(BodyId wall) const {
    for (const std::uint32_t i : topology_.walls)
      if (ids_[i] == wall) return BodyId(i);
    throw_invalid("DistributedSimulation", "wall", wall, "must be the id of a wall");
  }

 private:
  using Parts = WorldParts<World>;
  using ShapeT = std::remove_cvref_t<decltype(std::declval<World&>().shape_of_grain(0))>;
  using Grains = BodyList<S>;
  using ContactsOnTheWay = detail::ContactsOnTheWay<World>;

  std::size_t ranks() const { return std::size_t(processes_.size()); }
  void redistribute(Scalar slack, double imbalance);
  void cut_if_uneven(double imbalance);
  /// Sends grains and contacts to the new owners.
  void migrate(Grains& grains, ContactsOnTheWay& contacts);
  /// A body of one of the lists, and the process that owns it.
  struct Entry {
    BodyId id;
    Grains* list;
    std::size_t number;  ///< in the list
    int owner;
  };
  std::vector<Entry> entries_by_id(Grains& grains, std::vector<Grains>& ghosts,
                                   Grains& walls) const;
  void assemble(Grains& grains, std::vector<Grains>& ghosts, Grains& walls,
                const std::vector<std::vector<BodyId>>& lent);
  void take_contacts(ContactsOnTheWay& contacts);
  void take_bonds();
  /// Largest distance of the two points of a bond here [m].
  Scalar longest_stretch();

  Vector wrapped(const Vector& x) const { return world_.cell().wrap(x); }
  /// The local index of a body of the whole simulation; `none` if it is not here.
  std::uint32_t local_index(std::uint32_t global) const {
    const auto found =
        std::lower_bound(ids_.begin(), ids_.end(), global,
                         [](const BodyId& id, std::uint32_t value) { return id.value < value; });
    return found != ids_.end() && found->value == global ? std::uint32_t(found - ids_.begin())
                                                         : none;
  }
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  Communicator& processes_;
  DomainDecomposition<S>& decomposition_;
  RankTopology& topology_;
  World& world_;

  std::vector<BodyId>& ids_;              // of the whole simulation, one per body here, ascending
  std::vector<std::uint32_t> shape_ids_;  // of the whole simulation, one per shape here
  std::vector<std::uint32_t> own_;        // bodies here that are grains of this rank
  std::vector<Vector> reference_;         // where they were at the last redistribution
  Scalar slack_ = 0;                      // how far they may move from there
  std::size_t count_ = 0, partitions_ = 0;
  ShapeStore<ShapeT> shapes_;  // during a redistribution
  WholeSimulation<World> whole_;
  GhostMotion<S> ghost_motion_;
  std::vector<Bond<S>> bonds_;       // during a redistribution, with bodies of the whole simulation
  std::vector<Breakage> breakages_;  // of this process up to the last one, likewise
};

template <class World>
void Redistribution<World>::begin() {
  std::string settings;
  if (processes_.rank() == 0) {
    World empty = world_;
    const std::vector<BodyId> all(empty.grains().begin(), empty.grains().end());
    empty.remove_grains(all);
    Parts(empty).shapes().clear();
    Parts(empty).set_bonds({}, {});
    settings = packed(empty);
  }
  processes_.broadcast(settings);
  if (processes_.rank() != 0) unpack(settings, world_);
  Parts parts(world_);
  Bodies<S>& bodies = parts.bodies();
  ids_ = bodies.id;
  topology_.rank = processes_.rank();
  topology_.owner.assign(bodies.size(), 0);
  topology_.ghosts.assign(ranks(), {});
  topology_.lent.assign(ranks(), {});
  topology_.walls.clear();
  whole_.remember(world_, processes_);
  for (const BodyId wall : whole_.walls) {
    topology_.owner[wall.index()] = RankTopology::everywhere;
    topology_.walls.push_back(wall.value);
  }
  std::sort(topology_.walls.begin(), topology_.walls.end());
  for (const auto& grain : parts.grains()) own_.push_back(grain.body.value);
  for (std::uint32_t k = 0; k < parts.shapes().size(); ++k) shape_ids_.push_back(k);
  if constexpr (Parts::has_bonds) {  // bodies of earlier breakages may have been removed
    breakages_.assign(world_.breakages().begin(), world_.breakages().end());
    parts.set_bonds(parts.bonds(ids_), {});
  }
  redistribute(0, 1);
}

template <class World>
void Redistribution<World>::update(Scalar step, double imbalance) {
  const Bodies<S>& bodies = world_.bodies();
  double values[] = {0, 0};  // way since the last time with this step, way in this step
  for (std::size_t k = 0; k < own_.size(); ++k) {
    const std::size_t i = own_[k];
    const double way = double(step * linear<S>(bodies.velocity[i]).norm());
    values[0] = std::max(values[0], way + double((bodies.pose[i].position - reference_[k]).norm()));
    values[1] = std::max(values[1], way);
  }
  processes_.largest(std::span(values));
  if (values[0] <= double(slack_)) return;
  Parts parts(world_);
  const Scalar skin = parts.lengths().skin;
  redistribute(std::max(skin, 2 * Scalar(values[1])), imbalance);
}

template <class World>
void Redistribution<World>::redistribute(Scalar slack, double imbalance) {
  Parts parts(world_);
  ++count_;
  cut_if_uneven(imbalance);
  shapes_.take(shape_ids_, parts.shapes());
  Grains walls, grains;
  const auto remembered = parts.remembered();
  for (const std::uint32_t i : topology_.walls)
    walls.add(parts.bodies(), remembered, i, ids_[i], ShapeId());
  ContactsOnTheWay contacts;
  const Scalar longest = Scalar(processes_.largest(double(longest_stretch())));
  migrate(grains, contacts);
  std::vector<std::vector<BodyId>> lent(ranks());
  std::vector<Grains> ghosts = lend_grains(grains, shapes_, world_.cell(), parts.lengths().margin,
                                           slack + longest / 2, decomposition_, processes_, lent);
  assemble(grains, ghosts, walls, lent);
  take_contacts(contacts);
  take_bonds();
  parts.finish();
  slack_ = slack;
}

template <class World>
void Redistribution<World>::cut_if_uneven(double imbalance) {
  const Bodies<S>& bodies = world_.bodies();
  std::vector<float> work(bodies.size(), 1);
  for (const Contact<S>& contact : world_.contacts().points) {
    work[contact.a] += 0.5f;
    work[contact.b] += 0.5f;
  }
  std::vector<WeightedPoint<S>> points;
  double total = 0;
  for (const std::uint32_t i : own_) {
    points.push_back({wrapped(bodies.pose[i].position), work[i]});
    total += double(work[i]);
  }
  const double mean = processes_.sum(total) / double(ranks());
  if (mean == 0 || processes_.largest(total) <= imbalance * mean) return;
  decomposition_.partition(points);
  ++partitions_;
}

template <class World>
void Redistribution<World>::migrate(Grains& grains, ContactsOnTheWay& contacts) {
  Parts parts(world_);
  Bodies<S>& bodies = parts.bodies();
  std::vector<int> owner(bodies.size(), RankTopology::everywhere);
  std::vector<std::uint32_t> shape(bodies.size(), 0);
  for (const auto& grain : parts.grains()) {
    owner[grain.body.index()] =
        decomposition_.owner(wrapped(bodies.pose[grain.body.index()].position));
    shape[grain.body.index()] = shape_ids_[grain.shape.index()];
  }
  std::vector<Grains> leaving(ranks());
  std::vector<ContactsOnTheWay> leaving_contacts(ranks());
  const auto remembered = parts.remembered();
  for (const std::uint32_t i : own_)
    leaving[std::size_t(owner[i])].add(bodies, remembered, i, ids_[i], ShapeId(shape[i]));
  const auto& all = parts.contacts();
  for (std::size_t c = 0; c < all.size(); ++c) {
    const std::uint32_t a = all.points[c].a, b = all.points[c].b;
    const int to = RankTopology::owner_of_contact(owner[a], owner[b]);
    leaving_contacts[std::size_t(to)].add(all, parts.energies(), c, ids_[a].value, ids_[b].value);
  }
  std::vector<std::vector<Bond<S>>> leaving_bonds(ranks());
  const std::vector<Bond<S>> bonds = parts.bonds(ids_);
  for (const Bond<S>& bond : bonds) {
    const int to = RankTopology::owner_of_contact(owner[local_index(bond.a.value)],
                                                  owner[local_index(bond.b.value)]);
    leaving_bonds[std::size_t(to)].push_back(bond);
  }
  for (const Breakage& one : parts.breakages(ids_)) breakages_.push_back(one);
  std::vector<std::string> out;
  for (std::size_t rank = 0; rank < ranks(); ++rank)
    out.push_back(leaving[rank].size() + leaving_contacts[rank].contacts.size() +
                              leaving_bonds[rank].size() ==
                          0
                      ? std::string()
                      : packed(leaving[rank], leaving_contacts[rank], leaving_bonds[rank]));
  bonds_.clear();
  const std::vector<std::string> in = processes_.exchange(std::move(out));
  std::vector<Grains> from(ranks());
  for (std::size_t rank = 0; rank < ranks(); ++rank) {
    if (in[rank].empty()) continue;
    ContactsOnTheWay more;
    std::vector<Bond<S>> more_bonds;
    unpack(in[rank], from[rank], more, more_bonds);
    bonds_.insert(bonds_.end(), more_bonds.begin(), more_bonds.end());
    grains.add_all(from[rank]);
    contacts.add_all(more);
  }
  contacts.sort();
  shapes_.fetch(from, processes_);
}

template <class World>
auto Redistribution<World>::entries_by_id(Grains& grains, std::vector<Grains>& ghosts,
                                          Grains& walls) const -> std::vector<Entry> {
  std::vector<Entry> entries;
  const auto add = [&](Grains& list, int owner) {
    for (std::size_t k = 0; k < list.size(); ++k)
      entries.push_back({list.bodies.id[k], &list, k, owner});
  };
  add(grains, processes_.rank());
  for (std::size_t rank = 0; rank < ranks(); ++rank) add(ghosts[rank], int(rank));
  add(walls, RankTopology::everywhere);
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.id < b.id; });
  return entries;
}

template <class World>
void Redistribution<World>::assemble(Grains& grains, std::vector<Grains>& ghosts, Grains& walls,
                                     const std::vector<std::vector<BodyId>>& lent) {
  Parts parts(world_);
  Grains here;  // with the numbers of this process
  ids_.clear();
  own_.clear();
  reference_.clear();
  topology_.owner.clear();
  topology_.walls.clear();
  for (auto& list : topology_.ghosts) list.clear();
  parts.grains().clear();
  parts.shapes().clear();
  shape_ids_.clear();
  std::map<std::uint32_t, ShapeId> numbers;  // of shapes, by id
  for (const Entry& entry : entries_by_id(grains, ghosts, walls)) {
    const auto i = static_cast<std::uint32_t>(here.size());
    here.add(*entry.list, entry.number);
    here.bodies.id.back() = BodyId(i);
    ids_.push_back(entry.id);
    topology_.owner.push_back(entry.owner);
    if (entry.owner == RankTopology::everywhere) {
      topology_.walls.push_back(i);
      continue;
    }
    const std::uint32_t shape = entry.list->shapes[entry.number].value;
    const auto [known, is_new] = numbers.emplace(shape, ShapeId(shape_ids_.size()));
    if (is_new) {
      parts.shapes().push_back(std::move(shapes_[ShapeId(shape)]));
      shape_ids_.push_back(shape);
    }
    parts.grains().push_back({BodyId(i), known->second});
    if (entry.owner == processes_.rank()) {
      own_.push_back(i);
      reference_.push_back(here.bodies.pose[i].position);
    } else {
      topology_.ghosts[std::size_t(entry.owner)].push_back(i);
    }
  }
  shapes_.clear();
  for (std::size_t rank = 0; rank < ranks(); ++rank) {
    topology_.lent[rank].clear();
    for (const BodyId id : lent[rank]) topology_.lent[rank].push_back(local_index(id.value));
  }
  std::size_t next = 0;
  parts.for_each_wall(
      [&](BodyId& wall) { wall = BodyId(local_index(whole_.walls[next++].value)); });
  parts.bodies() = std::move(here.bodies);
  parts.set_remembered(std::move(here.remembered));
}

template <class World>
void Redistribution<World>::take_contacts(ContactsOnTheWay& contacts) {
  ContactsOnTheWay here;
  for (std::size_t c = 0; c < contacts.contacts.size(); ++c) {
    const ContactKey& key = contacts.contacts.keys[c];
    const std::uint32_t a = local_index(key.a), b = local_index(key.b);
    // A grain that is not a ghost is too far away for a contact in the next step.
    if (a != none && b != none) here.add(contacts.contacts, contacts.energies, c, a, b);
  }
  Parts parts(world_);
  parts.contacts() = std::move(here.contacts);
  if constexpr (Parts::has_springs) parts.spring_energies() = std::move(here.energies);
}

template <class World>
void Redistribution<World>::take_bonds() {
  for (Bond<S>& bond : bonds_) {
    bond.a = BodyId(local_index(bond.a.value));
    bond.b = BodyId(local_index(bond.b.value));
  }
  Parts(world_).set_bonds(std::move(bonds_), {});
  bonds_.clear();
}

template <class World>
typename Redistribution<World>::Scalar Redistribution<World>::longest_stretch() {
  Scalar longest = 0;
  if constexpr (Parts::has_bonds)
    for (const Bond<S>& bond : world_.bonds()) {
      const Vector shift = world_.cell().shift(bond.cells);
      longest = std::max(longest, place_of(bond, world_.bodies(), shift).stretch.norm());
    }
  return longest;
}

}  // namespace moreau::detail
