// SPDX-License-Identifier: Apache-2.0
// Several scans, and several windows of one, in one medium: what they absorb and show adds up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/stages/medium/density_grid.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

constexpr double kScanEdge = 0.25;

class ScanWindows : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        write_scan("ramp.nrrd", {7, 5, 12});
        write_scan("other.nrrd", {3, 5, 4});
    }

    /// Writes cells whose values are 10 times their numbers along z, the first around the origin.
    void write_scan(const std::string& name, const glm::ivec3& size) const {
        std::string text = fmt::format(
            "NRRD0004\ntype: uchar\ndimension: 3\nsizes: {} {} {}\nspace directions: ({},0,0) "
            "(0,{},0) (0,0,{})\nspace dimension: 3\nspace origin: (0,0,0)\nencoding: raw\n\n",
            size.x, size.y, size.z, kScanEdge, kScanEdge, kScanEdge);
        for (int z = 0; z < size.z; ++z) text.append(size_t(size.x) * size_t(size.y), char(10 * z));
        put_bytes(folder / name, text);
    }

    std::string text_of(const std::string& density) const {
        return R"({"voxelume": 1, "world": {"voxel_size": 0.25, "background": [1, 2, 4],
"bounds": {"min": [-0.125, -0.125, -0.125], "max": [1.625, 1.125, 2.875]},
"medium": {"density": {"kind": "grid", )" +
               density + R"(}}}, "objects": [], "lights": [],
"observer": {"position": [0.75, 0.5, -4], "look_at": [0.75, 0.5, 0],
             "display": {"shape": "box", "size": [1.75, 1.25, 9]}},
"render": {"size": [7, 5]}})";
    }
    Scene scene_of(const std::string& density) const {
        return parse_scene(text_of(density), folder / "s.json", {folder});
    }
    std::string refusal_of(const std::string& density) const {
        return error_of([&] { scene_of(density); }).what();
    }
};

Image picture(const Scene& scene) {
    RenderReport report;
    return render(shared_device(), scene, report);
}

/// A pixel of the middle row; the first column is that of the largest x.
glm::dvec3 color_at(const Image& image, int column) {
    const size_t pixel = size_t(2 * image.width + column);
    return {image.planes.at("R")[pixel], image.planes.at("G")[pixel], image.planes.at("B")[pixel]};
}

TEST_F(ScanWindows, OfOneScanLookLikeOneFunctionOfBoth) {
    const std::string soft =
        R"({"value": 5, "absorption": 0}, {"value": 22, "absorption": 1.5, "color": [1, 0.2, 0.1]},
           {"value": 41, "absorption": 0})";
    const std::string hard =
        R"({"value": 63, "absorption": 0}, {"value": 80, "absorption": 4, "color": [0.1, 0.3, 1]})";
    const Image one =
        picture(scene_of(R"("file": "ramp.nrrd", "transfer": [)" + soft + "," + hard + "]"));
    const Image both =
        picture(scene_of(R"("file": "ramp.nrrd", "transfer": [)" + soft +
                         R"(], "others": [{"file": "ramp.nrrd", "transfer": [)" + hard + "]}]"));
    EXPECT_GT(glm::length(color_at(one, 3)), 0.1);
    for (const char* channel : {"R", "G", "B"})
        for (size_t i = 0; i < one.planes.at(channel).size(); ++i)
            EXPECT_NEAR(one.planes.at(channel)[i], both.planes.at(channel)[i], 1e-6);
}

TEST_F(ScanWindows, ThatOverlapAddTheirAbsorptionAndMixTheirColors) {
    const Image image = picture(scene_of(
        R"("file": "ramp.nrrd", "transfer": [{"value": 0, "absorption": 0.3, "color": [1, 0, 0.5]}],
           "others": [{"file": "ramp.nrrd",
                       "transfer": [{"value": 0, "absorption": 0.7, "color": [0, 1, 0.25]}]}])"));
    const double left = std::exp(-1.0 * 3);  // of 3 metres
    const glm::dvec3 mixed(0.3, 0.7, 0.3 * 0.5 + 0.7 * 0.25), background(1, 2, 4);
    for (int column = 0; column < 7; ++column)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(color_at(image, column)[c], background[c] * left + mixed[c] * (1 - left),
                        3e-6)
                << column << c;
}

TEST_F(ScanWindows, OfScansInOtherPlacesAbsorbAsMuchAsEachAlone) {
    const std::string first = R"("file": "ramp.nrrd", "transfer": [
        {"value": 10, "absorption": 0, "color": [0, 0, 0]}, {"value": 90, "absorption": 1.5, "color": [0, 0, 0]}])";
    const std::string second =
        R"("file": "other.nrrd", "position": [0.35, 0.1, 1.05], "turn": [9, 0, 0],
        "transfer": [{"value": 0, "absorption": 0.7, "color": [0, 0, 0]}])";
    const Image one = picture(scene_of(first)), other = picture(scene_of(second)),
                both = picture(scene_of(first + R"(, "others": [{)" + second + "}]"));
    const glm::dvec3 background(1, 2, 4);
    int overlaps = 0;
    for (int column = 0; column < 7; ++column)
        for (int c = 0; c < 3; ++c) {
            const double of_one = color_at(one, column)[c] / background[c],
                         of_other = color_at(other, column)[c] / background[c];
            overlaps += of_other < 0.9 ? 1 : 0;
            EXPECT_NEAR(color_at(both, column)[c] / background[c], of_one * of_other, 2e-6)
                << column << c;
        }
    EXPECT_GE(overlaps, 9);
    EXPECT_LE(overlaps, 18);
}

TEST_F(ScanWindows, OfOneScanReadItOnce) {
    const std::string window = R"("transfer": [{"value": 20, "absorption": 1}])";
    const auto bytes = [&](const std::string& others) {
        return plan_density(scene_of(R"("file": "ramp.nrrd", )" + window + others).world)
            .host_bytes;
    };
    const double one = bytes("");
    EXPECT_EQ(bytes(R"(, "others": [{"file": "ramp.nrrd", )" + window + "}]"), one);
    EXPECT_GT(
        bytes(R"(, "others": [{"file": "ramp.nrrd", "position": [1, 0, 0], )" + window + "}]"),
        one);
}

TEST_F(ScanWindows, ThatAreWrongSayWhere) {
    const std::string first = R"("file": "ramp.nrrd", "transfer": [{"value": 1, "absorption": 1}])";
    EXPECT_THAT(refusal_of(R"("file": "ramp.nrrd", "others": [])"),
                HasSubstr("density.others: are scans with transfer functions"));
    EXPECT_THAT(refusal_of(first + R"(, "others": [{"file": "other.nrrd"}])"),
                HasSubstr("others[0]: needs a \"transfer\""));
    EXPECT_THAT(refusal_of(first + R"(, "others": [{"file": "none.nrrd", "transfer": [{"value": 1,
                                        "absorption": 1}]}])"),
                HasSubstr("others[0].file"));
    EXPECT_THAT(refusal_of(first + R"(, "others": [{"file": "other.nrrd", "sequence": {}}])"),
                HasSubstr("others[0]"));
    std::string many;
    for (int i = 0; i < 16; ++i) many += fmt::format("{}{{{}}}", i == 0 ? "" : ", ", first);
    EXPECT_THAT(refusal_of(first + R"(, "others": [)" + many + "]"),
                HasSubstr("has 16 scans; at most 15 are allowed"));
    put_bytes(folder / "other.nrrd", "NRRD0004\ntype: uchar\n");
    EXPECT_THAT(error_of([&] {
                    form_density_grid(
                        shared_device(),
                        scene_of(first + R"(, "others": [{"file": "other.nrrd", "transfer": [
                                          {"value": 1, "absorption": 1}]}])")
                            .world);
                }).what(),
                HasSubstr("others[0].file: "));
}

// Kernels multiply them by the 0 of lanes that have no medium.
TEST_F(ScanWindows, NoColorIsLeftUndefinedWhereNothingIs) {
    Scene scene = scene_of(
        R"("file": "other.nrrd", "transfer": [{"value": 5, "absorption": 0},
                                              {"value": 20, "absorption": 3}])");
    scene.world.bounds.max = glm::dvec3(9);
    const auto dirty = [&] {
        DensityGrid grid = form_density_grid(shared_device(), scene.world);
        grid.colors.fill(NAN);
        return grid.colors.size();
    };
    const size_t size = dirty();
    const std::vector<float> colors =
        form_density_grid(shared_device(), scene.world).colors.read(0, size);
    for (const float color : colors) ASSERT_TRUE(std::isfinite(color));
}

}  // namespace
}  // namespace voxelume
