// SPDX-License-Identifier: Apache-2.0
// Statistics of the values of an array.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <mutex>

#include "runtime/io/arrays/array_stream.hpp"
#include "runtime/io/arrays/array_voxels.hpp"

namespace voxelume {
namespace {

constexpr size_t kMaxLabels = 64;
constexpr size_t kBins = 1024;

/// Calls `use` with each value.
template <class Use>
void for_each_value(const CellArray& array, const Use& use) {
    const InputFile file(array.data);
    ArraySlabs slabs(array, file, 1);
    const size_t layer = size_t(array.counts.x) * size_t(array.counts.y);
    while (slabs.next() > 0)
        with_type(array.type, slabs.values(), [&](const auto* values) {
            for (size_t i = 0; i < layer; ++i)
                use(array.slope * double(values[i]) + array.intercept);
        });
}

/// The cut, in bins, between two sets of values with the largest variance between them.
double otsu_bin(const std::array<uint64_t, kBins>& bins) {
    double total = 0, sum = 0;
    for (size_t i = 0; i < kBins; ++i) {
        total += double(bins[i]);
        sum += double(i) * double(bins[i]);
    }
    double below = 0, sum_below = 0, best = -1;
    size_t first = 0, last = 0;
    for (size_t i = 0; i + 1 < kBins; ++i) {
        below += double(bins[i]);
        sum_below += double(i) * double(bins[i]);
        if (below == 0 || below == total) continue;
        const double difference = sum_below / below - (sum - sum_below) / (total - below);
        const double variance = below * (total - below) * difference * difference;
        if (variance > best) first = i;
        if (variance >= best) {
            best = variance;
            last = i;
        }
    }
    // Between two sets that are far apart, the cut is in the middle of the gap.
    return double(first + last) / 2 + 1;
}

/// Sums up the values that `for_each` passes to a function, each with the number of times that it
/// occurs in a row.
template <class ForEach>
ArraySummary summary_of(const ForEach& for_each) {
    ArraySummary summary;
    summary.min = INFINITY;
    summary.max = -INFINITY;
    bool has_labels = true;
    int last = 0;
    uint64_t run = 0;  // number of cells with the value `last` that aren't counted yet
    const auto count_run = [&] {
        if (run > 0 && last != 0) summary.labels[last] += run;
        run = 0;
    };
    for_each([&](double v, uint64_t count) {
        if (!std::isfinite(v)) {
            summary.not_finite += count;
            return;
        }
        summary.min = std::min(summary.min, v);
        summary.max = std::max(summary.max, v);
        if (v == 0) summary.zeros += count;
        if (!has_labels) return;
        if (run > 0 && v == last) {
            run += count;
            return;
        }
        count_run();
        if (v != std::floor(v) || std::abs(v) > 1e9 || summary.labels.size() > kMaxLabels) {
            has_labels = false;
            return;
        }
        last = int(v);
        run = count;
    });
    count_run();
    if (!has_labels || summary.labels.size() > kMaxLabels) summary.labels.clear();
    if (!(summary.min < summary.max)) {
        summary.threshold = summary.min;
        return summary;
    }
    std::array<uint64_t, kBins> bins{};
    const double width = (summary.max - summary.min) / kBins;
    // Ranges too large or too small for normal numbers have no bins.
    if (!std::isnormal(width)) {
        summary.threshold = std::isinf(width) ? summary.min / 2 + summary.max / 2 : summary.max;
        return summary;
    }
    for_each([&](double v, uint64_t count) {
        if (std::isfinite(v)) bins[std::min(size_t((v - summary.min) / width), kBins - 1)] += count;
    });
    summary.threshold = summary.min + otsu_bin(bins) * width;
    return summary;
}

/// Counts 8-bit values, of which many in a row are often equal. Neighbouring cells have counters of
/// their own, since each counter waits for its last update.
void count_bytes(const uint8_t* values, size_t count, std::vector<uint64_t>& counts) {
    std::array<std::array<uint32_t, 256>, 4> apart{};
    size_t i = 0;
    for (; i + 8 <= count; i += 8) {
        uint64_t eight = 0;
        std::memcpy(&eight, values + i, 8);
        if (eight == values[i] * 0x0101010101010101u) {
            counts[values[i]] += 8;
            continue;
        }
        for (size_t k = 0; k < 8; ++k) ++apart[k % 4][eight >> 8 * k & 255];
    }
    for (; i < count; ++i) ++counts[values[i]];
    for (const auto& some : apart)
        for (size_t value = 0; value < some.size(); ++value) counts[value] += some[value];
}

/// The number of times that each 8-bit or 16-bit code occurs. 512^3 bytes take 40 ms, and 1 s if
/// they are counted one by one.
std::vector<uint64_t> count_codes(const CellArray& array) {
    const InputFile file(array.data);
    const size_t layer = size_t(array.counts.x) * size_t(array.counts.y);
    const bool is_byte = bytes_of(array.type) == 1;
    std::vector<uint64_t> all(is_byte ? 256 : 65536);
    std::mutex mutex;
    for_layer_ranges(array, 1, [&](int first, int end) {
        ArraySlabs slabs(array, file, 1, first, end);
        std::vector<uint64_t> counts(all.size());
        while (slabs.next() > 0) {
            if (is_byte) {
                count_bytes(reinterpret_cast<const uint8_t*>(slabs.values()), layer, counts);
                continue;
            }
            const auto* codes = reinterpret_cast<const uint16_t*>(slabs.values());
            for (size_t i = 0; i < layer; ++i) ++counts[codes[i]];
        }
        const std::scoped_lock lock(mutex);
        for (size_t code = 0; code < all.size(); ++code) all[code] += counts[code];
    });
    return all;
}

/// Calls `use` with the value of each code that occurs, and with its count.
template <class Use>
void for_each_code(const CellArray& array, const std::vector<uint64_t>& counts, const Use& use) {
    const bool is_signed = array.type == CellType::i8 || array.type == CellType::i16;
    for (size_t code = 0; code < counts.size(); ++code) {
        if (counts[code] == 0) continue;
        const bool is_negative = is_signed && code >= counts.size() / 2;
        const double value = double(code) - (is_negative ? double(counts.size()) : 0.0);
        use(array.slope * value + array.intercept, counts[code]);
    }
}

}  // namespace

ArraySummary summary_of_array(const CellArray& array) {
    if (array.is_color()) InputFile(array.data).refuse("it holds colours, which have no values");
    // Values that are fewer than their codes are looked at one by one.
    const size_t bytes = bytes_in_memory(array.type);
    if (bytes <= 2 && array.cells() >= size_t{1} << 8 * bytes) {
        const std::vector<uint64_t> counts = count_codes(array);
        return summary_of([&](const auto& use) { for_each_code(array, counts, use); });
    }
    return summary_of(
        [&](const auto& use) { for_each_value(array, [&](double v) { use(v, uint64_t{1}); }); });
}

double largest_color(const CellArray& array, double enough) {
    const InputFile file(array.data);
    ArraySlabs slabs(array, file, 1);
    const size_t cells = size_t(array.counts.x) * size_t(array.counts.y),
                 channels = size_t(array.channels);
    double largest = 0;
    while (largest <= enough && slabs.next() > 0)
        for (size_t plane = 0; plane < (array.is_planar ? channels : 1); ++plane)
            with_type(array.type, slabs.values(int(plane)), [&](const auto* values) {
                const size_t count = array.is_planar ? cells : cells * channels;
                for (size_t i = 0; i < count && largest <= enough; ++i)
                    largest = std::max(largest, double(values[i]));  // NaN is none
            });
    return largest;
}

bool has_color_masks(const CellArray& array) {
    if (!array.is_color() || is_float(array.type)) return false;
    return array.type == CellType::boolean || largest_color(array, 1) == 1;
}

uint32_t label_color(int label) {
    // Hues by the golden angle, so that neighbours differ; two lightnesses in turn.
    const double hue = std::fmod(std::abs(double(label)) * 0.381966 * 6, 6.0);
    const double low = label % 2 == 0 ? 0.25 : 0.45, high = 0.92;
    uint32_t color = 0;
    for (int c = 0; c < 3; ++c) {
        const double at = std::fmod(hue + 4.0 * c + 6, 6.0);
        const double part = std::clamp(2 - std::abs(at - 3), 0.0, 1.0);
        const double share = 1 - part;
        color |= uint32_t(std::lround(255 * (low + (high - low) * share))) << 8 * c;
    }
    return color;
}

}  // namespace voxelume
