// SPDX-License-Identifier: MIT
// The near parts of pairs of compound grains: those that a test of all parts finds, also where trees find them.
#include <cstddef>
#include <cstdint>
#include <doctest/doctest.h>
#include <random>
#include <vector>

#include "moreau/detect/collide.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/compound.hpp"
#include "moreau/world/detail/pair_caches.hpp"

using namespace moreau;

namespace {

template <class ShapeT>
struct Grain {
  Placed<ShapeT> placed;
  typename SpaceOf<ShapeT>::Vector center;
};

}  // namespace

TEST_CASE_TEMPLATE("near parts of a grain with many parts and many neighbours", Part, Disk<double>,
                   Ball<double>, Disk<float>, Ball<float>) {
  using ShapeT = Compound<Part>;
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  constexpr std::size_t neighbours = 100;
  constexpr T width = 2, radius = T(0.05), margin = T(0.02);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-0.5, 0.5);
  const auto somewhere = [&] {
    Vector x;
    for (int k = 0; k < S::dim; ++k) x[k] = T(place(random));
    return x;
  };
  const auto grain_of = [&](std::size_t parts, T size) {
    std::vector<typename ShapeT::Part> list;
    for (std::size_t k = 0; k < parts; ++k)
      list.push_back({Part(radius), Pose<S>(Vector(k == 0 ? Vector(Vector::Zero())
                                                          : Vector(size * somewhere())))});
    return ShapeT(list, Part(radius).mass_properties(1));
  };
  const Vector shift = Vector::UnitX() * width;
  for (const std::size_t large : {std::size_t(0), neighbours / 2, neighbours}) {
    CAPTURE(large);
    const ShapeT wide = grain_of(300, width), narrow = grain_of(3, T(0.3));
    std::vector<Grain<ShapeT>> grains;
    std::vector<IndexPair> pairs;
    for (std::size_t k = 0; k <= neighbours; ++k) {
      Vector x = k == large ? Vector(Vector::Zero()) : Vector(width * somewhere());
      // The second grain of a pair is a cell away.
      if (k > large) x -= shift;
      if (k == large && large == neighbours) x -= shift;
      if (k < large && large != neighbours) x += shift;
      grains.push_back({Placed<ShapeT>(k == large ? wide : narrow, Pose<S>(x)), x});
      if (k < large) pairs.push_back({std::uint32_t(k), std::uint32_t(large)});
      if (k > large) pairs.push_back({std::uint32_t(large), std::uint32_t(k)});
    }
    const std::vector<Vector> shifts(pairs.size(), shift);
    detail::PairCaches<ShapeT> caches;
    caches.renew(pairs, {}, shifts, grains, margin / 2);
    std::size_t count = 0;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const Placed<ShapeT>& a = grains[pairs[p].first].placed;
      const Placed<ShapeT> b(pairs[p].second == large ? wide : narrow,
                             Pose<S>(Vector(grains[pairs[p].second].center + shift)));
      std::vector<IndexPair> found, all;
      Manifold<S> out;
      caches.collide_parts(p, a, S::identity(), b, S::identity(), margin, 0, 0, out, [&] {
        found.push_back({out.part_a, out.part_b});
      });
      for (std::uint32_t i = 0; i < a.part_count(); ++i)
        for (std::uint32_t j = 0; j < b.part_count(); ++j)
          if (PairCache<S> cache; collide(a.part(i), b.part(j), margin, out, cache))
            all.push_back({i, j});
      CHECK(found == all);
      count += all.size();
    }
    CHECK(count > 50);
  }
}
