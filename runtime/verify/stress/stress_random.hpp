// SPDX-License-Identifier: Apache-2.0
// Random numbers by case number: case n of a seed is the same whichever other cases are tried.
#pragma once

#include <cstdint>

namespace voxelume {

/// The generator of Steele, Lea and Flood 2014 (SplitMix64), seeded again for every case.
class StressRandom {
  public:
    StressRandom(uint64_t seed, uint64_t stream, uint64_t number)
        : state_(mix(mix(seed + 0x9E3779B97F4A7C15u) ^ mix(stream * 0xD1B54A32D192ED03u + 1)) +
                 number * 0x2545F4914F6CDD1Du) {}

    uint64_t next() { return mix(state_ += 0x9E3779B97F4A7C15u); }
    /// A number of 0 .. n-1.
    uint64_t below(uint64_t n) { return (next() >> 32) * n >> 32; }
    /// A number of low .. high, both included.
    int64_t between(int64_t low, int64_t high) {
        return low + int64_t(below(uint64_t(high - low) + 1));
    }
    /// A number in [low, high).
    double uniform(double low, double high) {
        return low + (high - low) * (double(next() >> 11) * 0x1p-53);
    }
    int sign() { return next() & 1u << 20 ? 1 : -1; }

  private:
    static uint64_t mix(uint64_t z) {
        z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
        z = (z ^ z >> 27) * 0x94D049BB133111EBu;
        return z ^ z >> 31;
    }
    uint64_t state_;
};

}  // namespace voxelume
