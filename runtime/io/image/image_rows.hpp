// SPDX-License-Identifier: Apache-2.0
// A file of an image that is written band by band, so that the whole image is never in memory.
#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "runtime/image/image.hpp"

namespace voxelume {

/// The number of an OpenEXR chunk's rows. All bands of an image but the last have a multiple of it.
inline constexpr int kBandRows = 16;

/// The pixels of an image, and their position in a picture that they are a part of.
struct ImageWindow {
    glm::ivec2 size;
    glm::ivec2 first{0}, frame{0};  ///< as an Image has them
};

inline ImageWindow window_of(const Image& image) {
    return {{image.width, image.height}, image.first, image.frame};
}

/// Writes an image in bands; its bytes are equal to those of an image that is written as a whole.
class ImageRows {
  public:
    virtual ~ImageRows() = default;

    /// Writes a band, whose rows follow those of the bands before. It has the image's width, and
    /// the channels and attributes of the first band.
    virtual void add(const Image& band) = 0;

    /// Replaces a text of the header by one that is as long, where the format has such texts.
    virtual void retell(const std::string& name, const std::string& text) = 0;

    /// Gives the file its name; all of its rows must be there. Without this call there is no file.
    virtual void finish() = 0;
};

}  // namespace voxelume
