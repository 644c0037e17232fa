// SPDX-License-Identifier: MIT
// Some of the combinations that long/matrix_*.cpp have all of. Rolling resistance and adhesion are
// among the quick cases of the validation.
#include "moreau/law/frictionless.hpp"
#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/shape/sphere.hpp"

#include "conformance/matrix.hpp"
#include "conformance/world.hpp"

using namespace moreau;

TEST_CASE("frictionless disks") {
  conformance::world(Disk<double>(0.005), Frictionless<>(), 0.01);
}
TEST_CASE("disks on springs") {
  conformance::world(Disk<double>(0.005), conformance::stiff_springs(0.08), 0.01);
}
TEST_CASE("Hertzian spheres of float") {
  conformance::world(Sphere<Space<3, float>>(0.005f), conformance::stiff_spheres(5e-4f), 0.01f);
}
