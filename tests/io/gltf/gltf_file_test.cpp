// SPDX-License-Identifier: Apache-2.0
// Files of glTF that the test writes: the files that they need, the files next to them, and damage.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/io/gltf/gltf_nodes.hpp"
#include "tests/support/parsed_gltf.hpp"

namespace voxelume {
namespace {

using glm::vec3;
using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::json;

}  // namespace

TEST(GltfFile, OfRequiredExtensionsThatAreNotReadIsRefusedAndOthersAreNoted) {
    GltfWriter writer = triangle_gltf();
    writer.json["extensionsUsed"] = {"KHR_texture_basisu", "KHR_texture_transform"};
    EXPECT_THAT(gltf_mesh(parsed_gltf(writer), 0).notes,
                ElementsAre("its extension \"KHR_texture_basisu\" isn't shown"));
    writer.json["extensionsRequired"] = nlohmann::json::array({"KHR_texture_basisu"});
    EXPECT_EQ(refusal_of_gltf(writer),
              "a.gltf: needs the extension \"KHR_texture_basisu\", which isn't read; export it "
              "without");
}

TEST(GltfFile, OfWrongPartsIsRefusedWithTheirPlaces) {
    GltfWriter writer = triangle_gltf();
    const auto changed = [&](const std::string& pointer, const Json& value) {
        GltfWriter other = writer;
        other.json[Json::json_pointer(pointer)] = value;
        return refusal_of_gltf(other);
    };
    EXPECT_THAT(changed("/asset/version", "1.0"), HasSubstr("version \"1.0\" of glTF"));
    EXPECT_THAT(changed("/accessors/0/count", 4), HasSubstr("accessors[0]: 4 elements"));
    EXPECT_THAT(changed("/accessors/0/count", 1e15), HasSubstr("fewer than 2^31"));
    EXPECT_THAT(changed("/accessors/0/byteOffset", 1), HasSubstr("don't fit"));
    EXPECT_THAT(changed("/accessors/0/componentType", 5124), HasSubstr("no type of components"));
    EXPECT_THAT(changed("/accessors/0/type", "VEC2"), HasSubstr("isn't of the type"));
    EXPECT_THAT(changed("/accessors/0/bufferView", 9),
                HasSubstr("accessors[0].bufferView: is 9, and the file has 1 of these"));
    EXPECT_THAT(changed("/bufferViews/0/byteLength", 99), HasSubstr("bytes 0 to 99 of a buffer"));
    EXPECT_THAT(changed("/bufferViews/0/byteOffset", -1),
                HasSubstr("a whole number of at least 0"));
    EXPECT_THAT(changed("/bufferViews/0/byteStride", 4), HasSubstr("4 bytes apart"));
    EXPECT_THAT(changed("/meshes/0/primitives/0/attributes/POSITION", "x"), HasSubstr("POSITION"));
    EXPECT_THAT(changed("/meshes/0/primitives", 7), HasSubstr("should be a list"));
    EXPECT_THAT(changed("/nodes/0/mesh", 1), HasSubstr("nodes[0].mesh"));
    EXPECT_THAT(changed("/nodes/0/scale", {1, 2}), HasSubstr("a list of 3 numbers"));
    EXPECT_THAT(changed("/scene", 3), HasSubstr("scene"));
    const std::string deep(100, '[');
    EXPECT_EQ(error_of([&] { GltfFile(deep, "a.gltf"); }).kind(), ErrorKind::limit);
}

TEST(GltfFile, ThatIsDamagedIsAnInputErrorOrAMesh) {
    const std::string good = triangle_gltf().glb();
    EXPECT_EQ(gltf_mesh(GltfFile(good, "a.glb"), 0).positions.at(1), vec3(7, 0, 0));
    const auto kind = [](const std::string& bytes) {
        try {
            gltf_mesh(GltfFile(bytes, "a.glb"), 0);
        } catch (const Error& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with("a.glb")) << error.what();
            return error.kind();
        }
        return ErrorKind::input;
    };
    for (size_t size = 0; size < good.size(); ++size)
        ASSERT_EQ(kind(good.substr(0, size)), ErrorKind::input) << size;
    srand(11);
    for (int i = 0; i < 20000; ++i) {
        std::string damaged = good;
        for (int flips = 1 + rand() % 3; flips > 0; --flips)
            damaged[size_t(rand()) % damaged.size()] = char(rand());
        const ErrorKind found = kind(damaged);
        ASSERT_TRUE(found == ErrorKind::input || found == ErrorKind::limit) << i;
    }
}

using GltfCompanions = FileTest;

TEST_F(GltfCompanions, LieInItsFolder) {
    GltfWriter writer = triangle_gltf();
    put_bytes(folder / "my buffer.bin", writer.bytes);
    writer.json["buffers"] = {{{"byteLength", writer.bytes.size()}, {"uri", "my%20buffer.bin"}}};
    writer.bytes.clear();
    const auto mesh = [&] { return gltf_mesh(GltfFile(writer.gltf(), folder / "a.gltf"), 0); };
    EXPECT_EQ(mesh().positions.at(1), vec3(7, 0, 0));
    EXPECT_THAT(gltf_companions(writer.gltf(), folder / "a.gltf"),
                ElementsAre(std::filesystem::canonical(folder / "my buffer.bin")));
    EXPECT_EQ(gltf_companions(writer.glb(), folder / "a.glb").size(), 1u);
    writer.json["buffers"][0]["uri"] = "../../etc/passwd";
    EXPECT_THAT(error_of(mesh).what(), HasSubstr("buffers[0]: there is no file"));
    writer.json["buffers"][0]["uri"] = "data:text/plain,abc";
    EXPECT_THAT(error_of(mesh).what(), HasSubstr("its data URI isn't base64"));
    writer.json["buffers"][0]["uri"] = "data:;base64,AAAA";
    EXPECT_THAT(error_of(mesh).what(), HasSubstr("has 36 bytes, and 3 are there"));
}

}  // namespace voxelume
