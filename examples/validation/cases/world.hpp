// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/law/cohesive.hpp"
#include "moreau/law/frictionless.hpp"
#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/sphere.hpp"
#include "moreau/world/simulation.hpp"

// Compiled once, in worlds/.
extern template class moreau::Polyhedron<double>;
extern template class moreau::Polygon<double>;

namespace validation {

using Polyhedron = moreau::Polyhedron<double>;
using Polygon = moreau::Polygon<double>;
using Ball = moreau::Sphere<moreau::Space<3>>;
using Disk = moreau::Sphere<moreau::Space<2>>;

using Coulomb = moreau::SignoriniCoulomb<double>;
using Frictionless = moreau::Frictionless<double>;
using Sticky = moreau::Cohesive<Coulomb>;
using Rolling = moreau::RollingResistance<double>;
using Springs = moreau::LinearSpringDashpot<double>;
using Hertz = moreau::HertzMindlin<double>;

/// A simulation whose step is compiled once for each shape and law, in worlds/, and not again in
/// every case.
template <class ShapeT, class Law = Coulomb>
struct World : moreau::Simulation<ShapeT, Law> {
  using Base = moreau::Simulation<ShapeT, Law>;
  using Base::Base;
  moreau::StepReport step(double step);
};

}  // namespace validation
