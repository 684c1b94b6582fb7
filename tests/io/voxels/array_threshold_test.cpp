// SPDX-License-Identifier: Apache-2.0
// Cells of arrays above a threshold, and how often values of few bits occur.
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <random>

#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/io/arrays/array_files.hpp"
#include "runtime/io/arrays/array_voxels.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/voxel_cells.hpp"
#include "tests/support/writers/array_writer.hpp"

namespace voxelume {

using testing::HasSubstr;

class ArrayThresholdTest : public FileTest {
  protected:
    static VoxelModel cubes(const std::filesystem::path& file, double iso) {
        return read_voxel_model(file, Surface::cubes, 0, {.iso = iso});
    }
};

// Every value against a number that lies on, between and beyond the values of its type.
TEST_F(ArrayThresholdTest, AThresholdIsTheSameForAllTypes) {
    const auto check = [&]<class Value>(const char* type, const std::vector<Value>& values) {
        const auto file = folder / "t.npy";
        put_bytes(file,
                  npy_bytes(type, fmt::format("{}, 1, 1", values.size()), bytes_of_values(values)));
        for (const double iso : {-1e300, -40000.0, -1.0, -0.5, 0.0, 0.1, 1.0, 1.5, 126.9, 255.0,
                                 255.5, 65536.0, 4294967295.0, 4294967296.0, 1e300}) {
            VoxelCells expected;
            for (size_t i = 0; i < values.size(); ++i)
                if (double(values[i]) >= iso) expected[{int(i), 0, 0}] = {};
            if (expected.empty()) {
                EXPECT_THAT(error_of([&] { cubes(file, iso); }).what(),
                            HasSubstr("no cell has the value"));
            } else {
                EXPECT_EQ(cells_of(cubes(file, iso)), expected) << type << ' ' << iso;
            }
        }
    };
    check("|u1", std::vector<uint8_t>{0, 1, 2, 126, 127, 128, 254, 255});
    check("|i1", std::vector<int8_t>{-128, -1, 0, 1, 2, 126, 127});
    check("<u2", std::vector<uint16_t>{0, 1, 255, 256, 65535});
    check("<i4", std::vector<int32_t>{-2147483647, -40000, 0, 255, 2147483647});
    check("<u4", std::vector<uint32_t>{0, 1, 255, 65536, 4294967295u});
    check("<i8", std::vector<int64_t>{-40000, 0, 1, 4294967296});
    check("<f4", std::vector<float>{-1e30f, -0.5f, 0.1f, 0.09999999f, 1.5f, 255.5f, 1e30f, NAN});
    check("<f8", std::vector<double>{-1e300, -0.5, 0.1, 0.1 - 1e-17, 1.5, 1e300, NAN});
}

// Values of 8 and 16 bits are counted by their codes, values of 32 bits one by one; both give the
// same result.
TEST_F(ArrayThresholdTest, TheSummaryOfFewBitsIsThatOfMany) {
    std::mt19937 random(19);
    for (const int kinds : {1, 3, 60, 65, 250}) {
        std::vector<int8_t> narrow(9 * 7 * 5);
        size_t left = 0;
        for (int8_t& value : narrow) {
            const bool goes_on = left > 0 && &value != narrow.data();
            left = goes_on ? left - 1 : random() % 20;
            value = goes_on ? *(&value - 1) : int8_t(int(random() % unsigned(kinds)) - kinds / 2);
        }
        const std::vector<int16_t> middle(narrow.begin(), narrow.end());
        const std::vector<int32_t> wide(narrow.begin(), narrow.end());
        put_bytes(folder / "1.npy", npy_bytes("|i1", "9, 7, 5", bytes_of_values(narrow)));
        put_bytes(folder / "2.npy", npy_bytes("<i2", "9, 7, 5", bytes_of_values(middle)));
        put_bytes(folder / "4.npy", npy_bytes("<i4", "9, 7, 5", bytes_of_values(wide)));
        const ArraySummary expected = summary_of_array(read_npy_header(folder / "4.npy"));
        for (const char* name : {"1.npy", "2.npy"}) {
            const ArraySummary found = summary_of_array(read_npy_header(folder / name));
            EXPECT_EQ(found.min, expected.min) << name << kinds;
            EXPECT_EQ(found.max, expected.max) << name << kinds;
            EXPECT_EQ(found.zeros, expected.zeros) << name << kinds;
            EXPECT_EQ(found.threshold, expected.threshold) << name << kinds;
            EXPECT_EQ(found.labels, expected.labels) << name << kinds;
        }
    }
}

}  // namespace voxelume
