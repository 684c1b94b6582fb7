// SPDX-License-Identifier: Apache-2.0
// What is probably wrong and doesn't stop a run.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "runtime/base/source_place.hpp"

namespace voxelume {

/// The subject of a warning, in the order of v1::WarningKind.
enum class WarningKind : uint8_t {
    outside_world,        ///< an object of which nothing can lie in the world
    no_voxels,            ///< an object that has no voxels
    thinner_than_voxel,   ///< an object, or a part of it, thinner than its voxels
    light_inside_object,  ///< a light inside an opaque object
    observer_in_object,   ///< an observer inside an opaque object
    nothing_in_view,      ///< no sight ray meets an object
    no_light,             ///< everything in view is black
    finer_than_world,     ///< cubes that an object shows, more than 4 times finer than the world's
                          ///< voxels, or the triangles of an exact mesh
    coarser_than_world,   ///< voxels of a `smooth` model more than 4 times coarser than the world's
    open_mesh,            ///< a mesh with holes where a closed one is needed
    inside_out_mesh,      ///< a mesh with faces turned inwards where a closed one is needed
    unlikely_unit,        ///< a mesh far larger or smaller than the world
    ignored_materials,    ///< a material library, or textures
    world_not_cached,     ///< a world that is too large for the cache
    cache_not_writable,  ///< a cache folder that can't be written, so that each run does everything
                         ///< again
    ignored_scattering,  ///< scattering of the medium in local light
    rounded_edges,       ///< edges of a smooth solid whose formula is too deep
    one_moment,          ///< an image that shows one moment of an open shutter
    no_effect,           ///< a setting that others keep from doing anything
};

/// A finished sentence in two parts: where, and what is wrong and what to do. `text` begins with a
/// small letter, as it follows the place and a colon.
struct Warning {
    WarningKind kind = WarningKind::outside_world;
    SourcePlace where;
    std::string text;
    std::string file = {};  ///< the subject's file, where files of other folders may share its text
};

/// True if both are about the same, whatever numbers their texts have.
inline bool is_same(const Warning& a, const Warning& b) {
    return a.kind == b.kind && a.where == b.where;
}

/// Adds a warning to those of which none is the same. Returns whether there was none.
inline bool add_once(Warning warning, std::vector<Warning>& warnings) {
    const auto same = [&](const Warning& known) { return is_same(known, warning); };
    if (std::ranges::any_of(warnings, same)) return false;
    warnings.push_back(std::move(warning));
    return true;
}

}  // namespace voxelume
