// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/rendered_channels.hpp"

namespace voxelume {

bool adds_color(const RenderSettings& render) {
    const ImageChannels& channels = render.channels;
    if (channels.color) return false;
    const bool shows_noise = channels.samples || channels.noise || channels.has_passes();
    return channels.variance || (render.noise.is_given() && shows_noise);
}

bool shows_points_alone(const ImageChannels& channels) {
    return channels.position && !channels.depth && !channels.distance && !channels.normal &&
           !channels.object && !channels.material;
}

ImageChannels rendered_channels(const RenderSettings& render) {
    ImageChannels channels = render.channels;
    channels.color |= adds_color(render);
    return channels;
}

}  // namespace voxelume
