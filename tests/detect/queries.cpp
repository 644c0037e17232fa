// SPDX-License-Identifier: MIT
// The queries overlap, distance and collide for all pairs of elementary shapes.
#include "detect/queries.hpp"

#include "moreau/shape/support_box.hpp"

using namespace queries;

TEST_CASE("every query for every pair in space") {
  using Solid = Polyhedron<double>;
  using Wall = HalfSpace<Space<3>>;
  std::mt19937_64 random(1);
  check_pair<Ball<double>, Ball<double>>(random);
  check_pair<Ball<double>, Solid>(random);
  check_pair<Solid, Solid>(random);
  check_pair<Ball<double>, Wall>(random);
  check_pair<Solid, Wall>(random);
}

TEST_CASE("every query for every pair in the plane") {
  using Wall = HalfSpace<Space<2>>;
  std::mt19937_64 random(2);
  check_pair<Disk<double>, Disk<double>>(random);
  check_pair<Disk<double>, Polygon<double>>(random);
  check_pair<Polygon<double>, Polygon<double>>(random);
  check_pair<Disk<double>, Wall>(random);
  check_pair<Polygon<double>, Wall>(random);
}

TEST_CASE("shapes known by their support alone, against all others") {
  using Solid = Opaque<Polyhedron<double>>;
  using Flat = Opaque<Polygon<double>>;
  std::mt19937_64 random(3);
  check_pair<Solid, Solid>(random);
  check_pair<Solid, Polyhedron<double>>(random);
  check_pair<Polyhedron<double>, Solid>(random);
  check_pair<Ball<double>, Solid>(random);
  check_pair<Solid, HalfSpace<Space<3>>>(random);
  check_pair<Flat, Flat>(random);
  check_pair<Polygon<double>, Flat>(random);
  check_pair<Disk<double>, Flat>(random);
  check_pair<Flat, HalfSpace<Space<2>>>(random);
}

TEST_CASE("ellipsoids and ellipses") {
  std::mt19937_64 random(4);
  check_pair<Ellipsoid<Space<3>>, Ellipsoid<Space<3>>>(random);
  check_pair<Ellipsoid<Space<3>>, Polyhedron<double>>(random);
  check_pair<Ball<double>, Ellipsoid<Space<3>>>(random);
  check_pair<Ellipsoid<Space<2>>, Ellipsoid<Space<2>>>(random);
  check_pair<Ellipsoid<Space<2>>, Polygon<double>>(random);
}

TEST_CASE("what a polytope shows of its support gives the gap of its faces and edges") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> apart(0, 2.2);
  for (int i = 0; i < rounds(500); ++i) {
    const auto a = Draw<Opaque<Polyhedron<double>>>::from(random);
    const auto b = Draw<Opaque<Polyhedron<double>>>::from(random);
    const Pose<Space<3>> pose{apart(random) * samples::direction<Space<3>>(random),
                              samples::rotation(Space<3>{}, random)};
    const auto exact = distance(Placed(a.inside), Placed(b.inside, pose));
    CHECK(std::abs(distance(Placed(a), Placed(b, pose)).gap - exact.gap) < tiny);
  }
}

namespace {

/// A disc without thickness, perpendicular to its z axis.
struct FlatDisc {
  using Space = moreau::Space<3>;
  using Vector = Space::Vector;
  Vector support(const Vector& d) const {
    const double across = std::hypot(d[0], d[1]);
    return across > 0 ? Vector(d[0] / across, d[1] / across, 0) : Vector(0, 0, 0);
  }
  Aabb<Space> bounding_box(const Pose<Space>& pose) const { return support_box(*this, pose); }
};

}  // namespace

TEST_CASE("discs without thickness that overlap in one plane have a unit normal") {
  const FlatDisc core;
  for (const Space<3>::Vector& place :
       {Space<3>::Vector(0.5, 0, 0), Space<3>::Vector(0, 0.5, 0), Space<3>::Vector(0.3, 0.4, 0)}) {
    const Pose<Space<3>> pose{place, Space<3>::identity()};
    const auto found = distance(Placed(core, {}), Placed(core, pose));
    CHECK(found.normal.norm() == doctest::Approx(1));
    CHECK(found.gap <= 0);
    CHECK(found.gap >= -1e-6);
  }
}
