// SPDX-License-Identifier: Apache-2.0
#include "cli/output/shard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>

#include "cli/shared/checks.hpp"

namespace voxelume::cli {

Shard parse_shard(const std::string& text) {
    constexpr int kMaxCount = 1'000'000;
    Shard shard;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%8d/%8d%c", &shard.number, &shard.count, &rest) != 2 ||
        shard.number < 1 || shard.count > kMaxCount || shard.number > shard.count)
        fail_usage(
            "render: --shard {}: give I/N, the part's number from 1 to N and that of all "
            "parts, like 2/8",
            text);
    return shard;
}

std::string text_of(const Shard& shard) {
    return fmt::format("{} of {}", shard.number, shard.count);
}

std::vector<FrameFiles> frames_of(const Shard& shard, const std::vector<FrameFiles>& frames) {
    std::vector<FrameFiles> own;
    for (size_t i = size_t(shard.number) - 1; i < frames.size(); i += size_t(shard.count))
        own.push_back(frames[i]);
    return own;
}

std::array<int, 2> rows_of(const Shard& shard, int height) {
    constexpr int kTile = 4;
    const int64_t tiles = (height + kTile - 1) / kTile;
    const auto row = [&](int64_t parts) {
        return int(std::min<int64_t>(tiles * parts / shard.count * kTile, height));
    };
    return {row(shard.number - 1), row(shard.number)};
}

}  // namespace voxelume::cli
