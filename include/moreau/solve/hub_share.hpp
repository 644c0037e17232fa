// SPDX-License-Identifier: MIT
// The rule for a hub, a body with many partners whose contacts are solved at the same time: all of them see its
// velocity before, and their changes of it are added up afterwards. A heavier block makes up for the impulses of the
// others,
//
//     W' = (1 + (n - 1) tr(W^-1 W_hub)) W  >=  W + (n - 1) W_hub,        n contacts at the same time,
//
// as if each contact had an n-th of the mass of the hub (mass splitting: R. Tonge, F. Benevolenski and A. Voroshilov,
// ACM Trans. Graph. 31 (2012) 105). The fixed point does not change.
#pragma once

#include <cstddef>

#include "moreau/core/small_matrix.hpp"

namespace moreau::detail {

/// tr(W^-1 W_hub), the share of the hub in W of a contact [-].
/// @param hub_is_a whether the hub is body a of the contact
template <class Operator>
typename Operator::Scalar share_of_hub(const Operator& op, std::size_t c, bool hub_is_a) {
  using Matrix = typename Operator::Matrix;
  const Matrix of_hub = hub_is_a ? op.block_of_a(c) : op.block_of_b(c);
  const Matrix inverse = inverse_of(Matrix(op.block(c).matrix()));
  return inverse.cwiseProduct(of_hub).sum();
}

/// The factor of W' [-].
/// @param together contacts of the hub that are solved at the same time, n
template <class Operator, class Count>
typename Operator::Scalar heavier_by_hub(const Operator& op, std::size_t c, bool hub_is_a,
                                         Count together) {
  return 1 + static_cast<typename Operator::Scalar>(together - 1) * share_of_hub(op, c, hub_is_a);
}

}  // namespace moreau::detail
