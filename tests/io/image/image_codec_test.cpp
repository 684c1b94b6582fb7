// SPDX-License-Identifier: Apache-2.0
// The helper program decodes the same bits from images as this process, refuses the same files in
// the same words, and damage stays in the helper.
#include "runtime/io/image_codec/image_codec.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfStandardAttributes.h>
#include <ImfThreading.h>
#include <ImfTiledOutputFile.h>
#include <gmock/gmock.h>
#include <turbojpeg.h>

#include <random>

#include "runtime/base/main_memory.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/picture.hpp"
#include "runtime/io/image/png_values.hpp"
#include "runtime/io/volume_file.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/volume_samples.hpp"
#include "tests/support/writers/png_writer.hpp"

namespace voxelume {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ImageCodecTest : public FileTest {
  protected:
    void TearDown() override {
        decode_images({});
        FileTest::TearDown();
    }

    std::filesystem::path path() const { return folder / "a.exr"; }

    template <class Read>
    static auto read_both(const Read& read) {
        decode_images({.is_apart = true});
        auto apart = read();
        decode_images({});
        return std::pair(std::move(apart), read());
    }
    /// The sentence of the error that both ways of reading end in, without how much memory the
    /// process holds; empty for none.
    template <class Read>
    static std::string refusal_of(const Read& read) {
        const auto sentence = [&]() -> std::pair<std::string, int> {
            try {
                read();
            } catch (const Error& error) {
                const std::string what = error.what();
                return {what.substr(0, what.find(" in addition")), error.exit_code()};
            }
            return {"", 0};
        };
        const auto [apart, here] = read_both(sentence);
        EXPECT_EQ(apart, here);
        return apart.first;
    }
    static void expect_same(const Image& a, const Image& b) {
        EXPECT_EQ(a.width, b.width);
        EXPECT_EQ(a.height, b.height);
        EXPECT_EQ(a.planes, b.planes);
        EXPECT_EQ(a.id_planes, b.id_planes);
        EXPECT_EQ(a.attributes, b.attributes);
        EXPECT_EQ(a.first, b.first);
        EXPECT_EQ(a.frame, b.frame);
    }
};

/// An image of random bits, higher than the rows that the helper decodes at once.
Image tall_image() {
    constexpr int kWidth = 7, kHeight = 600;
    std::mt19937 random(4711);
    Image image;
    image.width = kWidth;
    image.height = kHeight;
    for (const char* name : {"R", "G", "B", "A", "Z", "N.X"}) {
        std::vector<float> values(size_t(kWidth) * kHeight);
        for (float& value : values) value = float(random()) / 1024;
        image.planes[name] = std::move(values);
    }
    std::vector<uint32_t> ids(size_t(kWidth) * kHeight);
    for (uint32_t& id : ids) id = uint32_t(random());
    image.id_planes["objectId"] = std::move(ids);
    image.attributes = {{"scene", "a.json"}, {kPixelAspect, "1.5"}};
    image.first = {5, 3};
    image.frame = {100, 700};
    return image;
}

/// A file of one float channel and one of ids, by default in tiles whose height doesn't divide that
/// of a band.
void write_tiles(const std::filesystem::path& path, Imf::Compression compression,
                 const Imf::TileDescription& tiles = {20, 100}) {
    constexpr int kWidth = 37, kHeight = 521;
    Imf::Header header(kWidth, kHeight);
    header.compression() = compression;
    header.setTileDescription(tiles);
    header.channels().insert("Y", Imf::Channel(Imf::HALF));
    header.channels().insert("id", Imf::Channel(Imf::UINT));
    std::vector<half> values;
    std::vector<uint32_t> ids;
    for (int i = 0; i < kWidth * kHeight; ++i) {
        values.emplace_back(float(i % 1999) / 8);
        ids.push_back(uint32_t(i) * 77777u);
    }
    Imf::FrameBuffer buffer;
    const Imath::Box2i window = header.dataWindow();
    buffer.insert("Y", Imf::Slice::Make(Imf::HALF, values.data(), window));
    buffer.insert("id", Imf::Slice::Make(Imf::UINT, ids.data(), window));
    Imf::TiledOutputFile file(path.c_str(), header);
    file.setFrameBuffer(buffer);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
}

std::string jpeg_of(int width, int height) {
    std::vector<uint8_t> pixels;
    for (int i = 0; i < 3 * width * height; ++i) pixels.push_back(uint8_t(i * 7 % 251));
    tjhandle encoder = tjInitCompress();
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    EXPECT_EQ(tjCompress2(encoder, pixels.data(), width, 0, height, TJPF_RGB, &bytes, &size,
                          TJSAMP_420, 90, 0),
              0);
    std::string out(bytes, bytes + size);
    tjFree(bytes);
    tjDestroy(encoder);
    return out;
}

TEST_F(ImageCodecTest, ImagesHaveTheBitsOfThoseThatAreDecodedHere) {
    const Image image = tall_image();
    for (const bool has_parts : {false, true}) {
        write_exr(path(), image, {ColorDepth::float32, has_parts});
        const auto [apart, here] = read_both([&] { return read_exr(path()); });
        expect_same(apart, here);
        EXPECT_EQ(apart.planes, image.planes);
        EXPECT_EQ(apart.frame, image.frame);
    }
    for (const Imf::Compression compression : {Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
        write_tiles(path(), compression);
        const auto [apart, here] = read_both([&] { return read_exr(path()); });
        expect_same(apart, here);
        EXPECT_EQ(apart.id_planes.at("id")[37 * 521 - 1], (37u * 521 - 1) * 77777u);
    }
}

/// OpenEXR has two tiles for each thread, and each takes what a whole tile takes.
TEST_F(ImageCodecTest, TilesLargerThanTheirImageAreDecodedWithAnyNumberOfThreads) {
    decode_images({.is_apart = true});
    for (const int side : {512, 4096}) {
        write_tiles(path(), Imf::ZIP_COMPRESSION, {unsigned(side), unsigned(side)});
        for (const int threads : {0, 2, 64}) {
            Imf::setGlobalThreadCount(threads);
            const Image image = read_exr(path());
            EXPECT_EQ(image.id_planes.at("id")[37 * 521 - 1], (37u * 521 - 1) * 77777u)
                << side << " " << threads;
        }
    }
    Imf::setGlobalThreadCount(0);
}

TEST_F(ImageCodecTest, HeadersAreThoseThatAreReadHere) {
    for (const bool has_parts : {false, true}) {
        write_exr(path(), tall_image(), {ColorDepth::float16, has_parts});
        const auto [apart, here] = read_both([&] { return read_exr_header(path()); });
        EXPECT_EQ(apart.width, 7);
        EXPECT_EQ(apart.height, 600);
        EXPECT_EQ(apart.layout, here.layout);
        EXPECT_EQ(apart.compression, here.compression);
        EXPECT_EQ(apart.channels, here.channels);
        EXPECT_EQ(apart.attributes, here.attributes);
        ASSERT_EQ(apart.parts.size(), here.parts.size());
        for (size_t i = 0; i < here.parts.size(); ++i) {
            EXPECT_EQ(apart.parts[i].name, here.parts[i].name);
            EXPECT_EQ(apart.parts[i].channels, here.parts[i].channels);
            EXPECT_EQ(apart.parts[i].is_read, here.parts[i].is_read);
        }
    }
}

TEST_F(ImageCodecTest, DeepImagesAreThoseThatAreReadHere) {
    write_volume(path(), rays_volume());
    const auto [apart, here] = read_both([&] { return read_volume(path()); });
    expect_same_volume(apart, here);
    EXPECT_GT(apart.indices.size(), 10u);
    EXPECT_EQ(apart.attributes, here.attributes);
}

TEST_F(ImageCodecTest, PicturesAndNumbersAreThoseThatAreDecodedHere) {
    const std::string wide = png_of_rows(3, 16, 0, {"abcdef", "ghijkl"});
    const std::string rgba = png_of_rows(2, 8, 6, {"12345678", "abcdefgh", "ABCDEFGH"});
    const std::filesystem::path png = folder / "a.png";
    for (const std::string& bytes : {wide, rgba}) {
        put_bytes(png, bytes);
        const auto [apart, here] = read_both([&] { return read_png(png); });
        EXPECT_EQ(apart.pixels, here.pixels);
        EXPECT_EQ(apart.width, bytes == wide ? 3 : 2);
        const auto [shape, shape_here] = read_both([&] { return read_png_shape(png); });
        EXPECT_EQ(shape, shape_here);
        const PngShape& known = shape_here;
        const std::array slices = {png, png};
        const auto [values, values_here] =
            read_both([&] { return read_png_values(slices, known); });
        EXPECT_EQ(values, values_here);
        EXPECT_EQ(values.size(), 2 * known.bytes());
    }
    put_bytes(folder / "a.jpg", jpeg_of(50, 30));
    const auto [apart, here] = read_both([&] { return read_picture(folder / "a.jpg"); });
    EXPECT_EQ(apart.pixels, here.pixels);
    EXPECT_EQ(apart.height, 30);
    const auto bytes = [](const std::string& of) {
        return std::span(reinterpret_cast<const uint8_t*>(of.data()), of.size());
    };
    const std::array pngs = {bytes(wide), bytes(rgba)};
    const auto [several, several_here] = read_both([&] { return parse_pngs(pngs, "a", 6); });
    ASSERT_EQ(several.size(), 2u);
    for (size_t i = 0; i < 2; ++i) EXPECT_EQ(several[i].pixels, several_here[i].pixels);
}

TEST_F(ImageCodecTest, DamagedFilesAreRefusedInTheSameWords) {
    write_tiles(path(), Imf::ZIP_COMPRESSION);
    const std::string exr = bytes_of(path()), jpeg = jpeg_of(50, 30);
    const std::string png = png_of_rows(2, 8, 6, {"12345678", "abcdefgh", "ABCDEFGH"});
    const auto check = [&](const std::string& name, std::string bytes, size_t length) {
        put_bytes(folder / name, bytes.substr(0, length));
        const std::string refused = refusal_of([&] {
            if (name == "a.exr")
                read_exr(folder / name);
            else if (name == "a.jpg")
                read_picture(folder / name);
            else
                read_png(folder / name);
        });
        EXPECT_THAT(refused, HasSubstr(name + ": ")) << length;
    };
    for (const double share : {0.0, 0.02, 0.4, 0.99}) {
        check("a.exr", exr, size_t(share * double(exr.size())));
        check("a.png", png, size_t(share * double(png.size())));
        check("a.jpg", jpeg, size_t(share * double(jpeg.size())));
    }
    std::string changed = png;
    changed[png.size() - 20] ^= 1;
    check("a.png", changed, changed.size());
    const std::array slices = {folder / "a.png", folder / "a2.png", folder / "a3.png"};
    for (const std::filesystem::path& slice : slices) put_bytes(slice, png);
    put_bytes(slices[1], png_of_rows(2, 8, 6, {"12345678", "abcdefgh"}));
    EXPECT_THAT(refusal_of([&] {
                    read_png_values(slices, {2, 3, 8, 4});
                }),
                AllOf(HasSubstr("a2.png: "), HasSubstr("slices of a stack are alike")));
    EXPECT_THAT(refusal_of([&] { parse_png({}, "b.png", 5); }), HasSubstr("its end is missing"));
}

TEST_F(ImageCodecTest, ImagesWithoutRoomInMemoryAreRefusedAsHere) {
    write_exr(path(), tall_image());
    put_bytes(folder / "a.png", png_of_rows(1, 8, 0, {"1"}));
    limit_main_memory(1);
    EXPECT_THAT(refusal_of([&] { read_exr(path()); }), HasSubstr("an image of 7x600 pixels"));
    EXPECT_THAT(refusal_of([&] { parse_png({}, "b.png", 5); }), HasSubstr("its end is missing"));
    EXPECT_THAT(refusal_of([&] { read_png(folder / "a.png"); }), HasSubstr("a.png: "));
    limit_main_memory(0);
}

}  // namespace
}  // namespace voxelume
