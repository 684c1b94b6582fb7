# SPDX-License-Identifier: Apache-2.0
# build_facts(output): generates a source that defines voxelume::cli::build_facts(), what
# `voxelume --version` says of the build. It is generated again when another commit is checked out.
function(build_facts output)
    set(checkouts)
    execute_process(COMMAND git -C ${CMAKE_SOURCE_DIR} rev-parse --path-format=absolute --git-path logs/HEAD
                    OUTPUT_VARIABLE log OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(log AND EXISTS ${log})
        set(checkouts ${log})
    endif()
    set(compiler "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}")
    string(REPLACE "GNU" "GCC" compiler "${compiler}")
    set(facts "${compiler}, ${CMAKE_BUILD_TYPE}, ${CMAKE_SYSTEM_NAME} ${CMAKE_SYSTEM_PROCESSOR}")
    set(libraries "OpenEXR ${OpenEXR_VERSION}, OpenVDB ${OpenVDB_VERSION}, libspng ${spng_VERSION}, zstd ${zstd_VERSION}")
    add_custom_command(
        OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} -Dsource=${CMAKE_SOURCE_DIR} -Doutput=${output} "-Dfacts=${facts}"
                "-Dlibraries=${libraries}" -P ${CMAKE_SOURCE_DIR}/cmake/write_build_facts.cmake
        DEPENDS ${checkouts} ${CMAKE_SOURCE_DIR}/cmake/write_build_facts.cmake
        COMMENT "Writing the facts of the build"
        VERBATIM)
endfunction()
