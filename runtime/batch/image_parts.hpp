// SPDX-License-Identifier: Apache-2.0
// tiles that several devices made of one image -> the image.
#pragma once

#include <vector>

#include "runtime/render/renderer.hpp"

namespace voxelume {

/// The part of an image that one device rendered.
struct ImagePart {
    Image image;                   ///< undefined outside of `tiles`
    std::vector<TileRange> tiles;  ///< ranges of tiles of 4 x 4 pixels
    RenderReport report;
};

/// Adds what one device made of an image to what others did, as join_parts does.
void add_report(const RenderReport& part, RenderReport& sum);

/// The image of parts that have all its tiles. `report` counts the rays of all; its world and its
/// times are those of the device that took longest. Throws Error::render if tiles are missing.
Image join_parts(std::vector<ImagePart> parts, RenderReport& report);

}  // namespace voxelume
