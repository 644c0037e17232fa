# SPDX-License-Identifier: MIT
# Builds and runs a program as a project of its own, outside this one's source tree.
#   WAY       find_package | build_tree | eigen_5 | add_subdirectory | fetch_content | pkg_config | plain
#             | debian_package | project | instances | mistakes
#   LIBRARY   this project's source    BUILD     its build folder
#   COMPILER  the C++ compiler         GENERATOR of build files
#   EIGEN     its include folder
# One way builds two units with all of moreau.hpp; for the others it is enough that
# the headers are found, and Eigen's. eigen_5 has a package file as Eigen 5 has it, which refuses a
# request for version 3.4, over the headers that are there. project is the template of examples/project, which
# compiles the usual simulations once, and instances does the same with pkg-config and make. mistakes configures wrong
# projects, which CMake must refuse with the reason. The subdirectory meets globals with the names that
# the library has for its own.
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
  set(output "${output}" PARENT_SCOPE)
endfunction()

# A compiler and a few flags, no build system.
function(run_compiled flags)
  run(sh -c "${COMPILER} -std=c++20 ${warnings} ${flags} project/*.cpp -o hello")
  run(./hello)
endfunction()

function(run_with_pkg_config share)
  set(ENV{PKG_CONFIG_PATH} ${share}/pkgconfig)
  # Eigen is not asked for warnings.
  run_compiled("$(pkg-config --cflags moreau | sed 's/-I\\([^ ]*eigen3\\)/-isystem \\1/')")
endfunction()

# A project with these lines is refused, or its target is left out, with this reason; CMake breaks the lines of messages.
function(expect reason lines)
  file(WRITE ${WORK}/project/CMakeLists.txt "cmake_minimum_required(VERSION 3.21)\n${lines}\n")
  execute_process(COMMAND ${CMAKE_COMMAND} -S project -B build --fresh -Dmoreau_DIR=${BUILD} -DCMAKE_CXX_COMPILER=${COMPILER}
                  WORKING_DIRECTORY ${WORK} OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  string(FIND "${output}" "${reason}" found)
  if(found EQUAL -1)
    message(FATAL_ERROR "${WAY}: not said: ${reason}\n${lines}\n${output}")
  endif()
endfunction()

file(MAKE_DIRECTORY ${WORK}/project)
set(units hello.cpp)
if(WAY STREQUAL "add_subdirectory")
  set(units globals.cpp)
elseif(WAY STREQUAL "plain")
  set(units two_units/hello.cpp two_units/other.cpp)
endif()
list(TRANSFORM units PREPEND ${LIBRARY}/tests/consumer/)
file(COPY ${units} DESTINATION ${WORK}/project)

# An installed tree must not depend on where it was installed: move it.
if(WAY MATCHES "find_package|pkg_config|eigen_5|instances")
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/staging)
  file(RENAME ${WORK}/staging ${WORK}/prefix)
endif()

set(options -DCMAKE_BUILD_TYPE=Debug)
if(WAY STREQUAL "mistakes")
  set(begin "project(mine LANGUAGES NONE)\n")
  expect("moreau needs C++: project" "${begin}find_package(moreau 0.2 REQUIRED)")
  set(begin "project(mine LANGUAGES CXX)\n")
  expect("there is no component Picture, but instances" "${begin}find_package(moreau 0.2 REQUIRED COMPONENTS Picture)")
  expect("space_coulomb,plane_rolling is none of"
         "${begin}set(MOREAU_INSTANCES space_coulomb,plane_rolling)\nfind_package(moreau 0.2 REQUIRED)")
  expect("the package is moreau, in small letters" "${begin}set(Moreau_DIR ${BUILD})\nfind_package(Moreau 0.2 REQUIRED)")
  set(subdirectory "add_subdirectory(${LIBRARY} moreau)\n")
  expect("moreau is there already" "${begin}find_package(moreau 0.2 REQUIRED)\n${subdirectory}")
  expect("moreau::picture is left out: it needs find_package(PNG) before moreau" "${begin}${subdirectory}")
elseif(WAY STREQUAL "plain")
  run_compiled("-I ${LIBRARY}/include -isystem ${EIGEN}")
elseif(WAY STREQUAL "pkg_config")
  run_with_pkg_config(${WORK}/prefix/share)
  # The suites are installed, too.
  file(COPY_FILE ${LIBRARY}/tests/consumer/suites.cpp ${WORK}/suites.cpp)
  run(sh -c "${COMPILER} -std=c++20 -I prefix/include -isystem ${EIGEN} -isystem prefix/share/moreau/tests \
             suites.cpp -o suites")
  run(./suites)
elseif(WAY STREQUAL "project")
  file(COPY ${LIBRARY}/examples/project DESTINATION ${WORK})
  run(project/build.sh -DMOREAU=${LIBRARY} -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O1
      -DCMAKE_CXX_COMPILER=${COMPILER})
  if(NOT output MATCHES "contact points")
    message(FATAL_ERROR "${WAY}: the program printed:\n${output}")
  endif()
elseif(WAY STREQUAL "instances")
  set(ENV{PKG_CONFIG_PATH} ${WORK}/prefix/share/pkgconfig)
  set(flags "-std=c++20 -O1")
  run(sh -c "make -j2 -f $(pkg-config --variable=instances moreau) CXX=${COMPILER} CXXFLAGS='${flags}'")
  file(COPY_FILE ${LIBRARY}/examples/restart/restart.cpp ${WORK}/restart.cpp)
  run(sh -c "${COMPILER} ${flags} $(pkg-config --cflags moreau) -include moreau_instances.hpp \
             restart.cpp libmoreau_instances.a -o restart && ./restart")
elseif(WAY STREQUAL "debian_package")
  # Packed, looked at, unpacked beside the system, used.
  get_filename_component(bin ${CMAKE_COMMAND} DIRECTORY)
  run(${bin}/cpack -G DEB --config ${BUILD}/CPackConfig.cmake -B ${WORK})
  file(GLOB package ${WORK}/libmoreau-dev_*_all.deb)
  run(dpkg-deb --field ${package} Depends)
  if(NOT output MATCHES "libeigen3-dev")
    message(FATAL_ERROR "${WAY}: the package does not depend on Eigen: ${output}")
  endif()
  run(dpkg-deb --contents ${package})
  foreach(file include/moreau/moreau.hpp share/pkgconfig/moreau.pc
               share/cmake/moreau/moreau-config.cmake share/doc/libmoreau-dev/copyright
               share/doc/libmoreau-dev/changelog.gz)
    if(NOT output MATCHES "-rw-r--r-- root/root +[0-9]+ [^\n]*\\./usr/${file}\n")
      message(FATAL_ERROR "${WAY}: ${file} is not in the package as it should:\n${output}")
    endif()
  endforeach()
  run(dpkg-deb --extract ${package} ${WORK}/root)
  run_with_pkg_config(${WORK}/root/usr/share)
else()
  set(project ${WAY})
  if(WAY STREQUAL "find_package")
    list(APPEND options -DCMAKE_PREFIX_PATH=${WORK}/prefix)
  elseif(WAY STREQUAL "eigen_5")
    file(WRITE ${WORK}/eigen/Eigen3Config.cmake
         "add_library(Eigen3::Eigen INTERFACE IMPORTED)\n"
         "target_include_directories(Eigen3::Eigen INTERFACE ${EIGEN})\n")
    file(WRITE ${WORK}/eigen/Eigen3ConfigVersion.cmake
         "set(PACKAGE_VERSION 5.0.1)\n"
         "if(NOT PACKAGE_FIND_VERSION OR PACKAGE_FIND_VERSION_MAJOR EQUAL 5)\n"
         "  set(PACKAGE_VERSION_COMPATIBLE TRUE)\n"
         "endif()\n")
    list(APPEND options -DCMAKE_PREFIX_PATH=${WORK}/prefix -DEigen3_DIR=${WORK}/eigen)
    set(project find_package)
  elseif(WAY STREQUAL "build_tree")
    list(APPEND options -Dmoreau_DIR=${BUILD})
    set(project find_package)
  elseif(WAY STREQUAL "fetch_content")
    # From a clone, as from anywhere; where this is no repository, from the files.
    execute_process(COMMAND git clone --quiet --no-hardlinks ${LIBRARY} ${WORK}/clone
                    RESULT_VARIABLE no_repository ERROR_VARIABLE reason)
    if(no_repository)
      message(STATUS "Not cloned, the files are taken as they are: ${reason}")
      list(APPEND options -DFETCHCONTENT_SOURCE_DIR_MOREAU=${LIBRARY})
    endif()
    list(APPEND options -DMOREAU_REPOSITORY=${WORK}/clone)
  else()
    list(APPEND options -DMOREAU_SOURCE_DIR=${LIBRARY})
  endif()
  file(COPY_FILE ${LIBRARY}/tests/consumer/${project}/CMakeLists.txt ${WORK}/project/CMakeLists.txt)
  run(${CMAKE_COMMAND} -S project -B build -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER}
      -DCMAKE_CXX_FLAGS=${warnings} -DCMAKE_CXX_FLAGS_DEBUG=-O0 ${options})
  run(${CMAKE_COMMAND} --build build)
  run(build/hello)
endif()
file(REMOVE_RECURSE ${WORK})
