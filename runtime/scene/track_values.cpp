// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/track_values.hpp"

#include <algorithm>
#include <cmath>

namespace voxelume {
namespace {

/// The numbers of one column at all keys.
struct KeyedColumn {
    const Keyframes& keys;
    size_t column;

    template <class Fold>
    double folded(const Fold& fold) const {
        double result = keys.values[column];
        for (size_t i = column; i < keys.values.size(); i += keys.width)
            result = fold(result, keys.values[i]);
        return result;
    }
    double min() const {
        return folded([](double a, double b) { return std::min(a, b); });
    }
    double max() const {
        return folded([](double a, double b) { return std::max(a, b); });
    }
};

double kept_in(double value, const Range& range, const KeyedColumn& column) {
    if (std::isnan(value)) return column.min();
    const double low = range.min_is_open ? column.min() : range.min;
    const double high = range.max_is_open ? column.max() : range.max;
    if (range.min_is_open ? value <= range.min : value < range.min) return low;
    if (range.max_is_open ? value >= range.max : value > range.max) return high;
    return value;
}

bool is_on_key(const Keyframes& keys, double frame) {
    return frame <= keys.frames.front() || frame >= keys.frames.back() ||
           keys.frames[key_before(keys.frames, frame)] == frame;
}

}  // namespace

std::vector<double> values_of(const Track& track, double frame) {
    const Keyframes& keys = track.keys;
    std::vector<double> values = values_at(keys, frame);
    const bool is_spline = keys.interpolation == Interpolation::spline && !keys.has_quaternions;
    if (!is_spline || is_on_key(keys, frame)) return values;
    const Range range = std::visit([](const auto* row) { return row->range; }, track.value);
    if (!(range.min < range.max)) return values;
    for (size_t i = 0; i < values.size(); ++i)
        values[i] = kept_in(values[i], range, KeyedColumn{keys, i});
    return values;
}

}  // namespace voxelume
