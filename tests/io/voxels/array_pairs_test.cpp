// SPDX-License-Identifier: Apache-2.0
// Arrays of float16, and scans whose header and data are a file each.
#include <gmock/gmock.h>

#include <cmath>

#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/base/files/input_file.hpp"
#include "runtime/import/scene_of_file.hpp"
#include "runtime/io/arrays/array_files.hpp"
#include "runtime/io/arrays/array_stream.hpp"
#include "runtime/io/arrays/array_voxels.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/voxel_cells.hpp"
#include "tests/support/writers/array_writer.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

class ArrayPairs : public FileTest {
  protected:
    std::filesystem::path put(const std::string& name, const std::string& bytes) {
        put_bytes(folder / name, bytes);
        return folder / name;
    }
    std::string refusal(const std::string& name) {
        return error_of([&] { read_voxel_model(folder / name, Surface::cubes); }).what();
    }
};

/// The value of a number of 16 bits by its definition.
double value_of_half(unsigned half) {
    const double sign = half >> 15 ? -1 : 1, fraction = half & 1023;
    const int exponent = int(half >> 10 & 31);
    if (exponent == 31) return fraction > 0 ? NAN : sign * INFINITY;
    if (exponent == 0) return sign * std::ldexp(fraction, -24);
    return sign * std::ldexp(1024 + fraction, exponent - 25);
}

TEST_F(ArrayPairs, EveryFloat16IsReadExactly) {
    std::vector<uint16_t> codes(65536);
    for (size_t i = 0; i < codes.size(); ++i) codes[i] = uint16_t(i);
    for (const bool is_big : {false, true}) {
        const auto file = put("h.npy", npy_bytes(is_big ? ">f2" : "<f2", "32, 64, 32",
                                                 bytes_of_values(codes, is_big)));
        const CellArray array = read_npy_header(file);
        const InputFile data(file);
        ArraySlabs slabs(array, data, 3);
        size_t at = 0;
        while (const int layers = slabs.next())
            for (int i = 0; i < layers * 64 * 32; ++i, ++at) {
                const float found = reinterpret_cast<const float*>(slabs.values())[i];
                const double value = value_of_half(unsigned(at));
                ASSERT_TRUE(std::isnan(value) ? std::isnan(found) : double(found) == value) << at;
            }
        EXPECT_EQ(at, codes.size());
    }
}

TEST_F(ArrayPairs, Float16IsAnyOtherFloat) {
    // 0, 1, 0.5, 2.5, -3 and 60000.
    const std::vector<uint16_t> halves = {0, 0x3C00, 0x3800, 0x4100, 0xC200, 0x7B53};
    const std::vector<float> floats = {0, 1, 0.5f, 2.5f, -3, 60000};
    const auto half = put("h.npy", npy_bytes("<f2", "3, 1, 2", bytes_of_values(halves)));
    const auto full = put("f.npy", npy_bytes("<f4", "3, 1, 2", bytes_of_values(floats)));
    const VoxelValues choices[] = {{}, {.iso = 2.0}, {.label = -3}, {.each_label = true}};
    for (const VoxelValues& values : choices)
        EXPECT_EQ(cells_of(read_voxel_model(half, Surface::cubes, 0, values)),
                  cells_of(read_voxel_model(full, Surface::cubes, 0, values)));
    const VoxelModel a = read_voxel_model(half, Surface::smooth, 0, {.iso = 0.75}),
                     b = read_voxel_model(full, Surface::smooth, 0, {.iso = 0.75});
    EXPECT_EQ(a.occupancy, b.occupancy);
    EXPECT_EQ(a.distance, b.distance);
    const ArraySummary summary = summary_of_array(read_npy_header(half));
    EXPECT_EQ(summary.max, 60000);
    EXPECT_EQ(summary.min, -3);
    // Colours in Fortran's order, in which each channel is a separate block.
    const std::vector<uint16_t> planar = {0, 0x3C00, 0, 0x3800, 0, 0x4000};
    EXPECT_EQ(cells_of(read_voxel_model(
                  put("c.npy", npy_bytes("<f2", "2, 1, 1, 3", bytes_of_values(planar), true)),
                  Surface::cubes)),
              (VoxelCells{{{1, 0, 0}, {0xFF80FF, ""}}}));
}

TEST_F(ArrayPairs, OfHeaderAndDataAreTheScanThatOneFileWouldBe) {
    NiftiSample sample;
    const std::string data = bytes_of_values(std::vector<int16_t>{
        0, 1, 2, 0, 0, 3, 0, 0, 0, 4, 0, 0, 0, 0, 5, 0, 0, 0, 6, 0, 0, 0, 0, 7});
    const VoxelCells expected =
        cells_of(read_voxel_model(put("one.nii", nifti_bytes(sample, data)), Surface::cubes));
    ASSERT_EQ(expected.size(), 7u);
    sample.is_pair = true;
    const std::string header = nifti_bytes(sample, "");
    const auto expect = [&](const std::string& name) {
        EXPECT_TRUE(is_model_file(folder / name)) << name;
        EXPECT_EQ(cells_of(read_voxel_model(folder / name, Surface::cubes)), expected) << name;
    };
    put("a.hdr", header);
    put("a.img", data);
    expect("a.hdr");
    expect("a.img");
    put("b.hdr.gz", gzipped(header));
    put("b.img.gz", gzipped(data));
    expect("b.hdr.gz");
    expect("b.img.gz");
    put("c.v1.hdr", header);
    put("c.v1.img.gz", gzipped(data));
    expect("c.v1.hdr");
    put("D.HDR", header);
    put("D.IMG", data);
    expect("D.HDR");
}

TEST_F(ArrayPairs, ThatLackAFileOrEndTooEarlyAreRefused) {
    NiftiSample sample;
    sample.is_pair = true;
    const std::string header = nifti_bytes(sample, ""), data(48, '\1');
    put("a.hdr", header);
    EXPECT_THAT(refusal("a.hdr"), HasSubstr("ends in .img, which isn't in its folder"));
    put("b.img", data);
    EXPECT_THAT(refusal("b.img"), HasSubstr("ends in .hdr, isn't in its folder"));
    put("a.img", data.substr(0, 47));
    EXPECT_THAT(refusal("a.hdr"),
                HasSubstr("a.img: its array takes 48 bytes, and the file has 47"));
    put("a.img", gzipped(data.substr(0, 47)));
    EXPECT_THAT(refusal("a.hdr"), HasSubstr("a.img: its data end too early"));
    std::string analyze = header;
    analyze.replace(344, 4, 4, '\0');
    put("a.hdr", analyze);
    EXPECT_THAT(refusal("a.hdr"), HasSubstr("a.hdr: has the header of Analyze 7.5"));
    put("sky.hdr", "#?RADIANCE\n");
    EXPECT_FALSE(is_model_file(folder / "sky.hdr"));
}

}  // namespace
}  // namespace voxelume
