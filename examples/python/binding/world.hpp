// SPDX-License-Identifier: MIT
// A simulation of any shape and law behind one interface: what the Python module calls. The interface knows
// neither Python nor the types of a simulation. instance.hpp implements it for a Simulation, binding.cpp passes
// it to Python.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "moreau/measure/coordination.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/solve/coloured_gauss_seidel.hpp"
#include "moreau/world/overlap_correction.hpp"
#include "moreau/world/step_report.hpp"
#include "moreau/world/tolerances.hpp"

namespace moreau_python {

/// A body as one number: BodyId::index() + 2^32 BodyId::generation. It is the row of the body in all arrays as
/// long as no grain was removed.
using Id = std::int64_t;
using AnyShape = std::variant<moreau::Polyhedron<double>, moreau::Polygon<double>,
                              moreau::Ball<double>, moreau::Disk<double>>;

/// The parameters of all laws; a law reads its own.
struct LawSettings {
  double friction = 0, restitution = 0, static_friction = 0;  ///< [-]
  double rolling = 0;                                         ///< [-]
  double stiffness = 0, tangential_stiffness = 0;             ///< [N/m]
};

/// What a simulation is made of.
struct Settings {
  double grain_size = 0;  ///< [m]
  std::size_t materials = 1;
  LawSettings law;  ///< of all pairs of materials
  moreau::Tolerances tolerances;
  moreau::ColouredOptions solver;
};

/// Numbers in the memory of the simulation or of a caller: `rows` rows of `columns` numbers.
struct Rows {
  const double* first = nullptr;
  std::size_t rows = 0, columns = 1;
  std::ptrdiff_t stride = 0;  ///< from row to row [bytes]; the numbers of a row are adjacent

  /// Number k of row i.
  double operator()(std::size_t i, std::size_t k) const {
    return reinterpret_cast<const double*>(reinterpret_cast<const char*>(first) +
                                           std::ptrdiff_t(i) * stride)[k];
  }
};

/// A quantity of all bodies, by BodyId::index().
enum class Quantity { position, rotation, velocity, spin, force, torque, mass };

/// A copy of the contacts of the last step, n points in the order of the library; D numbers per vector.
struct ContactArrays {
  std::vector<Id> a, b;     ///< the two bodies
  std::vector<double> gap;  ///< [m]
  std::vector<double>
      frame;  ///< n x D x D, row by row; the columns are the normal and the tangents
  std::vector<double> point;    ///< n x D, from the centre of a, or of b if a is a wall [m]
  std::vector<double> impulse;  ///< n x D, on b, in the frame [N s]
  std::vector<double> couple;   ///< n x A, on b, in the frame [N m s]; empty without rolling
  std::vector<std::uint8_t> contact_class;  ///< ContactClass
};

/// Kinetic energy of the grains [J].
struct Kinetic {
  double translation, rotation;
};

/// A picture, and its colours: 3 numbers per grain in [0, 1], or none for the colours of stone.
struct PictureSettings {
  int width, height;
  double azimuth, elevation;
  bool walls;
  std::vector<double> colors;
};

using Numbers = std::span<const double>;

/// Simulation of moreau. Vectors have D components, angular ones A; the sizes are checked. Functions throw what
/// those of moreau::Simulation do.
class World {
 public:
  virtual ~World() = default;
  virtual int dim() const = 0;
  virtual bool is_set_valued_rigid() const = 0;  ///< whether overlaps may be corrected

  virtual std::size_t add_shape(const AnyShape& shape) = 0;
  virtual AnyShape shape(Id grain) const = 0;
  virtual std::vector<Id> add_grains(std::span<const std::int64_t> shapes, const Rows& positions,
                                     const Rows& rotations, Numbers densities,
                                     std::span<const std::int64_t> materials) = 0;
  virtual void remove_grains(std::span<const Id> grains) = 0;
  virtual Id add_wall(Numbers normal, Numbers point, std::size_t material) = 0;
  virtual Id add_cylinder(Numbers point, Numbers axis, double radius, std::size_t material) = 0;
  virtual Id add_mesh_wall(const Rows& vertices, std::span<const std::int64_t> facets,
                           bool both_sides, std::size_t material) = 0;
  virtual void set_periodic(int axis, double lower, double upper) = 0;
  virtual std::pair<std::vector<double>, std::vector<double>> cell() const = 0;
  virtual std::vector<double> wrap(const Rows& points) const = 0;

  virtual std::vector<Id> grains() const = 0;
  virtual std::vector<Id> walls() const = 0;
  virtual std::size_t body_count() const = 0;
  virtual bool contains(Id body) const = 0;
  virtual bool is_prescribed(Id body) const = 0;
  virtual Rows rows(Quantity quantity) const = 0;

  virtual void set_pose(Id body, Numbers position, Numbers rotation) = 0;
  virtual void set_vector(Id body, Quantity quantity, Numbers value) = 0;
  virtual void set_wall_mass(Id wall, double mass) = 0;
  virtual void prescribe_motion(Id grain) = 0;
  virtual void release(Id grain) = 0;
  virtual void drive(Id body, Numbers direction, double value, bool is_force, double step) = 0;
  virtual void set_gravity(Numbers gravity) = 0;
  virtual std::vector<double> gravity() const = 0;
  virtual void allow_overlaps(bool allow) = 0;
  virtual void set_threads(int threads) = 0;
  virtual void set_solver(const moreau::ColouredOptions& options) = 0;
  virtual void set_theta(double theta) = 0;
  virtual void set_correction(const moreau::OverlapCorrectionOptions& options) = 0;
  virtual void set_contact_points(bool few) = 0;
  virtual void set_law(std::size_t a, std::size_t b, const LawSettings& law) = 0;

  virtual moreau::StepReport step(double step) = 0;
  virtual double time() const = 0;
  virtual double grain_size() const = 0;

  virtual ContactArrays contacts() const = 0;
  virtual std::vector<double> contact_impulse(Id body) const = 0;
  virtual moreau::Coordination coordination(std::size_t fewest) const = 0;
  virtual double solid_fraction(Numbers lower, Numbers upper) const = 0;
  virtual Kinetic kinetic_energy() const = 0;
  virtual std::vector<double> stress(double step, Numbers lower, Numbers upper) const = 0;
  virtual double wall_pressure(Id wall, double step, double area) = 0;
  virtual std::vector<std::string> check(const moreau::StepReport& report) const = 0;

  virtual void write_snapshot(const std::string& path) const = 0;
  virtual void read_snapshot(const std::string& path) = 0;
  virtual std::string snapshot() const = 0;
  virtual void write_paraview(const std::string& path, double step) const = 0;
  virtual void write_picture(const std::string& path, const PictureSettings& picture) const = 0;
};

/// Random grains of one kind of shape, and their places.
struct Deposition {
  std::vector<double> positions;  ///< n x D [m]
  std::vector<double> rotations;  ///< n x 4 (x, y, z, w); in the plane n angles [rad]
};

using Factory = std::unique_ptr<World> (*)(const Settings&);

/// The simulations that the module was built with, by the names of shape and law.
std::vector<std::pair<std::pair<std::string, std::string>, Factory>>& factories();

/// Adds a simulation to factories() at the start of the program.
struct Registration {
  Registration(const char* shape, const char* law, Factory factory) {
    factories().push_back({{shape, law}, factory});
  }
};

}  // namespace moreau_python
