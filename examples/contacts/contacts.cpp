// SPDX-License-Identifier: MIT
// Contact detection without a simulation. A die turns as it moves down onto a second die. At each
// height the program makes the three queries that a pair of shapes answers.
#include <iostream>
#include <moreau/detect/collide.hpp>
#include <moreau/detect/reduce.hpp>
#include <vector>

int main() {
  using Shape = moreau::Polyhedron<double>;  // any shape of the library, also in the plane
  using S = moreau::SpaceOf<Shape>;
  using Vector = S::Vector;

  std::vector<Vector> corners;
  for (int k = 0; k < 8; ++k)
    corners.push_back(0.02 * (Vector(k & 1, k >> 1 & 1, k >> 2) - Vector::Constant(0.5)));
  const Shape die(corners);

  // A placed shape is constructed once and updated when it moves.
  const moreau::Placed<Shape> below(die);
  moreau::Placed<Shape> above(die);

  // One cache per pair saves time. For these shapes it changes no bit of the answers.
  moreau::PairCache<S> cache;
  moreau::Manifold<S> manifold;

  for (int step = 0; step <= 6; ++step) {
    above.update(die, {{0.004, 0.003, 0.0215 - 0.0003 * step}, S::exp({0, 0, 0.05 * step})});

    // Do the shapes have a point in common?
    const bool together = overlap(below, above, cache);
    // Signed distance (< 0 is penetration), normal from below to above, a point on each surface.
    const moreau::SignedDistance<S> apart = distance(below, above, cache);
    // Contact points, if the gap is at most the margin of 0.5 mm.
    const bool touch = collide(below, above, 0.0005, manifold, cache);

    std::cout << (together ? "overlap" : "no overlap") << ", gap " << 1e3 * apart.gap << " mm";
    if (touch) {
      std::cout << ", " << manifold.points.size() << " points, " << name(manifold.contact_class);
      reduce(manifold, 3);  // at most three points, which carry nearly the same load
      std::cout << ", reduced to";
      for (const moreau::ManifoldPoint<S>& point : manifold.points)
        std::cout << " (" << 1e3 * point.position.transpose() << ") mm";
    }
    std::cout << '\n';
  }
  return 0;
}
