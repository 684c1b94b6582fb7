// SPDX-License-Identifier: Apache-2.0
// Image <-> scanline OpenEXR.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "runtime/image/image.hpp"
#include "runtime/io/image/image_rows.hpp"
#include "runtime/io/image_codec/exr_decoder.hpp"

namespace voxelume {

/// The stored type of R G B A. Every other float plane is stored as float32, every id plane as
/// UINT.
enum class ColorDepth { float16, float32 };

/// The storage format of an image.
struct ExrStorage {
    ColorDepth color = ColorDepth::float16;
    bool is_multi_part = false;  ///< each layer is a part of its own, see exr_layers.hpp

    // NOLINTNEXTLINE(google-explicit-constructor): a depth alone says how, too
    constexpr ExrStorage(ColorDepth depth = ColorDepth::float16, bool has_parts = false)
        : color(depth), is_multi_part(has_parts) {}
};

/// Sets how many threads of the process compress and expand EXR files; before the first call there
/// are none. The bytes don't depend on the number.
void set_exr_threads(int threads);

/// Writes `image` with ZIP compression, the chromaticities of Rec. 709, and its attributes and
/// `others` as strings. If there are several parts, the first has these, and each part of a matte
/// has that matte's own.
///
/// Returns how many values of R G B A weren't finite. They are written as 0, and the caller tells
/// the user. Halves are rounded to nearest and clamped to +-65504. Equal images give equal bytes.
/// The file is verified before it appears under its name. Throws Error::output.
size_t write_exr(const std::filesystem::path& path, const Image& image,
                 const ExrStorage& storage = {},
                 const std::map<std::string, std::string>& others = {});

/// The file that `write_exr` writes, in bands. A text `noise` that is only known at the end may be
/// replaced then. Chunks of all parts but the first wait for the last band in a hidden file next to
/// it.
std::unique_ptr<ImageRows> exr_rows(const std::filesystem::path& path, const ImageWindow& window,
                                    const ExrStorage& storage,
                                    const std::map<std::string, std::string>& others);

/// The bytes of main memory that writing a band takes besides the band, whose rows have
/// `row_bytes`.
double exr_band_bytes(double row_bytes);

/// The bytes of the file that `write_exr` writes.
std::string exr_bytes(const Image& image, const ExrStorage& storage = {},
                      const std::map<std::string, std::string>& others = {});

/// True if main memory has room for the channels of a flat file in addition to what the process
/// holds.
bool fits_memory(const ExrHeader& header);

/// Reads every channel of a flat OpenEXR file, scanline or tiled, with its text attributes and,
/// where its data window is a part of its display window, the place of that.
///
/// A file with several parts gives the first and all flat ones with the same data window. A
/// channel of a later part whose name is taken has the part's name before its own: "albedo.R".
///
/// Throws Error::input for a file that is missing, damaged, deep or subsampled, or that declares
/// more pixels than it can hold, and Error::limit for one that memory doesn't hold.
Image read_exr(const std::filesystem::path& path);

/// Reads the headers alone. Throws Error::input.
ExrHeader read_exr_header(const std::filesystem::path& path);

}  // namespace voxelume
