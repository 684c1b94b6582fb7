// SPDX-License-Identifier: Apache-2.0
// glTF files whose meshes Draco's own encoder has compressed.
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>

#include "tests/io/mesh/mesh_codec_sheet.hpp"

namespace voxelume {
namespace {

using glm::vec3;
using testing::HasSubstr;
using Json = nlohmann::json;

template <class Number>
int add_attribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, draco::DataType number,
                  int components, const Number* values, size_t count) {
    draco::GeometryAttribute attribute;
    const auto stride = int64_t(sizeof(Number)) * components;
    attribute.Init(type, nullptr, uint8_t(components), number, false, stride, 0);
    const int id = mesh.AddAttribute(attribute, true, uint32_t(count));
    for (size_t i = 0; i < count; ++i)
        mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(uint32_t(i)),
                                              values + i * size_t(components));
    return int(mesh.attribute(id)->unique_id());
}

std::string draco_data(const Sheet& sheet, int method, int bits,
                       draco::DataType colors_as = draco::DT_UINT8, bool is_named = false) {
    draco::Mesh mesh;
    mesh.set_num_points(uint32_t(sheet.positions.size()));
    for (size_t i = 0; i < sheet.indices.size(); i += 3)
        mesh.AddFace({draco::PointIndex(sheet.indices[i]), draco::PointIndex(sheet.indices[i + 1]),
                      draco::PointIndex(sheet.indices[i + 2])});
    add_attribute(mesh, draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, 3,
                  &sheet.positions[0].x, sheet.positions.size());
    std::vector<uint8_t> colors;
    for (const vec3& p : sheet.positions)
        for (const float value : {p.x * 14, p.y * 25, 51.0f}) colors.push_back(uint8_t(value));
    add_attribute(mesh, draco::GeometryAttribute::COLOR, colors_as, 3, colors.data(),
                  sheet.positions.size());
    auto metadata = std::make_unique<draco::GeometryMetadata>();
    metadata->AddEntryString("name", "sheet");
    if (is_named) mesh.AddMetadata(std::move(metadata));
    draco::Encoder encoder;
    encoder.SetEncodingMethod(method);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, bits);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
    return {buffer.data(), buffer.size()};
}

/// A file with one primitive of Draco's data.
GltfWriter draco_gltf(const std::string& data, size_t vertices, size_t indices) {
    GltfWriter writer;
    const int view = writer.view(std::vector<char>(data.begin(), data.end()));
    writer.json["accessors"] = {
        {{"componentType", 5125}, {"count", indices}, {"type", "SCALAR"}},
        {{"componentType", 5126}, {"count", vertices}, {"type", "VEC3"}},
        {{"componentType", 5121}, {"count", vertices}, {"type", "VEC3"}, {"normalized", true}}};
    const Json attributes = {{"POSITION", 1}, {"COLOR_0", 2}};
    const Json draco = {{"bufferView", view}, {"attributes", {{"POSITION", 0}, {"COLOR_0", 1}}}};
    writer.json["meshes"] = {{{"primitives",
                               {{{"attributes", attributes},
                                 {"indices", 0},
                                 {"extensions", {{"KHR_draco_mesh_compression", draco}}}}}}}};
    writer.json["nodes"] = {{{"mesh", 0}}};
    writer.json["extensionsRequired"] = nlohmann::json::array({"KHR_draco_mesh_compression"});
    return writer;
}

}  // namespace

TEST(Draco, DracoMeshesAreWithinHalfAStepOfTheirVertices) {
    const Sheet sheet;
    for (const int method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING})
        for (const int bits : {10, 14}) {
            const std::string data = draco_data(sheet, method, bits);
            const Mesh mesh = gltf_mesh(parsed_gltf(draco_gltf(data, 35, 144)), 0);
            ASSERT_EQ(mesh.positions.size(), 35u);
            const double step = 18.0 / ((1 << bits) - 1);  // the longest side is that in x
            EXPECT_LE(distance_from(sheet, mesh), 0.5 * step + 2e-6) << method << ' ' << bits;
            expect_same_triangles(sheet, mesh);
            for (size_t i = 0; i < 35; ++i)
                EXPECT_NEAR(mesh.vertex_colors[i].x, mesh.positions[i].x * 14 / 255, 0.006);
        }
}

TEST(Draco, StripsAreTheTrianglesThatTheirDataHold) {
    const Sheet sheet;
    const std::string data = draco_data(sheet, draco::MESH_EDGEBREAKER_ENCODING, 14);
    GltfWriter writer = draco_gltf(data, 35, 50);  // 48 triangles
    writer.json["meshes"][0]["primitives"][0]["mode"] = 5;
    const Mesh mesh = gltf_mesh(parsed_gltf(writer), 0);
    expect_same_triangles(sheet, mesh);
    writer.json["accessors"][0]["count"] = 49;
    EXPECT_THAT(refusal_of_gltf(writer), HasSubstr("144 indices, and its accessor 141"));
}

TEST(Draco, DracoDataThatDontFitTheirAccessorsAreRefused) {
    const std::string data = draco_data(Sheet(), draco::MESH_EDGEBREAKER_ENCODING, 12);
    const GltfWriter writer = draco_gltf(data, 35, 144);
    const auto changed = [&](const std::string& pointer, const Json& value) {
        GltfWriter other = writer;
        other.json[Json::json_pointer(pointer)] = value;
        return refusal_of_gltf(other);
    };
    const std::string extension = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
    EXPECT_EQ(refusal_of_gltf(draco_gltf(data, 36, 144)),
              "a.gltf: meshes[0].primitives[0].extensions.KHR_draco_mesh_compression: its Draco "
              "data have 35 vertices and 144 indices, and its accessors 36 and 144");
    EXPECT_THAT(changed("/accessors/0/count", 141), HasSubstr("144 indices, and its accessor 141"));
    EXPECT_THAT(changed("/accessors/2/count", 34), HasSubstr("another count than POSITION"));
    EXPECT_THAT(changed("/accessors/2/type", "VEC4"),
                HasSubstr("3 components, and its accessor 4"));
    EXPECT_THAT(changed(extension + "/attributes/COLOR_0", 9), HasSubstr("have no attribute 9"));
    EXPECT_THAT(changed(extension + "/bufferView", 9), HasSubstr("the file has 1 of these"));
    EXPECT_THAT(changed("/meshes/0/primitives/0/mode", 6), HasSubstr("a mode other than 4"));
    EXPECT_THAT(refusal_of_gltf(draco_gltf(data, 2'000'000'000, 144)),
                HasSubstr("compressed ones can hold; it is damaged"));
    EXPECT_THAT(refusal_of_gltf(draco_gltf("DRACO", 35, 144)), HasSubstr("Draco data"));
    EXPECT_THAT(refusal_of_gltf(draco_gltf(data.substr(0, data.size() / 2), 35, 144)),
                HasSubstr("its Draco data can't be decoded"));
}

// Draco's library takes memory for the faces that are declared before it reads one, which the
// fuzzer found in data of an earlier version.
TEST(Draco, DataThatDeclareTooMuchOrAreOfAnotherVersionAreRefusedUnread) {
    std::string data = draco_data(Sheet(), draco::MESH_EDGEBREAKER_ENCODING, 12);
    ASSERT_EQ(data.substr(12, 2), "\x23\x30");  // 35 vertices and 48 faces
    std::string many = data;
    many.replace(13, 1, "\xf0\xff\xff\x7f");
    EXPECT_THAT(refusal_of_gltf(draco_gltf(many, 35, 144)),
                HasSubstr("its Draco data have 805306320 indices, and its accessor 144"));
    std::string sequential = draco_data(Sheet(), draco::MESH_SEQUENTIAL_ENCODING, 12);
    ASSERT_EQ(sequential.substr(11, 2), "\x30\x23");  // 48 faces and 35 points
    sequential.replace(11, 1, "\xf0\xff\xff\x7f");
    EXPECT_THAT(refusal_of_gltf(draco_gltf(sequential, 35, 144)),
                HasSubstr("its Draco data have 805306320 indices, and its accessor 144"));
    for (const int method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
        const std::string named = draco_data(Sheet(), method, 12, draco::DT_UINT8, true);
        ASSERT_NE(named.find("sheet"), std::string::npos);
        EXPECT_THAT(refusal_of_gltf(draco_gltf(named, 35, 141)), HasSubstr("have 144 indices"));
        EXPECT_EQ(gltf_mesh(parsed_gltf(draco_gltf(named, 35, 144)), 0).positions.size(), 35u);
    }
    EXPECT_THAT(refusal_of_gltf(draco_gltf(data.substr(0, 12), 35, 144)),
                HasSubstr("its Draco data end early"));
    data[5] = 1;
    EXPECT_THAT(refusal_of_gltf(draco_gltf(data, 35, 144)),
                HasSubstr("its Draco data have version 1.2, and glTF's have 2.2; compress the"));
}

// Draco's library loads any byte as a bool, which the fuzzer found.
TEST(Draco, TruthValuesAreRefused) {
    const std::string data =
        draco_data(Sheet(), draco::MESH_SEQUENTIAL_ENCODING, 12, draco::DT_BOOL);
    EXPECT_THAT(refusal_of_gltf(draco_gltf(data, 35, 144)),
                HasSubstr("attribute 1 of its Draco data has truth values, not numbers"));
}

TEST(Draco, DamagedDracoDataAreAnInputErrorOrAMesh) {
    for (const int method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
        const std::string data = draco_data(Sheet(), method, 12);
        expect_refusals_or_meshes(draco_gltf(data, 35, 144), 0, data.size());
    }
}

}  // namespace voxelume
