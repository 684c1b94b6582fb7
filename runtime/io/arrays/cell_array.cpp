// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/arrays/cell_array.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/base/files/input_file.hpp"
#include "runtime/io/voxels/voxel_limits.hpp"

namespace voxelume {
namespace {

struct TypeRow {
    std::string_view name;
    size_t bytes;
};

constexpr std::array<TypeRow, 12> kTypes = {{{"bool", 1},
                                             {"uint8", 1},
                                             {"int8", 1},
                                             {"uint16", 2},
                                             {"int16", 2},
                                             {"uint32", 4},
                                             {"int32", 4},
                                             {"uint64", 8},
                                             {"int64", 8},
                                             {"float32", 4},
                                             {"float64", 8},
                                             {"float16", 2}}};

constexpr uint64_t kMaxDeflated = 1032;  // maximum of bytes that a byte of gzip becomes
constexpr uint64_t kMaxSkip = uint64_t{1} << 28;
constexpr double kMaxExtent = 1e9;  // metres, as in scenes

/// Assigns to each axis of the model the axis of the file that is closest to its direction.
void match_axes(const std::array<glm::dvec3, 3>& directions, CellArray& array) {
    std::array<bool, 3> is_taken{}, is_matched{};
    for (int round = 0; round < 3; ++round) {
        double best = -1;
        int best_axis = 0, best_direction = 0;
        for (int direction = 0; direction < 3; ++direction)
            for (int axis = 0; axis < 3; ++axis) {
                if (is_taken[size_t(direction)] || is_matched[size_t(axis)]) continue;
                const double along = std::abs(directions[size_t(direction)][axis]);
                if (along <= best) continue;
                best = along;
                best_axis = axis;
                best_direction = direction;
            }
        is_taken[size_t(best_direction)] = is_matched[size_t(best_axis)] = true;
        array.axis[best_axis] = best_direction;
        array.sign[best_axis] = directions[size_t(best_direction)][best_axis] < 0 ? -1 : 1;
    }
}

}  // namespace

size_t bytes_of(CellType type) {
    return kTypes[size_t(type)].bytes;
}

size_t bytes_in_memory(CellType type) {
    return type == CellType::f16 ? sizeof(float) : bytes_of(type);
}

std::string_view name_of(CellType type) {
    return kTypes[size_t(type)].name;
}

bool is_float(CellType type) {
    return type == CellType::f32 || type == CellType::f64 || type == CellType::f16;
}

void set_place(const glm::dmat4& model_from_index, const InputFile& file, CellArray& array) {
    std::array<glm::dvec3, 3> directions;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 step(model_from_index[i]);
        const double length = glm::length(step);
        if (!(length > 0 && length <= kMaxExtent))
            file.refuse("its axes have no direction or no spacing");
        directions[size_t(i)] = step / length;
    }
    const double volume = glm::dot(directions[0], glm::cross(directions[1], directions[2]));
    if (!(std::abs(volume) > 1e-3)) file.refuse("its axes span no volume");
    match_axes(directions, array);
    double angle = 0;
    glm::dvec3 middle(model_from_index[3]);
    for (int axis = 0; axis < 3; ++axis) {
        const int from = array.axis[axis];
        array.voxel_edge[axis] = glm::length(glm::dvec3(model_from_index[from]));
        const double along = std::abs(directions[size_t(from)][axis]);
        angle = std::max(angle, std::acos(std::min(along, 1.0)) * 180 / 3.141592653589793);
        middle += glm::dvec3(model_from_index[from]) * ((array.counts[from] - 1) / 2.0);
    }
    // The middle of all cells stays, so turned arrays are straightened about it.
    array.first_corner = middle - array.voxel_edge * glm::dvec3(array.size()) / 2.0;
    const glm::dvec3& corner = array.first_corner;
    if (!(std::max({std::abs(corner.x), std::abs(corner.y), std::abs(corner.z)}) <= kMaxExtent))
        file.refuse("its origin is farther away than scenes reach");
    check_voxel_edge(array.voxel_edge, array.first_corner, file);
    if (angle > 0.1)
        array.notes.push_back(
            fmt::format("its axes are turned by {:.1f} degrees, and are set straight", angle));
}

namespace {

/// The minimum number of bytes that the values take in a file.
uint64_t min_bytes(const CellArray& array) {
    constexpr uint64_t kMaxBzip2 = 1'500'000;  // the ratio of a block of zeros
    switch (array.encoding) {
        case DataEncoding::gzip:
            return array.bytes() / kMaxDeflated;
        case DataEncoding::bzip2:
            return array.bytes() / kMaxBzip2;
        case DataEncoding::text:  // a digit for each, and blanks between them
            return 2 * array.cells() * uint64_t(array.channels) - 1;
        case DataEncoding::raw:
            break;
    }
    return array.bytes();
}

}  // namespace

void check_array(const CellArray& array, const InputFile& data) {
    if (std::min({array.counts.x, array.counts.y, array.counts.z}) < 1)
        data.refuse("its array has no cells");
    check_voxel_span(glm::dvec3(array.counts), data);
    if (array.skip > kMaxSkip)
        data.refuse(fmt::format("its values begin after {} bytes, {} at most are possible",
                                array.skip, kMaxSkip));
    if (!array.slices.empty()) return;  // each slice is checked as it is read
    const uint64_t stored = data.size() > array.start ? data.size() - array.start : 0;
    if (min_bytes(array) > stored)
        data.refuse(
            fmt::format("its array takes {} bytes, and the file has {} for it; it is "
                        "truncated",
                        array.bytes(), stored));
}

}  // namespace voxelume
