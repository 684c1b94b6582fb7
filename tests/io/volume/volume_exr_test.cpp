// SPDX-License-Identifier: Apache-2.0
#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineInputFile.h>
#include <gmock/gmock.h>

#include "tests/io/volume/volume_damage.hpp"
#include "tests/support/volume_samples.hpp"

namespace voxelume {

using testing::HasSubstr;

namespace {

constexpr std::array kChannels = {"R", "G", "B", "A", "Z", "ZBack"};
using DeepSample = std::array<float, kChannels.size()>;

/// Reads a whole deep image by OpenEXR's own reader: row by row, each pixel's samples in file
/// order.
std::vector<std::vector<DeepSample>> read_deep(const std::filesystem::path& path, size_t pixels,
                                               size_t width) {
    Imf::DeepScanLineInputFile file(path.c_str());
    std::vector<uint32_t> counts(pixels);
    std::array<std::vector<float*>, kChannels.size()> pointers;
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(
        Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 4 * width));
    for (size_t c = 0; c < kChannels.size(); ++c) {
        pointers[c].resize(pixels);
        buffer.insert(kChannels[c],
                      Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers[c].data()),
                                     sizeof(float*), sizeof(float*) * width, sizeof(float)));
    }
    file.setFrameBuffer(buffer);
    file.readPixelSampleCounts(0, int(pixels / width) - 1);
    std::array<std::vector<std::vector<float>>, kChannels.size()> values;
    for (size_t c = 0; c < kChannels.size(); ++c) {
        values[c].resize(pixels);
        for (size_t p = 0; p < pixels; ++p) {
            values[c][p].resize(counts[p] + 1);
            pointers[c][p] = values[c][p].data();
        }
    }
    file.readPixels(0, int(pixels / width) - 1);
    std::vector<std::vector<DeepSample>> samples(pixels);
    for (size_t p = 0; p < pixels; ++p)
        for (uint32_t n = 0; n < counts[p]; ++n) {
            DeepSample sample;
            for (size_t c = 0; c < kChannels.size(); ++c) sample[c] = values[c][p][n];
            samples[p].push_back(sample);
        }
    return samples;
}

}  // namespace

class VolumeExrTest : public FileTest {
  protected:
    std::filesystem::path path() const { return folder / "a.exr"; }
};

TEST_F(VolumeExrTest, AllButRoundingComesBack) {
    for (const DisplayShape shape :
         {DisplayShape::pyramid, DisplayShape::sector, DisplayShape::ball, DisplayShape::box}) {
        const Volume volume = rays_volume(shape);
        write_volume(path(), volume);
        Volume back = read_volume(path());
        ASSERT_EQ(back.colors.size(), volume.colors.size());
        for (size_t i = 0; i < volume.colors.size(); ++i)
            for (int c = 0; c < 3; ++c)  // multiplied and divided by alpha; lost where alpha is 0
                EXPECT_NEAR(back.colors[i][c], volume.opacities[i] > 0 ? volume.colors[i][c] : 0.0f,
                            3e-7f);
        back.colors = volume.colors;
        expect_same_volume(back, volume);
    }
}

TEST_F(VolumeExrTest, SamplesAreTidy) {
    write_volume(path(), rays_volume());
    size_t count = 0, points = 0;
    for (const auto& samples : read_deep(path(), 35, 7))
        for (size_t i = 0; i < samples.size(); ++i) {
            const auto [r, g, b, a, z, z_back] = samples[i];
            ++count;
            points += z == z_back;
            EXPECT_TRUE(a >= 0 && a <= 1);
            EXPECT_LE(z, z_back);
            if (i == 0) continue;
            EXPECT_GE(z, samples[i - 1][5]);
            EXPECT_GT(z, samples[i - 1][4]);
        }
    EXPECT_EQ(count, rays_volume().indices.size());
    EXPECT_GT(points, 20u);
}

TEST_F(VolumeExrTest, FlatteningItGivesTheFlatImage) {
    const Volume volume = rays_volume();
    write_volume(path(), volume);
    const auto deep = read_deep(path(), 35, 7);
    for (uint64_t pixel = 0; pixel < 35; ++pixel) {
        glm::dvec4 flat(0), expected(0);
        for (const DeepSample& s : deep[pixel])
            flat += (1 - flat.a) * glm::dvec4(s[0], s[1], s[2], s[3]);
        for (size_t i = 0; i < volume.indices.size(); ++i) {
            if (volume.indices[i] % 35 != pixel) continue;
            const double alpha = volume.opacities[i];
            expected += (1 - expected.a) * glm::dvec4(glm::dvec3(volume.colors[i]) * alpha, alpha);
        }
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(flat[c], expected[c], 1e-6) << pixel;
    }
}

TEST_F(VolumeExrTest, WhatIsMetStandsAtItsDepthAndSpaceFillsItsStep) {
    Volume volume = rays_volume(DisplayShape::pyramid, 0);
    volume.indices = {3 + 7 * (2 + 5 * 4), 3 + 7 * (2 + 5 * 6)};
    volume.colors = {{0.5f, 0.25f, 1.0f}, {1, 1, 1}};
    volume.opacities = {0.5f, 1.0f};
    volume.depths = {2.0f, 2.625f};
    volume.objects = {0, 4};
    volume.kinds = {VoxelKind::space, VoxelKind::object};
    write_volume(path(), volume);
    const auto samples = read_deep(path(), 35, 7)[3 + 7 * 2];
    ASSERT_EQ(samples.size(), 2u);
    EXPECT_EQ(samples[0],
              (DeepSample{0.25f, 0.125f, 0.5f, 0.5f, float(0.7 + 0.3 * 4), float(0.7 + 0.3 * 5)}));
    EXPECT_EQ(samples[1], (DeepSample{1, 1, 1, 1, 2.625f, 2.625f}));
}

TEST_F(VolumeExrTest, ExrheaderReadsIt) {
    write_volume(path(), rays_volume());
    const ProgramResult result = run_tool(folder, "exrheader a.exr");
    if (result.exit_code == 127) GTEST_SKIP() << "exrheader isn't installed";
    EXPECT_EQ(result.exit_code, 0);
    for (const char* text : {"deepscanline", "objectId, 32-bit unsigned integer",
                             "ZBack, 32-bit floating-point", "zip, individual scanlines"})
        EXPECT_THAT(result.out, HasSubstr(text));
}

TEST_F(VolumeExrTest, TheSameVolumeGivesTheSameBytes) {
    write_volume(path(), rays_volume());
    write_volume(folder / "b.exr", rays_volume());
    EXPECT_TRUE(bytes_of(path()) == bytes_of(folder / "b.exr"));
}

TEST_F(VolumeExrTest, ALatticeAndStepsBeyondFloatAreRefused) {
    const Error error = error_of([&] { write_volume(path(), lattice_volume()); });
    EXPECT_EQ(error.exit_code(), 2);
    EXPECT_THAT(error.what(), HasSubstr("is a lattice; write .vdb"));
    Volume thin = rays_volume();
    thin.frame.step = 1e-9;
    EXPECT_EQ(error_of([&] { write_volume(path(), thin); }).exit_code(), 5);
    EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(VolumeExrTest, DamagedFilesNeverReachOpenExr) {
    write_volume(path(), rays_volume());
    expect_truncations_refused(path(), path(), 97);
    EXPECT_EQ(count_refused_changes(path(), path(), 300), 300u);
}

TEST_F(VolumeExrTest, AFullDiskLeavesNothing) {
    expect_full_disk_leaves_nothing(path(), rays_volume());
}

}  // namespace voxelume
