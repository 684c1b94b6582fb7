// SPDX-License-Identifier: Apache-2.0
// The oracle's pictures as images, which tests write to PNG files.
#pragma once

#include "runtime/image/image.hpp"
#include "tests/oracles/texture_oracle.hpp"

namespace voxelume {

inline Image image_of(const oracle::Picture& picture) {
    Image image{picture.width, picture.height, {}, {}, {}};
    const char* const names[] = {"R", "G", "B"};
    for (size_t c = 0; c < 3; ++c) {
        std::vector<float> values;
        values.reserve(picture.texels.size());
        for (const auto& texel : picture.texels)
            values.push_back(float(oracle::linear_light(texel[c])));
        image.planes[names[c]] = values;
    }
    return image;
}

}  // namespace voxelume
