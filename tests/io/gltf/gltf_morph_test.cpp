// SPDX-License-Identifier: Apache-2.0
// Morph targets of glTF files: vertices at random times against sums written here.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <random>

#include "runtime/assets/asset_store.hpp"
#include "runtime/import/scene_of_file.hpp"
#include "runtime/io/gltf/gltf_targets.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/parsed_gltf.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

const std::vector<float> kCorners = {0, 0, 0, 7, 0, 0, 0, 5, 3};
const std::vector<float> kPulled = {0, 1, 0, 0.5F, 0, 0, 0, 0, -2};
const std::vector<float> kRaised = {0, 0, 4, 0, 0, 4, 0.25F, 0, 4};

/// A triangle with two targets, and weights of its mesh.
GltfWriter pulled_triangle(const std::vector<float>& weights) {
    GltfWriter writer = triangle_gltf();
    Json& mesh = writer.json["meshes"][0];
    for (const std::vector<float>* offsets : {&kPulled, &kRaised})
        mesh["primitives"][0]["targets"].push_back(
            {{"POSITION", writer.accessor(*offsets, "VEC3", 3)}});
    if (!weights.empty()) mesh["weights"] = weights;
    return writer;
}

/// The triangle with a clip that moves its weights.
GltfWriter waving_triangle(const std::vector<float>& times, const std::vector<float>& weights) {
    GltfWriter writer = pulled_triangle({});
    const int input = writer.accessor(times, "SCALAR", 1);
    const int output = writer.accessor(weights, "SCALAR", 1);
    Json& animation = writer.json["animations"][0];
    animation["channels"] = {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}};
    animation["samplers"] = {{{"input", input}, {"output", output}}};
    return writer;
}

class GltfMorphTest : public FileTest {
  protected:
    std::string morph_text(const GltfWriter& writer) {
        std::ofstream(folder / "a.glb", std::ios::binary) << writer.glb();
        assets_ = AssetStore();  // which keeps what it read of the file before
        return scene_of_file(folder / "a.glb", "a.glb", {}, assets_);
    }

    Scene morph_scene(const std::string& text) {
        return parse_scene(text, folder / "a.json", {folder}, [&](const Model& model, bool keeps) {
            return assets_.box_of_file(model, keeps);
        });
    }

    /// The largest distance of a vertex from where the weights put it.
    double distance_from(const Scene& scene, double first, double second) {
        const Mesh& mesh = *assets_.mesh_of(scene.models[0]);
        double worst = 0;
        for (size_t i = 0; i < 9; ++i) {
            const double expected = kCorners[i] + first * kPulled[i] + second * kRaised[i];
            worst = std::max(worst, std::abs(mesh.positions[i / 3][int(i % 3)] - expected));
        }
        return worst;
    }

    AssetStore assets_;
};

}  // namespace

TEST_F(GltfMorphTest, WeightsOfAMeshOrANodePullItsVertices) {
    const std::string text = morph_text(pulled_triangle({0.5F, 0.25F}));
    EXPECT_THAT(text, HasSubstr("\"morph\": {\"weights\": [0.5, 0.25]}"));
    const Scene scene = morph_scene(text);
    EXPECT_EQ(distance_from(scene, 0.5, 0.25), 0);
    EXPECT_EQ(assets_.box_of_file(scene.models[0], true).max.z, 4);  // 3, and 4 by a quarter

    GltfWriter nodes = pulled_triangle({});
    nodes.json["nodes"].push_back({{"mesh", 0}, {"weights", {1, -1}}});
    nodes.json["scenes"][0]["nodes"] = {1, 0};
    const std::string both = morph_text(nodes);
    EXPECT_THAT(both, HasSubstr("\"mesh 1\": {\"mesh\": \"a.glb\", \"part\": 1, \"surface\": "
                                "\"exact\", \"morph\": {\"weights\": [1, -1]}}"));
    EXPECT_THAT(both, HasSubstr("\"mesh 1 2\": {\"mesh\": \"a.glb\", \"part\": 1, \"surface\": "
                                "\"exact\"}"));
    EXPECT_THAT(morph_text(pulled_triangle({0, 0})), Not(HasSubstr("morph")));
}

TEST_F(GltfMorphTest, WeightsPullPointsToo) {
    GltfWriter writer = pulled_triangle({0.5F, 0.25F});
    writer.json["meshes"][0]["primitives"][0]["mode"] = 0;
    const Scene scene = morph_scene(morph_text(writer));
    EXPECT_EQ(assets_.mesh_of(scene.models[0])->triangles[1], glm::uvec3(1));
    EXPECT_EQ(distance_from(scene, 0.5, 0.25), 0);
}

TEST_F(GltfMorphTest, ANodesWeightsOfZeroHoldAgainstItsMeshsWeights) {
    GltfWriter writer = pulled_triangle({0.5F, 0.25F});
    writer.json["nodes"].push_back({{"mesh", 0}, {"weights", {0, 0}}});
    writer.json["nodes"].push_back({{"mesh", 0}, {"weights", {0, 0}}});
    writer.json["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = morph_scene(morph_text(writer));
    EXPECT_EQ(distance_from(scene, 0.5, 0.25), 0);
    const int unpulled = scene.objects[1].model;
    EXPECT_NE(scene.objects[0].model, unpulled);
    EXPECT_EQ(scene.objects[2].model, unpulled);  // nodes whose weights are all 0 share a model
    EXPECT_EQ(assets_.box_of_file(scene.models[size_t(unpulled)], true).max.z, 3);
}

TEST_F(GltfMorphTest, ClipsMoveWeightsAtAnyTime) {
    const Scene scene = morph_scene(morph_text(waving_triangle({0, 1, 3}, {0, 0, 1, 0.5F, 0, -1})));
    EXPECT_EQ(scene.animation.frames, 73);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> time(0, 3);
    for (int i = 0; i < 100; ++i) {
        const double t = time(random);
        const double first = t < 1 ? t : (3 - t) / 2;
        const double second = t < 1 ? t / 2 : 0.5 - 1.5 * (t - 1) / 2;
        EXPECT_LT(distance_from(scene_at(scene, 1 + 24 * t), first, second), 1e-6) << t;
    }
}

TEST_F(GltfMorphTest, WeightsThatDontFitAreRefused) {
    EXPECT_THAT(error_of([&] { morph_text(pulled_triangle({1})); }).what(),
                HasSubstr("meshes[0].weights: should be a list of 2 numbers"));
    EXPECT_THAT(error_of([&] {
                    morph_text(waving_triangle({0, 1}, {1, 2, 3, 4, 5, 6}));
                }).what(),
                HasSubstr("a clip has 3 weights for it, and its mesh has 2 targets"));
    GltfWriter shorter = pulled_triangle({1, 1});
    shorter.json["meshes"][0]["primitives"][0]["targets"][1]["POSITION"] =
        shorter.accessor(std::vector<float>{1, 2, 3}, "VEC3", 3);
    EXPECT_THAT(error_of([&] { morph_text(shorter); }).what(),
                HasSubstr("3 vertices, and 1 of POSITION"));
    std::string more = morph_text(pulled_triangle({0.5F, 0.25F}));
    more.replace(more.find("[0.5, 0.25]"), 11, "[0.5, 0.25, 1]");
    EXPECT_THAT(error_of([&] { morph_scene(more); }).what(),
                HasSubstr("has 3 weights, and its mesh has 2 targets"));
}

TEST_F(GltfMorphTest, MoreOffsetsThanTheLimitAreRefusedBeforeTheyAreRead) {
    GltfWriter writer = pulled_triangle({});
    Json& primitive = writer.json["meshes"][0]["primitives"][0];
    // Accessors without a buffer view are 0 and take no bytes in the file.
    const auto zeros = [&](uint64_t count) {
        writer.json["accessors"].push_back(
            {{"componentType", 5126}, {"count", count}, {"type", "VEC3"}});
        return writer.json["accessors"].size() - 1;
    };
    const uint64_t vertices = uint64_t{1} << 20, targets = kMaxTargetOffsets / vertices;
    const auto file_with = [&](uint64_t count) {
        primitive["attributes"]["POSITION"] = zeros(vertices);
        primitive["targets"] = Json::array();
        const auto offsets = zeros(1);  // fewer than vertices, which is refused when they are read
        for (uint64_t i = 0; i < count; ++i)
            primitive["targets"].push_back({{"POSITION", offsets}});
        return parsed_gltf(writer);
    };
    EXPECT_THAT(error_of([&] { gltf_targets(file_with(targets), 1); }).what(),
                HasSubstr("1048576 vertices, and 1 of POSITION"));
    EXPECT_THAT(error_of([&] { gltf_targets(file_with(targets + 1), 1); }).what(),
                HasSubstr("a mesh's targets move 1048576 vertices 65 times, and 67108864 offsets "
                          "are the most"));
}

}  // namespace voxelume
