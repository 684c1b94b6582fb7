# SPDX-License-Identifier: Apache-2.0
# hash_producers(folder output): generates a source that defines voxelume::producer_hash(), the
# hashes of the sources below `folder` that turn meshes into models, and models into a world. The
# source is generated again when one of them changes.
function(hash_producers folder output)
    file(GLOB_RECURSE files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/kernels/shared/*.h)
    foreach(part base scene grid geometry io/image io/mesh io/mesh_codec io/gltf io/voxels io/arrays io/voxel_art assets analysis stages/voxelize
                 stages/place stages/index stages/instance world)
        file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/${part}/*.?pp)
        list(APPEND files ${sources})
    endforeach()
    list(SORT files)
    add_custom_command(
        OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} "-Dfiles=${files}" -Doutput=${output} -P ${CMAKE_SOURCE_DIR}/cmake/write_producer_hashes.cmake
        DEPENDS ${files} ${CMAKE_SOURCE_DIR}/cmake/write_producer_hashes.cmake
        COMMENT "Hashing what makes models"
        VERBATIM)
endfunction()
