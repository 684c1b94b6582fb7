// SPDX-License-Identifier: Apache-2.0
// Pictures for textures: JPEG and PNG, damaged ones, and the levels that are made of them.
#include "runtime/io/image/picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "runtime/io/mesh/texture_levels.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

/// A smooth picture, whose three channels differ.
Picture ramp(int width, int height) {
    Picture picture{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            picture.pixels.push_back({uint8_t(255 * x / width), uint8_t(255 * y / height),
                                      uint8_t(100 + 50 * x / width), 255});
    return picture;
}

std::vector<uint8_t> jpeg_of(const Picture& picture, int sampling, int flags = 0) {
    tjhandle encoder = tjInitCompress();
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    EXPECT_EQ(tjCompress2(encoder, picture.pixels.data()->data(), picture.width, 0, picture.height,
                          TJPF_RGBA, &bytes, &size, sampling, 95, flags),
              0);
    std::vector<uint8_t> out(bytes, bytes + size);
    tjFree(bytes);
    tjDestroy(encoder);
    return out;
}

std::string refusal(const std::vector<uint8_t>& bytes) {
    return error_of([&] { parse_picture(bytes, "a.jpg"); }).what();
}

/// A JPEG whose four components are coded as those of TurboJPEG's CMYK, which is YCCK with Adobe's
/// marker.
std::vector<uint8_t> ink_jpeg(const std::vector<uint8_t>& inks, int width, int height) {
    tjhandle encoder = tjInitCompress();
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    EXPECT_EQ(tjCompress2(encoder, inks.data(), width, 0, height, TJPF_CMYK, &bytes, &size,
                          TJSAMP_444, 100, TJFLAG_ACCURATEDCT),
              0);
    std::vector<uint8_t> out(bytes, bytes + size);
    tjFree(bytes);
    tjDestroy(encoder);
    return out;
}

/// Inks as YCCK stores them.
std::array<double, 4> ycck_of(const std::array<uint8_t, 4>& ink) {
    const double r = 255 - ink[0], g = 255 - ink[1], b = 255 - ink[2];
    return {0.299 * r + 0.587 * g + 0.114 * b, 128 - 0.168736 * r - 0.331264 * g + 0.5 * b,
            128 + 0.5 * r - 0.418688 * g - 0.081312 * b, double(ink[3])};
}

}  // namespace

TEST(Pictures, OfInksAreTheLightThatTheyLeave) {
    // Three areas of 8 x 8 pixels each.
    const std::array<std::array<uint8_t, 4>, 3> stored = {
        {{0, 204, 255, 255}, {255, 153, 51, 204}, {225, 255, 120, 0}}};
    std::vector<uint8_t> inks;
    for (int i = 0; i < 24 * 8; ++i)
        inks.insert(inks.end(), stored[size_t(i % 24 / 8)].begin(),
                    stored[size_t(i % 24 / 8)].end());
    const std::vector<uint8_t> ycck = ink_jpeg(inks, 24, 8);
    const auto expect = [](const std::vector<uint8_t>& bytes, const auto& left) {
        const Picture read = parse_picture(bytes, "a.jpg");
        ASSERT_EQ(read.width, 24);
        ASSERT_EQ(read.height, 8);
        for (size_t x = 0; x < 24; ++x) {
            const std::array<double, 4> white = left(x / 8);  // what each ink leaves of it
            for (size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(read.pixels[72 + x][c], white[c] * white[3] / 255, 3) << x << " " << c;
            EXPECT_EQ(read.pixels[72 + x][3], 255);
        }
    };
    expect(ycck, [&](size_t i) {
        const auto& s = stored[i];
        return std::array<double, 4>{double(s[0]), double(s[1]), double(s[2]), double(s[3])};
    });
    // The marker's last byte tells YCCK from CMYK.
    const std::string_view name = "Adobe";
    const auto marker = std::search(ycck.begin(), ycck.end(), name.begin(), name.end());
    ASSERT_NE(marker, ycck.end());
    std::vector<uint8_t> cmyk = ycck;
    cmyk[size_t(marker - ycck.begin()) + 11] = 0;
    expect(cmyk, [&](size_t i) { return ycck_of(stored[i]); });
    // Inks aren't inverted without the marker.
    std::vector<uint8_t> plain = ycck;
    const auto start = plain.begin() + (marker - ycck.begin()) - 4;
    plain.erase(start, start + 16);
    expect(plain, [&](size_t i) {
        std::array<double, 4> left = ycck_of(stored[i]);
        for (double& l : left) l = 255 - l;
        return left;
    });
}

TEST(Pictures, OfJpegAreWhatWasCompressed) {
    const Picture picture = ramp(61, 43);
    for (const int flags : {0, TJFLAG_PROGRESSIVE}) {
        const Picture read = parse_picture(jpeg_of(picture, TJSAMP_444, flags), "a.jpg");
        ASSERT_EQ(read.width, 61);
        ASSERT_EQ(read.height, 43);
        for (size_t i = 0; i < read.pixels.size(); ++i)
            for (size_t c = 0; c < 4; ++c)
                ASSERT_NEAR(read.pixels[i][c], picture.pixels[i][c], 8) << i << " " << c;
    }
    const Picture gray = parse_picture(jpeg_of(picture, TJSAMP_GRAY), "a.jpg");
    EXPECT_EQ(gray.pixels[900][0], gray.pixels[900][2]);
}

TEST(Pictures, ThatAreDamagedAreInputErrors) {
    std::vector<uint8_t> bytes = jpeg_of(ramp(61, 43), TJSAMP_420);
    for (size_t size = 0; size < bytes.size(); size += 7)
        EXPECT_EQ(error_of([&] {
                      parse_picture({bytes.data(), size}, "a.jpg");
                  }).kind(),
                  ErrorKind::input)
            << size;
    srand(7);
    for (int i = 0; i < 2000; ++i) {
        std::vector<uint8_t> damaged = bytes;
        damaged[size_t(rand()) % damaged.size()] ^= uint8_t(1 << rand() % 8);
        try {
            parse_picture(damaged, "a.jpg");
        } catch (const Error& error) {
            ASSERT_EQ(error.kind(), ErrorKind::input);
        }
    }
    EXPECT_THAT(refusal({'G', 'I', 'F', '8'}), HasSubstr("a.jpg: neither PNG nor JPEG"));
    EXPECT_THAT(refusal({}), HasSubstr("neither PNG nor JPEG"));
}

TEST(Pictures, OfMorePixelsThanTexturesMayHaveAreRefusedBeforeMemoryIsTaken) {
    std::vector<uint8_t> bytes = jpeg_of(ramp(61, 43), TJSAMP_444);
    const std::array<uint8_t, 2> mark = {0xff, 0xc0};
    const auto frame = std::search(bytes.begin(), bytes.end(), mark.begin(), mark.end());
    ASSERT_NE(frame, bytes.end());
    for (int i = 5; i < 9; ++i) frame[i] = 0xf0;
    EXPECT_THAT(refusal(bytes), HasSubstr("a JPEG of 61680 x 61680 pixels; at most 2^26"));
}

TEST(TextureLevels, AreMeansInLinearLight) {
    Picture picture{5, 3, {}};
    for (int i = 0; i < 15; ++i) picture.pixels.push_back({0, 255, uint8_t(i * 17), 255});
    picture.pixels[0][0] = 255;
    const TextureImage image = with_levels(picture);
    ASSERT_EQ(image.texels.size(), 15u + 2 + 1);
    // The first of two texels covers 2.5 of 5 columns and all three rows.
    const auto linear = [](double code) {
        const double s = code / 255;
        return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    };
    double blue = 0;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) blue += linear((5 * y + x) * 17) * (x == 2 ? 0.5 : 1) / 7.5;
    EXPECT_EQ(image.texels[15] & 255, srgb_code(float(1 / 7.5)));
    EXPECT_EQ(image.texels[15] >> 8 & 255, 255u);
    EXPECT_EQ(image.texels[15] >> 16 & 255, srgb_code(float(blue)));
    EXPECT_EQ(image.texels[16] & 255, 0u);
    EXPECT_EQ(image.texels[17] & 255, srgb_code(float(1 / 15.0)));
}

TEST(TextureLevels, DoNotShowColorsOfClearTexels) {
    const TextureImage image =
        with_levels({2, 2, {{255, 0, 0, 255}, {0, 255, 0, 0}, {0, 255, 0, 0}, {255, 0, 0, 255}}});
    EXPECT_EQ(image.texels.at(4), 0x800000FFu);
    EXPECT_EQ(with_levels({2, 1, {{255, 9, 0, 0}, {255, 9, 0, 0}}}).texels.at(2), 0x000009FFu);
}

}  // namespace voxelume
