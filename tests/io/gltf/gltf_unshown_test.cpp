// SPDX-License-Identifier: Apache-2.0
// Properties of materials in glTF files that the shown surfaces lack.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/io/gltf/gltf_mesh.hpp"
#include "runtime/io/gltf/gltf_unshown.hpp"
#include "tests/support/writers/gltf_writer.hpp"

namespace voxelume {
namespace {

using UnshownJson = nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const UnshownJson kAnyTexture = {{"index", 0}};

/// A file of one triangle whose two parts have these materials.
std::string file_of(const UnshownJson& first, const UnshownJson& second) {
    GltfWriter writer = triangle_gltf();
    UnshownJson& primitives = writer.json["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    primitives[0]["material"] = 0;
    primitives[1]["material"] = 1;
    writer.json["materials"] = {first, second};
    writer.json["textures"] = UnshownJson::array({UnshownJson::object()});
    return writer.gltf();
}

std::vector<std::string> notes_on(const UnshownJson& extensions) {
    const UnshownJson material = {{"extensions", extensions}};
    return gltf_mesh(GltfFile(file_of(material, material), "a.gltf"), 0).notes;
}

TEST(GltfUnshown, IsNotedOnceForEachKindOfTextureOrFactor) {
    EXPECT_THAT(notes_on({{"KHR_materials_transmission",
                           {{"transmissionFactor", 1}, {"transmissionTexture", kAnyTexture}}}}),
                ElementsAre(HasSubstr("its transmission textures aren't shown")));
    EXPECT_THAT(notes_on({{"KHR_materials_specular", {{"specularTexture", kAnyTexture}}}}),
                ElementsAre(HasSubstr("its specular textures aren't shown")));
    for (const UnshownJson& colored : {UnshownJson{{"specularColorTexture", kAnyTexture}},
                                       UnshownJson{{"specularColorFactor", {1, 0.5, 1}}}})
        EXPECT_THAT(notes_on({{"KHR_materials_specular", colored}}),
                    ElementsAre(HasSubstr("its colours of KHR_materials_specular")));
    EXPECT_THAT(notes_on({{"KHR_materials_clearcoat",
                           {{"clearcoatFactor", 1},
                            {"clearcoatTexture", kAnyTexture},
                            {"clearcoatRoughnessTexture", kAnyTexture}}}}),
                ElementsAre(HasSubstr("how much they cover"), HasSubstr("how rough they are")));
}

TEST(GltfUnshown, IsNothingOfFactorsThatChangeNothing) {
    EXPECT_THAT(notes_on({{"KHR_materials_transmission", {{"transmissionTexture", kAnyTexture}}},
                          {"KHR_materials_clearcoat", {{"clearcoatTexture", kAnyTexture}}},
                          {"KHR_materials_specular", {{"specularColorFactor", {1, 1, 1}}}}}),
                IsEmpty());
    EXPECT_THAT(notes_on({{"KHR_materials_unlit", UnshownJson::object()},
                          {"KHR_materials_specular", {{"specularTexture", kAnyTexture}}}}),
                IsEmpty());
}

TEST(GltfUnshown, IsTheGlossTextureOfGlassAndCoats) {
    const UnshownJson gloss = {{"metallicRoughnessTexture", kAnyTexture}};
    const UnshownJson glass = {
        {"pbrMetallicRoughness", gloss},
        {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}}}};
    const UnshownJson coated = {
        {"pbrMetallicRoughness", gloss},
        {"extensions", {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}}}}};
    EXPECT_THAT(gltf_mesh(GltfFile(file_of(glass, coated), "a.gltf"), 0).notes,
                ElementsAre(HasSubstr("its metallic-roughness textures aren't shown on glass")));
}

TEST(GltfUnshown, IsToldOfInDescriptionsAloneWhereRaysOrShapesStandForIt) {
    const UnshownJson body = {
        {"normalTexture", kAnyTexture},
        {"extensions", {{"KHR_materials_volume", {{"thicknessTexture", kAnyTexture}}}}}};
    const UnshownJson coated = {
        {"extensions",
         {{"KHR_materials_clearcoat",
           {{"clearcoatFactor", 1}, {"clearcoatNormalTexture", kAnyTexture}}}}}};
    EXPECT_THAT(unshown_of_gltf(GltfFile(file_of(coated, {{"name", "b"}}), "a.gltf")),
                ElementsAre(HasSubstr("normal textures")));
    const GltfFile file(file_of(body, {{"name", "b"}}), "a.gltf");
    EXPECT_THAT(unshown_of_gltf(file),
                ElementsAre(HasSubstr("normal textures"), HasSubstr("thickness textures")));
    EXPECT_THAT(gltf_mesh(file, 0).notes, IsEmpty());
}

}  // namespace
}  // namespace voxelume
