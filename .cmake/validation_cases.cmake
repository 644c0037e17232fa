# SPDX-License-Identifier: MIT
# The cases of the validation, which the program and the tests share; what of them takes long to
# compile is in worlds/.
if(NOT TARGET validation_cases)
  set(cases ${PROJECT_SOURCE_DIR}/examples/validation)
  file(GLOB sources CONFIGURE_DEPENDS ${cases}/worlds/*.cpp ${cases}/*.cpp)
  list(REMOVE_ITEM sources ${cases}/main.cpp ${cases}/report.cpp)
  add_library(validation_cases STATIC EXCLUDE_FROM_ALL ${sources})
  target_include_directories(validation_cases PUBLIC ${cases})
  target_link_libraries(validation_cases PUBLIC moreau_development)
endif()
