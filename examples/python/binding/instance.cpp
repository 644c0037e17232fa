// SPDX-License-Identifier: MIT
// CMake compiles this file once for each shape, with its name as MOREAU_PYTHON_SHAPE.
#include "instance.hpp"

#define MOREAU_PYTHON_TEXT_OF(name) #name
#define MOREAU_PYTHON_TEXT(name) MOREAU_PYTHON_TEXT_OF(name)

namespace moreau_python {
namespace {

/// The types of the grains, under the names of Python.
namespace shapes {
using polyhedron = moreau::Polyhedron<double>;
using polygon = moreau::Polygon<double>;
using ball = moreau::Ball<double>;
using disk = moreau::Disk<double>;
}  // namespace shapes

template <class Law>
std::unique_ptr<World> make(const Settings& settings) {
  return std::make_unique<Instance<shapes::MOREAU_PYTHON_SHAPE, Law>>(settings);
}

constexpr const char* shape = MOREAU_PYTHON_TEXT(MOREAU_PYTHON_SHAPE);
const Registration coulomb(shape, "coulomb", make<Coulomb>);
const Registration rolling(shape, "rolling", make<Rolling>);
const Registration compliant(shape, "compliant", make<Compliant>);

}  // namespace
}  // namespace moreau_python
