# SPDX-License-Identifier: MIT
# The target moreau::instances: the usual simulations compiled once (moreau/instances/usual.hpp). A program that
# links it takes them from the library, and reads the headers from a precompiled one. The library belongs to
# the project that uses moreau, and is compiled with its flags; it is built only if something links it.
if(TARGET moreau::instances)
  return()
endif()
# MOREAU_INSTANCES names the simulations that are built: SPACE_LAW; empty: all.
set(MOREAU_INSTANCES "" CACHE STRING "simulations of moreau::instances, such as space_coulomb;plane_rolling; empty: all")
file(GLOB sources ${CMAKE_CURRENT_LIST_DIR}/usual_instances/*.cpp)
if(MOREAU_INSTANCES)
  set(parts same_flags)
  foreach(name IN LISTS MOREAU_INSTANCES)
    if(NOT name MATCHES "^(space|plane)_(coulomb|rolling|compliant)$")
      message(FATAL_ERROR "MOREAU_INSTANCES: ${name} is none of {space,plane}_{coulomb,rolling,compliant}")
    endif()
    list(APPEND parts ${CMAKE_MATCH_1}_shapes ${CMAKE_MATCH_1}_compounds ${name})
  endforeach()
  list(REMOVE_DUPLICATES parts)
  list(TRANSFORM parts PREPEND ${CMAKE_CURRENT_LIST_DIR}/usual_instances/ OUTPUT_VARIABLE sources)
  list(TRANSFORM sources APPEND .cpp)
endif()
add_library(moreau_usual_instances STATIC EXCLUDE_FROM_ALL ${sources})
add_library(moreau::instances ALIAS moreau_usual_instances)
target_link_libraries(moreau_usual_instances PUBLIC moreau::moreau)
target_precompile_headers(moreau_usual_instances PUBLIC
                          "$<$<COMPILE_LANGUAGE:CXX>:<moreau/instances/usual.hpp$<ANGLE-R>>")
