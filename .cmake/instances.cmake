# SPDX-License-Identifier: MIT
# The usual worlds compiled once for several programs: what links moreau_instances takes them from
# there without a line of its own.
include_guard(GLOBAL)
function(moreau_add_instances name)
  set(folder ${PROJECT_SOURCE_DIR}/.cmake/instances)
  add_library(${name} STATIC EXCLUDE_FROM_ALL ${folder}/space.cpp ${folder}/plane.cpp)
  target_link_libraries(${name} PUBLIC moreau_development)
  target_compile_options(${name} INTERFACE "SHELL:-include moreau/instances/space.hpp"
                                           "SHELL:-include moreau/instances/plane.hpp")
endfunction()
moreau_add_instances(moreau_instances)

# The same for problems given by matrices; the units that solve them include the header.
add_library(moreau_problem_instances STATIC EXCLUDE_FROM_ALL
            ${PROJECT_SOURCE_DIR}/.cmake/instances/friction_problems.cpp)
target_link_libraries(moreau_problem_instances PUBLIC moreau_development)
