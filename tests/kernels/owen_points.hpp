// SPDX-License-Identifier: Apache-2.0
// Sobol's sequence and Owen's scrambling, bit by bit according to their definitions.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace voxelume {

struct SquarePoint {
    double x, y;
    bool operator==(const SquarePoint&) const = default;
};

using Bits = std::array<bool, 32>;  ///< the highest first

inline Bits bits_of(uint32_t value) {
    Bits bits;
    for (int i = 0; i < 32; ++i) bits[size_t(i)] = value >> (31 - i) & 1;
    return bits;
}

inline uint32_t value_of(const Bits& bits) {
    uint32_t value = 0;
    for (const bool bit : bits) value = 2 * value + bit;
    return value;
}

/// The hashes of Murmur and Burley, the only part that every implementation must repeat.
inline uint32_t mixed(uint32_t v) {
    uint64_t w = v ^ v / 65536;
    w = w * 0x85EBCA6B % 0x100000000;
    w = (w ^ w / 8192) * 0xC2B2AE35 % 0x100000000;
    return uint32_t(w ^ w / 65536);
}
inline uint32_t hashed(uint32_t v, uint32_t seed) {
    uint64_t w = (uint64_t(v) + seed) % 0x100000000;
    for (const uint64_t factor : {0x6C50B47Cu, 0xB82F1E52u, 0xC7AFE638u, 0x8D22F6E6u})
        w ^= w * factor % 0x100000000;
    return uint32_t(w);
}

/// Owen's scrambling as a tree: the path of the bits above a bit decides whether it is flipped.
inline Bits scrambled(const Bits& bits, uint32_t seed) {
    Bits result = bits;
    for (size_t i = 0; i < 32; ++i) {
        uint32_t above = 0;
        for (size_t k = 0; k < i; ++k) above |= uint32_t(bits[k]) << k;
        const bool flip = hashed(above, seed) >> i & 1;
        result[i] = bits[i] != flip;
    }
    return result;
}

/// Sobol's sequence from its direction numbers. For the second coordinate, each is its predecessor,
/// exclusive-or the predecessor halved.
inline std::array<uint32_t, 2> sobol(uint32_t index) {
    uint32_t x = 0, y = 0, along_x = 1u << 31, along_y = 1u << 31;
    for (; index != 0; index >>= 1) {
        if (index & 1) x ^= along_x, y ^= along_y;
        along_x >>= 1;
        along_y ^= along_y >> 1;
    }
    return {x, y};
}

/// The point of two coordinates of 32 bits, scrambled and cut to 24 bits.
inline SquarePoint owen_point(uint32_t x, uint32_t y, uint32_t seed) {
    const uint32_t seed_x = mixed(seed ^ 0xA511E9B3u);
    const uint32_t seed_y = seed_x % 65536 * 65536 + seed_x / 65536;
    const auto coordinate = [](uint32_t value, uint32_t of) {
        return std::floor(value_of(scrambled(bits_of(value), of)) / 256.0) / 16777216.0;
    };
    return {coordinate(x, seed_x), coordinate(y, seed_y)};
}

}  // namespace voxelume
