// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/gltf/gltf_motion.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace voxelume {

namespace {

Factors factors_in(const GltfValue& node) {
    Factors factors{gltf_translation(node), glm::dvec3(0), gltf_scale(node)};
    const glm::dvec4 q = gltf_rotation(node);
    if (glm::length(q) > 0)
        factors.turn =
            turn_from_rotation(glm::mat3_cast(glm::normalize(glm::dquat(q.w, q.x, q.y, q.z))));
    return factors;
}

}  // namespace

GltfMotion::GltfMotion(const GltfFile& file, const GltfClip& clip,
                       const glm::dmat4& world_from_file)
    : world_from_file_(world_from_file),
      parents_(gltf_parents(file)),
      tracks_(parents_.size()),
      factors_(parents_.size()) {
    const std::vector<GltfValue> nodes = file.root().items("nodes");
    places_.reserve(nodes.size());
    for (const GltfValue& node : nodes) places_.push_back(gltf_parent_from_node(node));
    for (const GltfTrack& track : clip.tracks) {
        if (track.path == GltfPath::weights) continue;
        const GltfValue& node = nodes[size_t(track.node)];
        if (node.has("matrix")) node.fail("has a matrix, which a clip can't move");
        tracks_[size_t(track.node)][size_t(track.path)] = &track;
        factors_[size_t(track.node)] = factors_in(node);
    }
}

std::vector<int> GltfMotion::line_of(int node) const {
    std::vector<int> line;
    for (; node >= 0; node = parents_[size_t(node)]) line.push_back(node);
    std::reverse(line.begin(), line.end());
    return line;
}

bool GltfMotion::moves(int node) const {
    while (node >= 0 && !has_tracks(node)) node = parents_[size_t(node)];
    return node >= 0;
}

Factors GltfMotion::factors_at(int node, double seconds) const {
    Factors factors = factors_of(node);
    const std::array<glm::dvec3*, 3> values = {&factors.position, &factors.turn, &factors.scale};
    for (size_t i = 0; i < values.size(); ++i) {
        const GltfTrack* const track = tracks_of(node)[i];
        if (!track) continue;
        const std::vector<double> row = values_at(track->keys, seconds);
        *values[i] = {row[0], row[1], row[2]};
    }
    return factors;
}

glm::dmat4 GltfMotion::world_from_node(const GltfNode& node, double seconds) const {
    glm::dmat4 map = node.node_from_instance;
    for (int number = node.number; number >= 0; number = parents_[size_t(number)])
        map = (has_tracks(number) ? affine_from_factors(factors_at(number, seconds))
                                  : parent_from_node(number)) *
              map;
    return world_from_file_ * map;
}

}  // namespace voxelume
