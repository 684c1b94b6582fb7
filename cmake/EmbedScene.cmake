# SPDX-License-Identifier: Apache-2.0
# embed_scene(file name output): generates a source that defines std::string_view voxelume::NAME(),
# the text of a scene file. The source is generated again when the file changes.
function(embed_scene file name output)
    add_custom_command(
        OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} -Dfile=${file} -Dname=${name} -Doutput=${output}
                -P ${CMAKE_SOURCE_DIR}/cmake/write_scene.cmake
        DEPENDS ${file} ${CMAKE_SOURCE_DIR}/cmake/write_scene.cmake
        COMMENT "Embedding a scene"
        VERBATIM)
endfunction()
