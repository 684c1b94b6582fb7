// SPDX-License-Identifier: Apache-2.0
// A stack of numbered PNG slices -> array.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "runtime/base/error.hpp"
#include "runtime/base/files/input_file.hpp"
#include "runtime/io/arrays/array_files.hpp"
#include "runtime/io/image/png_values.hpp"
#include "runtime/io/mesh/companion_file.hpp"

namespace voxelume {
namespace {

constexpr size_t kMaxSlices = 65536;
constexpr uint64_t kMaxStackCells = uint64_t{1} << 30;

/// The slices with consecutive numbers, beginning with a file: slice007.png, slice008.png.
std::vector<std::filesystem::path> slices_from(const std::filesystem::path& first) {
    const std::string stem = first.stem().string();
    size_t start = stem.size();
    while (start > 0 && std::isdigit(static_cast<unsigned char>(stem[start - 1])) != 0) --start;
    const std::string digits = stem.substr(start).substr(0, 18);
    std::vector<std::filesystem::path> slices = {first};
    if (digits.empty()) return slices;
    for (uint64_t number = std::stoull(digits) + 1; slices.size() <= kMaxSlices; ++number) {
        const std::string name = fmt::format("{}{:0{}}{}", stem.substr(0, start), number,
                                             digits.size(), first.extension().string());
        const auto next = companion_file(first, name);
        const std::filesystem::path path = first.parent_path() / name;
        std::error_code error;
        if (!next && std::filesystem::exists(std::filesystem::symlink_status(path, error)))
            throw Error(ErrorKind::input,
                        "{}: the name of a slice, and no plain file of the folder; remove it",
                        SourcePlace(path.string()));
        if (!next) break;
        slices.push_back(*next);
    }
    return slices;
}

}  // namespace

CellArray read_png_stack_header(const std::filesystem::path& path) {
    const InputFile file(path);
    const PngShape shape = read_png_shape(path);
    CellArray array;
    array.data = path;
    array.slices = slices_from(path);
    if (array.slices.size() > kMaxSlices)
        file.refuse(fmt::format("begins a stack of more than {} slices", kMaxSlices));
    array.type = shape.bits == 16 ? CellType::u16 : CellType::u8;
    array.channels = shape.channels;
    array.counts = {shape.width, shape.height, int(array.slices.size())};
    if (array.cells() > kMaxStackCells)
        file.refuse(fmt::format("begins a stack of {} cells; 2^30 are read", array.cells()));
    // Rows go down; slices go away from an observer who sees the first one.
    glm::dmat4 model_from_index(1);
    model_from_index[1].y = model_from_index[2].z = -1;
    model_from_index[3] = {0.5, array.counts.y - 0.5, array.counts.z - 0.5, 1};
    set_place(model_from_index, file, array);
    array.orientation = "columns along X, rows down, slices towards -Z";
    array.notes.push_back(fmt::format(
        "it has {} slices, whose spacing isn't known: a cell is 1 m long", array.slices.size()));
    check_array(array, file);
    return array;
}

}  // namespace voxelume
