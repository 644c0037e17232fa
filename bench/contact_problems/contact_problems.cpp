// SPDX-License-Identifier: MIT
#include "contact_problems/contact_problems.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <span>

#include "moreau/io/siconos_text.hpp"
#include "moreau/sample/ballast.hpp"
#include "moreau/world/simulation.hpp"

#include "physics/masonry.hpp"
#include "ratcheting/experiment.hpp"

#ifdef CONTACT_PROBLEMS_HDF5
#include "moreau/io/fclib.hpp"
#endif

namespace contact_problems {

namespace {

/// Destination for the problem of the next step; null: none.
template <class S>
StepProblem<S>* wanted = nullptr;

/// The study's solver, which also stores the problem of a step if asked to.
struct Keeping : ratcheting::StudySolver {
  using StudySolver::StudySolver;

  template <class Operator, class L>
  SolveReport solve(ContactProblem<Operator, L>& problem,
                    std::span<typename Operator::Vector> impulses,
                    Workspace<Operator, L>& workspace) const {
    using S = typename Operator::Space;
    if (StepProblem<S>* const step = std::exchange(wanted<S>, nullptr))
      *step = {problem, {impulses.begin(), impulses.end()}};
    return StudySolver::solve(problem, impulses, workspace);
  }
};

/// Returns the problem that the next step of a simulation solves.
template <class S>
StepProblem<S> problem_of(const std::function<void()>& step) {
  StepProblem<S> problem;
  wanted<S> = &problem;
  step();
  return problem;
}

/// Grains fall from a lattice into a box for the time that the highest grain needs to fall through
/// half of the box. Then a wall compresses them from the side with ten times their weight.
template <class ShapeT>
StepProblem<SpaceOf<ShapeT>> packing(std::size_t count) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  constexpr double radius = 0.0125, step = 2e-4, cell = 2.05 * radius, gravity = 9.81;
  std::mt19937_64 random(1);
  const auto shapes = ballast_shapes<ShapeT>(30, random);
  Simulation<ShapeT, Law, MoreauJean, SweepAndPrune<S>, Keeping> world(
      2 * radius, Materials<Law>(1, Law(0.4)), Keeping(ColouredOptions{.max_sweeps = 200}));
  world.set_contact_points(ContactPoints::few);  // those of the figures in bench/README.md
  const auto side = static_cast<std::size_t>(std::ceil(std::pow(double(count), 1.0 / S::dim)));
  const double width = double(side) * cell;
  double mass = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Pose<S> pose;
    std::size_t place = i;
    for (int d = 0; d < S::dim; ++d) {
      pose.position[d] = (double(d == up ? place : place % side) + 0.5) * cell;
      place /= side;
    }
    typename S::Angular turn;
    for (auto& x : turn) x = std::uniform_real_distribution<double>(-3, 3)(random);
    pose.rotation = S::exp(turn);
    const auto body =
        world.add_grain(world.add_shape(shapes[i % shapes.size()].scaled(radius)), pose, 2700);
    mass += world.bodies().grain_mass[body.index()];
  }
  BodyId wall;
  for (int d = 0; d < up; ++d) {
    world.add_wall(Vector::Unit(d), Vector::Zero());
    const BodyId far = world.add_wall(-Vector::Unit(d), width * Vector::Unit(d));
    if (d == 0) wall = far;
  }
  world.add_wall(Vector::Unit(up), Vector::Zero());
  world.set_gravity(-gravity * Vector::Unit(up));
  const double fall = std::sqrt(width / gravity);
  while (world.time() < fall) world.step(step);
  world.set_wall_mass(wall, mass);
  world.set_force(wall, -10 * mass * gravity * Vector::Unit(0));
  for (int k = 0; k < 200; ++k) world.step(step);
  return problem_of<S>([&] { world.step(step); });
}

/// The study with another solver.
struct KeepingDynamics : ratcheting::ContactDynamics {
  using Solver = Keeping;
};

/// Two steps of the study's box: at the least force, while the wall opens, and at the largest
/// force, while it is jammed. The force per grain is that of the study.
template <class ShapeT>
std::array<StepProblem<SpaceOf<ShapeT>>, 2> drive(std::size_t grains) {
  using S = SpaceOf<ShapeT>;
  ratcheting::Parameters p;
  p.fmax *= double(grains) / double(p.grains);
  p.grains = grains;
  p.preparation_time = 0.1;
  std::mt19937_64 own(p.seed), twin(p.seed);
  using Twin = typename ratcheting::SolidTwin<ShapeT>::type;
  const double thickness = ratcheting::make_grains<Twin>(p, twin).volume /
                           ratcheting::make_grains<ShapeT>(p, own).volume;
  ratcheting::Experiment<ShapeT, KeepingDynamics> box(p, thickness);
  box.compress([](const char*, const StepReport&) {});
  box.release();
  const auto step_at = [&](double phase) {
    while (box.time() < phase / p.frequency) box.vibrate();
    return problem_of<S>([&] { box.vibrate(); });
  };
  return {step_at(0.25), step_at(0.75)};
}
/// Both steps come from one run.
template <class ShapeT, std::size_t grains>
const std::array<StepProblem<SpaceOf<ShapeT>>, 2>& driven() {
  static const auto steps = drive<ShapeT>(grains);
  return steps;
}

/// The first step of a structure of dry blocks, without a warm start.
template <class ShapeT>
StepProblem<SpaceOf<ShapeT>> first_step(masonry::Structure<ShapeT, Keeping> structure) {
  structure.simulation.set_solver(Keeping(ColouredOptions{.max_sweeps = 1}));
  return problem_of<SpaceOf<ShapeT>>([&] { structure.simulation.step(5e-3); });
}

}  // namespace

template <class ShapeT>
std::vector<Named<StepProblem<SpaceOf<ShapeT>>>> step_problems() {
  return {{"packing/300", [] { return packing<ShapeT>(300); }},
          {"packing/1200", [] { return packing<ShapeT>(1200); }},
          {"driven/300/out", [] { return driven<ShapeT, 300>()[0]; }},
          {"driven/300/jammed", [] { return driven<ShapeT, 300>()[1]; }},
          {"column/40", [] { return first_step(masonry::column<ShapeT, Keeping>(40)); }},
          {"wall/105", [] { return first_step(masonry::wall<ShapeT, Keeping>(10, 10)); }},
          {"large/driven/1200/out", [] { return driven<ShapeT, 1200>()[0]; }},
          {"large/driven/1200/jammed", [] { return driven<ShapeT, 1200>()[1]; }},
          {"large/packing/4800", [] { return packing<ShapeT>(4800); }},
          {"large/packing/20000", [] { return packing<ShapeT>(20000); }}};
}

template std::vector<Named<StepProblem<Space<3>>>> step_problems<Polyhedron<>>();
template std::vector<Named<StepProblem<Space<2>>>> step_problems<Polygon<>>();

std::vector<Named<AnyFrictionProblem>> file_problems() {
  const auto text = [](const std::string& name) {
    return Named<AnyFrictionProblem>(
        name, [name] { return read_siconos_text(CONTACT_PROBLEMS_FOLDER + name); });
  };
  return {
      text("FrictionContact3D_1c.dat"),
      text("FC2D_SliderCrankLagrangian00000.dat"),
      text("FrictionContactProblem00031.dat"),
      text("Rover1039.dat"),
      text("OneObject-i1028-138.hdf5.dat"),
#ifdef CONTACT_PROBLEMS_HDF5
      {"Capsules-i125-1213.hdf5",
       [] { return read_fclib(CONTACT_PROBLEMS_FOLDER "Capsules-i125-1213.hdf5"); }},
#endif
  };
}

}  // namespace contact_problems
