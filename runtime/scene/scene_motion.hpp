// SPDX-License-Identifier: Apache-2.0
// The changes of a scene from frame to frame: its tracks and numbered files, part by part.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "runtime/base/text.hpp"
#include "runtime/scene/keyframes.hpp"
#include "runtime/scene/parts/light.hpp"
#include "runtime/scene/parts/observer.hpp"
#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/scene/parts/value_row.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/scene/scene_animation.hpp"

namespace voxelume {

/// The kinds of parts that are updated as a whole when a value in them changes.
enum class ScenePart : uint8_t { world, material, model, object, light, observer };

/// The value that a track changes: a row of the part, or of a structure inside of it.
using ValueReference =
    std::variant<const ValueRow<World>*, const ValueRow<Medium>*, const ValueRow<HeightDensity>*,
                 const ValueRow<BallDensity>*, const ValueRow<GridDensity>*,
                 const ValueRow<Material>*, const ValueRow<Checker>*, const ValueRow<Model>*,
                 const ValueRow<Morph>*, const ValueRow<Solid>*, const ValueRow<Factors>*,
                 const ValueRow<Object>*, const ValueRow<LightParameters>*,
                 const ValueRow<ObserverParameters>*, const ValueRow<DisplayParameters>*>;

/// The path to a solid of a model: the whole one, or a part of a part by their numbers. If the
/// model is cut, the first number is that of the cut.
struct SolidPath {
    bool is_cut = false;
    std::vector<size_t> parts;

    friend bool operator==(const SolidPath&, const SolidPath&) = default;
};

/// A value over time.
struct Track {
    ValueReference value;
    SolidPath solid;  ///< for a model: the solid with the value or placement
    int item = -1;    ///< index of the vector's component that changes alone, or -1
    /// Values as numbers; true is 1 and false 0; models and materials are their indices in the
    /// scene; files have no numbers.
    Keyframes keys;
    std::vector<std::filesystem::path> files;  ///< file of each key
    std::string path;                          ///< path of the value in its part, for messages
    std::vector<TextPosition> at;              ///< position of each key's value in the scene's text
};

/// Files that frames show one after the other.
struct FileSequence {
    ValueReference value;
    std::vector<std::filesystem::path> files;
    int64_t start = 1;  ///< frame that shows the first file
    bool loop = false;  ///< the first file follows the last one; otherwise the last one stays

    const std::filesystem::path& at(double frame) const;
};

/// The placement of an object, a density, or a part of a solid, before its tracks change it.
struct MovingPlacement {
    SolidPath solid;   ///< of a model; of an object the number of the parent, or nothing
    std::string path;  ///< prefix of its keys in messages: "parts[1]."
    Factors factors;
};

/// The position of a value in the scene's text.
struct ValueOrigin {
    std::string path;  ///< path in its part; "" for the part itself
    TextPosition at;
};

/// A part of the scene that tracks or numbered files change.
struct MovingPart {
    ScenePart part = ScenePart::world;
    size_t index = 0;          ///< index in the scene's list
    std::string path;          ///< path for messages
    bool only_placed = false;  ///< an object that changes by its placement alone
    std::vector<Track> tracks;
    std::vector<FileSequence> sequences;
    /// The original placements that tracks change; the scene has only the resulting maps.
    std::vector<MovingPlacement> placements;
    /// The maps of an object's parents, the outermost first, and its own, before tracks
    /// change them.
    std::vector<glm::dmat4> links;
    std::variant<std::monostate, LightParameters, ObserverParameters> parameters;
    std::vector<ValueOrigin> origins;
};

/// The data that `scene_at` needs besides the scene.
struct SceneMotion {
    std::string file;               ///< the scene's file, which opens messages
    std::vector<MovingPart> parts;  ///< world, materials, models, objects, lights, observer
};

/// True if some part that may change from frame to frame is one of `which`.
bool any_part_changes(const Scene& scene, const auto& which) {
    return moves(scene) && std::ranges::any_of(scene.motion->parts, which);
}

}  // namespace voxelume
