# SPDX-License-Identifier: MIT
# Examples that no quick or extra test builds, and one benchmark: the target moreau_programs checks that they
# compile without warnings. They are one unit, no code is generated, and the usual worlds are declared extern:
# this takes a fraction of the time of building them. The long tests build and run all programs.
set(sources ${PROJECT_SOURCE_DIR}/bench/broad_phase.cpp)
set(folders ${PROJECT_SOURCE_DIR}/bench)
if(NOT TARGET bench_broad_phase)
  set(sources "")
endif()
foreach(program contacts drum heap measures mixed_shapes own_integrator own_law own_shape packing restart)
  file(GLOB of_program CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/examples/${program}/*.cpp)
  list(APPEND sources ${of_program})
  list(APPEND folders ${PROJECT_SOURCE_DIR}/examples/${program})
endforeach()
moreau_unite(units moreau_programs 100 ${sources})
add_library(moreau_programs OBJECT EXCLUDE_FROM_ALL ${units})
set_target_properties(moreau_programs PROPERTIES CXX_COMPILER_LAUNCHER ${PROJECT_SOURCE_DIR}/.cmake/check_syntax)
target_include_directories(moreau_programs PRIVATE ${folders})
target_link_libraries(moreau_programs PRIVATE moreau_development pictures
                                              $<TARGET_NAME_IF_EXISTS:benchmark::benchmark>)
target_compile_options(moreau_programs PRIVATE "SHELL:-include moreau/instances/space.hpp"
                                               "SHELL:-include moreau/instances/plane.hpp")

# The testbed by itself: nothing else compiles it, and it is one of the README's commands. Its scenes are read, not
# instantiated.
add_library(moreau_testbed_check OBJECT EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/examples/testbed/make_scene.cpp)
set_target_properties(moreau_testbed_check PROPERTIES CXX_COMPILER_LAUNCHER ${PROJECT_SOURCE_DIR}/.cmake/check_syntax)
target_link_libraries(moreau_testbed_check PRIVATE moreau_development)
