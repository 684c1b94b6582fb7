// SPDX-License-Identifier: Apache-2.0
// scene -> scenes that show parts of its light: what channels other than the colour are made of.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/image/image.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// A scene in the same world, whose colours become the channels NAME.R, NAME.G and NAME.B. One
/// without a name has no colours, and its channels are the image's own.
struct LightPass {
    std::string name;
    Scene scene;
    bool is_white = false;  ///< voxels show no colours of their own
};

/// The passes that the channels of a scene ask for. Light adds up, so that a pass is the scene with
/// a part of what shines; no kernel knows of passes. Where the scene has an earlier image, passes
/// go on from what it shows of them, and others get all samples.
std::vector<LightPass> light_passes(const Scene& scene);

/// Leaves mattes out of an image of which they are a pass: an earlier image has only the ranks that
/// its samples gave, to which no others can be added.
void leave_mattes_to_passes(RenderSettings& render);

/// Makes of an image with the planes of all passes the one that was asked for: what is left of the
/// colour without the direct light, and what shadows take away.
void finish_passes(const Scene& scene, Image& image);

}  // namespace voxelume
