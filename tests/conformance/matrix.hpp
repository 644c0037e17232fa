// SPDX-License-Identifier: MIT
// Tests one shape, or a mixture of shapes, under every law of the library. Each law is combined
// with the integrators, broad phases and solvers that are allowed for it. Most of what takes long to compile
// depends on the space and the law alone: test all shapes of one space in one file (tests/matrix).
#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>
#include <vector>

#include "moreau/detect/broad/cell_grid.hpp"
#include "moreau/law/bonded.hpp"
#include "moreau/law/bridges.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/frictionless.hpp"
#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/law/tangential_restitution.hpp"
#include "moreau/motion/moreau_jean.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"

#include "conformance/world.hpp"

namespace conformance {

/// Spring laws that are stiff enough for drops of a few centimetres, with a step of 1e-5 s.
/// @param mass mass of a grain [kg]
template <class T>
moreau::LinearSpringDashpot<T> stiff_springs(T mass) {
  return moreau::LinearSpringDashpot<T>(T(4e7) * mass, T(3e7) * mass, T(0.4), T(0.5));
}
template <class T>
moreau::HertzMindlin<T> stiff_spheres(T mass) {
  return moreau::HertzMindlin<T>::of_material(T(4e10) * mass, T(0.3), T(0.4), T(0.5));
}

/// Moreau-Jean with theta = 1.
struct Implicit : moreau::MoreauJean {
  Implicit() : MoreauJean(1) {}
};

/// The mass of the lightest shape [kg].
template <class ShapeT>
typename moreau::SpaceOf<ShapeT>::Scalar lightest(const std::vector<ShapeT>& shapes) {
  using T = typename moreau::SpaceOf<ShapeT>::Scalar;
  T mass = std::numeric_limits<T>::infinity();
  for (const ShapeT& shape : shapes) mass = std::min(mass, shape.mass_properties(T(1000)).mass);
  return mass;
}

/// Laws without attraction, with the integrators, broad phases and solvers that are allowed for them.
/// @param shapes shapes with a size of about one centimetre
/// @param size   diameter of a ball that contains any of the shapes [m]
template <class ShapeT>
void laws_of_pushes(const std::vector<ShapeT>& shapes,
                    typename moreau::SpaceOf<ShapeT>::Scalar size) {
  using T = typename moreau::SpaceOf<ShapeT>::Scalar;
  const moreau::SignoriniCoulomb<T> coulomb(T(0.4));
  const moreau::RollingResistance<T> rolling(T(0.4), T(0.1));
  const T mass = lightest(shapes);
  SUBCASE("SignoriniCoulomb") {
    world(shapes, coulomb, size);
  }
  SUBCASE("SignoriniCoulomb, theta = 1") {
    world<With<Implicit>>(shapes, coulomb, size);
  }
  SUBCASE("SignoriniCoulomb, plain sweeps") {
    using Space = moreau::SpaceOf<ShapeT>;
    world<With<void, moreau::CellGrid<Space>, moreau::NonlinearGaussSeidel>>(shapes, coulomb, size);
  }
  SUBCASE("SignoriniCoulomb with restitution and static friction") {
    world(shapes, moreau::SignoriniCoulomb<T>(T(0.3), T(0.5), T(0.4)), size);
  }
  SUBCASE("Frictionless") {
    world(shapes, moreau::Frictionless<T>(), size);
  }
  SUBCASE("TangentialRestitution") {
    world(shapes, moreau::TangentialRestitution<T>(T(0.3), T(0.8), T(0.4)), size);
  }
  SUBCASE("Compliant") {
    world(shapes, moreau::Compliant<moreau::SignoriniCoulomb<T>>(coulomb, T(1e9) * mass), size);
  }
  SUBCASE("RollingResistance") {
    world(shapes, moreau::RollingResistance<T>(T(0.4), T(0.1)), size);
  }
  SUBCASE("Compliant RollingResistance") {
    world(shapes, moreau::Compliant<moreau::RollingResistance<T>>(rolling, T(1e9) * mass), size);
  }
  SUBCASE("LinearSpringDashpot") {
    world(shapes, conformance::stiff_springs<T>(mass), size);
  }
  SUBCASE("HertzMindlin") {
    world(shapes, conformance::stiff_spheres<T>(mass), size);
  }
}

/// The same for laws that attract: cohesion, bridges and bonds.
template <class ShapeT>
void laws_of_attraction(const std::vector<ShapeT>& shapes,
                        typename moreau::SpaceOf<ShapeT>::Scalar size) {
  using T = typename moreau::SpaceOf<ShapeT>::Scalar;
  using Water = moreau::CapillaryBridge<T>;
  using Linear = moreau::LinearCohesion<T>;
  const moreau::SignoriniCoulomb<T> coulomb(T(0.4));
  const moreau::RollingResistance<T> rolling(T(0.4), T(0.1));
  const T mass = lightest(shapes);
  SUBCASE("Cohesive") {
    world(shapes, moreau::Cohesive<moreau::SignoriniCoulomb<T>>(coulomb, T(1e-3)), size);
  }
  SUBCASE("Cohesive with static friction") {
    const moreau::SignoriniCoulomb<T> sticky(T(0.3), T(0), T(0.4));
    world(shapes, moreau::Cohesive<moreau::SignoriniCoulomb<T>>(sticky, T(1e-3), T(1e-4)), size);
  }
  SUBCASE("Cohesive without friction") {
    world(shapes, moreau::Cohesive<moreau::Frictionless<T>>(moreau::Frictionless<T>(), T(1e-3)),
          size);
  }
  SUBCASE("Cohesive with rolling resistance") {
    world(shapes, moreau::Cohesive<moreau::RollingResistance<T>>(rolling, T(1e-3)), size);
  }
  SUBCASE("Cohesive holds grains together") {
    using Law = moreau::Cohesive<moreau::SignoriniCoulomb<T>>;
    hang(
        shapes, [&](T attraction) { return Law(coulomb, attraction); }, size);
  }
  SUBCASE("Bridged") {
    world(shapes, moreau::Bridged<Water, moreau::SignoriniCoulomb<T>>(Water(T(1e-12)), coulomb),
          size);
  }
  SUBCASE("Compliant Bridged") {
    using Wet = moreau::Bridged<Linear, moreau::RollingResistance<T>>;
    const Wet wet(Linear(T(1e-4), T(1e-4)), rolling);
    world(shapes, moreau::Compliant<Wet>(wet, T(1e9) * mass), size);
  }
  SUBCASE("Bonded") {
    const auto law_of = [](T strength) {
      return moreau::Bonded<T>({strength, strength, strength}, T(0.4), T(0.1));
    };
    world(shapes, law_of(T(1)), size);
    bonded(shapes, law_of, size);
  }
  SUBCASE("Bonded with a fracture energy") {
    const auto law_of = [](T strength) {
      return moreau::Bonded<T>({strength, strength, strength, T(1e-9)}, T(0.4), T(0.1));
    };
    world(shapes, law_of(T(1)), size);
    bonded(shapes, law_of, size);
  }
  SUBCASE("Compliant Bonded") {
    const auto law_of = [mass](T strength) {
      const moreau::Bonded<T> bonds({strength, strength, strength, T(1e-9)}, T(0.4), T(0.1));
      return moreau::Compliant<moreau::Bonded<T>>(bonds, T(1e9) * mass);
    };
    world(shapes, law_of(T(1)), size);
    bonded(shapes, law_of, size);
  }
}

/// The pairs of a wrapper and a law (tests/static/laws.cpp) that the functions above leave out.
template <class ShapeT>
void other_pairs(const std::vector<ShapeT>& shapes, typename moreau::SpaceOf<ShapeT>::Scalar size) {
  using T = typename moreau::SpaceOf<ShapeT>::Scalar;
  using Coulomb = moreau::SignoriniCoulomb<T>;
  using Smooth = moreau::Frictionless<T>;
  using Rolling = moreau::RollingResistance<T>;
  using Walton = moreau::TangentialRestitution<T>;
  const Coulomb coulomb(T(0.4));
  const Smooth smooth;
  const Rolling rolling(T(0.4), T(0.1));
  const Walton walton(T(0.3), T(0.8), T(0.4));
  const moreau::CapillaryBridge<T> water(T(1e-12));
  const moreau::LinearCohesion<T> linear(T(1e-4), T(1e-4));
  const T stiffness = T(1e9) * lightest(shapes);
  const auto cohesive = [](const auto& law) {
    return moreau::Cohesive<std::decay_t<decltype(law)>>(law, T(1e-3));
  };
  const auto bridged = [](const auto& bridge, const auto& law) {
    using Bridge = std::decay_t<decltype(bridge)>;
    return moreau::Bridged<Bridge, std::decay_t<decltype(law)>>(bridge, law);
  };
  const auto run = [&](const auto& law) { world(shapes, law, size); };
  const auto run_with_springs = [&](const auto& law) {
    run(moreau::Compliant<std::decay_t<decltype(law)>>(law, stiffness));
  };
  SUBCASE("Cohesive with a tangential restitution") {
    run(cohesive(walton));
  }
  SUBCASE("Capillary bridges without friction") {
    run(bridged(water, smooth));
  }
  SUBCASE("Capillary bridges with rolling resistance") {
    run(bridged(water, rolling));
  }
  SUBCASE("Capillary bridges with a tangential restitution") {
    run(bridged(water, walton));
  }
  SUBCASE("Linear cohesion with friction") {
    run(bridged(linear, coulomb));
  }
  SUBCASE("Linear cohesion without friction") {
    run(bridged(linear, smooth));
  }
  SUBCASE("Linear cohesion with rolling resistance") {
    run(bridged(linear, rolling));
  }
  SUBCASE("Linear cohesion with a tangential restitution") {
    run(bridged(linear, walton));
  }
  SUBCASE("Springs without friction") {
    run_with_springs(smooth);
  }
  SUBCASE("Springs, cohesive with friction") {
    run_with_springs(cohesive(coulomb));
  }
  SUBCASE("Springs, cohesive without friction") {
    run_with_springs(cohesive(smooth));
  }
  SUBCASE("Springs, cohesive with rolling resistance") {
    run_with_springs(cohesive(rolling));
  }
  SUBCASE("Springs and capillary bridges with friction") {
    run_with_springs(bridged(water, coulomb));
  }
  SUBCASE("Springs and capillary bridges without friction") {
    run_with_springs(bridged(water, smooth));
  }
  SUBCASE("Springs and capillary bridges with rolling resistance") {
    run_with_springs(bridged(water, rolling));
  }
  SUBCASE("Springs and linear cohesion with friction") {
    run_with_springs(bridged(linear, coulomb));
  }
  SUBCASE("Springs and linear cohesion without friction") {
    run_with_springs(bridged(linear, smooth));
  }
}

/// Those with and without attraction. Subcases of doctest: the test case runs once for each.
template <class ShapeT>
void all_laws(const std::vector<ShapeT>& shapes, typename moreau::SpaceOf<ShapeT>::Scalar size) {
  laws_of_pushes(shapes, size);
  laws_of_attraction(shapes, size);
}
template <moreau::Shape ShapeT>
void all_laws(const ShapeT& shape, typename moreau::SpaceOf<ShapeT>::Scalar size) {
  all_laws(std::vector<ShapeT>{shape}, size);
}

}  // namespace conformance
