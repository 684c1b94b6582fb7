// SPDX-License-Identifier: Apache-2.0
// KV6 files made by hand: what is right is summarized, and every count that disagrees is refused.
#include "runtime/io/volume/volume_kv6_read.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <cstring>

#include "runtime/io/volume_file.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/volume_samples.hpp"

namespace voxelume {

using testing::HasSubstr;

namespace {

template <class Value>
std::string bytes_of_value(Value value) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
}

/// A model of 2 x 3 x 9 voxels: two in column (0, 1), one in column (1, 2).
struct Kv6File {
    int32_t size[3] = {2, 3, 9};
    float pivot[3] = {1, 1.5f, 4.5f};
    int32_t count = 3;
    uint16_t z[3] = {4, 8, 0};
    uint8_t faces = 63;
    uint32_t of_x[2] = {2, 1};
    uint16_t of_xy[6] = {0, 2, 0, 0, 0, 1};
    std::string end;

    std::string bytes() const {
        std::string bytes = "Kvxl";
        for (const int32_t edge : size) bytes += bytes_of_value(edge);
        for (const float part : pivot) bytes += bytes_of_value(part);
        bytes += bytes_of_value(count);
        for (const uint16_t height : z)
            bytes += "bgr\x80" + bytes_of_value(height) + char(faces) + char(17);
        for (const uint32_t number : of_x) bytes += bytes_of_value(number);
        for (const uint16_t number : of_xy) bytes += bytes_of_value(number);
        return bytes + end;
    }
};

class Kv6Test : public FileTest {
  protected:
    std::filesystem::path path() const { return folder / "a.kv6"; }
    Kv6Summary summary(const std::string& bytes) const {
        put_bytes(path(), bytes);
        return read_kv6_summary(path());
    }
    template <class Change>
    void expect_refused(const Change& change, const char* reason) const {
        Kv6File file;
        change(file);
        const Error error = error_of([&] { summary(file.bytes()); });
        EXPECT_EQ(error.exit_code(), 4) << reason;
        EXPECT_THAT(error.what(), HasSubstr(reason));
    }
};

TEST_F(Kv6Test, AFileMadeByHandIsSummarized) {
    const Kv6Summary kv6 = summary(Kv6File().bytes());
    EXPECT_THAT(kv6.size, testing::ElementsAre(2, 3, 9));
    EXPECT_EQ(kv6.voxels, 3u);
    EXPECT_FALSE(kv6.has_palette);
}

TEST_F(Kv6Test, AFileOfOursIsSummarized) {
    write_volume(path(), lattice_volume());
    const Kv6Summary kv6 = read_kv6_summary(path());
    EXPECT_THAT(kv6.size, testing::ElementsAre(7, 3, 5));
    EXPECT_GT(kv6.voxels, 0u);
}

TEST_F(Kv6Test, APaletteIsKnown) {
    Kv6File file;
    file.end = "SPal" + std::string(768, '\x3f');
    EXPECT_TRUE(summary(file.bytes()).has_palette);
    expect_refused([](Kv6File& f) { f.end = "SPal" + std::string(768, '\x40'); }, "6 bits");
    expect_refused([](Kv6File& f) { f.end = "SPaL" + std::string(768, '\0'); }, "no palette");
    expect_refused([](Kv6File& f) { f.end = "SPal" + std::string(767, '\0'); }, "is damaged");
    expect_refused([](Kv6File& f) { f.end = "x"; }, "is damaged");
}

TEST_F(Kv6Test, CountsThatDisagreeAreRefused) {
    for (const int32_t edge : {0, -1, INT32_MIN, INT32_MAX, 65537})
        for (int axis = 0; axis < 3; ++axis)
            expect_refused([&](Kv6File& f) { f.size[axis] = edge; }, "its size along");
    for (const int32_t edge : {1, 4, 65536})
        expect_refused([&](Kv6File& f) { f.size[1] = edge; }, "is damaged");
    for (const int32_t count : {-1, INT32_MIN})
        expect_refused([&](Kv6File& f) { f.count = count; }, "is damaged");
    for (const int32_t count : {0, 2, 4, INT32_MAX})
        expect_refused([&](Kv6File& f) { f.count = count; }, "is damaged");
    expect_refused([](Kv6File& f) { f.pivot[1] = NAN; }, "pivot");
    expect_refused([](Kv6File& f) { f.of_x[0] = 1; }, "don't agree");
    expect_refused([](Kv6File& f) { f.of_x[1] = UINT32_MAX; }, "don't agree");
    expect_refused([](Kv6File& f) { f.of_xy[3] = 1; }, "more voxels");
    expect_refused([](Kv6File& f) { f.of_xy[0] = 65535; }, "more voxels");
    expect_refused([](Kv6File& f) { f.of_xy[5] = 0, f.of_x[1] = 0; }, "fewer voxels");
}

TEST_F(Kv6Test, VoxelsOutsideOrOutOfOrderAreRefused) {
    expect_refused([](Kv6File& f) { f.z[1] = 9; }, "ends at 9");
    expect_refused([](Kv6File& f) { f.z[2] = 65535; }, "ends at 9");
    expect_refused([](Kv6File& f) { f.z[1] = 4; }, "in order");
    expect_refused([](Kv6File& f) { f.faces = 64; }, "six faces");
}

TEST_F(Kv6Test, AnyTruncationIsRefused) {
    const std::string bytes = Kv6File().bytes();
    for (size_t size = 0; size < bytes.size(); ++size)
        EXPECT_EQ(error_of([&] { summary(bytes.substr(0, size)); }).exit_code(), 4) << size;
}

TEST_F(Kv6Test, WhatIsDeclaredTakesNoMemory) {
    // This is a sparse file, as large as its header says, in which nothing else agrees with the
    // header.
    Kv6File file;
    file.count = INT32_MAX;
    put_bytes(path(), file.bytes().substr(0, 32));
    std::filesystem::resize_file(path(), 32 + 8 * uint64_t(INT32_MAX) + 4 * 2 + 2 * 6);
    const auto start = std::chrono::steady_clock::now();
    EXPECT_THAT(error_of([&] { read_kv6_summary(path()); }).what(), HasSubstr("fewer voxels"));
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

}  // namespace
}  // namespace voxelume
