// SPDX-License-Identifier: MIT
// Frictionless grains compressed by the walls of a box.
#pragma once

#include <random>

#include "moreau/measure/coordination.hpp"
#include "moreau/measure/solid_fraction.hpp"

#include "scene.hpp"

namespace validation {

struct Packing {
  double fraction;      ///< solid fraction, away from the walls
  double coordination;  ///< mean contacts per grain, walls included, rattlers excluded
  double overlap;       ///< mean, relative to the size
  bool settled;
};

namespace detail {

/// Spheres at random positions without overlap in a box. Then three (in the plane two) of the walls
/// compress them.
template <class ShapeT, class Law>
class Compression {
 public:
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  static constexpr double size = 1, pressure = 1, density = 1;

  /// @param ratio size of the larger half of the grains / size of the smaller half
  Compression(std::size_t count, double ratio, std::uint64_t seed, const Law& law)
      : world_(world_of<ShapeT, Law>(size, law, {.tolerance = 1e-5, .max_sweeps = 3000},
                                     {.margin = 0.05})) {
    std::mt19937_64 random(seed);
    double solid = 0;
    for (std::size_t k = 0; k < count; ++k) {
      radii_.push_back(k % 2 ? ratio * size / 2 : size / 2);
      solid += ShapeT(radii_.back()).volume();
    }
    side_ = std::pow(solid / (S::dim == 3 ? 0.28 : 0.45), 1.0 / S::dim);
    std::sort(radii_.rbegin(), radii_.rend());
    for (const double radius : radii_) {
      places_.push_back(free_place(radius, random));
      world_.add_grain(world_.add_shape(ShapeT(radius)), {places_.back()}, density);
    }
    for (int axis = 0; axis < S::dim; ++axis) {
      world_.add_wall(Vector::Unit(axis), Vector::Zero());
      pistons_.push_back(world_.add_wall(-Vector::Unit(axis), side_ * Vector::Unit(axis)));
      world_.set_wall_mass(pistons_.back(), solid * density / 4);
    }
  }

  /// Runs until only rattlers move, or until the time limit.
  Packing press(double step, double time) {
    bool settled = false;
    for (int k = 0; !settled && world_.time() < time; ++k) {
      press_walls();
      world_.step(step);
      settled = k > 100 && k % 50 == 0 && still();
    }
    return {fraction(), coordination(), mean_overlap(), settled};
  }

 private:
  Vector free_place(double radius, std::mt19937_64& random) const {
    std::uniform_real_distribution<double> any(radius, side_ - radius);
    for (;;) {
      Vector x;
      for (int axis = 0; axis < S::dim; ++axis) x[axis] = any(random);
      bool free = true;
      for (std::size_t k = 0; k < places_.size() && free; ++k)
        free = (x - places_[k]).norm() > radius + radii_[k];
      if (free) return x;
    }
  }
  BodyId piston(int axis) const { return pistons_[std::size_t(axis)]; }
  Vector corner() const {
    Vector x;
    for (int axis = 0; axis < S::dim; ++axis) x[axis] = world_.pose(piston(axis)).position[axis];
    return x;
  }
  void press_walls() {
    const Vector box = corner();
    for (int axis = 0; axis < S::dim; ++axis)
      world_.set_force(piston(axis), -pressure * box.prod() / box[axis] * Vector::Unit(axis));
  }
  /// Whether the walls and 90 % of the grains are at rest, relative to the velocity
  /// sqrt(pressure/density).
  bool still() const {
    std::size_t moving = 0;
    for (const BodyId grain : world_.grains()) moving += world_.velocity(grain).norm() > 1e-5;
    for (int axis = 0; axis < S::dim; ++axis)
      if (world_.bodies().velocity[piston(axis).index()].norm() > 1e-6) return false;
    return moving * 10 < world_.grain_count();
  }
  double fraction() const {
    moreau::Aabb<S> inner{Vector::Constant(2 * size), corner() - Vector::Constant(2 * size)};
    return moreau::solid_fraction(world_, inner);
  }
  /// Contacts with less than a thousandth of the mean force count as open.
  double coordination() const {
    const auto& contacts = world_.contacts();
    std::vector<Vector> impulses = contacts.impulses;
    double mean = 0;
    for (const Vector& r : impulses) mean += r[0] / double(impulses.size());
    for (Vector& r : impulses)
      if (r[0] < 1e-3 * mean) r.setZero();
    moreau::CoordinationCounter<S> counter;
    const auto counted = counter.count(
        contacts.points, impulses, world_.bodies().size(),
        [&](std::size_t i) { return world_.is_grain(i); }, S::dim + 1);
    return 2 * double(counted.pairs) / double(counted.grains);
  }
  double mean_overlap() const {
    double sum = 0;
    std::size_t count = 0;
    for (const auto& contact : world_.contacts().points)
      if (contact.gap < 0) sum -= contact.gap, ++count;
    return count > 0 ? sum / double(count) / size : 0;
  }

  World<ShapeT, Law> world_;
  std::vector<double> radii_;
  std::vector<Vector> places_;
  std::vector<BodyId> pistons_;
  double side_;
};

}  // namespace detail

/// Frictionless spheres jam at random close packing: solid fraction 0.64 for equal spheres (J. D.
/// Bernal and J. Mason, Nature 188 (1960) 910), 0.84 for disks half of which are 1.4 times larger
/// (C. S. O'Hern et al., Phys. Rev. E 68 (2003) 011306). The packing is isostatic: 2 D contacts per
/// grain, rattlers excluded.
template <class ShapeT>
void close_packing(Record& record, double expected, const std::vector<std::size_t>& counts) {
  using S = SpaceOf<ShapeT>;
  Curve& curve = record.curve("close_packing", S{}, {"grains", "fraction", "coordination"});
  Packing packing{};
  for (const std::size_t count : counts) {
    detail::Compression<ShapeT, Frictionless<ShapeT>> sample(count, S::dim == 3 ? 1 : 1.4, count,
                                                             Frictionless<ShapeT>());
    packing = sample.press(0.02, 200);
    curve.rows.push_back({double(count), packing.fraction, packing.coordination});
  }
  const std::string name =
      with_shape<ShapeT>("random close packing of " + std::to_string(counts.back())) + ": ";
  record.compare(name + "solid fraction", S{}, expected, packing.fraction, 0.01);
  record.compare(name + "twice the contacts per grain, walls included", S{}, 2 * S::dim,
                 packing.coordination, 0.1);
  record.compare(name + "at rest", S{}, 1, packing.settled, 0);
}

inline void random_close_packing(Record& record, Effort effort) {
  const bool quick = effort == Effort::quick;
  close_packing<Disk<>>(
      record, 0.84,
      quick ? std::vector<std::size_t>{200} : std::vector<std::size_t>{200, 400, 800});
  close_packing<Ball<>>(
      record, 0.64,
      quick ? std::vector<std::size_t>{300} : std::vector<std::size_t>{300, 600, 1000});
}

/// Packings on springs tend to the packings of contact dynamics as the stiffness grows. Compared is
/// the mean over samples with the same initial positions, for stiffnesses k relative to pressure x
/// size. The coordination exceeds the isostatic 2 D by the square root of the compression (C. S.
/// O'Hern et al., Phys. Rev. E 68 (2003) 011306: exponent 0.49).
template <class ShapeT>
void stiff_springs(Record& record, std::size_t count, int samples) {
  using S = SpaceOf<ShapeT>;
  const double ratio = S::dim == 3 ? 1 : 1.4;
  const auto mean_of = [&](const auto& law, double step) {
    using Law = std::decay_t<decltype(law)>;
    Packing mean{};
    for (int seed = 1; seed <= samples; ++seed) {
      detail::Compression<ShapeT, Law> sample(count, ratio, std::uint64_t(seed), law);
      const Packing one = sample.press(step, 100);
      mean.fraction += one.fraction / samples;
      mean.coordination += one.coordination / samples;
      mean.overlap += one.overlap / samples;
    }
    return mean;
  };
  const Packing rigid = mean_of(Frictionless<ShapeT>(), 0.02);
  Curve& curve = record.curve("stiff_springs", S{},
                              {"stiffness", "fraction", "coordination", "overlap", "rigid"});
  Packing soft{}, softer{};
  std::vector<double> stiffness, overlap, excess;
  for (const double k : {1e2, 1e3, 1e4}) {
    // At most a twentieth of the duration of a contact of two unit spheres.
    softer = soft;
    soft = mean_of(Springs<ShapeT>(k, 0, 0, 0.2), 0.1 / std::sqrt(k));
    curve.rows.push_back({k, soft.fraction, soft.coordination, soft.overlap, rigid.fraction});
    stiffness.push_back(k);
    overlap.push_back(soft.overlap);
    excess.push_back(soft.coordination - 2 * S::dim);
  }
  // The number of contacts that exist only because of overlaps grows with the square root of the
  // overlap.
  const double share = std::sqrt(soft.overlap / softer.overlap);
  const double stiffest = (soft.coordination - share * softer.coordination) / (1 - share);
  const std::string name = with_shape<ShapeT>("stiff springs") + ": ";
  record.compare(name + "solid fraction", S{}, rigid.fraction, soft.fraction, 0.01);
  record.compare(name + "coordination, on to no overlap", S{}, rigid.coordination, stiffest, 0.1);
  if (samples > 1)
    record.compare(name + "order of the coordination above isostatic in overlap", S{}, 0.5,
                   order_of(overlap, excess), 0.1);
  record.compare(name + "order of the overlap in stiffness", S{}, -1, order_of(stiffness, overlap),
                 0.1);
}

inline void stiff_springs_are_rigid(Record& record, Effort effort) {
  const bool quick = effort == Effort::quick;
  stiff_springs<Disk<>>(record, quick ? 100 : 300, quick ? 1 : 3);
  if (!quick) stiff_springs<Ball<>>(record, 600, 2);
}

}  // namespace validation
