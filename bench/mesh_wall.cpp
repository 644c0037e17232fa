// SPDX-License-Identifier: MIT
// Time of the contacts of a polyhedron with a mesh wall, per grain and per triangle within the margin.
// Floors of 1e3 to 1e5 triangles of one size, flat or wavy: the grains lie on it at random places, at
// random orientations. Grains and floors are created from a fixed seed outside the timed loop.
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "moreau/detect/collide.hpp"
#include "moreau/detect/pairs/collide_mesh_wall.hpp"
#include "moreau/sample/ballast.hpp"
#include "moreau/sample/random_rotation.hpp"

namespace {

using namespace moreau;
using S = Space<3, double>;
using Vector = S::Vector;
using Grain = Polyhedron<double>;

constexpr double margin = 0.02;  // of a grain whose size is 1

/// A triangle as a convex core, to count those within the margin exactly.
struct Triangle {
  using Space = S;
  S::Matrix corners;  // as columns, relative to their mean
  Vector support(const Vector& d) const {
    int best = 0;
    for (int k = 1; k < 3; ++k)
      if (d.dot(corners.col(k)) > d.dot(corners.col(best))) best = k;
    return corners.col(best);
  }
  Aabb<S> bounding_box(const Pose<S>& pose) const {
    Aabb<S> box;
    for (int k = 0; k < 3; ++k) box.merge(pose(corners.col(k)));
    return box;
  }
};

/// A floor of about `count` triangles with edges of `edge` grain sizes; waves of 3 grain sizes.
FacetMesh<S> floor_of(std::size_t count, double edge, double height) {
  const int n = int(std::sqrt(double(count) / 2));
  FacetMesh<S> mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.vertices.push_back(
          {edge * i, edge * j, height * std::sin(2.1 * edge * i) * std::cos(2.1 * edge * j)});
  const auto at = [&](int i, int j) { return std::uint32_t(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.facets.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.facets.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

/// Grains that touch the floor, within the margin.
std::vector<Placed<Grain>> grains_on(const MeshWall<S>& wall, std::vector<Grain>& shapes) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto bounds = wall.tree().bounds();
  std::vector<Placed<Grain>> grains;
  MeshScratch scratch;
  Manifold<S> manifold;
  shapes.reserve(1000);
  while (grains.size() < 1000) {
    shapes.push_back(Ballast<Grain>::draw(random).scaled(0.5));
    Vector at;
    for (int k = 0; k < 2; ++k)
      at[k] = bounds.lower[k] + 1 + uniform(random) * (bounds.upper[k] - bounds.lower[k] - 2);
    at[2] = bounds.upper[2] + 1;
    Placed<Grain> grain(shapes.back(), {at, random_rotation<S>(random)});
    // Lowers the grain by its least gap until it touches.
    for (int step = 0; step < 200; ++step) {
      double gap = 0.2;
      const auto add = [&](std::uint32_t) {
        for (const auto& point : manifold.points) gap = std::min(gap, point.gap);
      };
      collide_each(grain, wall, 0.2, scratch, manifold, add);
      if (gap < 0.5 * margin) break;
      at[2] -= 0.9 * gap;
      grain.move_to(at);
    }
    grains.push_back(grain);
  }
  return grains;
}

std::size_t within_margin(const Placed<Grain>& grain, const MeshWall<S>& wall) {
  std::size_t count = 0;
  const Aabb<S> around = grain.bounding_box().inflated(margin);
  wall.tree().query([&](const Aabb<S>& box) { return box.overlaps(around); },
                    [&](std::uint32_t k) {
                      const S::Matrix& corners = wall.side(k).corners;
                      const Vector middle = corners.rowwise().mean();
                      const Triangle triangle{corners.colwise() - middle};
                      const Placed<Triangle> placed(triangle, {middle, S::identity()});
                      const detail::ConvexPair<Grain, Triangle> pair(grain, placed);
                      count += pair.distance(margin).gap <= margin;
                    });
  return count;
}

/// @param coherent whether the facets near each grain are known from the step before
void run(benchmark::State& state, double edge, double height, bool coherent) {
  const MeshWall<S> wall(floor_of(std::size_t(state.range(0)), edge, height));
  std::vector<Grain> shapes;
  const auto grains = grains_on(wall, shapes);
  std::size_t triangles = 0, points = 0;
  for (const auto& grain : grains) triangles += within_margin(grain, wall);
  MeshScratch scratch;
  Manifold<S> manifold;
  std::vector<MeshNeighbours<S>> near(grains.size());
  for ([[maybe_unused]] auto _ : state) {
    points = 0;
    const auto add = [&](std::uint32_t) { points += manifold.points.size(); };
    for (std::size_t i = 0; i < grains.size(); ++i)
      if (coherent) {
        near[i].update(wall, grains[i].bounding_box().inflated(margin));
        collide_each(grains[i], wall, margin, margin, near[i], scratch, manifold, add);
      } else {
        collide_each(grains[i], wall, margin, scratch, manifold, add);
      }
    benchmark::DoNotOptimize(points);
  }
  const auto per = [](std::size_t count) {
    return benchmark::Counter(
        double(count), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  };
  state.counters["per_grain"] = per(grains.size());
  state.counters["per_triangle"] = per(triangles);
  state.counters["triangles_per_grain"] = double(triangles) / double(grains.size());
  state.counters["points_per_grain"] = double(points) / double(grains.size());
}

}  // namespace

int main(int argc, char** argv) {
  struct Floor {
    const char* name;
    double edge, height;  // of a triangle, of the waves, in grain sizes
  };
  for (const Floor floor : {Floor{"flat/edges_of_0.2", 0.2, 0}, Floor{"flat/edges_of_1", 1, 0},
                            Floor{"wavy/edges_of_0.2", 0.2, 0.1}, Floor{"wavy/edges_of_1", 1, 0.3}})
    for (const bool coherent : {false, true})
      for (const std::int64_t count : {1000, 10000, 100000})
        benchmark::RegisterBenchmark(
            (std::string(floor.name) + (coherent ? "/coherent" : "/cold")).c_str(), run, floor.edge,
            floor.height, coherent)
            ->Arg(count)
            ->Unit(benchmark::kMicrosecond);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
