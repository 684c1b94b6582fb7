// SPDX-License-Identifier: Apache-2.0
// The camera and the lights of a glTF file, as parts of a scene's text.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "runtime/import/contents.hpp"
#include "runtime/io/gltf/gltf_motion.hpp"
#include "runtime/scene/parts/bounds.hpp"

namespace voxelume {

inline constexpr double kGltfFrameRate = 24;  ///< frames a second; a file has none

/// The number of frames that show a clip of this length.
int frame_count(double seconds);

/// The frames of a scene in which a clip moves nodes.
struct GltfFrames {
    const GltfMotion& motion;
    int count = 1;

    /// The length of a file's metre in metres of the scene.
    double scale() const { return glm::length(glm::dvec3(motion.world_from_file()[0])); }

    glm::dmat4 map_at(const GltfNode& node, int frame) const {
        return motion.world_from_node(node, (frame - 1) / kGltfFrameRate);
    }
    /// The maps of a node at all frames, or at some of them, evenly spread, where they are very
    /// many; one for a node that stands still.
    std::vector<glm::dmat4> maps_of(const GltfNode& node) const;
};

/// The observer of the file's first camera; empty where there is none. If the image has another
/// shape than the camera's, the height of the view stays.
FileObserver gltf_observer(const GltfFile& file, const std::vector<GltfNode>& nodes,
                           const Bounds& box, const glm::ivec2& size, const GltfFrames& frames);

/// Appends the tracks of gltf_observer()'s observer, frame by frame, where its camera moves.
void add_observer_tracks(const GltfFile& file, const std::vector<GltfNode>& nodes,
                         const GltfFrames& frames, std::vector<std::string>& tracks);

/// The file's lights, with the file's ratios of brightness. Together they give the middle of the
/// box an irradiance of 1, because files have lights in candela and lux and no exposure. Tracks of
/// moving lights are appended, frame by frame.
std::vector<std::string> gltf_light_items(const GltfFile& file, const std::vector<GltfNode>& nodes,
                                          const Bounds& box, const GltfFrames& frames,
                                          std::vector<std::string>& tracks);

}  // namespace voxelume
