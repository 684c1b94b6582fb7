// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/written_blocks.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <string>

namespace voxelume {
namespace {

constexpr size_t kBlock = size_t{1} << 16;

std::string random_bytes(std::mt19937& random, size_t size) {
    std::string bytes(size, '\0');
    for (char& byte : bytes) byte = char(random());
    return bytes;
}

/// A file in memory beside what is said of it.
struct Writer {
    WrittenBlocks blocks;
    std::string file;

    bool put(size_t position, const std::string& bytes) {
        const auto read = [this](uint64_t at, char* data, size_t size) {
            ASSERT_LE(at + size, file.size());
            std::memcpy(data, &file[at], size);
        };
        if (!blocks.put(position, bytes.data(), bytes.size(), read)) return false;
        if (file.size() < position + bytes.size()) file.resize(position + bytes.size());
        if (!bytes.empty()) std::memcpy(&file[position], bytes.data(), bytes.size());
        return true;
    }
    bool matches(const std::string& bytes) const {
        return bytes.size() == blocks.size() && blocks.match(0, bytes.data(), bytes.size());
    }
};

TEST(WrittenBlocks, MatchWhateverIsWrittenInAnyOrder) {
    for (uint32_t seed = 0; seed < 20; ++seed) {
        std::mt19937 random(seed);
        Writer writer;
        for (int i = 0; i < 20; ++i) {
            const size_t last = writer.file.size();
            const size_t position = random() % 3 == 0 ? random() % (last + 1000) : last;
            const size_t size = random() % (random() % 4 == 0 ? 3 * kBlock : 100);
            ASSERT_TRUE(writer.put(position, random_bytes(random, size))) << seed;
            ASSERT_EQ(writer.blocks.size(), writer.file.size()) << seed;
        }
        EXPECT_TRUE(writer.matches(writer.file)) << seed;
    }
}

TEST(WrittenBlocks, TellAnyOtherByte) {
    std::mt19937 random(25);
    Writer writer;
    ASSERT_TRUE(writer.put(0, random_bytes(random, 2 * kBlock + 5)));
    ASSERT_TRUE(writer.put(kBlock - 2, "four"));
    ASSERT_TRUE(writer.put(2 * kBlock + 1, "x"));
    ASSERT_TRUE(writer.matches(writer.file));
    for (const size_t at : {size_t(0), kBlock - 1, kBlock + 1, 2 * kBlock - 1, 2 * kBlock,
                            2 * kBlock + 1, 2 * kBlock + 4}) {
        std::string changed = writer.file;
        changed[at] = char(changed[at] ^ 1);
        EXPECT_FALSE(writer.matches(changed)) << at;
    }
}

TEST(WrittenBlocks, APatchOfABlockThatHasChangedIsRefused) {
    std::mt19937 random(25);
    Writer writer;
    ASSERT_TRUE(writer.put(0, random_bytes(random, 2 * kBlock)));
    writer.file[7] = char(writer.file[7] ^ 1);
    EXPECT_TRUE(writer.put(kBlock + 3, "other"));
    EXPECT_FALSE(writer.put(3, "same block"));
    EXPECT_TRUE(writer.put(0, random_bytes(random, kBlock)));  // all of it
    EXPECT_TRUE(writer.matches(writer.file));
}

}  // namespace
}  // namespace voxelume
