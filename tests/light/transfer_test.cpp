// SPDX-License-Identifier: Apache-2.0
// Transfer functions of scans against integrals in double.
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <fstream>

#include "runtime/assets/asset_store.hpp"
#include "runtime/grid/density_field.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/stages/medium/density_grid.hpp"
#include "tests/light/transfer_windows.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

/// A NRRD file of floats in cells of an edge, the first around the origin.
void write_nrrd(const std::filesystem::path& file, const glm::ivec3& size, double edge,
                const std::vector<float>& values) {
    std::ofstream out(file, std::ios::binary);
    out << "NRRD0004\ntype: float\ndimension: 3\nsizes: " << size.x << " " << size.y << " "
        << size.z << "\nspace directions: (" << edge << ",0,0) (0," << edge << ",0) (0,0," << edge
        << ")\nspace dimension: 3\nspace origin: (0,0,0)\nendian: little\nencoding: raw\n\n";
    out.write(reinterpret_cast<const char*>(values.data()),
              std::streamsize(values.size() * sizeof(float)));
}

class TransferTest : public FileTest {
  protected:
    static constexpr int kCells = 12;
    static constexpr double kEdge = 0.125;

    /// A scene that sees a ramp from -4 to 7 in cells along X, against a white background, from
    /// its side in parallel rays, or from a corner.
    Scene ramp_scene(const std::string& position, const std::string& more = "") {
        std::vector<float> values;
        for (int i = 0; i < kCells * kCells * kCells; ++i)
            values.push_back(float(ramp(double(i % kCells))));
        write_nrrd(folder / "ramp.nrrd", glm::ivec3(kCells), kEdge, values);
        std::string points;
        for (const TransferPoint& p : kWindows)
            points += fmt::format(R"({}{{"value": {}, "absorption": {}, "color": [{}, {}, {}]}})",
                                  points.empty() ? "" : ", ", p.value, p.absorption, p.color.x,
                                  p.color.y, p.color.z);
        const double low = -kEdge / 2, high = low + kCells * kEdge;
        return parse_scene(
            fmt::format(R"({{"voxelume": 1, "world": {{"voxel_size": {0}, "background": [1, 2, 4],
                "bounds": {{"min": [{1}, {1}, {1}], "max": [{2}, {2}, {2}]}},
                "medium": {{{4}"density": {{"kind": "grid", "file": "ramp.nrrd",
                                           "transfer": [{3}]}}}}}},
                "objects": [], "lights": [], "observer": {{"position": {5}, "look_at": [0.6875, 0.6875, 0.6875],
                "display": {{"shape": "box", "size": [0.5, 0.5, 9]}}}},
                "render": {{"size": [4, 4]}}}})",
                        kEdge, low, high, points, more, position),
            folder / "s.json", {folder});
    }

    /// The value at a place in cells, 0 being the middle of the first.
    static double ramp(double x) {
        const double within = std::clamp(x, 0.0, double(kCells - 1));
        return -4 + within * (11.0 / (kCells - 1));
    }

    /// The integral of a channel along X through all cells, metres times 1/m.
    static double integral(int channel) {
        constexpr int kSteps = 400'000;
        double sum = 0;
        for (int i = 0; i < kSteps; ++i)
            sum += light_at(ramp(-0.5 + kCells * (i + 0.5) / kSteps), channel);
        return sum * kCells * kEdge / kSteps;
    }

    /// Radiance of rays along X, by many thin layers from the far end on.
    static double radiance_from_low_x(int channel, double background) {
        constexpr int kSteps = 400'000;
        const double length = kCells * kEdge / kSteps;
        double radiance = background;
        for (int i = kSteps - 1; i >= 0; --i) {
            const double value = ramp(-0.5 + kCells * (i + 0.5) / kSteps);
            radiance = radiance * std::exp(-light_at(value, 3) * length) +
                       light_at(value, channel) * length;
        }
        return radiance;
    }

    static double color_of(const Image& image, size_t pixel, int channel) {
        constexpr std::array kNames = {"R", "G", "B"};
        return double(image.planes.at(kNames[size_t(channel)])[pixel]);
    }

    static Image picture(const Scene& scene) {
        RenderReport report;
        return render(test_device(), scene, report);
    }
};

}  // namespace

TEST_F(TransferTest, LightOfARampIsNearlyThatOfThinLayers) {
    const Image image = picture(ramp_scene("[-4, 0.6875, 0.6875]"));
    // Inside of a voxel, light is mixed with the mean colour: here a voxel has depths of up to 1.
    for (int channel = 0; channel < 3; ++channel) {
        const double expected = radiance_from_low_x(channel, channel == 0   ? 1
                                                             : channel == 1 ? 2
                                                                            : 4);
        for (size_t pixel = 0; pixel < 16; ++pixel)
            EXPECT_NEAR(color_of(image, pixel, channel), expected, 0.03 * expected) << channel;
    }
}

TEST_F(TransferTest, OpticalDepthOfARampIsExactFromBothEnds) {
    for (const char* position : {"[-4, 0.6875, 0.6875]", "[6, 0.6875, 0.6875]"}) {
        // A colour of 0: what is left of the background tells the depth.
        Scene scene = ramp_scene(position, R"("absorption": [0.25, 0.5, 0.125], )");
        for (TransferPoint& point : std::get<GridDensity>(scene.world.medium.density).transfer)
            point.color = glm::vec3(0);
        const Image image = picture(scene);
        const double depth = integral(3);
        EXPECT_GT(depth, 1);
        for (size_t pixel = 0; pixel < 16; ++pixel)
            for (int channel = 0; channel < 3; ++channel) {
                const double share = channel == 0 ? 0.25 : channel == 1 ? 0.5 : 0.125;
                const double left =
                    color_of(image, pixel, channel) / double(scene.world.background[channel]);
                EXPECT_NEAR(-std::log(left), share * depth, 1e-5 * share * depth) << channel;
            }
    }
}

TEST_F(TransferTest, HasTheSameBitsWithAnyNumberOfLanes) {
    if (!is_exhaustive()) GTEST_SKIP() << kOnlyWithAll;
    const Scene scene = ramp_scene("[-3, 2.5, 4]");
    RenderReport report;
    const Image one = render(test_device(1), scene, report);
    for (const int lanes : {4, 16}) {
        const Image more = render(test_device(lanes), scene, report);
        for (const char* name : {"R", "G", "B"})
            EXPECT_EQ(one.planes.at(name), more.planes.at(name)) << lanes << name;
    }
}

TEST_F(TransferTest, ThatIsLitIsDarkerOnTheSideAwayFromTheLight) {
    Scene scene = ramp_scene("[-4, 0.6875, 0.6875]");
    auto& density = std::get<GridDensity>(scene.world.medium.density);
    density.transfer = {{-1, 0, {1, 1, 1}}, {1, 500, {1, 1, 1}}};  // absorption rises along X
    EXPECT_NEAR(color_of(picture(scene), 0, 0), 1, 1e-3);
    density.lit = {1, 0, 0};
    EXPECT_NEAR(color_of(picture(scene), 0, 0), 1, 1e-3);
    density.lit = {-1, 0, 0};
    EXPECT_NEAR(color_of(picture(scene), 0, 0), 0.25, 1e-3);
}

TEST_F(TransferTest, ThatIsLitByTheSceneHasTheLightOfItsLights) {
    // Absorption rises along X, so that the surface faces lower X.
    Scene scene = ramp_scene("[-4, 0.6875, 0.6875]");
    auto& density = std::get<GridDensity>(scene.world.medium.density);
    const glm::dvec3 color(1, 0.5, 0.25);
    density.transfer = {{-4, 0, color}, {7, 44, color}};
    density.is_lit_by_scene = true;
    scene.world.ambient = {0.125F, 0.25F, 0.0625F};
    scene.lights.resize(2);
    scene.lights[0].position = {-3, 2, 0.6875};
    scene.lights[0].intensity = {8, 4, 2};
    scene.lights[1].kind = LightKind::directional;
    scene.lights[1].direction = {0.6, -0.8, 0};
    scene.lights[1].intensity = {0.5F, 1, 0.25F};
    const Image image = picture(scene);
    for (size_t pixel = 0; pixel < 16; ++pixel) {
        const double y = 0.6875 + 0.5 * (0.375 - 0.25 * double(pixel / 4));
        const double z = 0.5 * (0.375 - 0.25 * double(pixel % 4));  // from the light's plane
        glm::dvec3 radiance(0);
        double through = 1;
        for (int i = 0; i < kCells; ++i) {
            const double low = 4 * (ramp(i - 0.25) + 4), high = 4 * (ramp(i + 0.25) + 4);
            const double share = std::min(4 * (high - low) / (high + low), 1.0);
            const glm::dvec3 way(i * kEdge + 3, y - 2, z);
            const double distance = glm::length(way);
            const auto faced = [&](double cosine) { return 1 - share + share * cosine; };
            const glm::dvec3 light =
                glm::dvec3(0.125, 0.25, 0.0625) +
                glm::dvec3(8, 4, 2) * faced(way.x / distance) / (distance * distance) +
                glm::dvec3(0.5, 1, 0.25) * faced(0.6);
            const double left = std::exp(-(low + high) / 2 * kEdge);
            radiance += through * (1 - left) * color * light;
            through *= left;
        }
        radiance += through * glm::dvec3(1, 2, 4);
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(color_of(image, pixel, channel), radiance[channel], 1e-5)
                << pixel << channel;
    }
}

TEST_F(TransferTest, OfAFileWithoutOneItsValuesAreDensities) {
    Scene scene = ramp_scene("[-4, 0.6875, 0.6875]", R"("absorption": [0.5, 0.5, 0.5], )");
    std::get<GridDensity>(scene.world.medium.density).transfer.clear();
    double depth = 0;  // of densities at the middles of voxels
    for (int i = 0; i < kCells; ++i) depth += std::max(ramp(i), 0.0) * kEdge;
    EXPECT_NEAR(-std::log(color_of(picture(scene), 0, 0)), 0.5 * depth, 1e-5 * depth);
}

TEST_F(TransferTest, ThatIsWrongSaysWhere) {
    const auto message = [&](const std::string& points) {
        put_bytes(folder / "a.npy", "");
        return std::string(error_of([&] {
                               parse_scene(
                                   R"({"voxelume": 1, "objects": [], "world": {"voxel_size": 1,
                    "bounds": {"min": [0, 0, 0], "max": [1, 1, 1]}, "medium": {"density":
                    {"kind": "grid", "file": "a.npy", "transfer": )" +
                                       points + "}}}}",
                                   folder / "s.json", {folder});
                           }).what());
    };
    EXPECT_THAT(message("[]"), HasSubstr("density.transfer: needs at least one point"));
    EXPECT_THAT(message(R"([{"value": 1}])"), HasSubstr("transfer[0]: needs an \"absorption\""));
    EXPECT_THAT(
        message(R"([{"value": 1, "absorption": 1}, {"value": 1, "absorption": 2}])"),
        HasSubstr("transfer[1]: has the value 1, not above that of the point before it, 1"));
    EXPECT_THAT(message(R"([{"value": 1, "absorption": -1}])"),
                HasSubstr("transfer[0].absorption: must"));
}

}  // namespace voxelume
