// SPDX-License-Identifier: MIT
// Narrow phases side by side, one thread: boolean, signed distance with normal, manifold; cold and,
// for this library, coherent with a cache. Poses are made, and vertices turned, beforehand.
// "wrong": booleans where |gap| > 1e-12 d; "normals": more than 0.01 degrees off where the truth is
// unique. The truth is the exhaustive reference of the tests.
#include <deque>
#include <string>

#include "contest.hpp"

namespace {

using namespace moreau;
using peers::Answer;
using peers::Case;
using peers::Contest;

template <class ShapeT>
class Inputs {
 public:
  using S = SpaceOf<ShapeT>;
  std::vector<Case<ShapeT>> cases;

  Inputs(const pairs::Situation& situation, std::size_t count, const std::vector<ShapeT>& shapes)
      : pairs_(situation, count, shapes) {
    for (const auto& pair : pairs_.list) {
      Pose<S> pose = pairs_.poses[pair.b];
      pose.position = pair.offset;
      add(pair, pose, true);
    }
  }
  /// Along trajectories.
  Inputs(const std::vector<ShapeT>& shapes, std::size_t count)
      : pairs_(pairs::touching, count, shapes) {
    const pairs::Trajectories<ShapeT> ways(pairs::touching, count, shapes);
    for (std::size_t i = 0; i < ways.list.size(); ++i)
      for (std::size_t k = 0; k < ways.list[i].poses.size(); ++k)
        add(pairs_.list[i], ways.list[i].poses[k], k == 0);
  }

 private:
  void add(const typename pairs::Pairs<ShapeT>::Pair& pair, const Pose<S>& pose, bool is_first) {
    placed_.emplace_back(pairs_.shape_of(pair.b), pose);
    cases.push_back({pairs_.shape_index(pair.a), pairs_.shape_index(pair.b), pairs_.poses[pair.a],
                     pose, &pairs_.bodies[pair.a], &placed_.back(), pair.margin,
                     pairs_.diameter(pair), is_first});
  }

  pairs::Pairs<ShapeT> pairs_;
  std::deque<Placed<ShapeT>> placed_;
};

template <class ShapeT>
void enter_moreau(Contest<ShapeT>& contest, const std::string& kind, bool use_cache) {
  using S = SpaceOf<ShapeT>;
  const auto& cases = contest.cases();
  PairCache<S> cache;
  Manifold<S> manifold;
  const auto forget = [&cache, use_cache](const Case<ShapeT>& c) {
    if (c.is_first || !use_cache) cache = {};
  };
  const std::string name = use_cache ? "moreau, cached" : "moreau";
  if (kind == "overlap")
    contest.enter(name, kind, [&](std::size_t i) -> Answer<S> {
      forget(cases[i]);
      return {use_cache ? overlap(*cases[i].placed_a, *cases[i].placed_b, cache)
                        : overlap(*cases[i].placed_a, *cases[i].placed_b)};
    });
  if (kind == "distance")
    contest.enter(name, kind, [&](std::size_t i) -> Answer<S> {
      forget(cases[i]);
      const auto found = distance(*cases[i].placed_a, *cases[i].placed_b, cache);
      return {found.gap <= 0, found.gap, found.normal};
    });
  if (kind == "manifold")
    contest.enter(name, kind, [&](std::size_t i) -> Answer<S> {
      forget(cases[i]);
      const auto& c = cases[i];
      if (!collide(*c.placed_a, *c.placed_b, c.margin, manifold, cache)) return {false};
      return {manifold.gap <= 0, manifold.gap, manifold.normal};
    });
}

void run_space(const std::string& title, const std::vector<Polyhedron<double>>& shapes,
               const Inputs<Polyhedron<double>>& inputs, bool is_coherent) {
  Contest<Polyhedron<double>> contest(title, shapes, inputs.cases);
  for (const char* kind : {"overlap", "distance", "manifold"}) {
    enter_moreau(contest, kind, false);
    if (is_coherent) enter_moreau(contest, kind, true);
    peers::enter_ccd(contest, shapes, kind);
    if (kind == std::string("distance")) {
      peers::enter_fcl(contest, shapes);
      peers::enter_bullet(contest, shapes);
    }
  }
}

void run_plane(const std::string& title, const std::vector<Polygon<double>>& shapes,
               const Inputs<Polygon<double>>& inputs, bool is_coherent) {
  Contest<Polygon<double>> contest(title, shapes, inputs.cases);
  for (const char* kind : {"overlap", "distance", "manifold"}) {
    enter_moreau(contest, kind, false);
    if (is_coherent) enter_moreau(contest, kind, true);
  }
  peers::enter_box2d(contest, shapes);
}

}  // namespace

int main() {
  const auto hulls = pairs::ballast<Polyhedron<double>>(200);
  run_space("polyhedra around touching", hulls, {pairs::touching, 4000, hulls}, false);
  run_space("polyhedra apart", hulls, {pairs::apart, 4000, hulls}, false);
  run_space("polyhedra, aligned faces", hulls, {pairs::aligned, 1000, hulls}, false);
  run_space("polyhedra, trajectories", hulls, {hulls, 20}, true);
  const auto polygons = pairs::ballast<Polygon<double>>(200);
  run_plane("polygons around touching", polygons, {pairs::touching, 4000, polygons}, false);
  run_plane("polygons, trajectories", polygons, {polygons, 20}, true);
}
