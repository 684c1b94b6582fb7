// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/png.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/file_fixture.hpp"

namespace voxelume {

using testing::HasSubstr;
using testing::Not;
using Pixel = std::array<uint8_t, 4>;

namespace {

/// An image of 3 x 2 pixels: half grey, primaries of different strengths, white above 1, black and
/// a negative value.
Image small_image() {
    Image image{3, 2, {}, {}, {}};
    image.planes["R"] = {0.5f, 1.0f, 0.0f, 2.0f, 0.0f, -1.0f};
    image.planes["G"] = {0.5f, 0.0f, 0.25f, 2.0f, 0.0f, 0.1f};
    image.planes["B"] = {0.5f, 0.0f, 0.0f, 2.0f, 0.0f, 0.01f};
    return image;
}

Image pixel(float r, float g, float b, float a) {
    return Image{1, 1, {{"R", {r}}, {"G", {g}}, {"B", {b}}, {"A", {a}}}, {}, {}};
}

}  // namespace

class PngTest : public FileTest {
  protected:
    std::filesystem::path path() const { return folder / "a.png"; }
    Pixel written(const Image& image, const PngOptions& options) {
        write_png(path(), image, options);
        return read_png(path()).pixels.at(0);
    }
};

TEST(SrgbCode, IsTheNearestOfTheStandardsCurve) {
    EXPECT_EQ(srgb_code(0.0f), 0);
    EXPECT_EQ(srgb_code(1.0f), 255);
    EXPECT_EQ(srgb_code(0.5f), 188);
    EXPECT_EQ(srgb_code(0.18f), 118);
    EXPECT_EQ(srgb_code(0.0031308f), 10);
    // The oracle is the curve's forward formula in double, away from ties of rounding.
    for (int i = 0; i <= 10000; ++i) {
        const double linear = i / 10000.0;
        const double code =
            255.0 *
            (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
        if (std::abs(code - std::floor(code) - 0.5) < 1e-3) continue;
        EXPECT_EQ(srgb_code(static_cast<float>(linear)), std::lround(code)) << linear;
    }
}

TEST(SrgbCode, ClampsWhatIsOutsideAndTakesNanAsBlack) {
    EXPECT_EQ(srgb_code(-3.0f), 0);
    EXPECT_EQ(srgb_code(std::numeric_limits<float>::infinity()), 255);
    EXPECT_EQ(srgb_code(std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST_F(PngTest, RowsAndChannelsAreInTheirPlaces) {
    write_png(path(), small_image());
    const Picture picture = read_png(path());
    EXPECT_EQ(picture.width, 3);
    EXPECT_EQ(picture.height, 2);
    const std::vector<Pixel> pixels = {{188, 188, 188, 255}, {255, 0, 0, 255}, {0, 137, 0, 255},
                                       {255, 255, 255, 255}, {0, 0, 0, 255},   {0, 89, 25, 255}};
    EXPECT_EQ(picture.pixels, pixels);
}

TEST_F(PngTest, ExposureIsInStops) {
    PngOptions options;
    options.exposure = -1.0f;
    EXPECT_EQ(written(pixel(1, 1, 0.5f, 1), options), (Pixel{188, 188, 137, 255}));
    options.exposure = 2.0f;
    EXPECT_EQ(written(pixel(0.125f, 0.25f, 0, 1), options), (Pixel{188, 255, 0, 255}));
}

TEST_F(PngTest, AViewTransformAppliesAfterTheExposure) {
    PngOptions options;
    options.exposure = 1.0f;
    options.view_transform = ViewTransform::none;
    EXPECT_EQ(written(pixel(0.1f, 0.25f, 1, 1), options), (Pixel{51, 128, 255, 255}));
    options.view_transform = ViewTransform::filmic;
    EXPECT_EQ(written(pixel(0.5f, 0, 50, 1), options), (Pixel{232, 0, 255, 255}));
}

TEST_F(PngTest, SixteenBitsAreWrittenHighByteFirst) {
    PngOptions options;
    options.bits = 16;
    options.view_transform = ViewTransform::none;
    // A reader of eight bits takes the high bytes: 0x4CCD of 0.3 is 0x4C there, and 0x4D at 8 bits.
    EXPECT_EQ(written(pixel(0.3f, 0.5f, 1, 1), options), (Pixel{0x4C, 0x80, 255, 255}));
    write_png(path(), small_image(), options);
    EXPECT_EQ(bytes_of(path())[24], 16);
    EXPECT_THAT(bytes_of(path()), HasSubstr("gAMA"));
    EXPECT_THAT(bytes_of(path()), Not(HasSubstr("sRGB")));
}

TEST_F(PngTest, TheBackgroundFillsWhatColourLeavesOpen) {
    PngOptions options;
    options.background = {0.5f, 0.0f, 1.0f};
    EXPECT_EQ(written(pixel(0, 0, 0, 0), options), (Pixel{188, 0, 255, 255}));
    EXPECT_EQ(written(pixel(0.25f, 0.25f, 0, 0.5f), options), (Pixel{188, 137, 188, 255}));
    EXPECT_EQ(written(pixel(0.25f, 0.25f, 0, 1), options), (Pixel{137, 137, 0, 255}));
}

TEST_F(PngTest, KeptAlphaIsDividedOutOfTheColour) {
    PngOptions options;
    options.keep_alpha = true;
    EXPECT_EQ(written(pixel(0.25f, 0.5f, 0, 0.5f), options), (Pixel{188, 255, 0, 128}));
    EXPECT_EQ(written(pixel(0, 0, 0, 0), options), (Pixel{0, 0, 0, 0}));
}

TEST_F(PngTest, TheSameImageGivesTheSameBytesAndDeclaresSrgb) {
    write_png(path(), small_image());
    write_png(folder / "b.png", small_image());
    EXPECT_EQ(bytes_of(path()), bytes_of(folder / "b.png"));
    EXPECT_THAT(bytes_of(path()), HasSubstr("sRGB"));
}

TEST_F(PngTest, PixelsThatAreNotSquareAreDeclared) {
    EXPECT_THAT(png_bytes(small_image()), Not(HasSubstr("pHYs")));
    // 1e6 pixels to a unit across, twice as many along it, and no unit.
    EXPECT_THAT(png_bytes(small_image(), {.pixel_aspect = 2}),
                HasSubstr(std::string("pHYs\x00\x0f\x42\x40\x00\x1e\x84\x80\0", 13)));
    // Aspects of other programs' images may be as far from 1 as this: 1e9 to 1e3, and 1 to 1e6.
    EXPECT_THAT(png_bytes(small_image(), {.pixel_aspect = 1e6}),
                HasSubstr(std::string("pHYs\x00\x00\x03\xe8\x3b\x9a\xca\x00\0", 13)));
    EXPECT_THAT(png_bytes(small_image(), {.pixel_aspect = 1e-9}),
                HasSubstr(std::string("pHYs\x00\x0f\x42\x40\x00\x00\x00\x01\0", 13)));
}

TEST_F(PngTest, AnImageWithoutColourIsRefused) {
    Image image = small_image();
    image.planes.erase("G");
    const Error error = error_of([&] { write_png(path(), image); });
    EXPECT_EQ(error.exit_code(), 5);
    EXPECT_THAT(error.what(), HasSubstr("no plane G"));
    EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(PngTest, AFullDiskLeavesNothing) {
    const FileSizeLimit full(50);
    EXPECT_EQ(error_of([&] { write_png(path(), small_image()); }).exit_code(), 5);
    EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(PngTest, AnyTruncationIsAnInputError) {
    write_png(path(), small_image());
    const std::string bytes = bytes_of(path());
    for (size_t length = 0; length < bytes.size(); ++length) {
        put_bytes(path(), bytes.substr(0, length));
        EXPECT_EQ(error_of([&] { read_png(path()); }).exit_code(), 4) << length;
    }
}

TEST_F(PngTest, AnyFlippedByteIsAnInputErrorOrReadsAsAPicture) {
    write_png(path(), small_image());
    const std::string bytes = bytes_of(path());
    for (size_t i = 0; i < bytes.size(); ++i) {
        std::string damaged = bytes;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x5a);
        put_bytes(path(), damaged);
        try {
            read_png(path());
        } catch (const Error& error) {
            EXPECT_EQ(error.exit_code(), 4) << i;
        }
    }
}

}  // namespace voxelume
