// SPDX-License-Identifier: Apache-2.0
// glTF files that meshoptimizer's own encoders have compressed.
#include <meshoptimizer.h>

#include <cstring>

#include "runtime/io/gltf/gltf_accessor.hpp"
#include "runtime/io/mesh_codec/mesh_codec.hpp"
#include "tests/io/mesh/mesh_codec_sheet.hpp"

namespace voxelume {
namespace {

using glm::vec3;
using testing::HasSubstr;
using Json = nlohmann::json;

/// Adds a view of the buffer whose bytes are compressed by one of meshoptimizer's codecs.
int meshopt_view(GltfWriter& writer, const std::vector<uint8_t>& data, const char* mode,
                 size_t count, size_t stride, const char* filter = "NONE") {
    const int view = writer.view(data);
    Json& item = writer.json["bufferViews"].back();
    Json packed = {{"buffer", 0},         {"byteOffset", item["byteOffset"]},
                   {"count", count},      {"byteLength", data.size()},
                   {"mode", mode},        {"filter", filter},
                   {"byteStride", stride}};
    item["byteOffset"] = 0;
    item["byteLength"] = count * stride;
    item["extensions"]["EXT_meshopt_compression"] = std::move(packed);
    return view;
}

template <class Element>
std::vector<uint8_t> packed_vertices(const std::vector<Element>& elements) {
    const size_t count = elements.size();
    std::vector<uint8_t> data(meshopt_encodeVertexBufferBound(count, sizeof(Element)));
    data.resize(meshopt_encodeVertexBuffer(data.data(), data.size(), elements.data(), count,
                                           sizeof(Element)));
    return data;
}

std::vector<uint8_t> packed_triangles(const Sheet& sheet) {
    const size_t count = sheet.indices.size();
    std::vector<uint8_t> data(meshopt_encodeIndexBufferBound(count, sheet.positions.size()));
    data.resize(meshopt_encodeIndexBuffer(data.data(), data.size(), sheet.indices.data(), count));
    return data;
}

std::vector<uint8_t> packed_indices(const Sheet& sheet) {
    const size_t count = sheet.indices.size();
    std::vector<uint8_t> data(meshopt_encodeIndexSequenceBound(count, sheet.positions.size()));
    data.resize(meshopt_encodeIndexSequence(data.data(), data.size(), sheet.indices.data(), count));
    return data;
}

int accessor_of_view(GltfWriter& writer, int view, int component_type, size_t count,
                     const char* type) {
    writer.json["accessors"].push_back({{"bufferView", view},
                                        {"componentType", component_type},
                                        {"count", count},
                                        {"type", type}});
    return int(writer.json["accessors"].size()) - 1;
}

GltfWriter meshopt_gltf(const Sheet& sheet, bool is_sequence, int index_bytes) {
    GltfWriter writer;
    const size_t count = sheet.positions.size(), indices = sheet.indices.size();
    const int positions =
        meshopt_view(writer, packed_vertices(sheet.positions), "ATTRIBUTES", count, sizeof(vec3));
    const int order = is_sequence ? meshopt_view(writer, packed_indices(sheet), "INDICES", indices,
                                                 size_t(index_bytes))
                                  : meshopt_view(writer, packed_triangles(sheet), "TRIANGLES",
                                                 indices, size_t(index_bytes));
    const int position = accessor_of_view(writer, positions, 5126, count, "VEC3");
    const int index =
        accessor_of_view(writer, order, index_bytes == 2 ? 5123 : 5125, indices, "SCALAR");
    writer.json["meshes"] = {
        {{"primitives", {{{"attributes", {{"POSITION", position}}}, {"indices", index}}}}}};
    writer.json["nodes"] = {{{"mesh", 0}}};
    writer.json["extensionsRequired"] = nlohmann::json::array({"EXT_meshopt_compression"});
    return writer;
}

/// The values of a view that a filter has passed.
std::vector<float> filtered(const std::vector<uint8_t>& data, const char* filter, size_t count,
                            size_t stride, int component_type, const char* type, int components) {
    GltfWriter writer;
    const int view = meshopt_view(writer, data, "ATTRIBUTES", count, stride, filter);
    accessor_of_view(writer, view, component_type, count, type);
    writer.json["accessors"][0]["normalized"] = component_type != 5126;
    writer.json["thing"]["of"] = 0;
    const GltfFile file = parsed_gltf(writer);
    return gltf_values(file, file.root().at("thing"), "of", {components}).values;
}

/// Units of `size` numbers, by a fixed seed.
std::vector<float> random_units(size_t count, size_t size) {
    std::mt19937 random(7);
    std::normal_distribution<float> number;
    std::vector<float> values;
    for (size_t i = 0; i < count; ++i) {
        double square = 0;
        for (size_t c = 0; c < size; ++c) {
            values.push_back(number(random));
            square += double(values.back()) * double(values.back());
        }
        for (size_t c = 0; c < size; ++c) values[size * i + c] /= float(std::sqrt(square));
    }
    return values;
}

}  // namespace

TEST(Meshopt, MeshoptimizersVerticesAndIndicesComeBackAsTheyWere) {
    const Sheet sheet;
    for (const bool is_sequence : {false, true})
        for (const int index_bytes : {2, 4}) {
            const Mesh mesh =
                gltf_mesh(parsed_gltf(meshopt_gltf(sheet, is_sequence, index_bytes)), 0);
            EXPECT_EQ(mesh.positions, sheet.positions);
            expect_same_triangles(sheet, mesh);
        }
}

TEST(Meshopt, PartsOfAFileThatManyNameAreSentOnce) {
    const Sheet sheet;
    const std::vector<uint8_t> data = packed_vertices(sheet.positions);
    std::vector<uint8_t> file = data;  // the same twice, side by side
    file.insert(file.end(), data.begin(), data.end());
    CodecJob job;
    job.task.codec = MeshCodec::meshopt_vertices;
    job.task.count = sheet.positions.size();
    job.task.stride = sizeof(vec3);
    job.place = "here";
    std::vector<CodecJob> jobs(300, job);
    for (size_t i = 0; i < jobs.size(); ++i)
        jobs[i].input = std::span<const uint8_t>(file).subspan(i % 2 * data.size(), data.size());
    jobs[7].input = data;  // elsewhere
    for (const CodecArrays& arrays : decode_meshes("a.glb", jobs)) {
        ASSERT_EQ(arrays.at(0).size(), sheet.positions.size() * sizeof(vec3));
        EXPECT_EQ(std::memcmp(arrays[0].data(), sheet.positions.data(), arrays[0].size()), 0);
    }
}

TEST(Meshopt, TheNewNameOfTheExtensionIsRead) {
    GltfWriter writer = meshopt_gltf(Sheet(), false, 2);
    for (Json& view : writer.json["bufferViews"])
        view["extensions"] = {
            {"KHR_meshopt_compression", view["extensions"]["EXT_meshopt_compression"]}};
    writer.json["extensionsRequired"] = nlohmann::json::array({"KHR_meshopt_compression"});
    EXPECT_EQ(gltf_mesh(parsed_gltf(writer), 0).positions, Sheet().positions);
}

TEST(Meshopt, FallbackBuffersNeedNoBytes) {
    const GltfWriter writer = meshopt_gltf(Sheet(), false, 2);
    Json file = Json::parse(writer.gltf());
    const Json fallback = {{"EXT_meshopt_compression", {{"fallback", true}}}};
    file["buffers"].push_back({{"byteLength", 4096}, {"extensions", fallback}});
    for (Json& view : file["bufferViews"]) view["buffer"] = 1;
    EXPECT_EQ(gltf_mesh(GltfFile(file.dump(), "a.gltf"), 0).positions, Sheet().positions);
    file["bufferViews"][0].erase("extensions");
    EXPECT_THAT(error_of([&] { gltf_mesh(GltfFile(file.dump(), "a.gltf"), 0); }).what(),
                HasSubstr("bytes 0 to 420 of a buffer of 0"));
}

TEST(Meshopt, FiltersGiveBackUnitsRotationsAndFloats) {
    constexpr size_t kCount = 33;
    const auto expect_near = [](const std::vector<float>& found, const std::vector<float>& wanted,
                                float tolerance) {
        ASSERT_EQ(found.size(), wanted.size());
        for (size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], wanted[i], tolerance) << i;
    };
    std::vector<float> normals;  // the encoder takes four numbers each
    for (const auto units = random_units(kCount, 3); const float value : units) {
        normals.push_back(value);
        if (normals.size() % 4 == 3) normals.push_back(1);
    }
    std::vector<std::array<int8_t, 4>> bytes(kCount);
    meshopt_encodeFilterOct(bytes.data(), kCount, 4, 8, normals.data());
    expect_near(filtered(packed_vertices(bytes), "OCTAHEDRAL", kCount, 4, 5120, "VEC4", 4), normals,
                0.017f);
    std::vector<std::array<int16_t, 4>> shorts(kCount);
    meshopt_encodeFilterOct(shorts.data(), kCount, 8, 12, normals.data());
    expect_near(filtered(packed_vertices(shorts), "OCTAHEDRAL", kCount, 8, 5122, "VEC4", 4),
                normals, 0.0011f);
    std::vector<float> turns = random_units(kCount, 4);
    meshopt_encodeFilterQuat(shorts.data(), kCount, 8, 12, turns.data());
    std::vector<float> found =
        filtered(packed_vertices(shorts), "QUATERNION", kCount, 8, 5122, "VEC4", 4);
    for (size_t i = 0; i < kCount; ++i) {  // q and -q are one rotation
        double dot = 0;
        for (size_t c = 0; c < 4; ++c) dot += double(found[4 * i + c]) * double(turns[4 * i + c]);
        for (size_t c = 0; c < 4 && dot < 0; ++c) found[4 * i + c] *= -1;
    }
    expect_near(found, turns, 0.001f);
    const std::vector<float> floats = {0, 1.5f, -2, 1e6f, -3e-5f, 7.25f};
    std::vector<std::array<uint32_t, 2>> words(3);
    meshopt_encodeFilterExp(words.data(), 3, 8, 20, floats.data());
    const std::vector<float> values =
        filtered(packed_vertices(words), "EXPONENTIAL", 3, 8, 5126, "VEC2", 2);
    ASSERT_EQ(values.size(), 6u);
    for (size_t i = 0; i < 6; ++i) {  // the larger of two gives the exponent of both
        const float larger = std::max(std::abs(floats[i]), std::abs(floats[i ^ 1]));
        EXPECT_NEAR(values[i], floats[i], std::ldexp(larger, -19));
    }
}

TEST(Meshopt, MeshoptimizersPartsThatDontFitAreRefused) {
    const GltfWriter writer = meshopt_gltf(Sheet(), false, 2);
    const auto changed = [&](int view, const char* key, const Json& value) {
        GltfWriter other = writer;
        other.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"][key] = value;
        return refusal_of_gltf(other);
    };
    EXPECT_EQ(
        changed(0, "mode", "LINES"),
        "a.gltf: bufferViews[0].extensions.EXT_meshopt_compression: \"LINES\" is none that is "
        "read");
    EXPECT_THAT(changed(0, "filter", "COLOR"), HasSubstr("\"COLOR\" is none"));
    EXPECT_THAT(changed(0, "filter", "OCTAHEDRAL"), HasSubstr("elements of 12 bytes"));
    EXPECT_THAT(changed(1, "filter", "EXPONENTIAL"), HasSubstr("a filter of what aren't vertices"));
    EXPECT_THAT(changed(0, "byteStride", 10), HasSubstr("elements of 10 bytes"));
    EXPECT_THAT(changed(0, "byteStride", 0), HasSubstr("elements of 0 bytes"));
    EXPECT_THAT(changed(1, "byteStride", 8), HasSubstr("elements of 8 bytes"));
    EXPECT_THAT(changed(1, "count", 143), HasSubstr("143 indices of triangles"));
    EXPECT_THAT(changed(0, "count", 0), HasSubstr("0 elements"));
    EXPECT_THAT(changed(0, "count", 1e15), HasSubstr("fewer than 2^31"));
    EXPECT_THAT(changed(0, "count", 2e9), HasSubstr("compressed ones can hold; it is damaged"));
    EXPECT_THAT(changed(0, "count", 300), HasSubstr("can't be decoded; the file is damaged"));
    EXPECT_THAT(changed(0, "byteLength", 99999), HasSubstr("bytes 0 to 99999 of a buffer"));
    EXPECT_THAT(changed(0, "mode", "TRIANGLES"), HasSubstr("elements of 12 bytes"));
    EXPECT_THAT(changed(1, "mode", "INDICES"), HasSubstr("aren't those of its mode"));
    GltfWriter newer = writer;
    newer.bytes[0] = char(0xA1);
    EXPECT_THAT(refusal_of_gltf(newer), HasSubstr("version 1 of the codec"));
}

TEST(Meshopt, DamagedDataOfMeshoptimizerAreAnInputErrorOrAMesh) {
    for (const bool is_sequence : {false, true}) {
        const GltfWriter writer = meshopt_gltf(Sheet(), is_sequence, 4);
        expect_refusals_or_meshes(writer, 0, writer.bytes.size());
    }
}

}  // namespace voxelume
