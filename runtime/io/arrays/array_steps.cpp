// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/arrays/array_steps.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "runtime/io/arrays/array_stream.hpp"

namespace voxelume {
namespace {

/// One of the threads that read layers.
class StepMeter {
  public:
    StepMeter(const CellArray& array, const SurfaceValues& values, const ArraySides& sides,
              const glm::vec3& weight)
        : array_(array),
          values_(values),
          sides_(sides),
          weight_(weight),
          pairs_(sides.inside.words()) {}

    /// Measures the steps between neighbours in layer z.
    template <class Value>
    void measure(const Value* layer, int z) {
        const int height = array_.counts.y;
        const size_t width = size_t(array_.counts.x);
        for (int y = 0; y < height; ++y) {
            const Value* row = layer + size_t(y) * width;
            sides_.pairs(0, y, z, pairs_.data());
            measure_pairs(row, row + 1, weight_.x);
            if (y + 1 == height) continue;
            sides_.pairs(1, y, z, pairs_.data());
            measure_pairs(row, row + width, weight_.y);
        }
    }

    /// Measures the steps between layer z and the next one.
    template <class Value>
    void measure(const Value* layer, const Value* next, int z) {
        for (int y = 0; y < array_.counts.y; ++y) {
            const size_t row = size_t(y) * size_t(array_.counts.x);
            sides_.pairs(2, y, z, pairs_.data());
            measure_pairs(layer + row, next + row, weight_.z);
        }
    }

    float steepest() const { return steepest_; }

  private:
    template <class Value>
    void measure_pairs(const Value* row, const Value* next, float weight) {
        for (size_t word = 0; word < pairs_.size(); ++word)
            for_each_bit(pairs_[word], word, [&](int x) {
                const float step = std::abs(values_.step(row[x]) - values_.step(next[x]));
                steepest_ = std::max(steepest_, step * weight);
            });
    }

    const CellArray& array_;
    const SurfaceValues& values_;
    const ArraySides& sides_;
    const glm::vec3 weight_;
    std::vector<uint64_t> pairs_;  ///< pairs of a row
    float steepest_ = 0;
};

/// The steepest step within layers, and between each layer and the one before.
float steepest_in(const CellArray& array, const InputFile& file, StepMeter meter, int first,
                  int end) {
    const int before = std::max(first - 1, 0);
    ArraySlabs slabs(array, file, 1, before, end);
    std::vector<std::byte> last;  // layer
    const size_t bytes =
        size_t(array.counts.x) * size_t(array.counts.y) * bytes_in_memory(array.type);
    while (slabs.next() > 0) {
        const int z = slabs.first();
        with_type(array.type, slabs.values(), [&](const auto* layer) {
            if (z >= first) meter.measure(layer, z);
            if (z > before)
                meter.measure(reinterpret_cast<decltype(layer)>(last.data()), layer, z - 1);
        });
        if (z + 1 < end) last.assign(slabs.values(), slabs.values() + bytes);
    }
    return meter.steepest();
}

}  // namespace

float steepest_step(const CellArray& array, const InputFile& file, const SurfaceValues& values,
                    const ArraySides& sides, const glm::vec3& weight) {
    float steepest = 0;
    std::mutex mutex;
    for_layer_ranges(array, 1, [&](int first, int end) {
        const StepMeter meter(array, values, sides, weight);
        const float largest = steepest_in(array, file, meter, first, end);
        const std::scoped_lock lock(mutex);
        steepest = std::max(steepest, largest);
    });
    return steepest;
}

}  // namespace voxelume
