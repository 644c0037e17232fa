// SPDX-License-Identifier: MIT
// The force chains: each contact as a segment between the centres of its two bodies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/periodic_cell.hpp"
#include "moreau/measure/detail/of_simulation.hpp"

namespace moreau {

/// One contact point, with the segment between the centres of its two bodies. A wall has no centre;
/// if a body is a wall, the segment ends at the contact point. All vectors are in world axes.
template <class S>
struct ContactSegment {
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  std::uint32_t a;             ///< index of the first body
  std::uint32_t b;             ///< index of the second body
  Vector from;                 ///< centre of a [m]
  Vector to;                   ///< centre of b [m]
  Vector point;                ///< contact point [m]
  Scalar normal_force;         ///< normal force, > 0 for compression [N]
  Scalar friction_force;       ///< magnitude of the tangential force [N]
  Scalar gap;                  ///< signed gap [m], < 0 means penetration
  ContactClass contact_class;  ///< contact class of the pair
};

/// The segment of contact point c, for c < contacts.size().
/// @param step        length of the step [s], > 0, by which impulses are divided; not checked here
/// @param position_of function: index of a body -> its centre of mass in world axes [m]
/// @param is_grain    function: index of a body -> false for a wall
/// @param cell        periodic cell of the simulation. The segment begins at the position of a and
///                    ends at the image of b that a is in contact with
/// @throws std::invalid_argument if c is not smaller than the number of contact points
template <class S, int Rows>
ContactSegment<S> contact_segment(const Contacts<S, Rows>& contacts, std::size_t c,
                                  typename S::Scalar step, const auto& position_of,
                                  const auto& is_grain, const PeriodicCell<S>& cell = {}) {
  require(c < contacts.size(), "contact_segment", "c", c, "must be below the number of contacts");
  const Contact<S>& contact = contacts.points[c];
  const typename S::Vector& impulse = contacts.impulse(c);
  const std::uint32_t grain = is_grain(contact.a) ? contact.a : contact.b;
  const typename S::Vector point =
      position_of(grain) + (grain == contact.a ? contact.lever_a : contact.lever_b);
  ContactSegment<S> segment{contact.a,
                            contact.b,
                            point,
                            point,
                            point,
                            impulse[0] / step,
                            impulse.template tail<S::dim - 1>().norm() / step,
                            contact.gap,
                            contacts.classes[c]};
  if (is_grain(contact.a)) segment.from = position_of(contact.a);
  if (is_grain(contact.b))
    segment.to = cell.nearest(position_of(contact.b), point - contact.lever_b);
  return segment;
}

namespace detail {

/// Replaces the contents of `segments` by the segments of the contact points that a filter takes.
/// @param takes function: normal impulse of a contact point [N s] -> whether it is taken
template <class S, int Rows>
void list_segments(const Contacts<S, Rows>& contacts, typename S::Scalar step,
                   const auto& position_of, const auto& is_grain, const PeriodicCell<S>& cell,
                   const auto& takes, std::vector<ContactSegment<S>>& segments) {
  segments.clear();
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (takes(contacts.impulses[c][0]))
      segments.push_back(contact_segment(contacts, c, step, position_of, is_grain, cell));
}

}  // namespace detail

/// Replaces the contents of `segments` by the segments of all contact points with normal force > 0,
/// in the order of `contacts`. The arguments are those of contact_segment().
/// @throws std::invalid_argument if the step is not finite or not positive
template <class S, int Rows>
void force_chains(const Contacts<S, Rows>& contacts, typename S::Scalar step,
                  const auto& position_of, const auto& is_grain,
                  std::vector<ContactSegment<S>>& segments, const PeriodicCell<S>& cell = {}) {
  require_positive(step, "force_chains", "step");
  detail::list_segments(
      contacts, step, position_of, is_grain, cell, [](auto impulse) { return impulse > 0; },
      segments);
}

/// Replaces the contents of `segments` by the segments of all contact points, including points
/// without force. The arguments are those of contact_segment().
/// @throws std::invalid_argument if the step is not finite or not positive
template <class S, int Rows>
void contact_segments(const Contacts<S, Rows>& contacts, typename S::Scalar step,
                      const auto& position_of, const auto& is_grain,
                      std::vector<ContactSegment<S>>& segments, const PeriodicCell<S>& cell = {}) {
  require_positive(step, "contact_segments", "step");
  detail::list_segments(
      contacts, step, position_of, is_grain, cell, [](auto) { return true; }, segments);
}

/// The segments of those contact points of a simulation that have a normal force > 0 in its last step.
/// @param simulation a Simulation
/// @param step       length of its last step [s], > 0
/// @throws std::invalid_argument if the step is not finite or not positive, or a hundred times longer or shorter than
///         the last one
template <class Simulation>
std::vector<ContactSegment<typename Simulation::S>> force_chains(const Simulation& simulation,
                                                                 typename Simulation::Scalar step) {
  require_positive(step, "force_chains", "step");
  detail::require_unit_of_step(simulation, step, "force_chains");
  std::vector<ContactSegment<typename Simulation::S>> segments;
  force_chains(simulation.contacts(), step, detail::position_in(simulation),
               detail::grain_in(simulation), segments, simulation.cell());
  return segments;
}

/// The segments of all contact points of a simulation.
/// @param simulation a Simulation
/// @param step       length of its last step [s], > 0
/// @throws std::invalid_argument if the step is not finite or not positive, or a hundred times longer or shorter than
///         the last one
template <class Simulation>
std::vector<ContactSegment<typename Simulation::S>> contact_segments(
    const Simulation& simulation, typename Simulation::Scalar step) {
  require_positive(step, "contact_segments", "step");
  detail::require_unit_of_step(simulation, step, "contact_segments");
  std::vector<ContactSegment<typename Simulation::S>> segments;
  contact_segments(simulation.contacts(), step, detail::position_in(simulation),
                   detail::grain_in(simulation), segments, simulation.cell());
  return segments;
}

namespace detail {

/// The length of the last step of a simulation [s], for a file with forces; 1 if there are no contacts.
/// @param contacts their number, in all processes
/// @throws std::invalid_argument if it is not known: the simulation was read from a snapshot or gathered
template <class Simulation>
double known_step(const Simulation& simulation, double contacts, const char* function) {
  const auto step = double(simulation.last_step());
  require(step > 0 || contacts == 0, function, "contacts", contacts,
          "need the length of the step as an argument: the simulation was read or gathered, and "
          "has made none since");
  return step > 0 ? step : 1;
}

}  // namespace detail

}  // namespace moreau
