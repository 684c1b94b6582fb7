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

/// What a warning is about, in the order of v1::WarningKind.
enum class WarningKind : uint8_t {
    outside_world,        ///< an object of which nothing can lie in the world
    no_voxels,            ///< an object that became no voxel
    thinner_than_voxel,   ///< an object or a part of it
    light_inside_object,  ///< an opaque one
    observer_in_object,   ///< likewise
    nothing_in_view,      ///< no sight ray meets an object
    no_light,             ///< everything in view is black
    finer_than_world,     ///< cubes by more than 4, where an object shows them, or the triangles of
                          ///< an exact mesh
    coarser_than_world,   ///< voxels of a `smooth` model by more than 4
    open_mesh,            ///< where a closed one is needed
    inside_out_mesh,      ///< likewise
    unlikely_unit,        ///< a mesh far larger or smaller than the world
    ignored_materials,    ///< a material library, or textures
    world_not_cached,     ///< it is too large for the cache
    cache_not_writable,   ///< so that each run does everything again
    ignored_scattering,   ///< the medium's, in local light
    rounded_edges,        ///< of a smooth solid whose formula is too deep
    local_volume,         ///< a volumetric image in local light, where global light is asked for
    one_moment,           ///< of an open shutter
};

/// A finished sentence in two parts: where, and what is wrong and what to do. `text` begins with a
/// small letter, as it follows the place and a colon.
struct Warning {
    WarningKind kind = WarningKind::outside_world;
    SourcePlace where;
    std::string text;
    std::string file = {};  ///< that it is about, where files of other folders may have its text
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
