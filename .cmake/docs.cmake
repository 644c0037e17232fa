# SPDX-License-Identifier: MIT
# The reference and the pages as a site: the target moreau_docs, where Doxygen is installed. A warning is an error.
# Settings are in Doxyfile.in; filters, menu and look are in docs/.
find_package(Doxygen QUIET)
if(DOXYGEN_FOUND)
  configure_file(.cmake/Doxyfile.in docs/Doxyfile @ONLY)
  add_custom_target(moreau_docs
                    COMMAND ${CMAKE_COMMAND} -E rm -rf ${PROJECT_BINARY_DIR}/docs/html  # pages that are no more
                    COMMAND Doxygen::doxygen ${PROJECT_BINARY_DIR}/docs/Doxyfile
                    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} VERBATIM
                    COMMENT "Reference and pages: ${PROJECT_BINARY_DIR}/docs/html/index.html")
endif()
