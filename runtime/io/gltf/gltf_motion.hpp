// SPDX-License-Identifier: Apache-2.0
// The placements of a glTF file's nodes at a time of a clip.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <vector>

#include "runtime/io/gltf/gltf_animation.hpp"
#include "runtime/io/gltf/gltf_nodes.hpp"
#include "runtime/scene/parts/scene_affine.hpp"

namespace voxelume {

/// A clip that moves a file's nodes. The clip must outlive this object.
class GltfMotion {
  public:
    /// `world_from_file` is applied after the file's own placements.
    GltfMotion(const GltfFile& file, const GltfClip& clip,
               const glm::dmat4& world_from_file = glm::dmat4(1));

    /// The tracks of the node's translation, rotation and scale; null where there is none.
    const std::array<const GltfTrack*, 3>& tracks_of(int node) const {
        return tracks_[size_t(node)];
    }
    bool has_tracks(int node) const { return tracks_of(node) != std::array<const GltfTrack*, 3>{}; }
    /// The numbers of a node's ancestors and of the node itself, from the root on.
    std::vector<int> line_of(int node) const;
    /// True if the node or an ancestor has tracks.
    bool moves(int node) const;

    /// The placement in its parent that the file gives a node with tracks, and that of any node.
    const Factors& factors_of(int node) const { return factors_[size_t(node)]; }
    const glm::dmat4& parent_from_node(int node) const { return places_[size_t(node)]; }

    const glm::dmat4& world_from_file() const { return world_from_file_; }
    glm::dmat4 world_from_node(const GltfNode& node, double seconds) const;

  private:
    Factors factors_at(int node, double seconds) const;

    glm::dmat4 world_from_file_;
    // By node.
    std::vector<int> parents_;
    std::vector<std::array<const GltfTrack*, 3>> tracks_;
    std::vector<Factors> factors_;
    std::vector<glm::dmat4> places_;
};

}  // namespace voxelume
