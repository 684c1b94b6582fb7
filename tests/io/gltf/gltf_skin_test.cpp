// SPDX-License-Identifier: Apache-2.0
// Skins of glTF files: vertices at random times against blends of matrices written here.
#include <gmock/gmock.h>

#include <fstream>
#include <random>

#include "runtime/assets/asset_store.hpp"
#include "runtime/import/scene_of_file.hpp"
#include "runtime/io/gltf/gltf_skin.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/io/gltf/gltf_random_tree.hpp"
#include "tests/support/parsed_gltf.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

constexpr size_t kSkinVertices = 30;

/// A strip of triangles whose vertices follow joints of a random tree by two sets of weights: one
/// of floats and one of bytes.
struct SkinnedTree {
    explicit SkinnedTree(unsigned seed) : tree(seed), writer(tree.writer()), random(seed + 50) {
        for (size_t i = 0; i < 3 * kSkinVertices; ++i) positions.push_back(number(-2, 2));
        for (size_t joint = 0; joint < joints.size(); ++joint) {
            Matrix4 map = identity_rows();
            for (size_t row = 0; row < 3; ++row)
                for (double& v : map[row]) v += number(-0.3, 0.3);
            binds.push_back(map);
        }
        add_weights();
        write();
    }

    float number(double minimum, double maximum) {
        return float(std::uniform_real_distribution<double>(minimum, maximum)(random));
    }

    void add_weights() {
        for (size_t i = 0; i < kSkinVertices; ++i) {
            // Bytes that add up to 255 - 51 in one set, and 0.2 in the other.
            std::array<int, 3> parts = {int(random() % 100), int(random() % 100), 0};
            parts[2] = 204 - parts[0] - parts[1];
            for (int k = 0; k < 4; ++k) {
                byte_weights.push_back(k < 3 ? uint8_t(parts[size_t(k)]) : uint8_t(0));
                float_weights.push_back(k == 1 ? 0.2F : 0.0F);
                first_joints.push_back(uint8_t(random() % joints.size()));
                second_joints.push_back(uint16_t(random() % joints.size()));
            }
        }
    }

    void write() {
        std::vector<float> matrices;
        for (const Matrix4& map : binds)
            for (size_t column = 0; column < 4; ++column)
                for (size_t row = 0; row < 4; ++row) matrices.push_back(float(map[row][column]));
        const Json attributes = {{"POSITION", writer.accessor(positions, "VEC3", 3)},
                                 {"JOINTS_0", writer.accessor(first_joints, "VEC4", 4)},
                                 {"WEIGHTS_0", writer.accessor(byte_weights, "VEC4", 4, true)},
                                 {"JOINTS_1", writer.accessor(second_joints, "VEC4", 4)},
                                 {"WEIGHTS_1", writer.accessor(float_weights, "VEC4", 4)}};
        writer.json["meshes"].push_back(
            {{"primitives", {{{"attributes", attributes}, {"mode", 5}}}}});
        const int inverse = writer.accessor(matrices, "MAT4", 16);
        writer.json["skins"] = {{{"joints", joints}, {"inverseBindMatrices", inverse}}};
        // The node's own place says nothing.
        writer.json["nodes"].push_back({{"mesh", 1}, {"skin", 0}, {"translation", {100, 0, 0}}});
        writer.json["scenes"][0]["nodes"].push_back(RandomTree::kNodes);
    }

    /// The position of a vertex, by the format's equations.
    Numbers place(size_t vertex, const std::vector<Matrix4>& maps) const {
        Numbers sum(3);
        for (size_t k = 4 * vertex; k < 4 * vertex + 4; ++k) {
            add(maps[first_joints[k]], byte_weights[k] / 255.0, vertex, sum);
            add(maps[second_joints[k]], double(float_weights[k]), vertex, sum);
        }
        return sum;
    }
    void add(const Matrix4& map, double weight, size_t vertex, Numbers& sum) const {
        for (size_t row = 0; row < 3; ++row) {
            double value = map[row][3];
            for (size_t c = 0; c < 3; ++c) value += map[row][c] * positions[3 * vertex + c];
            sum[row] += weight * value;
        }
    }

    std::vector<Matrix4> maps_at(double time) const {
        std::vector<Matrix4> maps;
        for (size_t i = 0; i < joints.size(); ++i)
            maps.push_back(product_of_rows(tree.world_rows(joints[i], time), binds[i]));
        return maps;
    }

    /// The largest distance of a mesh's coordinate from where it should be, as a share of it or
    /// of 1.
    double distance_from(const Mesh& mesh, double time) const {
        const std::vector<Matrix4> maps = maps_at(time);
        double worst = 0;
        for (size_t i = 0; i < kSkinVertices; ++i) {
            const Numbers expected = place(i, maps);
            for (size_t c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(double(mesh.positions[i][int(c)]) - expected[c]) /
                                            std::max(1.0, std::abs(expected[c])));
        }
        return worst;
    }

    RandomTree tree;
    GltfWriter writer;
    std::mt19937 random;
    std::vector<int> joints = {3, 7, 11, 2, 23};
    std::vector<Matrix4> binds;
    std::vector<float> positions, float_weights;
    std::vector<uint8_t> first_joints, byte_weights;
    std::vector<uint16_t> second_joints;
};

class GltfSkinTest : public FileTest {
  protected:
    std::string skin_text(const GltfWriter& writer) {
        std::ofstream(folder / "a.glb", std::ios::binary) << writer.glb();
        assets_ = AssetStore();
        return scene_of_file(folder / "a.glb", "a.glb", {}, assets_);
    }
    Scene skin_scene(const std::string& text) {
        return parse_scene(text, folder / "a.json", {folder}, [&](const Model& model, bool keeps) {
            return assets_.box_of_file(model, keeps);
        });
    }
    static const Model& skinned(const Scene& scene) {
        for (const Model& model : scene.models)
            if (model.morph && model.morph->skin > 0) return model;
        throw std::runtime_error("no model has a skin");
    }

    AssetStore assets_;
};

std::string skin_refusal(const GltfWriter& writer) {
    return error_of([&] {
               const GltfFile file = parsed_gltf(writer);
               GltfSkin(file, 2, 0, "");
           })
        .what();
}

}  // namespace

TEST_F(GltfSkinTest, VerticesAreBlendsOfTheirJointsAtAnyTime) {
    for (const unsigned seed : {1U, 2U}) {
        const SkinnedTree tree(seed);
        const std::string text = skin_text(tree.writer);
        EXPECT_THAT(text, HasSubstr(R"("morph": {"skin": 1, "clip": "dance"})"));
        const Scene scene = skin_scene(text);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> time(0, 4);
        double worst = 0;
        for (int i = 0; i < 40; ++i) {
            const double t = time(random);
            const Scene now = scene_at(scene, 1 + t * scene.animation.fps);
            const Model& model = skinned(now);
            const Mesh mesh = *assets_.mesh_of(model);
            ASSERT_EQ(mesh.positions.size(), kSkinVertices);
            worst = std::max(worst, tree.distance_from(mesh, t));
            const Bounds box = assets_.box_of_file(model, true);
            for (const glm::vec3& p : mesh.positions)
                for (int axis = 0; axis < 3; ++axis) {
                    EXPECT_GE(p[axis], box.min[axis] - 1e-5);
                    EXPECT_LE(p[axis], box.max[axis] + 1e-5);
                }
        }
        EXPECT_LT(worst, 1e-6) << "seed " << seed;
    }
}

TEST_F(GltfSkinTest, WithoutAClipJointsStandWhereTheirNodesDo) {
    SkinnedTree tree(3);
    tree.writer.json.erase("animations");
    Json& nodes = tree.writer.json["nodes"];
    for (int i = 0; i < RandomTree::kNodes; ++i) nodes[size_t(i)].erase("mesh");
    const std::string text = skin_text(tree.writer);
    EXPECT_THAT(text, HasSubstr(R"("morph": {"skin": 1})"));
    const Scene scene = skin_scene(text);
    EXPECT_EQ(scene.animation.frames, 1);
    const Mesh shown = *assets_.mesh_of(skinned(scene));
    const Mesh whole = gltf_mesh(parsed_gltf(tree.writer), 0);
    EXPECT_EQ(shown.positions, whole.positions);
    EXPECT_NE(gltf_mesh(parsed_gltf(tree.writer), 2).positions, whole.positions);
}

TEST_F(GltfSkinTest, WeightsThatDontAddUpToOneAreMadeTo) {
    SkinnedTree tree(4);
    const GltfFile whole = parsed_gltf(tree.writer);
    // The second set holds a fifth of each vertex's weight.
    tree.writer.json["meshes"][1]["primitives"][0]["attributes"].erase("JOINTS_1");
    const GltfFile less = parsed_gltf(tree.writer);
    Mesh mesh = gltf_mesh(less, 2);
    GltfSkin(less, 2, 0, "dance").move(mesh, 0, 0.75);
    const std::vector<Matrix4> maps = tree.maps_at(0.75);
    for (size_t i = 0; i < kSkinVertices; ++i) {
        Numbers expected(3);
        for (size_t k = 4 * i; k < 4 * i + 4; ++k)
            tree.add(maps[tree.first_joints[k]], tree.byte_weights[k] / 204.0, i, expected);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(mesh.positions[i][c], expected[size_t(c)],
                        1e-6 * std::max(1.0, std::abs(expected[size_t(c)])));
    }
}

TEST_F(GltfSkinTest, PartsThatDontGoTogetherAreRefused) {
    const SkinnedTree tree(5);
    const auto changed = [&](const std::string& pointer, const Json& value) {
        GltfWriter other = tree.writer;
        other.json[Json::json_pointer(pointer)] = value;
        return skin_refusal(other);
    };
    EXPECT_THAT(changed("/skins/0/joints", {3, 7, 11, 2}), HasSubstr("the skin has 4"));
    EXPECT_THAT(changed("/skins/0/joints", {3, 7, 11, 2, 99}),
                HasSubstr("is the number of no node"));
    EXPECT_THAT(changed("/skins/0/joints", {3, 7, 11, 2, 1, 3}),
                HasSubstr("is a joint of this skin already"));
    EXPECT_THAT(changed("/skins/0/joints", {3, 7, 11, 2, 23, 1}),
                HasSubstr("6 joints and 5 matrices"));
    EXPECT_THAT(changed("/meshes/1/primitives/0/attributes/WEIGHTS_0", 0),
                HasSubstr("isn't of the type"));
    EXPECT_THAT(changed("/skins", Json::array()),
                HasSubstr("nodes[24].skin: is 0, and the file has 0 of these"));
    GltfWriter shorter = tree.writer;
    const Json& attributes = shorter.json["meshes"][1]["primitives"][0]["attributes"];
    shorter.json["accessors"][attributes["JOINTS_1"].get<size_t>()]["count"] = kSkinVertices - 1;
    EXPECT_THAT(skin_refusal(shorter), HasSubstr("30 vertices, 29 of JOINTS_1"));
    EXPECT_THAT(error_of([&] { GltfSkin(parsed_gltf(tree.writer), 2, 0, "danse"); }).what(),
                HasSubstr("has no clip \"danse\"; did you mean \"dance\"?"));
}

}  // namespace voxelume
