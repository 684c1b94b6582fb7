// What rendering for callers shares with planning.
#pragma once

#include "runtime/scene/scene.hpp"
#include "runtime/voxelume/image.hpp"

namespace voxelume::api {

inline ImageChannels inside(const v1::Channels& channels) {
    return {channels.color, channels.depth, channels.position, channels.normal, channels.object};
}

}  // namespace voxelume::api
