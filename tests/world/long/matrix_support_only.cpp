// SPDX-License-Identifier: MIT
#include "moreau/shape/capsule.hpp"

#include "conformance/matrix.hpp"
#include "conformance/support_only.hpp"

using FlatFloat = moreau::Space<2, float>;  // a comma would end the macro's argument
using DeepFloat = moreau::Space<3, float>;

TEST_CASE_TEMPLATE("a shape known by its farthest points under every law", S, moreau::Space<2>,
                   moreau::Space<3>, FlatFloat, DeepFloat) {
  using T = typename S::Scalar;
  using Grain = conformance::SupportOnly<moreau::CapsuleIn<S>>;
  static_assert(moreau::ConvexShape<Grain> && !moreau::HasCircumradius<Grain>);
  conformance::all_laws(Grain(moreau::CapsuleIn<S>(T(0.0025), T(0.0025))), T(0.01));
}
