// SPDX-License-Identifier: MIT
#include "moreau/shape/compound.hpp"

#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <stdexcept>

#include "moreau/mesh/surface_mesh.hpp"
#include "moreau/sample/compound_ballast.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/capsule.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/regular_shape.hpp"

#include "conformance/shape.hpp"
#include "detect/shapes.hpp"
#include "shape/compounds.hpp"
#include "shape/message_of.hpp"
#include "types.hpp"

using namespace moreau;

namespace {

using Vector2 = Space<2>::Vector;

/// Relative difference of mass properties.
template <class S>
double difference(const MassProperties<S>& a, const MassProperties<S>& b) {
  const double size = std::pow(double(b.mass), 1.0 / S::dim);
  return std::max({std::abs(double(a.mass / b.mass) - 1),
                   double((a.center - b.center).norm()) / size,
                   double((a.inertia - b.inertia).norm() / b.inertia.norm())});
}

}  // namespace

TEST_CASE_TEMPLATE("a grain cut in two has the mass properties of the whole", Part, Polygon<>,
                   Polyhedron<>) {
  using S = SpaceOf<Part>;
  std::mt19937_64 random(5);
  for (int k = 0; k < 20; ++k) {
    const Part whole = samples::grain(S{}, random);
    const auto normal = samples::direction<S>(random);
    const auto parts = compounds::halves<Part>(whole, normal, 0.2 * whole.inradius() * normal);
    const Compound<Part> grain{std::span<const Part>(parts)};
    CHECK(difference(grain.mass_properties(3.0), whole.mass_properties(3.0)) < 1e-12);
    CHECK(grain.centroid_of_input().norm() < 1e-13);
    CHECK(grain.volume_share() == doctest::Approx(1).epsilon(1e-14));
    CHECK(std::abs(grain.circumradius() - whole.circumradius()) < 1e-13);
  }
}

TEST_CASE_TEMPLATE("mass properties of an L against the integral", Part, Polygon<>, Polyhedron<>) {
  using S = SpaceOf<Part>;
  // A square with the side 3 without one with the side 2; in space 1 deep.
  const Compound<Part> l(
      {compounds::box<Part>(compounds::point<S>(0, 0), compounds::point<S>(3, 1, 1)),
       compounds::box<Part>(compounds::point<S>(0, 1), compounds::point<S>(1, 3, 1))});
  const Part large = compounds::box<Part>(compounds::point<S>(0, 0), compounds::point<S>(3, 3, 1));
  const Part small = compounds::box<Part>(compounds::point<S>(1, 1), compounds::point<S>(3, 3, 1));
  const auto a = large.mass_properties(1), b = small.mass_properties(1);
  const typename S::Vector centre =
      (a.mass * large.centroid_of_input() - b.mass * small.centroid_of_input()) / (a.mass - b.mass);
  const auto about = [&](const Part& part, double mass) -> typename S::Inertia {
    const typename S::Lever arm = S::lever(part.centroid_of_input() - centre);
    return mass * arm.transpose() * arm;
  };
  const typename S::Inertia inertia =
      a.inertia + about(large, a.mass) - b.inertia - about(small, b.mass);
  CHECK((l.centroid_of_input() - centre).norm() < 1e-14);
  CHECK(std::abs(l.volume() - 5) < 1e-14);
  CHECK((l.mass_properties(2).inertia - 2 * inertia).norm() < 1e-12 * inertia.norm());
}

TEST_CASE("grains of the guide") {
  const Polygon<double> foot({{0, 0}, {0.02, 0}, {0.02, 0.01}, {0, 0.01}});
  const Polygon<double> leg({{0, 0.01}, {0.01, 0.01}, {0.01, 0.03}, {0, 0.03}});
  const Compound<Polygon<double>> l({foot, leg});
  CHECK((l.centroid_of_input() - Vector2(0.0075, 0.0125)).norm() < 1e-15);

  const Ball<double> ball(0.005);
  const Compound<Ball<double>> dumbbell({{ball, {{-0.005, 0, 0}}}, {ball, {{0.005, 0, 0}}}});
  CHECK(dumbbell.volume() == doctest::Approx(2 * ball.volume()));

  const Ball<double> small(0.003);
  const Compound<Ball<double>>::Part clump_parts[] = {{ball, {}}, {small, {{0.006, 0, 0}}}};
  MassProperties<Space<3>> measured;  // at density 1, in the frame of the parts
  measured.mass = 5.9e-7;             // the volume [m^3]
  measured.center = {0.0007, 0, 0};   // [m]
  measured.inertia.diagonal() << 5.8e-12, 8.1e-12, 8.1e-12;  // about the centre [m^5]
  const Compound<Ball<double>> clump(clump_parts, measured);
  CHECK(clump.volume() == 5.9e-7);

  std::mt19937_64 random(1);
  const auto stones = ballast_shapes<Compound<Polyhedron<double>>>(4, random);
  CHECK(stones[0].parts().size() == 4);
  CHECK(stones[0].circumradius() == doctest::Approx(1));
}

TEST_CASE_TEMPLATE("two balls, in the plane two disks", S, Space<2>, Space<3>) {
  using Grain = Compound<BallIn<S>>;
  const typename S::Vector x = S::Vector::UnitX();
  const BallIn<S> ball(1.5);
  const Grain dumbbell({{ball, {1.5 * x}}, {ball, {-1.5 * x}}});
  const auto one = ball.mass_properties(1), both = dumbbell.mass_properties(1);
  const typename S::Lever arm = S::lever(1.5 * x);
  CHECK(both.mass == doctest::Approx(2 * one.mass).epsilon(1e-14));
  CHECK((both.inertia - 2 * (one.inertia + one.mass * arm.transpose() * arm)).norm() < 1e-13);
  CHECK(dumbbell.circumradius() == doctest::Approx(3));
}

TEST_CASE_TEMPLATE("parts that overlap need mass properties", S,
                   MOREAU_TYPES((Space<2>, Space<3>), (Space<2, float>, Space<3, float>))) {
  using T = typename S::Scalar;
  using Grain = Compound<BallIn<S>>;
  using Part = typename Grain::Part;
  const typename S::Vector x = S::Vector::UnitX();
  const std::vector<Part> apart{{BallIn<S>(1), {T(2.1) * x}}, {BallIn<S>(1), {}}};
  std::vector<Part> close = apart;
  close[0].pose.position = T(1.9) * x;
  const std::vector<Part> same(2);
  CHECK_NOTHROW(Grain{std::span<const Part>(apart)});
  CHECK(message_of([&] { Grain{std::span<const Part>(close)}; }) ==
        "Compound: parts = 0 and 1 must not overlap, unless the mass properties of the grain are "
        "given");
  MassProperties<S> mass = BallIn<S>(1).mass_properties(1);
  mass.center = T(0.95) * x;
  mass.mass *= T(1.9);
  const Grain clump(std::span<const Part>(close), mass);
  CHECK(double(clump.volume_share()) == doctest::Approx(0.95));
  CHECK((clump.parts()[0].pose.position - T(0.95) * x).norm() < T(1e-6));
  const auto refused = [&](const auto& change) {
    MassProperties<S> bad = mass;
    change(bad);
    return message_of([&] { Grain(std::span<const Part>(close), bad); });
  };
  CHECK(refused([](auto& m) { m.inertia.setZero(); }).find("inertia") != std::string::npos);
  CHECK(refused([](auto& m) { m.inertia *= 2700; }).find("inertia") != std::string::npos);
  CHECK(refused([](auto& m) { m.mass *= 1000; }).find("volume") != std::string::npos);
  CHECK(refused([&](auto& m) { m.center = 5 * x; }).find("center") != std::string::npos);
  if constexpr (S::dim == 3) {
    CHECK(refused([](auto& m) { m.inertia(0, 1) += m.inertia(0, 0); }).find("symmetric") !=
          std::string::npos);
    CHECK(refused([](auto& m) { m.inertia(2, 2) *= 3; }).find("inertia") != std::string::npos);
  }
  CHECK_THROWS_AS(Grain(std::vector<Part>{}), std::invalid_argument);
}

TEST_CASE_TEMPLATE("mass properties of concave ballast against the integral over its surface", Part,
                   Polygon<>, Polyhedron<>) {
  using S = SpaceOf<Part>;
  std::mt19937_64 random(9);
  for (int k = 0; k < 10; ++k) {
    const auto grain = Ballast<Compound<Part>>::draw(random);
    SurfaceMesh<S> mesh;
    SurfaceMesher<S>().mesh(grain, mesh);
    Moments<S> moments;
    std::size_t first = 0;
    for (const std::int32_t end : mesh.ends) {
      // A fan of triangles of a face; in the plane the segments of an outline.
      const std::size_t count = std::size_t(end) - first, fixed = S::dim - 2;
      for (std::size_t i = fixed; i < (fixed > 0 ? count - 1 : count); ++i) {
        typename S::Matrix corners;
        const std::size_t of[] = {i, (i + 1) % count, 0};
        for (int c = 0; c < S::dim; ++c) {
          const std::size_t corner = of[std::size_t(c)];
          corners.col(c) = mesh.points[std::size_t(mesh.corners[first + corner])];
        }
        moments.add_simplex(corners);
      }
      first = std::size_t(end);
    }
    const MassProperties<S> integral(moments.volume, moments.first / moments.volume,
                                     moments.centered().inertia());
    CHECK(difference(grain.mass_properties(1), integral) < 1e-12);
  }
}

TEST_CASE("parts of other shapes: of several types, rounded in float") {
  using Mixed = OneOf<Capsule<>, Ball<>, Polyhedron<>>;
  const Capsule<> handle(2, 0.5);
  const Compound<Mixed> hammer(
      {{handle, {}}, {regular_shape<Polyhedron<>>(2), {{3.5, 0, 0}}}, {Ball<>(1), {{-3.5, 0, 0}}}});
  CHECK(hammer.volume() ==
        doctest::Approx(handle.volume() + 8 + Ball<>(1).volume()).epsilon(1e-14));
  conformance::check_grain(hammer);
#ifdef MOREAU_TEST_FURTHER_TYPES
  using Corner = Rounded<Polyhedron<float>>;
  const Corner corner(regular_shape<Polyhedron<float>>(1), 0.1f);
  conformance::check_grain(Compound<Corner>({{corner, {}}, {corner, {{1.2f, 0, 0}}}}));
#endif
}

TEST_CASE_TEMPLATE("requirements on grains of parts", Part,
                   MOREAU_TYPES((Polygon<>, Polyhedron<>), (Polygon<float>, Polyhedron<float>))) {
  std::mt19937_64 random(3);
  for (int k = 0; k < 5; ++k) conformance::check_grain(Ballast<Compound<Part>>::draw(random));
  if constexpr (std::same_as<typename SpaceOf<Part>::Scalar, double>)
    conformance::check_grain(compounds::tetrapod<Part>(0.3));
}
