// SPDX-License-Identifier: MIT
// Ghosts: the grains of other processes that may touch grains of this one.
//
// A contact of grains a and b in the next steps needs the centre of a within
//
//     R_a + R_b + margin + 2 slack
//
// of the centre of b now, with the circumradii R, the margin (or the reach of bridges if it is larger), and the slack
// that each centre may move before the next redistribution. Each grain is therefore lent to all owners of the box around
// its centre with R_b of the widest grain. In a periodic cell the same is done for its images. Poses are not wrapped.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "moreau/core/aabb.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/neighbour_cells.hpp"
#include "moreau/core/periodic_cell.hpp"
#include "moreau/distributed/communicator.hpp"
#include "moreau/distributed/detail/shape_store.hpp"
#include "moreau/distributed/detail/world_parts.hpp"
#include "moreau/distributed/domain_decomposition.hpp"
#include "moreau/shape/circumradius.hpp"

namespace moreau::detail {

/// The ranks that own a part of the boxes around a point and its images.
/// @param x      in the cell [m]
/// @param reach  half of the width of the box [m]
/// @param found  out: ascending
/// @param buffer overwritten
template <class S>
void find_ranks(const DomainDecomposition<S>& decomposition, const PeriodicCell<S>& cell,
                const typename S::Vector& x, typename S::Scalar reach, std::vector<int>& found,
                std::vector<int>& buffer) {
  using Vector = typename S::Vector;
  found.clear();
  const Vector half = Vector::Constant(reach);
  for (int k = 0; k < neighbour_cells<S::dim>(); ++k) {
    const auto steps = neighbour_cell<Vector>(k);
    if (!cell.has_image(steps)) continue;
    const Vector center = x + steps.cwiseProduct(cell.length());
    decomposition.owners({center - half, center + half}, buffer);
    found.insert(found.end(), buffer.begin(), buffer.end());
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

/// Lends the grains of this process to the ranks that need them as ghosts.
/// @param grains of this process
/// @param shapes of all grains here; out: also those of the ghosts
/// @param margin largest gap of a contact [m]
/// @param slack  how far each centre may move before the next redistribution [m]
/// @param lent   out: ids of the grains that each rank gets, one entry per rank
/// @returns the ghosts from each rank
template <class S, class ShapeT>
std::vector<BodyList<S>> lend_grains(BodyList<S>& grains, ShapeStore<ShapeT>& shapes,
                                     const PeriodicCell<S>& cell, typename S::Scalar margin,
                                     typename S::Scalar slack,
                                     const DomainDecomposition<S>& decomposition,
                                     Communicator& processes,
                                     std::vector<std::vector<BodyId>>& lent) {
  using Scalar = typename S::Scalar;
  std::vector<Scalar> radius;
  for (const ShapeId shape : grains.shapes) radius.push_back(circumradius(shapes[shape]));
  double widest = 0;
  for (const Scalar r : radius) widest = std::max(widest, double(r));
  widest = processes.largest(widest);
  const Scalar around = Scalar(widest) + margin + 2 * slack;
  std::vector<BodyList<S>> out(lent.size());
  std::vector<int> found, buffer;
  for (std::size_t k = 0; k < grains.size(); ++k) {
    find_ranks(decomposition, cell, cell.wrap(grains.bodies.pose[k].position), radius[k] + around,
               found, buffer);
    for (const int rank : found) {
      if (rank == processes.rank()) continue;
      out[std::size_t(rank)].add(grains, k);
      lent[std::size_t(rank)].push_back(grains.bodies.id[k]);
    }
  }
  for (std::vector<BodyId>& list : lent) std::sort(list.begin(), list.end());
  std::vector<std::string> bytes;
  for (BodyList<S>& one : out) bytes.push_back(one.size() == 0 ? std::string() : packed(one));
  const std::vector<std::string> in = processes.exchange(std::move(bytes));
  std::vector<BodyList<S>> ghosts(lent.size());
  for (std::size_t rank = 0; rank < in.size(); ++rank)
    if (!in[rank].empty()) unpack(in[rank], ghosts[rank]);
  shapes.fetch(ghosts, processes);
  return ghosts;
}

}  // namespace moreau::detail
