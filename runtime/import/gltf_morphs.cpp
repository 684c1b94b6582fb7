// SPDX-License-Identifier: Apache-2.0
#include "runtime/import/gltf_morphs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>

#include "runtime/import/contents.hpp"
#include "runtime/import/gltf_sight.hpp"
#include "runtime/import/gltf_tracks.hpp"
#include "runtime/io/gltf/gltf_skin.hpp"
#include "runtime/io/gltf/gltf_targets.hpp"

namespace voxelume {

namespace {

/// The box that a box becomes under weights and their keys.
Bounds reach_of_targets(const GltfMorph& morph, const GltfFile& file, int mesh, const Bounds& box) {
    if (morph.weights.empty()) return box;
    std::vector<double> lowest = morph.weights, highest = morph.weights;
    if (morph.keys)
        for (size_t i = 0; i < morph.keys->values.size(); ++i) {
            const size_t target = i % lowest.size();
            lowest[target] = std::min(lowest[target], morph.keys->values[i]);
            highest[target] = std::max(highest[target], morph.keys->values[i]);
        }
    for (double& weight : lowest) weight = std::min(weight, 0.0);
    for (double& weight : highest) weight = std::max(weight, 0.0);
    const std::vector<MorphTarget> targets = gltf_targets(file, mesh + 1);
    return box_of_targets(box_of_targets(box, targets, lowest), targets, highest);
}

GltfMorph weights_of(const GltfFile& file, const GltfClip& clip, const GltfNode& node) {
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

}  // namespace

GltfMorph gltf_morph(const GltfFile& file, const GltfClip& clip, const GltfNode& node) {
    GltfMorph morph = weights_of(file, clip, node);
    morph.skin = node.skin;
    if (node.skin < 0) return morph;
    if (morph.owner == GltfMorph::kNobody) morph.owner = GltfMorph::kMesh;
    if (std::ranges::any_of(clip.tracks,
                            [](const GltfTrack& t) { return t.path != GltfPath::weights; }))
        morph.clip = clip.name;
    return morph;
}

std::string morph_member(const GltfMorph& morph) {
    std::vector<std::string> members, numbers;
    for (const double weight : morph.weights) numbers.push_back(fmt::format("{}", weight));
    if (!numbers.empty())
        members.push_back(fmt::format("\"weights\": [{}]", fmt::join(numbers, ", ")));
    if (morph.skin >= 0) members.push_back(fmt::format("\"skin\": {}", morph.skin + 1));
    if (!morph.clip.empty()) members.push_back(fmt::format("\"clip\": {}", json_text(morph.clip)));
    if (members.empty()) return {};
    return fmt::format(", \"morph\": {{{}}}", fmt::join(members, ", "));
}

std::string skin_track(const std::string& model, double seconds) {
    const std::string target = fmt::format("models.{}.morph.time", target_name(model));
    return fmt::format(
        "{{\"target\": {}, \"keys\": [{{\"time\": 0, \"value\": 0}}, "
        "{{\"time\": {}, \"value\": {}}}]}}",
        json_text(target), rounded(seconds, 9), rounded(seconds, 9));
}

Bounds reach_of(const GltfMorph& morph, const GltfFile& file, int mesh, const Bounds& box,
                int frames) {
    if (morph.skin < 0) return reach_of_targets(morph, file, mesh, box);
    const GltfSkin skin(file, mesh + 1, morph.skin, morph.clip);
    const Bounds slack = reach_of_targets(morph, file, mesh, {glm::dvec3(0), glm::dvec3(0)});
    Bounds reached = skin.box_at(0, slack);
    for (int frame = 2; frame <= frames && !morph.clip.empty(); ++frame) {
        const Bounds next = skin.box_at((frame - 1) / kGltfFrameRate, slack);
        reached = {glm::min(reached.min, next.min), glm::max(reached.max, next.max)};
    }
    return reached;
}

}  // namespace voxelume
