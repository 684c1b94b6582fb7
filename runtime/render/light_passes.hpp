// SPDX-License-Identifier: Apache-2.0
// scene -> scenes that show parts of its light, from which channels other than the colour are made.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/image/image.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// A scene in the same world, whose colours become the channels NAME.R, NAME.G and NAME.B. A pass
/// without a name has no colours, and its channels go to the image under their own names.
struct LightPass {
    std::string name;
    Scene scene;
    bool is_white = false;  ///< voxels show no colours of their own
};

/// The passes that the channels of a scene ask for. Light adds up, so a pass is the scene with a
/// part of its light sources; no kernel knows of passes. If the scene has an earlier image, passes
/// continue those parts that it shows, and other passes get all samples.
std::vector<LightPass> light_passes(const Scene& scene);

/// Leaves mattes out of an image if they are a pass: an earlier image has only the final ranks of
/// its samples, to which no others can be added.
void leave_mattes_to_passes(RenderSettings& render);

/// Turns an image with the planes of all passes into the one that was asked for: computes the
/// indirect light as the colour without the direct light, and the light that shadows remove.
void finish_passes(const Scene& scene, Image& image);

}  // namespace voxelume
