// SPDX-License-Identifier: MIT
// The contact problems of the benches of solvers, all from fixed seeds: steps of packings, of the
// study's driven box and of masonry, with the warm start that the step had; and problems from
// files, which have matrices and no bodies. They are made in a library, so that all programs have
// the same: what a compiler makes of a sum elsewhere is another packing after some hundred steps.
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

/// The problem of one step, as a solver gets it.
template <class S>
struct StepProblem {
  ContactProblem<BodyDelassus<S>, Law> problem;
  std::vector<typename S::Vector> guess;  ///< the warm start
};

/// A problem that is made when it is first asked for.
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
  /// It takes minutes to hours to make.
  bool is_large() const { return name.starts_with("large/"); }
};

/// @tparam ShapeT of the grains and blocks, Polyhedron<> or Polygon<>
template <class ShapeT>
std::vector<Named<StepProblem<SpaceOf<ShapeT>>>> step_problems();

/// Those from the test data of Siconos; see tests/data/fclib/README.md.
std::vector<Named<AnyFrictionProblem>> file_problems();

}  // namespace contact_problems
