// SPDX-License-Identifier: MIT
// Detection alone: a die comes down on another, turning, and all that can be asked of the pair is
// asked at each height, with a memory of the pair.
#include <iostream>
#include <moreau/detect/collide.hpp>
#include <moreau/detect/reduce.hpp>
#include <vector>

int main() {
  using Shape = moreau::Polyhedron<double>;  // any shape, in the plane too
  using S = moreau::SpaceOf<Shape>;
  using Vector = S::Vector;

  std::vector<Vector> corners;
  for (int k = 0; k < 8; ++k)
    corners.push_back(0.02 * (Vector(k & 1, k >> 1 & 1, k >> 2) - Vector::Constant(0.5)));
  const Shape die(corners);

  // A shape where it stands: made once, updated when it moves.
  const moreau::Placed<Shape> below(die);
  moreau::Placed<Shape> above(die);

  // One memory per pair. It saves time; the answers are those of an empty one, to the bit.
  moreau::PairCache<S> cache;
  moreau::Manifold<S> manifold;

  for (int step = 0; step <= 6; ++step) {
    above.update(die, {{0.004, 0.003, 0.0215 - 0.0003 * step}, S::exp({0, 0, 0.05 * step})});

    // Whether they have a point in common.
    const bool together = overlap(below, above, cache);
    // How far apart, or how deep; the normal from the first to the second; a point of each surface.
    const moreau::SignedDistance<S> apart = distance(below, above, cache);
    // The points of contact, if the gap is at most the margin.
    const bool touch = collide(below, above, 0.0005, manifold, cache);

    std::cout << (together ? "together" : "apart") << ", gap " << 1e3 * apart.gap << " mm";
    if (touch) {
      std::cout << ", " << manifold.points.size() << " points, " << name(manifold.contact_class);
      reduce(manifold, 3);  // those three that carry nearly the same load
      std::cout << ", kept:";
      for (const moreau::ManifoldPoint<S>& point : manifold.points)
        std::cout << " (" << 1e3 * point.position.transpose() << ") mm";
    }
    std::cout << '\n';
  }
}
