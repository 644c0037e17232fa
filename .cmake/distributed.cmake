# SPDX-License-Identifier: MIT
# The target moreau::distributed, where MPI and Zoltan are installed (Debian: libopenmpi-dev,
# libtrilinos-zoltan-dev).
if(PROJECT_IS_TOP_LEVEL AND NOT TARGET MPI::MPI_CXX)
  set(MPI_CXX_SKIP_MPICXX ON)
  find_package(MPI QUIET COMPONENTS CXX)
endif()
find_path(MOREAU_ZOLTAN_INCLUDE zoltan.h PATH_SUFFIXES trilinos)
find_library(MOREAU_ZOLTAN_LIBRARY NAMES trilinos_zoltan zoltan)
mark_as_advanced(MOREAU_ZOLTAN_INCLUDE MOREAU_ZOLTAN_LIBRARY)
if(TARGET MPI::MPI_CXX AND MOREAU_ZOLTAN_INCLUDE AND MOREAU_ZOLTAN_LIBRARY)
  add_library(moreau_distributed INTERFACE)
  add_library(moreau::distributed ALIAS moreau_distributed)
  target_include_directories(moreau_distributed SYSTEM INTERFACE ${MOREAU_ZOLTAN_INCLUDE})
  target_link_libraries(moreau_distributed INTERFACE moreau::moreau MPI::MPI_CXX
                                                     ${MOREAU_ZOLTAN_LIBRARY})
elseif(PROJECT_IS_TOP_LEVEL)
  message(STATUS "MPI or Zoltan is not installed: moreau::distributed and its tests are left out")
endif()
