// SPDX-License-Identifier: MIT
// Cost of the narrow phase for one pair: cold, without any memory of the pair; coherent, along
// trajectories with a cache; from memory, with a cache, each of 10,000 pairs once in a row, so that
// its data are not in the caches of the processor. The same code runs for every shape and dimension.
//
// Shapes of your own: configure with -DMOREAU_BENCH_HEADER=pebble.hpp -DMOREAU_BENCH_SHAPE=Pebble.
// The type has a function `static Shape draw(std::mt19937_64&)`, which returns a random shape: of this
// type, or any shape of the library. With -DMOREAU_BENCH_OWN_ONLY=ON only this type is compiled.
#include <benchmark/benchmark.h>
#include <memory>
#include <string>

#include "pairs.hpp"

#ifdef MOREAU_BENCH_HEADER
#include MOREAU_BENCH_HEADER
#endif

namespace {

using namespace moreau;

/// The three queries, with a cache or without one.
struct Overlap {
  static constexpr const char* name = "overlap";
  template <class Body, class T, class... Cache>
  bool operator()(const Body& a, const Body& b, T, Cache&... cache) const {
    return overlap(a, b, cache...);
  }
};
struct Distance {
  static constexpr const char* name = "distance";
  template <class Body, class T, class... Cache>
  bool operator()(const Body& a, const Body& b, T, Cache&... cache) const {
    const auto found = distance(a, b, cache...);
    benchmark::DoNotOptimize(found.witness_a);
    return found.gap <= 0;
  }
};
template <class S>
struct Collide {
  static constexpr const char* name = "collide";
  Manifold<S> manifold;
  template <class Body, class T, class... Cache>
  bool operator()(const Body& a, const Body& b, T margin, Cache&... cache) {
    bool touch = false;
    if constexpr (requires { a.part_count(); })  // a compound, whose caches are those of its parts
      touch = collide_parts(a, b, margin, manifold, [] {});
    else
      touch = collide(a, b, margin, manifold, cache...);
    benchmark::DoNotOptimize(manifold.points.data());
    return touch;
  }
};

template <class ShapeT, class Query>
void run_cold(benchmark::State& state, const pairs::Situation& situation,
              const std::vector<ShapeT>& shapes, Query query) {
  pairs::Pairs<ShapeT> pairs(situation, situation.faces_are_aligned ? 1000 : 10000, shapes);
  std::size_t i = 0, hits = 0;
  for ([[maybe_unused]] auto _ : state) {
    const auto& pair = pairs.list[i];
    Placed<ShapeT>& b = pairs.bodies[pair.b];
    const auto stood_at = b.center();
    pairs.move_to(pair.b, b, pairs.bodies[pair.a].center() + pair.offset);
    hits += query(pairs.bodies[pair.a], b, pair.margin);
    pairs.move_to(pair.b, b, stood_at);
    if (++i == pairs.list.size()) i = 0;
  }
  state.counters["hits"] = static_cast<double>(hits) / static_cast<double>(state.iterations());
}

template <class ShapeT, class Query>
void run_coherent(benchmark::State& state, const pairs::Situation& situation,
                  const std::vector<ShapeT>& shapes, bool use_cache, Query query) {
  const pairs::Trajectories<ShapeT> ways(situation, 20, shapes);
  PairCache<SpaceOf<ShapeT>> cache;
  std::size_t i = 0, k = 0, hits = 0;
  for ([[maybe_unused]] auto _ : state) {
    const auto& way = ways.list[i];
    const Placed<ShapeT>& a = ways.pairs.bodies[way.a];
    hits += use_cache ? query(a, way.b[k], way.margin, cache) : query(a, way.b[k], way.margin);
    if (++k == way.b.size()) {
      k = 0;
      if (++i == ways.list.size()) i = 0;
      cache = {};
    }
  }
  state.counters["hits"] = static_cast<double>(hits) / static_cast<double>(state.iterations());
}

template <class ShapeT, class Query>
void run_from_memory(benchmark::State& state, const pairs::Situation& situation,
                     const std::vector<ShapeT>& shapes, Query query) {
  struct Place {
    Placed<ShapeT> a, b;
    PairCache<SpaceOf<ShapeT>> cache;
    SpaceOf<ShapeT>::Scalar margin;
  };
  const pairs::Pairs<ShapeT> pairs(situation, 10000, shapes);
  std::vector<Place> places;
  places.reserve(pairs.list.size());
  for (const auto& pair : pairs.list) {
    places.push_back({pairs.bodies[pair.a], pairs.bodies[pair.b], {}, pair.margin});
    Place& place = places.back();
    pairs.move_to(pair.b, place.b, place.a.center() + pair.offset);
    query(place.a, place.b, place.margin, place.cache);
  }
  std::size_t i = 0, hits = 0;
  for ([[maybe_unused]] auto _ : state) {
    Place& place = places[i];
    hits += query(place.a, place.b, place.margin, place.cache);
    if (++i == places.size()) i = 0;
  }
  state.counters["hits"] = static_cast<double>(hits) / static_cast<double>(state.iterations());
}

template <class ShapeT, class Query>
void register_query(const std::string& shape, const std::vector<ShapeT>& shapes, Query query) {
  const auto name = [&](const pairs::Situation& situation, const char* kind) {
    return shape + '/' + Query::name + '/' + situation.name + kind;
  };
  for (const auto& situation :
       {pairs::touching, pairs::overlapping, pairs::near, pairs::apart, pairs::aligned}) {
    if (situation.faces_are_aligned && !Polytope<ShapeT>) continue;
    benchmark::RegisterBenchmark(name(situation, "").c_str(), [=](benchmark::State& state) {
      run_cold<ShapeT>(state, situation, shapes, query);
    });
    benchmark::RegisterBenchmark(
        name(situation, "/from_memory").c_str(),
        [=](benchmark::State& state) { run_from_memory<ShapeT>(state, situation, shapes, query); });
    for (const bool use_cache : {false, true})
      benchmark::RegisterBenchmark(
          name(situation, use_cache ? "/coherent_cached" : "/coherent_cold").c_str(),
          [=](benchmark::State& state) {
            run_coherent<ShapeT>(state, situation, shapes, use_cache, query);
          });
  }
}

template <class ShapeT>
void register_shape(const std::string& shape, const std::vector<ShapeT>& shapes) {
  register_query<ShapeT>(shape, shapes, Overlap{});
  register_query<ShapeT>(shape, shapes, Distance{});
  register_query<ShapeT>(shape, shapes, Collide<SpaceOf<ShapeT>>{});
}
template <class ShapeT>
void register_shape(const std::string& shape) {
  register_shape<ShapeT>(shape, pairs::ballast<ShapeT>(200));
}
/// The shapes that a type draws.
template <class FamilyT>
void register_family(const std::string& shape) {
  static_assert(
      pairs::Family<FamilyT>,
      "the type needs `static Shape draw(std::mt19937_64&)`, which returns a shape of grains");
  if constexpr (pairs::Family<FamilyT>) {
    register_shape(shape, pairs::draw_shapes<FamilyT>(200));
  }
}

/// The same by number of vertices.
template <class ShapeT>
void register_sizes(const std::string& shape, std::initializer_list<std::size_t> sizes) {
  for (const std::size_t size : sizes) {
    std::mt19937_64 random(3);
    std::vector<ShapeT> shapes;
    while (shapes.size() < 40)
      shapes.push_back(pairs::with_vertices(SpaceOf<ShapeT>{}, size, random));
    register_shape<ShapeT>(shape + '_' + std::to_string(size), shapes);
  }
}

template <class ShapeT>
void register_update(const std::string& shape) {
  benchmark::RegisterBenchmark((shape + "/place").c_str(), [](benchmark::State& state) {
    pairs::Pairs<ShapeT> pairs(pairs::touching, 0, pairs::ballast<ShapeT>(200));
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
#ifndef MOREAU_BENCH_OWN_ONLY
  register_shape<Polyhedron<double>>("polyhedra");
  register_shape<Polyhedron<float>>("polyhedra_float");
  register_shape<Polygon<double>>("polygons");
  register_shape<Ball<double>>("balls");
  register_shape<Disk<double>>("disks");
  register_sizes<Polyhedron<double>>("polyhedra", {4, 8, 16, 24, 37, 100});
  register_sizes<Polygon<double>>("polygons", {4, 8, 16});
  register_update<Polyhedron<double>>("polyhedra");
  register_update<Polygon<double>>("polygons");
#endif
#ifdef MOREAU_BENCH_HEADER
  register_family<MOREAU_BENCH_SHAPE>("own");
#endif
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
