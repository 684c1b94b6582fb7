// SPDX-License-Identifier: Apache-2.0
// Voxels with their own opacity, against their colours composited by hand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/io/vdb/vdb.hpp"
#include "runtime/render/illumination.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr const char* kPlanes[] = {"R", "G", "B"};

/// A stack of plates along Z, each of 12 x 9 voxels, as a fog that gives each plate its opacity and
/// colour.
struct Stack {
    std::vector<float> opacities = {0.2f, 0.6f, 0.4f, 1.5f, 0.8f};
    std::vector<glm::vec3> colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 1, 1}};

    void write(const std::filesystem::path& path) const {
        std::vector<glm::ivec3> cells;
        std::vector<float> values;
        std::vector<glm::vec3> of_cells;
        for (int z = 0; z < int(opacities.size()); ++z)
            for (int y = 0; y < 9; ++y)
                for (int x = 0; x < 12; ++x) {
                    cells.emplace_back(x, y, z);
                    values.push_back(opacities[size_t(z)]);
                    of_cells.push_back(colors[size_t(z)]);
                }
        VdbVolume volume;
        volume.cells = cells;
        volume.values = values;
        volume.colors = of_cells;
        volume.voxel_edges = glm::dvec3(0.05);
        volume.origin = glm::dvec3(0.025);
        write_vdb(path, volume);
    }
    /// A plate's opacity, rounded to the 8 bits that the file keeps.
    double opacity(size_t plate) const {
        return std::round(255.0 * double(std::min(opacities[plate], 1.0f))) / 255;
    }
};

/// The light that a ray sees of voxels composited front to back. Each voxel has an opacity and
/// emits light.
struct Laid {
    double left = 1;
    double light[3] = {};

    void add(const Stack& stack, size_t plate, int voxels = 1) {
        for (int i = 0; i < voxels; ++i) {
            for (int c = 0; c < 3; ++c)
                light[c] += left * stack.opacity(plate) * 0.5 * stack.colors[plate][c];
            left *= 1 - stack.opacity(plate);
        }
    }
};

constexpr double kBackground[] = {0.25, 0.5, 0.75};

std::string stack_scene(const std::string& objects, const std::string& observer) {
    return R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-0.5, -0.5, -0.5], "max": [1.5, 1, 1]},
          "background": [0.25, 0.5, 0.75], "ambient": [1, 1, 1]},
"materials": {"m": {"color": [0.5, 0.5, 0.5]},
              "mirror": {"diffuse": 0, "reflection": 1}},
"models": {"stack": {"voxels": "stack.vdb"},
           "mirror": {"shape": "box", "size": [1, 0.9, 0.12], "surface": "cubes"}},
"objects": [)" +
           objects + R"(],
"lights": [],
"observer": {)" +
           observer + R"(, "display": {"shape": "box", "size": [0.3, 0.2, 5]}},
"render": {"size": [6, 5]}})";
}

constexpr const char* kStack = R"({"model": "stack", "material": "m"})";
constexpr const char* kAlongZ = R"("position": [0.3, 0.22, -2], "look_at": [0.3, 0.22, 0])";

class StackedVoxels : public FileTest {
  protected:
    Image rendered_stack(const Stack& stack, const std::string& objects,
                         const std::string& observer = kAlongZ) const {
        stack.write(folder / "stack.vdb");
        RenderReport report;
        return render(test_device(),
                      parse_scene(stack_scene(objects, observer), folder / "s.json", {}), report);
    }

    static void expect_seen(const Image& image, const Laid& laid) {
        for (int c = 0; c < 3; ++c)
            for (const float value : image.planes.at(kPlanes[c]))
                EXPECT_NEAR(value, laid.light[c] + laid.left * kBackground[c], 2e-6) << c;
    }
};

TEST_F(StackedVoxels, CoverByTheirOwnOpacityFrontToBack) {
    Stack stack;
    for (const size_t plates : {5, 3}) {
        stack.opacities.resize(plates);
        const Image image = rendered_stack(stack, kStack);
        Laid laid;
        for (size_t plate = 0; plate < plates; ++plate) laid.add(stack, plate);
        expect_seen(image, laid);
        for (const float value : image.planes.at("A")) EXPECT_NEAR(value, 1 - laid.left, 2e-6);
    }
}

TEST_F(StackedVoxels, KeepOpacityAndColourWhenTurnedAndStretched) {
    // The stack is turned so that its plates follow one another along X, each three voxels of the
    // world deep.
    Stack stack;
    stack.opacities = {0.2f, 0.6f, 0.4f};
    const std::string placed =
        R"({"model": "stack", "material": "m", "position": [0.1, 0, 0.7], "turn": [90, 0, 0], "scale": [1, 1, 3]})";
    Laid forwards, backwards;
    for (size_t plate = 0; plate < 3; ++plate) {
        forwards.add(stack, plate, 3);
        backwards.add(stack, 2 - plate, 3);
    }
    expect_seen(
        rendered_stack(stack, placed, R"("position": [-2, 0.22, 0.4], "look_at": [0, 0.22, 0.4])"),
        forwards);
    expect_seen(
        rendered_stack(stack, placed, R"("position": [3, 0.22, 0.4], "look_at": [0, 0.22, 0.4])"),
        backwards);
}

TEST_F(StackedVoxels, CoverWhatAMirrorShowsToo) {
    Stack stack;
    stack.opacities = {0.2f, 0.6f, 0.4f};
    const Image image =
        rendered_stack(stack, fmt::format(R"({}, {{"model": "mirror", "material": "mirror",
"position": [0.3, 0.2, 0.5]}})",
                                          kStack));
    Laid laid;
    for (const size_t plate : {0, 1, 2, 2, 1, 0}) laid.add(stack, plate);
    expect_seen(image, laid);
}

TEST_F(StackedVoxels, OfWholeOpacityLeaveNothingOfItCompiled) {
    Stack stack;
    const Device device = test_device();
    const auto features = [&] {
        stack.write(folder / "stack.vdb");
        const Scene scene = parse_scene(stack_scene(kStack, kAlongZ), folder / "s.json", {});
        WorldReport report;
        return features_of(scene, build_world(device, scene, report));
    };
    const Features some = features();
    EXPECT_TRUE(some.voxel_opacity && some.transmission && some.paths && some.cube_bodies);
    stack.opacities.assign(5, 1.0f);
    const Features none = features();
    EXPECT_FALSE(none.voxel_opacity || none.transmission || none.paths || none.cube_bodies);
    EXPECT_TRUE(none.colors);
}

TEST_F(StackedVoxels, TintTheLightThatPassesThem) {
    Stack stack;
    stack.opacities.resize(3);
    stack.write(folder / "stack.vdb");
    // Light along Z falls through three plates onto a wall that is seen from the side.
    const auto text = [](bool with_stack) {
        return std::string(R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-1, -0.5, -0.5], "max": [1.5, 1, 1]}},
"materials": {"m": {}, "wall": {"color": [1, 1, 1]}},
"models": {"stack": {"voxels": "stack.vdb"},
           "wall": {"shape": "box", "size": [4, 4, 0.2], "surface": "cubes"}},
"objects": [{"model": "wall", "material": "wall", "position": [0.3, 0.2, 0.7]})") +
               (with_stack ? R"(, {"model": "stack", "material": "m"})" : "") + R"(],
"lights": [{"type": "directional", "direction": [0, 0, 1]}],
"observer": {"position": [-1.5, 0.22, 0.2], "look_at": [0.3, 0.22, 0.55],
             "display": {"shape": "pyramid", "angle": 2}},
"render": {"size": [6, 6]}})";
    };
    RenderReport report;
    const Image bare =
        render(test_device(), parse_scene(text(false), folder / "s.json", {}), report);
    const Image tinted =
        render(test_device(), parse_scene(text(true), folder / "s.json", {}), report);
    for (int c = 0; c < 3; ++c) {
        double transmittance = 1;
        for (size_t plate = 0; plate < 3; ++plate) {
            const double a = stack.opacity(plate), color = 0.8 * stack.colors[plate][c];
            transmittance *= (1 - a) * ((1 - a) + a * color);
        }
        for (size_t i = 0; i < 36; ++i) {
            ASSERT_GT(bare.planes.at(kPlanes[c])[i], 0.1f);
            EXPECT_NEAR(tinted.planes.at(kPlanes[c])[i],
                        transmittance * bare.planes.at(kPlanes[c])[i], 1e-6);
        }
    }
}

}  // namespace
}  // namespace voxelume
