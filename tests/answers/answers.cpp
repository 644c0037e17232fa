// SPDX-License-Identifier: MIT
// Prints hashes of all results of the narrow phase for the pairs of the benchmarks, and of the
// state of small simulations. The hashes depend on every bit. .ci/same_answers compares the output
// of two revisions.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "moreau/detect/broad/all_pairs.hpp"
#include "moreau/detect/broad/cell_grid.hpp"
#include "moreau/io/snapshot.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/law/frictionless.hpp"
#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/moreau.hpp"
#include "moreau/parallel/thread_team.hpp"
#include "moreau/sample/ballast.hpp"
#include "moreau/solve/proximal_fallback.hpp"

#include "../../bench/pairs.hpp"

namespace {

using namespace moreau;

/// FNV-1a hash of the bytes of numbers, and of objects that consist of numbers.
class Hash {
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 0x100000001b3ULL;
  }
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void add(T x) { add(&x, sizeof x); }
  template <class Derived>
  void add(const Eigen::MatrixBase<Derived>& m) {
    for (Eigen::Index i = 0; i < m.size(); ++i) add(m(i));
  }
  template <class T>
  void add(const Eigen::Quaternion<T>& q) {
    add(q.coeffs());
  }
  template <class T>
  void add(const Eigen::Rotation2D<T>& r) {
    add(r.angle());
  }
  void print(const std::string& name) const {
    std::printf("%-60s %016llx\n", name.c_str(), static_cast<unsigned long long>(value_));
    std::fflush(stdout);
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

template <class S>
void add(Hash& hash, const Manifold<S>& manifold) {
  hash.add(manifold.normal);
  hash.add(manifold.gap);
  hash.add(manifold.contact_class);
  hash.add(manifold.points.size());
  for (const auto& point : manifold.points) {
    hash.add(point.position);
    hash.add(point.gap);
    hash.add(point.feature.value);
  }
}
template <class S>
void add(Hash& hash, const SignedDistance<S>& found) {
  hash.add(found.gap);
  hash.add(found.normal);
  hash.add(found.witness_a);
  hash.add(found.witness_b);
}

/// Hashes the results of the three queries, and the points that reduce() keeps of the manifold.
template <class A, class B>
void query(Hash& hash, const Placed<A>& a, const Placed<B>& b, typename SpaceOf<A>::Scalar margin,
           PairCache<SpaceOf<A>>& cache) {
  using S = SpaceOf<A>;
  hash.add(overlap(a, b));
  add(hash, distance(a, b));
  Manifold<S> manifold;
  if (collide(a, b, margin, manifold, cache)) {
    add(hash, manifold);
    Reduction reduction;
    reduce(manifold, S::dim, std::span<const KeptPoint>(), reduction);
    add(hash, manifold);
  }
}

template <class ShapeT>
void narrow_phase(const std::string& name, const std::vector<ShapeT>& shapes, std::size_t count) {
  using S = SpaceOf<ShapeT>;
  for (const auto& situation :
       {pairs::touching, pairs::overlapping, pairs::near, pairs::apart, pairs::aligned}) {
    Hash hash;
    pairs::Pairs<ShapeT> set(situation, count, shapes);
    for (const auto& pair : set.list) {
      Placed<ShapeT> b = set.bodies[pair.b];
      b.move_to(pair.offset);
      PairCache<S> cache;
      query(hash, set.bodies[pair.a], b, pair.margin, cache);
      query(hash, set.bodies[pair.a], b, pair.margin, cache);
    }
    hash.print(name + " " + situation.name);
  }
  Hash hash;
  pairs::Trajectories<ShapeT> paths(pairs::touching, count / 10, shapes);
  for (auto& path : paths.list) {
    PairCache<S> cache;
    for (const auto& b : path.b) {
      query(hash, paths.pairs.bodies[path.a], b, path.margin, cache);
      hash.add(distance(paths.pairs.bodies[path.a], b, cache).gap);
      hash.add(overlap(paths.pairs.bodies[path.a], b, cache));
    }
  }
  hash.print(name + " trajectories");
}

template <class World>
void add_state(Hash& hash, const World& world) {
  for (const auto& pose : world.bodies().pose) {
    hash.add(pose.position);
    hash.add(pose.rotation);
  }
  for (const auto& velocity : world.bodies().velocity) hash.add(velocity);
  const auto& contacts = world.contacts();
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    hash.add(contacts.points[c].a);
    hash.add(contacts.points[c].b);
    auto gap = contacts.points[c].gap;
    if constexpr (requires { world.correction(); })
      gap += world.correction().gap_change(contacts.points[c]);
    hash.add(gap);
    hash.add(contacts.points[c].frame);
    hash.add(contacts.points[c].lever_a);
    hash.add(contacts.points[c].lever_b);
    hash.add(contacts.keys[c].feature.value);
    hash.add(contacts.classes[c]);
    hash.add(contacts.impulse(c));
  }
  if constexpr (std::decay_t<decltype(contacts)>::has_couples)
    for (std::size_t c = 0; c < contacts.size(); ++c) hash.add(contacts.couple(c));
}
void add_report(Hash& hash, const StepReport& report) {
  hash.add(report.candidate_pairs);
  hash.add(report.pairs);
  hash.add(report.points);
  hash.add(report.warm_started);
  hash.add(report.solve.sweeps);
  hash.add(report.solve.residual);
  hash.add(report.dissipation);
}

enum class Scene { box, periodic, cylinder };

/// Grains that fall into a box. A force presses on one wall of the box.
template <class World, class ShapeT>
void fill(World& world, const std::vector<ShapeT>& shapes, std::size_t count, Scene scene) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<T> jitter(T(-1e-3), T(1e-3));
  for (std::size_t k = 0; k < count; ++k) {
    Pose<S> pose;
    std::size_t rest = k;
    for (int axis = 0; axis < up; ++axis) {
      pose.position[axis] = T(0.016) + T(0.022) * T(rest % 4) + jitter(random);
      rest /= 4;
    }
    pose.position[up] = T(0.012) + T(0.021) * T(rest);
    if (scene == Scene::cylinder) pose.position.array() += T(0.03);
    pose.rotation = S::exp(S::Angular::Constant(T(100) * jitter(random)));
    world.add_grain(world.add_shape(shapes[k % shapes.size()]), pose, T(2700));
  }
  if (scene == Scene::cylinder) {
    typename S::Angular axis = S::Angular::Zero();
    axis[S::angular_dim == 1 ? 0 : 1] = 1;
    const Vector center = Vector::Constant(T(0.15));
    const BodyId drum = world.add_cylinder(center, axis, T(0.3));
    world.set_spin(drum, T(0.5) * axis);
    for (int a = 1; a < up; ++a) {
      world.add_wall(Vector::Unit(a), Vector::Zero());
      world.add_wall(-Vector::Unit(a), T(0.2) * Vector::Unit(a));
    }
  } else {
    for (int axis = 0; axis < up; ++axis) {
      const Vector n = Vector::Unit(axis);
      if (axis == 0 && scene == Scene::periodic) {
        world.set_periodic(0, T(0), T(0.1));
        continue;
      }
      world.add_wall(n, Vector::Zero());
      const BodyId wall = world.add_wall(-n, T(0.1) * n);
      if (axis == 0) {
        world.set_wall_mass(wall, T(1));
        world.set_force(wall, T(-20) * n);
      }
    }
    world.add_wall(Vector::Unit(up), Vector::Zero());
  }
  world.set_gravity(T(-9.81) * Vector::Unit(up));
}

template <class World, class ShapeT>
void simulate(const std::string& name, World world, const std::vector<ShapeT>& shapes,
              std::size_t count = 48, int steps = 240, double step = 5e-4,
              Scene scene = Scene::box) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  Hash hash;
  World empty = world;
  fill(world, shapes, count, scene);
  for (int k = 0; k < steps; ++k) {
    add_report(hash, world.step(T(step)));
    if (k % 20 == 0) add_state(hash, world);
  }
  add_state(hash, world);
  hash.print(name);
  const auto path = std::filesystem::temp_directory_path() / "moreau_answers.snapshot";
  write_snapshot(path, world);
  read_snapshot(path, empty);
  std::filesystem::remove(path);
  Hash again;
  for (int k = 0; k < 20; ++k) add_report(again, empty.step(T(step)));
  add_state(again, empty);
  again.print(name + ", restarted");
}

template <class ShapeT>
std::vector<ShapeT> grains(std::size_t count) {
  std::mt19937_64 random(3);
  std::vector<ShapeT> shapes;
  for (const ShapeT& shape : ballast_shapes<ShapeT>(count, random))
    shapes.push_back(shape.scaled(typename SpaceOf<ShapeT>::Scalar(0.01)));
  return shapes;
}

template <class ShapeT>
void of_shape(const std::string& name) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  using Coulomb = SignoriniCoulomb<T>;
  const auto shapes = grains<ShapeT>(8);
  const Materials<Coulomb> law(1, Coulomb(T(0.4)));
  simulate(name, Simulation<ShapeT, Coulomb>(T(0.02), law), shapes);
  simulate(name + ", periodic", Simulation<ShapeT, Coulomb>(T(0.02), law), shapes, 48, 240, 5e-4,
           Scene::periodic);
  simulate(name + ", cylinder", Simulation<ShapeT, Coulomb>(T(0.02), law), shapes, 32, 240, 5e-4,
           Scene::cylinder);
}

template <class ShapeT>
void policies(const std::string& name) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Coulomb = SignoriniCoulomb<T>;
  const auto shapes = grains<ShapeT>(8);
  const Materials<Coulomb> coulomb(1, Coulomb(T(0.3), T(0.2), T(0.4)));
  ColouredOptions qm16;
  qm16.stop_test = StopTest::qm16;
  using Simple = Simulation<ShapeT, Coulomb>;
  simulate(name + ", qm16, restitution, friction that falls",
           Simple(T(0.02), coulomb, ColouredGaussSeidel(qm16)), shapes);
  using Grid = Simulation<ShapeT, Coulomb, MoreauJean, CellGrid<S>>;
  Grid shared(T(0.02), coulomb);
  shared.set_team(ThreadTeam(2));
  simulate(name + ", two threads, cell grid", shared, shapes);
  using Reference = Simulation<ShapeT, Coulomb, MoreauJean, AllPairs<S>, NonlinearGaussSeidel>;
  simulate(name + ", reference solver", Reference(T(0.02), coulomb), shapes);
  using Frictionless_ = Simulation<ShapeT, Frictionless<T>>;
  simulate(name + ", frictionless",
           Frictionless_(T(0.02), Materials<Frictionless<T>>(1, Frictionless<T>())), shapes);
  using Sticky = Cohesive<Coulomb>;
  simulate(name + ", cohesive",
           Simulation<ShapeT, Sticky>(
               T(0.02), Materials<Sticky>(1, Sticky(Coulomb(T(0.4)), T(0.5), T(1e-3)))),
           shapes);
  using Fallback = Simulation<ShapeT, Coulomb, MoreauJean, SweepAndPrune<S>,
                              ProximalFallback<ColouredGaussSeidel>>;
  simulate(name + ", proximal fallback", Fallback(T(0.02), coulomb), shapes, 24, 80);
  using Spring = LinearSpringDashpot<T>;
  simulate(
      name + ", springs",
      Simulation<ShapeT, Spring>(T(0.02), Materials<Spring>(1, Spring(T(1e5), T(5e4), T(0.4)))),
      shapes, 32, 400, 2e-5);
}

}  // namespace

int main() {
  narrow_phase("polyhedra", pairs::ballast<Polyhedron<double>>(60), 1000);
  narrow_phase("polygons", pairs::ballast<Polygon<double>>(60), 1000);
  narrow_phase("balls", pairs::ballast<Ball<double>>(20), 300);
  narrow_phase("disks", pairs::ballast<Disk<double>>(20), 300);
  narrow_phase("polyhedra in float", pairs::ballast<Polyhedron<float>>(60), 500);
  of_shape<Polyhedron<double>>("polyhedra");
  of_shape<Polygon<double>>("polygons");
  of_shape<Ball<double>>("balls");
  of_shape<Disk<double>>("disks");
  policies<Disk<double>>("disks");
}
