// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/gltf/gltf_compression.hpp"

#include <fmt/format.h>

#include <optional>
#include <set>

#include "runtime/base/text.hpp"
#include "runtime/io/gltf/gltf_accessor.hpp"
#include "runtime/io/gltf/gltf_file.hpp"
#include "runtime/io/mesh_codec/mesh_codec.hpp"

namespace voxelume {
namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";
constexpr std::array kMeshopt = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

std::optional<GltfValue> meshopt_of(const GltfValue& value) {
    for (const char* const name : kMeshopt)
        if (value.has_extension(name)) return value.extension(name);
    return {};
}

/// The index of a word in a list.
template <class Number, size_t Size>
Number number_of(const GltfValue& from, const char* key, const char* otherwise,
                 const std::array<const char*, Size>& words) {
    const std::string word = from.text(key, otherwise);
    const auto found = std::ranges::find(words, word);
    if (found == words.end()) from.fail(fmt::format("{} is none that is read", quote(word)));
    return static_cast<Number>(found - words.begin());
}

/// The strides that the codecs and filters take.
void check_stride(const GltfValue& from, const CodecTask& task) {
    using Filter = MeshoptFilter;
    const uint64_t stride = task.stride;
    bool is_right = stride == 2 || stride == 4;
    if (task.codec == MeshCodec::meshopt_vertices)
        is_right = stride > 0 && stride <= 256 && stride % 4 == 0;
    if (task.filter == Filter::octahedral) is_right = stride == 4 || stride == 8;
    if (task.filter == Filter::quaternion) is_right = stride == 8;
    if (!is_right) from.fail(fmt::format("elements of {} bytes, which its mode hasn't", stride));
    if (task.filter != Filter::none && task.codec != MeshCodec::meshopt_vertices)
        from.fail("a filter of what aren't vertices");
    if (task.codec == MeshCodec::meshopt_triangles && task.count % 3 != 0)
        from.fail(fmt::format("{} indices of triangles", task.count));
}

CodecJob meshopt_job(const GltfFile& file, const GltfValue& view, const GltfValue& from) {
    CodecJob job;
    job.place = from.place();
    job.input = file.bytes_in_buffer(from);
    job.task.codec = static_cast<MeshCodec>(
        1 + number_of<int>(from, "mode", "", std::array{"ATTRIBUTES", "TRIANGLES", "INDICES"}));
    job.task.filter = number_of<MeshoptFilter>(
        from, "filter", "NONE", std::array{"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"});
    job.task.count = from.count("count", 0);
    job.task.stride = from.count("byteStride", 0);
    if (job.task.count == 0 || job.task.count >= kMaxGltfElements)
        from.fail(
            fmt::format("{} elements; it has at least 1 and fewer than 2^31", job.task.count));
    check_stride(from, job.task);
    if (view.count("byteStride", job.task.stride) != job.task.stride)
        view.fail("its byteStride isn't that of its compressed data");
    return job;
}

/// A primitive whose accessors Draco's data fill.
struct DracoPrimitive {
    CodecJob job;
    std::vector<size_t> accessors;  ///< accessors of the indices, then of the attributes
};

constexpr std::array kTypes = {"SCALAR", "VEC2", "VEC3", "VEC4"};

DracoPrimitive draco_primitive(const GltfFile& file, const GltfValue& primitive) {
    const GltfValue from = primitive.extension(kDraco), attributes = primitive.at("attributes");
    const size_t accessors = file.root().size("accessors");
    const uint64_t mode = primitive.count("mode", 4);
    if (mode != 4 && mode != 5)
        primitive.fail("a mode other than 4, triangles, or 5, strips, which Draco's data have");
    const int indices = primitive.index("indices", accessors);
    if (indices < 0 || !attributes.has("POSITION")) primitive.fail("has no indices or no POSITION");
    DracoPrimitive found{{{}, file.view(from, "bufferView"), from.place()}, {size_t(indices)}};
    CodecTask& task = found.job.task;
    task.indices = count_gltf_values(file, primitive, "indices");
    // A strip has a triangle for each index from the third on.
    if (mode == 5) task.indices = task.indices < 3 ? 0 : 3 * (task.indices - 2);
    task.count = count_gltf_values(file, attributes, "POSITION");
    for (const auto& [key, id] : from.at("attributes").json().items()) {
        const int number = attributes.index(key.c_str(), accessors);
        if (number < 0) continue;  // no accessor that is read
        if (task.attribute_count == kMaxDracoAttributes)
            from.fail(fmt::format("more than {} attributes", kMaxDracoAttributes));
        const GltfValue accessor = file.root().item("accessors", size_t(number));
        if (count_gltf_values(file, attributes, key.c_str()) != task.count)
            accessor.fail(fmt::format("another count than POSITION, which has {}", task.count));
        DracoAttribute& attribute = task.attributes[task.attribute_count++];
        attribute.id = uint32_t(from.at("attributes").count(key.c_str(), 0));
        attribute.component_type = uint32_t(gltf_component_type(accessor));
        attribute.components = uint32_t(1 + number_of<int>(accessor, "type", "", kTypes));
        found.accessors.push_back(size_t(number));
    }
    return found;
}

}  // namespace

bool is_gltf_fallback(const GltfValue& buffer) {
    const auto extension = meshopt_of(buffer);
    return extension && extension->boolean("fallback", false);
}

void decode_gltf_views(const GltfFile& file, GltfDecoded& decoded) {
    std::vector<CodecJob> jobs;
    std::vector<size_t> numbers;
    const std::vector<GltfValue> views = file.root().items("bufferViews");
    for (size_t i = 0; i < views.size(); ++i)
        if (const auto from = meshopt_of(views[i])) {
            jobs.push_back(meshopt_job(file, views[i], *from));
            numbers.push_back(i);
        }
    std::vector<CodecArrays> results = decode_meshes(file.path(), jobs);
    for (size_t i = 0; i < results.size(); ++i)
        decoded.views[numbers[i]] = std::move(results[i][0]);
}

void decode_gltf_primitives(const GltfFile& file, GltfDecoded& decoded) {
    std::vector<CodecJob> jobs;
    std::vector<std::vector<size_t>> accessors;
    std::set<std::vector<size_t>> known;
    for (const GltfValue& mesh : file.root().items("meshes"))
        for (const GltfValue& primitive : mesh.items("primitives")) {
            if (!primitive.has_extension(kDraco)) continue;
            DracoPrimitive found = draco_primitive(file, primitive);
            if (!known.insert(found.accessors).second) continue;
            jobs.push_back(std::move(found.job));
            accessors.push_back(std::move(found.accessors));
        }
    std::vector<CodecArrays> results = decode_meshes(file.path(), jobs);
    for (size_t i = 0; i < results.size(); ++i)
        for (size_t k = 0; k < accessors[i].size(); ++k)
            decoded.accessors[accessors[i][k]] = std::move(results[i][k]);
}

}  // namespace voxelume
