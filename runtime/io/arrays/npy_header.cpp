// SPDX-License-Identifier: Apache-2.0
// The header of a numpy array.
//
// The file begins with 93 'N' 'U' 'M' 'P' 'Y', a byte each for the version and the minor version,
// and the length of the header: u16 in version 1, u32 later. The header is a dictionary as Python
// writes it, with 'descr', 'fortran_order' and 'shape'; then come the values.
#include <cstring>
#include <string>

#include "runtime/base/files/input_file.hpp"
#include "runtime/base/text.hpp"
#include "runtime/io/arrays/array_files.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kMaxNpyHeader = 1 << 16;

/// The text behind a key of the dictionary.
std::string_view text_after(std::string_view header, std::string_view key, const InputFile& file) {
    for (const char quote : {'\'', '"'}) {
        const std::string quoted = quote + std::string(key) + quote;
        size_t at = header.find(quoted);
        if (at == std::string_view::npos) continue;
        at = header.find(':', at + quoted.size());
        if (at == std::string_view::npos) break;
        at = header.find_first_not_of(" \t", at + 1);
        if (at == std::string_view::npos) break;
        return header.substr(at);
    }
    file.refuse(fmt::format("its header lacks '{}'", key));
}

CellType npy_type(std::string_view text, const InputFile& file) {
    struct Row {
        std::string_view code;
        CellType type;
    };
    constexpr std::array<Row, 12> kCodes = {{{"b1", CellType::boolean},
                                             {"u1", CellType::u8},
                                             {"i1", CellType::i8},
                                             {"u2", CellType::u16},
                                             {"i2", CellType::i16},
                                             {"u4", CellType::u32},
                                             {"i4", CellType::i32},
                                             {"u8", CellType::u64},
                                             {"i8", CellType::i64},
                                             {"f2", CellType::f16},
                                             {"f4", CellType::f32},
                                             {"f8", CellType::f64}}};
    if (text.starts_with('[')) file.refuse("its values are records; save one field of them");
    const size_t end = text.size() > 1 ? text.find(text[0], 1) : std::string_view::npos;
    const std::string_view code = end == std::string_view::npos ? "" : text.substr(1, end - 1);
    for (const Row& row : kCodes)
        if (code.size() == 3 && code.substr(1) == row.code) return row.type;
    file.refuse(
        fmt::format("its values are of the type {}, which isn't read: save them as bool, "
                    "uint8, uint16, another integer, float16, float32 or float64",
                    quote(code)));
}

std::vector<uint64_t> shape_of(std::string_view text, const InputFile& file) {
    std::vector<uint64_t> shape;
    const size_t end = text.find(')');
    if (!text.starts_with('(') || end == std::string_view::npos)
        file.refuse("its header has no shape");
    uint64_t number = 0;
    bool is_number = false;
    for (const char c : text.substr(1, end)) {
        if (c >= '0' && c <= '9') {
            number = number * 10 + uint64_t(c - '0');
            is_number = true;
            if (number >= uint64_t{1} << 31 || shape.size() > 8)
                file.refuse("its shape is larger than a model may be");
        } else if (c == ',' || c == ')') {
            if (is_number) shape.push_back(number);
            number = 0;
            is_number = false;
        } else if (c != ' ' && c != 'L') {
            file.refuse("its header has no shape");
        }
    }
    return shape;
}

/// True if an array of values has the shape of a picture with colours.
bool is_like_picture(const std::vector<uint64_t>& shape) {
    return (shape[2] == 3 || shape[2] == 4) && shape[0] > 4 && shape[1] > 4;
}

/// The header's text, and where the values begin.
std::string header_of(const InputFile& file, uint64_t& start) {
    std::array<unsigned char, 12> head{};
    if (file.size() < head.size()) file.refuse("too short for a numpy array");
    file.read(0, head.data(), head.size());
    if (std::memcmp(head.data(), "\x93NUMPY", 6) != 0) file.refuse("not a numpy array");
    if (head[6] < 1 || head[6] > 3)
        file.refuse(fmt::format("a numpy array of version {}; 1 to 3 can be read", head[6]));
    uint32_t length = uint32_t(head[8] | head[9] << 8);
    if (head[6] > 1) length |= uint32_t(head[10]) << 16 | uint32_t(head[11]) << 24;
    const uint64_t at = head[6] > 1 ? 12 : 10;
    if (length > kMaxNpyHeader || at + length > file.size())
        file.refuse("its header has no end; it is damaged");
    std::string text(length, '\0');
    file.read(at, text.data(), text.size());
    start = at + length;
    return text;
}

}  // namespace

CellArray read_npy_header(const std::filesystem::path& path) {
    const InputFile file(path);
    CellArray array;
    array.data = path;
    const std::string header = header_of(file, array.start);
    const std::string_view descr = text_after(header, "descr", file);
    array.type = npy_type(descr, file);
    array.is_swapped = descr[1] == '>' && bytes_of(array.type) > 1;
    const bool is_fortran = text_after(header, "fortran_order", file).starts_with("True");
    std::vector<uint64_t> shape = shape_of(text_after(header, "shape", file), file);
    if (shape.size() == 4 && shape[3] == 1) shape.pop_back();
    const bool is_color = shape.size() == 4 && (shape[3] == 3 || shape[3] == 4);
    if (shape.size() != 3 && !is_color)
        file.refuse(
            fmt::format("its shape is ({}); voxels are (x, y, z), or (x, y, z, 3) and "
                        "(x, y, z, 4) with colours",
                        fmt::join(shape, ", ")));
    if (is_color) {
        array.channels = int(shape[3]);
        array.is_planar = is_fortran;
        const CellType t = array.type;
        if (t != CellType::boolean && t != CellType::u8 && t != CellType::u16 && !is_float(t))
            file.refuse(fmt::format(
                "its colours are {}; uint8, uint16, floats and bool can be read; labels are one "
                "number a voxel, of the shape (x, y, z)",
                name_of(t)));
    } else if (is_like_picture(shape) && bytes_of(array.type) <= 2) {
        array.notes.push_back(fmt::format(
            "its shape may be that of a picture, but is read as {} layers of values; voxels with "
            "colours have the shape (x, y, z, {})",
            shape[2], shape[2]));
    }
    for (int axis = 0; axis < 3; ++axis) {
        const int from = is_fortran ? axis : 2 - axis;
        array.counts[from] = int(shape[size_t(axis)]);
        array.axis[axis] = from;
    }
    array.orientation = "x, y, z as its axes are ordered, with Y up";
    check_array(array, file);
    return array;
}

}  // namespace voxelume
