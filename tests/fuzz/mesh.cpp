// SPDX-License-Identifier: MIT
// Input: an arbitrary list of vertices and facets. Expected: each function of meshes gives its result
// or std::invalid_argument, and what it accepts is what it says.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "moreau/detect/pairs/collide_mesh_wall.hpp"
#include "moreau/mesh/check_mesh.hpp"
#include "moreau/mesh/convex_of_mesh.hpp"
#include "moreau/mesh/facet_mesh.hpp"
#include "moreau/mesh/mesh_wall.hpp"
#include "moreau/mesh/repair_mesh.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/shape/simplify_hull.hpp"

#include "bytes.hpp"

namespace {

using namespace moreau;

/// Vertices, and facets that mostly refer to them.
template <class S>
FacetMesh<S> take_mesh(Bytes& bytes) {
  using T = typename S::Scalar;
  FacetMesh<S> mesh;
  const bool wild = bytes.between(0, 3) == 0;
  const T scale = std::ldexp(T(1), bytes.between(-40, 40));
  const int count = bytes.between(0, 24);
  for (int v = 0; v < count; ++v) {
    auto& x = mesh.vertices.emplace_back();
    for (auto& coordinate : x) coordinate = scale * static_cast<T>(bytes.number(wild));
  }
  while (!bytes.is_empty() && mesh.facets.size() < 64) {
    auto& facet = mesh.facets.emplace_back();
    for (auto& v : facet) v = std::uint32_t(bytes.between(0, std::max(count + (wild ? 1 : -1), 0)));
  }
  return mesh;
}

template <class Call>
void attempt(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument&) {
  }
}

template <class S>
void check_solid(const FacetMesh<S>& mesh) {
  hold(volume_of(mesh) > 0, "a solid has a volume");
  const auto ridges = ridges_of<S>(mesh.facets);
  for_each_ridge(ridges, [&](auto at) {
    hold(at.size() == 2 && at[0].is_forward != at[1].is_forward, "a solid is closed and oriented");
  });
  FacetMesh<S> same = mesh;
  attempt([&] {
    orient(same);
    hold(same.facets == mesh.facets, "orient changes nothing of a solid");
  });
  hold(pieces_of(mesh).size() == 1, "a solid is one piece");
}

template <class S>
void check_hull(const FacetMesh<S>& mesh, int n) {
  using T = typename S::Scalar;
  const auto hull = hull_of_mesh(mesh);
  const T rounding = T(1e-6) * size_of(mesh) + detail::rounding_of(mesh);
  hold(worst_concavity(mesh, hull).depth >= -rounding, "a mesh lies within its hull");
  const auto fewer = simplify_hull(hull, std::size_t(S::dim + 1 + n));
  hold(fewer.volume_error >= 0 && fewer.volume_error < 1, "volume error in [0, 1)");
  hold(fewer.shape.volume() <= hull.volume() * T(1 + 1e-9), "a simplified hull lies inside");
  hold(fewer.shape.vertex_count() <= std::max(std::size_t(S::dim + 1 + n), hull.vertex_count()),
       "a simplified hull has fewer vertices");
}

/// Collides a shape with a wall at a few places.
template <class ShapeT>
void check_contacts(const ShapeT& shape, const MeshWall<SpaceOf<ShapeT>>& wall, double size) {
  using S = SpaceOf<ShapeT>;
  MeshScratch scratch;
  Manifold<S> manifold;
  const double margin = 0.02 * size;
  for (std::size_t k = 0; k < std::min<std::size_t>(wall.size(), 4); ++k) {
    const auto& side = wall.side(k);
    const typename S::Vector at = side.corners.rowwise().mean() + 0.1 * size * side.normal;
    const Placed<ShapeT> placed(shape, {at, S::exp(S::Angular::Constant(0.3 * double(k)))});
    std::vector<FeatureKey> keys;
    const auto check = [&](std::uint32_t) {
      hold(std::abs(manifold.normal.norm() - 1) < 1e-9, "the normal of a contact is unit");
      for (const auto& point : manifold.points) {
        hold(std::isfinite(point.gap) && point.gap <= margin * (1 + 1e-9),
             "a gap within the margin");
        hold(point.position.allFinite(), "a contact point is finite");
        keys.push_back(point.feature);
      }
    };
    collide_each(placed, wall, margin, scratch, manifold, check);
    std::sort(keys.begin(), keys.end());
    hold(std::adjacent_find(keys.begin(), keys.end()) == keys.end(), "keys of contacts differ");
  }
}
template <class S>
void check_wall(const FacetMesh<S>& mesh, WallSides sides) {
  const MeshWall<S> wall(mesh, sides);
  const auto bounds = wall.tree().bounds();
  const double size = double((bounds.upper - bounds.lower).norm());
  // Coordinates far apart or far from 1 overflow in squares; a user's shape would be refused.
  if (!(size > 1e-6 && size < 1e6) || detail::largest_coordinate(mesh) > 1e3 * size) return;
  check_contacts(regular_shape<PolytopeOf<S>>(0.15 * size), wall, size);
  check_contacts(BallIn<S>(0.1 * size), wall, size);
}

template <class S>
void try_mesh(Bytes& bytes) {
  const int n = bytes.between(0, 8);
  const auto tolerance = static_cast<typename S::Scalar>(std::abs(bytes.number(false)));
  const FacetMesh<S> mesh = take_mesh<S>(bytes);
  if (!find_solid_fault(mesh)) check_solid(mesh);
  attempt([&] { check_hull(mesh, n); });
  attempt([&] { convex_of_mesh(mesh); });
  attempt([&] { check_wall(mesh, n % 2 == 0 ? WallSides::outside : WallSides::both); });
  attempt([&] {
    FacetMesh<S> welded = mesh;
    weld(welded, tolerance);
    for (const auto& facet : welded.facets)
      for (const auto v : facet) hold(v < welded.vertices.size(), "weld keeps corners valid");
    FacetMesh<S> again = welded;
    hold(weld(again, typename S::Scalar(0)).merged_vertices == 0, "weld merges all at one place");
    drop_repeated_facets(welded);
    for (auto& piece : pieces_of(welded)) {
      attempt([&] {
        orient(piece);
        if (!find_solid_fault(piece)) check_solid(piece);
        check_hull(piece, n);
      });
    }
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  if (bytes.between(0, 1) == 0)
    try_mesh<Space<3, double>>(bytes);
  else
    try_mesh<Space<2, double>>(bytes);
  return 0;
}
