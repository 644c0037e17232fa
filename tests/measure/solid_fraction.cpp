// SPDX-License-Identifier: MIT
#include "moreau/measure/solid_fraction.hpp"

#include <array>
#include <concepts>
#include <doctest/doctest.h>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/measure/region.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/capsule.hpp"
#include "moreau/shape/cylinder.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/shape/rounded.hpp"
#include "moreau/world/simulation.hpp"

#include "types.hpp"

namespace {

using namespace moreau;

#define MOREAU_SHAPES_IN_DOUBLE \
  MOREAU_TYPES((Polyhedron<double>, Disk<double>), (Polygon<double>, Ball<double>))

template <class T>
constexpr T tolerance = std::numeric_limits<T>::epsilon() * T(1000);

template <class T>
using V2 = typename Space<2, T>::Vector;
template <class T>
using V3 = typename Space<3, T>::Vector;

template <class S>
typename S::Vector random_vector(std::mt19937_64& random, typename S::Scalar size) {
  std::uniform_real_distribution<typename S::Scalar> uniform(-size, size);
  typename S::Vector x;
  for (auto& component : x) component = uniform(random);
  return x;
}

template <class S>
Pose<S> random_pose(std::mt19937_64& random, typename S::Scalar spread) {
  typename S::Angular turn;
  for (auto& component : turn)
    component = std::uniform_real_distribution<typename S::Scalar>(-2, 2)(random);
  return {random_vector<S>(random, spread), S::exp(turn)};
}

/// The convex hull of random points near an ellipsoid, with a circumradius of about one.
template <class Shape>
Shape random_polytope(std::mt19937_64& random, int points) {
  using S = SpaceOf<Shape>;
  std::vector<typename S::Vector> vertices;
  while (vertices.size() < static_cast<std::size_t>(points)) {
    typename S::Vector x = random_vector<S>(random, 1);
    const auto norm = x.norm();
    if (norm > 1 || norm < typename S::Scalar(0.2)) continue;
    x /= norm;
    x[0] *= typename S::Scalar(0.6);
    vertices.push_back(x);
  }
  return Shape(std::span<const typename S::Vector>(vertices));
}

template <class Shape>
Shape make_shape(std::mt19937_64& random) {
  if constexpr (requires(Shape s) { s.vertices(); })
    return random_polytope<Shape>(random, 20);
  else
    return Shape(std::uniform_real_distribution<typename Shape::Scalar>(0.5, 1.5)(random));
}

template <class S>
Aabb<S> random_box(std::mt19937_64& random, typename S::Scalar size) {
  Aabb<S> box;
  box.merge(random_vector<S>(random, size));
  box.merge(random_vector<S>(random, size));
  box.upper.array() += typename S::Scalar(1e-3);
  return box;
}

/// In this order of vertices the volumes of the parts of a cuboid have no rounding.
template <class T>
Polyhedron<T> cuboid(const V3<T>& half) {
  std::vector<V3<T>> v;
  for (int i = 0; i < 8; ++i)
    v.push_back(
        {i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(), i & 4 ? half.z() : -half.z()});
  return Polyhedron<T>(std::span<const V3<T>>(v));
}

template <class T>
Aabb<Space<3, T>> box_of(T x0, T y0, T z0, T x1, T y1, T z1) {
  return {V3<T>(x0, y0, z0), V3<T>(x1, y1, z1)};
}

/// The volume of the intersection, computed without clipping: the hull of all corners of the
/// intersection, which are found by brute force.
double hull_of_intersection(const Polyhedron<double>& shape, const Pose<Space<3>>& pose,
                            const Aabb<Space<3>>& box) {
  std::vector<std::pair<V3<double>, double>> planes;
  for (Eigen::Index f = 0; f < shape.face_normals().rows(); ++f) {
    const V3<double> n = pose.rotation * V3<double>(shape.face_normals().row(f).transpose());
    planes.emplace_back(n, shape.face_offsets()[f] + n.dot(pose.position));
  }
  for (int k = 0; k < 3; ++k) {
    planes.emplace_back(V3<double>::Unit(k), box.upper[k]);
    planes.emplace_back(-V3<double>::Unit(k), -box.lower[k]);
  }
  std::vector<V3<double>> corners;
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = i + 1; j < planes.size(); ++j)
      for (std::size_t k = j + 1; k < planes.size(); ++k) {
        Eigen::Matrix3d n;
        n << planes[i].first.transpose(), planes[j].first.transpose(), planes[k].first.transpose();
        if (std::abs(n.determinant()) < 1e-9) continue;
        const V3<double> x =
            n.inverse() * V3<double>(planes[i].second, planes[j].second, planes[k].second);
        bool inside = true;
        for (const auto& [normal, offset] : planes)
          inside = inside && normal.dot(x) <= offset + 1e-10;
        if (inside) corners.push_back(x);
      }
  return corners.size() < 4 ? 0 : Polyhedron<double>(std::span<const V3<double>>(corners)).volume();
}

}  // namespace

TEST_CASE_TEMPLATE("clipped volume adds up over the parts of a box", Shape,
                   MOREAU_TYPES((Polyhedron<double>, Polygon<double>, Ball<double>, Disk<double>),
                                (Polyhedron<float>, Polygon<float>, Ball<float>, Disk<float>))) {
  using S = SpaceOf<Shape>;
  using T = typename S::Scalar;
  std::mt19937_64 random(1);
  ClipWorkspace<S> workspace;
  for (int trial = 0; trial < 300; ++trial) {
    const Shape shape = make_shape<Shape>(random);
    const Pose<S> pose = random_pose<S>(random, T(0.8));
    const Aabb<S> box = random_box<S>(random, T(1.5));
    const T whole = clipped_volume(shape, pose, box, workspace);
    CHECK(whole <= std::min(shape.volume(), volume(box)) * (1 + tolerance<T>));
    const int axis = trial % S::dim;
    const T cut = std::uniform_real_distribution<T>(T(0.1), T(0.9))(random);
    Aabb<S> low = box, high = box;
    low.upper[axis] = high.lower[axis] =
        box.lower[axis] + cut * (box.upper[axis] - box.lower[axis]);
    const T parts =
        clipped_volume(shape, pose, low, workspace) + clipped_volume(shape, pose, high, workspace);
    CHECK(std::abs(parts - whole) <= tolerance<T> * shape.volume());
  }
}

TEST_CASE_TEMPLATE("the cells of a grid around a shape share its whole volume", Shape,
                   MOREAU_SHAPES_IN_DOUBLE) {
  using S = SpaceOf<Shape>;
  std::mt19937_64 random(2);
  ClipWorkspace<S> workspace;
  for (int trial = 0; trial < 10; ++trial) {
    const Shape shape = make_shape<Shape>(random);
    const Pose<S> pose = random_pose<S>(random, 0.2);
    constexpr int cells = 7;
    int count = 1;
    for (int k = 0; k < S::dim; ++k) count *= cells;
    double sum = 0;
    for (int cell = 0; cell < count; ++cell) {
      Aabb<S> box;
      for (int k = 0, rest = cell; k < S::dim; ++k, rest /= cells) {
        box.lower[k] = -2 + 4.0 * (rest % cells) / cells;
        box.upper[k] = -2 + 4.0 * (rest % cells + 1) / cells;
      }
      sum += clipped_volume(shape, pose, box, workspace);
    }
    CHECK(sum == doctest::Approx(shape.volume()).epsilon(1e-13));
  }
}

TEST_CASE("a clipped polyhedron has the volume of the hull of its corners") {
  std::mt19937_64 random(3);
  ClipWorkspace<Space<3>> workspace;
  int cut = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const auto shape = random_polytope<Polyhedron<double>>(random, 9);
    const auto pose = random_pose<Space<3>>(random, 0.5);
    const auto box = random_box<Space<3>>(random, 1.0);
    const double clipped = clipped_volume(shape, pose, box, workspace);
    const double truth = hull_of_intersection(shape, pose, box);
    cut += clipped > 0 && clipped < shape.volume() ? 1 : 0;
    CHECK(std::abs(clipped - truth) <= 1e-12 * shape.volume());
  }
  CHECK(cut > 25);
}

TEST_CASE_TEMPLATE("clipped volume agrees with random sampling", Shape, MOREAU_SHAPES_IN_DOUBLE) {
  using S = SpaceOf<Shape>;
  std::mt19937_64 random(4);
  ClipWorkspace<S> workspace;
  const Shape shape = make_shape<Shape>(random);
  const Pose<S> pose = random_pose<S>(random, 0.1);
  Aabb<S> box{S::Vector::Constant(-0.3), S::Vector::Constant(0.5)};
  box.upper[0] = 2;
  const auto holds = [&](const typename S::Vector& x) {
    const typename S::Vector body = pose.to_body(x);
    if constexpr (requires { shape.radius(); })
      return body.norm() <= shape.radius();
    else
      return ((shape.face_normals() * body).array() <= shape.face_offsets()).all();
  };
  int hits = 0;
  constexpr int samples = 200000;
  for (int i = 0; i < samples; ++i) {
    typename S::Vector x;
    for (int k = 0; k < S::dim; ++k)
      x[k] = std::uniform_real_distribution<double>(box.lower[k], box.upper[k])(random);
    hits += holds(x) ? 1 : 0;
  }
  const double share = double(hits) / samples;
  const double deviation = std::sqrt(share * (1 - share) / samples);
  CHECK(std::abs(clipped_volume(shape, pose, box, workspace) / volume(box) - share) <
        5 * deviation);
}

TEST_CASE_TEMPLATE("cubes have closed forms", T, double) {
  using S = Space<3, T>;
  ClipWorkspace<S> workspace;
  const auto cube = cuboid<T>(V3<T>::Constant(1));
  const T pi = std::numbers::pi_v<T>, tol = tolerance<T>;
  Pose<S> pose;
  CHECK(std::abs(clipped_volume(cube, pose, box_of<T>(-9, -9, 0, 9, 9, 9), workspace) - 4) < tol);
  CHECK(std::abs(clipped_volume(cube, pose, box_of<T>(0, 0, 0, 9, 9, 9), workspace) - 1) < tol);
  const T inner = clipped_volume(
      cube, pose, box_of<T>(T(-0.5), T(-0.25), T(-0.125), T(0.5), T(0.25), T(0.125)), workspace);
  CHECK(std::abs(inner - T(0.125)) < tol);

  SUBCASE("turned by 45 degrees about z, a prism with a square section of diagonal 2 sqrt 2") {
    pose.rotation = typename S::Rotation(Eigen::AngleAxis<T>(pi / 4, V3<T>::UnitZ()));
    const T h = T(0.3);  // distance of the cutting plane from the outermost edge
    const T edge = std::numbers::sqrt2_v<T>;
    CHECK(std::abs(clipped_volume(cube, pose, box_of<T>(edge - h, -9, -9, 9, 9, 9), workspace) -
                   h * h * 2) < tol);
    CHECK(std::abs(clipped_volume(cube, pose, box_of<T>(0, -9, 0, 9, 9, 9), workspace) - 2) < tol);
  }
  SUBCASE("standing on a corner") {
    pose.rotation.setFromTwoVectors(V3<T>::Ones(), V3<T>::UnitZ());
    // The box cuts off a tetrahedron of height h and volume sqrt(3)/2 h^3.
    const T corner = std::sqrt(T(3)), h = T(0.5);
    CHECK(std::abs(clipped_volume(cube, pose, box_of<T>(-9, -9, corner - h, 9, 9, 9), workspace) -
                   std::sqrt(T(3)) / 2 * h * h * h) < tol);
    CHECK(std::abs(clipped_volume(cube, pose, box_of<T>(-9, -9, -9, 9, 9, 0), workspace) - 4) <
          tol);
  }
}

TEST_CASE_TEMPLATE("planes through faces, edges and vertices are no special case", T, double) {
  using S = Space<3, T>;
  ClipWorkspace<S> workspace;
  const auto cube = cuboid<T>(V3<T>::Constant(1));
  const T tol = tolerance<T>;
  Pose<S> pose;
  CHECK(std::abs(clipped_volume(cube, pose, box_of<T>(-1, -1, -1, 1, 1, 1), workspace) - 8) < tol);
  CHECK(clipped_volume(cube, pose, box_of<T>(1, -1, -1, 2, 1, 1), workspace) == 0);
  CHECK(clipped_volume(cube, pose, box_of<T>(1, 1, 1, 2, 2, 2), workspace) == 0);
  CHECK(std::abs(clipped_volume(cube, pose, box_of<T>(-1, -1, -1, 1, 0, 1), workspace) - 4) < tol);

  SUBCASE("faces within rounding of the planes, whichever side it falls on") {
    std::mt19937_64 random(5);
    const T pi = std::numbers::pi_v<T>, epsilon = std::numeric_limits<T>::epsilon();
    for (int trial = 0; trial < 500; ++trial) {
      const auto jitter = [&] {
        return 1 + epsilon * T(std::uniform_int_distribution<int>(-2, 2)(random));
      };
      pose.rotation =
          typename S::Rotation(Eigen::AngleAxis<T>(pi / 2 * T(trial % 4), V3<T>::Unit(trial % 3)));
      const auto box = box_of<T>(-jitter(), -jitter(), -jitter(), jitter(), jitter(), jitter());
      CHECK(std::abs(clipped_volume(cube, pose, box, workspace) - 8) < tol);
      auto half = box;
      half.lower[trial % 3] = 0;
      CHECK(std::abs(clipped_volume(cube, pose, half, workspace) - 4) < tol);
    }
  }
  SUBCASE("through the diagonals of an octahedron") {
    const std::vector<V3<T>> v = {V3<T>::UnitX(),  V3<T>::UnitY(),  V3<T>::UnitZ(),
                                  -V3<T>::UnitX(), -V3<T>::UnitY(), -V3<T>::UnitZ()};
    const Polyhedron<T> octahedron{std::span<const V3<T>>(v)};
    pose.rotation = S::identity();
    const T whole = T(4) / 3;
    CHECK(std::abs(clipped_volume(octahedron, pose, box_of<T>(0, -1, -1, 1, 1, 1), workspace) -
                   whole / 2) < tol);
    CHECK(std::abs(clipped_volume(octahedron, pose, box_of<T>(0, 0, -1, 1, 1, 1), workspace) -
                   whole / 4) < tol);
    CHECK(std::abs(clipped_volume(octahedron, pose, box_of<T>(0, 0, 0, 1, 1, 1), workspace) -
                   whole / 8) < tol);
    pose.rotation = typename S::Rotation(
        // With this rotation the planes of the box cut edges.
        Eigen::AngleAxis<T>(std::numbers::pi_v<T> / 4, V3<T>::UnitZ()));
    CHECK(std::abs(clipped_volume(octahedron, pose, box_of<T>(0, 0, -1, 1, 1, 1), workspace) -
                   whole / 4) < tol);
  }
}

TEST_CASE_TEMPLATE("a square and its corner", T, double) {
  using S = Space<2, T>;
  const std::vector<V2<T>> v = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const Polygon<T> square{std::span<const V2<T>>(v)};
  ClipWorkspace<S> workspace;
  Pose<S> pose;
  const Aabb<S> right{V2<T>(0, -9), V2<T>(9, 9)};
  CHECK(std::abs(clipped_volume(square, pose, right, workspace) - 2) < tolerance<T>);
  pose.rotation = typename S::Rotation(std::numbers::pi_v<T> / 4);
  const Aabb<S> tip{V2<T>(std::numbers::sqrt2_v<T> - T(0.3), -9), V2<T>(9, 9)};
  CHECK(std::abs(clipped_volume(square, pose, tip, workspace) - T(0.09)) < tolerance<T>);
}

TEST_CASE_TEMPLATE("balls and disks have closed forms", T, double) {
  const T pi = std::numbers::pi_v<T>, tol = tolerance<T>;
  ClipWorkspace<Space<3, T>> workspace;
  const Ball<T> ball(2);
  Pose<Space<3, T>> pose;
  CHECK(clipped_volume(ball, pose, box_of<T>(-2, -2, -2, 2, 2, 2), workspace) == ball.volume());
  CHECK(clipped_volume(ball, pose, box_of<T>(2, 0, 0, 3, 3, 3), workspace) == 0);
  CHECK(clipped_volume(ball, pose, box_of<T>(0, 0, 0, 1, 1, 1), workspace) == 1);
  CHECK(std::abs(clipped_volume(ball, pose, box_of<T>(0, 0, 0, 9, 9, 9), workspace) - 4 * pi / 3) <
        10 * tol);
  const T h = T(0.7);  // height of the spherical cap
  CHECK(std::abs(clipped_volume(ball, pose, box_of<T>(-9, -9, 2 - h, 9, 9, 9), workspace) -
                 pi * h * h * (6 - h) / 3) < 10 * tol);

  ClipWorkspace<Space<2, T>> flat;
  const Disk<T> disk(1);
  Pose<Space<2, T>> at{V2<T>(5, -3), Space<2, T>::exp(typename Space<2, T>::Angular(T(1)))};
  const Aabb<Space<2, T>> segment{V2<T>(T(5.5), -9), V2<T>(9, 9)};
  CHECK(std::abs(clipped_volume(disk, at, segment, flat) - (pi / 3 - std::sqrt(T(3)) / 4)) < tol);
}

TEST_CASE("the ball in a corner agrees with an integral over disks") {
  std::mt19937_64 random(6);
  ClipWorkspace<Space<3>> workspace;
  ClipWorkspace<Space<2>> flat;
  for (int trial = 0; trial < 20; ++trial) {
    const Ball<double> ball(1);
    const Pose<Space<3>> pose;
    const auto box = random_box<Space<3>>(random, 1.2);
    // Midpoint rule over slices at z = sin(s), so that the integrand is smooth where the slice
    // vanishes.
    const double from = std::asin(std::clamp(box.lower.z(), -1.0, 1.0));
    const double to = std::asin(std::clamp(box.upper.z(), -1.0, 1.0));
    constexpr int slices = 2000;
    double sum = 0;
    for (int i = 0; i < slices && to > from; ++i) {
      const double radius = std::cos(from + (to - from) * (i + 0.5) / slices);
      sum +=
          radius * clipped_volume(Disk<double>(radius), Pose<Space<2>>{},
                                  Aabb<Space<2>>{box.lower.head<2>(), box.upper.head<2>()}, flat);
    }
    CHECK(clipped_volume(ball, pose, box, workspace) ==
          doctest::Approx(sum * (to - from) / slices).epsilon(1e-5));
  }
}

TEST_CASE("far from the origin no digits are lost but those of the position") {
  std::mt19937_64 random(7);
  ClipWorkspace<Space<3>> workspace;
  const auto shape = random_polytope<Polyhedron<double>>(random, 20);
  const V3<double> far(1024, -2048, 512);
  auto pose = random_pose<Space<3>>(random, 0.0);
  auto box = box_of<double>(-0.25, -9, -0.5, 9, 0.125, 9);
  const double near = clipped_volume(shape, pose, box, workspace);
  pose.position += far;
  box.lower += far;
  box.upper += far;
  CHECK(clipped_volume(shape, pose, box, workspace) == near);
}

TEST_CASE("solid fraction of cubes on a lattice") {
  ClipWorkspace<Space<3>> workspace;
  const auto cube = cuboid<double>(V3<double>::Constant(0.4));
  std::vector<Pose<Space<3>>> poses;
  for (int i = 0; i < 27; ++i)
    poses.push_back({V3<double>(i % 3, i / 3 % 3, i / 9), Space<3>::identity()});
  const auto shape_of = [&](std::size_t) -> const Polyhedron<double>& { return cube; };
  const auto pose_of = [&](std::size_t k) -> const Pose<Space<3>>& { return poses[k]; };
  const auto rho = [&](const Aabb<Space<3>>& box) {
    return solid_fraction(box, poses.size(), shape_of, pose_of, workspace);
  };
  CHECK(rho(box_of<double>(-0.5, -0.5, -0.5, 2.5, 2.5, 2.5)) == doctest::Approx(0.512));
  CHECK(rho(box_of<double>(0, 0, 0, 2, 2, 2)) == doctest::Approx(0.512).epsilon(1e-13));
  CHECK(rho(box_of<double>(-0.4, -0.4, -0.4, 0.4, 0.4, 0.4)) == doctest::Approx(1));
}

TEST_CASE("control volumes are checked") {
  ClipWorkspace<Space<3>> workspace;
  const Ball<double> ball(1);
  const Pose<Space<3>> pose;
  const auto none = [](std::size_t) { return Ball<double>(1); };
  const auto nowhere = [](std::size_t) { return Pose<Space<3>>{}; };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const std::array bad = {box_of<double>(0, 0, 0, 0, 1, 1), box_of<double>(0, 0, 0, 1, -1, 1),
                          box_of<double>(0, 0, 0, 1, 1, nan), box_of<double>(0, 0, -inf, 1, 1, 1),
                          Aabb<Space<3>>{}};
  for (const auto& box : bad) {
    CHECK_THROWS_AS(clipped_volume(ball, pose, box, workspace), std::invalid_argument);
    CHECK_THROWS_AS(solid_fraction(box, 0, none, nowhere, workspace), std::invalid_argument);
  }
  const auto box = box_of<double>(0, 0, 0, 1, 1, 1);
  CHECK_NOTHROW(require_inside(box_of<double>(0, 0, 0, 1, 1, 0.5), box));
  try {
    require_inside(box_of<double>(0, 0, 0, 1, 1.5, 1), box);
    FAIL("did not throw");
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    CHECK(message.find("(1, 1.5, 1)") != std::string::npos);
    CHECK(message.find("box [(0, 0, 0), (1, 1, 1)]") != std::string::npos);
  }
}

TEST_CASE("solid fraction of grains of several types in a simulation") {
  using S = Space<3>;
  using Shape = OneOf<Ball<>, Polyhedron<>>;
  using Law = SignoriniCoulomb<>;
  Simulation<Shape, Law> world(0.4, Materials<Law>(1, Law(0.4)));
  world.add_grain(world.add_shape(Ball<>(0.2)), {V3<double>(0.5, 0.5, 0.5), S::identity()}, 1);
  world.add_grain(world.add_shape(cuboid<double>(V3<double>::Constant(0.2))),
                  {V3<double>(1.5, 0.5, 0.5), S::identity()}, 1);
  const double ball = 4 * std::numbers::pi / 3 * 0.008, cube = 0.064;
  CHECK(solid_fraction(world, box_of<double>(0, 0, 0, 2, 1, 1)) ==
        doctest::Approx((ball + cube) / 2));
  CHECK(solid_fraction(world, box_of<double>(0.5, 0, 0, 1.5, 1, 1)) ==
        doctest::Approx((ball + cube) / 2));
}

TEST_CASE_TEMPLATE("curved grains other than balls count as a whole, and in part", Shape, Capsule<>,
                   Cylinder<>, Rounded<Polyhedron<>>, Rounded<Polygon<>>) {
  using S = SpaceOf<Shape>;
  using Vector = typename S::Vector;
  const Shape shape = [] {
    if constexpr (std::same_as<Shape, Capsule<>> || std::same_as<Shape, Cylinder<>>)
      return Shape(0.3, 0.2);
    else
      return Shape(regular_shape<std::remove_cvref_t<decltype(std::declval<Shape>().core())>>(0.5),
                   0.1);
  }();
  using Law = SignoriniCoulomb<>;
  Simulation<Shape, Law> world(0.5, Materials<Law>(1, Law(0.4)));
  const Vector turn = 0.3 * Vector::Ones();
  typename S::Angular spin = S::Angular::Constant(0.4);
  world.add_grain(world.add_shape(shape), {turn, S::exp(spin)}, 1);
  const Aabb<S> all{Vector::Constant(-2), Vector::Constant(2)};
  const double size = volume(all);
  CHECK(solid_fraction(world, all) * size == doctest::Approx(shape.volume()).epsilon(1e-12));
  // Both halves of a body with a centre of symmetry, and the parts of any body.
  Aabb<S> left = all, right = all;
  left.upper[0] = right.lower[0] = 0.3;
  const double of_left = solid_fraction(world, left) * volume(left),
               of_right = solid_fraction(world, right) * volume(right);
  CHECK(of_left + of_right == doctest::Approx(shape.volume()).epsilon(1e-12));
  if constexpr (std::same_as<Shape, Capsule<>> || std::same_as<Shape, Cylinder<>>)
    CHECK(of_left == doctest::Approx(of_right).epsilon(0.01));  // of the inscribed mesh
  left.upper[0] = right.lower[0] = 0.45;
  CHECK(solid_fraction(world, left) * volume(left) + solid_fraction(world, right) * volume(right) ==
        doctest::Approx(shape.volume()).epsilon(1e-12));
  CHECK(measure_region(world, 1e-3, all).grains == 1);
}
