// SPDX-License-Identifier: MIT
#include "moreau/core/ids.hpp"

#include <cstddef>
#include <doctest/doctest.h>
#include <sstream>
#include <type_traits>

namespace {

using moreau::BodyId;
using moreau::MaterialId;
using moreau::ShapeId;

// The purpose of strongly typed ids: none of these conversions exists.
static_assert(!std::is_convertible_v<BodyId, ShapeId>);
static_assert(!std::is_constructible_v<BodyId, ShapeId>);
static_assert(!std::is_convertible_v<std::size_t, BodyId>);
static_assert(!std::is_convertible_v<BodyId, std::size_t>);
static_assert(std::is_trivially_copyable_v<BodyId>);
static_assert(sizeof(BodyId) == 8);

TEST_CASE("an id keeps its index, its order and its text") {
  constexpr BodyId third(std::size_t{3});
  static_assert(third.index() == 3);
  CHECK(third == BodyId(std::size_t{3}));
  CHECK(third != BodyId(std::size_t{4}));
  CHECK(third < BodyId(std::size_t{4}));
  std::ostringstream text;
  text << MaterialId(std::size_t{7});
  CHECK(text.str() == "7");
}

TEST_CASE("a default id is the id of no item") {
  CHECK(BodyId() != BodyId(std::size_t{0}));
  CHECK(MaterialId() != MaterialId(std::size_t{0}));
  std::ostringstream text;
  text << BodyId() << ' ' << ShapeId();
  CHECK(text.str() == "none none");
}

}  // namespace
