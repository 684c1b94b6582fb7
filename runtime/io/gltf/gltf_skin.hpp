// SPDX-License-Identifier: Apache-2.0
// Skins of a glTF file: vertices that follow several joints, at a time of a clip.
#pragma once

#include <vector>

#include "runtime/geometry/mesh.hpp"
#include "runtime/io/gltf/gltf_motion.hpp"
#include "runtime/scene/parts/bounds.hpp"

namespace voxelume {

/// The maximum number of pairs of a joint and a weight over all of a mesh's vertices: 1 GiB.
inline constexpr uint64_t kMaxSkinWeights = uint64_t{1} << 27;

/// The joints that each vertex of a mesh follows, and their weights.
struct SkinWeights {
    size_t per_vertex = 0;         ///< 4 for each pair of JOINTS_n and WEIGHTS_n
    std::vector<uint32_t> joints;  ///< numbers in the skin
    std::vector<float> weights;    ///< the weights of a vertex add up to 1, or are all 0: it stays
};

/// A mesh's vertices under a skin, while a clip moves the joints. Nothing moves in an empty clip:
/// joints stand where the file's nodes do.
class GltfSkin {
  public:
    /// The skin (`number` from 0 on) of the mesh `part`, numbered from 1 on, whose vertices are
    /// those of gltf_mesh(file, part). `clip` is a name, or empty. Throws Error::input for parts
    /// that don't go together, Error::limit, before they are read, for more than kMaxSkinWeights.
    GltfSkin(const GltfFile& file, int part, int number, const std::string& clip);
    GltfSkin(const GltfSkin&) = delete;  // the motion refers to the clip
    GltfSkin& operator=(const GltfSkin&) = delete;

    /// Moves vertices from their positions in the mesh, from number `first` on, into the world by
    /// linear blends of their joints' maps, and turns their normals.
    void move(Mesh& mesh, size_t first, double seconds) const;
    /// A box around the moved vertices, each of which may first be moved by something in `slack`.
    Bounds box_at(double seconds, const Bounds& slack = {}) const;
    uint64_t bytes() const {
        return weights_.joints.size() * sizeof(uint32_t) + weights_.weights.size() * sizeof(float);
    }

  private:
    std::vector<glm::dmat4> maps_at(double seconds) const;

    GltfClip clip_;
    GltfMotion motion_;
    SkinWeights weights_;
    std::vector<Bounds> boxes_;  ///< boxes of vertices by joint, and of those that none moves
    std::vector<int> joints_;    ///< nodes
    std::vector<glm::dmat4> inverse_binds_;  ///< joint from mesh
};

/// The clip of that name; an empty one for no name. Throws Error::input for another name.
GltfClip gltf_clip_named(const GltfFile& file, const std::string& name);

}  // namespace voxelume
