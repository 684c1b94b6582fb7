// SPDX-License-Identifier: Apache-2.0
#include "runtime/import/gltf_morphs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/import/contents.hpp"
#include "runtime/io/gltf/gltf_targets.hpp"

namespace voxelume {

GltfMorph gltf_morph(const GltfFile& file, const GltfClip& clip, const GltfNode& node) {
    const GltfValue mesh = file.root().item("meshes", size_t(node.mesh));
    const size_t targets = count_gltf_targets(mesh);
    GltfMorph morph;
    if (targets == 0) return morph;
    const GltfValue value = file.root().item("nodes", size_t(node.number));
    const bool is_own = value.has("weights");
    morph.weights = (is_own ? value : mesh).numbers("weights", targets);
    for (const GltfTrack& track : clip.tracks) {
        if (track.node != node.number || track.path != GltfPath::weights) continue;
        if (track.keys.width != targets)
            value.fail(fmt::format("a clip has {} weights for it, and its mesh has {} targets",
                                   track.keys.width, targets));
        morph.keys = &track.keys;
    }
    morph.owner = is_own || morph.keys ? node.number : GltfMorph::kMesh;
    if (morph.keys) morph.weights.resize(targets);
    if (!morph.keys &&
        std::ranges::count(morph.weights, 0.0) == std::ptrdiff_t(morph.weights.size()))
        return {};
    return morph;
}

std::string morph_member(const GltfMorph& morph) {
    if (morph.weights.empty()) return {};
    std::vector<std::string> numbers;
    for (const double weight : morph.weights) numbers.push_back(fmt::format("{}", weight));
    return fmt::format(", \"morph\": {{\"weights\": [{}]}}", fmt::join(numbers, ", "));
}

Bounds reach_of(const GltfMorph& morph, const GltfFile& file, int mesh, const Bounds& box) {
    if (morph.weights.empty()) return box;
    std::vector<double> least = morph.weights, most = morph.weights;
    if (morph.keys)
        for (size_t i = 0; i < morph.keys->values.size(); ++i) {
            const size_t target = i % least.size();
            least[target] = std::min(least[target], morph.keys->values[i]);
            most[target] = std::max(most[target], morph.keys->values[i]);
        }
    for (double& weight : least) weight = std::min(weight, 0.0);
    for (double& weight : most) weight = std::max(weight, 0.0);
    const std::vector<MorphTarget> targets = gltf_targets(file, mesh + 1);
    return box_of_targets(box_of_targets(box, targets, least), targets, most);
}

}  // namespace voxelume
