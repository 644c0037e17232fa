// SPDX-License-Identifier: MIT
// The functions of Simulation that make bonds.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/world/bond.hpp"
#include "moreau/world/simulation.hpp"

namespace moreau {

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
std::size_t Simulation<ShapeT, Law, Integrator, Broad, Solver>::bond_touching(Scalar gap) requires
    BondingLaw<Law, SpaceOf<ShapeT>> {
  return bond_near(
      gap, [](std::uint32_t) { return true; }, 1);
}

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
std::size_t Simulation<ShapeT, Law, Integrator, Broad, Solver>::bond_touching(
    Scalar gap, std::span<const BodyId> among,
    std::size_t fewest_points) requires BondingLaw<Law, SpaceOf<ShapeT>> {
  std::vector<bool> listed(bodies().size(), false);
  for (const BodyId body : among) {
    assembly_.require_body(body, "Simulation::bond_touching");
    listed[body.index()] = true;
  }
  return bond_near(
      gap, [&](std::uint32_t body) { return bool(listed[body]); }, fewest_points);
}

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
std::size_t Simulation<ShapeT, Law, Integrator, Broad, Solver>::bond_near(
    Scalar gap, const auto& is_listed, std::size_t fewest_points) {
  constexpr const char* self = "Simulation::bond_touching";
  require(gap >= 0 && gap <= lengths().margin, self, "gap", gap, "must lie in [0, margin]");
  Scalar nearest = std::numeric_limits<Scalar>::infinity();
  std::size_t too_few = 0;
  const std::size_t made = add_bonds(self, [&](std::span<const Contact<S>> points) {
    if (!is_listed(points[0].a) || !is_listed(points[0].b)) return false;
    Scalar least = points[0].gap;
    for (const Contact<S>& point : points) least = std::min(least, point.gap);
    if (least <= gap && points.size() < fewest_points) {
      too_few = std::max(too_few, points.size());
      return false;
    }
    nearest = std::min(nearest, least);
    return least <= gap;
  });
  if (bonds().empty())
    dynamics_.bonds().note_missed(std::max(nearest, Scalar(0)), too_few);
  else
    dynamics_.bonds().note_missed(-1, 0);
  return made;
}

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
void Simulation<ShapeT, Law, Integrator, Broad, Solver>::bond(BodyId a, BodyId b) requires
    BondingLaw<Law, SpaceOf<ShapeT>> {
  assembly_.require_body(a, "Simulation::bond");
  assembly_.require_body(b, "Simulation::bond");
  const std::pair pair(a, b);
  for (const Bond<S>& one : bonds())
    if (std::pair(one.a, one.b) == pair || std::pair(one.b, one.a) == pair) return;
  bond(std::span(&pair, 1));
}

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
std::size_t Simulation<ShapeT, Law, Integrator, Broad, Solver>::bond(
    std::span<const std::pair<BodyId, BodyId>> pairs) requires BondingLaw<Law, SpaceOf<ShapeT>> {
  constexpr const char* self = "Simulation::bond";
  const auto ordered = [](BodyId a, BodyId b) { return std::pair(std::min(a, b), std::max(a, b)); };
  std::vector<std::pair<BodyId, BodyId>> listed, bonded;
  for (const auto& [a, b] : pairs) {
    assembly_.require_body(a, self);
    assembly_.require_body(b, self);
    listed.push_back(ordered(a, b));
  }
  std::sort(listed.begin(), listed.end());
  std::vector<Bond<S>> before(bonds().begin(), bonds().end());
  const std::size_t made = add_bonds(self, [&](std::span<const Contact<S>> points) {
    return std::binary_search(listed.begin(), listed.end(),
                              ordered(bodies().id[points[0].a], bodies().id[points[0].b]));
  });
  dynamics_.bonds().note_missed(-1, 0);
  for (const Bond<S>& one : bonds()) bonded.push_back(ordered(one.a, one.b));
  std::sort(bonded.begin(), bonded.end());
  for (const auto& [a, b] : pairs) {
    if (std::binary_search(bonded.begin(), bonded.end(), ordered(a, b))) continue;
    dynamics_.bonds().set_bonds(std::move(before));
    require(a != b, self, "b", b, "must be another body than a");
    const auto is_held = [&](BodyId body) { return bodies().is_prescribed(body.index()); };
    require(!is_held(a) || !is_held(b), self, "b", b,
            "must be free to move, or a must be: the motion of both is prescribed");
    require(false, self, "b", b,
            "must be within the margin of a: that is tolerances().margin x grain_size()");
  }
  return made;
}

template <GrainShape ShapeT, class Law, class Integrator, class Broad, class Solver>
std::size_t Simulation<ShapeT, Law, Integrator, Broad, Solver>::add_bonds(const char* function,
                                                                          const auto& keeps) {
  ContactsOf<Law, S> touching;
  detector_.place(std::span<const Pose<S>>(bodies().pose),
                  [&](std::size_t k) -> const ShapeT& { return assembly_.shape_of_grain(k); });
  const Matrix vectors = cell().vectors();
  detector_.find_pairs(lengths(), function);
  if (cell().is_lattice()) dynamics_.bonds().recount_cells(vectors, cell());
  detector_.use_whole_margin();
  detector_.detect(lengths(), bodies(), contacts_, touching);
  assembly_.keep_poses(0);  // nothing has moved
  assembly_.require_no_deep_overlap(touching, function, [] {});
  return dynamics_.bonds().add(bodies(), cell(), touching, keeps);
}

}  // namespace moreau
