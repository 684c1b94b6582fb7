// SPDX-License-Identifier: Apache-2.0
// Arrays of values and colours as cubes, voxel by voxel.
#include <gmock/gmock.h>

#include <random>

#include "runtime/assets/voxel_model_file.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/voxel_cells.hpp"
#include "tests/support/writers/array_writer.hpp"

namespace voxelume {

using testing::HasSubstr;

class ArrayCubesTest : public FileTest {
  protected:
    std::filesystem::path put(const std::string& name, const std::string& bytes) {
        put_bytes(folder / name, bytes);
        return folder / name;
    }
    VoxelModel cubes(const std::filesystem::path& file, const VoxelValues& values = {}) {
        return read_voxel_model(file, Surface::cubes, 0, values);
    }
    std::string refusal(const std::filesystem::path& file, const VoxelValues& values = {}) {
        return error_of([&] { cubes(file, values); }).what();
    }
};

TEST_F(ArrayCubesTest, NumpyIndicesAreXYZ) {
    // Shape (2, 3, 4): the last index runs fastest. Cell (1, 2, 3) is the last value.
    std::vector<uint8_t> values(24);
    values[0] = 1;        // (0, 0, 0)
    values[3] = 7;        // (0, 0, 3)
    values[1 * 4] = 255;  // (0, 1, 0)
    values[23] = 2;       // (1, 2, 3)
    const VoxelCells expected = {
        {{0, 0, 0}, {}}, {{0, 0, 3}, {}}, {{0, 1, 0}, {}}, {{1, 2, 3}, {}}};
    const std::string data = bytes_of_values(values);
    for (const int version : {1, 2, 3})
        EXPECT_EQ(cells_of(cubes(put("a.npy", npy_bytes("|u1", "2, 3, 4", data, false, version)))),
                  expected);
    // Fortran's order gives the bytes another meaning: the first index runs fastest.
    const VoxelCells fortran = {{{0, 0, 0}, {}}, {{1, 1, 0}, {}}, {{0, 2, 0}, {}}, {{1, 2, 3}, {}}};
    EXPECT_EQ(cells_of(cubes(put("f.npy", npy_bytes("|u1", "2, 3, 4", data, true)))), fortran);
    // A wrong ending changes nothing: the first bytes decide.
    EXPECT_EQ(cells_of(cubes(put("a.bin", npy_bytes("|u1", "2, 3, 4", data)))), expected);
}

/// The cells of an array of (x, y, z) by walking it cell by cell.
template <class Choose>
VoxelCells walked(const glm::ivec3& size, const Choose& is_voxel) {
    VoxelCells cells;
    for (int x = 0; x < size.x; ++x)
        for (int y = 0; y < size.y; ++y)
            for (int z = 0; z < size.z; ++z)
                if (is_voxel((x * size.y + y) * size.z + z)) cells[{x, y, z}] = {};
    return cells;
}

template <class Value>
std::vector<Value> random_values(size_t count, uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<Value> values(count);
    for (Value& value : values)
        if (random() % 3 == 0) value = Value(int(random() % 200) - 60);
    return values;
}

template <class Value>
void expect_type(const std::filesystem::path& file, const std::string& code, uint32_t seed) {
    const glm::ivec3 size(37, 21, 50);
    const auto values = random_values<Value>(size_t(size.x * size.y * size.z), seed);
    for (const bool is_big : {false, true}) {
        put_bytes(file, npy_bytes((is_big ? ">" : "<") + code, "37, 21, 50",
                                  bytes_of_values(values, is_big)));
        const auto at = [&](int i) { return double(values[size_t(i)]); };
        const bool is_fraction = std::is_floating_point_v<Value>;
        EXPECT_EQ(cells_of(read_voxel_model(file, Surface::cubes)),
                  walked(size, [&](int i) { return is_fraction ? at(i) >= 0.5 : at(i) != 0; }))
            << code;
        EXPECT_EQ(cells_of(read_voxel_model(file, Surface::cubes, 0, {.iso = 42.5})),
                  walked(size, [&](int i) { return at(i) >= 42.5; }))
            << code;
        EXPECT_EQ(cells_of(read_voxel_model(file, Surface::cubes, 0, {.label = 17})),
                  walked(size, [&](int i) { return at(i) == 17; }))
            << code;
    }
}

TEST_F(ArrayCubesTest, AllTypesAndByteOrdersAreReadCellByCell) {
    const auto file = folder / "t.npy";
    expect_type<uint8_t>(file, "u1", 1);
    expect_type<int8_t>(file, "i1", 2);
    expect_type<uint16_t>(file, "u2", 3);
    expect_type<int16_t>(file, "i2", 4);
    expect_type<uint32_t>(file, "u4", 5);
    expect_type<int32_t>(file, "i4", 6);
    expect_type<uint64_t>(file, "u8", 7);
    expect_type<int64_t>(file, "i8", 8);
    expect_type<float>(file, "f4", 9);
    expect_type<double>(file, "f8", 10);
}

TEST_F(ArrayCubesTest, ColoursAreVoxelsThatArentBlackOrClear) {
    std::vector<uint8_t> rgb(2 * 1 * 3 * 3), rgba(2 * 1 * 3 * 4);
    const auto set = [](auto& values, size_t cell, std::vector<uint8_t> color) {
        std::copy(color.begin(), color.end(), values.begin() + long(cell * color.size()));
    };
    set(rgb, 1, {10, 20, 30});
    set(rgb, 5, {0, 0, 1});
    EXPECT_EQ(cells_of(cubes(put("a.npy", npy_bytes("|u1", "2, 1, 3, 3", bytes_of_values(rgb))))),
              (VoxelCells{{{0, 0, 1}, {0x1E140A, ""}}, {{1, 0, 2}, {0x010000, ""}}}));
    set(rgba, 0, {0, 0, 0, 255});
    set(rgba, 4, {255, 1, 2, 1});
    set(rgba, 5, {9, 9, 9, 0});
    const VoxelModel model =
        cubes(put("b.npy", npy_bytes("|u1", "2, 1, 3, 4", bytes_of_values(rgba))));
    EXPECT_TRUE(model.transparent);
    EXPECT_EQ(cells_of(model),
              (VoxelCells{{{0, 0, 0}, {0x000000, ""}}, {{1, 0, 1}, {0xFE0201FF, ""}}}));
    // Floats from 0 to 1 in Fortran's order, in which each channel is a separate block.
    const std::vector<float> planar = {0, 1, 0, 0.5f, 0, 2};  // reds, greens, blues of two cells
    EXPECT_EQ(cells_of(cubes(
                  put("c.npy", npy_bytes("<f4", "2, 1, 1, 3", bytes_of_values(planar), true)))),
              (VoxelCells{{{1, 0, 0}, {0xFF80FF, ""}}}));
    EXPECT_THAT(refusal(folder / "c.npy", {.iso = 1.0}), HasSubstr("holds colours"));
}

TEST_F(ArrayCubesTest, EachLabelHasAColourOfItsOwn) {
    const std::vector<int16_t> values = {0, 3, -4, 3, 900, 0};
    const auto file = put("l.npy", npy_bytes("<i2", "6, 1, 1", bytes_of_values(values)));
    const VoxelCells cells = cells_of(cubes(file, {.each_label = true}));
    ASSERT_EQ(cells.size(), 4u);
    EXPECT_EQ(cells.at({1, 0, 0}), cells.at({3, 0, 0}));
    EXPECT_NE(cells.at({1, 0, 0}), cells.at({2, 0, 0}));
    EXPECT_NE(cells.at({1, 0, 0}), cells.at({4, 0, 0}));
    EXPECT_THAT(refusal(file, {.label = 5}), HasSubstr("no cell has the value 5"));
    // Bytes have the colours that other numbers of the same value have.
    const auto wide = put(
        "w.npy", npy_bytes("<i2", "4, 1, 1", bytes_of_values(std::vector<int16_t>{0, 3, -4, 120})));
    const auto narrow = put(
        "n.npy", npy_bytes("|i1", "4, 1, 1", bytes_of_values(std::vector<int8_t>{0, 3, -4, 120})));
    EXPECT_EQ(cells_of(cubes(narrow, {.each_label = true})),
              cells_of(cubes(wide, {.each_label = true})));
    const auto high =
        put("h.npy", npy_bytes("<i2", "2, 1, 1", bytes_of_values(std::vector<int16_t>{252, 0})));
    const auto byte = put("b.npy", npy_bytes("|u1", "2, 1, 1", std::string("\xFC\0", 2)));
    EXPECT_EQ(cells_of(cubes(byte, {.each_label = true})),
              cells_of(cubes(high, {.each_label = true})));
}

TEST_F(ArrayCubesTest, NrrdIsReadRawCompressedAndFromAnotherFile) {
    // The first axis runs fastest, and the second one against the space's.
    const std::vector<int16_t> values = random_values<int16_t>(5 * 6 * 7, 3);
    const std::string head =
        "NRRD0005\n# a comment\ntype: short\ndimension: 3\nspace: 3D-right-handed\n"
        "sizes: 5 6 7\nspace directions: (2,0,0) (0,-3,0) (0,0,4)\nspace origin: (1,20,2)\n"
        "endian: little\nkey:=value\n";
    const std::string data = bytes_of_values(values);
    std::vector<std::filesystem::path> files = {
        put("a.nrrd", head + "encoding: raw\n\n" + data),
        put("b.nrrd", head + "encoding: gzip\n\n" + gzipped(data)),
        put("c.nhdr", head + "encoding: raw\nbyte skip: 3\ndata file: c.raw\n\n"),
        put("d.nhdr", head + "encoding: raw\nbyte skip: -1\ndata file: c.raw\n"),
        put("e.nhdr", head + "encoding: gz\nbyte skip: 9\ndatafile: e.gz\n\n")};
    put("c.raw", "xyz" + data);
    put("e.gz", gzipped("123456789" + data));
    for (const auto& file : files) {
        const VoxelModel model = cubes(file);
        EXPECT_EQ(model.frame.voxel_edge, glm::dvec3(2, 3, 4));
        // The middle of cell (0, 0, 0) is at (1, 20, 2); along y cells go down from there.
        VoxelModel unit = model;
        unit.frame.voxel_edge = glm::dvec3(1);
        unit.frame.origin = (model.frame.origin - glm::dvec3(0, 3.5, 0)) / model.frame.voxel_edge;
        VoxelCells expected;
        for (int i = 0; i < 5 * 6 * 7; ++i)
            if (values[size_t(i)] != 0) expected[{i % 5, 5 - i / 5 % 6, i / 30}] = {};
        EXPECT_EQ(cells_of(unit), expected) << file;
    }
}

TEST_F(ArrayCubesTest, PatientsStandUprightAndFaceTheFront) {
    // One voxel each: the cells with the index 1 along one axis. Left, posterior, superior.
    const std::string data = bytes_of_values(std::vector<uint8_t>{0, 1, 1, 0, 1, 0, 0, 0});
    const VoxelModel lps =
        cubes(put("a.nrrd",
                  "NRRD0004\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\n"
                  "sizes: 2 2 2\nspace directions: (1000,0,0) (0,1000,0) (0,0,1000)\n"
                  "space origin: (500,500,500)\nencoding: raw\n\n" +
                      data));
    // Millimetres are assumed. X is left, Y up, Z to the front: posterior is -Z.
    const VoxelCells expected = {{{1, 0, -1}, {}}, {{0, 0, -2}, {}}, {{0, 1, -1}, {}}};
    EXPECT_EQ(cells_of(lps), expected);
    NiftiSample sample;
    sample.dim = {3, 2, 2, 2, 1, 1, 1, 1};
    sample.datatype = 2;
    sample.units = 1;
    sample.sform = 1;
    // Right, anterior, superior of the same cells.
    sample.srow = {-1, 0, 0, -0.5f, 0, -1, 0, -0.5f, 0, 0, 1, 0.5f};
    EXPECT_EQ(cells_of(cubes(put("a.nii", nifti_bytes(sample, data)))), expected);
    EXPECT_EQ(cells_of(cubes(put("b.nii.gz", gzipped(nifti_bytes(sample, data))))), expected);
    EXPECT_EQ(cells_of(cubes(put("c.nii", nifti_bytes(sample, data, true)))), expected);
    // A quaternion says this place, too: half a turn about Z.
    sample.sform = 0;
    sample.qform = 1;
    sample.quatern = {0, 0, 1, -0.5f, -0.5f, 0.5f};
    EXPECT_EQ(cells_of(cubes(put("d.nii", nifti_bytes(sample, data)))), expected);
}

TEST_F(ArrayCubesTest, NiftiSlopesCountBeforeValuesAreChosen) {
    NiftiSample sample;
    sample.dim = {3, 3, 1, 1, 1, 1, 1, 1};
    sample.slope = 2;
    sample.intercept = -1000;
    sample.units = 1;
    const auto file =
        put("a.nii", nifti_bytes(sample, bytes_of_values(std::vector<int16_t>{0, 500, 700})));
    EXPECT_EQ(cells_of(cubes(file, {.iso = 400.0})).size(), 1u);
    EXPECT_EQ(cells_of(cubes(file, {.label = -1000})).size(), 1u);
    EXPECT_EQ(cells_of(cubes(file)).size(), 2u);
}

TEST_F(ArrayCubesTest, WholeNumbersOfFloatsAreLabels) {
    const std::vector<float> values = {0, 1, 2.5f, NAN, -3, INFINITY, 1, 0.5f};
    const VoxelModel model = cubes(
        put("a.npy", npy_bytes("<f4", "8, 1, 1", bytes_of_values(values))), {.each_label = true});
    const VoxelCells found = cells_of(model);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found.at({0 + 1, 0, 0}).color, found.at({6, 0, 0}).color);
    EXPECT_NE(found.at({1, 0, 0}).color, found.at({4, 0, 0}).color);
    EXPECT_THAT(refusal(put("b.npy",
                            npy_bytes("<f4", "1, 1, 1", bytes_of_values(std::vector<float>{0.5f}))),
                        {.each_label = true}),
                HasSubstr("no value is a whole number but 0"));
}

TEST_F(ArrayCubesTest, WhatIsntReadIsSaid) {
    const std::string data(64, '\1');
    const auto npy = [&](const std::string& descr, const std::string& shape) {
        return refusal(put("x.npy", npy_bytes(descr, shape, data)));
    };
    EXPECT_THAT(npy("<c8", "2, 2, 2"), HasSubstr("of the type \"<c8\", which isn't read"));
    EXPECT_THAT(npy("|u1", "8, 8"), HasSubstr("its shape is (8, 8)"));
    EXPECT_THAT(npy("|u1", "2, 2, 2, 2"), HasSubstr("(x, y, z, 4) with colours"));
    EXPECT_THAT(npy("|u1", "4, 4, 5"), HasSubstr("takes 80 bytes, and the file has 64"));
    EXPECT_THAT(npy("|u1", "99999999, 1, 1"), HasSubstr("at most 65536 along each axis"));
    EXPECT_THAT(npy("|u1", "2147483648, 1, 1"), HasSubstr("larger than a model may be"));
    EXPECT_THAT(npy("|u1", "0, 4, 4"), HasSubstr("has no cells"));
    EXPECT_THAT(refusal(put("x.npy", npy_bytes("|u1", "4, 4, 4", std::string(64, '\0')))),
                HasSubstr("all of its values are 0"));
    const std::string head = "NRRD0005\ntype: uchar\ndimension: 3\nsizes: 4 4 4\n";
    EXPECT_THAT(refusal(put("x.nrrd", head + "encoding: hex\n\n" + data)),
                HasSubstr("raw, gzip, bzip2 and text can be read"));
    EXPECT_THAT(refusal(put("x.nrrd", head + "encoding: raw\ndata file: ../none.raw\n\n")),
                HasSubstr("isn't in its folder"));
    EXPECT_THAT(refusal(put("x.nrrd", head + "encoding: raw\ndata file: /etc/none\n\n")),
                HasSubstr("isn't in its folder"));
    EXPECT_THAT(refusal(put("x.nrrd", head + "encoding: gzip\n\n" + data)),
                HasSubstr("compressed data are damaged"));
    EXPECT_THAT(refusal(put("x.nii", std::string(400, 'x'))), HasSubstr("not a NIfTI file"));
    EXPECT_THAT(error_of([&] { read_voxel_model(folder / "x.npy", Surface::exact); }).what(),
                HasSubstr("has no exact surface"));
}

TEST_F(ArrayCubesTest, AGzipBombEndsByTheSizesOfItsHeader) {
    const std::string head = "NRRD0005\ntype: uchar\ndimension: 3\nencoding: gzip\n";
    const std::string bomb = gzipped(std::string(1 << 20, '\0'));
    EXPECT_THAT(refusal(put("b.nrrd", head + "sizes: 4096 4096 4096\n\n" + bomb)),
                HasSubstr("truncated"));
    // Data beyond the size in the header is not read.
    EXPECT_THAT(refusal(put("c.nrrd", head + "sizes: 2 2 2\n\n" + bomb)), HasSubstr("are 0"));
    EXPECT_THAT(refusal(put("d.nhdr", head + "sizes: 2 2 2\nbyte skip: 999999999\n"
                                             "data file: b.nrrd\n")),
                HasSubstr("at most are possible"));
}

TEST_F(ArrayCubesTest, EveryTruncationIsRefused) {
    const std::string data(2 * 3 * 4 * 2, '\1');
    NiftiSample sample;
    const std::vector<std::pair<std::string, std::string>> files = {
        {"t.npy", npy_bytes("<u2", "2, 3, 4", data)},
        {"t.nii", nifti_bytes(sample, data)},
        {"t.nrrd",
         "NRRD0005\ntype: short\ndimension: 3\nsizes: 2 3 4\nendian: little\nencoding: raw\n\n" +
             data}};
    for (const auto& [name, bytes] : files) {
        EXPECT_EQ(cells_of(cubes(put(name, bytes))).size() > 0, true) << name;
        for (size_t size = 0; size < bytes.size(); ++size)
            EXPECT_THAT(refusal(put(name, bytes.substr(0, size))), HasSubstr(name)) << size;
    }
}

}  // namespace voxelume
