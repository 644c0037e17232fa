# SPDX-License-Identifier: MIT
# Settings of the project's own tests, benchmarks and examples. They link moreau_development and
# nothing of it reaches a user of moreau::moreau.
option(MOREAU_WERROR "Treat warnings as errors" ${PROJECT_IS_TOP_LEVEL})
option(MOREAU_NATIVE "Compile for the CPU of this machine (-march=native)" OFF)
set(MOREAU_SANITIZE "" CACHE STRING "Sanitizers, comma separated, e.g. address,undefined")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES AND PROJECT_IS_TOP_LEVEL)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

set(CMAKE_CXX_EXTENSIONS OFF)

add_library(moreau_development INTERFACE)
find_package(Threads REQUIRED)  # moreau/parallel/thread_team.hpp
target_link_libraries(moreau_development INTERFACE moreau::moreau Threads::Threads)
target_compile_options(moreau_development INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow)
if(MOREAU_WERROR)
  target_compile_options(moreau_development INTERFACE -Werror)
endif()
if(MOREAU_NATIVE)
  # A target with the property MOREAU_ANY_CPU is compiled as without MOREAU_NATIVE.
  target_compile_options(moreau_development INTERFACE
    $<$<NOT:$<BOOL:$<TARGET_PROPERTY:MOREAU_ANY_CPU>>>:-march=native>)
  # g++ 12 sees uninitialized values inside its own AVX-512 intrinsics (GCC bug 105593).
  target_compile_options(moreau_development INTERFACE
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized -Wno-uninitialized>)
endif()
if(MOREAU_SANITIZE)
  set(sanitize -fsanitize=${MOREAU_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_compile_options(moreau_development INTERFACE ${sanitize})
  target_link_options(moreau_development INTERFACE ${sanitize})
  target_compile_definitions(moreau_development INTERFACE _GLIBCXX_ASSERTIONS)
endif()

# Optional: the C library of HDF5, for moreau/io/fclib.hpp.
find_path(MOREAU_HDF5_INCLUDE hdf5.h PATH_SUFFIXES hdf5/serial)
find_library(MOREAU_HDF5_LIBRARY NAMES hdf5 hdf5_serial PATH_SUFFIXES hdf5/serial)
mark_as_advanced(MOREAU_HDF5_INCLUDE MOREAU_HDF5_LIBRARY)
if(MOREAU_HDF5_INCLUDE AND MOREAU_HDF5_LIBRARY)
  add_library(moreau_hdf5 INTERFACE)
  target_include_directories(moreau_hdf5 SYSTEM INTERFACE ${MOREAU_HDF5_INCLUDE})
  target_link_libraries(moreau_hdf5 INTERFACE ${MOREAU_HDF5_LIBRARY})
endif()
