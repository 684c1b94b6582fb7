// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/display/line_surfaces.hpp"

#include <kernels/shared/display.h>

#include <cmath>
#include <vector>

#include "runtime/scene/predicates.hpp"

namespace voxelume {

uint32_t log_clear(double opacity) {
    if (opacity >= 1) return VXL_OPAQUE_LOG;
    return uint32_t(std::lround(-std::log1p(-opacity) * double(VXL_LOG_UNITS)));
}

LineSurfaces line_surfaces(const Device& device, const Scene& scene) {
    std::vector<float> opacities;
    std::vector<uint32_t> logs;
    for (const Material& material : scene.materials) {
        const Material shown = whitted_material(material);
        opacities.push_back(shown.refraction > 0 ? 2.0f : shown.opacity);
        logs.push_back(log_clear(double(opacities.back())));
    }
    const std::vector<uint32_t> ranks = object_ranks(scene.objects);
    LineSurfaces surfaces;
    surfaces.ranks = Buffer<uint32_t>(device, "line ranks", std::span<const uint32_t>(ranks));
    surfaces.opacities = Buffer<float>(device, "line opacities", std::span<const float>(opacities));
    surfaces.logs = Buffer<uint32_t>(device, "line logs", std::span<const uint32_t>(logs));
    return surfaces;
}

}  // namespace voxelume
