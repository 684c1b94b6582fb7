// SPDX-License-Identifier: Apache-2.0
// The hashes that the repository keeps in tests/golden/hashes.txt: each line has a name and its
// hash.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace voxelume {

inline std::string golden_hash(const std::string& wanted) {
    std::ifstream file(std::filesystem::path(VXL_SOURCE_DIR) / "tests/golden/hashes.txt");
    std::string name, hash;
    while (file >> name >> hash)
        if (name == wanted) return hash;
    return "none";
}

/// Fails if `hash` isn't the one that the repository has under `name`.
inline void expect_golden(const std::string& name, uint64_t hash) {
    EXPECT_EQ(fmt::format("{:016x}", hash), golden_hash(name))
        << name << ": if it was meant to change, look at what it stands for, run the slow "
        << "tests of it and write the hash to tests/golden/hashes.txt";
}

}  // namespace voxelume
