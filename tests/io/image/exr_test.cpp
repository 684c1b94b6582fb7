// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/exr.hpp"

#include <ImfMultiPartInputFile.h>
#include <ImfStringAttribute.h>
#include <gmock/gmock.h>

#include <bit>
#include <limits>
#include <random>

#include "tests/support/file_fixture.hpp"

namespace voxelume {

using testing::HasSubstr;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// An image of 7 x 5 pixels whose values are random bits, but all numbers, in every channel of the
/// renderer.
Image random_image(int width = 7, int height = 5) {
    std::mt19937 random(20170613);
    Image image{width, height, {}, {}, {{"scene", "bunny.json"}, {"version", "voxelume 0.1.0"}}};
    const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
    for (const char* name : {"R", "G", "B", "A", "Z", "P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z"}) {
        std::vector<float> values(pixels, kNan);
        for (float& value : values)
            while (value != value || std::abs(value) == kInfinity)
                value = std::bit_cast<float>(static_cast<uint32_t>(random()));
        image.planes[name] = std::move(values);
    }
    std::vector<uint32_t> ids(pixels);
    for (uint32_t& id : ids) id = static_cast<uint32_t>(random());
    image.id_planes["objectId"] = std::move(ids);
    image.planes["Z"][3] = kInfinity;
    return image;
}

Image red_row(std::vector<float> values) {
    Image image;
    image.width = static_cast<int>(values.size());
    image.height = 1;
    image.planes["R"] = std::move(values);
    return image;
}

}  // namespace

class ExrTest : public FileTest {
  protected:
    std::filesystem::path path() const { return folder / "a.exr"; }
};

TEST_F(ExrTest, EveryBitOfAFloatImageComesBack) {
    const Image image = random_image();
    EXPECT_EQ(write_exr(path(), image, ColorDepth::float32), 0u);
    const Image back = read_exr(path());
    EXPECT_EQ(back.width, 7);
    EXPECT_EQ(back.height, 5);
    EXPECT_EQ(back.planes, image.planes);
    EXPECT_EQ(back.id_planes, image.id_planes);
    EXPECT_EQ(back.attributes, image.attributes);
}

TEST_F(ExrTest, HalvesAreRoundedToNearestAndClamped) {
    // 2049 lies halfway between the halves 2048 and 2050, and the tie goes to the even one.
    write_exr(path(),
              red_row({0.5f, 2049.0f, 2051.0f, 65504.0f, 65519.0f, 65520.0f, 1e30f, -1e9f, 6e-8f}));
    EXPECT_EQ(read_exr(path()).planes["R"],
              (Plane<float>{0.5f, 2048.0f, 2052.0f, 65504.0f, 65504.0f, 65504.0f, 65504.0f,
                            -65504.0f, 5.9604645e-8f}));
}

TEST_F(ExrTest, ColoursThatAreNotFiniteAreCountedAndBecomeZero) {
    for (const ColorDepth depth : {ColorDepth::float16, ColorDepth::float32}) {
        EXPECT_EQ(write_exr(path(), red_row({1.0f, kNan, kInfinity, -kInfinity}), depth), 3u);
        EXPECT_EQ(read_exr(path()).planes["R"], (Plane<float>{1, 0, 0, 0}));
    }
}

TEST_F(ExrTest, DepthKeepsItsInfinity) {
    write_exr(path(), random_image());
    EXPECT_EQ(read_exr(path()).planes["Z"][3], kInfinity);
}

TEST_F(ExrTest, TheHeaderNamesChannelsCompressionAndColour) {
    write_exr(path(), random_image());
    const ExrHeader header = read_exr_header(path());
    EXPECT_EQ(header.width, 7);
    EXPECT_EQ(header.height, 5);
    EXPECT_EQ(header.layout, "scanline");
    EXPECT_EQ(header.compression, "ZIP");
    const std::map<std::string, std::string> channels = {
        {"R", "half"},    {"G", "half"},    {"B", "half"},    {"A", "half"},
        {"Z", "float"},   {"P.X", "float"}, {"P.Y", "float"}, {"P.Z", "float"},
        {"N.X", "float"}, {"N.Y", "float"}, {"N.Z", "float"}, {"objectId", "uint"}};
    EXPECT_EQ(header.channels, channels);
    EXPECT_EQ(header.attributes.at("scene"), "bunny.json");
    EXPECT_EQ(header.attributes.at("chromaticities"),
              "red 0.64 0.33, green 0.3 0.6, blue 0.15 0.06, white 0.3127 0.329");
}

TEST_F(ExrTest, TheSameImageGivesTheSameBytes) {
    write_exr(path(), random_image());
    write_exr(folder / "b.exr", random_image());
    EXPECT_EQ(bytes_of(path()), bytes_of(folder / "b.exr"));
}

TEST_F(ExrTest, ASmallFileOnAFullDiskFailsAndLeavesNothing) {
    // OpenEXR silently ignores a failed write of the table of rows, which is the last write. Every
    // limit up to the file's size must fail.
    write_exr(path(), random_image(3, 2));
    const auto size = std::filesystem::file_size(path());
    std::filesystem::remove(path());
    for (rlim_t limit = 1; limit < size; limit += 13) {
        const FileSizeLimit full(limit);
        const Error error = error_of([&] { write_exr(path(), random_image(3, 2)); });
        EXPECT_EQ(error.exit_code(), 5) << limit;
        EXPECT_THAT(error.what(), HasSubstr("the file grows beyond the size allowed")) << limit;
        ASSERT_EQ(files_in_folder(), 0u) << limit;
    }
}

TEST_F(ExrTest, ALargeFileOnAFullDiskFailsAndLeavesTheOldOne) {
    put_bytes(path(), "old");
    {
        const FileSizeLimit full(100000);
        EXPECT_EQ(error_of([&] { write_exr(path(), random_image(200, 150)); }).exit_code(), 5);
    }
    EXPECT_EQ(bytes_of(path()), "old");
    EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(ExrTest, AnImageWithoutPixelsOrWithAShortPlaneIsRefused) {
    EXPECT_EQ(error_of([&] { write_exr(path(), Image{}); }).exit_code(), 5);
    Image image = red_row({1, 2, 3});
    image.planes["G"] = {1, 2};
    EXPECT_THAT(error_of([&] { write_exr(path(), image); }).what(), HasSubstr("plane G"));
    EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(ExrTest, AnAttributeWithTheNameOfAStandardOneIsRefused) {
    Image image = red_row({1});
    image.attributes["channels"] = "R";
    EXPECT_EQ(error_of([&] { write_exr(path(), image); }).exit_code(), 5);
}

TEST_F(ExrTest, AMissingFileIsAnInputError) {
    const Error error = error_of([&] { read_exr(path()); });
    EXPECT_EQ(error.exit_code(), 4);
    EXPECT_THAT(error.what(), HasSubstr("a.exr: no such file"));
}

TEST_F(ExrTest, AnyTruncationIsAnInputError) {
    write_exr(path(), random_image());
    const std::string bytes = bytes_of(path());
    for (size_t length = 0; length < bytes.size(); length += 7) {
        put_bytes(path(), bytes.substr(0, length));
        EXPECT_EQ(error_of([&] { read_exr(path()); }).exit_code(), 4) << length;
    }
}

/// OpenEXR would take the memory first, and clear it: 1.4 s for a file of a kilobyte.
TEST_F(ExrTest, WhatAHeaderDeclaresBeyondTheFileIsRefusedBeforeMemoryIsTaken) {
    write_exr(path(), random_image(4, 4));
    const std::string bytes = bytes_of(path());
    const auto refusal = [&](const std::string& head, const std::string& value) {
        std::string changed = bytes;
        const size_t offset = bytes.find(head) + head.size();
        put_bytes(path(), changed.replace(offset, value.size(), value));
        EXPECT_EQ(error_of([&] { read_exr_header(path()); }).exit_code(), 4);
        return std::string(error_of([&] { read_exr(path()); }).what());
    };
    using namespace std::string_literals;
    for (const std::string& size : {"\x0d\0\0\x69"s, "\xff\xff\xff\x7f"s, "\xff\xff\xff\xff"s})
        EXPECT_THAT(refusal("type\0string\0"s, size), HasSubstr("its attribute type declares"));
    EXPECT_THAT(refusal("v/1\1"s, std::string(300, 'n')), HasSubstr("doesn't end"));
    EXPECT_THAT(refusal("v/1\1\2\0\0\0"s, "\0"s), HasSubstr("header is empty"));
    std::string preview = bytes;
    preview.insert(8, "p\0preview\0\x0c\0\0\0\xff\xff\0\0\xff\xff\0\0abcd"s);
    put_bytes(path(), preview);
    EXPECT_THAT(error_of([&] { read_exr(path()); }).what(), HasSubstr("attribute p declares"));
    std::string texts = bytes;
    texts.insert(8,
                 "s\0stringvector\0\x06\0\0\0\xff\xff\xff\x7f"
                 "ab"s);
    put_bytes(path(), texts);
    EXPECT_THAT(error_of([&] { read_exr(path()); }).what(), HasSubstr("attribute s declares"));
}

/// OpenEXR reads such values by their types, and takes what follows for other attributes: 1.7 GB
/// for a file of 754 bytes.
TEST_F(ExrTest, AttributesOfOtherLengthsThanTheirTypesHaveAreRefused) {
    write_exr(path(), random_image(4, 4));
    const std::string bytes = bytes_of(path());
    using namespace std::string_literals;
    const std::string longer[] = {"compression\0compression\0"s, "dataWindow\0box2i\0"s,
                                  "screenWindowCenter\0v2f\0"s, "pixelAspectRatio\0float\0"s};
    for (const std::string& head : longer) {
        std::string changed = bytes;
        const size_t offset = bytes.find(head);
        ASSERT_NE(offset, std::string::npos) << head;
        const size_t length = offset + head.size();
        changed.insert(length + 4, 1, '\0');
        ++changed[length];
        put_bytes(path(), changed);
        EXPECT_EQ(error_of([&] { read_exr(path()); }).exit_code(), 4);
        EXPECT_THAT(error_of([&] { read_exr_header(path()); }).what(),
                    HasSubstr("bytes, which is no"));
    }
    const std::string head = "channels\0chlist\0"s;
    const size_t length = bytes.find(head) + head.size();
    for (const int added : {-1, 1, 16, 17}) {  // the list ends before or behind its attribute
        std::string changed = bytes;
        changed[length] = char(changed[length] + added);
        put_bytes(path(), changed);
        EXPECT_THAT(error_of([&] { read_exr_header(path()); }).what(),
                    HasSubstr("its attribute channels declares"));
    }
}

/// One of OpenEXR's libraries takes the first, and one the last: 1.7 GB for a file of 593 bytes.
TEST_F(ExrTest, AnAttributeThatIsThereTwiceIsRefused) {
    write_exr(path(), random_image(4, 4));
    std::string bytes = bytes_of(path());
    using namespace std::string_literals;
    const size_t second = bytes.find("displayWindow\0"s);
    bytes.insert(second,
                 "dataWindow\0box2i\0\x10\0\0\0"s + "\0\0\0\0\0\0\0\0"s + "\1\0\x29\0\4\0\0\0"s);
    put_bytes(path(), bytes);
    EXPECT_EQ(error_of([&] { read_exr(path()); }).exit_code(), 4);
    EXPECT_THAT(error_of([&] { read_exr_header(path()); }).what(),
                HasSubstr("it has its attribute dataWindow twice"));
}

TEST_F(ExrTest, ADamagedFileEndsInAnErrorOrAnImage) {
    write_exr(path(), random_image());
    const std::string bytes = bytes_of(path());
    std::mt19937 random(7);
    for (int trial = 0; trial < 300; ++trial) {
        std::string damaged = bytes;
        damaged[random() % bytes.size()] = static_cast<char>(random());
        put_bytes(path(), damaged);
        try {
            read_exr(path());
        } catch (const Error& error) {
            EXPECT_EQ(error.exit_code(), 4) << "trial " << trial;
        }
    }
}

TEST_F(ExrTest, AHeaderThatDeclaresABillionPixelsTakesNoMemory) {
    write_exr(path(), red_row({1, 2, 3}));
    std::string bytes = bytes_of(path());
    const size_t window = bytes.find("dataWindow") + sizeof("dataWindow") + sizeof("box2i") + 4;
    bytes.replace(window + 8, 8, std::string("\xff\xff\xff\x0f\xff\xff\xff\x0f", 8));
    put_bytes(path(), bytes);
    const Error error = error_of([&] { read_exr(path()); });
    EXPECT_EQ(error.exit_code(), 4);
    EXPECT_THAT(error.what(), HasSubstr("268435456 x 268435456"));
}

TEST_F(ExrTest, PixelsThatAreNotSquareAreDeclaredInEveryPart) {
    for (const ExrStorage& storage : {ExrStorage(), ExrStorage(ColorDepth::float32, true)}) {
        write_exr(path(), random_image(), storage, {{kPixelAspect, "1.5"}});
        const Imf::MultiPartInputFile file(path().c_str());
        for (int part = 0; part < file.parts(); ++part) {
            EXPECT_EQ(file.header(part).pixelAspectRatio(), 1.5f);
            EXPECT_FALSE(file.header(part).findTypedAttribute<Imf::StringAttribute>(kPixelAspect));
        }
        const Image image = read_exr(path());
        EXPECT_EQ(image.attributes.at(kPixelAspect), "1.5");
        EXPECT_EQ(read_exr_header(path()).attributes.at(kPixelAspect), "1.5");
        write_exr(folder / "b.exr", image, storage);
        EXPECT_TRUE(bytes_of(folder / "b.exr") == bytes_of(path()));
    }
    write_exr(path(), random_image());
    EXPECT_FALSE(read_exr(path()).attributes.contains(kPixelAspect));
}

}  // namespace voxelume
