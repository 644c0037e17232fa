// SPDX-License-Identifier: MIT
// Cost of the narrow phase for one pair, cold: nothing is known of the pair beforehand. One body
// for every shape and dimension; the pairs are made, from a fixed seed, outside the timed loop.
//
// A shape of your own joins in by one line at the end, once Ballast<Shape> says how to draw one.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <random>
#include <string>
#include <vector>

#include "moreau/detect/collide.hpp"
#include "moreau/sample/ballast.hpp"

namespace {

using namespace moreau;

template <class S>
typename S::Vector random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  typename S::Vector v;
  for (auto& x : v) x = static_cast<typename S::Scalar>(normal(random));
  return v.normalized();
}
template <class T>
Eigen::Rotation2D<T> random_rotation(Space<2, T>, std::mt19937_64& random) {
  return Eigen::Rotation2D<T>(
      static_cast<T>(std::uniform_real_distribution<double>(-3.2, 3.2)(random)));
}
template <class T>
Eigen::Quaternion<T> random_rotation(Space<3, T>, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Eigen::Quaternion<T> q;
  for (auto& x : q.coeffs()) x = static_cast<T>(normal(random));
  return q.normalized();
}

/// Where a pair stands: the distance of the centres is that of touching plus a part of the diameter
/// drawn evenly between the two.
struct Situation {
  const char* name;
  double from, to;
};
constexpr Situation touching{"touching", -0.005, 0.005};
constexpr Situation overlapping{"overlapping", -0.02, -0.005};
constexpr Situation near{"near", 0.006, 0.02};
constexpr Situation apart{"apart", 0.01, 0.15};
constexpr double margin_over_diameter = 0.005;

/// Bodies at the origin, each in an orientation of its own, and pairs of them with the place of the
/// second one. 600 bodies outgrow the caches next to the core, as those of a simulation do.
template <class ShapeT>
struct Pairs {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  struct Pair {
    std::size_t a, b;
    Vector offset;
    T margin;
  };
  std::vector<ShapeT> shapes;
  std::vector<Placed<ShapeT>> bodies;
  std::vector<Pair> list;

  Pairs(const Situation& situation, std::size_t count) {
    std::mt19937_64 random(1);
    shapes.reserve(200);
    while (shapes.size() < 200) shapes.push_back(Ballast<ShapeT>::draw(random));
    for (std::size_t k = 0; k < 3 * shapes.size(); ++k)
      bodies.emplace_back(shapes[k % shapes.size()],
                          Pose<S>{Vector::Zero(), random_rotation(S{}, random)});
    while (list.size() < count) add(situation, random);
  }

 private:
  void add(const Situation& situation, std::mt19937_64& random) {
    const std::size_t a = random() % bodies.size(), b = random() % bodies.size();
    const T diameter = 2 * std::min(bodies[a].radius(), bodies[b].radius());
    const Vector line = random_direction<S>(random);
    Placed<ShapeT> moving = bodies[b];
    T inside = 0, outside = bodies[a].radius() + bodies[b].radius();
    for (int k = 0; k < 50; ++k) {
      const T middle = (inside + outside) / 2;
      moving.move_to(middle * line);
      (overlap(bodies[a], moving) ? inside : outside) = middle;
    }
    std::uniform_real_distribution<double> part(situation.from, situation.to);
    list.push_back({a, b, (inside + diameter * static_cast<T>(part(random))) * line,
                    static_cast<T>(margin_over_diameter) * diameter});
  }
};

template <class ShapeT, class Query>
void run(benchmark::State& state, const Situation& situation, Query query) {
  Pairs<ShapeT> pairs(situation, 10000);
  std::size_t i = 0, hits = 0;
  for ([[maybe_unused]] auto _ : state) {
    const auto& pair = pairs.list[i];
    Placed<ShapeT>& b = pairs.bodies[pair.b];
    const auto stood_at = b.center();
    b.move_to(pairs.bodies[pair.a].center() + pair.offset);
    hits += query(pairs.bodies[pair.a], b, pair.margin);
    b.move_to(stood_at);
    if (++i == pairs.list.size()) i = 0;
  }
  state.counters["in_contact"] =
      static_cast<double>(hits) / static_cast<double>(state.iterations());
}

template <class ShapeT>
void register_shape(const std::string& shape) {
  const auto add = [&](const char* query_name, const Situation& situation, auto query) {
    benchmark::RegisterBenchmark(
        (shape + "/" + query_name + "/" + situation.name).c_str(),
        [=](benchmark::State& state) { run<ShapeT>(state, situation, query); });
  };
  using Body = Placed<ShapeT>;
  using T = typename Body::Scalar;
  for (const Situation& situation : {touching, overlapping, near, apart}) {
    add("overlap", situation, [](const Body& a, const Body& b, T) { return overlap(a, b); });
    add("distance", situation, [](const Body& a, const Body& b, T) {
      const auto found = distance(a, b);
      benchmark::DoNotOptimize(found.witness_a);
      return found.gap <= 0;
    });
    add("collide", situation,
        [manifold = Manifold<SpaceOf<ShapeT>>()](const Body& a, const Body& b, T margin) mutable {
          const bool touch = collide(a, b, margin, manifold);
          benchmark::DoNotOptimize(manifold.points.data());
          return touch;
        });
  }
}

template <class ShapeT>
void register_update(const std::string& shape) {
  benchmark::RegisterBenchmark((shape + "/place").c_str(), [](benchmark::State& state) {
    Pairs<ShapeT> pairs(touching, 0);
    const Pose<SpaceOf<ShapeT>> pose;
    std::size_t i = 0;
    for ([[maybe_unused]] auto _ : state) {
      pairs.bodies[i].update(pairs.bodies[i].shape(), pose);
      benchmark::DoNotOptimize(pairs.bodies[i].bounding_box());
      if (++i == pairs.bodies.size()) i = 0;
    }
  });
}

}  // namespace

int main(int argc, char** argv) {
  register_shape<Polyhedron<double>>("polyhedra");
  register_shape<Polyhedron<float>>("polyhedra_float");
  register_shape<Polygon<double>>("polygons");
  register_shape<Ball<double>>("balls");
  register_shape<Disk<double>>("disks");
  register_update<Polyhedron<double>>("polyhedra");
  register_update<Polygon<double>>("polygons");
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
