// SPDX-License-Identifier: Apache-2.0
// Times of other programs for the same rays and scenes, from a file that tests/bench/bench_peers or
// tests/bench/peers/path_peers.py writes.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runtime/verify/bench/bench_global.hpp"

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

/// The measurements of other programs.
struct PeerResults {
    std::vector<BenchPeerRow> rows;
    glm::ivec2 size{0};  ///< pixels of the images of `rows`; 0: the file has none
    std::vector<GlobalRow> global_rows;
    /// By the names of scenes of `global_rows`: two OpenEXR files, the references with which the
    /// pictures of all programs are compared. Not every scene has them.
    std::map<std::string, std::array<std::filesystem::path, 2>> references;
};

/// Reads a file of rows. Throws Error::input for a file that is missing, isn't such a file, or has
/// depths of an unknown scene.
PeerResults read_peers(const std::filesystem::path& file);

/// Throws Error::input for depths that were measured with images of other sizes.
void check_size(const PeerResults& peers, const std::filesystem::path& file, glm::ivec2 size);

struct BenchReport;
struct BenchRow;

/// The quickest row of the peer's scene whose depth RMS is at most the peer's; null if there is
/// none.
const BenchRow* row_as_accurate(const BenchReport& report, const BenchPeerRow& peer);

}  // namespace voxelume
