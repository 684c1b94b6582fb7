// SPDX-License-Identifier: Apache-2.0
// The table of the formats of images: each row names functions of its own format.
#include "runtime/io/image/image_format_table.hpp"

#include <fstream>
#include <iterator>
#include <set>

#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

class ImageFormats : public FileTest {
  protected:
    static Image small() {
        Image image{3, 2, {}, {}, {}};
        for (const char* channel : {"R", "G", "B"})
            image.planes[channel] = std::vector<float>{0, 0.25f, 0.5f, 0.75f, 1, 0.5f};
        return image;
    }

    static std::string content(const std::filesystem::path& file) {
        std::ifstream stream(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
};

TEST_F(ImageFormats, ReadTheFilesThatTheyWrite) {
    int written = 0;
    for (const ImageFormatEntry& format : image_format_table()) {
        if (format.write == nullptr) continue;
        ++written;
        const std::filesystem::path file = folder / ("image" + std::string(format.ending));
        format.write(file, small(), {});
        const std::string bytes = content(file);
        EXPECT_EQ(bytes, format.encode(small(), {})) << format.ending;
        EXPECT_EQ(bytes.substr(0, format.start.size()), format.start) << format.ending;
        const std::span<const uint8_t> span(reinterpret_cast<const uint8_t*>(bytes.data()),
                                            bytes.size());
        EXPECT_EQ(image_format_of(span), &format);
        const Image image = format.read(file);
        EXPECT_EQ(image.width, 3) << format.ending;
        EXPECT_EQ(image.height, 2) << format.ending;
        EXPECT_EQ(format.read_size(file), glm::ivec2(3, 2)) << format.ending;
        const ColorPicture colors = format.read_colors(file, 6);
        ASSERT_EQ(colors.values.size(), 18u) << format.ending;
        for (size_t i = 0; i < 6; ++i)
            EXPECT_NEAR(colors.values[3 * i], small().planes.at("R")[i], 0.005) << format.ending;
    }
    EXPECT_EQ(written, 2);
}

TEST_F(ImageFormats, HaveEndingsAndFirstBytesOfTheirOwn) {
    std::set<std::string_view> endings, starts;
    for (const ImageFormatEntry& format : image_format_table()) {
        endings.insert(format.ending);
        starts.insert(format.start);
        EXPECT_EQ(image_format_of(format.ending), &format);
    }
    EXPECT_EQ(endings.size(), image_format_table().size());
    EXPECT_EQ(starts.size(), image_format_table().size());
    EXPECT_EQ(image_format_of(std::string_view(".gif")), nullptr);
    EXPECT_EQ(image_format_of(std::string_view("")), nullptr);
    EXPECT_EQ(image_format_of(std::span<const uint8_t>()), nullptr);
}

TEST_F(ImageFormats, AreListedInWords) {
    EXPECT_EQ(image_endings(&ImageFormatEntry::write), ".exr or .png");
    EXPECT_EQ(image_endings(&ImageFormatEntry::read_colors), ".exr, .hdr or .png");
    EXPECT_EQ(image_endings(&ImageFormatEntry::parse_texture), ".png or .jpg");
}

}  // namespace
}  // namespace voxelume
