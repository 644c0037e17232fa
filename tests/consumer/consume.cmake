# SPDX-License-Identifier: MIT
# Builds and runs the twenty-line example as a project of its own, outside this one's source tree.
#   WAY       find_package | build_tree | add_subdirectory | fetch_content | pkg_config
#   LIBRARY   this project's source    BUILD     its build folder
#   COMPILER  the C++ compiler         GENERATOR of build files
cmake_minimum_required(VERSION 3.21)
set(warnings "-Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Werror")

execute_process(COMMAND mktemp -d OUTPUT_VARIABLE WORK OUTPUT_STRIP_TRAILING_WHITESPACE
                COMMAND_ERROR_IS_FATAL ANY)

function(run)
  execute_process(COMMAND ${ARGV} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${WAY}: failed: ${command}\n${output}")
  endif()
endfunction()

file(MAKE_DIRECTORY ${WORK}/project)
# Two ways build the whole example; for the others it is enough that the headers are found.
if(WAY MATCHES "find_package|add_subdirectory")
  file(COPY_FILE ${LIBRARY}/examples/hello/hello.cpp ${WORK}/project/hello.cpp)
else()
  file(COPY_FILE ${LIBRARY}/tests/consumer/version.cpp ${WORK}/project/hello.cpp)
endif()

# An installed tree must not depend on where it was installed: move it.
if(WAY MATCHES "find_package|pkg_config")
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/staging)
  file(RENAME ${WORK}/staging ${WORK}/prefix)
endif()

if(WAY STREQUAL "pkg_config")
  set(ENV{PKG_CONFIG_PATH} ${WORK}/prefix/share/pkgconfig)
  run(sh -c "${COMPILER} -std=c++20 -O1 ${warnings} \
             $(pkg-config --cflags moreau | sed 's/-I\\([^ ]*eigen3\\)/-isystem \\1/') \
             project/hello.cpp -o hello")
  run(./hello)
  file(REMOVE_RECURSE ${WORK})
  return()
endif()

# One of them optimizes fully, for the warnings that only optimizers give; the others save the time,
# but without any optimization the program would run for minutes.
set(build_type Debug)
if(WAY STREQUAL "find_package")
  set(build_type Release)
endif()
set(options -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${warnings}
            -DCMAKE_CXX_FLAGS_DEBUG=-O1
            -DCMAKE_BUILD_TYPE=${build_type})
if(WAY STREQUAL "find_package")
  list(APPEND options -DCMAKE_PREFIX_PATH=${WORK}/prefix)
elseif(WAY STREQUAL "build_tree")
  list(APPEND options -Dmoreau_DIR=${BUILD})
else()
  list(APPEND options -DMOREAU_SOURCE_DIR=${LIBRARY})
endif()
set(project ${WAY})
if(WAY STREQUAL "build_tree")
  set(project find_package)
endif()
file(COPY_FILE ${LIBRARY}/tests/consumer/${project}/CMakeLists.txt ${WORK}/project/CMakeLists.txt)
run(${CMAKE_COMMAND} -S project -B build ${options})
run(${CMAKE_COMMAND} --build build)
run(build/hello)
file(REMOVE_RECURSE ${WORK})
