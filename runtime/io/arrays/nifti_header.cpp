// SPDX-License-Identifier: Apache-2.0
// The header of a NIfTI file.
//
// 348 bytes (version 1) or 540 (version 2) with numbers at fixed offsets, in the order of the
// machine that wrote them: the first number is the header's size, which tells the order. X goes to
// the patient's right, Y to the front, Z to the head.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <optional>
#include <string>

#include "runtime/base/text.hpp"
#include "runtime/io/arrays/array_files.hpp"
#include "runtime/io/arrays/array_stream.hpp"
#include "runtime/io/mesh/companion_file.hpp"

namespace voxelume {
namespace {

/// The byte offsets of the two versions' numbers.
struct HeaderOffsets {
    size_t header, dim, datatype, pixdim, vox_offset, slope, intercept, qform, sform, quatern,
        offset, srow, units;
    bool is_wide;  ///< 64-bit sizes, doubles and 32-bit codes
};

constexpr HeaderOffsets kVersion1 = {348, 40,  70,  76,  108, 112, 116,
                                     252, 254, 256, 268, 280, 123, false};
constexpr HeaderOffsets kVersion2 = {540, 16,  12,  104, 168, 176, 184,
                                     344, 348, 352, 376, 400, 500, true};

class NiftiHeader {
  public:
    NiftiHeader(const InputFile& file, DataEncoding encoding) {
        ByteStream stream(file, 0, encoding);
        const size_t count = stream.read_some(bytes_.data(), bytes_.size());
        if (count < kVersion1.header) file.refuse("too short for a NIfTI file");
        offsets_ = &kVersion1;
        if (find_order(kVersion2) && count >= kVersion2.header)
            offsets_ = &kVersion2;
        else if (!find_order(kVersion1))
            file.refuse("not a NIfTI file");
        const char* magic =
            reinterpret_cast<const char*>(bytes_.data()) + (offsets_->is_wide ? 4 : 344);
        has_data_elsewhere_ =
            std::memcmp(magic, "ni1", 3) == 0 || std::memcmp(magic, "ni2", 3) == 0;
        if (has_data_elsewhere_) return;
        if (std::all_of(magic, magic + 4, [](char c) { return c == 0; }))
            file.refuse(
                "has the header of Analyze 7.5, which says too little of orientation; save "
                "it as NIfTI");
        if (std::memcmp(magic, "n+1", 3) != 0 && std::memcmp(magic, "n+2", 3) != 0)
            file.refuse("not a NIfTI file");
    }

    bool is_swapped() const { return is_swapped_; }
    /// True if the data are in a second file, whose name differs in the ending .img.
    bool has_data_elsewhere() const { return has_data_elsewhere_; }
    const HeaderOffsets& offsets() const { return *offsets_; }

    template <class Number>
    Number at(size_t offset) const {
        std::array<unsigned char, sizeof(Number)> bytes;
        std::copy_n(bytes_.begin() + long(offset), sizeof(Number), bytes.begin());
        if (is_swapped_) std::ranges::reverse(bytes);
        Number number;
        std::memcpy(&number, bytes.data(), sizeof number);
        return number;
    }
    /// The `i`-th of the numbers at an offset: floats in version 1, doubles in version 2.
    double real(size_t offset, size_t i = 0) const {
        const double v = offsets_->is_wide ? at<double>(offset + 8 * i) : at<float>(offset + 4 * i);
        return std::isfinite(v) ? v : 0;
    }
    int64_t dim(size_t i) const {
        return offsets_->is_wide ? at<int64_t>(offsets_->dim + 8 * i)
                                 : at<int16_t>(offsets_->dim + 2 * i);
    }
    int code(size_t offset) const {
        return offsets_->is_wide ? at<int32_t>(offset) : at<int16_t>(offset);
    }
    int units() const { return offsets_->is_wide ? at<int32_t>(offsets_->units) : bytes_[123]; }

  private:
    bool find_order(const HeaderOffsets& offsets) {
        for (const bool is_swapped : {false, true}) {
            is_swapped_ = is_swapped;
            if (at<int32_t>(0) == int32_t(offsets.header)) return true;
        }
        return false;
    }

    std::array<unsigned char, 540> bytes_{};
    const HeaderOffsets* offsets_ = nullptr;
    bool is_swapped_ = false, has_data_elsewhere_ = false;
};

bool is_gzip(const InputFile& file) {
    std::array<unsigned char, 2> mark{};
    if (file.size() < 2) return false;
    file.read(0, mark.data(), 2);
    return mark[0] == 0x1f && mark[1] == 0x8b;
}

/// The other file of a pair. Its name differs in the ending alone, with or without ".gz", in small
/// letters or, if `path` has some, in capitals. Empty where there is none.
std::optional<std::filesystem::path> partner_of(const std::filesystem::path& path,
                                                std::string_view ending) {
    std::filesystem::path stem = path.filename();
    if (ending_of(stem) == ".gz") stem = stem.stem();
    const std::string own = stem.extension().string();
    std::string wanted(ending);
    if (own.size() > 1 && own[1] >= 'A' && own[1] <= 'Z')
        for (char& c : wanted) c = c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c;
    const std::string name = stem.stem().string() + wanted;
    for (const char* const packed : {"", ".gz", ".GZ"})
        if (auto found = companion_file(path, name + packed)) return found;
    return {};
}

/// The file with the header: the path itself, or the other file of a pair if the path has the data.
std::filesystem::path header_file(const std::filesystem::path& path) {
    std::filesystem::path plain = path.filename();
    if (ending_of(plain) == ".gz") plain = plain.stem();
    if (ending_of(plain) != ".img") return path;
    if (const auto header = partner_of(path, ".hdr")) return *header;
    InputFile(path).refuse(
        "has the data of a scan, whose header, a file of its name that ends in "
        ".hdr, isn't in its folder");
}

/// Finds the bytes of the values.
void set_data(const NiftiHeader& header, const InputFile& file, CellArray& array) {
    const HeaderOffsets& offsets = header.offsets();
    const double offset = offsets.is_wide ? double(header.at<int64_t>(offsets.vox_offset))
                                          : header.real(offsets.vox_offset);
    if (!(offset >= 0 && offset <= 1e15))
        file.refuse("its header gives no place where its data begin; it is damaged");
    uint64_t start = std::max(uint64_t(offset), uint64_t(offsets.header));
    if (header.has_data_elsewhere()) {
        const auto data = partner_of(file.path(), ".img");
        if (!data)
            file.refuse(
                "its data are in a file of its name that ends in .img, which isn't in its "
                "folder");
        array.data = *data;
        array.header = file.path();
        array.encoding = is_gzip(InputFile(*data)) ? DataEncoding::gzip : DataEncoding::raw;
        start = uint64_t(offset);
    }
    (array.is_compressed() ? array.skip : array.start) = start;
}

void set_type(const NiftiHeader& header, const InputFile& file, CellArray& array) {
    struct Row {
        int code;
        CellType type;
        int channels;
    };
    constexpr std::array<Row, 12> kRows = {{{2, CellType::u8, 1},
                                            {4, CellType::i16, 1},
                                            {8, CellType::i32, 1},
                                            {16, CellType::f32, 1},
                                            {64, CellType::f64, 1},
                                            {128, CellType::u8, 3},
                                            {256, CellType::i8, 1},
                                            {512, CellType::u16, 1},
                                            {768, CellType::u32, 1},
                                            {1024, CellType::i64, 1},
                                            {1280, CellType::u64, 1},
                                            {2304, CellType::u8, 4}}};
    const int code = header.at<int16_t>(header.offsets().datatype);
    for (const Row& row : kRows) {
        if (row.code != code) continue;
        array.type = row.type;
        array.channels = row.channels;
        return;
    }
    file.refuse(
        fmt::format("its values have the NIfTI data type {}, which isn't read: integers, "
                    "float32, float64 and RGB are",
                    code));
}

/// The map from a cell's indices to its middle, in the file's units and axes.
glm::dmat4 file_from_index(const NiftiHeader& header, CellArray& array) {
    const HeaderOffsets& offsets = header.offsets();
    glm::dmat4 map(1);
    if (header.code(offsets.sform) > 0) {
        const size_t row_bytes = offsets.is_wide ? 32 : 16;
        for (size_t row = 0; row < 3; ++row)
            for (size_t column = 0; column < 4; ++column)
                map[int(column)][int(row)] = header.real(offsets.srow + row * row_bytes, column);
        return map;
    }
    glm::dvec3 spacing;
    for (size_t i = 0; i < 3; ++i) {
        const double s = std::abs(header.real(offsets.pixdim, i + 1));
        spacing[int(i)] = s > 0 ? s : 1;
        if (s == 0) array.notes.emplace_back("assumed: spacing 1 where the file has 0");
    }
    if (header.code(offsets.qform) > 0) {
        glm::dvec3 turn(header.real(offsets.quatern), header.real(offsets.quatern, 1),
                        header.real(offsets.quatern, 2));
        // Half a turn has no real part; the remainder of rounding would turn the axes.
        const double square = 1 - glm::dot(turn, turn);
        if (square < 1e-7) turn = glm::normalize(turn);
        const double a = square < 1e-7 ? 0 : std::sqrt(square), b = turn.x, c = turn.y, d = turn.z;
        const double flip = header.real(offsets.pixdim) < 0 ? -1 : 1;
        map[0] = {a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c), 0};
        map[1] = {2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b), 0};
        map[2] =
            glm::dvec4(2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - c * c - b * b, 0) *
            flip;
        for (size_t i = 0; i < 3; ++i) map[3][int(i)] = header.real(offsets.offset, i);
    } else {
        array.notes.emplace_back(
            "assumed: X right, Y front, Z up, for the file has no orientation");
    }
    for (int i = 0; i < 3; ++i) map[i] *= spacing[i];
    return map;
}

double metres_per_unit(const NiftiHeader& header, CellArray& array) {
    switch (header.units() & 7) {
        case 1:
            return 1;
        case 2:
            return 1e-3;
        case 3:
            return 1e-6;
        default:
            array.notes.emplace_back("assumed: lengths in millimetres");
            return 1e-3;
    }
}

}  // namespace

CellArray read_nifti_header(const std::filesystem::path& path) {
    const InputFile file(header_file(path));
    if (file.size() < 2) file.refuse("too short for a NIfTI file");
    CellArray array;
    array.data = file.path();
    if (is_gzip(file)) array.encoding = DataEncoding::gzip;
    const NiftiHeader header(file, array.encoding);
    const HeaderOffsets& offsets = header.offsets();
    array.is_swapped = header.is_swapped();
    set_type(header, file, array);
    const int64_t axes = header.dim(0);
    if (axes < 3 || axes > 7)
        file.refuse(fmt::format("it has {} axes; at least 3 are needed", axes));
    int64_t volumes = 1;
    for (size_t i = 1; i <= size_t(axes); ++i) {
        const int64_t n = header.dim(i);
        if (n < 1 || n > 1 << 20) file.refuse(fmt::format("its axis {} has {} cells", i, n));
        if (i <= 3)
            array.counts[int(i) - 1] = int(n);
        else
            volumes = std::min<int64_t>(volumes * n, 1 << 20);
    }
    if (volumes > 1) array.notes.push_back(fmt::format("the first of {} volumes", volumes));
    set_data(header, file, array);
    const double slope = header.real(offsets.slope);
    if (slope != 0 && !array.is_color()) {
        array.slope = slope;
        array.intercept = header.real(offsets.intercept);
    }
    const double metres = metres_per_unit(header, array);
    glm::dmat4 map = file_from_index(header, array);
    for (int i = 0; i < 4; ++i) {
        const glm::dvec4 v = map[i];
        // Left, up and front are X, Y and Z here.
        map[i] = {-v.x * metres, v.z * metres, v.y * metres, i == 3};
    }
    array.orientation = "the head is up, the face in front";
    check_array(array, InputFile(array.data));
    set_place(map, file, array);
    return array;
}

}  // namespace voxelume
