// SPDX-License-Identifier: MIT
// Contact problems for the benchmarks of solvers, all from fixed seeds: steps of packings, of the
// study's box and of masonry, with the warm start of the step; and problems from files (matrices
// without bodies). They are compiled once, in a library. Compiled in each program, they would
// differ by rounding, and the packings would differ after some hundred steps.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "moreau/contact/body_delassus.hpp"
#include "moreau/io/friction_file.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/solve/contact_problem.hpp"

namespace contact_problems {

using namespace moreau;
using Law = SignoriniCoulomb<double>;

/// The problem of one step, as a solver receives it.
template <class S>
struct StepProblem {
  ContactProblem<BodyDelassus<S>, Law> problem;
  std::vector<typename S::Vector> guess;  ///< the warm start
};

/// A problem that is created on first use.
template <class Problem>
struct Named {
  std::string name;
  std::function<const Problem&()> get;

  template <class Make>
  Named(std::string its_name, Make make)
      : name(std::move(its_name)),
        get([make, made = std::make_shared<std::optional<Problem>>()]() -> const Problem& {
          if (!*made) made->emplace(make());
          return **made;
        }) {}
  /// Whether its creation takes minutes to hours.
  bool is_large() const { return name.starts_with("large/"); }
};

/// @tparam ShapeT shape of grains and blocks: Polyhedron<> or Polygon<>
template <class ShapeT>
std::vector<Named<StepProblem<SpaceOf<ShapeT>>>> step_problems();

/// Problems from the test data of Siconos; see tests/data/fclib/README.md.
std::vector<Named<AnyFrictionProblem>> file_problems();

}  // namespace contact_problems
