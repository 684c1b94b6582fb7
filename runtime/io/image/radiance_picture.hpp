// SPDX-License-Identifier: Apache-2.0
// Radiance's pictures (.hdr) -> linear colours.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace voxelume {

/// Linear red, green and blue of each pixel, in rows from the top down.
struct ColorPicture {
    int width = 0, height = 0;
    std::vector<float> values;
};

/// The size in an .hdr's header. Throws Error::input, which begins with `name`, for bytes that
/// aren't an .hdr, or whose rows don't go from left to right.
glm::ivec2 parse_radiance_size(std::span<const uint8_t> bytes, const std::filesystem::path& name);

/// Decodes an .hdr: four bytes red, green, blue and exponent, as they are or in runs, both old and
/// new ones. Exposures that its header notes aren't undone. Throws as parse_radiance_size does, and
/// Error::input for damaged bytes and for more than `max_pixels`.
ColorPicture parse_radiance(std::span<const uint8_t> bytes, const std::filesystem::path& name,
                            uint64_t max_pixels);

}  // namespace voxelume
