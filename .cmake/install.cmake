# SPDX-License-Identifier: MIT
# Install rules, and the same package files in the build tree, so that moreau_DIR may point at
# either. All paths are relative: an installed tree may be moved.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/moreau)

configure_package_config_file(.cmake/moreau-config.cmake.in moreau-config.cmake
                              INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may break its users.
write_basic_package_version_file(moreau-config-version.cmake COMPATIBILITY SameMinorVersion
                                 ARCH_INDEPENDENT)
configure_file(.cmake/moreau.pc.in moreau.pc @ONLY)

install(TARGETS moreau EXPORT moreau-targets INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT moreau-targets NAMESPACE moreau:: DESTINATION ${package_dir})
export(EXPORT moreau-targets NAMESPACE moreau:: FILE ${PROJECT_BINARY_DIR}/moreau-targets.cmake)

install(DIRECTORY include/moreau DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.hpp")
install(FILES ${PROJECT_BINARY_DIR}/moreau-config.cmake
              ${PROJECT_BINARY_DIR}/moreau-config-version.cmake
        DESTINATION ${package_dir})
# moreau::instances: its sources are compiled in the project that links it.
file(COPY .cmake/usual_instances.cmake .cmake/usual_instances DESTINATION ${PROJECT_BINARY_DIR})
install(FILES .cmake/usual_instances.cmake DESTINATION ${package_dir})
install(DIRECTORY .cmake/usual_instances DESTINATION ${package_dir})
install(FILES ${PROJECT_BINARY_DIR}/moreau.pc DESTINATION ${CMAKE_INSTALL_DATADIR}/pkgconfig)
# The suites that policies of a user's own are tried with; they need doctest.
install(DIRECTORY tests/conformance DESTINATION ${CMAKE_INSTALL_DATADIR}/moreau/tests
        FILES_MATCHING PATTERN "*.hpp" PATTERN shapes.hpp EXCLUDE PATTERN long EXCLUDE)
install(FILES tests/solve/assembly.hpp tests/solve/plain_coulomb.hpp DESTINATION ${CMAKE_INSTALL_DATADIR}/moreau/tests/solve)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/moreau)

# A package of the headers for Debian and its kin: `cpack -G DEB` in the build folder.
if(PROJECT_IS_TOP_LEVEL)
  set(CPACK_PACKAGE_NAME libmoreau-dev)
  set(CPACK_PACKAGE_CONTACT "The moreau authors <moreau@example.org>"
      CACHE STRING "Who packs: name and address")
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
  set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/.cmake/debian_files.cmake)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4)")
  # For moreau/picture/write_picture.hpp and moreau/io/read_mesh.hpp.
  set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libpng-dev")
  set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Contact dynamics of rigid grains (headers)")
  set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
      "Moreau-Jean time stepping with Signorini-Coulomb contacts for polyhedra,
polygons, spheres, disks and rounded shapes, in C++20 headers.")
  include(CPack)
endif()
