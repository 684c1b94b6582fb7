// SPDX-License-Identifier: Apache-2.0
// Reads deep OpenEXR files with OpenEXR's own reader.
#pragma once

#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineInputFile.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <glm/vec4.hpp>
#include <vector>

namespace voxelume {

/// R, G, B and A of a deep image's pixels, flattened from what OpenEXR's own reader returns.
inline std::vector<glm::dvec4> flattened_file(const std::filesystem::path& path, size_t width,
                                              size_t height) {
    Imf::DeepScanLineInputFile file(path.c_str());
    std::vector<uint32_t> counts(width * height);
    std::array<std::vector<float*>, 5> pointers;
    constexpr std::array kChannels = {"R", "G", "B", "A", "Z"};
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(
        Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 4 * width));
    for (size_t c = 0; c < kChannels.size(); ++c) {
        pointers[c].resize(counts.size());
        buffer.insert(kChannels[c],
                      Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers[c].data()),
                                     sizeof(float*), sizeof(float*) * width, sizeof(float)));
    }
    file.setFrameBuffer(buffer);
    file.readPixelSampleCounts(0, int(height) - 1);
    std::vector<std::vector<float>> values(counts.size() * kChannels.size());
    for (size_t p = 0; p < counts.size(); ++p)
        for (size_t c = 0; c < kChannels.size(); ++c) {
            values[p * kChannels.size() + c].resize(counts[p] + 1);
            pointers[c][p] = values[p * kChannels.size() + c].data();
        }
    file.readPixels(0, int(height) - 1);
    std::vector<glm::dvec4> flat(counts.size(), glm::dvec4(0));
    for (size_t p = 0; p < counts.size(); ++p)
        for (uint32_t n = 0; n < counts[p]; ++n) {
            if (n > 0) {
                EXPECT_GE(pointers[4][p][n], pointers[4][p][n - 1]) << "not front to back";
            }
            flat[p] += (1 - flat[p].a) * glm::dvec4(pointers[0][p][n], pointers[1][p][n],
                                                    pointers[2][p][n], pointers[3][p][n]);
        }
    return flat;
}

}  // namespace voxelume
