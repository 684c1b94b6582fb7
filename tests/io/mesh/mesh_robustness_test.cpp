// SPDX-License-Identifier: Apache-2.0
// Damaged mesh files: each gives a valid Mesh or an error's sentence, never a crash.
#include "runtime/base/error.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "tests/io/mesh/mesh_samples.hpp"
#include "tests/support/mesh_invariants.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

namespace voxelume {
namespace {

namespace fs = std::filesystem;

/// True if the bytes are read as a mesh. Expects a valid mesh, or an input error that names the
/// file.
bool is_read(const std::string& bytes, const std::string& name) {
    try {
        EXPECT_EQ(broken_invariant(parse_mesh(bytes, name)), "");
        return true;
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
        EXPECT_TRUE(std::string(error.what()).starts_with(name)) << error.what();
        return false;
    }
}

std::vector<samples::Sample> every_sample() {
    std::vector<samples::Sample> every = samples::all(false);
    for (samples::Sample& sample : samples::all(true)) {
        every.push_back(std::move(sample));
    }
    return every;
}

}  // namespace

TEST(DamagedMesh, EveryTruncationIsSurvived) {
    for (const auto& [name, bytes] : every_sample()) {
        for (size_t length = 0; length < bytes.size(); ++length) {
            const bool read = is_read(bytes.substr(0, length), name);
            ASSERT_FALSE(HasFailure()) << name << " cut to " << length << " bytes";
            // OBJ has no end that could be missing; ascii STL may lose the name after "endsolid",
            // and ascii PLY its last newline.
            if (!name.ends_with(".obj")) {
                const size_t optional = name == "ascii.stl" ? 11 : name == "ascii.ply" ? 1 : 0;
                ASSERT_EQ(read, length + optional >= bytes.size())
                    << name << " cut to " << length << " of " << bytes.size() << " bytes";
            }
        }
    }
}

TEST(DamagedMesh, FlippedBytesAreSurvived) {
    constexpr unsigned kSeed = 41;
    constexpr int kFlips = 2000;
    for (const auto& [name, bytes] : every_sample()) {
        std::mt19937 random(kSeed);
        for (int flip = 0; flip < kFlips; ++flip) {
            std::string damaged = bytes;
            for (auto left = 1 + random() % 3; left > 0; --left) {
                damaged[random() % damaged.size()] = static_cast<char>(random());
            }
            is_read(damaged, name);
            ASSERT_FALSE(HasFailure()) << name << ", seed " << kSeed << ", flip " << flip;
        }
    }
}

TEST(DamagedMesh, AssimpsTestModelsAreReadOrRefused) {
    const fs::path folder = "/usr/share/assimp/models";
    if (!fs::is_directory(folder)) {
        GTEST_SKIP() << "Debian's assimp-testmodels is not installed";
    }
    int read = 0;
    int refused = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        std::string extension = entry.path().extension().string();
        for (char& c : extension) {
            c = static_cast<char>(c | ' ');
        }
        if (extension != ".obj" && extension != ".ply" && extension != ".stl") {
            continue;
        }
        try {
            EXPECT_EQ(broken_invariant(read_mesh(entry.path())), "") << entry.path();
            ++read;
        } catch (const Error& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with(entry.path().string()))
                << error.what();
            ++refused;
        }
    }
    // The readers refuse the point clouds, the damaged files and a file whose coordinates are no
    // numbers.
    EXPECT_GE(read, 28);
    RecordProperty("read", read);
    RecordProperty("refused", refused);
}

}  // namespace voxelume
