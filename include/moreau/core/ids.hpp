// SPDX-License-Identifier: MIT
// Strongly typed ids: the id of a body cannot be passed where the id of a shape is expected.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ostream>
#include <tuple>

#include "moreau/core/error.hpp"

namespace moreau {

/// An index into an array of one kind of objects. It is trivially copyable and is ordered by its
/// value.
template <class Tag>
struct Id {
  /// Counted from 0; the largest number for the id of no item.
  std::uint32_t value = std::numeric_limits<std::uint32_t>::max();

  constexpr Id() = default;  ///< the id of no item: functions refuse it
  /// Id of the item with this index, < 2^32.
  /// @throws std::invalid_argument for an index of 2^32 or more
  constexpr explicit Id(std::size_t index) : value(static_cast<std::uint32_t>(index)) {
    if (value != index) throw_invalid("Id", "index", index, "must be below 2^32");
  }

  /// The index as a number.
  constexpr std::size_t index() const { return value; }
  auto serialized_members() { return std::tie(value); }  ///< see core/serialize.hpp
  friend constexpr auto operator<=>(const Id&, const Id&) = default;
  friend std::ostream& operator<<(std::ostream& out, Id id) {
    return id == Id() ? out << "none" : out << id.value;
  }
};

/// Id of a grain or wall. Its index is the position of the body in the arrays of Bodies. The index
/// of a removed grain is given to a body that is added later; the generations of the two ids differ.
/// A simulation refuses the id of a removed grain. Ids are ordered by index, then by generation.
struct BodyId : Id<struct BodyTag> {
  /// 0 for the first body with this index, 2 for the second, and so on. An odd number belongs to an
  /// index without a body.
  std::uint32_t generation = 0;

  constexpr BodyId() = default;  ///< the id of no body: functions refuse it
  /// Id of the first body that has this index, < 2^32. BodyAccess::body_id() gives the id of the
  /// present body.
  /// @throws std::invalid_argument for an index of 2^32 or more
  constexpr explicit BodyId(std::size_t index) : Id(index) {}

  auto serialized_members() { return std::tie(value, generation); }  ///< see core/serialize.hpp
  friend constexpr auto operator<=>(const BodyId&, const BodyId&) = default;
  friend std::ostream& operator<<(std::ostream& out, BodyId id) {
    out << static_cast<const Id&>(id);
    if (id.generation > 0) out << " (generation " << id.generation << ')';
    return out;
  }
};

using ShapeId = Id<struct ShapeTag>;        ///< id of a shape, which several grains can share
using MaterialId = Id<struct MaterialTag>;  ///< id of a material, in the order in which Materials
                                            ///< lists them

}  // namespace moreau
