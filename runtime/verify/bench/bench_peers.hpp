// SPDX-License-Identifier: Apache-2.0
// Times of other programs for the same rays, from a file that tests/bench/bench_peers writes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace voxelume {

/// Another program's result on one scene with one setting of its fineness.
struct BenchPeerRow {
    std::string program;  ///< name and version
    std::string scene;    ///< name as in `bench_entries`
    std::string setting;  ///< text for people: "1,024 triangles", "voxels of 10 mm"
    double build_seconds = 0;
    double trace_seconds = 0;
    double depth_rms = 0;  ///< metres
    double depth_max = 0;
    double normal_rms = 0;     ///< degrees
    uint64_t other_parts = 0;  ///< pixels that the errors leave out, as in `BenchErrors`

    double total_seconds() const { return build_seconds + trace_seconds; }
};

/// Reads a file of rows that were measured with images of `size` pixels. Throws Error::input for a
/// file that is missing, isn't such a file, names an unknown scene or has another image size.
std::vector<BenchPeerRow> read_peers(const std::filesystem::path& file, glm::ivec2 size);

struct BenchReport;
struct BenchRow;

/// The quickest row of the peer's scene whose depth RMS is at most the peer's; null if there is
/// none.
const BenchRow* row_as_accurate(const BenchReport& report, const BenchPeerRow& peer);

}  // namespace voxelume
