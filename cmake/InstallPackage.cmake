# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` puts where: the program, the library with its header, the module and the reader for OpenVDB,
# the decoders of meshes and images, and what CMake and pkg-config need to find the library.
include(CMakePackageConfigHelpers)

install(TARGETS voxelume)
# The program itself makes its manual page and completions, from the table of its options.
install(CODE "
    set(share \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATAROOTDIR}\")
    foreach(page \"man/man1/voxelume.1:man\" \"bash-completion/completions/voxelume:completion bash\"
                 \"zsh/site-functions/_voxelume:completion zsh\"
                 \"fish/vendor_completions.d/voxelume.fish:completion fish\")
        string(REGEX MATCH \"^([^:]*):(.*)\" all \"\${page}\")
        set(file \"\${share}/\${CMAKE_MATCH_1}\")
        separate_arguments(words UNIX_COMMAND \"\${CMAKE_MATCH_2}\")
        get_filename_component(folder \"\${file}\" DIRECTORY)
        file(MAKE_DIRECTORY \"\${folder}\")
        execute_process(COMMAND \"$<TARGET_FILE:voxelume>\" \${words} OUTPUT_FILE \"\${file}\"
                        COMMAND_ERROR_IS_FATAL ANY)
    endforeach()
    execute_process(COMMAND gzip -9nf \"\${share}/man/man1/voxelume.1\" COMMAND_ERROR_IS_FATAL ANY)
")
install(TARGETS voxelume_vdb LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/voxelume)
install(TARGETS voxelume_vdb_reader voxelume_mesh_decoder voxelume_image_decoder voxelume_kernel_compiler
        RUNTIME DESTINATION ${CMAKE_INSTALL_LIBDIR}/voxelume) # beside it
install(TARGETS voxelume_shared EXPORT voxelumeTargets INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES ${CMAKE_SOURCE_DIR}/runtime/voxelume.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${CMAKE_SOURCE_DIR}/runtime/voxelume DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN *.hpp)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/voxelume)
install(EXPORT voxelumeTargets NAMESPACE voxelume:: DESTINATION ${package})
configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/voxelumeConfig.cmake.in ${CMAKE_BINARY_DIR}/voxelumeConfig.cmake
                              INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/voxelumeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/voxelumeConfig.cmake ${CMAKE_BINARY_DIR}/voxelumeConfigVersion.cmake
        DESTINATION ${package})

# Scenes to begin with, their schema and their manual, and the files that they name.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/voxelume
        PATTERN pictures EXCLUDE PATTERN gallery EXCLUDE PATTERN farm/*.sh EXCLUDE PATTERN farm/*.sbatch EXCLUDE)
file(GLOB farm_programs CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/scenes/farm/*.sh ${CMAKE_SOURCE_DIR}/scenes/farm/*.sbatch)
install(PROGRAMS ${farm_programs} DESTINATION ${CMAKE_INSTALL_DATADIR}/voxelume/scenes/farm)

# The prefix of voxelume.pc is found from where the file is, so that an installed tree can be moved.
file(RELATIVE_PATH prefix_from_pc ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(${CMAKE_SOURCE_DIR}/cmake/voxelume.pc.in ${CMAKE_BINARY_DIR}/voxelume.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/voxelume.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
