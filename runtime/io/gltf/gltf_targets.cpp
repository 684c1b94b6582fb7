// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/gltf/gltf_targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/base/error.hpp"
#include "runtime/io/gltf/gltf_accessor.hpp"
#include "runtime/io/gltf/gltf_primitives.hpp"

namespace voxelume {
namespace {

constexpr const char* kMoved[] = {"POSITION", "NORMAL"};

/// Refuses a mesh whose targets take too much memory. A list of offsets covers the vertices of all
/// primitives, even if its target moves few of them.
void check_size(const GltfFile& file, const GltfValue& mesh) {
    uint64_t vertices = 0, lists = 0;
    for (const char* const key : kMoved) {
        size_t max_targets = 0;
        for (const GltfValue& primitive : mesh.items("primitives"))
            for (size_t i = max_targets; i < primitive.size("targets"); ++i)
                if (primitive.item("targets", i).has(key)) max_targets = i + 1;
        lists += max_targets;
    }
    for (const GltfValue& primitive : gltf_primitives(mesh))
        vertices += count_gltf_values(file, primitive.at("attributes"), "POSITION");
    if (lists == 0 || vertices <= kMaxTargetOffsets / lists) return;
    throw Error(ErrorKind::limit,
                "{}: a mesh's targets move {} vertices {} times, and {} offsets are the most",
                SourcePlace(file.path().string()), vertices, lists, kMaxTargetOffsets);
}

/// Appends the offsets of one attribute of a target, after zeros for the vertices before them.
void add_offsets(const GltfFile& file, const GltfValue& target, const char* key, size_t base,
                 size_t vertices, std::vector<glm::vec3>& offsets) {
    if (!target.has(key)) return;
    const GltfValues values = gltf_values(file, target, key, {3});
    if (values.count != vertices)
        target.fail(fmt::format("{} vertices, and {} of {}", vertices, values.count, key));
    offsets.resize(base, glm::vec3(0));
    for (size_t i = 0; i < vertices; ++i) {
        const glm::vec3 offset(values.values[3 * i], values.values[3 * i + 1],
                               values.values[3 * i + 2]);
        if (!std::isfinite(offset.x + offset.y + offset.z))
            target.fail(fmt::format("a number of {} isn't finite", key));
        offsets.push_back(offset);
    }
}

}  // namespace

size_t count_gltf_targets(const GltfValue& mesh) {
    size_t count = 0;  // of plain JSON, since each node that shows the mesh asks
    for (const nlohmann::json& primitive : mesh.at("primitives").json())
        if (const auto targets = primitive.find("targets"); targets != primitive.end())
            count = std::max(count, targets->size());
    return count;
}

std::vector<MorphTarget> gltf_targets(const GltfFile& file, int part) {
    const GltfValue mesh = file.root().item("meshes", size_t(part - 1));
    check_size(file, mesh);
    std::vector<MorphTarget> targets(count_gltf_targets(mesh));
    size_t base = 0;
    for (const GltfValue& primitive : gltf_primitives(mesh)) {
        const size_t vertices = count_gltf_values(file, primitive.at("attributes"), "POSITION");
        for (size_t i = 0; i < primitive.size("targets"); ++i) {
            const GltfValue target = primitive.item("targets", i);
            add_offsets(file, target, kMoved[0], base, vertices, targets[i].positions);
            add_offsets(file, target, kMoved[1], base, vertices, targets[i].normals);
        }
        base += vertices;
    }
    for (MorphTarget& target : targets)
        for (std::vector<glm::vec3>* const offsets : {&target.positions, &target.normals})
            if (!offsets->empty()) offsets->resize(base, glm::vec3(0));
    return targets;
}

}  // namespace voxelume
