// SPDX-License-Identifier: Apache-2.0
// glTF files that the test writes: numbers of all types, nodes, primitives, materials, damage.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/io/gltf/gltf_accessor.hpp"
#include "runtime/io/gltf/gltf_nodes.hpp"
#include "tests/support/parsed_gltf.hpp"

namespace voxelume {
namespace {

using glm::uvec3;
using glm::vec2;
using glm::vec3;
using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::json;

template <class T>
std::vector<float> read(const std::vector<T>& values, bool is_normalized) {
    GltfWriter writer;
    writer.accessor(values, "SCALAR", 1, is_normalized);
    writer.json["thing"]["of"] = 0;
    const GltfFile file = parsed_gltf(writer);
    return gltf_values(file, file.root().at("thing"), "of", {1}).values;
}

/// The positions of an instance's origin, and of the ends of its axes.
std::vector<vec3> frame_of(const GltfNode& node) {
    std::vector<vec3> points;
    for (const glm::dvec4 p : {glm::dvec4(0, 0, 0, 1), {1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}})
        points.emplace_back(node.world_from_node * p);
    return points;
}

testing::Matcher<vec3> near(const vec3& expected) {
    return testing::Truly([=](const vec3& v) { return glm::length(v - expected) < 1e-6f; });
}

}  // namespace

TEST(GltfNumbers, AreThoseOfTheirTypes) {
    EXPECT_THAT(read<float>({1.5f, -2}, false), ElementsAre(1.5f, -2));
    EXPECT_THAT(read<uint8_t>({0, 51, 255}, true), ElementsAre(0, 0.2f, 1));
    EXPECT_THAT(read<uint8_t>({0, 51, 255}, false), ElementsAre(0, 51, 255));
    EXPECT_THAT(read<int8_t>({-128, -127, 127}, true), ElementsAre(-1, -1, 1));
    EXPECT_THAT(read<int16_t>({-32768, 16384}, true), ElementsAre(-1, 16384 / 32767.0f));
    EXPECT_THAT(read<uint16_t>({65535, 13107}, true), ElementsAre(1, 0.2f));
    EXPECT_THAT(read<int16_t>({-300, 7}, false), ElementsAre(-300, 7));
    EXPECT_THAT(read<uint32_t>({70000, 7}, false), ElementsAre(70000, 7));
}

TEST(GltfNumbers, MayLieApartOrBeginLater) {
    GltfWriter writer;
    writer.view(std::vector<int16_t>{9, 1, 2, 3, 9, 9, 9, 4, 5, 6}, 12);
    writer.json["accessors"] = {{{"bufferView", 0},
                                 {"byteOffset", 2},
                                 {"componentType", 5122},
                                 {"count", 2},
                                 {"type", "VEC3"}}};
    writer.json["thing"]["of"] = 0;
    const GltfFile file = parsed_gltf(writer);
    EXPECT_THAT(gltf_values(file, file.root().at("thing"), "of", {3}).values,
                ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(GltfNumbers, MayBeSparseWithOrWithoutAnArrayBelow) {
    GltfWriter writer;
    writer.accessor(std::vector<float>{1, 2, 3, 4}, "SCALAR", 1);
    const Json sparse = {
        {"count", 2},
        {"indices",
         {{"bufferView", writer.view(std::vector<uint8_t>{1, 3})}, {"componentType", 5121}}},
        {"values", {{"bufferView", writer.view(std::vector<float>{20, 40})}}}};
    writer.json["accessors"][0]["sparse"] = sparse;
    writer.json["accessors"].push_back(
        {{"componentType", 5126}, {"count", 4}, {"type", "SCALAR"}, {"sparse", sparse}});
    writer.json["thing"] = {{"of", 0}, {"bare", 1}};
    const GltfFile file = parsed_gltf(writer);
    const GltfValue thing = file.root().at("thing");
    EXPECT_THAT(gltf_values(file, thing, "of", {1}).values, ElementsAre(1, 20, 3, 40));
    EXPECT_THAT(gltf_values(file, thing, "bare", {1}).values, ElementsAre(0, 20, 0, 40));
    writer.json["accessors"][0]["count"] = 3;
    EXPECT_THAT(error_of([&] {
                    const GltfFile damaged = parsed_gltf(writer);
                    gltf_values(damaged, damaged.root().at("thing"), "of", {1});
                }).what(),
                HasSubstr("accessors[0].sparse.indices: names element 3 of 3"));
}

TEST(GltfNodes, HaveTheirWayThroughAllParents) {
    GltfWriter writer = triangle_gltf();
    writer.json["nodes"] = {
        {{"children", {1, 2}}, {"translation", {10, 20, 30}}, {"scale", {2, 2, 2}}},
        {{"mesh", 0},
         {"name", "turned"},
         {"rotation", {0, 0.7071067811865476, 0, 0.7071067811865476}}},
        {{"mesh", 0}, {"matrix", {0, 1, 0, 0, -3, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}},
        {{"name", "shows nothing"}}};
    const std::vector<GltfNode> nodes = gltf_nodes(parsed_gltf(writer));
    ASSERT_EQ(nodes.size(), 2u);
    EXPECT_EQ(nodes[0].name, "turned");
    EXPECT_THAT(frame_of(nodes[0]), ElementsAre(near({10, 20, 30}), near({10, 20, 28}),
                                                near({10, 22, 30}), near({12, 20, 30})));
    EXPECT_THAT(frame_of(nodes[1]), ElementsAre(near({20, 32, 44}), near({20, 34, 44}),
                                                near({14, 32, 44}), near({20, 32, 46})));
}

TEST(GltfNodes, ThatAreInstancesAreOneEach) {
    GltfWriter writer = triangle_gltf();
    const int places = writer.accessor(std::vector<float>{1, 2, 3, 4, 5, 6}, "VEC3", 3);
    const int turns =
        writer.accessor(std::vector<int16_t>{0, 0, 32767, 0, 0, 0, 0, 32767}, "VEC4", 4, true);
    writer.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", places}, {"ROTATION", turns}};
    writer.json["nodes"][0]["scale"] = {1, 1, 2};
    const std::vector<GltfNode> nodes = gltf_nodes(parsed_gltf(writer));
    ASSERT_EQ(nodes.size(), 2u);
    EXPECT_THAT(frame_of(nodes[0]),
                ElementsAre(near({1, 2, 6}), near({0, 2, 6}), near({1, 1, 6}), near({1, 2, 8})));
    EXPECT_THAT(frame_of(nodes[1])[0], near({4, 5, 12}));
}

TEST(GltfNodes, ThatAreTheirOwnAncestorsAreRefused) {
    GltfWriter writer = triangle_gltf();
    writer.json["nodes"][0]["children"] = {0};
    EXPECT_THAT(refusal_of_gltf(writer), HasSubstr("a.gltf: nodes[0]: is a child of two nodes"));
    writer.json["nodes"][0]["children"] = {7};
    EXPECT_THAT(refusal_of_gltf(writer),
                HasSubstr("nodes[0].children[0]: is the number of no node"));
}

TEST(GltfMesh, StripsAndFansKeepTheirSides) {
    const auto triangles = [](int mode, const std::vector<uint8_t>& order) {
        GltfWriter writer;
        const int positions = writer.accessor(
            std::vector<float>{0, 0, 0, 7, 0, 0, 0, 5, 3, 7, 5, 3, 9, 9, 9}, "VEC3", 3);
        writer.json["meshes"] = {
            {{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"mode", mode}}}}}};
        if (!order.empty())
            writer.json["meshes"][0]["primitives"][0]["indices"] =
                writer.accessor(order, "SCALAR", 1);
        return gltf_mesh(parsed_gltf(writer), 1).triangles;
    };
    EXPECT_THAT(triangles(4, {0, 1, 2, 2, 1, 3}), ElementsAre(uvec3(0, 1, 2), uvec3(2, 1, 3)));
    EXPECT_THAT(triangles(5, {}), ElementsAre(uvec3(0, 1, 2), uvec3(1, 3, 2), uvec3(2, 3, 4)));
    EXPECT_THAT(triangles(6, {4, 0, 1, 2}), ElementsAre(uvec3(0, 1, 4), uvec3(1, 2, 4)));
}

TEST(GltfMesh, WholeScenesHaveMeshesInTheirPlacesAndMirrorsTurnedRound) {
    GltfWriter writer = triangle_gltf();
    writer.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        writer.accessor(std::vector<int8_t>{0, 0, 127, 0, 0, 127, 0, 127, 0}, "VEC3", 3, true);
    writer.json["nodes"].push_back(
        {{"mesh", 0}, {"scale", {-2, 1, 4}}, {"translation", {1, 0, 0}}});
    writer.json["scenes"][0]["nodes"] = {0, 1};
    const Mesh mesh = gltf_mesh(parsed_gltf(writer), 0);
    EXPECT_THAT(mesh.positions, ElementsAre(vec3(0), vec3(7, 0, 0), vec3(0, 5, 3), vec3(1, 0, 0),
                                            vec3(-13, 0, 0), vec3(1, 5, 12)));
    EXPECT_THAT(mesh.triangles, ElementsAre(uvec3(0, 1, 2), uvec3(3, 5, 4)));
    EXPECT_EQ(glm::normalize(mesh.normals.at(4)), vec3(0, 0, 1));
    EXPECT_EQ(gltf_mesh(parsed_gltf(writer), 1).triangles.size(), 1u);
    EXPECT_THAT(error_of([&] { gltf_mesh(parsed_gltf(writer), 2); }).what(),
                HasSubstr("has 1 meshes, and none of number 2"));
}

TEST(GltfMesh, ThatNodesRepeatFarBeyondTheirFilesBytesIsRefused) {
    GltfWriter writer = triangle_gltf();
    Json& primitives = writer.json["meshes"][0]["primitives"];
    primitives = Json(400, Json(primitives[0]));
    const auto show = [&](size_t times) {
        writer.json["nodes"] = Json(times, Json{{"mesh", 0}});
        writer.json["scenes"][0]["nodes"] = Json::array();
        for (size_t i = 0; i < times; ++i) writer.json["scenes"][0]["nodes"].push_back(i);
    };
    show(40);
    EXPECT_EQ(gltf_mesh(parsed_gltf(writer), 0).triangles.size(), 16000u);
    show(400);
    EXPECT_THAT(refusal_of_gltf(writer),
                HasSubstr("its nodes show more vertices and indices than"));
}

TEST(GltfNumbers, WithoutBytesAreFewEnough) {
    GltfWriter writer = triangle_gltf();
    writer.json["accessors"] = {
        {{"componentType", 5126}, {"count", (1 << 24) + 1}, {"type", "VEC3"}}};
    EXPECT_THAT(refusal_of_gltf(writer),
                HasSubstr("more than 2^24 elements without a buffer view"));
}

TEST(GltfMesh, PrimitivesHaveTheirMaterialsColorsAndPlaces) {
    GltfWriter writer = triangle_gltf();
    Json& primitives = writer.json["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    primitives.push_back(primitives[0]);
    primitives[1]["material"] = 1;
    primitives[1]["attributes"]["COLOR_0"] = writer.accessor(
        std::vector<uint8_t>{255, 51, 0, 255, 255, 51, 0, 0, 255, 51, 0, 7}, "VEC4", 4, true);
    primitives[1]["attributes"]["TEXCOORD_1"] =
        writer.accessor(std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2", 2);
    primitives[2]["material"] = 2;
    writer.json["materials"] = {
        {{"name", "a"}},
        {{"name", "a"},
         {"pbrMetallicRoughness",
          {{"baseColorTexture",
            {{"index", 0},
             {"texCoord", 0},
             {"extensions",
              {{"KHR_texture_transform",
                {{"texCoord", 1}, {"offset", {0.5, 0.25}}, {"scale", {2, 3}}}}}}}}}}},
        Json::object()};
    writer.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    writer.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
    // A PNG of one pixel of sRGB 255, 51, 0.
    writer.json["images"] = {
        {{"uri",
          "data:image/png;base64,"
          "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4b8wAAANnATNXmcmTAAAA"
          "AElFTkSuQmCC"}}};
    const Mesh mesh = gltf_mesh(parsed_gltf(writer), 0);
    EXPECT_THAT(mesh.group_names, ElementsAre("", "a 1", "material 2"));
    EXPECT_THAT(mesh.triangle_group, ElementsAre(0, 1, 2));
    EXPECT_EQ(mesh.vertex_colors.at(2), vec3(1));
    EXPECT_EQ(mesh.vertex_colors.at(4), vec3(1, 0.2f, 0)) << "colours of glTF are linear";
    EXPECT_EQ(mesh.vertex_colors.at(8), vec3(1));
    ASSERT_EQ(mesh.textures.size(), 1u) << testing::PrintToString(mesh.notes);
    EXPECT_THAT(mesh.group_textures, ElementsAre(kNoTexture, 0u, kNoTexture));
    EXPECT_EQ(mesh.textures[0].wrap_u, TextureWrap::clamp);
    EXPECT_EQ(mesh.textures[0].wrap_v, TextureWrap::mirror);
    EXPECT_EQ(mesh.uvs.at(3), vec2(0.5f, 0.25f));
    EXPECT_EQ(mesh.uvs.at(4), vec2(2.5f, 0.25f));
    EXPECT_EQ(mesh.uvs.at(5), vec2(0.5f, 3.25f));
}

TEST(GltfMesh, NormalsThatAreNoNumbersSayNothingAndPositionsAreRefused) {
    GltfWriter writer = triangle_gltf();
    writer.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        writer.accessor(std::vector<float>{NAN, 0, 0, 0, 0, INFINITY, 0, 2, 0}, "VEC3", 3);
    EXPECT_THAT(gltf_mesh(parsed_gltf(writer), 0).normals,
                ElementsAre(vec3(0), vec3(0), vec3(0, 2, 0)));
    const int positions =
        writer.accessor(std::vector<float>{0, 0, 0, NAN, 0, 0, 0, 5, 3}, "VEC3", 3);
    writer.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = positions;
    EXPECT_THAT(refusal_of_gltf(writer), HasSubstr("a vertex isn't finite"));
}

TEST(GltfMesh, LeavesOutPointsAlongsideTrianglesWithANote) {
    GltfWriter writer = triangle_gltf();
    Json& primitives = writer.json["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    primitives[1]["mode"] = 0;
    EXPECT_THAT(gltf_mesh(parsed_gltf(writer), 0).notes, ElementsAre(HasSubstr("points or lines")));
    primitives = Json::array();
    EXPECT_THAT(refusal_of_gltf(writer), HasSubstr("has no triangles, points or lines to show"));
}

TEST(GltfMesh, OfPointsAndLinesAloneHasTrianglesWithoutArea) {
    GltfWriter writer = triangle_gltf();
    Json& mode = writer.json["meshes"][0]["primitives"][0]["mode"];
    const auto triangles = [&](int number) {
        mode = number;
        return gltf_mesh(parsed_gltf(writer), 0).triangles;
    };
    EXPECT_THAT(triangles(0), ElementsAre(uvec3(0, 0, 0), uvec3(1, 1, 1), uvec3(2, 2, 2)));
    EXPECT_THAT(triangles(1), ElementsAre(uvec3(0, 1, 1)));
    EXPECT_THAT(triangles(2), ElementsAre(uvec3(0, 1, 1), uvec3(1, 2, 2), uvec3(2, 0, 0)));
    EXPECT_THAT(triangles(3), ElementsAre(uvec3(0, 1, 1), uvec3(1, 2, 2)));
}

}  // namespace voxelume
