// SPDX-License-Identifier: MIT
// What a simulation consists of, as its snapshot stores it, and what goes from process to process.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "moreau/body/bodies.hpp"
#include "moreau/contact/contact.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/io/detail/archive.hpp"

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

/// References to the members of a simulation that snapshots store.
template <class World>
struct WorldParts {
  decltype(SerializationAccess::serialized_members(std::declval<World&>())) members;

  explicit WorldParts(World& world) : members(SerializationAccess::serialized_members(world)) {}

  auto& dynamics() { return std::get<3>(members); }
  auto& time() { return std::get<5>(members); }
  auto& assembly() { return std::get<6>(members); }
  auto& contacts() { return std::get<7>(members); }
  auto& detector() { return std::get<8>(members); }
  const auto& tolerances() { return std::get<1>(members); }

  auto& shapes() { return std::get<0>(of(assembly())); }
  auto& grains() { return std::get<1>(of(assembly())); }
  auto& walls() { return std::get<2>(of(assembly())); }
  auto& cylinders() { return std::get<3>(of(assembly())); }
  auto& meshes() { return std::get<4>(of(assembly())); }
  auto& bodies() { return std::get<5>(of(assembly())); }
  /// Calls visit(body) with a reference to the body of every wall: of half-spaces, then of cylinders,
  /// then of meshes, each in the order in which they were added.
  void for_each_wall(const auto& visit) {
    for (BodyId& wall : walls()) visit(wall);
    for (auto& cylinder : cylinders()) visit(cylinder.body);
    for (auto& mesh : meshes()) visit(mesh.body);
  }

  /// The energies of the springs, one per contact.
  auto& spring_energies() { return std::get<1>(of(springs())); }
  /// The same; none without springs.
  auto energies() {
    if constexpr (has_springs)
      return std::span(std::as_const(spring_energies()));
    else
      return std::span<const char>();
  }
  /// The springs of compliant contacts.
  auto& springs() { return std::get<3>(of(dynamics())); }
  static constexpr bool has_springs =
      std::tuple_size_v<decltype(SerializationAccess::serialized_members(
          std::get<3>(std::declval<decltype(members)&>())))> == 4;

  /// The shifts of the overlap correction in the last step, which the next step does not need.
  auto& shifts() { return std::get<1>(of(std::get<1>(of(dynamics())))); }

  /// Makes the list of pairs empty, so that the next step finds all pairs.
  void forget_pairs() {
    auto [cell, kept_points, stale, fat, pairs, shifts, caches] = of(detector());
    stale = true;
    fat.clear();
    pairs.clear();
    shifts.clear();
    caches = {};
  }
  /// Computes what depends on the members, after they were set.
  void finish(World& world) {
    forget_pairs();
    shifts().assign(bodies().size(), World::S::Twist::Zero());
    SerializationAccess::deserialized(assembly());
    if constexpr (has_springs) SerializationAccess::deserialized(springs());
    SerializationAccess::deserialized(world);
  }

 private:
  template <class X>
  static auto of(X& x) {
    return SerializationAccess::serialized_members(x);
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
  std::vector<ShapeId> shapes;  ///< one per body, ids of the whole simulation

  void add(Bodies<S>& from, std::size_t i, BodyId id, ShapeId shape) {
    append(bodies, from, i);
    bodies.id.back() = id;
    shapes.push_back(shape);
  }
  void add_all(BodyList& from) {
    for (std::size_t i = 0; i < from.bodies.size(); ++i)
      add(from.bodies, i, from.bodies.id[i], from.shapes[i]);
  }
  std::size_t size() const { return shapes.size(); }
  auto serialized_members() { return std::tie(bodies, shapes); }
};

/// Contacts on their way, with the bodies of the whole simulation, and the energies of their springs.
template <class S, class Energy>
struct ContactList {
  Contacts<S> contacts;
  std::vector<Energy> energies;  ///< one per contact, or none

  /// @param a,b bodies of the contact in the list
  void add(const Contacts<S>& from, std::span<const Energy> from_energies, std::size_t c,
           std::uint32_t a, std::uint32_t b) {
    contacts.points.push_back(from.points[c]);
    contacts.points.back().a = a;
    contacts.points.back().b = b;
    contacts.keys.push_back(from.keys[c]);
    contacts.keys.back().a = a;
    contacts.keys.back().b = b;
    contacts.classes.push_back(from.classes[c]);
    contacts.impulses.push_back(from.impulses[c]);
    if (!from.couples.empty()) contacts.couples.push_back(from.couples[c]);
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
