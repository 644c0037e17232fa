// SPDX-License-Identifier: MIT
// Strong ids: the id of a body cannot be passed where the id of a shape is expected.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <tuple>

#include "moreau/core/error.hpp"

namespace moreau {

/// An index into one kind of array. Trivially copyable; ordered like its value.
template <class Tag>
struct Id {
  std::uint32_t value = 0;  ///< counted from 0

  constexpr Id() = default;  ///< id of the first item
  /// The id of the item at this index, < 2^32.
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

using BodyId = Id<struct BodyTag>;          ///< of grains and walls, in the order they were added
using ShapeId = Id<struct ShapeTag>;        ///< of shapes that grains share
using MaterialId = Id<struct MaterialTag>;  ///< of materials, as Materials counts them

}  // namespace moreau
