// SPDX-License-Identifier: Apache-2.0
// Files of several parts, against OpenEXR's own reader and writer.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <gmock/gmock.h>

#include <numeric>
#include <random>

#include "runtime/base/files/stamp.hpp"
#include "runtime/io/image/exr.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr ExrStorage kParts(ColorDepth::float32, true);

/// An image in whose channels no two values are equal.
Image layered_image(int width, int height) {
    Image image;
    image.width = width;
    image.height = height;
    const size_t pixels = size_t(width) * size_t(height);
    float next = 0.125f;
    for (const char* name : {"R", "G", "B", "A", "Z", "distance", "N.X", "N.Y", "N.Z",
                             "light_key.R", "light_key.G", "light_key.B", "forward.u", "forward.v",
                             "CryptoObject00.R", "CryptoObject00.G", "CryptoObject01.R"}) {
        std::vector<float> values(pixels);
        for (float& value : values) value = next += 0.25f;
        image.planes[name] = std::move(values);
    }
    std::vector<uint32_t> ids(pixels);
    std::iota(ids.begin(), ids.end(), 4'000'000'000u);
    image.id_planes["objectId"] = std::move(ids);
    image.attributes = {{"scene", "a.json"},
                        {"cryptomatte/1234567/name", "CryptoObject"},
                        {"cryptomatte/1234567/manifest", R"({"a":"00000001"})"},
                        {"cryptomatte/89abcde/name", "CryptoMaterial"}};
    return image;
}

/// The rows of one channel, by OpenEXR's own reader.
template <class Value>
Plane<Value> rows_of(Imf::MultiPartInputFile& file, int number, const char* channel,
                     Imf::PixelType type) {
    Imf::InputPart part(file, number);
    const Imath::Box2i window = part.header().dataWindow();
    std::vector<Value> values(size_t(window.size().x + 1) * size_t(window.size().y + 1));
    Imf::FrameBuffer buffer;
    buffer.insert(channel, Imf::Slice::Make(type, values.data(), window));
    part.setFrameBuffer(buffer);
    part.readPixels(window.min.y, window.max.y);
    return values;
}

std::vector<std::string> channels_of(const Imf::Header& header) {
    std::vector<std::string> names;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
        names.emplace_back(c.name());
    return names;
}

std::string text_of(const Imf::Header& header, const char* name) {
    const auto* text = header.findTypedAttribute<Imf::StringAttribute>(name);
    return text ? text->value() : "";
}

}  // namespace

class ExrPartsTest : public FileTest {
  protected:
    std::filesystem::path path() const { return folder / "a.exr"; }
    std::string name() const { return path().string(); }
};

TEST_F(ExrPartsTest, EachLayerIsAPartWithItsNameForOpenExrsReader) {
    const Image image = layered_image(7, 37);
    write_exr(path(), image, kParts);
    Imf::MultiPartInputFile file(name().c_str());
    std::vector<std::string> parts;
    for (int part = 0; part < file.parts(); ++part) {
        const Imf::Header& header = file.header(part);
        parts.push_back(header.name());
        EXPECT_EQ(header.type(), Imf::SCANLINEIMAGE);
        EXPECT_TRUE(file.partComplete(part));
        EXPECT_TRUE(Imf::hasChromaticities(header)) << parts.back();
        for (const std::string& channel : channels_of(header)) {
            if (channel == "objectId")
                EXPECT_EQ(rows_of<uint32_t>(file, part, "objectId", Imf::UINT),
                          image.id_planes.at(channel));
            else
                EXPECT_EQ(rows_of<float>(file, part, channel.c_str(), Imf::FLOAT),
                          image.planes.at(channel))
                    << channel;
        }
    }
    EXPECT_THAT(parts, ElementsAre("rgba", "depth", "CryptoObject00", "CryptoObject01", "N",
                                   "distance", "forward", "light_key", "objectId"));
    EXPECT_THAT(channels_of(file.header(0)), ElementsAre("A", "B", "G", "R"));
    EXPECT_THAT(channels_of(file.header(1)), ElementsAre("Z"));
    EXPECT_THAT(channels_of(file.header(4)), ElementsAre("N.X", "N.Y", "N.Z"));
    EXPECT_THAT(channels_of(file.header(6)), ElementsAre("forward.u", "forward.v"));
}

TEST_F(ExrPartsTest, TextsAreInTheFirstPartAndThoseOfMattesInTheirOwnToo) {
    write_exr(path(), layered_image(3, 2), kParts, {{"stamp", "here"}});
    const Imf::MultiPartInputFile file(name().c_str());
    const auto texts = [&](int part) {
        std::vector<std::string> found;
        for (const char* key : {"scene", "stamp", "cryptomatte/1234567/name",
                                "cryptomatte/1234567/manifest", "cryptomatte/89abcde/name"})
            found.push_back(text_of(file.header(part), key));
        return found;
    };
    constexpr const char* kManifest = R"({"a":"00000001"})";
    EXPECT_THAT(texts(0),
                ElementsAre("a.json", "here", "CryptoObject", kManifest, "CryptoMaterial"));
    EXPECT_THAT(texts(1), ElementsAre("", "", "", "", ""));
    EXPECT_THAT(texts(2), ElementsAre("", "", "CryptoObject", kManifest, ""));
    EXPECT_THAT(texts(3), ElementsAre("", "", "CryptoObject", kManifest, ""));
}

TEST_F(ExrPartsTest, TheImageComesBackAsFromOnePart) {
    Image image = layered_image(7, 37);
    image.first = {5, 3};
    image.frame = {20, 50};
    for (const ColorDepth depth : {ColorDepth::float16, ColorDepth::float32}) {
        write_exr(path(), image, {depth, true});
        write_exr(folder / "b.exr", image, depth);
        const Image parts = read_exr(path()), one = read_exr(folder / "b.exr");
        EXPECT_EQ(parts.planes, one.planes);
        EXPECT_EQ(parts.id_planes, one.id_planes);
        EXPECT_EQ(parts.attributes, one.attributes);
        EXPECT_EQ(parts.first, one.first);
        EXPECT_EQ(parts.frame, one.frame);
        EXPECT_EQ(read_exr_header(path()).channels, read_exr_header(folder / "b.exr").channels);
        EXPECT_EQ(read_exr_header(path()).attributes, read_exr_header(folder / "b.exr").attributes);
    }
    EXPECT_EQ(read_exr_header(path()).parts.size(), 9u);
    EXPECT_TRUE(read_exr_header(folder / "b.exr").parts.empty());
}

TEST_F(ExrPartsTest, EveryPartHasTheWindowOfACrop) {
    Image image = layered_image(7, 37);
    image.first = {5, 3};
    image.frame = {20, 50};
    write_exr(path(), image, kParts);
    const Imf::MultiPartInputFile file(name().c_str());
    for (int part = 0; part < file.parts(); ++part) {
        const Imf::Header& header = file.header(part);
        EXPECT_EQ(header.dataWindow(), Imath::Box2i({5, 3}, {11, 39}));
        EXPECT_EQ(header.displayWindow(), Imath::Box2i({0, 0}, {19, 49}));
    }
}

TEST_F(ExrPartsTest, TheBytesDependOnNeitherThreadsNorTheWay) {
    const Image image = layered_image(7, 100);
    write_exr(path(), image, kParts);
    set_exr_threads(3);
    write_exr(folder / "b.exr", image, kParts);
    EXPECT_EQ(exr_bytes(image, kParts), bytes_of(path()));
    set_exr_threads(0);
    EXPECT_EQ(bytes_of(folder / "b.exr"), bytes_of(path()));
}

TEST_F(ExrPartsTest, ColoursThatAreNotFiniteAreCounted) {
    Image image = layered_image(3, 2);
    image.planes["R"][2] = image.planes["A"][1] = std::numeric_limits<float>::infinity();
    image.planes["Z"][0] = std::numeric_limits<float>::infinity();
    EXPECT_EQ(write_exr(path(), image, kParts), 2u);
    EXPECT_EQ(read_exr(path()).planes["Z"][0], std::numeric_limits<float>::infinity());
}

TEST_F(ExrPartsTest, LongNamesOfLayersAreReadBack) {
    Image image = layered_image(3, 2);
    const std::string layer = "light_" + std::string(200, 'x');
    image.planes[layer + ".R"] = image.planes.at("R");
    write_exr(path(), image, kParts);
    EXPECT_EQ(read_exr(path()).planes, image.planes);
}

TEST_F(ExrPartsTest, AStampIsFoundInFrontOfAManifestOfTwoMegabytes) {
    const std::string hash(32, '7');
    Image image = layered_image(3, 2);
    image.attributes["cryptomatte/1234567/manifest"] = std::string(size_t{2} << 20, 'x');
    for (const bool is_multi_part : {false, true}) {
        write_exr(path(), image, {ColorDepth::float16, is_multi_part}, {{"stamp", stamp_of(hash)}});
        EXPECT_EQ(check_stamp(path(), hash), StampState::current) << is_multi_part;
    }
}

TEST_F(ExrPartsTest, TruncatedOrDamagedFilesEndInAnErrorOrAnImage) {
    write_exr(path(), layered_image(7, 37), kParts);
    const std::string bytes = bytes_of(path());
    for (size_t length = 0; length < bytes.size(); length += bytes.size() / 60) {
        put_bytes(path(), bytes.substr(0, length));
        EXPECT_EQ(error_of([&] { read_exr(path()); }).exit_code(), 4) << length;
    }
    std::mt19937 random(11);
    for (int trial = 0; trial < 400; ++trial) {
        std::string damaged = bytes;
        // Two thirds of the damage is in the headers.
        const size_t end = trial % 3 == 0 ? bytes.size() : 4000;
        damaged[random() % end] = static_cast<char>(random());
        put_bytes(path(), damaged);
        try {
            read_exr(path());
        } catch (const Error& error) {
            EXPECT_EQ(error.exit_code(), 4) << "trial " << trial;
        }
    }
}

namespace {

/// A part for OpenEXR's own writer.
Imf::Header foreign_part(const char* name, const Imath::Box2i& data,
                         const std::vector<const char*>& channels) {
    Imf::Header header(Imath::Box2i({0, 0}, {3, 1}), data);
    header.setName(name);
    header.setType(Imf::SCANLINEIMAGE);
    for (const char* channel : channels)
        header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
    return header;
}

/// Writes the parts; each value is 10 * part + pixel.
void write_foreign(const std::string& path, const std::vector<Imf::Header>& headers) {
    Imf::MultiPartOutputFile file(path.c_str(), headers.data(), int(headers.size()));
    for (size_t i = 0; i < headers.size(); ++i) {
        Imf::OutputPart part(file, int(i));
        const Imath::Box2i window = headers[i].dataWindow();
        std::vector<float> values(size_t(window.size().x + 1) * size_t(window.size().y + 1));
        std::iota(values.begin(), values.end(), 10.0f * float(i));
        Imf::FrameBuffer buffer;
        for (auto c = headers[i].channels().begin(); c != headers[i].channels().end(); ++c)
            buffer.insert(c.name(), Imf::Slice::Make(Imf::FLOAT, values.data(), window));
        part.setFrameBuffer(buffer);
        part.writePixels(window.size().y + 1);
    }
}

}  // namespace

TEST_F(ExrPartsTest, PartsOfOtherProgramsAreReadWhereTheyFitTheFirst) {
    const Imath::Box2i whole({0, 0}, {3, 1}), small({1, 0}, {2, 1});
    write_foreign(name(),
                  {foreign_part("beauty", whole, {"R", "G"}), foreign_part("cropped", small, {"Y"}),
                   foreign_part("albedo", whole, {"R", "G", "mask"})});
    const Image image = read_exr(path());
    std::vector<std::string> names;
    for (const auto& [channel, plane] : image.planes) names.push_back(channel);
    EXPECT_THAT(names, ElementsAre("G", "R", "albedo.G", "albedo.R", "mask"));
    EXPECT_EQ(image.planes.at("R"), (Plane<float>{0, 1, 2, 3, 4, 5, 6, 7}));
    EXPECT_EQ(image.planes.at("albedo.R"), (Plane<float>{20, 21, 22, 23, 24, 25, 26, 27}));
    const ExrHeader header = read_exr_header(path());
    ASSERT_EQ(header.parts.size(), 3u);
    EXPECT_EQ(header.parts[1].name, "cropped");
    EXPECT_THAT(header.parts[1].channels, ElementsAre("Y"));
    EXPECT_TRUE(header.parts[0].is_read);
    EXPECT_FALSE(header.parts[1].is_read);
    EXPECT_TRUE(header.parts[2].is_read);
}

TEST_F(ExrPartsTest, TwoChannelsOfOneNameAreRefused) {
    const Imath::Box2i whole({0, 0}, {3, 1});
    write_foreign(name(), {foreign_part("beauty", whole, {"R", "albedo.R"}),
                           foreign_part("albedo", whole, {"R"})});
    EXPECT_THAT(error_of([&] { read_exr(path()); }).what(),
                HasSubstr("two of its channels are albedo.R"));
}

}  // namespace voxelume
