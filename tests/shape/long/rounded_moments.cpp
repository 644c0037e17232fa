// SPDX-License-Identifier: MIT
// The moments of rounded grains, compared with sums over many points.
#include "moreau/shape/rounded_moments.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <random>
#include <vector>

#include "moreau/detect/pairs/collide_ball_polytope.hpp"

#include "detect/shapes.hpp"
#include "sanitized.hpp"

namespace {

using namespace moreau;
constexpr double pi = std::numbers::pi;

/// The moments of all points at most r from a polytope, computed by counting grid points.
template <class Core>
Moments<SpaceOf<Core>> counted(const Core& core, double r, int samples, std::mt19937_64& random) {
  using S = SpaceOf<Core>;
  using Vector = typename S::Vector;
  const double size = core.circumradius() + r, tiny = 1e-9;
  const Placed<Core> placed(core);
  std::uniform_real_distribution<double> coordinate(-size, size);
  Moments<S> sum;
  for (int i = 0; i < samples; ++i) {
    Vector x;
    for (double& c : x) c = coordinate(random);
    const BallIn<S> ball(tiny);
    const Placed<BallIn<S>> point(ball, Pose<S>{x, S::identity()});
    if (distance(point, placed).gap + tiny > r) continue;
    sum += {1, x, x * x.transpose()};
  }
  const double share = std::pow(2 * size, S::dim) / samples;
  return {share * sum.volume, share * sum.first, share * sum.second};
}

TEST_CASE_TEMPLATE("moments of rounded grains by counting points", S, Space<2>, Space<3>) {
  std::mt19937_64 random(11);
  for (const double r : {0.1, 1.0}) {
    const auto core = samples::grain(S{}, random);
    const Moments<S> exact = rounded_moments(core, r);
    const Moments<S> rough = counted(core, r, rounds(200000), random);
    const double size = core.circumradius() + r;
    CHECK(rough.volume == doctest::Approx(exact.volume).epsilon(0.01));
    CHECK((rough.first - exact.first).norm() < 0.01 * exact.volume * size);
    CHECK((rough.second - exact.second).norm() < 0.01 * exact.volume * size * size);
  }
}

TEST_CASE("the cones of a polyhedron's vertices by counting directions") {
  using S = Space<3>;
  using Vector = S::Vector;
  std::mt19937_64 random(12);
  const Polyhedron<double> core = samples::grain(S{}, random);
  std::vector<detail::VertexCone<double>> cones(core.vertex_count());
  for (std::size_t f = 0; f < core.face_count(); ++f) detail::face_moments(core, f, cones);
  const auto row = [](const auto& rows, auto i) -> Vector {
    return rows.row(static_cast<Eigen::Index>(i)).transpose();
  };
  for (const auto& edge : core.edges()) {
    const Vector along =
        (row(core.vertices(), edge.vertex[1]) - row(core.vertices(), edge.vertex[0])).normalized();
    const Vector n = row(core.face_normals(), edge.face[0]);
    const Vector m = row(core.face_normals(), edge.face[1]);
    cones[edge.vertex[0]].add_edge(along, n, m);
    cones[edge.vertex[1]].add_edge(-along, n, m);
  }
  // Points on a spiral from pole to pole, each with the same share of the sphere's surface.
  const int count = rounds(400000);
  std::vector<Moments<S>> counted(core.vertex_count());
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, angle = pi * (3 - std::sqrt(5.0)) * i;
    const double around = std::sqrt(1 - z * z);
    const Vector n(around * std::cos(angle), around * std::sin(angle), z);
    counted[core.support_vertex(n)] += {1, n, n * n.transpose()};
  }
  double whole = 0;
  for (std::size_t v = 0; v < cones.size(); ++v) {
    const Moments<S> cone = cones[v].moments(1);
    const double share = 4 * pi / count, close = sanitizer_share * 3e-4;
    CHECK(std::abs(share * counted[v].volume / 3 - cone.volume) < close);
    CHECK((share / 4 * counted[v].first - cone.first).norm() < close);
    CHECK((share / 5 * counted[v].second - cone.second).norm() < close);
    whole += cone.volume;
  }
  CHECK(whole == doctest::Approx(4 * pi / 3).epsilon(1e-13));
}

}  // namespace
