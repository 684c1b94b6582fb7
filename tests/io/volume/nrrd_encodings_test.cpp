// SPDX-License-Identifier: Apache-2.0
// NRRD arrays as text and in bzip2: all types of values, and what is refused.
#include <bzlib.h>
#include <gmock/gmock.h>

#include <random>

#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/io/arrays/array_files.hpp"
#include "runtime/io/arrays/array_stream.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/writers/array_writer.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

std::string bzipped(std::string data) {
    std::string packed(data.size() + data.size() / 100 + 600, '\0');
    auto size = unsigned(packed.size());
    EXPECT_EQ(
        BZ2_bzBuffToBuffCompress(packed.data(), &size, data.data(), unsigned(data.size()), 1, 0, 0),
        BZ_OK);
    packed.resize(size);
    return packed;
}

std::string head(const char* type, const std::string& sizes, const char* encoding) {
    return fmt::format(
        "NRRD0005\ntype: {}\ndimension: 3\nsizes: {}\nendian: little\nencoding: {}\n\n", type,
        sizes, encoding);
}

class NrrdEncodings : public FileTest {
  protected:
    std::filesystem::path put(const std::string& bytes) const {
        put_bytes(folder / "a.nrrd", bytes);
        return folder / "a.nrrd";
    }
    /// Reads all bytes of the values, in slabs of two layers.
    std::string values_of(const std::string& bytes) const {
        const CellArray array = read_nrrd_header(put(bytes));
        const InputFile data(array.data);
        ArraySlabs slabs(array, data, 2);
        std::string values;
        while (const int layers = slabs.next())
            values.append(reinterpret_cast<const char*>(slabs.values()),
                          size_t(layers * array.counts.x * array.counts.y) * bytes_of(array.type));
        return values;
    }
    std::string refusal(const std::string& bytes) const {
        return error_of([&] { values_of(bytes); }).what();
    }
};

TEST_F(NrrdEncodings, TextHasTheValuesOfAllTypes) {
    const std::string text = "1 2,3\n\t4\r\n  5 100";
    const auto same = [&](const char* type, const std::string& words, const std::string& bytes) {
        EXPECT_EQ(values_of(head(type, "3 1 2", "text") + words), bytes) << type;
    };
    same("uchar", text, bytes_of_values<uint8_t>({1, 2, 3, 4, 5, 100}));
    same("signed char", text + "\n", bytes_of_values<int8_t>({1, 2, 3, 4, 5, 100}));
    same("ushort", text, bytes_of_values<uint16_t>({1, 2, 3, 4, 5, 100}));
    same("int", "-1 2 3 4 5 +6", bytes_of_values<int32_t>({-1, 2, 3, 4, 5, 6}));
    same("uint64", "18446744073709551615 2 3 4 5 6",
         bytes_of_values<uint64_t>({18446744073709551615u, 2, 3, 4, 5, 6}));
    same("longlong", "-9223372036854775807 2 3 4 5 6 more behind them",
         bytes_of_values<int64_t>({-9223372036854775807, 2, 3, 4, 5, 6}));
    same("float", "0.25 -1e3 3 4 5 1e-3", bytes_of_values<float>({0.25f, -1000, 3, 4, 5, 0.001f}));
    same("double", "0.1 -1e300 3. .5 5 6", bytes_of_values<double>({0.1, -1e300, 3, 0.5, 5, 6}));
}

TEST_F(NrrdEncodings, LongTextsAndSeveralMembersOfBzip2AreReadAcrossBlocks) {
    std::mt19937 random(11);
    std::vector<int16_t> values(40 * 50 * 60);
    std::string text;
    for (int16_t& value : values) {
        value = int16_t(random());
        text += fmt::format("{}{}", value, random() % 40 == 0 ? "   \n" : " ");
    }
    const std::string bytes = bytes_of_values(values);
    EXPECT_TRUE(values_of(head("short", "40 50 60", "ascii") + text) == bytes);
    EXPECT_TRUE(values_of(head("short", "40 50 60", "bz2") + bzipped(bytes)) == bytes);
    EXPECT_TRUE(values_of(head("short", "40 50 60", "bzip2") + bzipped(bytes.substr(0, 100001)) +
                          bzipped(bytes.substr(100001))) == bytes);
}

TEST_F(NrrdEncodings, WordsThatAreNoNumbersOfTheTypeAreNamed) {
    for (const auto& [type, word] :
         {std::pair{"uchar", "256"}, std::pair{"uchar", "-1"}, std::pair{"short", "1.5"},
          std::pair{"float", "1e99"}, std::pair{"int", "0x10"}, std::pair{"double", "one"}})
        EXPECT_THAT(refusal(head(type, "2 1 1", "text") + "1 " + word),
                    HasSubstr(fmt::format("\"{}\" among its data isn't a number", word)))
            << type;
    EXPECT_THAT(refusal(head("uchar", "2 1 1", "text") + "1 " + std::string(300000, '1')),
                HasSubstr("isn't a number"));
    EXPECT_THAT(refusal(head("uchar", "3 1 1", "text") + "100 20  "), HasSubstr("truncated"));
    EXPECT_THAT(refusal(head("uchar", "30 20 10", "text") + "1 2 3"), HasSubstr("takes 6000"));
}

TEST_F(NrrdEncodings, DamagedBzip2EndsInASentence) {
    std::mt19937 random(5);
    std::string bytes(30 * 20 * 10, '\0');
    for (char& byte : bytes) byte = char(random() % 40);
    const std::string packed = bzipped(bytes), start = head("uchar", "30 20 10", "bzip2");
    for (size_t size = 0; size < packed.size(); size += 97)
        EXPECT_THAT(refusal(start + packed.substr(0, size)), HasSubstr("truncated")) << size;
    for (int round = 0; round < 200; ++round) {
        std::string damaged = packed;
        damaged[random() % damaged.size()] = char(random());
        try {
            EXPECT_EQ(values_of(start + damaged).size(), bytes.size());
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
        }
    }
    // A bomb ends by the sizes of the header.
    const std::string bomb = bzipped(std::string(1 << 22, '\0'));
    EXPECT_THAT(refusal(head("uchar", "4096 4096 4096", "bzip2") + bomb), HasSubstr("truncated"));
    EXPECT_EQ(values_of(head("uchar", "2 2 2", "bzip2") + bomb), std::string(8, '\0'));
}

}  // namespace
}  // namespace voxelume
