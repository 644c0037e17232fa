# SPDX-License-Identifier: MIT
# Checks of the headers:
#   moreau_headers            each header alone, included twice: a header that needs what its includer
#                             includes, or that lacks a guard, does not pass
#   moreau_headers_together   two units that include all headers, linked into one program: a function
#                             that is not inline is defined twice
set(include_dir ${PROJECT_SOURCE_DIR}/include)
set(generated ${CMAKE_CURRENT_BINARY_DIR}/headers)
file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${include_dir} ${include_dir}/moreau/*.hpp)
list(SORT headers ORDER DESCENDING)
if(NOT TARGET moreau_hdf5)
  list(REMOVE_ITEM headers moreau/io/fclib.hpp)
endif()
if(NOT TARGET moreau_picture)
  list(FILTER headers EXCLUDE REGEX "moreau/picture/.*\\.hpp")
endif()
set(units "")
set(together "int main() {}\n")
set(again "")
if(NOT TARGET moreau_distributed)
  list(FILTER headers EXCLUDE REGEX "moreau/distributed/.*\\.hpp")
endif()
foreach(header IN LISTS headers)
  set(include "#include \"${header}\"\n")
  file(CONFIGURE OUTPUT ${generated}/${header}.cpp CONTENT "${include}${include}" @ONLY)
  list(APPEND units ${generated}/${header}.cpp)
  string(PREPEND together "${include}")
  string(APPEND again "${include}")
endforeach()
# The number that moreau::instances defines (instances/usual.hpp): nothing here calls its functions.
string(APPEND together "template <int N>\nconst char moreau::detail::InstancesCompiledWithTheSameFlags<N>::yes = 1;\n"
                       "template struct moreau::detail::InstancesCompiledWithTheSameFlags<"
                       "EIGEN_MAX_STATIC_ALIGN_BYTES>;\n")
file(CONFIGURE OUTPUT ${generated}/together.cpp CONTENT "${together}" @ONLY)
file(CONFIGURE OUTPUT ${generated}/again.cpp CONTENT "${again}" @ONLY)

# No code is generated, and there are no warnings: moreau_headers_together shows them. Most of what these
# units include is Eigen's, which is read once.
add_library(moreau_headers OBJECT EXCLUDE_FROM_ALL ${units})
set_target_properties(moreau_headers PROPERTIES CXX_COMPILER_LAUNCHER ${PROJECT_SOURCE_DIR}/.cmake/check_syntax)
target_link_libraries(moreau_headers PRIVATE moreau_development $<TARGET_NAME_IF_EXISTS:moreau_hdf5>
                                             $<TARGET_NAME_IF_EXISTS:moreau_picture>
                                             $<TARGET_NAME_IF_EXISTS:moreau_distributed>)
target_compile_options(moreau_headers PRIVATE -O0 -g0 -w)
target_precompile_headers(moreau_headers PRIVATE <Eigen/Geometry>)
foreach(header IN LISTS headers)
  file(STRINGS ${include_dir}/${header} includes REGEX "^#include (<Eigen|\"moreau/)")
  list(FILTER includes EXCLUDE REGEX "moreau/(core/(error|ids)|version)\\.hpp")
  if(NOT includes)
    set_source_files_properties(${generated}/${header}.cpp PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
  endif()
endforeach()

add_executable(moreau_headers_together EXCLUDE_FROM_ALL ${generated}/together.cpp ${generated}/again.cpp)
target_link_libraries(moreau_headers_together PRIVATE moreau_development
                                              $<TARGET_NAME_IF_EXISTS:moreau_hdf5>
                                              $<TARGET_NAME_IF_EXISTS:moreau_picture>
                                               $<TARGET_NAME_IF_EXISTS:moreau_distributed>)
target_compile_options(moreau_headers_together PRIVATE -O0 -g0)

add_test(NAME source.headers COMMAND ${PROJECT_SOURCE_DIR}/.ci/check_headers)
set_tests_properties(source.headers PROPERTIES LABELS source)
