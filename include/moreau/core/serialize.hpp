// SPDX-License-Identifier: MIT
// What an object is made of, for those who write it to a file and read it back (io/archive.hpp).
//
// An aggregate of up to eight members, such as Pose, is made of these. A class with private members
// names them once, for both directions:
//
//     private:
//      friend struct StateAccess;
//      auto state() { return std::tie(radius_); }
//
// and may have restored(), which is called when they have been read, makes what follows from them,
// and throws if there is no such object. A class without a public default constructor has a private
// one, whose object is only there to be read into.
#pragma once

#include <tuple>  // for those who include this

namespace moreau {

/// The one friend of classes that can be written to a file.
struct StateAccess {
  /// Whether X lists its members by state().
  template <class X>
  static constexpr bool has_state() {
    if constexpr (requires(X & x) { x.state(); }) {
      using Owner = decltype(owner(&X::state));
      static_assert(sizeof(X) == sizeof(Owner), "state(): it is a base's, which lacks members");
      return true;
    } else {
      return false;
    }
  }
  /// References to all that x is made of.
  template <class X>
  static auto state(X& x) {
    return x.state();
  }
  /// Lets x make what follows from its members; its exception if there is no such object.
  template <class X>
  static void restored(X& x) {
    if constexpr (requires { x.restored(); }) x.restored();
  }
  /// An object to be read into.
  template <class X>
  static X blank() {
    return X();
  }

 private:
  template <class Owner, class State>
  static Owner owner(State (Owner::*)());
};

}  // namespace moreau
