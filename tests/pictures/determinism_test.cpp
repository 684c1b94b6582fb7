// SPDX-License-Identifier: Apache-2.0
// Equal scenes give equal bytes: the stress cases D2 and D6 (tests/CASES.md), and all properties of
// a device that must not matter.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/setting.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// The text of an OBJ file of a ring of triangles.
std::string ring_text() {
    constexpr int kAround = 24, kAcross = 12;
    std::string text;
    for (int i = 0; i < kAround; ++i)
        for (int j = 0; j < kAcross; ++j) {
            const double a = 2 * std::numbers::pi * i / kAround;
            const double b = 2 * std::numbers::pi * j / kAcross, r = 0.4 + 0.18 * std::cos(b);
            text +=
                fmt::format("v {} {} {}\n", r * std::cos(a), 0.18 * std::sin(b), r * std::sin(a));
        }
    for (int i = 0; i < kAround; ++i)
        for (int j = 0; j < kAcross; ++j) {
            const int next = (i + 1) % kAround * kAcross + 1, neighbour = (j + 1) % kAcross;
            text += fmt::format("f {} {} {} {}\n", i * kAcross + 1 + j, i * kAcross + 1 + neighbour,
                                next + neighbour, next + j);
        }
    return text;
}

constexpr const char* kRings = R"({"voxelume": 1,
"world": {"voxel_size": 0.03, "bounds": {"min": [-0.7, -0.9, -0.7], "max": [0.7, 0.9, 0.7]}},
"models": {"smooth": {"mesh": "ring.obj", "surface": "smooth"},
           "solid": {"mesh": "ring.obj", "surface": "cubes", "set": "solid"},
           "exact": {"mesh": "ring.obj", "surface": "exact"}},
"objects": [{"model": "smooth", "turn": [11, 20, 5]},
            {"model": "solid", "position": [0.01, 0.55, 0.02], "turn": [7, 0, 3]},
            {"model": "exact", "position": [0.01, -0.55, 0.02]}],
"observer": {"position": [0.5, 1.2, 2.4], "look_at": [0, 0, 0],
             "display": {"shape": "pyramid", "angle": 45}},
"lights": [{"type": "point", "position": [2, 3, 4], "intensity": 20}]})";

constexpr const char* kSolidsCommand = VXL_SOURCE_DIR "/scenes/solids.json";
constexpr const char* kRingsCommand = "rings.json --no-cache";

class Determinism : public ProgramTest {
  protected:
    void write_rings() const {
        std::ofstream(folder / "ring.obj") << ring_text();
        std::ofstream(folder / "rings.json") << kRings;
    }

    /// The bytes of the scenes' images.
    std::string image(const std::string& name) {
        write_rings();
        std::string bytes;
        for (const char* scene : scenes) {
            const ProgramResult result =
                run(fmt::format("render {} --size 52x39 --float -q -o {}.exr", scene, name));
            EXPECT_EQ(result.exit_code, 0) << result.err;
            bytes += bytes_of(folder / (name + ".exr"));
        }
        return bytes;
    }

    void expect_same_image(const char* variable, const std::vector<const char*>& values) {
        const std::string expected = image("own");
        ASSERT_FALSE(expected.empty());
        for (const char* value : values) {
            const Setting setting(variable, value);
            EXPECT_TRUE(image("other") == expected) << variable << "=" << value;
        }
    }

    std::vector<const char*> scenes = {kSolidsCommand, kRingsCommand};
};

TEST_F(Determinism, D2ThreadsOfTheDeviceDoNotChangeABit) {
    expect_same_image("POCL_MAX_PTHREAD_COUNT",
                      is_exhaustive() ? std::vector{"1", "2", "3", "16"} : std::vector{"1", "3"});
}

TEST_F(Determinism, D6RunsOfTheProgramGiveTheSameBytes) {
    const std::string expected = image("first");
    for (int i = 1; i < 3; ++i) ASSERT_TRUE(image("again") == expected) << i;
}

TEST_F(Determinism, D6TenRendersOfTheSameDeviceGiveTheSameBits) {
    write_rings();
    Scene scene = read_scene(folder / "rings.json", {});
    resize(scene, {52, 39});
    const Device device = test_device();
    const auto hash = [&] {  // the hash of an image made from files; nothing is kept
        RenderReport report;
        return oracle::image_hash(render(device, scene, report));
    };
    const uint64_t expected = hash();
    for (int i = 1; i < 10; ++i) ASSERT_EQ(hash(), expected) << i;
}

TEST_F(Determinism, WorkGroupsOfAnySizeGiveTheSameBytes) {
    expect_same_image("VOXELUME_WORK_GROUP", in_turn<const char*>({"32", "64", "256"}, 1));
}

/// Only meshes are tested here; matrix_test.cpp tests solids, and by default it alone.
TEST_F(Determinism, WorkGroupsOfOtherSizesGiveTheSameBytesOfMeshes) {
    if (!is_exhaustive()) GTEST_SKIP() << "VXL_TEST_ALL isn't set";
    scenes = {kRingsCommand};
    expect_same_image("VOXELUME_WORK_GROUP", {"1", "24"});
}

TEST_F(Determinism, APartOfTheDeviceGivesTheSameBytes) {
    if (!test_device().is_cpu()) GTEST_SKIP() << "GPUs can't be divided";
    expect_same_image("VOXELUME_UNITS", {"1"});
}

TEST_F(Determinism, BatchesOfAnySizeGiveTheSameBytes) {
    expect_same_image("VOXELUME_BATCH", in_turn<const char*>({"512", "10000", "2097152"}, 1));
}

TEST_F(Determinism, AnOptimizerGivesTheSameBytesAsNone) {
    expect_same_image("VOXELUME_BUILD_OPTIONS", {"", "-cl-opt-disable"});
}

TEST_F(Determinism, RefusesSettingsThatAreNoNumbers) {
    const Setting setting("VOXELUME_WORK_GROUP", "many");
    const ProgramResult result = run("render nothing.json -o a.exr");
    EXPECT_NE(result.exit_code, 0);
}

}  // namespace
}  // namespace voxelume
