// SPDX-License-Identifier: MIT
// The parts of a simulation, and the messages of which they are made between processes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/core/archive.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/world/bond.hpp"

namespace moreau::detail {

/// The objects as the bytes of a message.
template <class... Objects>
std::string packed(Objects&... objects) {
  ArchiveWriter archive;
  (transfer(archive, objects), ...);
  return std::move(archive.bytes);
}
/// Reads objects from the bytes of packed().
template <class... Objects>
void unpack(std::string_view bytes, Objects&... objects) {
  ArchiveReader archive(bytes);
  (transfer(archive, objects), ...);
}

/// The members of a simulation and of its parts that a simulation in several processes reads and sets.
struct StateAccess {
  static auto& dynamics(auto& world) { return world.dynamics_; }
  static auto& time(auto& world) { return world.time_; }
  static auto& assembly(auto& world) { return world.assembly_; }
  static auto& contacts(auto& world) { return world.contacts_; }
  static auto& detector(auto& world) { return world.detector_; }
  static auto lengths(const auto& world) { return world.lengths(); }

  static auto& shapes(auto& assembly) { return assembly.shapes_; }
  static auto& grains(auto& assembly) { return assembly.grains_; }
  static auto& bodies(auto& assembly) { return assembly.bodies_; }

  /// Whether the contacts have springs.
  template <class Dynamics>
  static constexpr bool has_springs() {
    return Dynamics::compliant;
  }
  /// Whether the law has bonds.
  template <class Dynamics>
  static constexpr bool has_bonds() {
    return Dynamics::bonding;
  }
  static auto& springs(auto& dynamics) { return dynamics.springs_; }
  static auto& energies(auto& springs) { return springs.energies_; }
  static auto& velocities(auto& springs) { return springs.last_; }
  static auto& shifts(auto& dynamics) { return dynamics.correction_.shifts_; }

  /// Makes the list of pairs empty, so that the next step finds all pairs.
  static void forget_pairs(auto& detector) { detector.near_.forget(); }
};

/// The parts of a simulation.
template <class World>
struct WorldParts {
  using S = typename World::S;
  World& world;

  explicit WorldParts(World& whole) : world(whole) {}

  auto& dynamics() { return StateAccess::dynamics(world); }
  auto& time() { return StateAccess::time(world); }
  auto& assembly() { return StateAccess::assembly(world); }
  auto& contacts() { return StateAccess::contacts(world); }
  auto& detector() { return StateAccess::detector(world); }
  auto lengths() { return StateAccess::lengths(world); }

  auto& shapes() { return StateAccess::shapes(assembly()); }
  auto& grains() { return StateAccess::grains(assembly()); }
  auto& bodies() { return StateAccess::bodies(assembly()); }
  /// Calls visit(body) with a reference to the body of every wall, in the order of Assembly::for_each_wall().
  void for_each_wall(const auto& visit) {
    auto& assembly = this->assembly();
    assembly.for_each_wall(assembly, [&](BodyId& body, const auto&) { visit(body); });
  }

  /// The energies of the springs, one per contact.
  auto& spring_energies() { return StateAccess::energies(springs()); }
  /// The same; none without springs.
  auto energies() {
    if constexpr (has_springs)
      return std::span(std::as_const(spring_energies()));
    else
      return std::span<const char>();
  }
  /// The springs of compliant contacts.
  auto& springs() { return StateAccess::springs(dynamics()); }
  static constexpr bool has_springs = StateAccess::has_springs<
      std::remove_cvref_t<decltype(StateAccess::dynamics(std::declval<World&>()))>>();
  /// The velocities of the bodies that springs remember: those after the step before. A body that was added since has the
  /// velocity that it has now. None without springs.
  List<typename S::Twist> remembered() {
    List<typename S::Twist> velocities;
    if constexpr (has_springs) {
      velocities = StateAccess::velocities(springs());
      for (std::size_t i = velocities.size(); i < bodies().size(); ++i)
        velocities.push_back(bodies().velocity[i]);
    }
    return velocities;
  }
  /// Replaces the velocities that springs remember.
  /// @param velocities one per body; without springs nothing is done
  void set_remembered([[maybe_unused]] List<typename S::Twist> velocities) {
    if constexpr (has_springs) StateAccess::velocities(springs()) = std::move(velocities);
  }

  /// The shifts of the overlap correction in the last step, which the next step does not need.
  auto& shifts() { return StateAccess::shifts(dynamics()); }

  static constexpr bool has_bonds = StateAccess::has_bonds<
      std::remove_cvref_t<decltype(StateAccess::dynamics(std::declval<World&>()))>>();
  /// The bonds with the ids of their bodies in the whole simulation; none of a law without.
  /// @param ids one per body
  std::vector<Bond<S>> bonds(std::span<const BodyId> ids) {
    if constexpr (has_bonds) return with_ids<Bond<S>>(dynamics().bonds().bonds(), ids);
    return {};
  }
  /// The same of the breakages.
  std::vector<Breakage> breakages(std::span<const BodyId> ids) {
    if constexpr (has_bonds) return with_ids<Breakage>(dynamics().bonds().breakages(), ids);
    return {};
  }
  /// Replaces bonds and breakages.
  /// @param bonds     of bodies here, in any order
  /// @param breakages in any order
  void set_bonds([[maybe_unused]] std::vector<Bond<S>> bonds,
                 [[maybe_unused]] std::vector<Breakage> breakages) {
    if constexpr (has_bonds) {
      std::sort(bonds.begin(), bonds.end(), [](const Bond<S>& l, const Bond<S>& r) {
        return std::pair(l.a, l.b) < std::pair(r.a, r.b);
      });
      std::sort(breakages.begin(), breakages.end(), [](const Breakage& l, const Breakage& r) {
        return std::tuple(l.time, l.a, l.b) < std::tuple(r.time, r.a, r.b);
      });
      dynamics().bonds().set_bonds(std::move(bonds));
      dynamics().bonds().set_breakages(std::move(breakages));
    }
  }

  /// Copies, whose bodies a and b have their ids in the whole simulation.
  template <class Pair>
  static std::vector<Pair> with_ids(const auto& pairs, std::span<const BodyId> ids) {
    std::vector<Pair> copies(pairs.begin(), pairs.end());
    for (Pair& one : copies) {
      one.a = ids[one.a.index()];
      one.b = ids[one.b.index()];
    }
    return copies;
  }

  void forget_pairs() { StateAccess::forget_pairs(detector()); }
  /// Computes what depends on the members, after they were set. If bodies were placed since the last step, the next one
  /// looks for deep overlaps of all of them, because they have other numbers.
  void finish() {
    const bool placed = assembly().any_placed();
    forget_pairs();
    shifts().assign(bodies().size(), S::Twist::Zero());
    assembly().forget_placed();
    SerializationAccess::deserialized(assembly());
    if (placed) assembly().note_all_placed();
    if constexpr (has_springs) SerializationAccess::deserialized(springs());
    SerializationAccess::deserialized(world);
  }
};

/// Appends element i of every array of `from`.
template <class S>
void append(Bodies<S>& to, Bodies<S>& from, std::size_t i) {
  const auto targets = to.serialized_members();
  const auto sources = from.serialized_members();
  [&]<std::size_t... Array>(std::index_sequence<Array...>) {
    (std::get<Array>(targets).push_back(std::get<Array>(sources)[i]), ...);
  }
  (std::make_index_sequence<std::tuple_size_v<decltype(targets)>>{});
}

/// Bodies on their way; their ids are those of the whole simulation.
template <class S>
struct BodyList {
  Bodies<S> bodies;
  std::vector<ShapeId> shapes;         ///< one per body, ids of the whole simulation
  List<typename S::Twist> remembered;  ///< of WorldParts::remembered(): one per body, or none

  /// @param from_remembered those of `from`
  void add(Bodies<S>& from, const List<typename S::Twist>& from_remembered, std::size_t i,
           BodyId id, ShapeId shape) {
    append(bodies, from, i);
    bodies.id.back() = id;
    shapes.push_back(shape);
    if (!from_remembered.empty()) remembered.push_back(from_remembered[i]);
  }
  /// Adds element i of a list.
  void add(BodyList& from, std::size_t i) {
    add(from.bodies, from.remembered, i, from.bodies.id[i], from.shapes[i]);
  }
  void add_all(BodyList& from) {
    for (std::size_t i = 0; i < from.size(); ++i) add(from, i);
  }
  std::size_t size() const { return shapes.size(); }
  auto serialized_members() { return std::tie(bodies, shapes, remembered); }
};

/// Contacts on their way, with the bodies of the whole simulation, and the energies of their springs.
/// @tparam Points Contacts
template <class Points, class Energy>
struct ContactList {
  Points contacts;
  List<Energy> energies;  ///< one per contact, or none

  /// @param a,b bodies of the contact in the list
  void add(const Points& from, std::span<const Energy> from_energies, std::size_t c,
           std::uint32_t a, std::uint32_t b) {
    contacts.points.push_back(from.points[c]);
    contacts.points.back().a = a;
    contacts.points.back().b = b;
    contacts.keys.push_back(from.keys[c]);
    contacts.keys.back().a = a;
    contacts.keys.back().b = b;
    contacts.classes.push_back(from.classes[c]);
    contacts.impulses.push_back(from.impulses[c]);
    contacts.variants.push_back(from.variants[c]);
    if (!from_energies.empty()) energies.push_back(from_energies[c]);
  }
  void add_all(const ContactList& from) {
    for (std::size_t c = 0; c < from.contacts.size(); ++c)
      add(from.contacts, from.energies, c, from.contacts.keys[c].a, from.contacts.keys[c].b);
  }
  /// Sorts by key.
  void sort() {
    std::vector<std::size_t> order(contacts.size());
    for (std::size_t c = 0; c < order.size(); ++c) order[c] = c;
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t k) { return contacts.keys[i] < contacts.keys[k]; });
    ContactList sorted;
    for (const std::size_t c : order)
      sorted.add(contacts, energies, c, contacts.keys[c].a, contacts.keys[c].b);
    *this = std::move(sorted);
  }
  auto serialized_members() { return std::tie(contacts, energies); }
};

}  // namespace moreau::detail
