// SPDX-License-Identifier: MIT
// ReproducibleGaussSeidel: the same bits for any number of processes.
#include <cstdint>
#include <doctest/doctest.h>
#include <string_view>
#include <type_traits>

#include "moreau/core/crc64.hpp"
#include "moreau/distributed/reproducible_gauss_seidel.hpp"
#include "moreau/io/snapshot.hpp"

#include "distributed/worlds.hpp"

using namespace distributed_test;

namespace {

/// The hash of the state after some steps over all ranks below `count`, or on this rank alone.
/// Redistributes on the way, and once goes through a snapshot with another number of processes.
template <class World>
std::uint64_t hash_after(const std::string& start, int count, int steps, bool restarts) {
  std::string bytes = start;
  for (int part = 0; part < (restarts ? 2 : 1); ++part) {
    const int size = part == 0 ? count : std::max(1, count - 1);
    MPI_Comm some = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, rank() < size ? 0 : MPI_UNDEFINED, 0, &some);
    if (some != MPI_COMM_NULL) {
      World world = empty_world<World>();
      if (rank() == 0) restore_snapshot(bytes, world);
      {
        DistributedSimulation<World> packing(some, std::move(world));
        const int share = restarts ? steps / 2 : steps;
        for (int k = 0; k < share; ++k) {
          const bool is_solved = packing.step(step).solve.converged;
          // Rigid contacts are not solved to 1e-6 in every step, whatever the number of processes.
          if (std::is_same_v<World, OrderedSoftPolyhedra>) CHECK(is_solved);
        }
        if (size > 1) CHECK(packing.distribution().redistributions > 2);
        if (const std::optional<World> whole = packing.gather()) bytes = snapshot(*whole);
      }
      MPI_Comm_free(&some);
    }
  }
  // A snapshot ends with its own checksum: with it, the checksum would be the same for every state.
  return moreau::detail::crc64(
      std::string_view(bytes).substr(0, bytes.size() - sizeof(std::uint64_t)));
}

template <class World>
void check_bits(const std::string& start, int steps) {
  const std::uint64_t alone = hash_after<World>(start, 1, steps, false);
  for (int count = 2; count <= ranks(); ++count) {
    const std::uint64_t hash = hash_after<World>(start, count, steps, false);
    if (rank() == 0) CHECK(hash == alone);
  }
  const std::uint64_t restarted = hash_after<World>(start, ranks(), steps, true);
  if (rank() == 0) CHECK(restarted == alone);
}

}  // namespace

TEST_CASE("The state has the same bits for any number of processes") {
  check_bits<OrderedPolygons>(snapshot(box_of_grains<OrderedPolygons>(80)), 240);
  check_bits<OrderedRollingBalls>(snapshot(box_of_grains<OrderedRollingBalls>(60)), 120);
  check_bits<OrderedSoftPolyhedra>(snapshot(box_of_grains<OrderedSoftPolyhedra>(60)), 200);
}

TEST_CASE("The residual of the report is the one on one rank") {
  using World = OrderedPolygons;
  DistributedSimulation<World> packing(
      MPI_COMM_WORLD, rank() == 0 ? box_of_grains<World>(80) : empty_world<World>());
  for (int k = 1; k <= 240; ++k) {
    const bool checks = k % 20 == 0;
    std::optional<World> before;
    if (checks) before = packing.gather();
    const StepReport report = packing.step(step);
    if (!checks) continue;
    const std::optional<World> after = packing.gather();
    if (!after) continue;
    const SolveReport measured = measured_on_one_rank(*before, *after);
    CHECK(report.solve.converged == (report.solve.residual <= 1e-6));
    if (report.solve.converged) CHECK(measured.residual <= 1e-6);
    CHECK(measured.residual == doctest::Approx(report.solve.residual).epsilon(1e-3));
  }
}

TEST_CASE("Exact sums do not depend on the order, and are rounded once") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> part(-1, 1), exponent(-300, 300);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> terms;
    for (int k = 0; k < 200; ++k) terms.push_back(part(random) * std::pow(10, exponent(random)));
    for (int k = 0; k < 100; ++k) terms.push_back(-terms[std::size_t(k)]);
    detail::ExactSum one, two;
    for (const double x : terms) one.add(x);
    std::shuffle(terms.begin(), terms.end(), random);
    for (const double x : terms) two.add(x);
    CHECK(one.value() == two.value());
  }
  detail::ExactSum sum;
  for (const double x : {1e300, 1.0, -1e300, 1e-310, 3 * 5e-324}) sum.add(x);
  CHECK(sum.value() == 1);
  sum.add(-1);
  CHECK(sum.value() == 1e-310 + 3 * 5e-324);
  sum.add(std::numeric_limits<double>::infinity());
  CHECK(std::isnan(sum.value()));
}

TEST_CASE("Without processes, a wall with a mass touches any number of grains") {
  OrderedPolygons row = empty_world<OrderedPolygons>(1e-4);
  const ShapeId shape = row.add_shape(regular_shape<Polygon<>>(size));
  const Space<2>::Rotation flat = Space<2>::exp(Space<2>::Angular(0.0));
  for (int k = 0; k < 300; ++k)
    row.add_grain(shape, {Space<2>::Vector(1.2 * size * k, 0), flat}, 2700);
  const double up = row.shape(shape).bounding_box({}).upper[1];
  row.add_wall({0, 1}, {0, -up});
  const BodyId lid = row.add_wall({0, -1}, {0, up});
  row.set_wall_mass(lid, 1);
  row.set_force(lid, {0, -10});
  const StepReport report = row.step(step);
  CHECK(report.points >= 600);
  CHECK(report.solve.converged);
  CHECK(row.velocity(lid).norm() < 1e-3 * 10 * step);
}
