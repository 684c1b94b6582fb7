// SPDX-License-Identifier: Apache-2.0
// Probable mistakes in a scene or its files, which don't stop a call.
#pragma once

#include <string>

namespace voxelume::v1 {

/// The subject of a warning. More may be added at the end.
enum class WarningKind {
    outside_world,        ///< nothing of an object can lie in the world
    no_voxels,            ///< an object became no voxel
    thinner_than_voxel,   ///< an object, or a part of it, is thinner than the voxels that show it
    light_inside_object,  ///< an opaque object encloses a light
    observer_in_object,   ///< an opaque object encloses the observer
    nothing_in_view,      ///< no sight ray meets an object, in no frame
    no_light,             ///< what is in view is black, in all frames
    finer_than_world,     ///< cubes are finer than the world's, by more than 4, or a voxel has more
                          ///< than 128 triangles
    coarser_than_world,   ///< a model's voxels are coarser than the world's, by more than 4
    open_mesh,            ///< a mesh has holes, and its surface or material needs an inside
    inside_out_mesh,      ///< a mesh's faces turn inwards, and it needs an inside
    unlikely_unit,        ///< a mesh is far larger or smaller than the world
    ignored_materials,    ///< a mesh's material library or textures, or parts of them, aren't shown
    world_not_cached,     ///< the world is too large to be kept on disk
    cache_not_writable,   ///< nothing can be kept on disk
    ignored_scattering,   ///< local light doesn't follow what the medium scatters
    rounded_edges,        ///< a smooth solid is nested too deeply for all edges to stay sharp
    one_moment,           ///< a shutter is open, and an image with one sample shows one moment
    no_effect             ///< a setting does nothing, because of another
};

/// The kind's name in JSON: "outside_world".
const char* name_of(WarningKind kind);

/// A sentence in two parts, which a person reads as "WHERE: TEXT".
struct Warning {
    WarningKind kind = WarningKind::outside_world;  ///< kind, for programs
    std::string where{};  ///< a place in the scene, "room.json:12:9: objects[0]", or a file
    std::string text{};   ///< what is wrong, and what to do
};

}  // namespace voxelume::v1
