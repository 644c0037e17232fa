// SPDX-License-Identifier: MIT
// The core of moreau in one include: shapes, Coulomb's law, the default solver, Simulation. All
// else is taken singly: further laws and solvers, drives (boundary/), instruments (measure/),
// samples (sample/), files (io/), threads.
#pragma once

#include "moreau/law/materials.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/capsule.hpp"
#include "moreau/shape/half_space.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/shape/rounded.hpp"
#include "moreau/solve/coloured_gauss_seidel.hpp"
#include "moreau/version.hpp"
#include "moreau/world/simulation.hpp"
