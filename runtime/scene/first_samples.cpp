// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/first_samples.hpp"

#include <glm/common.hpp>

namespace voxelume {

bool is_adaptive(const RenderSettings& render) {
    return render.adaptive > 0 && render.samples > kComparedSamples &&
           render.light == LightMode::local && !render.noise.is_given();
}

Scene first_samples_of(const Scene& scene) {
    Scene first = scene;
    RenderSettings& render = first.render;
    render.adaptive = 0;
    render.samples = kComparedSamples;
    ImageChannels& channels = render.channels;
    channels.color = channels.depth = channels.normal = channels.object = true;
    if (render.crop.is_whole()) return first;
    const glm::ivec2 low = glm::max(render.crop.first - 1, glm::ivec2(0));
    const glm::ivec2 high = glm::min(render.crop.first + render.size + 1, render.crop.frame);
    render.crop.first = low;
    render.size = high - low;
    return first;
}

}  // namespace voxelume
