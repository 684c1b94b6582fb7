// SPDX-License-Identifier: Apache-2.0
// Changes from frame to frame, as typed tracks.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "values.hpp"

namespace voxelume::v1 {

/// A value at a frame. Frame 1 is the first; fractions are allowed.
template <class Value>
struct Key {
    double frame = 1;  ///< 1 is the first; fractions are allowed
    Value value{};     ///< the track's value there
    /// The slope with which Interpolation::spline arrives at the value, in the value's unit per
    /// second; 0 without it.
    std::optional<Value> in{};
    /// The slope with which the spline leaves the value, in the value's unit per second; 0 without
    /// it.
    std::optional<Value> out{};
};

/// The keys of one track, in the order of time.
template <class Value>
using Keys = std::vector<Key<Value>>;

/// The value between two keys.
enum class Interpolation {
    step,    ///< the earlier key's value
    linear,  ///< number by number, at an even speed
    cubic,   ///< number by number, smoothly, and never beyond the two keys' values
    slerp,   ///< the shorter way of a `turn` round one axis, at an even speed
    spline   ///< number by number, with the slopes that the keys have
};

/// One value of the scene over time. Before the first key, the first value holds; after the last
/// key, the last value holds.
///
/// `target` is the path to the value by the keys of the scene format, which are the names of these
/// structs' members (scenes/manual/animation.md): "objects.ball.position", "lights.lamp.intensity",
/// "materials.glass.color", "models.block.parts[1].position", "observer.display.angle",
/// "world.medium.density.base". Objects and lights without a name have their place in brackets:
/// "lights[0].color". Names with dots or brackets in them stand in quotes.
struct Track {
    std::string target{};  ///< path as scene files write it: "objects.ball.position"
    /// Keys in the order of time, one or more; four numbers are a quaternion of a `turn`, a vector
    /// is the weights of a morph.
    std::variant<Keys<double>, Keys<std::array<double, 2>>, Keys<Vec3>, Keys<bool>,
                 Keys<std::string>, Keys<std::array<double, 4>>, Keys<std::vector<double>>>
        keys{};
    /// Empty: linear, or step for texts and bools.
    std::optional<Interpolation> interpolation{};
};

/// Frames of a scene, and the tracks that move it.
struct Animation {
    int frames = 1;                 ///< numbered from 1
    double frames_per_second = 24;  ///< frames a second; slopes of keys are per second
    std::vector<Track> tracks{};    ///< values that change
};

}  // namespace voxelume::v1
