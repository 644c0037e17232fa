// SPDX-License-Identifier: MIT
#include "answers.hpp"

#include <map>
#include <stdexcept>

namespace validation {

const Answer& answer_of(const std::string& name) {
  constexpr const char* balance = "the laws of Newton and Euler";
  static const std::map<std::string, Answer> answers{
      {"free_fall",
       {"v = v₀ + g t in every scheme; x = x₀ + v₀ t + g t²/2 at θ = 1/2 and with velocity Verlet, "
        "with an error of g t h/2 at θ = 1",
        "Newton; M. Jean, Comput. Methods Appl. Mech. Eng. 177 (1999) 235, for the scheme"}},
      {"asymmetric_top",
       {"a disturbance of the rotation about the middle axis grows with the rate Ω √((I₂ − I₁)(I₃ "
        "− "
        "I₂)/(I₁ I₃)); angular momentum is conserved, the energy to the order of the scheme",
        "Euler's equations; Landau and Lifshitz, Mechanics, section 37"}},
      {"bouncing_ball",
       {"v′ = −e v at every impact; at rest after √(2 h₀/g) (1 + e)/(1 − e), to the order of h",
        "Newton's restitution; the flights form a geometric series"}},
      {"two_grains",
       {"separate with e v; overlap without damping v √(m/k) on linear springs, (15 m v²/(16 E "
        "√R))^(2/5) "
        "on Hertz's; sticking, vₜ′ = vₜ (1 + k/(1 + k) (cos(π √((1 + 1/k) kₜ/kₙ)) − 1)); m and R "
        "effective, k = I/(m R²)",
        "H. Hertz, J. reine angew. Math. 92 (1882) 156; two linear oscillators of one contact, as "
        "N. "
        "Maw, J. R. Barber and J. N. Fawcett, Wear 38 (1976) 101"}},
      {"incline",
       {"sticks iff tan α ≤ μ, else a = g (sin α − μ cos α)",
        "C. A. de Coulomb, Théorie des machines simples (1785)"}},
      {"slip_to_roll",
       {"from t = v₀ k/((1 + k) μ g) on it rolls at v₀/(1 + k), k = I/(m R²): 5/7 for spheres, 2/3 "
        "for disks",
        "G.-G. Coriolis, Théorie mathématique des effets du jeu de billard (1835)"}},
      {"oblique_impact",
       {"slips iff vₜ/vₙ ≥ (1 + 1/k) μ (1 + e): vₜ falls by μ (1 + e) vₙ; else vₜ′ = vₜ/(1 + k)",
        "W. Goldsmith, Impact (1960)"}},
      {"toppling_block", {"topples iff tan α > b/h, if friction prevents sliding", balance}},
      {"rocking_block",
       {"ω′/ω = 1 − (3/2) sin² α at the change of edge, tan α = b/h",
        "G. W. Housner, Bull. Seismol. Soc. Am. 53 (1963) 403"}},
      {"off_a_ball",
       {"separates at (3 + k) cos φ = 2 cos φ₀: 10/17 for spheres, 4/7 for disks; 2/3 without "
        "friction",
        "energy and the balance along the radius"}},
      {"laws",
       {"static friction: rolls iff a ≤ (1 + 1/k) μₛ N/m; adhesion: falls iff m g > N_a; rolling "
        "resistance: stays iff tan α ≤ η, else a = g (sin α − η cos α)/(1 + k)",
        "K. Iwashita and M. Oda, J. Eng. Mech. 124 (1998) 285, for rolling; else moments about the "
        "point of contact"}},
      {"column", {"contact k of N from the floor carries (N − k) m g h", balance}},
      {"stack", {"three boxes at half the friction angle stay where they are", balance}},
      {"pyramid",
       {"stands iff μ between balls ≥ tan(β/2) and μ of the floor ≥ tan(β/2)/(D + 1); sin β = "
        "1/√3 in space, β = 30° in the plane",
        "moments of one of the lower balls, and the weight of the top one"}},
      {"arch",
       {"a semicircular arch with radial joints stands iff thickness/radius ≥ 0.1075",
        "M. Milankovitch, Z. Math. Phys. 55 (1907) 1; H. Alexakis and N. Makris, Arch. Appl. Mech. "
        "85 (2015) 1363"}},
      {"painleve",
       {"no closed contact has a force where 1 + 3 cos φ (cos φ − μ sin φ) < 0 (slender rod, μ > "
        "4/3); over a step an impulse exists, and the energy does not grow",
        "P. Painlevé, C. R. Acad. Sci. 121 (1895) 112; J.-J. Moreau, Unilateral contact and dry "
        "friction in finite freedom dynamics (1988)"}},
      {"symmetries",
       {"an experiment that is moved and rotated gives the moved and rotated result; another order "
        "of "
        "the bodies gives the same result",
        "Galilean invariance; the order of the bodies is not part of the problem"}},
      {"momentum",
       {"Σ m v and Σ (m x × v + I ω) of free bodies that collide are conserved", balance}},
      {"prisms",
       {"prisms that symmetry keeps in a plane move like their polygons, to 1e-9 over the first "
        "hundred steps",
        "the same equations"}},
      {"balance",
       {"contact forces and weight of every grain at rest add up to zero, and so do their moments",
        balance}},
      {"energy",
       {"without drive and with restitution 0 energy never grows, over 1e5 steps",
        "contacts without restitution dissipate energy"}},
      {"energy_of_fall",
       {"the same while the grains fall, to first order in the step: on contacts that rotate the "
        "velocity before a step points out of the contact frame after it, by v h/R",
        "as for `energy`"}},
      {"close_packing",
       {"frictionless: solid fraction 0.64 of equal spheres, 0.84 of disks of two sizes; 2 D "
        "contacts per grain, rattlers excluded",
        "J. D. Bernal and J. Mason, Nature 188 (1960) 910; C. S. O'Hern et al., Phys. Rev. E 68 "
        "(2003) 011306"}},
      {"stiff_springs",
       {"the packing on springs tends to the rigid packing; the coordination exceeds 2 D by the "
        "square "
        "root of the compression",
        "C. S. O'Hern et al., Phys. Rev. E 68 (2003) 011306"}},
      {"janssen",
       {"σ(z) = ρ g λ (1 − exp(−z/λ))", "H. A. Janssen, Z. Ver. dt. Ing. 39 (1895) 1045"}},
      {"plane_shear",
       {"μ* = 0.25 + 1.1 I for 0.02 ≤ I ≤ 0.2",
        "F. da Cruz, S. Emam, M. Prochnow, J.-N. Roux and F. Chevoir, Phys. Rev. E 72 (2005) "
        "021309"}}};
  const auto found = answers.find(name);
  if (found == answers.end())
    throw std::logic_error("answer_of: name = " + name + " has no formula");
  return found->second;
}

}  // namespace validation
