# SPDX-License-Identifier: MIT
# The examples and benchmarks that no quick or extra test builds: the target moreau_programs checks that they
# compile without warnings. Sources are united, and no code is generated: this takes a tenth of the time of
# building them. Long tests build and run the programs.
set(sources "")
set(folders "")
foreach(program avalanche contact_dynamics_vs_springs drum measures mixed_shapes own_integrator own_law own_shape
        packing plane_and_space restart silo)
  file(GLOB of_program CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/examples/${program}/*.cpp)
  list(APPEND sources ${of_program})
  list(APPEND folders ${PROJECT_SOURCE_DIR}/examples/${program})
endforeach()
if(MOREAU_BUILD_BENCHES)
  file(GLOB benches CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/bench/*.cpp)
  list(APPEND sources ${benches})
  list(APPEND folders ${PROJECT_SOURCE_DIR}/bench)
endif()
moreau_unite(units moreau_programs 100 ${sources})
add_library(moreau_programs OBJECT EXCLUDE_FROM_ALL ${units})
set_target_properties(moreau_programs PROPERTIES CXX_COMPILER_LAUNCHER ${PROJECT_SOURCE_DIR}/.cmake/check_syntax)
target_include_directories(moreau_programs PRIVATE ${folders})
target_link_libraries(moreau_programs PRIVATE moreau_development pictures
                                              $<TARGET_NAME_IF_EXISTS:benchmark::benchmark>)
