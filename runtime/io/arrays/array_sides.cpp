// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/arrays/array_sides.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "runtime/io/arrays/array_choice.hpp"
#include "runtime/io/arrays/array_stream.hpp"

namespace voxelume {
namespace {

/// Widens the range from `min` to `max` by the values that are numbers.
template <class Value>
void widen_range(const Value* values, size_t count, Value& min, Value& max) {
    // Each lane of a register has its own range, which compilers may not do for floats by
    // themselves.
    constexpr size_t kLanes = 64 / sizeof(Value);
    std::array<Value, kLanes> low, high;
    low.fill(min);
    high.fill(max);
    size_t i = 0;
    for (; i + kLanes <= count; i += kLanes)
        for (size_t lane = 0; lane < kLanes; ++lane) {
            low[lane] = values[i + lane] < low[lane] ? values[i + lane] : low[lane];
            high[lane] = values[i + lane] > high[lane] ? values[i + lane] : high[lane];
        }
    for (; i < count; ++i) {
        low[0] = values[i] < low[0] ? values[i] : low[0];
        high[0] = values[i] > high[0] ? values[i] : high[0];
    }
    min = *std::ranges::min_element(low);
    max = *std::ranges::max_element(high);
}

/// One of the threads that read layers.
class LayerReader {
  public:
    LayerReader(const CellArray& array, const SurfaceValues& values, ArraySides& sides)
        : array_(array), values_(values), sides_(sides), chosen_(64 * sides.inside.words()) {}

    template <class Value>
    void read(const Value* layer, int z) {
        const size_t width = size_t(array_.counts.x), height = size_t(array_.counts.y);
        for (size_t y = 0; y < height; ++y) {
            const Value* row = layer + y * width;
            choose(row, width, array_, values_.inside(), chosen_.data());
            sides_.inside.set_row(int(y), z, chosen_.data());
            if (!values_.may_be_infinite()) continue;
            for (size_t x = 0; x < width; ++x) chosen_[x] = std::isfinite(values_.step(row[x]));
            sides_.finite.set_row(int(y), z, chosen_.data());
        }
        using Limits = std::numeric_limits<Value>;
        Value low = Limits::has_infinity ? Limits::infinity() : Limits::max();
        Value high = Limits::has_infinity ? -Limits::infinity() : Limits::lowest();
        widen_range(layer, width * height, low, high);
        if (!(low <= high)) return;  // no value is a number
        for (const Value v : {low, high}) {
            const double meant = array_.slope * double(v) + array_.intercept;
            min_ = std::min(min_, meant);
            max_ = std::max(max_, meant);
        }
    }

    void give_range() {
        sides_.min = std::min(sides_.min, min_);
        sides_.max = std::max(sides_.max, max_);
    }

  private:
    const CellArray& array_;
    const SurfaceValues& values_;
    ArraySides& sides_;
    std::vector<uint8_t> chosen_;  ///< a row of them
    double min_ = INFINITY, max_ = -INFINITY;
};

}  // namespace

SurfaceValues::SurfaceValues(const CellArray& array, const VoxelValues& values)
    : slope_(array.slope), intercept_(array.intercept) {
    const bool is_plain = slope_ == 1 && intercept_ == 0;
    inside_.label = values.label;
    if (!values.label && (values.iso || is_float(array.type))) {
        iso_ = values.iso.value_or(0.5);
        inside_.iso = std::nextafter(*iso_, INFINITY);  // choose() takes equal values, too
    }
    may_be_infinite_ = iso_ && (is_float(array.type) || !is_plain);
}

float SurfaceValues::step_between(double high, double low) {
    constexpr double kMaxStep = 1e37;  // sums of two such steps are finite floats
    const double step = high - low;
    return float(std::isfinite(step) ? std::clamp(step, -kMaxStep, kMaxStep) : step);
}

bool SurfaceValues::are_crossed(double min, double max) const {
    if (inside_.label) return min <= *inside_.label && *inside_.label <= max;
    return iso_ ? max > *iso_ : min != 0 || max != 0;
}

std::string SurfaceValues::in_words() const {
    if (inside_.label) return fmt::format("the label {}", *inside_.label);
    return iso_ ? fmt::format("the value {} (\"iso\")", *iso_) : "values that aren't 0";
}

void ArraySides::pairs(int axis, int y, int z, uint64_t* out) const {
    const bool has_finite = finite.words() > 0;
    const uint64_t *here = inside.row(y, z), *here_finite = has_finite ? finite.row(y, z) : nullptr;
    const size_t words = inside.words();
    if (axis > 0) {
        const int next_y = y + (axis == 1), next_z = z + (axis == 2);
        const uint64_t* next = inside.row(next_y, next_z);
        const uint64_t* next_finite = has_finite ? finite.row(next_y, next_z) : nullptr;
        for (size_t i = 0; i < words; ++i)
            out[i] = (here[i] ^ next[i]) & (has_finite ? here_finite[i] & next_finite[i] : ~0ull);
        return;
    }
    const auto shifted = [words](const uint64_t* row, size_t i) {
        return row[i] >> 1 | (i + 1 < words ? row[i + 1] << 63 : 0);
    };
    for (size_t i = 0; i < words; ++i)
        out[i] = (here[i] ^ shifted(here, i)) &
                 (has_finite ? here_finite[i] & shifted(here_finite, i) : ~0ull);
    // The last cell has no next one.
    const int last = counts.x - 1;
    out[last / 64] &= ~(uint64_t{1} << last % 64);
}

ArraySides sides_of_array(const CellArray& array, const InputFile& file,
                          const SurfaceValues& values) {
    ArraySides sides;
    sides.counts = array.counts;
    sides.inside = CellBits(array.counts);
    if (values.may_be_infinite()) sides.finite = CellBits(array.counts);
    sides.min = INFINITY;
    sides.max = -INFINITY;
    std::mutex mutex;  // guards the range
    for_layer_ranges(array, 1, [&](int first, int end) {
        ArraySlabs slabs(array, file, 1, first, end);
        LayerReader reader(array, values, sides);
        while (slabs.next() > 0)
            with_type(array.type, slabs.values(),
                      [&](const auto* layer) { reader.read(layer, slabs.first()); });
        const std::scoped_lock lock(mutex);
        reader.give_range();
    });
    return sides;
}

}  // namespace voxelume
