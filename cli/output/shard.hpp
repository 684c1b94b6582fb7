// SPDX-License-Identifier: Apache-2.0
// The parts of a run that several processes share: some of the frames, or some rows of one image.
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

/// Reads a text such as "2/8". Throws Error::usage.
Shard parse_shard(const std::string& text);

/// A text such as "2 of 8".
std::string text_of(const Shard& shard);

/// Every count-th frame, from the number-th on: neighbouring frames, which often take equally long,
/// go to different parts.
std::vector<FrameFiles> frames_of(const Shard& shard, const std::vector<FrameFiles>& frames);

/// The part's first row and the one after its last, of `height` rows. Parts consist of whole tiles
/// of four rows, in numbers as equal as possible. A part is empty if there are more parts than
/// tiles.
std::array<int, 2> rows_of(const Shard& shard, int height);

}  // namespace voxelume::cli
