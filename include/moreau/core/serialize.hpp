// SPDX-License-Identifier: MIT
// How a class takes part in serialization: writing an object to a file and reading it back
// (io/detail/archive.hpp).
//
// An aggregate of up to eight members, such as Tolerances, needs no code. A class with private
// members lists them once, for both directions:
//
//     private:
//      friend struct SerializationAccess;
//      auto serialized_members() { return std::tie(radius_); }
//
// A class may also have deserialized(). It is called after the members have been read, computes the
// members that follow from them, and throws if the members describe no valid object. A class
// without a public default constructor has a private one: its object is only read into.
#pragma once

#include <tuple>  // for the classes that include this header

namespace moreau {

/// The one friend that a serializable class declares.
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
  /// Calls deserialized() if X has it; passes its exception on if the members are not valid.
  template <class X>
  static void deserialized(X& x) {
    if constexpr (requires { x.deserialized(); }) x.deserialized();
  }
  /// An object to be read into.
  template <class X>
  static X blank() {
    return X();
  }

 private:
  template <class Owner, class Members>
  static Owner owner(Members (Owner::*)());
};

}  // namespace moreau
