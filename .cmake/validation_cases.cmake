# SPDX-License-Identifier: MIT
# The cases of the validation, which the program and the tests share; what of them takes long to
# compile is in worlds/. Those in float are a library of their own, for the program and the long
# tests.
if(NOT TARGET validation_cases)
  include(${CMAKE_CURRENT_LIST_DIR}/instances.cmake)
  set(cases ${PROJECT_SOURCE_DIR}/examples/validation)
  file(GLOB case_sources CONFIGURE_DEPENDS ${cases}/worlds/*.cpp ${cases}/*.cpp)
  list(REMOVE_ITEM case_sources ${cases}/main.cpp ${cases}/report.cpp)
  add_library(validation_cases STATIC EXCLUDE_FROM_ALL ${case_sources})
  target_include_directories(validation_cases PUBLIC ${cases})
  target_link_libraries(validation_cases PUBLIC moreau_instances)
  set(fast $<$<CONFIG:Release>:-O1>)  # the cases themselves; the steps are as in a user's build
  set(kinds closed_forms invariants structures)
  foreach(kind ${kinds} packings)
    set_source_files_properties(${cases}/${kind}.cpp PROPERTIES COMPILE_OPTIONS ${fast})
  endforeach()

  file(GLOB case_sources CONFIGURE_DEPENDS ${cases}/in_float/*.cpp)
  add_library(validation_cases_in_float STATIC EXCLUDE_FROM_ALL ${case_sources})
  # The cases state their numbers in double, whatever the scalar. Options of a source come last: to
  # clang++, -Wconversion after these would switch them on again.
  set_source_files_properties(${case_sources} PROPERTIES COMPILE_OPTIONS
    "-Wno-float-conversion;$<$<CXX_COMPILER_ID:Clang>:-Wno-implicit-float-conversion>")
  foreach(kind ${kinds})
    set_property(SOURCE ${cases}/in_float/${kind}.cpp APPEND PROPERTY COMPILE_OPTIONS ${fast})
  endforeach()
  target_link_libraries(validation_cases_in_float PUBLIC validation_cases)
endif()
