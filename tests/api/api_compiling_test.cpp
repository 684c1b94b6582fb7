// SPDX-License-Identifier: Apache-2.0
// Callers hear of kernels that are compiled. The process has compiled none before.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <utility>

#include "tests/api/api_environment.hpp"
#include "tests/support/setting.hpp"

namespace voxelume::v1 {
namespace {

/// An empty folder that is left behind: PoCL keeps it for this process, whose other tests compile
/// there, too.
std::filesystem::path fresh_cache() {
    const char* shared = std::getenv("VOXELUME_CACHE_DIR");
    const std::filesystem::path folder =
        (shared ? std::filesystem::path(shared) : std::filesystem::temp_directory_path()) /
        "api_compiling_test";
    std::filesystem::remove_all(folder);
    return folder;
}

/// A mirror, in 40 x 24 pixels.
SceneDescription mirrored_ball() {
    SceneDescription scene;
    scene.name = "mirrored";
    scene.world = {.voxel_size = uniform(0.05), .min = {-1, -1, -1}, .max = {1, 1, 1}};
    scene.materials = {{.name = "mirror", .color = {0.2, 0.2, 0.2}, .reflection = 0.5}};
    scene.models = {{.name = "ball", .source = Sphere{0.3}}};
    scene.objects = {{.name = "ball", .model = "ball", .material = "mirror"}};
    scene.lights = {{.source = PointLight{{0.5, 0.9, -0.8}}, .intensity = 2}};
    scene.observer = {.position = {0.2, 0.5, -3}, .look_at = Vec3{0, 0, 0}};
    scene.render.size = {40, 24};
    return scene;
}

TEST(ApiCompiling, IsToldOfKernelsThatNoEarlierRunCompiled) {
    const Setting setting("VOXELUME_CACHE_DIR", fresh_cache().string());
    const std::vector<Device> fresh = {Device::open(test_selector())};
    const Scene scene = Scene::build(mirrored_ball());
    std::vector<std::pair<int, int>> heard;
    RenderOptions options{.cache = {.enabled = false}};
    options.compiling = [&](int kernel, int known) { heard.emplace_back(kernel, known); };
    render_image(scene, fresh, 1, options);
    ASSERT_GT(heard.size(), 3u);
    for (size_t i = 0; i < heard.size(); ++i) {
        EXPECT_EQ(heard[i].first, int(i) + 1);
        EXPECT_LE(heard[i].first, heard[i].second);
    }
    heard.clear();
    render_image(scene, fresh, 1, options);
    EXPECT_THAT(heard, testing::IsEmpty());
}

}  // namespace
}  // namespace voxelume::v1
