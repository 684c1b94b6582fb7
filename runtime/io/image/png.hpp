// Image -> 8-bit sRGB PNG, and PNG -> 8-bit picture.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <vector>

#include "runtime/image/image.hpp"

namespace voxelume {

/// How linear light becomes a picture for a screen.
struct PngOptions {
    float exposure = 0.0f;       ///< stops: colours are multiplied by 2^exposure
    bool keep_alpha = false;     ///< else the background shows through where alpha is below 1
    glm::vec3 background{0.0f};  ///< linear Rec. 709, exposed like the image
};

/// Pixels of a PNG: red, green, blue and alpha, row 0 at the top.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::array<uint8_t, 4>> pixels;
};

/// The nearest sRGB code (IEC 61966-2-1) of a linear value; outside 0..1 is clamped, NaN is 0.
uint8_t srgb_code(float linear);

/// Writes the planes R G B (and A, 1 where there is none).
///
/// As in OpenEXR, colour is multiplied by alpha: what is seen is colour + (1 - A) * background.
/// With `keep_alpha` it is divided by alpha again, as PNG wants it. The same image gives the same
/// bytes. Throws Error::output.
void write_png(const std::filesystem::path& path, const Image& image,
               const PngOptions& options = {});

/// Reads any PNG as 8-bit RGBA. Throws Error::input for a file that is missing, damaged or above
/// 2^28 pixels.
Picture read_png(const std::filesystem::path& path);

}  // namespace voxelume
