// SPDX-License-Identifier: Apache-2.0
// Image -> PNG for a screen, and PNG -> 8-bit picture.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "runtime/image/image.hpp"
#include "runtime/image/view_transform.hpp"
#include "runtime/io/image/image_rows.hpp"
#include "runtime/io/image_codec/picture_decoder.hpp"

namespace voxelume {

/// The conversion of linear light to a picture for a screen.
struct PngOptions {
    float exposure = 0.0f;  ///< stops: colours are multiplied by 2^exposure
    ViewTransform view_transform = ViewTransform::srgb;
    int bits = 8;                ///< a channel: 8 or 16
    bool keep_alpha = false;     ///< if false, the background shows through where alpha is below 1
    glm::vec3 background{0.0f};  ///< linear Rec. 709, exposed like the image
    double pixel_aspect = 1;     ///< the width of a pixel over its height
    std::string stamp = {};      ///< stamp of the file, as a text chunk; empty for none
};

/// The sRGB code (IEC 61966-2-1) nearest to a linear value. Values outside 0..1 are clamped; NaN
/// gives 0.
uint8_t srgb_code(float linear);

/// Writes the planes R, G, B and A; A is 1 where the image has none.
///
/// As in OpenEXR, colour is multiplied by alpha: the visible colour is colour + (1 - A) *
/// background. With `keep_alpha` the colour is divided by alpha again, as PNG requires. Equal
/// images give equal bytes. Throws Error::output.
void write_png(const std::filesystem::path& path, const Image& image,
               const PngOptions& options = {});

/// The file that `write_png` writes, in bands.
std::unique_ptr<ImageRows> png_rows(const std::filesystem::path& path, const ImageWindow& window,
                                    const PngOptions& options = {});

/// The bytes of the file that `write_png` writes.
std::string png_bytes(const Image& image, const PngOptions& options = {});

/// Reads any PNG as 8-bit RGBA. Throws Error::input for a file that is missing, damaged or above
/// 2^28 pixels, and Error::limit for one that memory doesn't hold.
Picture read_png(const std::filesystem::path& path);

/// Decodes the bytes of a PNG as read_png does, with at most `max_pixels`; `name` opens the
/// messages.
Picture parse_png(std::span<const uint8_t> bytes, const std::filesystem::path& name,
                  uint64_t max_pixels);

/// Decodes several PNGs as parse_png does. It takes less time than one after another where a
/// program of its own decodes them.
std::vector<Picture> parse_pngs(std::span<const std::span<const uint8_t>> pictures,
                                const std::filesystem::path& name, uint64_t max_pixels);

}  // namespace voxelume
