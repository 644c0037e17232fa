// SPDX-License-Identifier: MIT
// Rigid grains and walls in contact. The shape decides whether they are in the plane or in space.
// One step: predict the configuration, detect the contacts, assign their laws, compute their
// impulses (impulse_dynamics.hpp) or forces (force_dynamics.hpp), advance the configuration.
#pragma once

#include <algorithm>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

#include "moreau/contact/contact.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/periodic_cell.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/value.hpp"
#include "moreau/detect/broad/cell_grid.hpp"
#include "moreau/detect/broad/sweep_and_prune.hpp"
#include "moreau/law/materials.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/cylinder_wall.hpp"
#include "moreau/shape/half_space.hpp"
#include "moreau/solve/concepts.hpp"
#include "moreau/world/body_control.hpp"
#include "moreau/world/bond.hpp"
#include "moreau/world/cell_control.hpp"
#include "moreau/world/cell_motion.hpp"
#include "moreau/world/contact_detector.hpp"
#include "moreau/world/defaults.hpp"
#include "moreau/world/detail/attraction_forces.hpp"
#include "moreau/world/detail/bridges.hpp"
#include "moreau/world/detail/chord_velocities.hpp"
#include "moreau/world/detail/force_dynamics.hpp"
#include "moreau/world/detail/impulse_dynamics.hpp"
#include "moreau/world/detail/refused.hpp"
#include "moreau/world/detail/state_access.hpp"
#include "moreau/world/detail/step_context.hpp"
#include "moreau/world/overlap_correction.hpp"
#include "moreau/world/step_report.hpp"
#include "moreau/world/tolerances.hpp"

namespace moreau {

/// Grains and walls in contact, advanced step by step. SI units; in the plane, masses, forces and
/// energies are per length if densities are.
///
/// @tparam ShapeT     shape of the grains, convex or a Compound; its space is that of the simulation
/// @tparam Law        contact law between two materials, set-valued or regularized
/// @tparam Integrator of impulses for a set-valued law, of forces for a regularized law
/// @tparam Broad      broad phase
/// @tparam Solver     of the contact problem; NoSolver for a regularized law
///
/// Policies that do not fit together do not compile; policies.hpp has the reasons.
/// BodyAccess has the functions that read bodies: pose(id), velocity(id), grains(), ... BodyControl
/// has those that set forces and motions: set_velocity(id, v), prescribe_motion(id), ...
///
/// Functions throw std::invalid_argument, which names function, argument and value, for an id that
/// is not of this simulation or of a grain that was removed, a value that is not finite, and the
/// cases in their comments. The simulation is then unchanged.
template <GrainShape ShapeT, class Law,
          class Integrator = typename detail::DefaultPolicies<ShapeT, Law>::Integrator,
          class Broad = typename detail::DefaultPolicies<ShapeT, Law>::Broad,
          class Solver = typename detail::DefaultPolicies<ShapeT, Law>::Solver>
class Simulation : public BodyControl<ShapeT> {
  static constexpr bool set_valued = SetValuedLaw<Law, SpaceOf<ShapeT>>;
  static constexpr bool bonding = BondingLaw<Law, SpaceOf<ShapeT>>;

 public:
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;
  using Twist = typename S::Twist;
  using BodyControl<ShapeT>::bodies;

  /// A simulation without bodies, at time 0, without gravity, for a set-valued law.
  /// @param grain_size size of the smallest grain [m], > 0; all tolerances are relative to it
  /// @param materials  the law for every pair of materials
  /// @param solver     of the contact problem, with its options
  /// @param tolerances of detection, relative to the grain size [-]
  /// @param correction how overlaps are corrected; not enabled under a compliant law
  /// @param integrator with its options
  /// @throws std::invalid_argument for a size, tolerances or options of the correction out of range
  Simulation(Scalar grain_size, const Materials<Law>& materials, const Solver& solver = Solver{},
             const Tolerances& tolerances = {},
             const OverlapCorrectionOptions& correction = Dynamics::default_correction(),
             const Integrator& integrator = Integrator{}) requires set_valued
      : Simulation(grain_size, materials, tolerances, Parts(solver, correction, integrator)) {}
  /// The same for a regularized law, without a contact problem and without overlap correction.
  /// @throws std::invalid_argument for a size or tolerances out of range
  Simulation(Scalar grain_size, const Materials<Law>& materials, const Tolerances& tolerances = {},
             const Integrator& integrator = Integrator{}) requires(!set_valued)
      : Simulation(grain_size, materials, tolerances, Parts(integrator)) {}
  /// The same with the arguments of a set-valued law: Simulation(grain_size, law, {}, tolerances).
  template <std::same_as<Tolerances> T>
  Simulation(Scalar grain_size, const Materials<Law>& materials, const Solver&, const T& tolerances,
             const Integrator& integrator = Integrator{}) requires(!set_valued)
      : Simulation(grain_size, materials, tolerances, integrator) {}
  /// Refused in one sentence: the friction is an argument of the law.
  template <std::floating_point Number>
  Simulation(Scalar, Number, const auto&...)
      : Simulation(detail::refuse_number<Simulation, Number>()) {}

  Simulation(const Simulation&);  ///< a copy with the same state; it shares the team
  Simulation(Simulation&&);       ///< moves the state; the source may only be assigned to
  Simulation& operator=(const Simulation&);  ///< as the copy
  Simulation& operator=(Simulation&&);       ///< as the move
  ~Simulation();                             ///< the team stays with those who share it

  /// Adds a shape that grains can share; it is copied. It stays, also if no grain has it any more.
  ShapeId add_shape(const ShapeT& shape);

  /// Adds a grain at rest, before the first step or between two steps.
  /// @param shape    an id that add_shape() returned
  /// @param pose     of the shape's frame in the world [m]; its origin is the centre of mass
  /// @param density  [kg/m^3], in the plane [kg/m^2], > 0
  /// @param material of its surface
  /// @returns its id; bodies, grains and walls, are numbered in the order in which they are added,
  ///          except that a new body takes the lowest index that a removed grain has left
  /// @throws std::invalid_argument for an unknown shape or material, a pose that is not finite or
  ///         whose rotation is not of unit length, a density that is not finite or not positive, a
  ///         mass or an inertia that the scalar cannot hold, a shape whose centre of mass is farther
  ///         from its origin than 1e-3 of the grain size, a grain too wide for a periodic cell
  BodyId add_grain(ShapeId shape, const Pose<S>& pose, Scalar density,
                   MaterialId material = MaterialId(0));
  /// Removes a grain, with its contacts of the last step. Its id is refused from now on. All other ids
  /// stay valid. The other grains keep their contacts with the impulses and the memory of the laws.
  /// The measures of the last step no longer include the grain.
  /// @throws std::invalid_argument for a body that is not a grain of this simulation
  void remove_grain(BodyId grain) { remove(std::span(&grain, 1), "Simulation::remove_grain"); }
  /// Removes grains as remove_grain() does. One call for many takes about as long as for one.
  /// @throws std::invalid_argument for a body that is no grain or is listed twice; none is removed then
  void remove_grains(std::span<const BodyId> grains) {
    if (!grains.empty()) remove(grains, "Simulation::remove_grains");
  }

  /// Adds a half-space as a wall: fixed, or moving with set_velocity() and set_spin(). A spin turns it
  /// about `point`: a spin along the normal drags grains around the point, any other tilts the plane.
  /// @param normal   unit vector out of the solid, towards the grains, world axes
  /// @param point    any point of its plane, in the plane of its line, world axes [m]
  /// @param material of its surface
  /// @returns its id
  /// @throws std::invalid_argument for a normal that is not unit within 1e-5, a point that is not
  ///         finite, an unknown material, a wall across a periodic axis
  BodyId add_wall(const VectorArgument<S>& normal, const VectorArgument<S>& point,
                  MaterialId material = MaterialId(0));
  /// Adds the inside of an infinite cylinder (in the plane, of a circle) as a wall around grains:
  /// fixed, or moving with set_velocity() and set_spin(cylinder, rate * axis). walls() does not contain
  /// it and it cannot have a mass. Laws with an effective radius treat it as flat.
  /// @param point    any point of its axis, world axes [m]
  /// @param axis     unit vector of the axis, world axes; in the plane the number 1 or -1
  /// @param radius   [m], > 0
  /// @param material of its surface
  /// @returns its id
  /// @throws std::invalid_argument for a point that is not finite, an axis that is not unit within
  ///         1e-5, a radius that is not finite or not positive, an unknown material, a cylinder
  ///         that bounds a periodic axis
  BodyId add_cylinder(const VectorArgument<S>& point, const AngularArgument<S>& axis, Scalar radius,
                      MaterialId material = MaterialId(0));

  /// Adds a wall of triangles [m], in the plane of segments, in the frame `pose`: fixed, or moving with
  /// set_velocity() and set_spin(). mesh_walls() lists it.
  /// @throws std::invalid_argument for a faulty mesh, pose or material, or a periodic cell
  BodyId add_mesh_wall(const FacetMesh<S>& mesh, const Pose<S>& pose = {},
                       WallSides sides = WallSides::outside,
                       MaterialId material = MaterialId(0)) requires MeshCollidable<ShapeT> {
    constexpr const char* self = "Simulation::add_mesh_wall";
    assembly_.require_pose(pose, self);
    require(cell().is_open(), self, "cell", "(periodic)", "must be open: walls have no images");
    return add_wall_of(MeshWall<S>(mesh, sides, self), pose, material, self);
  }
  /// Makes an axis periodic. Poses are not wrapped: displacements are differences of positions, and
  /// cell().wrap() gives the place of a point in the cell. Call it again for another axis or other
  /// bounds; infinite bounds open the axis. A change of length moves grains that have left the cell
  /// to other places in it.
  /// @param axis         0 for x, 1 for y, ..
  /// @param lower,upper  bounds of the cell along it [m]; walls must be parallel to the axis
  /// @throws std::invalid_argument for an axis that does not exist, bounds that are not ascending,
  ///         a wall across the axis or with a spin about another one, a mesh wall, a cell not
  ///         longer than two of the widest grain with margin and skins: a pair could touch through two images, or a
  ///         bond across an axis that is opened or gets another length. The simulation is then unchanged
  void set_periodic(int axis, Scalar lower, Scalar upper);
  /// Makes the world periodic along D vectors, with a cell that can deform (control_cell()). Poses are not
  /// wrapped. Walls, cylinders and meshes do not fit into it. An oblique cell, as after a large shear, gets other
  /// vectors of the same lattice: read cell().vectors() again after this call and after each step.
  /// @param vectors of the cell as columns, world axes [m]; with a positive determinant
  /// @param lower   corner of the cell, world axes [m]; it stays where it is
  /// @throws std::invalid_argument for vectors that are not finite or without volume, a simulation with walls, a cell whose
  ///         height is not more than two of the widest grain with margin and skins (core/periodic_cell.hpp), or a bond
  ///         across vectors that change
  void set_cell(const Matrix& vectors,
                const VectorArgument<S>& lower = Vector(Vector::Zero())) requires
      SetValuedLaw<Law, SpaceOf<ShapeT>>;
  /// Sets how the cell of set_cell() deforms, from the next step on. From then on velocities of bodies are relative
  /// to the cell: velocity(body) + cell_motion().rate() (x - corner) is that in the world. No velocity changes by the call.
  /// step() throws std::invalid_argument if the cell becomes too small for the grains.
  /// @throws std::invalid_argument without such a cell, for numbers that are not finite, a mass or damping < 0, a stress
  ///         of a component without a mass, or one that pulls an axis (< 0) under a law without attraction
  void control_cell(const CellControl<S>& control) requires SetValuedLaw<Law, SpaceOf<ShapeT>>;
  const CellMotion<S>& cell_motion() const { return cell_motion_; }  ///< of the cell of set_cell()
  const PeriodicCell<S>& cell() const { return detector_.cell(); }   ///< open unless set

  /// Sets the pose of a body, world axes [m]; its velocity does not change. See allow_overlaps().
  /// @throws std::invalid_argument for a body that is not of this simulation, a pose that is not finite
  ///         or whose rotation is not of unit length, or a wall across a periodic axis
  void set_pose(BodyId body, const Pose<S>& pose) {
    constexpr const char* self = "Simulation::set_pose";
    assembly_.require_body(body, self);
    assembly_.require_pose(pose, self);
    assembly_.require_walls_fit(cell(), body, pose, self);
    assembly_.bodies().pose[body.index()] = pose;
    assembly_.note_placed(body.index());
  }
  /// Sets the angular velocity, world axes [rad/s]: a vector in space; in the plane a number, > 0
  /// from x to y. A body without inertia, such as a wall, and one whose motion is prescribed keep it.
  /// @throws std::invalid_argument for a body that is not of this simulation, a spin that is not finite, or
  ///         the spin of a half-space or a cylinder about another axis than the only periodic one
  void set_spin(BodyId body, const AngularArgument<S>& spin) {
    constexpr const char* self = "Simulation::set_spin";
    assembly_.require_body(body, self, "spin", spin);
    assembly_.require_walls_stay(cell(), body, spin, self);
    angular<S>(assembly_.bodies().velocity[body.index()]) = spin;
    this->note_speed_of(body);
  }
  /// Sets the acceleration of gravity on grains, world axes [m/s^2]; zero at first. It must be finite.
  void set_gravity(const VectorArgument<S>& gravity) {
    require(all_finite(gravity), "Simulation::set_gravity", "gravity", gravity, "must be finite");
    gravity_ = gravity;
  }
  /// Sets the threads that share the work of a step; at first, the calling thread alone. Results have
  /// the same bits for every team. Snapshots do not contain it; a copy shares it.
  void set_team(const Team& team) {
    team_ = team;
    detector_.set_team(team);
    if constexpr (set_valued) dynamics_.set_team(team);
  }
  /// Sets the solver from the next step on.
  void set_solver(const Solver& solver) requires set_valued { dynamics_.set_solver(solver); }
  /// Sets the integrator from the next step on.
  void set_integrator(const Integrator& integrator) { dynamics_.set_integrator(integrator); }
  /// Sets how overlaps are corrected, from the next step on.
  /// @throws std::invalid_argument for options out of range; see OverlapCorrection
  void set_correction(const OverlapCorrectionOptions& options) requires set_valued {
    dynamics_.set_correction(options);
  }
  /// Sets which points of a contact between faces are used, from the next step on.
  void set_contact_points(ContactPoints points) { detector_.keep_points(points); }
  ContactPoints contact_points() const { return detector_.kept_points(); }  ///< all unless set
  /// Sets the laws from the next step on; another number of materials throws.
  void set_materials(const Materials<Law>& materials);

  /// Bonds all pairs of bodies whose gap is at most `gap` [m] now and that have no bond yet, at the middle of their
  /// contact points. The laws of their materials have the strengths.
  /// @returns how many bonds were made; check() says if there is none
  /// @throws std::invalid_argument for a gap that is negative, not finite or above the margin, or a deep overlap of a
  ///         body that was placed since the last step, see allow_overlaps()
  std::size_t bond_touching(Scalar gap) requires BondingLaw<Law, SpaceOf<ShapeT>>;
  /// The same for pairs of which both bodies are in `among`; an empty list makes no bond.
  /// @param fewest_points pairs with fewer contact points within the margin are not bonded. With S::dim polytopes are
  ///                      bonded at a common face, not where they touch at an edge or a corner alone
  /// @throws std::invalid_argument as the function for all bodies, or for a body that is not of this simulation
  std::size_t bond_touching(Scalar gap, std::span<const BodyId> among,
                            std::size_t fewest_points = 1) requires
      BondingLaw<Law, SpaceOf<ShapeT>>;
  /// Bonds two bodies at the middle of their contact points, unless they have a bond.
  /// @throws std::invalid_argument for a body that is not of this simulation, or bodies farther apart than the margin,
  ///         or that both have a prescribed motion, or a deep overlap as in bond_touching()
  void bond(BodyId a, BodyId b) requires BondingLaw<Law, SpaceOf<ShapeT>>;
  /// Bonds each of these pairs, with one detection of all contacts.
  /// @returns how many bonds were made: pairs that have one keep it
  /// @throws std::invalid_argument as the function for one pair; no bond is made then
  std::size_t bond(std::span<const std::pair<BodyId, BodyId>> pairs) requires
      BondingLaw<Law, SpaceOf<ShapeT>>;
  /// The smallest gap of two bodies without a bond in the last call of bond_touching() [m], if there is no bond because
  /// this call made none, without the pairs of missed_points(); infinite if no other pair was within the margin;
  /// otherwise < 0. Snapshots do not contain it.
  Scalar missed_gap() const requires BondingLaw<Law, SpaceOf<ShapeT>> {
    return dynamics_.bonds().missed_gap();
  }
  /// The most contact points of a pair within the gap that had fewer than `fewest_points` in the last call of
  /// bond_touching(), if there is no bond because this call made none; otherwise 0. Snapshots do not contain it.
  std::size_t missed_points() const requires BondingLaw<Law, SpaceOf<ShapeT>> {
    return dynamics_.bonds().missed_points();
  }
  /// All bonds, sorted by their bodies. The span is valid until bonds are made or break.
  std::span<const Bond<S>> bonds() const requires BondingLaw<Law, SpaceOf<ShapeT>> {
    return dynamics_.bonds().bonds();
  }
  /// All bonds that broke, in the order of time.
  std::span<const Breakage> breakages() const requires BondingLaw<Law, SpaceOf<ShapeT>> {
    return dynamics_.bonds().breakages();
  }

  /// Refused in one sentence: under a law without bonds nothing can be bonded.
  template <class L = Law>
  requires(!BondingLaw<L, S>) std::size_t bond_touching(const auto&...)
  const { return detail::refuse_bonds<L, S>(); }
  /// Refused in the same way.
  template <class L = Law>
  requires(!BondingLaw<L, S>) void bond(const auto&...) const { detail::refuse_bonds<L, S>(); }
  /// Refused in one sentence: the shape has no contacts with triangles.
  template <class Shape = ShapeT>
  requires(!MeshCollidable<Shape>) BodyId add_mesh_wall(const auto&...)
  const { return detail::refuse_mesh_wall<Shape>(); }
  /// Refused in one sentence: a cell that deforms needs a law for impulses.
  template <class L = Law>
  requires(!SetValuedLaw<L, S>) void set_cell(const auto&...) const { detail::refuse_cell<L, S>(); }
  /// Refused in the same way.
  template <class L = Law>
  requires(!SetValuedLaw<L, S>) void control_cell(const auto&...) const {
    detail::refuse_cell<L, S>();
  }

  /// Advances the time by `step` [s], > 0.
  /// @returns results of the step, and how well the contact problem was solved
  /// @throws std::invalid_argument for a step that is not positive or not finite, a cell whose rate x step is 1 or more, or
  ///         a deep overlap of a body that was placed since the last step, see allow_overlaps(); nothing has moved then
  /// @throws std::invalid_argument if a cell that deforms has become too small for the grains
  /// @throws std::runtime_error naming a body with a velocity or position that is not finite. In these two
  ///         cases the step is half made: continue from a snapshot
  MOREAU_COMPILED_ONCE StepReport step(Scalar step);

  double time() const { return time_; }  ///< sum of the steps [s]
  /// Checks that a step by which impulses are divided is in the unit of the last step, not in ms: forces would be a
  /// thousandth. Factors up to 100 pass, because a program may change its step. Any step passes before the first step()
  /// and after a snapshot was read.
  /// @param function name of the calling function, for the error message
  /// @throws std::invalid_argument in the name of the function
  void require_unit_of_step(Scalar step, const char* function) const {
    require(!(last_step_ > 0) || (step <= 100 * last_step_ && last_step_ <= 100 * step), function,
            "step / last step", step / last_step_,
            "must be near 1: a step in seconds, as that of Simulation::step()");
  }
  /// Length of the last step [s], by which impulses are divided to obtain forces; 0 before the first step and after the
  /// simulation was read from a snapshot.
  Scalar last_step() const { return last_step_; }
  Scalar grain_size() const { return grain_size_; }  ///< length that tolerances are relative to [m]
  const Tolerances& tolerances() const { return tolerances_; }  ///< of detection
  /// Contacts of the last step with their impulses [N s]; for a regularized law, force x step.
  const ContactsOf<Law, S>& contacts() const { return contacts_; }
  const Materials<Law>& materials() const { return materials_; }  ///< of all pairs
  /// The overlap correction, with the shifts of the last step.
  const OverlapCorrection<S>& correction() const requires set_valued {
    return dynamics_.correction();
  }
  const Value<Vector> gravity() const { return gravity_; }  ///< world axes [m/s^2]

  /// Sum of the impulses that a body received from its contacts in the last step, attraction
  /// included, world axes [N s]. Two bodies of prescribed motion have no contact. A call looks at all contacts: for many
  /// bodies, add up contacts() in one pass.
  /// @throws std::invalid_argument for a body that is not of this simulation
  const Value<Vector> contact_impulse(BodyId body) const {
    assembly_.require_body(body, "Simulation::contact_impulse");
    return contacts_.impulse_on(body.value);
  }
  /// The contact problem that the last step solved, one row per contact of contacts(), for gather_problem()
  /// and for solvers of one's own. It still has the contacts of grains that were removed since.
  const ContactProblem<OperatorOf<Law, S>, Law>& contact_problem() const requires set_valued {
    return dynamics_.problem();
  }

 private:
  using Clock = std::chrono::steady_clock;
  using Dynamics =
      std::conditional_t<set_valued, detail::ImpulseDynamics<S, Law, Integrator, Solver>,
                         detail::ForceDynamics<S, Law, Integrator>>;
  /// The parts of dynamics_.
  using Parts =
      std::conditional_t<set_valued, std::tuple<Solver, OverlapCorrectionOptions, Integrator>,
                         std::tuple<Integrator>>;
  Simulation(Scalar grain_size, const Materials<Law>& materials, const Tolerances& tolerances,
             const Parts& parts);

  BodyId add_wall_of(const auto& shape, const Pose<S>& pose, MaterialId material,
                     const char* function) {
    const BodyId body = assembly_.add_body(pose, material, materials_.count(), function);
    assembly_.set_wall(body, shape), detector_.add_wall(body, shape);
    return body;
  }
  friend struct SerializationAccess;
  friend struct detail::StateAccess;
  auto serialized_members() {
    return std::tie(grain_size_, tolerances_, materials_, dynamics_, gravity_, time_, assembly_,
                    contacts_, detector_, attempts_, cell_motion_);
  }
  void deserialized() {
    reach_ = detail::reach_of<S>(materials_);
    last_step_ = 0;
    const std::size_t laws = materials_.laws().size(), variants = variants_of<Law, S>();
    require(assembly_.is_valid(materials_.count()) &&
                contacts_.are_valid(bodies().size(), laws, variants),
            "Simulation", "bodies", bodies().size(), "must be those of contacts and materials");
    if constexpr (bonding)
      require(dynamics_.bonds().are_valid(bodies()), "Simulation", "bonds", bonds().size(),
              "must be of bodies that exist");
    require(dynamics_.is_valid(contacts_.size(), bodies().size()), "Simulation", "contacts",
            contacts_.size(), "must be as many as the laws have memories");
    detector_.rebuild([&] { assembly_.add_to(detector_); });
  }

  void remove(std::span<const BodyId> grains, const char* function);

  Scalar reach() const { return reach_; }  ///< reach_of() of the materials [m]
  /// Lengths of detection: bridges act beyond the margin.
  DetectionLengths<Scalar> lengths() const {
    DetectionLengths<Scalar> lengths = tolerances_.lengths(grain_size_);
    lengths.margin = std::max(lengths.margin, reach());
    return lengths;
  }

  /// The two functions bond_touching(): bonds pairs of which is_listed(index) is true for both bodies.
  std::size_t bond_near(Scalar gap, const auto& is_listed, std::size_t fewest_points);
  /// Bonds the pairs for which keeps(contact points in the present configuration) is true.
  std::size_t add_bonds(const char* function, const auto& keeps);

  /// Detects the contacts at the predicted configuration and assigns their laws.
  /// @param report out: results and times of detection
  /// @param clock  started before the prediction
  void detect(StepReport& report, Scalar step, StepReport::StageClock clock = {});
  void count_contacts(StepReport& report) const {
    report.pairs = detector_.touching_count();
    if constexpr (bonding) report.pairs += dynamics_.bonds().undetected();
    report.points = contacts_.size();
    report.measure_overlaps(contacts_);
  }
  /// Whether pairs have margins by their motion in the step (detail/step_margins.hpp). The pairs of a
  /// process among several are not all pairs of its bodies.
  bool narrows_margins() const {
    if constexpr (ActsWhereGapsClose<Law>)
      return tolerances_.narrows && !dynamics_.shares_bodies() && !cell_motion_.is_active();
    else
      return false;
  }
  /// After the contact problem was solved: detects the contacts again, up to the whole margin, if a pair
  /// approaches by more than its margin.
  /// @returns whether it did
  bool detect_again(StepReport& report, const detail::StepContext<S, Law>& context) requires
      SetValuedLaw<Law, SpaceOf<ShapeT>>;

  Scalar grain_size_;
  Tolerances tolerances_;
  Materials<Law> materials_;
  Scalar reach_ = 0;
  Scalar last_step_ = 0;
  Dynamics dynamics_;
  Vector gravity_ = Vector::Zero();
  double time_ = 0;
  using BodyControl<ShapeT>::assembly_;
  ContactDetector<ShapeT, Broad> detector_;
  ContactsOf<Law, S> contacts_, previous_;
  [[no_unique_address]] std::conditional_t<BridgingLaw<Law, S>, detail::Bridges<S, Law>,
                                           detail::NoBridges>
      bridges_;
  detail::ChordVelocities<ShapeT> chords_;
  detail::MarginAttempts attempts_;
  CellMotion<S> cell_motion_;  // of a periodic cell that can deform
  Team team_;
  List<unsigned char> lost_;  // one per contact: whether remove() removes it
};

}  // namespace moreau

// Functions that are not in the class are not inline: a program can instantiate them in one source and declare them
// extern (moreau/instances). A function in the class is inline, and is compiled in each unit that uses it.
#include "moreau/world/detail/add_bodies.hpp"
#include "moreau/world/detail/bonds/make_bonds.hpp"
#include "moreau/world/detail/cell/set_cell.hpp"
#include "moreau/world/detail/make_simulation.hpp"
#include "moreau/world/detail/simulation_step.hpp"
