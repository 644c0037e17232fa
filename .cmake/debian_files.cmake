# SPDX-License-Identifier: MIT
# What Debian wants of a package beside its content: copyright and changelog under the package's
# name. CPack runs it between the installation and the packing.
set(doc ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/share/doc)
set(mine ${doc}/${CPACK_PACKAGE_NAME})
file(REMOVE_RECURSE ${doc}/moreau)
file(MAKE_DIRECTORY ${mine})
file(COPY_FILE ${CPACK_RESOURCE_FILE_LICENSE} ${mine}/copyright)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${mine}/changelog "${CPACK_PACKAGE_NAME} (${CPACK_PACKAGE_VERSION}) unstable; \
urgency=low\n\n  * Version ${CPACK_PACKAGE_VERSION}.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
execute_process(COMMAND gzip -9n ${mine}/changelog COMMAND_ERROR_IS_FATAL ANY)
file(CHMOD ${mine}/copyright ${mine}/changelog.gz
     FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
