// SPDX-License-Identifier: MIT
#include "decompose.hpp"

#include <span>
#include <stdexcept>

#if defined(SCAN_TO_GRAIN_HACD)
#include <hacdHACD.h>

bool can_decompose() {
  return true;
}

std::vector<moreau::Polyhedron<>> decompose(const moreau::TriangleMesh<>& mesh,
                                            const DecompositionLimits& limits) {
  const double size = size_of(mesh);
  std::vector<HACD::Vec3<HACD::Real>> points;
  for (const auto& x : mesh.vertices) points.emplace_back(x[0] / size, x[1] / size, x[2] / size);
  std::vector<HACD::Vec3<long>> triangles;
  for (const auto& f : mesh.facets) triangles.emplace_back(f[0], f[1], f[2]);

  HACD::HACD hacd;
  hacd.SetPoints(points.data());
  hacd.SetNPoints(points.size());
  hacd.SetTriangles(triangles.data());
  hacd.SetNTriangles(triangles.size());
  hacd.SetNClusters(limits.parts);
  hacd.SetNVerticesPerCH(limits.vertices);
  hacd.SetScaleFactor(1000);  // HACD's own unit: concavities are relative to it
  hacd.SetConcavity(1000 * limits.concavity);
  hacd.SetCompacityWeight(0.1);
  hacd.SetVolumeWeight(0);
  hacd.SetAddExtraDistPoints(true);
  hacd.SetAddFacesPoints(true);
  if (!hacd.Compute()) throw std::runtime_error("HACD found no decomposition");

  std::vector<moreau::Polyhedron<>> parts;
  for (std::size_t c = 0; c < hacd.GetNClusters(); ++c) {
    std::vector<HACD::Vec3<HACD::Real>> corners(hacd.GetNPointsCH(c));
    std::vector<HACD::Vec3<long>> faces(hacd.GetNTrianglesCH(c));
    hacd.GetCH(c, corners.data(), faces.data());
    std::vector<Eigen::Vector3d> hull;
    for (auto& x : corners) hull.push_back(size * Eigen::Vector3d(x.X(), x.Y(), x.Z()));
    parts.emplace_back(std::span<const Eigen::Vector3d>(hull));
  }
  return parts;
}

#else

bool can_decompose() {
  return false;
}

std::vector<moreau::Polyhedron<>> decompose(const moreau::TriangleMesh<>&,
                                            const DecompositionLimits&) {
  throw std::runtime_error("built without HACD (Debian: libbullet-extras-dev)");
}

#endif
