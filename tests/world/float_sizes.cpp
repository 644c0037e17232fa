// SPDX-License-Identifier: MIT
// Single precision from 1e-6 m to 1e6 m. Lengths, velocities and gravity are those of the scene of 1 m times a power of
// two: no rounding is different, but where numbers become so small that they lose bits.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <span>
#include <vector>

#include "moreau/law/rolling_resistance.hpp"
#include "moreau/moreau.hpp"
#include "moreau/shape/ball.hpp"

namespace {

constexpr float h = 1 / 512.0f;
/// 9.5e-7 m, 1.5e-5 m, 1.6e4 m, 2.6e5 m and 1.0e6 m. Roots of even powers of two are exact.
constexpr float sizes[] = {0x1p-20f, 0x1p-16f, 0x1p14f, 0x1p18f, 0x1p20f};

using Coulomb = moreau::SignoriniCoulomb<float>;
using Rolling = moreau::RollingResistance<float>;

template <class ShapeT, class Law>
using World = moreau::Simulation<ShapeT, Law>;

/// The end of a scene.
struct Course {
  std::vector<float> numbers;  // positions over the size, spins, and what a scene adds
  int sweeps = 0, unsolved = 0;
};

Course run(auto& world, float size, int steps) {
  Course course;
  for (int k = 0; k < steps; ++k) {
    const moreau::StepReport report = world.step(h);
    course.sweeps += report.solve.sweeps;
    course.unsolved += report.solve.converged ? 0 : 1;
  }
  for (const moreau::BodyId grain : world.grains()) {
    for (const float x : world.pose(grain).position) course.numbers.push_back(x / size);
    for (const float x : world.spin(grain)) course.numbers.push_back(x);
  }
  return course;
}

/// @param scene function: size -> Course
void require_same(const auto& scene) {
  const Course one = scene(1.0f);
  CHECK(one.unsolved == 0);
  for (const float size : sizes) {
    CAPTURE(size);
    const Course other = scene(size);
    CHECK(other.unsolved == 0);
    CHECK(other.sweeps <= 2 * one.sweeps);
    double largest = 0, apart = 0;
    REQUIRE(one.numbers.size() == other.numbers.size());
    for (std::size_t i = 0; i < one.numbers.size(); ++i) {
      largest = std::max(largest, std::abs(double(one.numbers[i])));
      apart = std::max(apart, std::abs(double(one.numbers[i]) - double(other.numbers[i])));
    }
    CHECK(apart < 1e-4 * largest);
  }
}

/// A box of flat edges, of the size along the last axis, wider by `wide` along the first.
template <class ShapeT>
ShapeT block(float size, float wide) {
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  std::vector<Vector> corners;
  for (int code = 0; code < 1 << S::dim; ++code) {
    Vector x;
    for (int k = 0; k < S::dim; ++k) x[k] = (code >> k & 1) != 0 ? size / 2 : -size / 2;
    x[0] *= wide;
    if (S::dim == 3) x[1] *= 2;
    corners.push_back(x);
  }
  return ShapeT{std::span<const Vector>(corners)};
}

template <class S>
typename S::Vector up() {
  return S::Vector::Unit(S::dim - 1);
}

}  // namespace

TEST_CASE("float: a free brick turns alike at all sizes") {
  using S = moreau::Space<3, float>;
  require_same([](float size) {
    World<moreau::Polyhedron<float>, Coulomb> world(size, moreau::Materials<Coulomb>(1, Coulomb()));
    const auto brick = world.add_grain(world.add_shape(block<moreau::Polyhedron<float>>(size, 3)),
                                       {S::Vector::Zero(), S::exp({0.1f, 0.2f, 0.3f})}, 2700);
    world.set_spin(brick, {9, 5, -7});
    const auto momentum = [&] {
      const auto& bodies = world.bodies();
      const std::size_t i = brick.index();
      return (bodies.inertia(i, bodies.pose[i].rotation) / bodies.inertia_body[i].trace() *
              world.spin(brick))
          .eval();
    };
    const typename S::Angular before = momentum();
    const auto course = run(world, size, 100);
    CHECK((momentum() - before).norm() < 1e-4f * before.norm());
    return course;
  });
}

TEST_CASE_TEMPLATE("float: a stack of blocks is solved by sweeps alike at all sizes", ShapeT,
                   moreau::Polyhedron<float>, moreau::Polygon<float>) {
  using S = moreau::SpaceOf<ShapeT>;
  for (const auto test : {moreau::StopTest::natural_map, moreau::StopTest::qm16})
    require_same([&](float size) {
      moreau::ColouredOptions options;
      options.islands = false;
      options.stop_test = test;
      World<ShapeT, Coulomb> world(size, moreau::Materials<Coulomb>(1, Coulomb(0.5f)),
                                   moreau::ColouredGaussSeidel(options));
      const auto shape = world.add_shape(block<ShapeT>(size, 2));
      world.add_wall(up<S>(), S::Vector::Zero());
      for (int k = 0; k < 6; ++k) {
        typename S::Vector x = (0.5f + float(k) * 1.001f) * size * up<S>();
        x[0] = (k % 2 == 0 ? 0.2f : -0.3f) * size;
        world.add_grain(shape, {x, S::identity()}, 2000);
      }
      world.set_gravity(-10 * size * up<S>());
      return run(world, size, 40);
    });
}

TEST_CASE_TEMPLATE("float: 250 round grains with rolling resistance are solved alike at all sizes",
                   ShapeT, moreau::Ball<float>, moreau::Disk<float>) {
  using S = moreau::SpaceOf<ShapeT>;
  require_same([](float size) {
    World<ShapeT, Rolling> world(size, moreau::Materials<Rolling>(1, Rolling(0.4f, 0.1f)));
    const auto shape = world.add_shape(ShapeT(size / 2));
    world.add_wall(up<S>(), S::Vector::Zero());
    const int row = S::dim == 3 ? 7 : 40;
    for (int k = 0; k < 250; ++k) {
      typename S::Vector x = S::Vector::Zero();
      int rest = k;
      for (int axis = 0; axis < S::dim - 1; ++axis, rest /= row)
        x[axis] = float(rest % row) * 1.01f * size;
      x[S::dim - 1] = (0.5f + float(rest)) * size;
      x[0] += 0.25f * float(rest % 2) * size;
      const auto grain = world.add_grain(shape, {x, S::identity()}, 2000);
      world.set_velocity(grain, S::Vector::Unit(0) * (0.01f * float(k % 5)) * size);
    }
    world.set_gravity(-10 * size * up<S>());
    return run(world, size, 8);
  });
}

TEST_CASE_TEMPLATE("float: a periodic cell follows its stress alike at all sizes", ShapeT,
                   moreau::Ball<float>, moreau::Disk<float>) {
  using S = moreau::SpaceOf<ShapeT>;
  require_same([](float size) {
    World<ShapeT, Rolling> world(size, moreau::Materials<Rolling>(1, Rolling(0.4f, 0.1f)));
    const auto shape = world.add_shape(ShapeT(size / 2));
    const int row = 4;
    world.set_cell(float(row) * 1.01f * size * S::Matrix::Identity());
    int count = 1;
    for (int axis = 0; axis < S::dim; ++axis) count *= row;
    float mass = 0;
    for (int k = 0; k < count; ++k) {
      typename S::Vector x;
      for (int axis = 0, rest = k; axis < S::dim; ++axis, rest /= row)
        x[axis] = (0.5f + float(rest % row)) * 1.01f * size;
      x[0] += 0.01f * float(k % 7) * size;
      const auto grain = world.add_grain(shape, {x, S::identity()}, 2000);
      mass += world.bodies().grain_mass[grain.index()];
    }
    moreau::CellControl<S> control;
    control.stress = 200 * size * size * S::Matrix::Identity();
    control.mass = mass * S::Matrix::Identity();
    world.control_cell(control);
    auto course = run(world, size, 40);
    CHECK(world.cell_motion().stress()(0, 0) > size * size);
    for (int k = 0; k < S::dim; ++k) course.numbers.push_back(world.cell().vectors()(k, k) / size);
    return course;
  });
}

TEST_CASE("float: a light hub of many grains is solved alike at all sizes") {
  using S = moreau::Space<3, float>;
  using Ball = moreau::Ball<float>;
  require_same([](float size) {
    World<Ball, Rolling> world(size, moreau::Materials<Rolling>(1, Rolling(0.2f)));
    const auto small = world.add_shape(Ball(size / 2)), large = world.add_shape(Ball(4 * size));
    world.add_grain(large, {}, 100);
    const int count = 120;
    for (int k = 0; k < count; ++k) {
      const float z = 1 - 2 * (float(k) + 0.5f) / count, angle = 2.39996f * float(k);
      const float across = std::sqrt(1 - z * z);
      const S::Vector n(across * std::cos(angle), across * std::sin(angle), z);
      const auto grain = world.add_grain(small, {4.5f * size * n, S::identity()}, 2000);
      world.set_velocity(grain, -(1 + 0.3f * float(k % 3)) * size * n);
    }
    return run(world, size, 1);
  });
}

TEST_CASE_TEMPLATE("float: a cube of 1e-6 m to 1e6 m falls and comes to rest alike", ShapeT,
                   moreau::Polyhedron<float>, moreau::Polygon<float>) {
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  using Law = moreau::SignoriniCoulomb<float>;
  for (const float size : {1e-6f, 1e-5f, 1e-4f, 1e-3f, 1e-2f, 1.f, 1e2f, 1e3f, 1e4f, 1e5f, 1e6f}) {
    CAPTURE(size);
    std::vector<Vector> corners;
    for (int code = 0; code < 1 << S::dim; ++code) {
      Vector x;
      for (int k = 0; k < S::dim; ++k) x[k] = (code >> k & 1) != 0 ? size / 2 : -size / 2;
      corners.push_back(x);
    }
    moreau::Simulation<ShapeT, Law> world(size, moreau::Materials<Law>(1, Law(0.5f)));
    const auto cube = world.add_shape(ShapeT{std::span<const Vector>(corners)});
    const Vector up = Vector::Unit(S::dim - 1);
    const auto turn = S::exp(S::Angular::Constant(0.1f));
    world.add_wall(up, Vector::Zero());
    const auto low = world.add_grain(cube, {0.8f * size * up, turn}, 2000);
    const auto high = world.add_grain(cube, {2.2f * size * up, S::identity()}, 2000);
    world.set_gravity(-10 * size * up);
    int unsolved = 0;
    for (int k = 0; k < 1500; ++k) unsolved += world.step(2e-3f).solve.converged ? 0 : 1;
    CHECK(unsolved == 0);
    CHECK(up.dot(world.pose(low).position) / size == doctest::Approx(0.5).epsilon(0.01));
    CHECK(up.dot(world.pose(high).position) / size > 0.49f);
    CHECK(up.dot(world.pose(high).position) / size < 1.55f);
    CHECK(world.velocity(low).norm() < 0.01f * size);
  }
}

TEST_CASE_TEMPLATE("float: a belt that has moved 1 km along itself is met where it is", ShapeT,
                   moreau::Polyhedron<float>, moreau::Polygon<float>) {
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  using Law = moreau::SignoriniCoulomb<float>;
  constexpr float size = 0.02f, gap = 2e-4f;
  const Vector up = Vector::Unit(S::dim - 1);
  moreau::Simulation<ShapeT, Law> world(size, moreau::Materials<Law>(1, Law(0.5f)));
  const auto belt = world.add_wall(up, Vector::Zero());
  world.set_pose(belt, {Vector(1000 * Vector::UnitX()), world.pose(belt).rotation});
  std::vector<Vector> corners;
  for (int code = 0; code < 1 << S::dim; ++code) {
    Vector x;
    for (int k = 0; k < S::dim; ++k) x[k] = (code >> k & 1) != 0 ? size / 2 : -size / 2;
    corners.push_back(x);
  }
  const auto cube = world.add_shape(ShapeT{std::span<const Vector>(corners)});
  const auto grain = world.add_grain(cube, {Vector((size / 2 + gap) * up), S::identity()}, 2000);
  world.set_gravity(-10 * up);
  for (int k = 0; k < 50; ++k) world.step(1e-3f);
  // The normal has its own rounding, which lifts the belt at the origin by up to 0.06 mm.
  const Vector normal = world.bodies().axes(belt.index()).col(0);
  const Vector way = world.pose(grain).position - world.pose(belt).position;
  CHECK(std::abs(normal.dot(way) - size / 2) < 0.02f * gap);
}
