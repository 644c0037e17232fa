// SPDX-License-Identifier: MIT
// How a class supports serialization: writing an object to a file and reading it back
// (core/archive.hpp).
//
// An aggregate with at most eight members, such as Tolerances, needs no code. A class with private
// members lists the members once, for both directions:
//
//     private:
//      friend struct SerializationAccess;
//      auto serialized_members() { return std::tie(radius_); }
//
// A class may also have a function deserialized(). It is called after the members have been read.
// It computes the other members from them, and throws if the members do not describe a valid
// object. A class without a public default constructor has a private default constructor; an object
// made by it is used only to be overwritten by reading.
#pragma once

#include <tuple>  // for the classes that include this header

#include "moreau/core/compiler.hpp"

namespace moreau {

/// The class that every serializable class declares as its friend.
struct SerializationAccess {
  /// Whether X has serialized_members().
  template <class X>
  static constexpr bool is_serializable() {
    if constexpr (requires(X & x) { x.serialized_members(); }) {
      using Owner = decltype(owner(&X::serialized_members));
      static_assert(
          sizeof(X) == sizeof(Owner),
          "serialized_members() is inherited from a base that lacks members of the class");
      return true;
    } else {
      return false;
    }
  }
  /// References to all serialized members of x.
  template <class X>
  static auto serialized_members(X& x) {
    return x.serialized_members();
  }
  /// Calls deserialized() if X has it. The call throws if the members are not valid.
  template <class X>
  static void deserialized(X& x) {
    if constexpr (requires { x.deserialized(); }) x.deserialized();
  }
  /// A default-constructed object, to be overwritten by reading.
  template <class X>
  static X blank() {
    constexpr bool default_constructible = requires {
      X();
    };
    static_assert(default_constructible,
                  "a class that is read from a snapshot needs a default constructor, which may be "
                  "private");
    if constexpr (default_constructible) return X();
  }

 private:
  template <class Owner, class Members>
  static Owner owner(Members (Owner::*)());
};

}  // namespace moreau
