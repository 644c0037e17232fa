// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "moreau/contact/contact.hpp"
#include "moreau/law/materials.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/solve/concepts.hpp"
#include "moreau/world/cell_motion.hpp"

namespace moreau::detail {

/// The data that the stages of one step of a Simulation read and write.
template <class S, class Law>
struct StepContext {
  Bodies<S>& bodies;
  const typename S::Vector& gravity;  ///< world axes [m/s^2]
  const Materials<Law>& materials;
  const ContactsOf<Law, S>& previous;  ///< contacts of the step before, with their impulses
  ContactsOf<Law, S>& contacts;        ///< contacts of this step
  typename S::Scalar grain_size;       ///< length that tolerances are relative to [m]
  typename S::Scalar step;             ///< h [s]
  typename S::Scalar
      margin;  ///< that tolerances of detection follow from [m]; bridges reach farther
  /// Second-order terms of the relative velocity of each contact, world axes [m/s]; empty if
  /// none has any (chord_velocities.hpp).
  std::span<const typename S::Vector> chords = {};
  const CellMotion<S>* cell = nullptr;  ///< of a periodic cell that can deform; null: none
  /// Whether the periodic cell deforms in this step.
  bool deforms() const { return cell != nullptr && cell->is_active(); }
};

}  // namespace moreau::detail
