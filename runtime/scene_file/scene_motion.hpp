// What changes in a scene from frame to frame: its tracks and numbered files, part by part.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "runtime/scene/scene_affine.hpp"
#include "runtime/scene_file/assets.hpp"
#include "runtime/scene_file/scene_track.hpp"

namespace voxelume {

struct Scene;

/// A part of the scene that tracks or numbered files change.
struct MovingPart {
    ScenePart part = ScenePart::world;
    size_t number = 0;               ///< in the document
    size_t place = 0;                ///< in the scene's list
    std::string name;                ///< of a material or model
    std::string path;                ///< as messages have it
    JsonValue value;                 ///< of an object that is only placed anew, its placement alone
    bool places = false;             ///< an object that is only placed anew
    std::optional<Factors> factors;  ///< of such an object, by whole factors: those without tracks
    std::vector<Track> tracks;
};

/// What `scene_at` needs besides the scene.
struct SceneMotion {
    std::string file;
    AssetFolders assets;
    std::vector<MovingPart> parts;  ///< materials, models, objects, lights, world, observer
};

/// The motion of a scene whose plain values are read, or null when it stands still. Marks objects
/// that move.
///
/// Throws Error::scene for tracks that are wrong, and for values that are at some key.
std::shared_ptr<const SceneMotion> read_motion(const SceneValue& root, const AssetFolders& assets,
                                               Scene& scene);

}  // namespace voxelume
