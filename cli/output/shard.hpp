// SPDX-License-Identifier: Apache-2.0
// The parts of a run that several processes share: which frames, or which rows of one image.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "runtime/voxelume.hpp"

namespace voxelume::cli {

/// One of `count` parts of a run.
struct Shard {
    int number = 1;  ///< from 1 on
    int count = 1;

    friend bool operator==(const Shard&, const Shard&) = default;
};

/// Reads "2/8". Throws Error::usage.
Shard parse_shard(const std::string& text);

/// "2 of 8".
std::string text_of(const Shard& shard);

/// Every count-th of the frames, from the number-th on: neighbours, which often take alike, are
/// dealt out.
std::vector<FrameFiles> frames_of(const Shard& shard, const std::vector<FrameFiles>& frames);

/// The first row of the part's and the one after its last, of `height` rows: whole tiles of four,
/// as equal in number as can be. None where there are more parts than tiles.
std::array<int, 2> rows_of(const Shard& shard, int height);

}  // namespace voxelume::cli
