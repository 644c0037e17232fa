// SPDX-License-Identifier: MIT
// Grains are poured on a finite plate, where they form a heap. What falls off is removed. Prints the angle of
// repose: the slope of the free surface when the heap is at rest. The plate is rough; `heap smooth` takes a smooth one.
#include <iostream>
#include <moreau/measure/heap.hpp>
#include <moreau/measure/rest_test.hpp>
#include <moreau/moreau.hpp>
#include <moreau/sample/ballast.hpp>
#include <moreau/sample/random_rotation.hpp>
#include <numbers>
#include <random>
#include <vector>

namespace {

// Or moreau::Polyhedron<double>; without add_smooth_plate(), moreau::Ball<double>, moreau::Disk<double>:
using Shape = moreau::Polygon<double>;
using S = moreau::SpaceOf<Shape>;
using Vector = S::Vector;
using Law = moreau::SignoriniCoulomb<double>;
using Simulation = moreau::Simulation<Shape, Law>;
constexpr int up = S::dim - 1;
constexpr double size = 0.02, plate = 0.2,
                 h = 5e-4;           // circumdiameter of a grain, radius [m]; step [s]
const Vector axis = Vector::Zero();  // of the heap

/// Adds fixed grains on a lattice inside a circle, in the plane a segment: a rough plate.
void add_plate(Simulation& heap, const std::vector<moreau::ShapeId>& shapes) {
  const int side = int(plate / size), count = 2 * side + 1;
  int places = 1;
  for (int k = 0; k < up; ++k) places *= count;
  for (int place = 0; place < places; ++place) {
    Vector x = axis - 0.5 * size * Vector::Unit(up);
    int rest = place;
    for (int k = 0; k < up; ++k, rest /= count) x[k] += size * (rest % count - side);
    if ((x - axis).head(up).norm() > plate) continue;  // outside of the plate
    const moreau::ShapeId shape = shapes[std::size_t(place) % shapes.size()];
    heap.prescribe_motion(heap.add_grain(shape, {x}, 2700));
  }
}

/// The same plate, smooth: one flat obstacle, a square in space. Its upper side is at height 0.
void add_smooth_plate(Simulation& heap) {
  Vector half = Vector::Constant(plate);
  half[up] = size / 2;
  const moreau::ShapeId slab = heap.add_shape(moreau::cuboid<Shape>(half));
  heap.prescribe_motion(heap.add_grain(slab, {axis - half[up] * Vector::Unit(up)}, 2700));
}

/// Removes the grains that fell off the plate.
void remove_fallen(Simulation& heap) {
  std::vector<moreau::BodyId> fallen;
  for (const moreau::BodyId grain : heap.grains())
    if (heap.pose(grain).position[up] < -5 * size) fallen.push_back(grain);
  heap.remove_grains(fallen);
}

/// Height of the highest grain [m].
double top_of(const Simulation& heap) {
  double top = 0;
  for (const Vector& point : moreau::free_surface(heap, size)) top = std::max(top, point[up]);
  return top;
}

}  // namespace

int main(int argc, char**) {
  std::mt19937_64 random(1);
  moreau::Tolerances tolerances;
  tolerances.margin = 0.08;  // of the grain size: in one step a falling grain moves by up to 1.5 mm
  Simulation heap(size, Law(0.5), {}, tolerances);
  std::vector<moreau::ShapeId> shapes;
  for (const Shape& shape : moreau::ballast_shapes<Shape>(20, random))
    shapes.push_back(heap.add_shape(shape.scaled(size / 2)));
  if (argc > 1)
    add_smooth_plate(heap);
  else
    add_plate(heap, shapes);
  heap.set_gravity(-9.81 * Vector::Unit(up));

  // One grain in 20 ms, from two grain sizes above the top, not exactly on the axis.
  std::uniform_real_distribution<double> aside(-size / 2, size / 2);
  for (int k = 0; k < 300; ++k) {
    Vector x = axis + (top_of(heap) + 2 * size) * Vector::Unit(up);
    for (int j = 0; j < up; ++j) x[j] += aside(random);
    heap.add_grain(shapes[random() % shapes.size()], {x, moreau::random_rotation<S>(random)}, 2700);
    for (int step = 0; step < 40; ++step) heap.step(h);
    remove_fallen(heap);
  }

  const double end = heap.time() + 5;
  moreau::RestTest rest;
  while (!rest.add(heap, heap.step(h), h) && heap.time() < end) remove_fallen(heap);
  if (!rest.is_at_rest()) std::cerr << "not at rest: " << rest.reason() << '\n';

  // Neither the rounded top nor the edge of the plate.
  const std::vector<Vector> surface = moreau::free_surface(heap, 2 * size);
  const moreau::HeapSlope slope = moreau::heap_slope(surface, axis, 2 * size, plate - 2 * size);
  std::cout << "t = " << heap.time() << " s, angle of repose "
            << slope.angle * 180 / std::numbers::pi << " degrees, from " << slope.points
            << " columns, which differ from a line by " << slope.error / size << " grain sizes\n";
}
