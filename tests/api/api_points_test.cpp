// SPDX-License-Identifier: Apache-2.0
// Scans and drawings without faces: each voxel that a point lies in has the point's colour.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>

#include "runtime/voxelume/files.hpp"
#include "tests/api/api_fixture.hpp"

namespace voxelume::v1 {
namespace {

using testing::HasSubstr;

constexpr int kColumns = 7, kRows = 5;

class ApiPoints : public ApiTest {
  protected:
    /// A point in the middle of every voxel of a checkerboard, seen along -Z with a pixel a voxel.
    void SetUp() override {
        ApiTest::SetUp();
        std::ofstream file(folder / "scan.ply");
        int count = 0;
        std::string rows;
        for (int y = 0; y < kRows; ++y)
            for (int x = 0; x < kColumns; ++x) {
                if (!is_there(x, y)) continue;
                ++count;
                rows += fmt::format("{} {} {} {} {} 0\n", x + 0.5, y + 0.5, 0.5 + (x + y) % 3,
                                    red_of(x), green_of(y));
            }
        file << "ply\nformat ascii 1.0\nelement vertex " << count
             << "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                "property uchar green\nproperty uchar blue\nend_header\n"
             << rows;
    }

    static bool is_there(int x, int y) { return (x + y) % 2 == 0; }
    static int red_of(int x) { return 30 * x + 10; }
    static int green_of(int y) { return 40 * y + 20; }

    Scene scene(const std::string& model) const {
        const std::string text = R"({"voxelume": 1,
"world": {"voxel_size": 1, "bounds": {"min": [-2, -2, -2], "max": [9, 7, 5]},
          "background": [0, 0, 0], "ambient": [1, 1, 1]},
"materials": {"own": {"color": [1, 1, 1]}},
"models": {"scan": {"mesh": "scan.ply", "voxel_size": 1)" +
                                 model + R"(}},
"objects": [{"model": "scan", "material": "own"}],
"lights": [],
"observer": {"position": [3.5, 2.5, 5], "look_at": [3.5, 2.5, 0],
             "display": {"shape": "box", "size": [7, 5, 7]}},
"render": {"size": [7, 5]}})";
        return Scene::parse(text, (folder / "scene.json").string(), {.cache = no_cache});
    }

    std::string message_of(const std::string& model) const {
        try {
            plan(scene(model), device->front(), {.cache = no_cache});
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    }

    const CacheOptions no_cache{.enabled = false};
};

}  // namespace

TEST_F(ApiPoints, AreVoxelsOfTheirColours) {
    const Image image = render_image(scene(""), *device, 1, {.cache = no_cache});
    for (int y = 0; y < kRows; ++y)
        for (int x = 0; x < kColumns; ++x) {
            SCOPED_TRACE(testing::Message() << x << ", " << y);
            const size_t pixel = size_t(x + kColumns * (kRows - 1 - y));
            EXPECT_EQ(image.object_ids()[pixel], is_there(x, y) ? 1u : 0u);
            if (!is_there(x, y)) continue;
            EXPECT_NEAR(image.plane("Z")[pixel], 4 - (x + y) % 3, 1e-4);
            EXPECT_NEAR(image.plane("R")[pixel], linear_from_code(red_of(x)), 1e-3);
            EXPECT_NEAR(image.plane("G")[pixel], linear_from_code(green_of(y)), 1e-3);
        }
}

TEST_F(ApiPoints, HaveNoOtherSurfaceThanCubes) {
    EXPECT_EQ(message_of(""), "no error");
    EXPECT_EQ(message_of(R"(, "surface": "cubes")"), "no error");
    EXPECT_THAT(message_of(R"(, "surface": "exact")"),
                HasSubstr("\"scan.ply\" has points and lines alone, which have no exact surface: "
                          "give it \"surface\": \"cubes\""));
    EXPECT_THAT(message_of(R"(, "surface": "smooth")"), HasSubstr("no smooth surface"));
}

TEST_F(ApiPoints, AreVoxelizedWithoutGapsUnlessASizeIsGiven) {
    std::ofstream file(folder / "flat.ply");
    file << "ply\nformat ascii 1.0\nelement vertex 10000\nproperty float x\nproperty float y\n"
            "property float z\nend_header\n";
    for (int i = 0; i < 10000; ++i) file << i % 100 << " " << i / 100 << " 0\n";
    file.close();
    const auto longest = [&](const VoxelizeOptions& options) {
        return voxelize(folder / "flat.ply", {folder / "flat.vxm"}, device->front(), options)
            .size[0];
    };
    EXPECT_GT(longest({}), 32);
    EXPECT_LT(longest({}), 70) << "three points in a voxel";
    EXPECT_GE(longest({.resolution = 200}), 200);
    EXPECT_GE(longest({.voxel_size = 0.5}), 198);
}

}  // namespace voxelume::v1
