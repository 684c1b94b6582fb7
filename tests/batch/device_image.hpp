// SPDX-License-Identifier: Apache-2.0
// The image of a scene's only frame, made by one device or several.
#pragma once

#include <memory>
#include <vector>

#include "runtime/batch/render_frames.hpp"

namespace voxelume {

inline std::shared_ptr<const Image> image_by(const std::vector<Device>& devices, const Scene& scene,
                                             RenderReport& report,
                                             const BatchProgress& progress = {}) {
    std::shared_ptr<const Image> image;
    BatchOptions options;
    options.progress = progress;
    render_frames(devices, scene, std::move(options), [&](const FrameResult& result) {
        image = result.image;
        report = result.report.report;
    });
    return image;
}

}  // namespace voxelume
