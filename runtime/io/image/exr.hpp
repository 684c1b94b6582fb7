// Image <-> scanline OpenEXR.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "runtime/image/image.hpp"

namespace voxelume {

/// How R G B A are stored; every other float plane is float32, every id plane UINT.
enum class ColorDepth { float16, float32 };

/// Threads of the process that compress and expand EXR files; none until this is called. The bytes
/// don't depend on it.
void set_exr_threads(int threads);

/// Writes `image` with ZIP compression, the chromaticities of Rec. 709 and its attributes as
/// strings, beside others that the file shall have.
///
/// Returns how many values of R G B A weren't finite: they are written as 0, and the caller tells
/// the user. Halves are rounded to nearest and clamped to +-65504. The same image gives the same
/// bytes. The file is verified before it appears under its name. Throws Error::output.
size_t write_exr(const std::filesystem::path& path, const Image& image,
                 ColorDepth color = ColorDepth::float16,
                 const std::map<std::string, std::string>& others = {});

/// Reads every channel of a flat, single-part or first-part OpenEXR file, scanline or tiled; text
/// attributes come along.
///
/// Throws Error::input for a file that is missing, damaged, deep, subsampled or declares more
/// pixels than it can hold.
Image read_exr(const std::filesystem::path& path);

/// What a header says, for people.
struct ExrHeader {
    int width = 0;
    int height = 0;
    std::string layout;       ///< "scanline", "tiled", "deep scanline", "deep tiled"
    std::string compression;  ///< "ZIP"
    std::map<std::string, std::string> channels;    ///< name -> "half", "float" or "uint"
    std::map<std::string, std::string> attributes;  ///< text and chromaticities, as text
};

/// Reads the header alone. Throws Error::input.
ExrHeader read_exr_header(const std::filesystem::path& path);

}  // namespace voxelume
