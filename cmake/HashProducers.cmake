# SPDX-License-Identifier: Apache-2.0
# hash_producers(folder output): generates a source that defines voxelume::producer_hash(), the
# hashes of the sources below `folder` that turn meshes into models, and models into a world. The
# source is generated again when one of them changes.
function(hash_producers folder output)
    file(GLOB_RECURSE files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/kernels/shared/*.h)
    set(readers image image_codec mesh mesh_codec gltf voxels arrays voxel_art)
    set(others vdb volume) # a model's own distances aren't kept, and volumetric images are no models
    file(GLOB formats RELATIVE ${folder}/io CONFIGURE_DEPENDS ${folder}/io/*)
    foreach(format ${formats})
        if(IS_DIRECTORY ${folder}/io/${format} AND NOT format IN_LIST readers AND NOT format IN_LIST others)
            message(FATAL_ERROR "cmake/HashProducers.cmake: do models come from runtime/io/${format}? List it")
        endif()
    endforeach()
    list(TRANSFORM readers PREPEND io/)
    foreach(part base scene grid geometry ${readers} assets analysis stages/voxelize stages/place stages/index
                 stages/instance world)
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
