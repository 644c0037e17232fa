// SPDX-License-Identifier: MIT
// A program of which one process fails in a step: all end, after one message. With an argument no process fails by itself:
//   cell     the simulation has a cell that deforms, which is refused
//   overlap  two grains lie in each other, which the first step refuses
//   allowed  the same, and allow_overlaps(): the program ends as it should
#include <cstdio>
#include <stdexcept>
#include <string_view>

#include "moreau/distributed/distributed_simulation.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/motion/moreau_jean.hpp"
#include "moreau/shape/ball.hpp"

namespace {

using namespace moreau;

/// Fails in rank 1.
struct Failing : MoreauJean {
  static inline bool fails = true;
  template <class S>
  void predict_configuration(Bodies<S>& bodies, std::span<typename S::Angular> momentum,
                             typename S::Scalar step) const {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == 1 && fails) throw std::runtime_error("this rank fails on purpose");
    MoreauJean::predict_configuration(bodies, momentum, step);
  }
};

}  // namespace

int main(int argc, char** argv) {
  const MpiSession mpi(argc, argv);
  using Law = SignoriniCoulomb<>;
  using World = Simulation<Ball<>, Law, Failing>;
  World world(0.02, Materials<Law>(1, Law(0.3)));
  const ShapeId shape = world.add_shape(Ball<>(0.01));
  for (int k = 0; k < 9; ++k)
    world.add_grain(shape, {{0.03 * k, 0, 0}, Space<3>::Rotation::Identity()}, 2700);
  const std::string_view how = argc > 1 ? argv[1] : "";
  Failing::fails = how.empty();
  if (how == "cell") world.set_cell(Space<3>::Matrix::Identity());
  if (how == "overlap" || how == "allowed")
    world.add_grain(shape, {{0.001, 0, 0}, Space<3>::Rotation::Identity()}, 2700);
  world.allow_overlaps(how == "allowed");
  DistributedSimulation<World> packing(MPI_COMM_WORLD, world);
  packing.step(1e-3);
  std::puts("goes on");
}
