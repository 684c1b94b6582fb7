// SPDX-License-Identifier: Apache-2.0
// Files of images that are written in bands, against those that are written as a whole.
#include <gmock/gmock.h>

#include <random>

#include "runtime/base/files/stamp.hpp"
#include "runtime/base/main_memory.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/png.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;
using Texts = std::map<std::string, std::string>;

/// Noise that compresses badly, planes that compress well, ids, and the names of a matte.
Image varied_image(int width, int height) {
    Image image;
    image.width = width;
    image.height = height;
    const size_t pixels = size_t(width) * size_t(height);
    std::mt19937 random(35);
    std::uniform_real_distribution<float> value(-0.5f, 3.0f);
    for (const char* name : {"R", "G", "B", "A", "Z", "N.X", "CryptoObject00.R", "light_key.R"}) {
        std::vector<float> values(pixels);
        for (size_t i = 0; i < pixels; ++i)
            values[i] = *name == 'Z' ? float(i / 100) : value(random);
        image.planes[name] = std::move(values);
    }
    image.planes["R"][3] = NAN;
    image.planes["A"] = std::vector<float>(pixels, 0.75f);
    std::vector<uint32_t> ids(pixels);
    for (size_t i = 0; i < pixels; ++i) ids[i] = uint32_t(i / 7);
    image.id_planes["objectId"] = std::move(ids);
    image.attributes = {{"cryptomatte/1234567/name", "CryptoObject"},
                        {"cryptomatte/1234567/manifest", R"({"a":"00000001"})"}};
    return image;
}

/// The rows from `first` up to `end`.
Image rows_of(const Image& image, int first, int end) {
    Image band;
    band.width = image.width;
    band.height = end - first;
    band.attributes = image.attributes;
    band.first = image.first + glm::ivec2(0, first);
    band.frame = image.frame;
    const auto cut = [&](const auto& plane) {
        return std::vector(plane.begin() + int64_t(first) * image.width,
                           plane.begin() + int64_t(end) * image.width);
    };
    for (const auto& [name, plane] : image.planes) band.planes[name] = cut(plane);
    for (const auto& [name, plane] : image.id_planes) band.id_planes[name] = cut(plane);
    return band;
}

void add_bands(const Image& image, int rows, ImageRows& file) {
    for (int row = 0; row < image.height; row += rows)
        file.add(rows_of(image, row, std::min(row + rows, image.height)));
}

const std::string kHash = "0123456789abcdef0123456789abcdef";

class ImageRowsTest : public FileTest {
  protected:
    std::filesystem::path whole() const { return folder / "whole"; }
    std::filesystem::path in_bands() const { return folder / "bands"; }
};

TEST_F(ImageRowsTest, OfOpenExrHaveTheBytesOfAWholeFile) {
    for (const bool is_part : {false, true})
        for (const bool has_parts : {false, true})
            for (const ColorDepth depth : {ColorDepth::float16, ColorDepth::float32}) {
                Image image = varied_image(61, 107);
                if (is_part) image.first = {5, 11}, image.frame = {200, 150};
                const ExrStorage storage(depth, has_parts);
                const Texts texts = {{"stamp", stamp_of(kHash)}, {"noise", "0.02345"}};
                write_exr(whole(), image, storage, texts);
                for (const int rows : {16, 48, 96, 112}) {
                    Texts before = texts;
                    before["noise"] = "0.00000";
                    const auto file = exr_rows(in_bands(), window_of(image), storage, before);
                    add_bands(image, rows, *file);
                    file->retell("noise", "0.02345");
                    file->finish();
                    EXPECT_TRUE(bytes_of(in_bands()) == bytes_of(whole()))
                        << is_part << has_parts << int(depth) << " in bands of " << rows;
                    EXPECT_EQ(files_in_folder(), 2u);
                }
            }
}

TEST_F(ImageRowsTest, OfPngHaveTheBytesOfAWholeFile) {
    const Image image = varied_image(61, 107);
    for (const ViewTransform transform :
         {ViewTransform::srgb, ViewTransform::none, ViewTransform::filmic, ViewTransform::agx})
        for (const bool keeps_alpha : {false, true})
            for (const int bits : {8, 16}) {
                const PngOptions options{.exposure = 0.5f,
                                         .view_transform = transform,
                                         .bits = bits,
                                         .keep_alpha = keeps_alpha,
                                         .background = {0.1f, 0.2f, 0.3f},
                                         .stamp = stamp_of(kHash)};
                write_png(whole(), image, options);
                EXPECT_TRUE(png_bytes(image, options) == bytes_of(whole()));
                for (const int rows : {16, 64}) {
                    const auto file = png_rows(in_bands(), window_of(image), options);
                    add_bands(image, rows, *file);
                    file->finish();
                    EXPECT_TRUE(bytes_of(in_bands()) == bytes_of(whole()))
                        << int(transform) << keeps_alpha << bits << " in bands of " << rows;
                }
            }
}

TEST_F(ImageRowsTest, ThatEndTooSoonLeaveNoFile) {
    const Image image = varied_image(20, 40);
    const std::vector<std::function<std::unique_ptr<ImageRows>()>> kinds = {
        [&] { return exr_rows(in_bands(), window_of(image), ExrStorage({}, true), {}); },
        [&] { return png_rows(in_bands(), window_of(image)); }};
    for (const auto& begin : kinds) {
        auto file = begin();
        file->add(rows_of(image, 0, 16));
        const Error error = error_of([&] { file->finish(); });
        EXPECT_EQ(error.kind(), ErrorKind::output);
        EXPECT_THAT(error.what(), HasSubstr("are missing"));
        file.reset();
        EXPECT_EQ(files_in_folder(), 0u);
    }
}

TEST_F(ImageRowsTest, OnAFullDiskSayWhyAndLeaveNoFile) {
    const Image image = varied_image(300, 160);
    const std::vector<std::function<std::unique_ptr<ImageRows>()>> kinds = {
        [&] { return exr_rows(in_bands(), window_of(image), {}, {}); },
        [&] { return exr_rows(in_bands(), window_of(image), ExrStorage({}, true), {}); },
        [&] { return png_rows(in_bands(), window_of(image), {.bits = 16}); }};
    for (const auto& begin : kinds)
        for (const rlim_t limit : {1000, 60'000, 120'000}) {
            const FileSizeLimit full(limit);
            const Error error = error_of([&] {
                const auto file = begin();
                add_bands(image, 32, *file);
                file->finish();
            });
            EXPECT_EQ(error.kind(), ErrorKind::output);
            EXPECT_THAT(error.what(), HasSubstr("bands: can't be written: the file grows beyond"));
            EXPECT_EQ(files_in_folder(), 0u);
        }
}

TEST_F(ImageRowsTest, TellATextOfAnotherLengthAsAFault) {
    const Image image = varied_image(20, 40);
    const auto file = exr_rows(in_bands(), window_of(image), {}, {{"noise", "0.00000"}});
    add_bands(image, 16, *file);
    EXPECT_EQ(error_of([&] { file->retell("noise", "12.34567"); }).kind(), ErrorKind::output);
}

TEST_F(ImageRowsTest, OfAnImageLargerThanMemoryAreRefusedByItsReader) {
    write_exr(whole(), varied_image(30, 20));  // 9 channels of 4 bytes
    limit_main_memory(30 * 20 * 36);
    const Error error = error_of([&] { read_exr(whole()); });
    EXPECT_FALSE(fits_memory(read_exr_header(whole())));
    limit_main_memory(0);
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_THAT(error.what(), HasSubstr("whole: an image of 30x20 pixels takes "));
    EXPECT_EQ(read_exr(whole()).width, 30);
}

}  // namespace
}  // namespace voxelume
