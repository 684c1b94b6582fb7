// SPDX-License-Identifier: Apache-2.0
// Volumetric images of scans: a medium whose colour differs from voxel to voxel is shown by voxels
// of its colours, which laid over one another are the flat image.
#include <gtest/gtest.h>

#include "tests/support/display_fixture.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

class DisplayedScan : public FileTest {
  protected:
    /// Writes cells of an edge, whose values are their numbers along z, with their middle at 0.
    void write_scan(const glm::ivec3& size, double edge) const {
        std::string text = fmt::format(
            "NRRD0004\ntype: uchar\ndimension: 3\nsizes: {} {} {}\nspace directions: ({},0,0) "
            "(0,{},0) (0,0,{})\nspace dimension: 3\nspace origin: ({},{},{})\nencoding: raw\n\n",
            size.x, size.y, size.z, edge, edge, edge, (1 - size.x) * edge / 2,
            (1 - size.y) * edge / 2, (1 - size.z) * edge / 2);
        for (int z = 0; z < size.z; ++z) text.append(size_t(size.x) * size_t(size.y), char(z));
        put_bytes(folder / "scan.nrrd", text);
    }

    Scene parsed_here(const std::string& text) const {
        return parse_scene(text, folder / "scene.json", {folder});
    }
};

/// The light of a volume's voxels, laid over one another pixel by pixel, and the light from behind
/// that they let through.
struct Laid {
    std::vector<glm::dvec3> light;
    std::vector<double> left;
};

Laid laid(const Volume& volume) {
    const auto pixels = size_t(volume.frame.size.x) * size_t(volume.frame.size.y);
    Laid sum{std::vector<glm::dvec3>(pixels, glm::dvec3(0)), std::vector<double>(pixels, 1)};
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        const size_t pixel = volume.indices[i] % pixels;
        sum.light[pixel] +=
            sum.left[pixel] * double(volume.opacities[i]) * glm::dvec3(volume.colors[i]);
        sum.left[pixel] *= 1 - double(volume.opacities[i]);
    }
    return sum;
}

TEST_F(DisplayedScan, LaidOverOneAnotherItsVoxelsAreTheFlatImage) {
    write_scan({20, 16, 24}, 0.1);
    const std::string medium = R"(, "medium": {"absorption": [1, 1, 1], "density": {"kind": "grid",
        "file": "scan.nrrd", "turn": [20, 10, 0], "transfer": [
          {"value": 2, "absorption": 0}, {"value": 5, "absorption": 1.5, "color": [1, 0.2, 0.1]},
          {"value": 9, "absorption": 0.2, "color": [0.1, 1, 0.2]},
          {"value": 14, "absorption": 3, "color": [0.2, 0.3, 1]}, {"value": 20, "absorption": 0}]}})";
    for (const DisplayCase& shape : kDisplayCases) {
        Scene scene = parsed_here(display_scene(
            std::string(shape.keys) + R"(, "voxels": [16, 12, 20])", "exact", medium));
        scene.world.background = glm::vec3(0);
        const Volume volume = volume_of(scene);
        const Laid seen = laid(volume);
        scene.render.size = {16, 12};
        RenderReport report;
        const Image image = render(shared_device(), scene, report);
        double largest = 0, brightest = 0;
        for (size_t i = 0; i < seen.light.size(); ++i) {
            const glm::dvec3 flat(image.planes.at("R")[i], image.planes.at("G")[i],
                                  image.planes.at("B")[i]);
            // The flat image looks on into the world behind the display's end.
            if (image.planes.at("A")[i] == 0) continue;
            largest = std::max(largest, glm::length(flat - seen.light[i]));
            brightest = std::max(brightest, glm::length(flat));
        }
        EXPECT_GT(brightest, 0.2) << shape.name;
        EXPECT_LT(largest, 1e-5) << shape.name;
    }
}

TEST_F(DisplayedScan, ItsVoxelsHaveTheColorsOfTheirDepthsHoweverMuchIsInFront) {
    write_scan({12, 8, 20}, 0.25);
    const Scene scene = parsed_here(R"({"voxelume": 1,
"world": {"voxel_size": 0.25, "bounds": {"min": [-1.5, -1, -2.5], "max": [1.5, 1, 2.5]},
  "medium": {"absorption": [1, 1, 1], "density": {"kind": "grid", "file": "scan.nrrd", "transfer": [
    {"value": 3, "absorption": 0.5, "color": [1, 0, 0]}, {"value": 8, "absorption": 0.5, "color": [1, 0, 0]},
    {"value": 11, "absorption": 30, "color": [0, 0.25, 1]}]}}},
"objects": [], "lights": [],
"observer": {"position": [0, 0, -3.5],
             "display": {"shape": "box", "size": [3, 2, 5], "near": 1, "voxels": [6, 4, 10]}},
"render": {"size": [6, 4]}})");
    const Volume volume = volume_of(scene);
    const size_t pixels = 24;
    size_t red = 0, blue = 0;
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        const size_t step = volume.indices[i] / pixels;
        ASSERT_EQ(volume.kinds[i], VoxelKind::space);
        // A step is two cells deep: those up to number 7 are red, those from 12 on blue.
        const bool is_red = step < 4, is_blue = step >= 6;
        if (!is_red && !is_blue) continue;
        const glm::vec3 expected = is_red ? glm::vec3(1, 0, 0) : glm::vec3(0, 0.25, 1);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(volume.colors[i][c], expected[c], 2e-6) << step;
        EXPECT_NEAR(volume.opacities[i], -std::expm1((is_red ? -0.5 : -30.0) * 0.5), 2e-6) << step;
        ++(is_red ? red : blue);
    }
    EXPECT_EQ(red, 4 * pixels);
    EXPECT_EQ(blue, 4 * pixels);
}

TEST_F(DisplayedScan, HasTheSameBitsForEveryNumberOfLanes) {
    if (!is_exhaustive()) GTEST_SKIP() << kOnlyWithAll;
    write_scan({12, 8, 20}, 0.25);
    const Scene scene = parsed_here(display_scene(
        std::string(kDisplayCases[0].keys) + R"(, "voxels": [16, 12, 20])", "exact",
        R"(, "medium": {"density": {"kind": "grid", "file": "scan.nrrd", "turn": [20, 10, 0],
           "transfer": [{"value": 2, "absorption": 0.3, "color": [1, 0.2, 0.1]},
                        {"value": 14, "absorption": 3, "color": [0.2, 0.3, 1]}]}})"));
    const Volume one = volume_of(scene, 1);
    EXPECT_GT(one.indices.size(), 1000u);
    for (const int lanes : {4, 16}) {
        const Volume more = volume_of(scene, lanes);
        EXPECT_EQ(one.indices, more.indices) << lanes;
        EXPECT_EQ(one.colors, more.colors) << lanes;
        EXPECT_EQ(one.opacities, more.opacities) << lanes;
    }
}

}  // namespace
}  // namespace voxelume
