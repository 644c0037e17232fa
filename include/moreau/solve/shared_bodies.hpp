// SPDX-License-Identifier: MIT
// Bodies that several contact problems share. A distributed simulation (moreau/distributed) has one
// contact problem per process. A body that has contacts in n of them is split into n copies, each
// with an n-th of the mass, so that each process solves an ordinary contact problem. After every
// sweep the copies get the mean of their velocities. This is mass splitting (R. Tonge, F. Benevolenski
// and A. Voroshilov, ACM Trans. Graph. 31 (2012) 105). It does not change the solution: with the
// impulses r_p of process p, J_p the rows of its contacts and M the mass of the body,
//
//     mean over p of (M/n)^-1 J_p^T r_p  =  M^-1 sum over p of J_p^T r_p,
//
// so that copies with equal velocities move as the whole body does under all of its contacts. For
// frictionless contacts each sweep with a mean lowers the energy that the solution minimizes.
#pragma once

#include <cstddef>
#include <span>

namespace moreau {

/// The sums and means over processes that the contact problem of one process needs. All processes call
/// the functions that communicate in the same order.
class SharedBodies {
 public:
  virtual ~SharedBodies() = default;

  /// Finds the shared bodies of a step. Communicates.
  /// @param touched one entry per body: whether it can move and has a contact in this process
  virtual void find(std::span<const unsigned char> touched) = 0;
  /// The number n >= 1 of copies of a body since the last find().
  virtual int copies(std::size_t body) const = 0;
  /// Whether this process counts the body in sums over all bodies; exactly one process does.
  virtual bool owns(std::size_t body) const = 0;

  /// Replaces the velocities of every shared body by their mean over its copies. Communicates.
  /// @param velocities `width` numbers per body, of which the first D + A are used
  virtual void average(std::span<double> velocities, std::size_t width) = 0;
  virtual void average(std::span<float> velocities, std::size_t width) = 0;  ///< the same
  /// Replaces each value by its sum over all processes, with the same bits in all. Communicates.
  virtual void sum(std::span<double> values) = 0;
  /// Replaces each value by its largest over all processes. Communicates.
  virtual void largest(std::span<double> values) = 0;
};

namespace detail {

/// The sum of a value over all processes that share bodies; the value itself without them.
inline double sum_over(SharedBodies* shared, double value) {
  if (shared) shared->sum({&value, 1});
  return value;
}

/// Replaces the velocities of every shared body by their mean over its copies. Communicates.
/// @param twists in, out: one per body [m/s, rad/s]
template <class S>
void average_twists(SharedBodies& shared, std::span<typename S::Twist> twists) {
  using Scalar = typename S::Scalar;
  const std::size_t width = S::dofs;
  Scalar* const first = twists.empty() ? nullptr : twists[0].data();
  shared.average(std::span<Scalar>(first, twists.size() * width), width);
}

}  // namespace detail

}  // namespace moreau
