// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/voxels/model_file.hpp"

#include <gmock/gmock.h>
#include <xxhash.h>

#include <bit>
#include <cstring>
#include <random>

#include "tests/io/little_endian.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {

using testing::HasSubstr;

namespace {

ModelFile small_model() {
    ModelFile model;
    model.header = {{"format", "smooth 1"}, {"origin", "-0.5 0.25 1e-3"}, {"size", "7 5 3"}};
    std::mt19937_64 random(42);
    std::vector<uint64_t> masks(105);
    for (uint64_t& mask : masks) mask = random();
    std::vector<float> distances(31);
    for (float& d : distances)
        d = std::bit_cast<float>(static_cast<uint32_t>(random() & 0xbfffffff));
    model.arrays["masks"] = masks;
    model.arrays["distances"] = distances;
    model.arrays["field"] = std::vector<int16_t>{-32768, -1, 0, 1, 32767};
    model.arrays["materials"] = std::vector<uint8_t>(100000, 7);
    model.arrays["triangles"] = std::vector<uint32_t>{0, 1, 4294967295u};
    model.arrays["nothing"] = std::vector<float>{};
    return model;
}

}  // namespace

class ModelFileTest : public FileTest {
  protected:
    std::filesystem::path path() const { return folder / "a.vxm"; }
};

TEST_F(ModelFileTest, EveryBitComesBack) {
    const ModelFile model = small_model();
    write_model_file(path(), model);
    const ModelFile back = read_model_file(path());
    EXPECT_EQ(back.header, model.header);
    EXPECT_EQ(back.arrays, model.arrays);
}

TEST_F(ModelFileTest, AnEmptyModelComesBack) {
    write_model_file(path(), {});
    EXPECT_TRUE(read_model_file(path()).arrays.empty());
    EXPECT_EQ(std::filesystem::file_size(path()), 40u);
}

TEST_F(ModelFileTest, TheSameModelGivesTheSameBytes) {
    write_model_file(path(), small_model());
    write_model_file(folder / "b.vxm", small_model());
    EXPECT_EQ(bytes_of(path()), bytes_of(folder / "b.vxm"));
}

TEST_F(ModelFileTest, TheLayoutIsTheDocumentedOne) {
    ModelFile model;
    model.header["k"] = "value";
    model.arrays["a"] = std::vector<int16_t>{1, 2, 3};
    write_model_file(path(), model);
    const std::string bytes = bytes_of(path());
    EXPECT_EQ(bytes.substr(0, 8), std::string("\x89VXM\r\n\x1a\n", 8));
    EXPECT_EQ(u32_at(bytes, 8), 1u);
    EXPECT_EQ(u32_at(bytes, 12), 1u);
    EXPECT_EQ(u32_at(bytes, 16), 1u);
    EXPECT_EQ(u32_at(bytes, 20), uint32_t(XXH3_64bits(&bytes[95], bytes.size() - 95)));
    EXPECT_EQ(u32_at(bytes, 24), 14u + 41u);
    EXPECT_EQ(bytes.substr(40, 14), std::string("\x01\0\0\0k\x05\0\0\0value", 14));
    EXPECT_EQ(bytes.substr(54, 5), std::string("\x01\0\0\0a", 5));
    EXPECT_EQ(u32_at(bytes, 59), 1u);
    EXPECT_EQ(u32_at(bytes, 63), 3u);
    EXPECT_EQ(u32_at(bytes, 71), 95u);
    EXPECT_EQ(u32_at(bytes, 79), bytes.size() - 95);
}

TEST_F(ModelFileTest, TheSummaryNeedsNoElements) {
    write_model_file(path(), small_model());
    const ModelSummary summary = read_model_summary(path());
    EXPECT_EQ(summary.header.at("size"), "7 5 3");
    EXPECT_EQ(summary.arrays.at("materials").count, 100000u);
    EXPECT_LT(summary.arrays.at("materials").compressed_bytes, 100u);
    EXPECT_STREQ(element_name(summary.arrays.at("masks").type), "u64");
}

TEST_F(ModelFileTest, AnyTruncationIsAnInputError) {
    write_model_file(path(), small_model());
    const std::string bytes = bytes_of(path());
    for (size_t length = 0; length < bytes.size(); length += 17) {
        put_bytes(path(), bytes.substr(0, length));
        EXPECT_EQ(error_of([&] { read_model_file(path()); }).exit_code(), 4) << length;
    }
}

TEST_F(ModelFileTest, AnyChangedByteIsAnInputError) {
    write_model_file(path(), small_model());
    const std::string bytes = bytes_of(path());
    for (size_t i = 0; i < bytes.size(); i += 5) {
        std::string damaged = bytes;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
        put_bytes(path(), damaged);
        // Bits of a frame's header may change without an effect on its content; then the read
        // content has to be right.
        try {
            EXPECT_EQ(read_model_file(path()).arrays, small_model().arrays) << i;
        } catch (const Error& error) {
            EXPECT_EQ(error.exit_code(), 4) << i;
        }
    }
}

TEST_F(ModelFileTest, IsAsWrittenWhereNoBitOfAnyByteIsFlipped) {
    write_model_file(path(), small_model());
    const std::string bytes = bytes_of(path());
    EXPECT_TRUE(is_model_as_written(path()));
    for (size_t i = 0; i < bytes.size(); i += 3) {
        std::string damaged = bytes;
        damaged[i] = static_cast<char>(damaged[i] ^ (1 << i % 8));
        put_bytes(path(), damaged);
        EXPECT_FALSE(is_model_as_written(path())) << i;
    }
    put_bytes(path(), bytes + "x");
    EXPECT_FALSE(is_model_as_written(path()));
    put_bytes(path(), bytes);
    EXPECT_TRUE(is_model_as_written(path()));
}

TEST_F(ModelFileTest, ThatIsOlderAndHasNoSumOfItsDataIsAsWrittenByItsContent) {
    write_model_file(path(), small_model());
    std::string bytes = bytes_of(path());
    std::memset(&bytes[20], 0, 4);
    const std::string checked = bytes.substr(0, 32) + bytes.substr(40, u32_at(bytes, 24));
    const uint64_t checksum = XXH3_64bits(checked.data(), checked.size());
    std::memcpy(&bytes[32], &checksum, sizeof checksum);
    put_bytes(path(), bytes);
    EXPECT_TRUE(is_model_as_written(path()));
    EXPECT_EQ(read_model_file(path()).arrays, small_model().arrays);
}

TEST_F(ModelFileTest, ALieAboutTheSizeTakesNoMemory) {
    ModelFile model;
    model.arrays["a"] = std::vector<uint8_t>{1, 2, 3};
    write_model_file(path(), model);
    std::string bytes = bytes_of(path());
    bytes[40 + 5 + 4 + 6] = 1;  // 2^48 elements
    std::string checked = bytes.substr(0, 32) + bytes.substr(40, 41);
    const uint64_t checksum = XXH3_64bits(checked.data(), checked.size());
    std::memcpy(bytes.data() + 32, &checksum, sizeof checksum);
    put_bytes(path(), bytes);
    EXPECT_THAT(error_of([&] { read_model_file(path()); }).what(),
                HasSubstr("array a declares more elements than it can hold"));
}

TEST_F(ModelFileTest, ALaterVersionSaysWhatToDo) {
    write_model_file(path(), {});
    std::string bytes = bytes_of(path());
    bytes[8] = 2;
    put_bytes(path(), bytes);
    EXPECT_THAT(error_of([&] { read_model_file(path()); }).what(),
                HasSubstr("a model of version 2, and this voxelume reads version 1"));
}

TEST_F(ModelFileTest, AnotherFileIsNotAModel) {
    put_bytes(path(), std::string(100, 'o'));
    EXPECT_THAT(error_of([&] { read_model_file(path()); }).what(),
                HasSubstr("not a voxelume model"));
}

TEST_F(ModelFileTest, AFullDiskLeavesNothing) {
    const FileSizeLimit full(500);
    EXPECT_EQ(error_of([&] { write_model_file(path(), small_model()); }).exit_code(), 5);
    EXPECT_EQ(files_in_folder(), 0u);
}

}  // namespace voxelume
