// SPDX-License-Identifier: Apache-2.0
// Pictures of volumetric images: where each side is shown, and what covers what.
#include "runtime/image/volume_view.hpp"

#include <gmock/gmock.h>

#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/io/volume_file.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/volume_samples.hpp"

namespace voxelume {

using testing::HasSubstr;

namespace {

void add_voxel(Volume& volume, glm::ivec3 cell, glm::vec3 color, float opacity = 1) {
    const glm::ivec3& size = volume.frame.size;
    volume.indices.push_back(uint64_t(cell.x + size.x * (cell.y + size.y * cell.z)));
    volume.colors.push_back(color);
    volume.opacities.push_back(opacity);
    volume.depths.push_back(1);
    volume.objects.push_back(1);
    volume.kinds.push_back(VoxelKind::object);
}

/// The middle of the pixels in which one channel is by far the brightest, as a fraction of the
/// picture.
glm::dvec2 middle_of(const Image& image, const char* channel) {
    glm::dvec2 sum(0);
    double count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const size_t i = size_t(y) * size_t(image.width) + size_t(x);
            double others = -image.planes.at(channel)[i];
            for (const char* name : {"R", "G", "B"}) others += image.planes.at(name)[i];
            if (image.planes.at(channel)[i] < 2 * others + 0.1) continue;
            sum += glm::dvec2(x + 0.5, y + 0.5);
            ++count;
        }
    return count > 0 ? sum / count / glm::dvec2(image.width, image.height) : glm::dvec2(-1);
}

glm::vec3 pixel_of(const Image& image, double x, double y) {
    const size_t i = size_t(y * image.height) * size_t(image.width) + size_t(x * image.width);
    return {image.planes.at("R")[i], image.planes.at("G")[i], image.planes.at("B")[i]};
}

/// A lattice of cubes with red on the image's left, green on top and blue at the far end.
Volume three_sides() {
    Volume volume = lattice_volume({9, 9, 9}, 0);
    volume.frame.edge = glm::dvec3(0.5);
    add_voxel(volume, {8, 4, 4}, {1, 0, 0});  // image right is -X_E
    add_voxel(volume, {4, 8, 4}, {0, 1, 0});
    add_voxel(volume, {4, 4, 8}, {0, 0, 1});
    std::vector<size_t> order = {0, 1, 2};
    std::ranges::sort(order, {}, [&](size_t i) { return volume.indices[i]; });
    Volume sorted = volume;
    for (size_t i = 0; i < 3; ++i) {
        sorted.indices[i] = volume.indices[order[i]];
        sorted.colors[i] = volume.colors[order[i]];
    }
    return sorted;
}

constexpr glm::ivec2 kSize(240, 200);

}  // namespace

TEST(VolumeView, TheFrontIsWhatTheObserverSees) {
    const Image image = view_volume(three_sides(), {}, kSize);
    ASSERT_EQ(image.width, 240);
    ASSERT_EQ(image.height, 200);
    const glm::dvec2 red = middle_of(image, "R"), green = middle_of(image, "G"),
                     blue = middle_of(image, "B");
    EXPECT_LT(red.x, blue.x - 0.15);
    EXPECT_NEAR(green.x, blue.x, 0.1);
    EXPECT_LT(green.y, blue.y - 0.15);
    EXPECT_NEAR(red.y, blue.y, 0.1);
}

TEST(VolumeView, AViewFromTheRightBringsTheFarEndToTheRight) {
    const Image image = view_volume(three_sides(), {M_PI / 2, 0}, kSize);
    const glm::dvec2 red = middle_of(image, "R"), green = middle_of(image, "G"),
                     blue = middle_of(image, "B");
    EXPECT_GT(blue.x, green.x + 0.15);
    EXPECT_NEAR(red.x, green.x, 0.1);
    EXPECT_LT(green.y, blue.y - 0.15);
}

TEST(VolumeView, FromAboveTheFarEndIsUp) {
    const Image image = view_volume(three_sides(), {0, M_PI / 2}, kSize);
    const glm::dvec2 red = middle_of(image, "R"), green = middle_of(image, "G"),
                     blue = middle_of(image, "B");
    EXPECT_LT(blue.y, green.y - 0.15);
    EXPECT_LT(red.x, green.x - 0.15);
}

TEST(VolumeView, NearVoxelsCoverFarOnesByTheirOpacity) {
    Volume volume = lattice_volume({5, 5, 5}, 0);
    volume.frame.edge = glm::dvec3(0.5);
    add_voxel(volume, {2, 2, 0}, {1, 0, 0}, 0.25f);
    add_voxel(volume, {2, 2, 4}, {0, 0, 1});
    const glm::vec3 front = pixel_of(view_volume(volume, {}, kSize), 0.5, 0.5);
    EXPECT_NEAR(front.r, 0.25f, 1e-5f);
    EXPECT_NEAR(front.b, 0.75f, 1e-5f);
    const glm::vec3 back = pixel_of(view_volume(volume, {M_PI, 0}, kSize), 0.5, 0.5);
    EXPECT_EQ(back, glm::vec3(0, 0, 1));
}

TEST(VolumeView, NeighboursLeaveNoGapsAndCoverNothingTwice) {
    Volume volume = lattice_volume({40, 40, 1}, 0);
    volume.frame.edge = {0.01, 0.01, 1e-6};
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 40; ++x) add_voxel(volume, {x, y, 0}, {1, 1, 1}, 0.5f);
    // Seen straight on, no voxel hides another; at a slant some do.
    const Image image = view_volume(volume, {}, kSize);
    for (double y = 0.3; y < 0.7; y += 0.01)
        for (double x = 0.35; x < 0.65; x += 0.01)
            EXPECT_NEAR(pixel_of(image, x, y).r, 0.505f, 1e-3f) << x << " " << y;
    const Image slice = view_slices(volume, 0, 1, {97, 97});
    for (double y = 0.05; y < 0.95; y += 0.01)
        for (double x = 0.05; x < 0.95; x += 0.01)
            EXPECT_NEAR(pixel_of(slice, x, y).r, 0.505f, 1e-3f) << x << " " << y;
    const Image slant = view_volume(volume, {0.6, 0.4}, kSize);
    for (double y = 0.45; y < 0.55; y += 0.01)
        for (double x = 0.45; x < 0.55; x += 0.01)
            EXPECT_GT(pixel_of(slant, x, y).r, 0.5f) << x << " " << y;
}

TEST(VolumeView, SlicesLieAsTheObserverSeesThem) {
    const Volume volume = three_sides();
    const Image middle = view_slices(volume, 4, 5, {90, 90});
    EXPECT_EQ(pixel_of(middle, 0.05, 0.5), glm::vec3(1, 0, 0));
    EXPECT_EQ(pixel_of(middle, 0.5, 0.05), glm::vec3(0, 1, 0));
    EXPECT_LT(pixel_of(middle, 0.5, 0.5).b, 0.1f);
    EXPECT_EQ(pixel_of(view_slices(volume, 8, 9, {90, 90}), 0.5, 0.5), glm::vec3(0, 0, 1));
}

TEST(VolumeView, EveryShapeAndAnEmptyVolumeHaveAPicture) {
    for (const DisplayShape shape :
         {DisplayShape::pyramid, DisplayShape::sector, DisplayShape::ball, DisplayShape::box}) {
        for (const double share : {0.0, 0.6}) {
            const Image sheet = view_sheet(rays_volume(shape, share), {0.6, 0.4}, {160, 120});
            float minimum = 1e9f, maximum = 0;
            for (const float r : sheet.planes.at("R"))
                minimum = std::min(minimum, r), maximum = std::max(maximum, r);
            EXPECT_GT(minimum, 0.0f);
            EXPECT_GT(maximum, share > 0 ? 0.3f : 0.03f);
        }
    }
}

class CliViewTest : public ProgramTest {};

TEST_F(CliViewTest, ShowsWhatConvertReads) {
    write_volume(folder / "a.vdb", lattice_volume());
    write_volume(folder / "a.nrrd", lattice_volume());
    write_volume(folder / "a.raw", lattice_volume());
    write_volume(folder / "b.exr", rays_volume());
    for (const char* name : {"a.vdb", "a.nrrd", "a.raw", "a.json", "b.exr"}) {
        const ProgramResult picture = run(fmt::format("view {} -o v.png --size 200x160", name));
        EXPECT_EQ(picture.exit_code, 0) << name << picture.err;
        EXPECT_EQ(picture.out + picture.err, "");
        EXPECT_EQ(read_png(folder / "v.png").width, 200);
        const ProgramResult page =
            run(fmt::format("view {} -o v.html --around -40 --above 10 --exposure 1", name));
        EXPECT_EQ(page.exit_code, 0) << name << page.err;
        EXPECT_THAT(bytes_of(folder / "v.html"), HasSubstr("\"around\":-0.698"));
        std::filesystem::remove(folder / "v.png");
        std::filesystem::remove(folder / "v.html");
    }
}

TEST_F(CliViewTest, WhatCantBeShownSaysWhy) {
    write_volume(folder / "a.vdb", lattice_volume());
    const auto failure = [&](const char* arguments, int code) {
        const ProgramResult result = run(fmt::format("view {}", arguments));
        EXPECT_EQ(result.exit_code, code) << arguments;
        return result.err;
    };
    EXPECT_THAT(failure("a.vdb -o a.gif", 2), HasSubstr("ends in .png or .html"));
    EXPECT_THAT(failure("a.vdb -o a.png --size 20x", 2), HasSubstr("WIDTHxHEIGHT"));
    EXPECT_THAT(failure("a.vdb -o a.png --size 20x900", 2), HasSubstr("at least 64 pixels"));
    EXPECT_THAT(failure("a.vdb -o a.png --above 95", 2), HasSubstr("-90 to 90"));
    EXPECT_THAT(failure("b.vdb -o a.png", 4), HasSubstr("no such file"));
    EXPECT_THAT(failure("a.rgb332 -o a.png", 2), HasSubstr("are read from .vdb"));
    EXPECT_THAT(failure("a.vdb -o nowhere/a.html", 5), HasSubstr("nowhere"));
    failure("a.vdb", 2);
    put_bytes(folder / "a.vdb", bytes_of(folder / "a.vdb") + "x");
    EXPECT_THAT(failure("a.vdb -o a.html", 4), HasSubstr("damaged"));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.html"));
}

}  // namespace voxelume
