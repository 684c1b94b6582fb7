// SPDX-License-Identifier: Apache-2.0
// A summary of a KV6 file.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

namespace voxelume {

struct Kv6Summary {
    std::array<int32_t, 3> size{};  ///< voxels along x, y and z, which points down
    uint64_t voxels = 0;
    bool has_palette = false;
};

/// Reads a KV6 file whole. Throws Error::input for one that is missing, truncated or damaged: whose
/// counts disagree with each other or with the file's size, or whose voxels lie outside.
Kv6Summary read_kv6_summary(const std::filesystem::path& path);

}  // namespace voxelume
