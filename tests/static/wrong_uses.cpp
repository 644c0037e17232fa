// SPDX-License-Identifier: MIT
// What a user may get wrong and the compiler refuses. REFUSED(n, use) states that use number n does
// not compile; TAKEN(use) is the same call written right. The tests in rejected.cpp compile the uses
// 38 to 40 (velocity_of_two_numbers, pose_of_another_dimension, shape_of_a_space) and policies that
// do not fit each other, and compare the compiler's messages with the text in that file. The first
// lines of the messages of g++ 12, without the name of the file:
//
// | use | message |
// |---|---|
// | 1-4, 6, 11-22, 25-27, 38, 39, 41-43 | use of deleted function 'Components<N, T>::Components(WrongNumber ...) [with WrongNumber = {int, int}; int N = 3; T = double]' |
// | 7-9, 31, 32 | use of deleted function 'Components<N, T>::Components(..) [with WrongVector = Eigen::Matrix<double, 2, 1>; int N = 3; T = double]' |
// | 5, 10 | cannot convert 'double' to 'const Components<3, double>&' |
// | 23 | no matching function for call to 'CylinderWall<Space<3, double> >::CylinderWall(double, double)' |
// | 24 | no matching function for call to 'ForceDrive<Eigen::Matrix<double, 3, 1>, ..>::apply(plane&, double)' |
// | 28, 29, 40 | template constraint failure for 'template<class T> requires floating_point<T> using Disk = BallIn<Space<2, T> >' |
// | 30 | template constraint failure for 'template<class S> requires EuclideanSpace<S> struct Pose' |
// | 33 | no matching function for call to 'Simulation<..>::Simulation(double, const Materials<SignoriniCoulomb<float> >&)' |
// | 34 | cannot convert 'Id<BodyTag>' to 'Id<ShapeTag>' |
// | 35 | cannot convert 'Pose<Space<2, double> >' to 'const Pose<Space<3, double> >&' |
// | 36 | cannot convert 'Polygon<double>' to 'const Polyhedron<double>&' |
// | 44 | use of deleted function 'Materials<Law>::Materials(auto:1, const Law&) [with auto:1 = double]' |
// | 45-47 | use of deleted function 'Placed<ShapeT>::Placed(const ShapeT&&)' |
// | 48, 49 | template constraint failure for 'template<class ShapeT, ..> requires GrainShape<ShapeT> class Simulation' |
// | 50, 51, 54-57 | assignment of read-only location '..' |
// | 52 | passing 'const moreau::Value<Eigen::Matrix<double, 3, 1> >' as 'this' argument discards qualifiers |
// | 53 | the same of 'Eigen::MatrixBase<..>::operator+=' |
// | 37 | template constraint failure for 'template<class ... Shapes> .. class OneOf' |
#include "moreau/boundary/drive.hpp"
#include "moreau/measure/energy.hpp"
#include "moreau/measure/grid_field.hpp"
#include "moreau/moreau.hpp"

namespace {

using Law = moreau::SignoriniCoulomb<double>;
using World = moreau::Simulation<moreau::Polyhedron<double>, Law>;
using Plane = moreau::Simulation<moreau::Polygon<double>, Law>;
using Drive = moreau::ForceDrive<World::Vector, double (*)(double)>;

// The variables are template parameters of a lambda, so that an invalid use gives false and not a
// compile error.
#define COMPILES(...)                                                                          \
  []<class W = World, class P = Plane, class S = moreau::Space<3>, class R = moreau::Space<2>, \
     class T = double>() {                                                                     \
    return requires(W & world, P & plane, moreau::BodyId body, moreau::ShapeId shape,          \
                    moreau::Pose<S> pose, moreau::Aabb<S> box, typename S::Vector vector,      \
                    typename S::Rotation rotation, Drive drive, moreau::GridField<S> field) {  \
      __VA_ARGS__;                                                                             \
    };                                                                                         \
  }                                                                                            \
  ()
#define REFUSED(number, ...) static_assert(!COMPILES(__VA_ARGS__), #number)
#define TAKEN(...) static_assert(COMPILES(__VA_ARGS__))

// Number of components, in a simulation.
TAKEN(world.add_wall({0, 0, 1}, {0, 0, 0}));
REFUSED(1, world.add_wall({0, 0, 1}, {0, 0}));
REFUSED(2, world.add_wall({0, 1}, {0, 0, 0}));
REFUSED(3, plane.add_wall({0, 0, 1}, {0, 0}));
TAKEN(world.set_velocity(body, {1, 0, 0.5f}));
TAKEN(world.set_velocity(body, -2 * vector));
REFUSED(4, world.set_velocity(body, {1, 0}));
REFUSED(5, world.set_velocity(body, T(1)));
REFUSED(6, world.set_velocity(body, {}));
REFUSED(7, world.set_velocity(body, typename R::Vector(1, 0)));
REFUSED(8, world.set_velocity(body, Eigen::Matrix<T, Eigen::Dynamic, 1>(3)));
REFUSED(9, world.set_velocity(body, vector.transpose()));
TAKEN(plane.set_spin(body, 1); plane.set_spin(body, {1.0}));
REFUSED(10, world.set_spin(body, T(1)));
// Results, of which a change would be lost.
TAKEN((typename S::Vector(world.velocity(body))).x() = 3);
REFUSED(50, world.velocity(body).x() = 3);
REFUSED(51, world.velocity(body)[0] = 3);
REFUSED(52, world.velocity(body) = vector);
REFUSED(53, world.velocity(body) += vector);
REFUSED(54, world.spin(body).z() = 3);
REFUSED(55, plane.spin(body)[0] = 3);
REFUSED(56, world.gravity().z() = -9.81);
REFUSED(57, world.contact_impulse(body).x() = 0);
REFUSED(11, plane.set_spin(body, {0, 0, 1}));
REFUSED(12, world.set_force(body, {0, 1}));
REFUSED(13, world.set_gravity({0, -9.81}));
TAKEN(world.add_cylinder({0, 0, 0}, {0, 1, 0}, 0.5));
REFUSED(14, world.add_cylinder({0, 0, 0}, {0, 1}, 0.5));
REFUSED(15, world.cell().wrap({0, 0}));

// Number of components, in other classes.
TAKEN(moreau::Pose<S>{{0, 0, 0}, rotation}, moreau::Pose<R>{{0, 0}}, moreau::Pose<S>{vector});
REFUSED(16, moreau::Pose<S>{{0, 0}, rotation});
REFUSED(17, moreau::Pose<S>{{0, 0}});
REFUSED(18, pose.to_body({0, 0}));
TAKEN(pose.position = {0, 0, 0}, pose.position = vector, pose.position += vector);
REFUSED(41, pose.position = {0, 0});
REFUSED(42, pose.position = {});
REFUSED(43, box.lower = {0, 0});
TAKEN(moreau::Aabb<S>{{0, 0, 0}, {1, 1, 1}}, box.contains({0, 0, 0}));
REFUSED(19, moreau::Aabb<S>{{0, 0}, {1, 1}});
REFUSED(20, box.contains({0, 0}));
TAKEN(moreau::Polygon<T>({{0, 0}, {1, 0}, {0, 1}}));
REFUSED(21, moreau::Polyhedron<T>({{0, 0}, {1, 0}, {0, 1}, {1, 1}}));
TAKEN(moreau::HalfSpace<S>({0, 0, 1}), moreau::CylinderWall<R>(1, 0.5));
REFUSED(22, moreau::HalfSpace<S>({0, 1}));
REFUSED(23, moreau::CylinderWall<S>(T(1), 0.5));
TAKEN(drive.apply(world, 1e-3));
TAKEN(moreau::ForceDrive(body, {0, 0, 1}, moreau::HarmonicForce(1, 2, 3)).apply(world, 1e-3));
TAKEN(moreau::VelocityDrive(body, {0.f, 1.f}, moreau::HarmonicForce(1, 2, 3)));
REFUSED(24, drive.apply(plane, 1e-3));
TAKEN(S::exp({0, 0, 0.1}), R::exp(0.1));
REFUSED(25, S::exp({0, 0.1}));
TAKEN(moreau::GridField<S>(box, {20, 20, 20}));
REFUSED(26, moreau::GridField<S>(box, {20, 20}));
REFUSED(27, field.add(vector, {1, 0}));

// The template argument of a shape.
TAKEN(typename moreau::Ball<T>; typename moreau::Capsule<T>; typename moreau::BallIn<S>);
REFUSED(28, typename moreau::Disk<S>);
REFUSED(29, typename moreau::Capsule<S>);
REFUSED(30, typename moreau::Pose<T>);

// Different scalar types.
REFUSED(31, world.set_velocity(body, vector.template cast<float>()));
REFUSED(32, moreau::Pose<S>{vector.template cast<float>(), rotation});
TAKEN(W(0.01, moreau::Materials<Law>(1)));
REFUSED(33, W(0.01, std::declval<const moreau::Materials<moreau::SignoriniCoulomb<float>>&>()));

// Objects of a wrong type.
TAKEN(world.add_grain(shape, pose, 2700));
REFUSED(34, world.add_grain(body, pose, 2700));
REFUSED(35, world.add_grain(shape, moreau::Pose<R>(), 2700));
REFUSED(36, world.add_shape(std::declval<moreau::Polygon<T>>()));
REFUSED(37, typename moreau::OneOf<moreau::Ball<T>, moreau::Disk<T>>);
TAKEN(moreau::Materials<Law>(2));
REFUSED(44, moreau::Materials<Law>(T(0.4)));
TAKEN(typename moreau::Simulation<moreau::Polyhedron<T>, Law>);
REFUSED(48, typename moreau::Simulation<Law, moreau::Polyhedron<T>>);
REFUSED(49, typename moreau::Simulation<moreau::HalfSpace<S>, Law>);

// Temporary shapes, to which a placed shape would refer.
TAKEN(moreau::Placed<moreau::Polygon<T>>(std::declval<const moreau::Polygon<T>&>()));
REFUSED(45, moreau::Placed<moreau::Polygon<T>>(std::declval<moreau::Polygon<T>>()));
REFUSED(46,
        moreau::Placed<moreau::Polygon<T>>(std::declval<moreau::Polygon<T>>(), moreau::Pose<R>()));
REFUSED(47, moreau::Placed<moreau::Rounded<moreau::Polygon<T>>>(
                std::declval<moreau::Rounded<moreau::Polygon<T>>>()));

}  // namespace
