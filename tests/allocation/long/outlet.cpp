// SPDX-License-Identifier: MIT
// 2,000 disks flow through an outlet for 10 s while a source replaces those that a sink removes. Every
// grain is accounted for, the run restarts with the same bits, and after its start it allocates only
// where a buffer must hold more contacts or groups of contacts than ever before.
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <doctest/doctest.h>
#include <string>
#include <vector>

#include "moreau/boundary/sink.hpp"
#include "moreau/boundary/source.hpp"
#include "moreau/io/snapshot.hpp"

#include "allocation/counted_new.hpp"
#include "world/assemblies.hpp"

using namespace moreau;

namespace {

using S = Space<2>;
using World = scenes::World<Disk<>>;
using Law = scenes::LawOf<Disk<>>;
constexpr double h = 1e-3, width = 0.4, diameter = 0.01, density = 2500;
constexpr std::size_t grains = 2000;

ColouredOptions solver_options() {
  ColouredOptions options;
  options.tolerance = 1e-3;
  return options;
}

/// Grains that fall from the source move up to 4 mm in a step: contacts are detected from there on.
Tolerances tolerances() {
  Tolerances tolerances;
  tolerances.margin = 0.5;
  return tolerances;
}

/// A silo with side walls and a floor of disks that do not move, with a gap of eight diameters.
struct Silo {
  World world{0.8 * diameter, Materials<Law>(1, Law(0.4)), ColouredGaussSeidel(solver_options()),
              tolerances()};
  std::size_t fixed = 0;
  Source<S> source;
  Sink<S> sink = Sink<S>::behind(S::Vector::UnitY(), {0, -0.1});

  Silo() : source(options(world)) {
    world.set_gravity({0, -9.81});
    world.add_wall(S::Vector::UnitX(), S::Vector::Zero());
    world.add_wall(-S::Vector::UnitX(), {width, 0});
    const ShapeId stone = world.add_shape(Disk<>(diameter / 2));
    for (double x = 0; x < width; x += 0.8 * diameter) {
      if (std::abs(x - width / 2) < 4 * diameter) continue;
      world.prescribe_motion(world.add_grain(stone, {S::Vector(x, 0), S::identity()}, density));
      ++fixed;
    }
  }
  /// Disks of three sizes above the silo, up to the number of grains that flow: those of the floor are obstacles.
  static SourceOptions<S> options(World& world) {
    SourceOptions<S> options;
    options.region = {{diameter, 0.6}, {width - diameter, 0.8}};
    for (const double size : {0.8, 1.0, 1.2})
      options.shapes.push_back(world.add_shape(Disk<>(size * diameter / 2)));
    options.density = density;
    options.velocity = {0, -1};
    options.grain_limit = grains;
    return options;
  }
  void step() {
    source.apply(world, h);
    world.step(h);
    sink.apply(world);
  }
};

/// What source and sink say about each grain, by the index of its body.
class Ledger {
 public:
  explicit Ledger(std::size_t bodies) : entries_(bodies) {}

  void record(const Silo& silo) {
    for (const BodyId grain : silo.sink.removed()) {
      Entry& entry = entries_[grain.index()];
      wrong_ += !entry.present || entry.grain != grain;
      entry.present = false;
      --present_;
    }
  }
  void record_added(const Silo& silo) {
    for (const BodyId grain : silo.source.added()) {
      Entry& entry = entries_[grain.index()];
      wrong_ += entry.present;
      entry = {grain, silo.world.bodies().grain_mass[grain.index()], true};
      ++present_;
    }
  }
  /// Whether the grains of the simulation are those that were added and not removed, with their mass.
  bool agrees(const Silo& silo) const {
    std::size_t found = 0;
    for (const BodyId grain : silo.world.grains()) {
      if (silo.world.is_prescribed(grain)) continue;
      const Entry& entry = entries_[grain.index()];
      if (!entry.present || entry.grain != grain ||
          entry.mass != silo.world.bodies().grain_mass[grain.index()])
        return false;
      ++found;
    }
    return wrong_ == 0 && found == present_ && found + silo.fixed == silo.world.grain_count() &&
           silo.source.total().count - silo.sink.total().count == found;
  }

 private:
  struct Entry {
    BodyId grain;
    double mass = 0;
    bool present = false;
  };
  std::vector<Entry> entries_;
  std::size_t present_ = 0, wrong_ = 0;
};

}  // namespace

TEST_CASE("2,000 grains through an outlet: every grain is accounted for, memory is constant") {
  constexpr int steps = 10000, transient = 4000, middle = 5000, compared = 6000;
  Silo silo;
  REQUIRE(silo.fixed == 40);
  Ledger ledger(3000);
  std::string stopped, continued;
  long before = 0, seen = 0, in_snapshots = 0, allocating_steps = 0;
  std::size_t bodies = 0, unsolved = 0;
  double largest_overlap = 0;
  const auto start = std::chrono::steady_clock::now();
  for (int k = 1; k <= steps; ++k) {
    silo.source.apply(silo.world, h);
    ledger.record_added(silo);
    const StepReport report = silo.world.step(h);
    silo.sink.apply(silo.world);
    ledger.record(silo);
    unsolved += !report.solve.converged;
    largest_overlap = std::max(largest_overlap, report.max_overlap);
    if (k % 100 == 0) REQUIRE(ledger.agrees(silo));
    if (k == transient) {
      before = seen = allocations;
      bodies = silo.world.bodies().size();
    }
    if (k > transient) allocating_steps += allocations > seen;
    if (k == middle || k == compared) {
      const long now = allocations;
      (k == middle ? stopped : continued) = snapshot(silo.world, silo.source, silo.sink);
      in_snapshots += allocations - now;
    }
    seen = allocations;
    if (k > transient) REQUIRE(silo.world.bodies().size() == bodies);
  }
  const long after = allocations;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  MESSAGE("added " << silo.source.total().count << ", removed " << silo.sink.total().count
                   << ", present " << silo.world.grain_count() - silo.fixed << "; "
                   << silo.sink.total().mass << " kg/m removed; bodies " << bodies << "; "
                   << after - before - in_snapshots << " allocations in " << allocating_steps
                   << " of the last 6000 steps; largest overlap " << largest_overlap
                   << " m; steps that did not converge " << unsolved << "; " << seconds.count()
                   << " s");
  CHECK(after - before - in_snapshots < 120);  // growth; one allocation per grain would be 3400
  CHECK(allocating_steps < 60);
  CHECK(silo.sink.total().count > grains);
  CHECK(silo.world.grain_count() > grains / 2);
  const double present = silo.source.total().mass - silo.sink.total().mass;
  double mass = 0;
  for (const BodyId grain : silo.world.grains())
    if (!silo.world.is_prescribed(grain)) mass += silo.world.bodies().grain_mass[grain.index()];
  CHECK(present == doctest::Approx(mass).epsilon(1e-10));

  Silo other;
  restore_snapshot(stopped, other.world, other.source, other.sink);
  for (int k = middle; k < compared; ++k) other.step();
  CHECK(snapshot(other.world, other.source, other.sink) == continued);
}
