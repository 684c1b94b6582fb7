// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/stamp.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "runtime/base/files/atomic_file.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

const std::string kHash = "0123456789abcdef0123456789abcdef";
const std::string kOther = "ff23456789abcdef0123456789abcdef";

class StampTest : public FileTest {
  protected:
    std::filesystem::path path() const { return folder / "frame"; }

    /// A file of 3 MB whose stamp lies behind a thousand bytes.
    void write_file() const {
        AtomicFile file(path());
        const std::string bytes =
            std::string(1000, 'h') + stamp_of(kHash) + '\0' + std::string(3 << 20, 'p');
        file.write(bytes.data(), bytes.size());
        file.commit();
    }
};

TEST_F(StampTest, AFileThatWasWrittenIsCurrentForItsHashAndStaleForOthers) {
    EXPECT_EQ(check_stamp(path(), kHash), StampState::missing);
    write_file();
    EXPECT_EQ(check_stamp(path(), kHash), StampState::current);
    EXPECT_EQ(check_stamp(path(), kOther), StampState::stale);
}

TEST_F(StampTest, AFileIsAsWrittenWhateverItWasMadeFrom) {
    EXPECT_EQ(is_as_written(path()), std::nullopt);
    write_file();
    EXPECT_EQ(is_as_written(path()), true);
    std::string bytes = bytes_of(path());
    bytes.back() ^= 1;
    put_bytes(path(), bytes);
    EXPECT_EQ(is_as_written(path()), false);
    put_bytes(path(), "another program's");
    EXPECT_EQ(is_as_written(path()), std::nullopt);
}

TEST_F(StampTest, AnyChangedByteOrLengthIsDamage) {
    write_file();
    const std::string bytes = bytes_of(path());
    for (const size_t at :
         {size_t(0), size_t(999), size_t(1070), size_t(2 << 20), bytes.size() - 1}) {
        std::string damaged = bytes;
        damaged[at] ^= 1;
        put_bytes(path(), damaged);
        EXPECT_EQ(check_stamp(path(), kHash), StampState::damaged) << at;
    }
    put_bytes(path(), bytes.substr(0, bytes.size() - 1));
    EXPECT_EQ(check_stamp(path(), kHash), StampState::damaged);
    put_bytes(path(), bytes + "x");
    EXPECT_EQ(check_stamp(path(), kHash), StampState::damaged);
    put_bytes(path(), bytes);
    EXPECT_EQ(check_stamp(path(), kHash), StampState::current);
}

TEST_F(StampTest, InAPngFileTheSumOfItsChunkIsCheckedToo) {
    const std::string bytes = std::string("\x89PNG\r\n\x1a\n", 8) + "....tEXtComment" + '\0' +
                              stamp_of(kHash) + "sum." + "other chunks";
    {
        AtomicFile file(path());
        file.write(bytes.data(), bytes.size());
        file.commit();
    }
    const std::string sealed = bytes_of(path());
    EXPECT_EQ(is_as_written(path()), true);
    EXPECT_EQ(sealed.find("sum."), std::string::npos);
    for (size_t at = 8; at < sealed.size(); ++at) {
        std::string damaged = sealed;
        damaged[at] = char(damaged[at] ^ 1);
        put_bytes(path(), damaged);
        EXPECT_NE(is_as_written(path()), true) << at;
    }
}

TEST_F(StampTest, WhatHasNoSealedStampIsDamaged) {
    for (const std::string& bytes :
         {std::string(), std::string("voxelume-frame="), "x" + stamp_of(kHash),
          "voxelume-frame=" + kHash + " check=xyz"}) {
        put_bytes(path(), bytes);
        EXPECT_EQ(check_stamp(path(), kHash), StampState::damaged) << bytes;
    }
    std::filesystem::remove(path());
    std::filesystem::create_directory(path());
    EXPECT_EQ(check_stamp(path(), kHash), StampState::damaged);
}

TEST_F(StampTest, AFileThatCantBeReadIsToldFromOneWithoutAStamp) {
    const std::string bytes = stamp_of(kHash) + std::string(3 << 20, 'p');
    const auto all_but = [&bytes](uint64_t unreadable) {
        return [&bytes, unreadable](uint64_t at, char* data, size_t size) {
            if (at <= unreadable && unreadable < at + size) throw std::runtime_error("broken");
            bytes.copy(data, size, at);
        };
    };
    EXPECT_TRUE(seal_of(bytes.size(), all_but(bytes.size())).has_value());
    EXPECT_THROW(seal_of(bytes.size(), all_but(0)), std::runtime_error);
    EXPECT_THROW(seal_of(bytes.size(), all_but(2 << 20)), std::runtime_error);
    const auto none = [](uint64_t, char* data, size_t size) { std::fill_n(data, size, 'n'); };
    EXPECT_FALSE(seal_of(1000, none).has_value());
}

TEST_F(StampTest, BytesInMemoryAreSealedLikeFiles) {
    std::string bytes = "head " + stamp_of(kHash) + " tail";
    EXPECT_TRUE(seal(bytes));
    put_bytes(path(), bytes);
    EXPECT_EQ(check_stamp(path(), kHash), StampState::current);
    std::string none = "head and tail";
    EXPECT_FALSE(seal(none));
    EXPECT_EQ(none, "head and tail");
}

}  // namespace
}  // namespace voxelume
