// SPDX-License-Identifier: MIT
// Macros of this folder. They declare or instantiate templates that take long to compile; KEYWORD is
// `extern template` (compiled elsewhere) or `template` (compiled here).
#pragma once

#ifdef MOREAU_INSTANTIATE
#define MOREAU_INSTANCE template
#else
#define MOREAU_INSTANCE extern template
#endif

/// The parts that depend on the shape only: detection, the parts of a simulation that hold its bodies.
#define MOREAU_SHAPE_INSTANCES(KEYWORD, ShapeT) \
  KEYWORD class ContactDetector<ShapeT, CellGrid<SpaceOf<ShapeT>>>;

/// The parts that depend on the space and on the law only: the solver and its stages of a step.
#define MOREAU_LAW_INSTANCES(KEYWORD, SpaceT, LawT) \
  KEYWORD class detail::ImpulseDynamics<SpaceT, LawT, MoreauJean, ColouredGaussSeidel>;

/// The part that depends on both: the step.
#define MOREAU_STEP_INSTANCE(KEYWORD, ShapeT, LawT) \
  KEYWORD StepReport Simulation<ShapeT, LawT>::step(double);

/// All functions of a simulation that are not inline. clang++ 14 instantiates with a class also members whose
/// requirements do not hold, and g++ 12 instantiates no member that is defaulted outside of its class.
#if defined(__clang__)
#define MOREAU_SIMULATION_INSTANCE(KEYWORD, ShapeT, LawT)                                          \
  KEYWORD Simulation<ShapeT, LawT>::Simulation(double, const Materials<LawT>&, const Tolerances&,  \
                                               const Simulation<ShapeT, LawT>::Parts&);            \
  KEYWORD Simulation<ShapeT, LawT>::Simulation(const Simulation<ShapeT, LawT>&);                   \
  KEYWORD Simulation<ShapeT, LawT>::Simulation(Simulation<ShapeT, LawT>&&);                        \
  KEYWORD Simulation<ShapeT, LawT>& Simulation<ShapeT, LawT>::operator=(                           \
      const Simulation<ShapeT, LawT>&);                                                            \
  KEYWORD Simulation<ShapeT, LawT>& Simulation<ShapeT, LawT>::operator=(                           \
      Simulation<ShapeT, LawT>&&);                                                                 \
  KEYWORD Simulation<ShapeT, LawT>::~Simulation();                                                 \
  KEYWORD ShapeId Simulation<ShapeT, LawT>::add_shape(const ShapeT&);                              \
  KEYWORD BodyId Simulation<ShapeT, LawT>::add_grain(ShapeId, const Pose<SpaceOf<ShapeT>>&,        \
                                                     double, MaterialId);                          \
  KEYWORD BodyId Simulation<ShapeT, LawT>::add_wall(                                               \
      const VectorArgument<SpaceOf<ShapeT>>&, const VectorArgument<SpaceOf<ShapeT>>&, MaterialId); \
  KEYWORD BodyId Simulation<ShapeT, LawT>::add_cylinder(const VectorArgument<SpaceOf<ShapeT>>&,    \
                                                        const AngularArgument<SpaceOf<ShapeT>>&,   \
                                                        double, MaterialId);                       \
  KEYWORD void Simulation<ShapeT, LawT>::remove(std::span<const BodyId>, const char*);             \
  KEYWORD StepReport Simulation<ShapeT, LawT>::step(double);
#else
#define MOREAU_SIMULATION_INSTANCE(KEYWORD, ShapeT, LawT) KEYWORD class Simulation<ShapeT, LawT>;
#endif

/// The worlds of one space: spheres and one kind of polytope in double under Signorini-Coulomb,
/// with the default integrator, broad phase and solver.
#define MOREAU_WORLD_INSTANCES(KEYWORD, SpaceT, PolytopeT)           \
  KEYWORD class PolytopeT;                                           \
  MOREAU_SHAPE_INSTANCES(KEYWORD, PolytopeT)                         \
  MOREAU_SHAPE_INSTANCES(KEYWORD, BallIn<SpaceT>)                    \
  MOREAU_LAW_INSTANCES(KEYWORD, SpaceT, SignoriniCoulomb<double>)    \
  MOREAU_STEP_INSTANCE(KEYWORD, PolytopeT, SignoriniCoulomb<double>) \
  MOREAU_STEP_INSTANCE(KEYWORD, BallIn<SpaceT>, SignoriniCoulomb<double>)

/// Snapshots of a simulation.
#define MOREAU_SNAPSHOT_INSTANCES(KEYWORD, ShapeT, LawT)                                        \
  KEYWORD void detail::transfer_simulation(detail::ArchiveReader&, Simulation<ShapeT, LawT>&);  \
  KEYWORD void detail::transfer_simulation(detail::ArchiveWriter&, Simulation<ShapeT, LawT>&);  \
  KEYWORD void detail::transfer_simulation(detail::ArchiveOutline&, Simulation<ShapeT, LawT>&); \
  KEYWORD Simulation<ShapeT, LawT> detail::copy_of_simulation(const Simulation<ShapeT, LawT>&); \
  KEYWORD void detail::replace_simulation(Simulation<ShapeT, LawT>&, Simulation<ShapeT, LawT>&);

/// Files for ParaView of a simulation.
#define MOREAU_PARAVIEW_INSTANCE(KEYWORD, ShapeT, LawT)                                      \
  KEYWORD void write_paraview(const std::filesystem::path&, const Simulation<ShapeT, LawT>&, \
                              double, const VtkOptions&);

/// Files for ParaView and the energy balance: what depends on the space only.
#define MOREAU_MEASURE_INSTANCES(KEYWORD, SpaceT) \
  KEYWORD class VtkWriter<SpaceT>;                \
  KEYWORD class EnergyBalance<SpaceT>;

/// The parts of the library of usual simulations (usual.hpp); each is a source of its own.
#define MOREAU_BALL_AND_POLYTOPE_INSTANCES(KEYWORD, BallT, PolytopeT) \
  KEYWORD class PolytopeT;                                            \
  MOREAU_SHAPE_INSTANCES(KEYWORD, BallT)                              \
  MOREAU_SHAPE_INSTANCES(KEYWORD, PolytopeT)
#define MOREAU_CAPSULE_AND_COMPOUND_INSTANCES(KEYWORD, CapsuleT, PolytopeT) \
  MOREAU_SHAPE_INSTANCES(KEYWORD, CapsuleT)                                 \
  MOREAU_SHAPE_INSTANCES(KEYWORD, Compound<PolytopeT>)
#define MOREAU_SIMULATION_INSTANCES(KEYWORD, ShapeT, LawT) \
  MOREAU_SIMULATION_INSTANCE(KEYWORD, ShapeT, LawT)        \
  MOREAU_SNAPSHOT_INSTANCES(KEYWORD, ShapeT, LawT)         \
  MOREAU_PARAVIEW_INSTANCE(KEYWORD, ShapeT, LawT)
#define MOREAU_SPACE_AND_LAW_INSTANCES(KEYWORD, SpaceT, BallT, PolytopeT, CapsuleT, LawT) \
  MOREAU_LAW_INSTANCES(KEYWORD, SpaceT, LawT)                                             \
  MOREAU_SIMULATION_INSTANCES(KEYWORD, BallT, LawT)                                       \
  MOREAU_SIMULATION_INSTANCES(KEYWORD, PolytopeT, LawT)                                   \
  MOREAU_SIMULATION_INSTANCES(KEYWORD, CapsuleT, LawT)                                    \
  MOREAU_SIMULATION_INSTANCES(KEYWORD, Compound<PolytopeT>, LawT)
#define MOREAU_PLANE_INSTANCES(KEYWORD, LawT)                                      \
  MOREAU_SPACE_AND_LAW_INSTANCES(KEYWORD, Space<2>, Disk<double>, Polygon<double>, \
                                 Stadium<double>, LawT)
#define MOREAU_SPACE_INSTANCES(KEYWORD, LawT)                                         \
  MOREAU_SPACE_AND_LAW_INSTANCES(KEYWORD, Space<3>, Ball<double>, Polyhedron<double>, \
                                 Capsule<double>, LawT)
