# SPDX-License-Identifier: Apache-2.0
# embed_kernels(folder output): generates a source that defines voxelume::embedded_kernels(), the
# text of every .cl and .h file below `folder`, named by its path from there. The source is
# generated again when a kernel changes.
function(embed_kernels folder output)
    file(GLOB_RECURSE files CONFIGURE_DEPENDS ${folder}/*.cl ${folder}/*.h)
    add_custom_command(
        OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} -Dfolder=${folder} -Doutput=${output} -P ${CMAKE_SOURCE_DIR}/cmake/write_kernels.cmake
        DEPENDS ${files} ${CMAKE_SOURCE_DIR}/cmake/write_kernels.cmake
        COMMENT "Embedding kernels"
        VERBATIM)
endfunction()
