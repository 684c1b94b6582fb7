// SPDX-License-Identifier: Apache-2.0
// The rule by which `index` keeps the cells of a distance field, as documented, and fields to test
// it with.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>

#include "tests/support/brick_grids.hpp"

namespace voxelume {

inline constexpr std::array<glm::ivec3, 3> kAxes = {glm::ivec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// Twice D of the edge from node `n` along `axis`, as voxel.h defines D.
inline int twice_d(const NodeDistance& f, const glm::ivec3& n, int axis) {
    const glm::ivec3 a = kAxes[size_t(axis)];
    const int values[] = {f(n - a), f(n), f(n + a), f(n + a + a)};
    for (const int value : values)
        if (std::abs(value) == 32767) return 0;
    return values[2] - values[0] - values[3] + values[1];
}

/// The corner of cell `c` where edge `e` (0..3) of `axis` begins.
inline glm::ivec3 edge_start(const glm::ivec3& c, int axis, int e) {
    const glm::ivec3 offsets[] = {{0, e % 2, e / 2}, {e % 2, 0, e / 2}, {e % 2, e / 2, 0}};
    return c + offsets[axis];
}

/// True if the documented rule keeps the cell.
inline bool rule_keeps(const NodeDistance& f, const glm::ivec3& c) {
    int low = 32767, high = -32767, unsaturated = 0;
    for (int i = 0; i < 8; ++i) {
        const int value = f(c + glm::ivec3{i % 2, i / 2 % 2, i / 4});
        low = std::min(low, value);
        high = std::max(high, value);
        unsaturated += std::abs(value) != 32767;
    }
    int twice = 0;  // the sum of the largest |2D|
    for (int axis = 0; axis < 3; ++axis) {
        int largest = 0;
        for (int e = 0; e < 4; ++e)
            largest = std::max(largest, std::abs(twice_d(f, edge_start(c, axis, e), axis)));
        twice += largest;
    }
    const double m = (twice + twice / 128 + 16) / 16.0;
    return unsaturated > 0 && low - m <= 0 && high + m >= 0;
}

inline VoxelMap cells_by_rule(const glm::ivec3& size, const NodeDistance& f, uint32_t word) {
    VoxelMap cells;
    for (glm::ivec3 c{0}; c.z < size.z; ++c.z)
        for (c.y = 0; c.y < size.y; ++c.y)
            for (c.x = 0; c.x < size.x; ++c.x)
                if (rule_keeps(f, c)) cells[c] = word;
    return cells;
}

/// The value of D in its ten bits.
inline int second_difference(uint32_t bits) {
    const int size = (64 + int(bits % 64)) * (1 << bits / 64 % 8) - 64;
    return bits / 512 ? -size : size;
}

/// The bits of the second difference nearest to D, given 2D. Searches all, and takes the even one
/// of two that are equally near.
inline uint32_t nearest_bits(int twice) {
    uint32_t best = twice < 0 ? 512 : 0;
    const uint32_t first = best;
    for (uint32_t bits = first; bits < first + 512; ++bits) {
        const int off = std::abs(2 * second_difference(bits) - twice);
        const int minimum = std::abs(2 * second_difference(best) - twice);
        if (off < minimum || (off == minimum && bits % 2 == 0)) best = bits;
    }
    return best;
}

/// The rounded second differences of cell `c`'s edges, by axis and edge.
using EdgeDifferences = std::array<std::array<int, 4>, 3>;

inline EdgeDifferences rounded_differences(const NodeDistance& f, const glm::ivec3& c) {
    EdgeDifferences differences;
    for (int axis = 0; axis < 3; ++axis)
        for (int e = 0; e < 4; ++e)
            differences[size_t(axis)][size_t(e)] =
                second_difference(nearest_bits(twice_d(f, edge_start(c, axis, e), axis)));
    return differences;
}

/// The half-Taylor interpolation in cell `c` at `s`, with its `differences` rounded as in records.
inline double interpolate(const NodeDistance& f, const EdgeDifferences& differences,
                          const glm::ivec3& c, const glm::dvec3& s) {
    const double w[3][2] = {{1 - s.x, s.x}, {1 - s.y, s.y}, {1 - s.z, s.z}};
    double sum = 0;
    for (int i = 0; i < 8; ++i)
        sum += w[0][i % 2] * w[1][i / 2 % 2] * w[2][i / 4] *
               f(c + glm::ivec3{i % 2, i / 2 % 2, i / 4});
    for (int axis = 0; axis < 3; ++axis)
        for (int e = 0; e < 4; ++e) {
            const int first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
            sum += 0.5 * s[axis] * (1 - s[axis]) * w[first][e % 2] * w[second][e / 2] *
                   differences[size_t(axis)][size_t(e)];
        }
    return sum;
}

/// The distance to a torus in stored units. Outside the table it is outside, as in missing bricks.
inline NodeDistance torus(const glm::ivec3& size) {
    const glm::ivec3 nodes = (size / 16 + 1) * 16;
    return [=](const glm::ivec3& n) -> int16_t {
        if (n.x < 0 || n.y < 0 || n.z < 0 || n.x >= nodes.x || n.y >= nodes.y || n.z >= nodes.z)
            return 32767;
        const glm::dvec3 p = glm::dvec3(n) - glm::dvec3{33.2, 17.7, 29.4};
        const double ring = std::hypot(p.x, p.z) - 20.1;
        return stored_distance(std::hypot(ring, p.y) - 7.3);
    };
}

/// Smooth noise that isn't a distance field, with steps of up to six voxels and saturated nodes.
inline NodeDistance wild_field(uint32_t seed, const glm::ivec3& nodes, int lowest = -22000) {
    std::mt19937 random(seed);
    std::vector<int16_t> values(size_t(nodes.x * nodes.y * nodes.z));
    for (int16_t& value : values) {
        const int sort = int(random() % 8);
        value = sort == 0 ? int16_t(32767)
                : sort == 1 && lowest < 0
                    ? int16_t(-32767)
                    : int16_t(int(random() % uint32_t(32767 - lowest)) + lowest);
    }
    return [=](const glm::ivec3& n) -> int16_t {
        if (n.x < 0 || n.y < 0 || n.z < 0 || n.x >= nodes.x || n.y >= nodes.y || n.z >= nodes.z)
            return 32767;
        return values[size_t(n.x + nodes.x * (n.y + nodes.y * n.z))];
    };
}

}  // namespace voxelume
