# SPDX-License-Identifier: Apache-2.0
# A Debian package of what is installed: `./bootstrap.sh package` makes and tests it. Dates are those
# of SOURCE_DATE_EPOCH, so that equal sources give equal bytes.

# Debian's changelog has one entry, which names the version; CHANGELOG.md has the changes.
set(debian ${CMAKE_BINARY_DIR}/debian)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${debian}/changelog "voxelume (${PROJECT_VERSION}) unstable; urgency=medium

  * CHANGELOG.md has the changes.

 -- Voxelume maintainers <maintainers@voxelume.invalid>  ${date}
")
file(READ ${CMAKE_SOURCE_DIR}/CHANGELOG.md changes)
file(WRITE ${debian}/CHANGELOG.md "${changes}")
foreach(file changelog CHANGELOG.md)
    execute_process(COMMAND gzip -9nf ${debian}/${file} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
install(FILES ${debian}/changelog.gz ${debian}/CHANGELOG.md.gz ${CMAKE_SOURCE_DIR}/cmake/debian/copyright
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/voxelume COMPONENT debian EXCLUDE_FROM_ALL)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME voxelume)
set(CPACK_PACKAGE_CONTACT "Voxelume maintainers <maintainers@voxelume.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "renderer of voxel worlds, flat and volumetric")
set(CPACK_PACKAGE_DESCRIPTION
    "Voxelume renders worlds of voxels with shadows, mirrors, glass, fog and
skylight, as images and as the volumetric images that 3-D displays,
compositors and voxel tools take, by OpenCL on CPUs and GPUs.
.
This package has the program, the library with its headers, the manual
page, completions of shells, and scenes.")
set(CPACK_COMPONENTS_ALL Unspecified debian)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Debian wants a trigger in addition to CPack's own scripts, which call ldconfig.
file(WRITE ${debian}/triggers "activate-noawait ldconfig\n")
file(WRITE ${debian}/shlibs "libvoxelume ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} voxelume (>= ${PROJECT_VERSION})\n")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${debian}/triggers ${debian}/shlibs)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "pocl-opencl-icd | opencl-icd")
include(CPack)
