// SPDX-License-Identifier: MIT
// Which process owns which part of space: recursive coordinate bisection by Zoltan. Needs MPI and
// Zoltan (Debian: libtrilinos-zoltan-dev).
//
// Space is cut in two by a plane across one axis, so that both sides have equal weight, then each
// side in the same way, until there is one box per rank. The outermost boxes have no outer bound.
// Every rank knows all planes, so that it can tell the owner of any point (M. J. Berger and
// S. H. Bokhari, IEEE Trans. Comput. 36 (1987) 570).
#pragma once

#ifndef OMPI_SKIP_MPICXX
#define OMPI_SKIP_MPICXX 1
#endif
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>
#include <zoltan.h>

#include "moreau/core/aabb.hpp"
#include "moreau/distributed/communicator.hpp"

namespace moreau {

/// A point with a weight, for DomainDecomposition.
template <class S>
struct WeightedPoint {
  typename S::Vector position;  ///< world axes [m]
  float weight = 1;             ///< work that belongs to the point, > 0
};

/// A partition of space into one box per rank.
template <class S>
class DomainDecomposition {
 public:
  using Vector = typename S::Vector;

  /// One box for all until partition() is called: everything is owned by rank 0. All processes call it.
  explicit DomainDecomposition(const Communicator& processes) : size_(processes.size()) {
    float version = 0;
    check(Zoltan_Initialize(0, nullptr, &version), "Zoltan_Initialize");
    zoltan_ = Zoltan_Create(processes.handle());
    if (!zoltan_) throw std::runtime_error("DomainDecomposition: Zoltan_Create fails");
    const auto set = [&](const char* name, const char* value) {
      check(Zoltan_Set_Param(zoltan_, name, value), name);
    };
    set("DEBUG_LEVEL", "0");
    set("LB_METHOD", "RCB");
    set("KEEP_CUTS", "1");
    set("AVERAGE_CUTS", "1");
    set("OBJ_WEIGHT_DIM", "1");
    set("NUM_GID_ENTRIES", "1");
    set("NUM_LID_ENTRIES", "1");
    set("RETURN_LISTS", "NONE");
    set("IMBALANCE_TOL", "1.02");
  }
  ~DomainDecomposition() { Zoltan_Destroy(&zoltan_); }
  DomainDecomposition(const DomainDecomposition&) = delete;
  DomainDecomposition& operator=(const DomainDecomposition&) = delete;

  /// Cuts space anew, so that the boxes have equal weight. All processes call it.
  /// @param points those of this rank; each point is on one rank. At least one rank must have some
  void partition(std::span<const WeightedPoint<S>> points) {
    if (size_ == 1) return;
    points_ = points;
    Zoltan_Set_Num_Obj_Fn(zoltan_, &count_points, this);
    Zoltan_Set_Obj_List_Fn(zoltan_, &list_points, this);
    Zoltan_Set_Num_Geom_Fn(zoltan_, &count_axes, this);
    Zoltan_Set_Geom_Multi_Fn(zoltan_, &list_positions, this);
    int changes = 0, gid = 0, lid = 0, imports = 0, exports = 0;
    ZOLTAN_ID_PTR import_gids = nullptr, import_lids = nullptr, export_gids = nullptr,
                  export_lids = nullptr;
    int *import_ranks = nullptr, *import_parts = nullptr, *export_ranks = nullptr,
        *export_parts = nullptr;
    const int result = Zoltan_LB_Partition(
        zoltan_, &changes, &gid, &lid, &imports, &import_gids, &import_lids, &import_ranks,
        &import_parts, &exports, &export_gids, &export_lids, &export_ranks, &export_parts);
    Zoltan_LB_Free_Part(&import_gids, &import_lids, &import_ranks, &import_parts);
    Zoltan_LB_Free_Part(&export_gids, &export_lids, &export_ranks, &export_parts);
    points_ = {};
    check(result, "Zoltan_LB_Partition");
    is_cut_ = true;
  }

  /// The rank that owns a point, world axes [m]. Every rank gives the same answer.
  int owner(const Vector& point) const {
    if (!is_cut_) return 0;
    double x[3] = {};
    for (int k = 0; k < S::dim; ++k) x[k] = double(point[k]);
    int rank = 0;
    check(Zoltan_LB_Point_Assign(zoltan_, x, &rank), "Zoltan_LB_Point_Assign");
    return rank;
  }
  /// The ranks that own a part of a box [m].
  /// @param ranks out: in no particular order
  void owners(const Aabb<S>& box, std::vector<int>& ranks) const {
    ranks.assign(1, 0);
    if (!is_cut_) return;
    double lower[3] = {}, upper[3] = {};
    for (int k = 0; k < S::dim; ++k) {
      lower[k] = double(box.lower[k]);
      upper[k] = double(box.upper[k]);
    }
    ranks.resize(std::size_t(size_));
    int count = 0;
    check(Zoltan_LB_Box_Assign(zoltan_, lower[0], lower[1], lower[2], upper[0], upper[1], upper[2],
                               ranks.data(), &count),
          "Zoltan_LB_Box_Assign");
    ranks.resize(std::size_t(count));
  }

 private:
  static void check(int result, const char* function) {
    if (result != ZOLTAN_OK && result != ZOLTAN_WARN)
      throw std::runtime_error(std::string("DomainDecomposition: ") + function + " fails");
  }

  // Functions that Zoltan calls; `self` is this object.
  static int count_points(void* self, int* error) {
    *error = ZOLTAN_OK;
    return int(static_cast<DomainDecomposition*>(self)->points_.size());
  }
  static void list_points(void* self, int, int, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, int,
                          float* weights, int* error) {
    const auto& points = static_cast<DomainDecomposition*>(self)->points_;
    for (std::size_t k = 0; k < points.size(); ++k) {
      // Zoltan only hands the ids back, and they are not asked for.
      global[k] = local[k] = static_cast<ZOLTAN_ID_TYPE>(k);
      weights[k] = points[k].weight;
    }
    *error = ZOLTAN_OK;
  }
  static int count_axes(void*, int* error) {
    *error = ZOLTAN_OK;
    return S::dim;
  }
  static void list_positions(void* self, int, int, int count, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local,
                             int axes, double* positions, int* error) {
    const auto& points = static_cast<DomainDecomposition*>(self)->points_;
    for (int i = 0; i < count; ++i)
      for (int k = 0; k < axes; ++k) positions[i * axes + k] = double(points[local[i]].position[k]);
    *error = ZOLTAN_OK;
  }

  Zoltan_Struct* zoltan_ = nullptr;
  int size_;
  bool is_cut_ = false;
  std::span<const WeightedPoint<S>> points_;  // during partition()
};

}  // namespace moreau
