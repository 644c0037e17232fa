// SPDX-License-Identifier: MIT
// By how much rigid bonds are corrected in a step (bond_list.hpp). Bonds have small stretches and rotations because positions
// and rotations are rounded. These are no errors: a correction of them would load the bonds of bodies at rest. A stretch x with
// the rounding e has an error of max(0, |x| - e), the share s = max(0, 1 - e / |x|) of x.
//
// All bonds of a set of bodies that bonds connect are corrected by the same share, the largest share of these bonds.
// Where bonds form a closed row, the sum of their stretches and rotations is zero. If all of them are corrected by
// the same share, there is a motion of the bodies that corrects them. If each bond were corrected by its own share, there would be
// none: the forces in the row would grow from sweep to sweep, and the residual of the solver would turn the bodies against each other.
#pragma once

#include <algorithm>
#include <cstddef>

#include "moreau/core/disjoint_sets.hpp"
#include "moreau/core/list.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/solve/shared_bodies.hpp"
#include "moreau/world/bond.hpp"

namespace moreau::detail {

/// The shares of a step: start(), then connect() for each bond, then add() for each of its errors, then end(). Bodies of
/// prescribed motion connect nothing.
template <class S>
class CorrectedBonds {
 public:
  using Scalar = typename S::Scalar;

  /// @param bodies their number
  void start(std::size_t bodies) {
    sets_.assign(bodies);
    shares_.assign(bodies, 0);
  }
  /// The bodies of a bond are in one set.
  void connect(const Bodies<S>& bodies, const Bond<S>& bond) {
    const std::size_t a = bond.a.index(), b = bond.b.index();
    if (!bodies.is_prescribed(a) && !bodies.is_prescribed(b)) sets_.unite(a, b);
  }
  /// @param rounding e / |x| of a stretch or a rotation of the bond, infinite if x = 0 [-]
  void add(const Bodies<S>& bodies, const Bond<S>& bond, Scalar rounding) {
    Scalar& share = shares_[sets_.find(free_body(bodies, bond))];
    share = std::max(share, 1 - rounding);
  }
  /// A process does not know the bonds of the others. If there are several, all bonds are one set.
  void end(SharedBodies* shared) {
    if (!shared) return;
    double largest = 0;
    for (const Scalar share : shares_) largest = std::max(largest, double(share));
    shared->largest({&largest, 1});
    shares_.assign(shares_.size(), Scalar(largest));
  }
  /// s of a bond [-].
  Scalar share(const Bodies<S>& bodies, const Bond<S>& bond) {
    return shares_[sets_.find(free_body(bodies, bond))];
  }

 private:
  static std::size_t free_body(const Bodies<S>& bodies, const Bond<S>& bond) {
    return bodies.is_prescribed(bond.a.index()) ? bond.b.index() : bond.a.index();
  }

  DisjointSets sets_;
  List<Scalar> shares_;  // of the first body of each set
};

}  // namespace moreau::detail
