// SPDX-License-Identifier: MIT
// The extension module moreau._moreau: World, Shape and Random for Python. It checks what memory safety needs;
// the functions of the package moreau check the arguments, have the docstrings, and are what users call.
#include <algorithm>
#include <cmath>
#include <concepts>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <stdexcept>
#include <string>
#include <system_error>

#include "moreau/boundary/drive.hpp"
#include "moreau/sample/ballast.hpp"
#include "moreau/sample/random_deposition.hpp"
#include "moreau/sample/size_distribution.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/version.hpp"

#include "world.hpp"

namespace py = pybind11;

namespace moreau_python {

std::vector<std::pair<std::pair<std::string, std::string>, Factory>>& factories() {
  static std::vector<std::pair<std::pair<std::string, std::string>, Factory>> all;
  return all;
}

namespace {

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// A simulation and what Python does with it. Arrays that are views share the ownership.
struct Handle {
  std::unique_ptr<World> world;
  long views = 0;     ///< arrays that look into the memory of the bodies
  bool busy = false;  ///< whether a thread that does not hold the GIL is in a function of it

  /// The simulation for a function that moves no memory of the bodies.
  World& use(const char* function) {
    if (busy)
      throw std::invalid_argument(std::string(function) +
                                  ": simulation = (in a step of another thread) must be idle");
    return *world;
  }
  /// The simulation for a function that may move the memory of the bodies.
  World& grow(const char* function) {
    World& used = use(function);
    if (views > 0)
      throw std::invalid_argument(
          std::string(function) + ": views = " + std::to_string(views) +
          " must be 0: arrays such as positions look into the memory that "
          "would move; delete them, or copy() them. An interactive session keeps "
          "the last result in _ (Jupyter in Out[]), and the last exception "
          "keeps the variables of its function");
    return used;
  }
};

/// Work without the GIL, in which other threads of Python are refused the simulation.
template <class Work>
auto without_gil(Handle& handle, const Work& work) {
  struct Busy {
    bool& flag;
    explicit Busy(bool& f) : flag(f) { flag = true; }
    ~Busy() { flag = false; }
  } busy(handle.busy);
  py::gil_scoped_release release;
  return work();
}

/// Keeps the memory of a view, and is counted as one.
struct View {
  std::shared_ptr<Handle> handle;
  explicit View(std::shared_ptr<Handle> of) : handle(std::move(of)) { ++handle->views; }
  ~View() { --handle->views; }
  View(const View&) = delete;
  View& operator=(const View&) = delete;
};

py::array view_of(const std::shared_ptr<Handle>& handle, Quantity quantity, bool flat) {
  const Rows rows = handle->use("Simulation.positions, velocities, ...").rows(quantity);
  const py::capsule owner(new View(handle), [](void* view) { delete static_cast<View*>(view); });
  std::vector<py::ssize_t> shape{py::ssize_t(rows.rows)}, strides{rows.stride};
  if (!flat) shape.push_back(py::ssize_t(rows.columns)), strides.push_back(sizeof(double));
  py::array array(py::dtype::of<double>(), shape, strides, rows.first, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

Rows rows_of(const Array& array) {
  if (array.ndim() == 1)
    return {array.data(), std::size_t(array.shape(0)), 1, py::ssize_t(sizeof(double))};
  if (array.ndim() != 2) throw std::invalid_argument("moreau: array must have one or two axes");
  return {array.data(), std::size_t(array.shape(0)), std::size_t(array.shape(1)),
          py::ssize_t(sizeof(double)) * array.shape(1)};
}
Numbers numbers_of(const Array& array) {
  return {array.data(), std::size_t(array.size())};
}
std::span<const std::int64_t> integers_of(const Integers& array) {
  return {array.data(), std::size_t(array.size())};
}

/// An array with a copy of the numbers.
template <class T>
py::array_t<T> array_of(const std::vector<T>& numbers, std::vector<py::ssize_t> shape = {}) {
  if (shape.empty()) shape.push_back(py::ssize_t(numbers.size()));
  py::array_t<T> array(shape);
  std::copy(numbers.begin(), numbers.end(), array.mutable_data());
  return array;
}

py::dict dict_of(const ContactArrays& c, int dim) {
  const auto n = py::ssize_t(c.gap.size()), d = py::ssize_t(dim);
  py::dict out;
  out["a"] = array_of(c.a), out["b"] = array_of(c.b), out["gap"] = array_of(c.gap);
  out["frame"] = array_of(c.frame, {n, d, d});
  out["point"] = array_of(c.point, {n, d});
  out["impulse"] = array_of(c.impulse, {n, d});
  std::vector<double> couple = c.couple;
  const py::ssize_t angular = d * (d - 1) / 2;
  couple.resize(std::size_t(n * angular), 0);
  out["couple"] = array_of(couple, {n, angular});
  out["contact_class"] = array_of(c.contact_class);
  return out;
}

/// A random number generator, std::mt19937_64.
struct Random {
  std::mt19937_64 engine;
};

/// A shape for Python: pybind11 would turn a variant itself into one of its types.
struct Grain {
  AnyShape shape;
};

/// Calls f with the type of the shapes of this name.
template <class F>
auto with_kind(const std::string& kind, const char* function, const F& f) {
  if (kind == "polyhedron") return f.template operator()<moreau::Polyhedron<double>>();
  if (kind == "polygon") return f.template operator()<moreau::Polygon<double>>();
  if (kind == "ball") return f.template operator()<moreau::Ball<double>>();
  if (kind == "disk") return f.template operator()<moreau::Disk<double>>();
  throw std::invalid_argument(std::string(function) + ": kind = '" + kind +
                              "' must be polyhedron, polygon, ball or disk");
}

template <class ShapeT>
Grain hull_of(const Array& points, const char* function) {
  using Vector = typename ShapeT::Space::Vector;
  const Rows rows = rows_of(points);
  moreau::require(rows.columns == std::size_t(Vector::SizeAtCompileTime), function, "points",
                  rows.columns, "columns, must have one for each axis");
  std::vector<Vector> all(rows.rows);
  for (std::size_t i = 0; i < rows.rows; ++i)
    for (std::size_t k = 0; k < rows.columns; ++k) all[i][Eigen::Index(k)] = rows(i, k);
  return {ShapeT(std::span<const Vector>(all))};
}

/// The shape of this kind from points, or, for balls and disks, a radius.
Grain make_shape(const std::string& kind, const Array& of) {
  return with_kind(kind, "moreau.shape", [&]<class ShapeT>() -> Grain {
    if constexpr (std::constructible_from<ShapeT, double>)
      return {ShapeT(of.size() > 0 ? of.data()[0] : 0.0)};
    else
      return hull_of<ShapeT>(of, "moreau.shape");
  });
}

py::array vertices_of(const Grain& grain) {
  return std::visit(
      []<class ShapeT>(const ShapeT& s) -> py::array {
        constexpr py::ssize_t dim = ShapeT::Space::dim;
        if constexpr (requires { s.vertices(); }) {
          py::array_t<double> out({py::ssize_t(s.vertices().rows()), dim});
          for (Eigen::Index i = 0; i < s.vertices().rows(); ++i)
            for (Eigen::Index k = 0; k < dim; ++k) out.mutable_at(i, k) = s.vertices()(i, k);
          return out;
        } else {
          return py::array_t<double>(std::vector<py::ssize_t>{0, dim});
        }
      },
      grain.shape);
}

std::vector<std::vector<std::uint32_t>> faces_of(const Grain& grain) {
  std::vector<std::vector<std::uint32_t>> faces;
  if (const auto* polyhedron = std::get_if<moreau::Polyhedron<double>>(&grain.shape))
    for (std::size_t f = 0; f < polyhedron->face_count(); ++f)
      faces.emplace_back(polyhedron->face(f).begin(), polyhedron->face(f).end());
  return faces;
}

const char* kind_of(const Grain& grain) {
  constexpr const char* kinds[] = {"polyhedron", "polygon", "ball", "disk"};
  return kinds[grain.shape.index()];
}

double volume_of(const Grain& grain) {
  return std::visit([](const auto& s) { return s.volume(); }, grain.shape);
}
double circumradius_of(const Grain& grain) {
  return std::visit([](const auto& s) { return s.circumradius(); }, grain.shape);
}
double inradius_of(const Grain& grain) {
  return std::visit([](const auto& s) { return s.inradius(); }, grain.shape);
}

template <int dim>
py::tuple deposit(const Array& radii, double length, std::mt19937_64& random) {
  using S = moreau::Space<dim>;
  const std::vector<double> r(radii.data(), radii.data() + radii.size());
  const auto poses = moreau::random_deposition<S>(r, length, random);
  const auto n = py::ssize_t(poses.size());
  py::array_t<double> x({n, py::ssize_t(dim)});
  py::array_t<double> q(dim == 2 ? std::vector<py::ssize_t>{n} : std::vector<py::ssize_t>{n, 4});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto row = py::ssize_t(i);
    for (int k = 0; k < dim; ++k) x.mutable_at(row, k) = poses[i].position[k];
    if constexpr (dim == 2)
      q.mutable_at(row) = poses[i].rotation.angle();
    else
      for (int k = 0; k < 4; ++k) q.mutable_at(row, k) = poses[i].rotation.coeffs()[k];
  }
  return py::make_tuple(x, q);
}

py::array_t<double> rotations_of(const Array& vectors) {
  const Rows rows = rows_of(vectors);
  moreau::require(rows.columns == 3, "moreau.rotation", "vectors", rows.columns,
                  "columns, must have 3");
  py::array_t<double> out({py::ssize_t(rows.rows), py::ssize_t(4)});
  for (std::size_t i = 0; i < rows.rows; ++i) {
    const Eigen::Vector3d w(rows(i, 0), rows(i, 1), rows(i, 2));
    const Eigen::Quaterniond q = moreau::Space<3>::exp(w);
    for (int k = 0; k < 4; ++k) out.mutable_at(py::ssize_t(i), k) = q.coeffs()[k];
  }
  return out;
}

/// Exceptions of C++ for Python: the names of functions are those of Python.
void translate(std::exception_ptr thrown) {
  const auto python_names = [](std::string text) {
    for (std::size_t at; (at = text.find("::")) != std::string::npos;) text.replace(at, 2, ".");
    return text;
  };
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const std::invalid_argument& error) {
    PyErr_SetString(PyExc_ValueError, python_names(error.what()).c_str());
  } catch (const std::system_error& error) {
    PyErr_SetString(PyExc_OSError, error.what());
  } catch (const std::bad_alloc&) {
    PyErr_SetString(PyExc_MemoryError, "moreau: not enough memory");
  } catch (const std::runtime_error& error) {
    PyErr_SetString(PyExc_RuntimeError, python_names(error.what()).c_str());
  }
}

LawSettings law_of(const py::dict& d) {
  LawSettings law;
  const auto get = [&](const char* name, double& to) {
    if (d.contains(name)) to = d[name].cast<double>();
  };
  get("friction", law.friction), get("restitution", law.restitution);
  law.static_friction = law.friction, law.tangential_stiffness = law.stiffness;
  get("static_friction", law.static_friction), get("rolling", law.rolling);
  get("stiffness", law.stiffness);
  law.tangential_stiffness = law.stiffness;
  get("tangential_stiffness", law.tangential_stiffness);
  return law;
}

moreau::ColouredOptions solver_of(const py::dict& d) {
  moreau::ColouredOptions options;
  const auto get = [&]<class T>(const char* name, T& to) {
    if (d.contains(name)) to = d[name].cast<T>();
  };
  get("tolerance", options.tolerance), get("max_sweeps", options.max_sweeps);
  get("cold_sweeps", options.cold_sweeps), get("check_interval", options.check_interval);
  get("accelerate", options.accelerate), get("islands", options.islands);
  get("velocity_tolerance", options.velocity_tolerance);
  if (d.contains("stop_test") && d["stop_test"].cast<std::string>() == "qm16")
    options.stop_test = moreau::StopTest::qm16;
  return options;
}

moreau::OverlapCorrectionOptions correction_of(const py::dict& d) {
  moreau::OverlapCorrectionOptions options;
  const auto get = [&]<class T>(const char* name, T& to) {
    if (d.contains(name)) to = d[name].cast<T>();
  };
  get("enabled", options.enabled), get("slop", options.slop), get("rate", options.rate);
  get("sweeps", options.sweeps), get("max_shift", options.max_shift);
  get("islands", options.islands);
  return options;
}

std::shared_ptr<Handle> make_world(const std::string& shape, const std::string& law,
                                   double grain_size, std::size_t materials, const py::dict& of_law,
                                   const py::dict& tolerances, const py::dict& solver) {
  Settings settings;
  settings.grain_size = grain_size, settings.materials = materials;
  settings.law = law_of(of_law), settings.solver = solver_of(solver);
  settings.tolerances = {tolerances["margin"].cast<double>(), tolerances["skin"].cast<double>(),
                         tolerances["resolution"].cast<double>()};
  for (const auto& [names, factory] : factories())
    if (names.first == shape && names.second == law) {
      auto handle = std::make_shared<Handle>();
      handle->world = factory(settings);
      return handle;
    }
  throw std::invalid_argument("Simulation: shape = '" + shape + "' under law = '" + law +
                              "' must be one that the module was built with");
}

/// One step; Ctrl-C ends a loop of steps after the present one.
moreau::StepReport step(Handle& handle, double h) {
  World& world = handle.use("Simulation.step");
  return without_gil(handle, [&] { return world.step(h); });
}
moreau::StepReport run(Handle& handle, double h, long steps) {
  moreau::StepReport report;
  for (long k = 0; k < steps; ++k) {
    report = step(handle, h);
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  return report;
}

/// A number of a result with six digits, anything else as Python shows it.
std::string shown(const py::object& value) {
  if (py::isinstance<py::float_>(value)) return py::str("{:.6g}").format(value);
  return py::repr(value);
}

/// A struct of results: repr() shows its fields on one line, print() one field on each line.
template <class T>
class Fields {
 public:
  Fields(py::module_& m, const char* name, const char* doc) : type_(m, name, doc) {
    type_.def("__repr__", [of = names_, name = std::string(name)](const py::object& self) {
      std::string text;
      for (const std::string& field : *of)
        text += (text.empty() ? "" : ", ") + field + "=" + shown(self.attr(field.c_str()));
      return name + "(" + text + ")";
    });
    type_.def("__str__", [of = names_](const py::object& self) {
      std::string text;
      for (const std::string& field : *of) {
        const py::object value = self.attr(field.c_str());
        const bool is_nested = py::hasattr(value, "converged");
        text +=
            field + (is_nested ? ":\n" + std::string(py::str(value)) : " = " + shown(value) + "\n");
      }
      return text;
    });
  }
  template <class Member>
  void add(const char* name, Member T::*member) {
    type_.def_readonly(name, member);
    names_->push_back(name);
  }

 private:
  py::class_<T> type_;
  std::shared_ptr<std::vector<std::string>> names_ = std::make_shared<std::vector<std::string>>();
};

void bind_reports(py::module_& m) {
  using moreau::SolveReport, moreau::StepReport, moreau::Coordination;
  Fields<SolveReport> solve(
      m, "SolveReport",
      "How well the contact problem was solved. converged: whether the residual is below the "
      "tolerance; sweeps: of the "
      "solver; capped: whether it stopped at max_sweeps; residual: relative to the impulses [-]; "
      "velocity_error: "
      "estimated error of velocities. All fields: examples/guide/solve-report.md.");
#define FIELD(name) solve.add(#name, &SolveReport::name)
  FIELD(sweeps), FIELD(converged), FIELD(capped), FIELD(residual), FIELD(relative_approach);
  FIELD(velocity_error), FIELD(islands), FIELD(unsolved_islands), FIELD(quad_dv), FIELD(quad_dvr);
  FIELD(maxm_dv), FIELD(maxm_dvr), FIELD(worst_velocity), FIELD(worst_gap), FIELD(worst_cone);
  FIELD(worst_complementarity), FIELD(wrong_sign_dissipation);
#undef FIELD
  Fields<StepReport> step_report(m, "StepReport",
                                 "Results of one step. pairs, points: in contact or within the "
                                 "margin; approach: largest approach of a pair in the "
                                 "step over the margin [-], above 1 the step is too long; "
                                 "max_overlap, mean_overlap [m]; dissipation, of it "
                                 "friction and rolling, elastic_energy [J]; ms_...: times [ms]. "
                                 "All fields: examples/guide/solve-report.md.");
#define FIELD(name) step_report.add(#name, &StepReport::name)
  FIELD(step), FIELD(solve), FIELD(candidate_pairs), FIELD(pairs), FIELD(points),
      FIELD(warm_started);
  FIELD(approach), FIELD(overlapping), FIELD(max_overlap), FIELD(mean_overlap), FIELD(deepest_a);
  FIELD(deepest_b), FIELD(dissipation), FIELD(friction), FIELD(rolling), FIELD(elastic_energy);
  FIELD(ms_detect), FIELD(ms_solve), FIELD(ms_total);
#undef FIELD
  Fields<Coordination> coordination(m, "Coordination",
                                    "grains: counted; rattlers: removed before; points, pairs: "
                                    "contact points that push, and pairs of bodies that have "
                                    "one, each counted once, walls included; neighbours, "
                                    "points_per_grain: means over the grains [-].");
#define FIELD(name) coordination.add(#name, &Coordination::name)
  FIELD(grains), FIELD(rattlers), FIELD(points), FIELD(pairs), FIELD(neighbours);
  FIELD(points_per_grain);
#undef FIELD
}

void bind_shapes(py::module_& m) {
  py::class_<Grain>(m, "Shape")
      .def_property_readonly("kind", kind_of)
      .def_property_readonly("volume", volume_of)
      .def_property_readonly("circumradius", circumradius_of)
      .def_property_readonly("inradius", inradius_of)
      .def_property_readonly("vertices", vertices_of)
      .def_property_readonly("faces", faces_of)
      .def("scaled",
           [](const Grain& grain, double factor) {
             return std::visit([&](const auto& s) -> Grain { return {s.scaled(factor)}; },
                               grain.shape);
           })
      .def("__repr__", [](const Grain& grain) {
        return std::string("<moreau ") + kind_of(grain) + ", circumradius " +
               std::to_string(circumradius_of(grain)) + " m>";
      });
  m.def("shape", make_shape);
  m.def("regular", [](const std::string& kind, double size) {
    return with_kind(kind, "moreau.regular", [&]<class ShapeT>() -> Grain {
      return {moreau::regular_shape<ShapeT>(size)};
    });
  });
  py::class_<Random>(m, "Random").def(py::init([](std::uint64_t seed) {
    return Random{std::mt19937_64(seed)};
  }));
  m.def("ballast", [](const std::string& kind, Random& random) {
    return with_kind(kind, "Random.shape", [&]<class ShapeT>() -> Grain {
      return {moreau::Ballast<ShapeT>::draw(random.engine)};
    });
  });
  m.def("sample_sizes", [](const Array& sizes, const Array& shares, std::size_t n, Random& random) {
    std::vector<moreau::SizeDistribution::Class> classes;
    for (py::ssize_t k = 0; k < std::min(sizes.size(), shares.size()); ++k)
      classes.push_back({sizes.data()[k], shares.data()[k]});
    return array_of(moreau::SizeDistribution(classes).sample(n, random.engine));
  });
  m.def("random_deposition", [](int dim, const Array& radii, double length, Random& random) {
    return dim == 2 ? deposit<2>(radii, length, random.engine)
                    : deposit<3>(radii, length, random.engine);
  });
  m.def("rotations", rotations_of);
  py::class_<moreau::HarmonicForce>(m, "HarmonicForce")
      .def(py::init<double, double, double, double>())
      .def("__call__", &moreau::HarmonicForce::operator());
}

using WorldClass = py::class_<Handle, std::shared_ptr<Handle>>;

void bind_bodies(WorldClass& world) {
  world
      .def("add_shape",
           [](Handle& h, const Grain& s) {
             return h.use("Simulation.add_shape").add_shape(s.shape);
           })
      .def("shape",
           [](Handle& h, Id grain) { return Grain{h.use("Simulation.shape").shape(grain)}; })
      .def("add_grains",
           [](Handle& h, const Integers& shapes, const Array& x, const Array& q,
              const Array& densities, const Integers& materials) {
             return array_of(h.grow("Simulation.add_grains")
                                 .add_grains(integers_of(shapes), rows_of(x), rows_of(q),
                                             numbers_of(densities), integers_of(materials)));
           })
      .def("remove_grains",
           [](Handle& h, const Integers& ids) {
             h.use("Simulation.remove_grains").remove_grains(integers_of(ids));
           })
      .def("add_wall",
           [](Handle& h, const Array& normal, const Array& point, std::size_t material) {
             return h.grow("Simulation.add_wall")
                 .add_wall(numbers_of(normal), numbers_of(point), material);
           })
      .def("add_cylinder",
           [](Handle& h, const Array& point, const Array& axis, double radius,
              std::size_t material) {
             return h.grow("Simulation.add_cylinder")
                 .add_cylinder(numbers_of(point), numbers_of(axis), radius, material);
           })
      .def(
          "add_mesh_wall",
          [](Handle& h, const Array& vertices, const Integers& facets, bool both,
             std::size_t material) {
            World& w = h.grow("Simulation.add_mesh_wall");
            if (vertices.ndim() != 2 || vertices.shape(1) != w.dim() ||
                facets.size() % w.dim() != 0)
              throw std::invalid_argument("Simulation.add_mesh_wall: vertices must have D columns");
            return w.add_mesh_wall(rows_of(vertices), integers_of(facets), both, material);
          })
      .def("grains", [](Handle& h) { return array_of(h.use("Simulation.grains").grains()); })
      .def("walls", [](Handle& h) { return array_of(h.use("Simulation.walls").walls()); })
      .def("body_count", [](Handle& h) { return h.use("Simulation.body_count").body_count(); })
      .def("contains", [](Handle& h, Id id) { return h.use("Simulation.contains").contains(id); })
      .def("is_prescribed",
           [](Handle& h, Id id) { return h.use("Simulation.is_prescribed").is_prescribed(id); })
      .def("set_pose",
           [](Handle& h, Id id, const Array& x, const Array& q) {
             h.use("Simulation.set_pose").set_pose(id, numbers_of(x), numbers_of(q));
           })
      .def("set_vector",
           [](Handle& h, Id id, int quantity, const Array& value) {
             h.use("Simulation.set_velocity")
                 .set_vector(id, static_cast<Quantity>(quantity), numbers_of(value));
           })
      .def("set_wall_mass",
           [](Handle& h, Id id, double mass) {
             h.use("Simulation.set_wall_mass").set_wall_mass(id, mass);
           })
      .def("prescribe_motion",
           [](Handle& h, Id id) { h.use("Simulation.prescribe_motion").prescribe_motion(id); })
      .def("release", [](Handle& h, Id id) { h.use("Simulation.release").release(id); })
      .def("drive",
           [](Handle& h, Id id, const Array& direction, double value, bool is_force, double step) {
             h.use("Simulation.drive").drive(id, numbers_of(direction), value, is_force, step);
           });
}

void bind_settings(WorldClass& world) {
  world
      .def("set_periodic",
           [](Handle& h, int axis, double lower, double upper) {
             h.use("Simulation.set_periodic").set_periodic(axis, lower, upper);
           })
      .def("cell",
           [](Handle& h) {
             const auto [lower, length] = h.use("Simulation.cell").cell();
             return py::make_tuple(array_of(lower), array_of(length));
           })
      .def("wrap",
           [](Handle& h, const Array& x) {
             World& w = h.use("Simulation.wrap");
             if (x.ndim() != 2 || x.shape(1) != w.dim())
               throw std::invalid_argument("Simulation.wrap: points must have D columns");
             return array_of(w.wrap(rows_of(x)), {x.shape(0), x.shape(1)});
           })
      .def("set_gravity",
           [](Handle& h, const Array& g) {
             h.use("Simulation.set_gravity").set_gravity(numbers_of(g));
           })
      .def("gravity", [](Handle& h) { return array_of(h.use("Simulation.gravity").gravity()); })
      .def("allow_overlaps",
           [](Handle& h, bool a) { h.use("Simulation.allow_overlaps").allow_overlaps(a); })
      .def("set_threads", [](Handle& h, int n) { h.use("Simulation.set_threads").set_threads(n); })
      .def("set_solver",
           [](Handle& h, const py::dict& d) {
             h.use("Simulation.set_solver").set_solver(solver_of(d));
           })
      .def("set_theta", [](Handle& h, double t) { h.use("Simulation.set_theta").set_theta(t); })
      .def("set_correction",
           [](Handle& h, const py::dict& d) {
             h.use("Simulation.set_correction").set_correction(correction_of(d));
           })
      .def("set_contact_points",
           [](Handle& h, bool few) {
             h.use("Simulation.set_contact_points").set_contact_points(few);
           })
      .def("set_law", [](Handle& h, std::size_t a, std::size_t b, const py::dict& d) {
        h.use("Simulation.set_law").set_law(a, b, law_of(d));
      });
}

void bind_measures(WorldClass& world) {
  world
      .def("contacts",
           [](Handle& h) {
             World& w = h.use("Simulation.contacts");
             return dict_of(w.contacts(), w.dim());
           })
      .def("contact_impulse",
           [](Handle& h, Id id) {
             return array_of(h.use("Simulation.contact_impulse").contact_impulse(id));
           })
      .def("coordination",
           [](Handle& h, std::size_t fewest) {
             return h.use("Simulation.coordination").coordination(fewest);
           })
      .def("solid_fraction",
           [](Handle& h, const Array& lower, const Array& upper) {
             World& w = h.use("Simulation.solid_fraction");
             return w.solid_fraction(numbers_of(lower), numbers_of(upper));
           })
      .def("kinetic_energy",
           [](Handle& h) {
             const Kinetic k = h.use("Simulation.kinetic_energy").kinetic_energy();
             return py::make_tuple(k.translation, k.rotation);
           })
      .def("stress",
           [](Handle& h, double step, const Array& lower, const Array& upper) {
             World& w = h.use("Simulation.stress");
             const py::ssize_t d = w.dim();
             return array_of(w.stress(step, numbers_of(lower), numbers_of(upper)), {d, d});
           })
      .def("wall_pressure",
           [](Handle& h, Id wall, double step, double area) {
             return h.use("Simulation.wall_pressure").wall_pressure(wall, step, area);
           })
      .def("check", [](Handle& h, const moreau::StepReport& report) {
        return h.use("Simulation.check").check(report);
      });
}

void bind_files(WorldClass& world) {
  world
      .def("write_snapshot",
           [](Handle& h, const std::string& path) {
             World& w = h.use("Simulation.write_snapshot");
             without_gil(h, [&] { w.write_snapshot(path); });
           })
      .def("read_snapshot",
           [](Handle& h, const std::string& path) {
             World& w = h.grow("Simulation.read_snapshot");
             without_gil(h, [&] { w.read_snapshot(path); });
           })
      .def("snapshot", [](Handle& h) { return py::bytes(h.use("Simulation.snapshot").snapshot()); })
      .def("write_paraview",
           [](Handle& h, const std::string& path, double step) {
             World& w = h.use("Simulation.write_paraview");
             without_gil(h, [&] { w.write_paraview(path, step); });
           })
      .def("write_picture", [](Handle& h, const std::string& path, int width, int height,
                               double azimuth, double elevation, bool walls, const Array& colors) {
        World& w = h.use("Simulation.write_picture");
        const PictureSettings picture{width,   height,
                                      azimuth, elevation,
                                      walls,   {colors.data(), colors.data() + colors.size()}};
        without_gil(h, [&] { w.write_picture(path, picture); });
      });
}

}  // namespace

PYBIND11_MODULE(_moreau, m) {
  py::register_exception_translator(translate);
  m.attr("__version__") = MOREAU_VERSION_STRING;
#ifdef MOREAU_WITHOUT_PNG
  m.attr("has_pictures") = false;
#else
  m.attr("has_pictures") = true;
#endif
  bind_reports(m);
  bind_shapes(m);
  m.def("instances", [] {
    std::vector<std::pair<std::string, std::string>> names;
    for (const auto& [name, factory] : factories()) names.push_back(name);
    return names;
  });
  WorldClass world(m, "World");
  world.def(py::init(&make_world))
      .def_property_readonly("dim", [](Handle& h) { return h.world->dim(); })
      .def_property_readonly("rigid", [](Handle& h) { return h.world->is_set_valued_rigid(); })
      .def_property_readonly("views", [](Handle& h) { return h.views; })
      .def("view", [](const std::shared_ptr<Handle>& h, int quantity,
                      bool flat) { return view_of(h, static_cast<Quantity>(quantity), flat); })
      .def("step", step)
      .def("run", run)
      .def("time", [](Handle& h) { return h.use("Simulation.time").time(); })
      .def("grain_size", [](Handle& h) { return h.use("Simulation.grain_size").grain_size(); });
  bind_bodies(world);
  bind_settings(world);
  bind_measures(world);
  bind_files(world);
}

}  // namespace moreau_python
