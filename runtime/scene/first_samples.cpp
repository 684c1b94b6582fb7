// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/first_samples.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace voxelume {

int contrast_reach(const RenderSettings& render) {
    // The contrast lies between the middles of two pixels, at least half a pixel behind one of
    // them.
    return std::max(int(std::ceil(render.filter.width / 2)) - 1, 0);
}

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
    const int border = 1 + contrast_reach(render);
    const glm::ivec2 low = glm::max(render.crop.first - border, glm::ivec2(0));
    const glm::ivec2 high = glm::min(render.crop.first + render.size + border, render.crop.frame);
    render.crop.first = low;
    render.size = high - low;
    return first;
}

RenderSettings retained_settings(const Scene& scene) {
    return is_adaptive(scene.render) ? first_samples_of(scene).render : scene.render;
}

}  // namespace voxelume
