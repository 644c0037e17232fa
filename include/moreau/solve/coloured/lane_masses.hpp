// SPDX-License-Identifier: MIT
// Velocities, impulses and inverse masses of one body per SIMD lane, in world axes.
//
// A contact with the frame F and the levers l_a, l_b changes the velocities by
//
//     p = F r,     v_b += p / m_b,   w_b += I_b^-1 (l_b x p),    v_a, w_a: with -p,
//
// so that a point needs its frame and levers; 1/m and I^-1 belong to the pair.
#pragma once

#include <cstddef>

#include "moreau/law/lane_block.hpp"
#include "moreau/motion/mobility.hpp"
#include "moreau/simd/lane_algebra.hpp"

namespace moreau::detail {

/// Inverse masses of bodies whose mass is the same along all axes. For other bodies `linear` has no
/// meaning.
template <class S>
struct LaneMass {
  using Values = typename LaneBlock<S>::Values;
  using Algebra = LaneAlgebra<S, Values>;
  Values linear{};                                                   ///< 1/m [1/kg]
  typename Algebra::template Symmetric<Algebra::angular> angular{};  ///< I^-1 [1/(kg m^2)]

  void set(std::size_t lane, const InverseMass<S>& mass) {
    linear[lane] = mass.linear()[0];
    for (std::size_t i = 0; i < angular.size(); ++i) angular[i][lane] = mass.angular()[i];
  }
};

/// Inverse masses of bodies along all axes, a and b of each pair of a group [1/kg].
template <class S>
struct LaneMassMatrices {
  using Algebra = LaneAlgebra<S, typename LaneBlock<S>::Values>;
  typename Algebra::template Symmetric<Algebra::dim> a{}, b{};

  void set(std::size_t lane, const InverseMass<S>& of_a, const InverseMass<S>& of_b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      a[i][lane] = of_a.linear()[i];
      b[i][lane] = of_b.linear()[i];
    }
  }
};

}  // namespace moreau::detail
