# SPDX-License-Identifier: MIT
# The target moreau::instances: the usual simulations compiled once (moreau/instances/usual.hpp). A program that
# links it takes them from the library, and reads the headers from a precompiled one. The library belongs to
# the project that uses moreau, and is compiled with its flags; it is built only if something links it.
if(TARGET moreau::instances)
  return()
endif()
file(GLOB sources ${CMAKE_CURRENT_LIST_DIR}/usual_instances/*.cpp)
add_library(moreau_usual_instances STATIC EXCLUDE_FROM_ALL ${sources})
add_library(moreau::instances ALIAS moreau_usual_instances)
target_link_libraries(moreau_usual_instances PUBLIC moreau::moreau)
target_precompile_headers(moreau_usual_instances PUBLIC
                          "$<$<COMPILE_LANGUAGE:CXX>:<moreau/instances/usual.hpp$<ANGLE-R>>")
