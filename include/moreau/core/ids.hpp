// SPDX-License-Identifier: MIT
// Strongly typed ids: the id of a body cannot be passed where the id of a shape is expected.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <tuple>

#include "moreau/core/error.hpp"

namespace moreau {

/// An index into an array of one kind of objects. It is trivially copyable and is ordered by its
/// value.
template <class Tag>
struct Id {
  std::uint32_t value = 0;  ///< counted from 0

  constexpr Id() = default;  ///< the id of the first item
  /// Id of the item with this index, < 2^32.
  /// @throws std::invalid_argument for an index of 2^32 or more
  constexpr explicit Id(std::size_t index) : value(static_cast<std::uint32_t>(index)) {
    if (value != index) throw_invalid("Id", "index", index, "must be below 2^32");
  }

  /// The index as a number.
  constexpr std::size_t index() const { return value; }
  auto serialized_members() { return std::tie(value); }  ///< see core/serialize.hpp
  friend constexpr auto operator<=>(const Id&, const Id&) = default;
  friend std::ostream& operator<<(std::ostream& out, Id id) { return out << id.value; }
};

using BodyId = Id<struct BodyTag>;    ///< id of a grain or wall, in the order in which they were
                                      ///< added
using ShapeId = Id<struct ShapeTag>;  ///< id of a shape, which several grains can share
using MaterialId = Id<struct MaterialTag>;  ///< id of a material, in the order in which Materials
                                            ///< lists them

}  // namespace moreau
