// SPDX-License-Identifier: Apache-2.0
// Damaged scene files: each gives a scene or an error that names the file.
#include <gmock/gmock.h>

#include <fstream>
#include <random>

#include "runtime/base/error.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/scene/small_scene.hpp"

namespace voxelume {
namespace {

class SceneText : public testing::TestWithParam<const char*> {};

TEST_P(SceneText, NoDamageToAShippedSceneEscapesAsAnythingButAnError) {
    std::ifstream stream(kScenes / GetParam());
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    ASSERT_FALSE(text.empty());
    const unsigned seed = 1980;
    std::mt19937 random(seed);
    int refused = 0;
    for (int i = 0; i < 3000; ++i) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", case " << i);
        std::string damaged = text;
        for (int change = 0; change < 3; ++change) {
            const size_t at = random() % damaged.size();
            switch (random() % 3) {
                case 0:
                    damaged[at] = static_cast<char>(random());
                    break;
                case 1:
                    damaged.erase(at, random() % 40);
                    break;
                default:
                    damaged.insert(at, text, random() % text.size(), random() % 40);
            }
        }
        try {
            scene_at(parse_scene(damaged, "damaged.json", {}), 7.5);
        } catch (const Error& error) {
            ++refused;
            EXPECT_THAT(error.what(), testing::StartsWith("damaged.json:"));
        }
    }
    EXPECT_GT(refused, 2500);
}

INSTANTIATE_TEST_SUITE_P(Shipped, SceneText, testing::Values("solids.json", "drill.json"),
                         [](const auto& file) { return std::string(file.param).substr(0, 5); });

}  // namespace
}  // namespace voxelume
