// SPDX-License-Identifier: MIT
// The sweeps of the overlap correction find the mass-weighted smallest shift.
#include "moreau/world/overlap_correction.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <doctest/doctest.h>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "moreau/solve/body_chunks.hpp"

#include "solve/assembly.hpp"
#include "threads/eager_team.hpp"
#include "types.hpp"

using namespace solve_test;

namespace {

/// Gaps of which a share are deep and the others closed or open [m].
template <class S>
void set_gaps(Assembly<S>& assembly, std::uint64_t seed, unsigned every) {
  using T = typename S::Scalar;
  std::mt19937_64 random(seed);
  std::normal_distribution<T> normal;
  for (Contact<S>& contact : assembly.contacts)
    contact.gap = random() % every == 0 ? T(-1e-3) * std::abs(normal(random))
                                        : T(3e-4) * std::abs(normal(random));
}

OverlapCorrectionOptions sweeps_only(int sweeps) {
  OverlapCorrectionOptions options;
  options.islands = false;
  options.sweeps = sweeps;
  options.max_shift = 1e3;
  return options;
}

/// The contacts in the order of the sweeps: inside the chunks of bodies, chunk after chunk, then between chunks.
template <class S>
std::vector<std::size_t> order_of(const Assembly<S>& assembly) {
  detail::BodyChunks chunks;
  chunks.assign(assembly.roots.size(), detail::OverlapSweeps<S>::bodies_of_chunk);
  std::vector<std::pair<std::uint32_t, std::size_t>> order;
  for (std::size_t c = 0; c < assembly.contacts.size(); ++c) {
    const Contact<S>& contact = assembly.contacts[c];
    const auto moves = [&](std::uint32_t i) { return assembly.op.inverse_mass(i).moves(); };
    order.emplace_back(chunks.of_pair(contact.a, contact.b, moves(contact.a), moves(contact.b)), c);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> contacts;
  for (const auto& [chunk, c] : order) contacts.push_back(c);
  return contacts;
}

/// The same problem, contact after contact, without leaving out any.
template <class S>
std::vector<typename S::Twist> plain_shifts(const Assembly<S>& assembly,
                                            const OverlapCorrectionOptions& options) {
  using T = typename S::Scalar;
  std::vector<typename S::Twist> shifts(assembly.roots.size(), S::Twist::Zero());
  std::vector<T> pushes(assembly.contacts.size(), 0);
  const std::vector<std::size_t> order = order_of(assembly);
  for (int k = 0; k < options.sweeps; ++k)
    for (const std::size_t c : order) {
      const Contact<S>& contact = assembly.contacts[c];
      const typename S::Vector n = contact.frame.col(0);
      const T depth = -(contact.gap + T(options.slop));
      const T closing = relative_velocity(contact, shifts[contact.a], shifts[contact.b])[0];
      const T missing = (depth > 0 ? T(options.rate) * depth : depth) - closing;
      const T push = std::max(T(0), pushes[c] + missing / assembly.op.normal(c)),
              change = push - std::exchange(pushes[c], push);
      for (const bool is_a : {true, false}) {
        const std::uint32_t body = is_a ? contact.a : contact.b;
        const InverseMass<S>& mass = assembly.op.inverse_mass(body);
        const typename S::Vector along = (is_a ? -change : change) * n;
        linear<S>(shifts[body]) += mass.velocity_of(along);
        angular<S>(shifts[body]) +=
            mass.spin_of(S::moment(is_a ? contact.lever_a : contact.lever_b, along));
      }
    }
  return shifts;
}

template <class S>
void check_gaps(const Assembly<S>& assembly, const OverlapCorrection<S>& correction,
                double rounding) {
  for (std::size_t c = 0; c < assembly.contacts.size(); ++c) {
    const Contact<S>& contact = assembly.contacts[c];
    const double change = double(relative_velocity(contact, correction.shifts()[contact.a],
                                                   correction.shifts()[contact.b])[0]);
    CHECK(double(contact.gap) + double(correction.gap_change(contact)) ==
          doctest::Approx(double(contact.gap) + change).epsilon(rounding));
  }
}

/// Compares the shifts with those of the plain loop.
/// @param rounding largest difference relative to the shifts
template <class S>
void check_shifts(Assembly<S> assembly, unsigned every, int sweeps, double rounding) {
  set_gaps(assembly, 5, every);
  const OverlapCorrectionOptions options = sweeps_only(sweeps);
  const auto expected = plain_shifts(assembly, options);
  OverlapCorrection<S> correction(options);
  const auto report = correction.solve(assembly.op, assembly.contacts, 1);
  CHECK(report.corrected > 5);
  double square = 0, norm = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    square += double((correction.shifts()[i] - expected[i]).squaredNorm());
    norm += double(expected[i].squaredNorm());
  }
  CHECK(norm > 0);
  CHECK(std::sqrt(square / norm) <= rounding);
  check_gaps(assembly, correction, rounding);
}

}  // namespace

TEST_CASE_TEMPLATE("overlap correction: the smallest shift, with few and with many deep contacts",
                   S, MOREAU_TYPES((Space<3>), (Space<2>, Space<3, float>))) {
  using T = typename S::Scalar;
  const double rounding = sizeof(T) == 8 ? 1e-7 : 2e-3;
  for (const unsigned every : {1U, 3U, 30U}) {
    check_shifts(Assembly<S>(2, true, T(1e-3)), every, 4000, rounding);
    check_shifts(Assembly<S>::lattice(20, 3), every, 4000, rounding);
  }
}

TEST_CASE_TEMPLATE("overlap correction: ten sweeps are those of the plain loop", S,
                   MOREAU_TYPES((Space<3>), (Space<2>, Space<3, float>))) {
  const double rounding = sizeof(typename S::Scalar) == 8 ? 1e-12 : 1e-4;
  for (const int sweeps : {1, 10}) check_shifts(Assembly<S>::lattice(40, 4), 1, sweeps, rounding);
  check_shifts(Assembly<S>(2, true, typename S::Scalar(1e-3)), 1, 10, rounding);
}

TEST_CASE_TEMPLATE("overlap correction: threads change no bit", S,
                   MOREAU_TYPES((Space<3>), (Space<2>))) {
  using T = typename S::Scalar;
  auto assembly = Assembly<S>::lattice(50, 4, T(1e-4));
  CHECK(assembly.contacts.size() > 4096);  // below, the sweeps are not shared
  set_gaps(assembly, 5, 2);
  std::vector<typename S::Twist> alone;
  for (const int threads : {1, 2, 3, 8}) {
    OverlapCorrection<S> correction(sweeps_only(10));
    const auto report =
        correction.solve(assembly.op, assembly.contacts, T(1), threads_test::eager(threads));
    CHECK(report.corrected > 2000);
    if (threads == 1) alone.assign(correction.shifts().begin(), correction.shifts().end());
    CHECK(std::equal(alone.begin(), alone.end(), correction.shifts().begin()));
  }
}
