// SPDX-License-Identifier: MIT
#include "moreau/shape/capsule.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/polygon.hpp"

#include "conformance/matrix.hpp"
#include "world/assemblies.hpp"

TEST_CASE_TEMPLATE("disks, polygons and stadiums under every law", T, double, float) {
  using Grain = moreau::OneOf<moreau::Disk<T>, moreau::Polygon<T>, moreau::Stadium<T>>;
  const std::vector<Grain> grains{moreau::Disk<T>(T(0.005)),
                                  scenes::cuboid<moreau::Polygon<T>>({T(0.004), T(0.0025)}),
                                  moreau::Stadium<T>(T(0.0025), T(0.0025))};
  conformance::all_laws(grains, T(0.01));
}
