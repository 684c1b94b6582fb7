// SPDX-License-Identifier: Apache-2.0
// Callers hear of kernels that are compiled. The process has compiled none before.
#include <gmock/gmock.h>

#include <utility>

#include "tests/api/api_environment.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/setting.hpp"

namespace voxelume::v1 {
namespace {

class ApiCompiling : public FileTest {};

TEST_F(ApiCompiling, IsToldOfKernelsThatNoEarlierRunCompiled) {
    const std::filesystem::path cache = folder / "cache";
    const Setting setting("VOXELUME_CACHE_DIR", cache.string());
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
