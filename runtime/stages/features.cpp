// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/features.hpp"

namespace voxelume {
namespace {

/// The constants of the world's content and of its lights.
Defines defines_of_voxels(const Features& f) {
    return {{"VXL_CUBES", f.cubes},
            {"VXL_SMOOTH", f.smooth},
            {"VXL_EXACT", f.exact()},
            {"VXL_TRIANGLES", f.triangles},
            {"VXL_SHADING_NORMALS", f.shading_normals()},
            {"VXL_CORNER_NORMALS", f.corner_normals},
            {"VXL_VOXEL_NORMALS", f.voxel_normals},
            {"VXL_RESAMPLED_CUBES", f.resampled_cubes},
            {"VXL_SOLIDS", f.solids},
            {"VXL_SOLIDS_AHEAD", f.solids_ahead},
            {"VXL_SOLID_KINDS", f.solid_kinds},
            {"VXL_FIELD_LISTS", f.field_lists},
            {"VXL_FIELD_CHAINS", f.field_chains},
            {"VXL_CHAIN_DEPTH", f.chain_depth},
            {"VXL_SOURCES", f.sources()},
            {"VXL_MIXED", f.mixed},
            {"VXL_ATTRIBUTES", f.attributes},
            {"VXL_COLORS", f.colors},
            {"VXL_TEXTURES", f.textures()},
            {"VXL_WORN_TRIANGLES", f.worn_triangles},
            {"VXL_SOURCE_MESHES", f.source_meshes},
            {"VXL_TEXTURE_ALPHA", f.texture_alpha},
            {"VXL_TEXTURE_MAPS", f.texture_maps},
            {"VXL_MEDIUM", f.medium},
            {"VXL_MEDIUM_GRID", f.medium_grid},
            {"VXL_MEDIUM_COLORS", f.medium_colors},
            {"VXL_SCATTERING", f.scattering},
            {"VXL_NEAR_LIGHT", f.near_light},
            {"VXL_SHADOWS", f.shadows},
            {"VXL_AREA_SAMPLES", f.area_samples},
            {"VXL_CHOSEN_AREAS", f.chosen_areas},
            {"VXL_CHECKER", f.checker},
            {"VXL_TINTED", f.tinted}};
}

/// The constants of how rays continue, and of the results that are asked for.
Defines defines_of_rays(const Features& f) {
    return {{"VXL_PATHS", f.paths},
            {"VXL_TRANSMISSION", f.transmission},
            {"VXL_REFRACTS", f.refracts},
            {"VXL_ABSORBS", f.absorbs},
            {"VXL_FILTER", f.filter},
            {"VXL_FILTERED", f.filtered_refraction},
            {"VXL_CUBE_BODIES", f.cube_bodies},
            {"VXL_VOXEL_OPACITY", f.voxel_opacity},
            {"VXL_OBSERVER_IN_MEDIUM", f.observer_in_medium},
            {"VXL_GLOBAL", f.global},
            {"VXL_OWN_LIGHT", f.own_light},
            {"VXL_PHYSICAL", f.physical},
            {"VXL_ROUGH_GLASS", f.rough_glass},
            {"VXL_COAT", f.coat},
            {"VXL_WEAK_FACETS", f.weak_facets},
            {"VXL_AREA_SHARES", f.area_shares},
            {"VXL_DIRECT_ALONE", f.direct_alone},
            {"VXL_SCATTERED_SIGHT", f.scattered_sight},
            {"VXL_LENS", f.lens},
            {"VXL_BLADES", f.blades},
            {"VXL_EMITTERS", f.emitters},
            {"VXL_SKY", f.sky},
            {"VXL_SKY_RAYS", f.sky_rays},
            {"VXL_SKY_HIDDEN", f.sky_hidden},
            {"VXL_MEDIA", f.media},
            {"VXL_MEDIUM_SET_CAPPED", f.medium_set_capped},
            {"VXL_INSTANCES", f.instances},
            {"VXL_RADIANCE", f.radiance},
            {"VXL_POSITIONS", f.positions},
            {"VXL_NORMALS", f.normals},
            {"VXL_HIT_ATTRIBUTES", f.hit_attributes}};
}

}  // namespace

Defines Features::defines(const Device& device) const {
    Defines defines = defines_of_voxels(*this);
    const Defines of_rays = defines_of_rays(*this);
    defines.insert(defines.end(), of_rays.begin(), of_rays.end());
    defines.emplace_back("VXL_NATIVE_DIVIDE", device.is_cpu());
    return defines;
}

}  // namespace voxelume
