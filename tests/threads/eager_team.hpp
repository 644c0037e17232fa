// SPDX-License-Identifier: MIT
// A team that shares all work, for tests of bits.
#pragma once

#include <cstddef>
#include <memory>

#include "moreau/parallel/thread_team.hpp"

namespace threads_test {

/// Lets a team share its work from now on, without measuring whether this is faster.
class EagerThreads final : public moreau::TeamThreads {
 public:
  explicit EagerThreads(int size) : pool_(size) { shares = true; }
  int size() const override { return pool_.size(); }
  void run(const Work& work) override { pool_.run(work); }
  bool begin(moreau::TimedWork) override { return true; }
  void end(moreau::TimedWork, std::size_t) override {}

 private:
  moreau::detail::ThreadPool pool_;
};
inline moreau::Team eager(int size) {
  return moreau::Team(std::make_shared<EagerThreads>(size));
}

}  // namespace threads_test
