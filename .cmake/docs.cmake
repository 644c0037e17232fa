# SPDX-License-Identifier: MIT
# The reference and the pages as HTML: the target moreau_docs, where Doxygen is installed. A warning
# is an error.
find_package(Doxygen QUIET)
if(DOXYGEN_FOUND)
  configure_file(.cmake/Doxyfile.in docs/Doxyfile @ONLY)
  add_custom_target(moreau_docs COMMAND Doxygen::doxygen ${PROJECT_BINARY_DIR}/docs/Doxyfile
                    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} VERBATIM
                    COMMENT "Reference and pages: ${PROJECT_BINARY_DIR}/docs/html/index.html")
endif()
