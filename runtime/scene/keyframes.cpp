// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/keyframes.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "runtime/scene/parts/scene_affine.hpp"

namespace voxelume {
namespace {

/// One of the numbers of a track, key by key.
class Curve {
  public:
    Curve(const Keyframes& keys, size_t column) : keys_(keys), column_(column) {}

    double linear(size_t key, double share) const {
        return value(key) * (1 - share) + value(key + 1) * share;
    }

    double cubic(size_t key, double t) const {
        const double rise = value(key + 1) - value(key), span = length(key);
        const double start = slope_at(key) * span, end = slope_at(key + 1) * span;
        // Hermite's polynomial over the rise, so that equal keys stay what they are.
        return value(key) + t * t * (3 - 2 * t) * rise + t * (1 - t) * ((1 - t) * start - t * end);
    }

    double spline(size_t key, double t) const {
        const double rise = value(key + 1) - value(key), span = length(key);
        const double start = slope(keys_.out, key) * span, end = slope(keys_.in, key + 1) * span;
        return value(key) + t * t * (3 - 2 * t) * rise + t * (1 - t) * ((1 - t) * start - t * end);
    }

  private:
    double slope(const std::vector<double>& slopes, size_t key) const {
        return slopes[key * keys_.width + column_];
    }
    double value(size_t key) const { return keys_.values[key * keys_.width + column_]; }
    double length(size_t key) const { return keys_.frames[key + 1] - keys_.frames[key]; }
    double slope_after(size_t key) const { return (value(key + 1) - value(key)) / length(key); }

    double slope_at(size_t key) const {
        if (key == 0 || key + 1 == keys_.frames.size()) return 0;
        const double before = slope_after(key - 1), after = slope_after(key);
        if (!((before > 0 && after > 0) || (before < 0 && after < 0))) return 0;
        const double weight_before = 2 * length(key) + length(key - 1);
        const double weight_after = length(key) + 2 * length(key - 1);
        return (weight_before + weight_after) / (weight_before / before + weight_after / after);
    }

    const Keyframes& keys_;
    size_t column_;
};

std::vector<double> turn_of(const glm::dquat& orientation) {
    const glm::dvec3 turn = turn_from_rotation(glm::mat3_cast(glm::normalize(orientation)));
    return {turn.x, turn.y, turn.z};
}

/// The quaternion of four numbers x, y, z, w.
glm::dquat quaternion(const double* row) {
    return {row[3], row[0], row[1], row[2]};
}

std::vector<double> slerp(const Keyframes& keys, size_t key, double share) {
    const auto orientation = [&](size_t number) {
        const double* row = &keys.values[keys.width * number];
        return keys.has_quaternions ? glm::normalize(quaternion(row))
                                    : glm::quat_cast(rotation_from_turn({row[0], row[1], row[2]}));
    };
    return turn_of(glm::slerp(orientation(key), orientation(key + 1), share));
}

/// A row of numbers, or the turn of a quaternion.
std::vector<double> finished(const Keyframes& keys, const std::vector<double>& row) {
    return keys.has_quaternions ? turn_of(quaternion(row.data())) : row;
}

}  // namespace

size_t key_before(const std::vector<double>& frames, double frame) {
    const auto after = std::upper_bound(frames.begin(), frames.end(), frame);
    return after == frames.begin() ? 0 : size_t(after - frames.begin()) - 1;
}

std::vector<double> values_at(const Keyframes& keys, double frame) {
    const size_t key = key_before(keys.frames, frame);
    const bool is_on_key = frame <= keys.frames[key] || key + 1 == keys.frames.size();
    if (is_on_key || keys.interpolation == Interpolation::step) {
        const auto row = keys.values.begin() + std::ptrdiff_t(key * keys.width);
        return finished(keys, {row, row + std::ptrdiff_t(keys.width)});
    }
    const double share = (frame - keys.frames[key]) / (keys.frames[key + 1] - keys.frames[key]);
    if (keys.interpolation == Interpolation::slerp) return slerp(keys, key, share);
    std::vector<double> row(keys.width);
    for (size_t column = 0; column < keys.width; ++column) {
        const Curve curve(keys, column);
        switch (keys.interpolation) {
            case Interpolation::linear:
                row[column] = curve.linear(key, share);
                break;
            case Interpolation::spline:
                row[column] = curve.spline(key, share);
                break;
            default:
                row[column] = curve.cubic(key, share);
        }
    }
    return finished(keys, row);
}

}  // namespace voxelume
