// SPDX-License-Identifier: MIT
// World for one type of simulation.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "moreau/boundary/drive.hpp"
#include "moreau/boundary/servo.hpp"
#include "moreau/io/snapshot.hpp"
#include "moreau/io/write_paraview.hpp"
#include "moreau/measure/check.hpp"
#include "moreau/measure/energy.hpp"
#include "moreau/measure/solid_fraction.hpp"
#include "moreau/measure/stress.hpp"
#include "moreau/parallel/thread_team.hpp"

#include "engine.hpp"
#ifndef MOREAU_WITHOUT_PNG
#include "moreau/picture/write_picture.hpp"
#endif

#include "world.hpp"

namespace moreau_python {

/// The law with these settings.
template <class Law>
Law make_law(const LawSettings& s);
template <>
inline Coulomb make_law(const LawSettings& s) {
  return Coulomb(s.friction, s.restitution, s.static_friction);
}
template <>
inline Rolling make_law(const LawSettings& s) {
  return Rolling(s.friction, s.rolling, s.restitution);
}
template <>
inline Compliant make_law(const LawSettings& s) {
  return Compliant(make_law<Coulomb>(s), s.stiffness, s.tangential_stiffness);
}

/// A vector of numbers from Python as one of the space.
/// @throws std::invalid_argument for a wrong number of components
template <class Vector>
Vector vector_of(Numbers numbers, const char* function, const char* argument) {
  moreau::require(numbers.size() == std::size_t(Vector::SizeAtCompileTime), function, argument,
                  numbers.size(),
                  "components, must have " + std::to_string(Vector::SizeAtCompileTime));
  return Eigen::Map<const Vector>(numbers.data());
}
template <class Matrix>
std::vector<double> numbers_of(const Matrix& m) {
  std::vector<double> out;
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index k = 0; k < m.cols(); ++k) out.push_back(m(i, k));
  return out;
}

/// The numbers of a rotation: x, y, z, w, in the plane the angle.
inline double* rotation_data(Eigen::Quaterniond& q) {
  return q.coeffs().data();
}
inline double* rotation_data(Eigen::Rotation2Dd& q) {
  return &q.angle();
}
template <class S>
constexpr std::size_t rotation_size = S::dim == 2 ? 1 : 4;
template <class S>
typename S::Rotation rotation_of(const Rows& rows, std::size_t i) {
  typename S::Rotation q = S::identity();
  for (std::size_t k = 0; k < rotation_size<S>; ++k) rotation_data(q)[k] = rows(i, k);
  return q;
}

inline moreau::BodyId body_of(Id id) {
  moreau::BodyId body;  // a negative number is no body
  if (id < 0) return body;
  body.value = static_cast<std::uint32_t>(id & 0xFFFFFFFF);
  body.generation = static_cast<std::uint32_t>(id >> 32);
  return body;
}
inline Id id_of(moreau::BodyId body) {
  return Id(body.value) | Id(body.generation) << 32;
}

template <class ShapeT, class LawT>
class Instance final : public World {
 public:
  using Simulation = moreau::Simulation<ShapeT, LawT>;
  using S = typename Simulation::S;
  using Vector = typename S::Vector;
  using Angular = typename S::Angular;

  explicit Instance(const Settings& s)
      : laws_(s.materials, make_law<LawT>(s.law)),
        simulation_(s.grain_size, laws_, moreau::ColouredGaussSeidel(s.solver), s.tolerances) {}

  int dim() const override { return S::dim; }
  bool is_set_valued_rigid() const override { return !moreau::CompliantLaw<LawT, S>; }

  std::size_t add_shape(const AnyShape& shape) override {
    const ShapeT* own = std::get_if<ShapeT>(&shape);
    moreau::require(own != nullptr, "Simulation::add_shape", "shape", "(another kind)",
                    "must be of the kind of the simulation");
    shapes_ = simulation_.add_shape(*own).index() + 1;
    return shapes_ - 1;
  }
  AnyShape shape(Id grain) const override { return simulation_.shape(body_of(grain)); }

  std::vector<Id> add_grains(std::span<const std::int64_t> shapes, const Rows& positions,
                             const Rows& rotations, Numbers densities,
                             std::span<const std::int64_t> materials) override;
  void remove_grains(std::span<const Id> grains) override {
    std::vector<moreau::BodyId> bodies;
    for (const Id grain : grains) bodies.push_back(body_of(grain));
    simulation_.remove_grains(bodies);
  }
  Id add_wall(Numbers normal, Numbers point, std::size_t material) override {
    constexpr const char* self = "Simulation::add_wall";
    return id_of(simulation_.add_wall(vector_of<Vector>(normal, self, "normal"),
                                      vector_of<Vector>(point, self, "point"),
                                      moreau::MaterialId(material)));
  }
  Id add_cylinder(Numbers point, Numbers axis, double radius, std::size_t material) override {
    constexpr const char* self = "Simulation::add_cylinder";
    return id_of(simulation_.add_cylinder(vector_of<Vector>(point, self, "point"),
                                          vector_of<Angular>(axis, self, "axis"), radius,
                                          moreau::MaterialId(material)));
  }
  Id add_mesh_wall(const Rows& vertices, std::span<const std::int64_t> facets, bool both_sides,
                   std::size_t material) override;
  void set_periodic(int axis, double lower, double upper) override {
    simulation_.set_periodic(axis, lower, upper);
  }
  std::pair<std::vector<double>, std::vector<double>> cell() const override {
    return {numbers_of(simulation_.cell().lower()), numbers_of(simulation_.cell().length())};
  }
  std::vector<double> wrap(const Rows& points) const override {
    std::vector<double> out;
    for (std::size_t i = 0; i < points.rows; ++i) {
      Vector x;
      for (int k = 0; k < S::dim; ++k) x[k] = points(i, std::size_t(k));
      const Vector y = simulation_.cell().wrap(x);
      out.insert(out.end(), y.data(), y.data() + S::dim);
    }
    return out;
  }

  std::vector<Id> grains() const override { return ids_of(simulation_.grains()); }
  std::vector<Id> walls() const override { return ids_of(simulation_.walls()); }
  std::size_t body_count() const override { return simulation_.bodies().size(); }
  bool contains(Id body) const override { return simulation_.contains(body_of(body)); }
  bool is_prescribed(Id body) const override { return simulation_.is_prescribed(body_of(body)); }
  Rows rows(Quantity quantity) const override;

  void set_pose(Id body, Numbers position, Numbers rotation) override {
    constexpr const char* self = "Simulation::set_pose";
    moreau::Pose<S> pose = simulation_.pose(body_of(body));
    pose.position = vector_of<Vector>(position, self, "position");
    if (!rotation.empty()) {
      moreau::require(rotation.size() == rotation_size<S>, self, "rotation", rotation.size(),
                      "numbers, must have " + std::to_string(rotation_size<S>));
      pose.rotation = rotation_of<S>({rotation.data(), 1, rotation.size(), 0}, 0);
    }
    simulation_.set_pose(body_of(body), pose);
  }
  void set_vector(Id body, Quantity quantity, Numbers value) override;
  void set_wall_mass(Id wall, double mass) override {
    simulation_.set_wall_mass(body_of(wall), mass);
  }
  void prescribe_motion(Id grain) override { simulation_.prescribe_motion(body_of(grain)); }
  void release(Id grain) override { simulation_.release(body_of(grain)); }
  void drive(Id body, Numbers direction, double value, bool is_force, double step) override {
    const auto f = [value](double) { return value; };
    const Vector along = vector_of<Vector>(direction, "Simulation::drive", "direction");
    if (is_force)
      moreau::ForceDrive(body_of(body), along, f).apply(simulation_, step);
    else
      moreau::VelocityDrive(body_of(body), along, f).apply(simulation_, step);
  }
  void set_gravity(Numbers gravity) override {
    simulation_.set_gravity(vector_of<Vector>(gravity, "Simulation::set_gravity", "gravity"));
  }
  std::vector<double> gravity() const override { return numbers_of(simulation_.gravity()); }
  void allow_overlaps(bool allow) override { simulation_.allow_overlaps(allow); }
  void set_threads(int threads) override { simulation_.set_team(moreau::ThreadTeam(threads)); }
  void set_solver(const moreau::ColouredOptions& options) override {
    simulation_.set_solver(moreau::ColouredGaussSeidel(options));
  }
  void set_theta(double theta) override { simulation_.set_integrator(moreau::MoreauJean(theta)); }
  void set_correction(const moreau::OverlapCorrectionOptions& options) override {
    simulation_.set_correction(options);
  }
  void set_contact_points(bool few) override {
    simulation_.set_contact_points(few ? moreau::ContactPoints::few : moreau::ContactPoints::all);
  }
  void set_law(std::size_t a, std::size_t b, const LawSettings& law) override {
    laws_.set(moreau::MaterialId(a), moreau::MaterialId(b), make_law<LawT>(law));
    simulation_.set_materials(laws_);
  }

  moreau::StepReport step(double step) override { return simulation_.step(step); }
  double time() const override { return simulation_.time(); }
  double grain_size() const override { return simulation_.grain_size(); }

  ContactArrays contacts() const override;
  std::vector<double> contact_impulse(Id body) const override {
    return numbers_of(simulation_.contact_impulse(body_of(body)));
  }
  moreau::Coordination coordination(std::size_t fewest) const override {
    return moreau::coordination(simulation_, fewest);
  }
  double solid_fraction(Numbers lower, Numbers upper) const override {
    return moreau::solid_fraction(simulation_, box_of(lower, upper, "Simulation::solid_fraction"));
  }
  Kinetic kinetic_energy() const override {
    const auto energy = moreau::kinetic_energy(simulation_);
    return {energy.translation, energy.rotation};
  }
  std::vector<double> stress(double step, Numbers lower, Numbers upper) const override {
    return numbers_of(
        moreau::contact_stress(simulation_, step, box_of(lower, upper, "Simulation::stress")));
  }
  double wall_pressure(Id wall, double step, double area) override {
    return moreau::wall_pressure(simulation_, body_of(wall), step, area);
  }
  std::vector<std::string> check(const moreau::StepReport& report) const override {
    return moreau::check(simulation_, report);
  }

  void write_snapshot(const std::string& path) const override {
    moreau::write_snapshot(path, simulation_);
  }
  void read_snapshot(const std::string& path) override {
    moreau::reload_snapshot(path, simulation_);
    laws_ = simulation_.materials();
    count_shapes();
  }
  std::string snapshot() const override { return moreau::snapshot(simulation_); }
  void write_paraview(const std::string& path, double step) const override {
    moreau::write_paraview(path, simulation_, step);
  }
  void write_picture(const std::string& path, const PictureSettings& picture) const override;

 private:
  static moreau::Aabb<S> box_of(Numbers lower, Numbers upper, const char* function) {
    return {vector_of<Vector>(lower, function, "lower"),
            vector_of<Vector>(upper, function, "upper")};
  }
  static std::vector<Id> ids_of(std::span<const moreau::BodyId> bodies) {
    std::vector<Id> ids;
    ids.reserve(bodies.size());
    for (const moreau::BodyId body : bodies) ids.push_back(id_of(body));
    return ids;
  }
  /// Finds the number of shapes of a simulation that was read.
  void count_shapes() {
    for (shapes_ = 0;; ++shapes_) {
      try {
        (void)simulation_.shape(moreau::ShapeId(shapes_));
      } catch (const std::invalid_argument&) {
        return;
      }
    }
  }
  void require_grains(std::span<const std::int64_t> shapes, const Rows& positions,
                      const Rows& rotations, Numbers densities,
                      std::span<const std::int64_t> materials) const;

  moreau::Materials<LawT> laws_;
  Simulation simulation_;
  std::size_t shapes_ = 0;
};

/// Checks all grains before the first is added; messages name the element.
template <class ShapeT, class LawT>
void Instance<ShapeT, LawT>::require_grains(std::span<const std::int64_t> shapes,
                                            const Rows& positions, const Rows& rotations,
                                            Numbers densities,
                                            std::span<const std::int64_t> materials) const {
  constexpr const char* self = "Simulation::add_grains";
  const auto at = [](const char* name, std::size_t i) {
    return name + ("[" + std::to_string(i) + "]");
  };
  const std::size_t n = positions.rows;
  moreau::require(positions.columns == std::size_t(S::dim) && shapes.size() == n &&
                      rotations.rows == n && rotations.columns == rotation_size<S> &&
                      densities.size() == n && materials.size() == n,
                  self, "positions", n, "rows, must fit all other arrays");
  for (std::size_t i = 0; i < n; ++i) {
    Vector x;
    for (int k = 0; k < S::dim; ++k) x[k] = positions(i, std::size_t(k));
    moreau::require(x.allFinite(), self, at("positions", i), x, "must be finite");
    Eigen::Matrix<double, int(rotation_size<S>), 1> q;
    for (std::size_t k = 0; k < rotation_size<S>; ++k) q[Eigen::Index(k)] = rotations(i, k);
    moreau::require(S::is_rotation(rotation_of<S>(rotations, i)), self, at("rotations", i), q,
                    S::dim == 2 ? "must be finite" : "must be a quaternion of length 1");
    moreau::require(shapes[i] >= 0 && std::size_t(shapes[i]) < shapes_, self, at("shapes", i),
                    shapes[i], "must be an id that add_shape returned");
    moreau::require(std::isfinite(densities[i]) && densities[i] > 0, self, at("density", i),
                    densities[i], "must be finite and > 0");
    moreau::require(materials[i] >= 0 && std::size_t(materials[i]) < laws_.count(), self,
                    at("material", i), materials[i], "must be below the number of materials");
  }
}

template <class ShapeT, class LawT>
std::vector<Id> Instance<ShapeT, LawT>::add_grains(std::span<const std::int64_t> shapes,
                                                   const Rows& positions, const Rows& rotations,
                                                   Numbers densities,
                                                   std::span<const std::int64_t> materials) {
  require_grains(shapes, positions, rotations, densities, materials);
  std::vector<moreau::BodyId> added;
  try {
    for (std::size_t i = 0; i < positions.rows; ++i) {
      moreau::Pose<S> pose;
      for (int k = 0; k < S::dim; ++k) pose.position[k] = positions(i, std::size_t(k));
      pose.rotation = rotation_of<S>(rotations, i);
      added.push_back(simulation_.add_grain(moreau::ShapeId(std::size_t(shapes[i])), pose,
                                            densities[i],
                                            moreau::MaterialId(std::size_t(materials[i]))));
    }
  } catch (...) {  // of the mass or the room in a periodic cell
    simulation_.remove_grains(added);
    throw;
  }
  return ids_of(added);
}

template <class ShapeT, class LawT>
Id Instance<ShapeT, LawT>::add_mesh_wall(const Rows& vertices, std::span<const std::int64_t> facets,
                                         bool both_sides, std::size_t material) {
  constexpr const char* self = "Simulation::add_mesh_wall";
  constexpr auto corners = std::size_t(S::dim);
  moreau::FacetMesh<S> mesh;
  for (std::size_t i = 0; i < vertices.rows; ++i) {
    mesh.vertices.push_back(Vector::Zero());
    for (std::size_t k = 0; k < corners; ++k)
      mesh.vertices.back()[Eigen::Index(k)] = vertices(i, k);
  }
  for (std::size_t i = 0; i < facets.size(); ++i) {
    moreau::require(facets[i] >= 0 && std::size_t(facets[i]) < vertices.rows, self,
                    "facets[" + std::to_string(i / corners) + "]", facets[i],
                    "must be the row of a vertex");
    if (i % corners == 0) mesh.facets.emplace_back();
    mesh.facets.back()[i % corners] = static_cast<std::uint32_t>(facets[i]);
  }
  return id_of(simulation_.add_mesh_wall(
      mesh, {}, both_sides ? moreau::WallSides::both : moreau::WallSides::outside,
      moreau::MaterialId(material)));
}

template <class ShapeT, class LawT>
Rows Instance<ShapeT, LawT>::rows(Quantity quantity) const {
  const auto& b = simulation_.bodies();
  const std::size_t n = b.size();
  constexpr auto dim = std::size_t(S::dim), angular = std::size_t(S::angular_dim);
  const auto of = [n](const double* first, std::size_t columns, std::size_t size) {
    return Rows{first, n, columns, std::ptrdiff_t(size)};
  };
  using Twist = typename S::Twist;
  static moreau::Pose<S> no_pose;  // where the arrays of a simulation without bodies begin
  static const Twist no_twist = Twist::Zero();
  auto& pose = n > 0 ? const_cast<moreau::Pose<S>&>(b.pose[0]) : no_pose;  // only read here
  const Twist& velocity = n > 0 ? b.velocity[0] : no_twist;
  const Twist& force = n > 0 ? b.force[0] : no_twist;
  switch (quantity) {
    case Quantity::position:
      return of(pose.position.data(), dim, sizeof pose);
    case Quantity::rotation:
      return of(rotation_data(pose.rotation), rotation_size<S>, sizeof pose);
    case Quantity::velocity:
      return of(velocity.data(), dim, sizeof(Twist));
    case Quantity::spin:
      return of(velocity.data() + dim, angular, sizeof(Twist));
    case Quantity::force:
      return of(force.data(), dim, sizeof(Twist));
    case Quantity::torque:
      return of(force.data() + dim, angular, sizeof(Twist));
    case Quantity::mass:
      break;
  }
  return of(b.grain_mass.data(), 1, sizeof(double));
}

template <class ShapeT, class LawT>
void Instance<ShapeT, LawT>::set_vector(Id id, Quantity quantity, Numbers value) {
  const moreau::BodyId body = body_of(id);
  switch (quantity) {
    case Quantity::velocity:
      return simulation_.set_velocity(
          body, vector_of<Vector>(value, "Simulation::set_velocity", "velocity"));
    case Quantity::spin:
      return simulation_.set_spin(body, vector_of<Angular>(value, "Simulation::set_spin", "spin"));
    case Quantity::force:
      return simulation_.set_force(body,
                                   vector_of<Vector>(value, "Simulation::set_force", "force"));
    case Quantity::torque:
      return simulation_.set_torque(body,
                                    vector_of<Angular>(value, "Simulation::set_torque", "torque"));
    default:
      break;
  }
}

template <class ShapeT, class LawT>
ContactArrays Instance<ShapeT, LawT>::contacts() const {
  const auto& contacts = simulation_.contacts();
  const auto& bodies = simulation_.bodies();
  ContactArrays out;
  const auto append = [](std::vector<double>& to, const auto& vector) {
    to.insert(to.end(), vector.data(), vector.data() + vector.size());
  };
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const moreau::Contact<S>& contact = contacts.points[c];
    out.a.push_back(id_of(bodies.id[contact.a]));
    out.b.push_back(id_of(bodies.id[contact.b]));
    out.gap.push_back(contact.gap);
    append(out.frame, typename S::Matrix(contact.frame.transpose()));  // by rows
    const bool from_a = simulation_.is_grain(contact.a);
    append(out.point, Vector(bodies.pose[from_a ? contact.a : contact.b].position +
                             (from_a ? contact.lever_a : contact.lever_b)));
    append(out.impulse, contacts.impulse(c));
    if constexpr (std::decay_t<decltype(contacts)>::has_couples)
      append(out.couple, contacts.couple(c));
    out.contact_class.push_back(static_cast<std::uint8_t>(contacts.classes[c]));
  }
  return out;
}

template <class ShapeT, class LawT>
void Instance<ShapeT, LawT>::write_picture(const std::string& path,
                                           const PictureSettings& picture) const {
#ifdef MOREAU_WITHOUT_PNG
  (void)path, (void)picture;
  throw std::runtime_error("Simulation::write_picture: the module was built without libpng");
#else
  const moreau::rendering::Picture view{picture.width, picture.height, picture.azimuth,
                                        picture.elevation, picture.walls};
  if (picture.colors.empty()) return moreau::write_picture(path, simulation_, view);
  moreau::require(picture.colors.size() == 3 * simulation_.grain_count(),
                  "Simulation::write_picture", "colors", picture.colors.size(),
                  "numbers, must be three for each grain");
  std::vector<std::size_t> number(simulation_.bodies().size());
  for (std::size_t k = 0; k < simulation_.grain_count(); ++k)
    number[simulation_.grain(k).index()] = k;
  moreau::write_picture(
      path, simulation_,
      [&](moreau::BodyId grain) {
        unsigned screen = 0;
        for (std::size_t c = 0; c < 3; ++c)
          screen = screen << 8 |
                   unsigned(std::lround(
                       255 * std::clamp(picture.colors[3 * number[grain.index()] + c], 0.0, 1.0)));
        return moreau::rendering::screen_color(screen);
      },
      view);
#endif
}

}  // namespace moreau_python
