// SPDX-License-Identifier: MIT
// A simulation whose grains live in several processes. Needs MPI and Zoltan; link
// moreau::distributed.
//
//   moreau::MpiSession mpi(argc, argv);
//   World world(size, materials);              // a Simulation, the same code in all processes
//   if (rank == 0) build(world);               // or read_snapshot("run.snapshot", world)
//   moreau::DistributedSimulation<World> packing(MPI_COMM_WORLD, std::move(world));
//   for (...) packing.step(1e-4);
//   if (const auto whole = packing.gather())   // on rank 0
//     write_snapshot("run.snapshot", *whole);
//
// 1. Space is cut into one box per process (domain_decomposition.hpp). A process owns the grains whose
//    centre is in its box. Walls are in every process.
// 2. It has copies of the grains of other processes that can touch its own (ghosts). Grains change
//    their owner, and ghosts are found anew, when one of them has moved by the skin.
// 3. The contacts of two grains with different owners are those of one of them.
// 4. Each process solves the contact problem of its contacts. Bodies that have contacts in several
//    processes are split (solve/shared_bodies.hpp). Their velocities are exchanged once per sweep. The
//    residual and all measures that end the sweeps are those of all contacts together.
// 5. The owners of grains move them, and send their motion to the processes that have ghosts of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/distributed/communicator.hpp"
#include "moreau/distributed/detail/ordered_rank_sharing.hpp"
#include "moreau/distributed/detail/rank_sharing.hpp"
#include "moreau/distributed/detail/redistribution.hpp"
#include "moreau/distributed/detail/reduced_report.hpp"
#include "moreau/distributed/detail/world_parts.hpp"
#include "moreau/distributed/domain_decomposition.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/world/simulation.hpp"

namespace moreau {

/// Options of DistributedSimulation.
struct DistributionOptions {
  /// Space is cut anew if the work of a process is above this multiple of the mean, > 1. The work is
  /// the number of grains and contact points.
  double imbalance = 1.1;
};

/// How the grains are distributed.
struct DistributionReport {
  std::size_t grains = 0;  ///< of this process
  std::size_t ghosts = 0;  ///< copies of grains of other processes in this process
  std::size_t shared = 0;  ///< grains of which this process averaged a copy in the last step
  std::size_t redistributions = 0;  ///< how often grains could change their owner
  std::size_t partitions = 0;       ///< how often space was cut
};

/// A Simulation in several processes; the head of this file explains it. All processes call its
/// functions in the same order with the same arguments. Bodies have the ids that they had in the
/// simulation that was distributed.
///
/// A std::exception in one process ends all processes with one message that names the process.
///
/// @tparam World a Simulation whose law is a SetValuedLaw, and whose solver can share bodies (ColouredGaussSeidel;
///               ReproducibleGaussSeidel for laws without attraction)
template <class World>
class DistributedSimulation;

/// The DistributedSimulation of a Simulation; the comment above describes it.
template <class ShapeT, class Law, class Integrator, class Broad, class Solver>
class DistributedSimulation<Simulation<ShapeT, Law, Integrator, Broad, Solver>> {
 public:
  /// The part of one process.
  using World = Simulation<ShapeT, Law, Integrator, Broad, Solver>;
  using S = typename World::S;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  static_assert(SetValuedLaw<Law, S>, "DistributedSimulation: the law is regularized");
  static_assert(
      requires(Solver solver) { solver.share_bodies(nullptr); },
      "DistributedSimulation: the solver cannot share bodies");
  static_assert(
      !AttractiveLaw<Law, S> || !requires { Solver::splits_bodies; },
      "DistributedSimulation: the law attracts, for which bodies must be split");

  /// Distributes the simulation of rank 0. The other processes give one of the same type, which may be
  /// empty; it is replaced.
  /// @throws std::invalid_argument for an imbalance that is not above 1
  DistributedSimulation(MPI_Comm processes, World world, const DistributionOptions& options = {})
      : options_(options),
        processes_(processes),
        decomposition_(processes_),
        sharing_(std::make_shared<Sharing>(processes_)),
        world_(std::move(world)),
        redistribution_(processes_, decomposition_, sharing_->topology, world_) {
    require(options.imbalance > 1, "DistributedSimulation", "imbalance", options.imbalance,
            "must be above 1");
    guarded([&] {
      require(!world_.cell().is_lattice(), "DistributedSimulation", "cell", "(deforming)",
              "must be open, or a box of set_periodic()");
      redistribution_.begin();
      require(splits || CompliantLaw<Law, S> || !world_.correction().options().enabled,
              "DistributedSimulation", "correction.enabled", true,
              "must be false for a solver with the same bits for any number of processes");
      detail::WorldParts<World> parts(world_);
      parts.dynamics().share_bodies(sharing_);
      parts.detector().set_filter([sharing = sharing_](std::uint32_t a, std::uint32_t b) {
        return sharing->topology.has_contact(a, b);
      });
    });
  }
  DistributedSimulation(const DistributedSimulation&) = delete;
  DistributedSimulation& operator=(const DistributedSimulation&) = delete;

  /// Advances the time by `step` [s], > 0.
  /// @returns results of the step of all processes together: sums, or the largest value of times,
  ///          overlaps and shifts
  /// @throws std::invalid_argument for a step that is not positive or not finite
  StepReport step(Scalar step) {
    require_positive(step, "DistributedSimulation::step", "step");
    return guarded([&] {
      redistribution_.update(step, options_.imbalance);
      // The pair caches of the detector depend on the process that had the pairs.
      if constexpr (!splits) detail::WorldParts<World>(world_).forget_pairs();
      StepReport report = world_.step(step);
      redistribution_.refresh_ghosts();
      if (report.max_overlap > 0) {
        report.deepest_a = redistribution_.id(report.deepest_a).value;
        report.deepest_b = redistribution_.id(report.deepest_b).value;
      }
      detail::reduce(report, processes_);
      return report;
    });
  }

  /// The whole simulation with its contacts and impulses, on rank 0; nothing on the other ranks. It
  /// can be measured, written to a file, and distributed again, also over another number of processes.
  std::optional<World> gather() {
    return guarded([&] { return redistribution_.gather(); });
  }

  double time() const { return world_.time(); }  ///< sum of the steps [s]
  /// Grains of all processes together.
  std::size_t grain_count() {
    return std::size_t(processes_.sum(double(redistribution_.own_grains())));
  }
  std::span<const BodyId> walls() const { return redistribution_.half_spaces(); }  ///< half-spaces

  // The functions of BodyControl and BodyAccess for walls. They throw std::invalid_argument as the
  // functions of Simulation do.

  /// Pose of a wall, world axes [m].
  const Pose<S>& pose(BodyId wall) const { return world_.pose(local(wall)); }
  /// Velocity of a wall, world axes [m/s].
  const Vector velocity(BodyId wall) const { return world_.velocity(local(wall)); }
  /// Sets the pose of a wall, world axes [m].
  void set_pose(BodyId wall, const Pose<S>& pose) { world_.set_pose(local(wall), pose); }
  /// Sets the velocity of a wall, world axes [m/s].
  void set_velocity(BodyId wall, const VectorArgument<S>& velocity) {
    world_.set_velocity(local(wall), velocity);
  }
  /// Sets the angular velocity of a wall, world axes [rad/s].
  void set_spin(BodyId wall, const AngularArgument<S>& spin) { world_.set_spin(local(wall), spin); }
  /// Sets the force on a wall with a mass, world axes [N].
  void set_force(BodyId wall, const VectorArgument<S>& force) {
    world_.set_force(local(wall), force);
  }
  /// Gives a wall a mass [kg] along its normal.
  void set_wall_mass(BodyId wall, Scalar mass) { world_.set_wall_mass(local(wall), mass); }
  /// Sets the acceleration of gravity on grains, world axes [m/s^2].
  void set_gravity(const VectorArgument<S>& gravity) { world_.set_gravity(gravity); }
  /// M^-1/2 of a wall, world axes [kg^-1/2, kg^-1/2 m^-1]. Drives ask for it.
  MobilityRoot<S> mobility_root(BodyId wall) const {
    return world_.bodies().mobility_root(local(wall).index());
  }
  /// Sum of the impulses that a wall received from all contacts in the last step, world axes [N s].
  Vector contact_impulse(BodyId wall) {
    Vector sum = world_.contact_impulse(local(wall));
    processes_.sum(std::span(sum.data(), std::size_t(S::dim)));
    return sum;
  }

  /// The part of this process: its grains, the ghosts and the walls, numbered anew. Its contacts and bonds are
  /// those of this process, its breakages those since grains could last change their owner; gather() has all.
  const World& local() const { return world_; }
  /// The id in the whole simulation of a body of local().
  BodyId id(BodyId local) const { return redistribution_.id(local.index()); }
  /// Whether a body of local() is counted in this process: its own grains, and on rank 0 the walls.
  bool owns(BodyId local) const { return sharing_->owns(local.index()); }
  /// How the grains are distributed.
  DistributionReport distribution() const {
    return {redistribution_.own_grains(), redistribution_.ghost_count(), sharing_->shared_grains(),
            redistribution_.count(), redistribution_.partitions()};
  }
  Communicator& processes() { return processes_; }  ///< that share the simulation
  /// Messages of this process so far.
  const Traffic& traffic() const { return processes_.traffic(); }

 private:
  static constexpr bool splits = !requires { Solver::splits_bodies; };
  using Sharing = std::conditional_t<splits, detail::RankSharing<S>, detail::OrderedRankSharing<S>>;

  BodyId local(BodyId wall) const { return redistribution_.local_wall(wall); }

  template <class Work>
  auto guarded(const Work& work) -> decltype(work()) {
    try {
      return work();
    } catch (const std::exception& error) {
      processes_.end_all(error.what());
    }
  }

  DistributionOptions options_;
  Communicator processes_;
  DomainDecomposition<S> decomposition_;
  std::shared_ptr<Sharing> sharing_;
  World world_;
  detail::Redistribution<World> redistribution_;
};

}  // namespace moreau
