// SPDX-License-Identifier: Apache-2.0
// What is in a file of an array, and what is assumed of it.
#include <set>

#include "runtime/api/describe/describe.hpp"

#include "runtime/grid/brick_cells.hpp"
#include "runtime/io/arrays/array_voxels.hpp"

namespace voxelume::api {
namespace {

template <class Vector>
Report coordinates_of(const Vector& v) {
    return {v.x, v.y, v.z};
}

/// The number of different colours of the voxels, without cells that hold no voxel.
size_t colors_in(const VoxelModel& model) {
    std::set<uint32_t> colors;
    for (size_t i = 0; i < model.colors.size(); ++i) {
        const glm::ivec3 cell = cell_in_brick(i % kVoxelsPerBrick);
        const size_t leaf = i / kVoxelsPerBrick * kLeavesPerBrick + leaf_in_brick(cell);
        if ((model.occupancy[leaf] & bit_in_leaf(cell)) != 0) colors.insert(model.colors[i]);
    }
    return colors.size();
}

/// Notes on what was assumed of the array, and on its colours.
std::vector<std::string> notes_of(const CellArray& array) {
    std::vector<std::string> notes = array.notes;
    if (!array.is_color()) return notes;
    if (has_color_masks(array))
        notes.emplace_back("its colours are 0 and 1, taken for none and all of a colour");
    if (is_float(array.type) && largest_color(array, 1) > 1)
        notes.emplace_back("colours above 1 are cut at 1: divide those up to 255 by 255");
    return notes;
}

}  // namespace

Report describe_array(const std::filesystem::path& path, const VoxelFileFormat& format) {
    const CellArray array = format.array(path);
    Report report = {{"kind", format.name},
                     {"size", coordinates_of(array.size())},
                     {"type", name_of(array.type)},
                     {"voxel edges", coordinates_of(array.voxel_edge)},
                     {"from", coordinates_of(array.first_corner)},
                     {"orientation", array.orientation}};
    if (array.is_color()) {
        report["colors"] = array.channels == 3 ? "red, green, blue" : "red, green, blue, opacity";
    } else {
        const ArraySummary summary = summary_of_array(array);
        report["min"] = summary.min;
        report["max"] = summary.max;
        report["zeros"] = summary.zeros;
        if (summary.not_finite > 0) report["not finite"] = summary.not_finite;
        if (summary.labels.empty()) {
            report["threshold"] = summary.threshold;
        } else {
            report["labels"] = Report::array();
            for (const auto& [label, cells] : summary.labels)
                report["labels"].push_back({{"label", label}, {"cells", cells}});
        }
    }
    const std::vector<std::string> notes = notes_of(array);
    if (array.data != path) report["data file"] = array.data.filename().string();
    if (!notes.empty()) report["notes"] = notes;
    return report;
}

Report describe_art(const std::filesystem::path& path, const VoxelFileFormat& format) {
    const VoxelArt art = format.art(path);
    Report report = {
        {"kind", format.name}, {"size", coordinates_of(art.size)}, {"voxels", art.model.voxels()}};
    if (!art.model.colors.empty()) report["colors"] = colors_in(art.model);
    if (!art.notes.empty()) report["notes"] = art.notes;
    return report;
}

}  // namespace voxelume::api
