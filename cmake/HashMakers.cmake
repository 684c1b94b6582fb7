# hash_makers(folder output): a source that defines voxelume::maker_sources(), hashes of the sources below
# `folder` by which meshes become models, and these a world. Rewritten when one of them changes.
function(hash_makers folder output)
    file(GLOB files CONFIGURE_DEPENDS ${folder}/grid_bytes.* ${folder}/pyramid_bytes.* ${folder}/packed_buffers.*
         ${folder}/mesh*.?pp ${folder}/surface_extent.* ${folder}/object_grids.* ${folder}/world*.?pp ${folder}/io/decimal.*
         ${folder}/io/mesh_*.?pp ${folder}/stages/mesh_*.?pp ${folder}/stages/voxelize*.?pp ${folder}/stages/solid_*.?pp
         ${folder}/stages/cut.* ${folder}/stages/place*.?pp ${folder}/stages/world_bricks.* ${folder}/stages/index*.?pp
         ${folder}/stages/sector_table.* ${folder}/stages/shape_map.* ${folder}/stages/placement_*.?pp ${folder}/exact_sum.*
         ${folder}/grid.hpp ${folder}/solid.hpp ${folder}/surface.hpp ${folder}/scene_affine.* ${folder}/object_boxes.* ${folder}/model_frame.*
         ${folder}/key_words.hpp ${folder}/interior.* ${CMAKE_SOURCE_DIR}/kernels/shared/*.h)
    list(SORT files)
    add_custom_command(
        OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} "-Dfiles=${files}" -Doutput=${output} -P ${CMAKE_SOURCE_DIR}/cmake/write_maker_hashes.cmake
        DEPENDS ${files} ${CMAKE_SOURCE_DIR}/cmake/write_maker_hashes.cmake
        COMMENT "Hashing what makes models"
        VERBATIM)
endfunction()
