// SPDX-License-Identifier: Apache-2.0
// Images -> arrays, by the helper program voxelume-image-decoder.
//
// The helper is started as `voxelume-image-decoder VERSION NAME QUESTION NUMBER...` for one file,
// its input. `NAME` begins its messages. It answers ImageAnswers: a refusal is the end; otherwise
// what image_codec.cpp receives for the question, ImageAnswer::end last.
#pragma once

#include <filesystem>
#include <string>

#include "runtime/base/error.hpp"
#include "runtime/io/image_codec/deep_exr_decoder.hpp"
#include "runtime/io/image_codec/exr_decoder.hpp"
#include "runtime/io/image_codec/picture_decoder.hpp"

namespace voxelume {

/// Where images are decoded.
struct ImageDecoding {
    bool is_apart = false;               ///< by the helper; otherwise by this process
    std::filesystem::path program = {};  ///< the helper; empty for the one that is installed
    double seconds = 0;                  ///< for an answer; 0 for a limit by the file's size
};

/// Sets it for the whole process, before other threads decode.
void decode_images(const ImageDecoding& how);

/// True if the functions below are to be called instead of the decoders that they stand for.
bool decodes_apart();

/// A helper that was missing, late, or ended before it had answered. The file may be whole.
class ImageDecoderError : public Error {
  public:
    using Error::Error;
};

enum class PictureKind { png, jpeg };

// Each function does what the decoder of that name does, and throws what it throws, and
// ImageDecoderError, whose kind is input.

ExrHeader ask_exr_header(const InputFile& file);
Image ask_exr(const InputFile& file, ExrSink& sink);
DeepExrHeader ask_deep_exr_header(const InputFile& file);
/// `size` are the columns and rows of the file.
void ask_deep_exr(const InputFile& file, glm::ivec2 size, uint32_t max_samples,
                  const TakeDeepExrRow& take);
Picture ask_picture(PictureKind kind, const InputFile& file, uint64_t max_pixels,
                    const PictureRoom& room);
Picture ask_picture(PictureKind kind, std::span<const uint8_t> bytes,
                    const std::filesystem::path& name, uint64_t max_pixels,
                    const PictureRoom& room);
/// Decodes several PNGs by one run of the helper.
std::vector<Picture> ask_pngs(std::span<const std::span<const uint8_t>> pictures,
                              const std::filesystem::path& name, uint64_t max_pixels);
PngShape ask_png_shape(const InputFile& file);
/// Decodes the numbers of several PNGs, which have these names, one after another.
std::vector<std::byte> ask_png_values(std::span<const std::vector<uint8_t>> pngs,
                                      std::span<const std::filesystem::path> names,
                                      const PngShape& shape);

}  // namespace voxelume
