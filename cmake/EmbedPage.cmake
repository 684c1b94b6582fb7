# SPDX-License-Identifier: Apache-2.0
# embed_page(page script output): generates a source that defines voxelume::page_text() and
# page_script(), the text of both files. The source is generated again when one of them changes.
function(embed_page page script output)
    add_custom_command(
        OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} -Dpage=${page} -Dscript=${script} -Doutput=${output}
                -P ${CMAKE_SOURCE_DIR}/cmake/write_page.cmake
        DEPENDS ${page} ${script} ${CMAKE_SOURCE_DIR}/cmake/write_page.cmake
        COMMENT "Embedding the page"
        VERBATIM)
endfunction()
