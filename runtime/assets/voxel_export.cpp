// SPDX-License-Identifier: Apache-2.0
#include "runtime/assets/voxel_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "kernels/shared/voxel.h"
#include "runtime/base/text.hpp"
#include "runtime/base/version.hpp"
#include "runtime/grid/brick_cells.hpp"
#include "runtime/io/mesh/mesh_color.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/io/voxel_art/cube_list.hpp"
#include "runtime/io/voxel_output_table.hpp"
#include "runtime/io/voxels/model_file.hpp"

namespace voxelume {
namespace {

template <class Vector>
std::string vector_text(const Vector& v) {
    return fmt::format("{} {} {}", v.x, v.y, v.z);
}

const char* set_name(VoxelSet set) {
    return set == VoxelSet::solid ? "solid" : set == VoxelSet::thin ? "thin" : "supercover";
}

glm::vec3 linear_color(uint32_t code) {
    return linear_from_srgb(glm::dvec3(code & 255, code >> 8 & 255, code >> 16 & 255) / 255.0);
}

/// The opacity of a voxel with this colour code.
float opacity_of(uint32_t code) {
    return float(255 - (code >> VXL_TRANSPARENCY_SHIFT)) / 255;
}

double shortest_edge(const GridFrame& frame) {
    return std::min({frame.voxel_edge.x, frame.voxel_edge.y, frame.voxel_edge.z});
}

}  // namespace

VoxelExport::VoxelExport(const BrickGrid& grid, const Mesh& mesh, Surface surface, VoxelSet set)
    : frame_(grid.frame),
      surface_(surface),
      slots_(grid.slots.read()),
      coordinates_(grid.coordinates.read()),
      occupancy_(grid.occupancy.read()),
      distance_(grid.distance.read()),
      attributes_(grid.attributes.read()),
      colors_(grid.colors.read()),
      normals_(grid.normals.read()),
      primitive_first_(grid.primitive_first.read()),
      primitives_(grid.primitives.read()),
      triangle_attributes_(grid.triangle_attributes.read()),
      triangle_normals_(grid.triangle_normals.read()),
      triangles_(grid.triangles.read()) {
    set_header();
    if (shows_voxels(surface)) header_["set"] = set_name(set);
    std::string groups;
    for (const std::string& name : mesh.group_names) groups += name + "\n";
    if (!groups.empty()) header_["groups"] = groups;
}

VoxelExport::VoxelExport(VoxelModel model)
    : frame_(model.frame),
      surface_(Surface::cubes),
      slots_(std::move(model.slots)),
      coordinates_(std::move(model.coordinates)),
      occupancy_(std::move(model.occupancy)),
      colors_(std::move(model.colors)),
      full_colors_(std::move(model.full_colors)) {
    set_header();
    header_["set"] = set_name(model.set);
}

void VoxelExport::set_header() {
    header_ = {{"format", "voxelume bricks 1"},
               {"software", fmt::format("voxelume {}", version())},
               {"surface", std::string(kind_of(surface_).name)},
               {"size", vector_text(frame_.size)},
               {"origin", vector_text(frame_.origin)},
               {"voxel_edge", vector_text(frame_.voxel_edge)}};
}

VoxelModel VoxelExport::cubes() const {
    VoxelModel model;
    model.frame = frame_;
    model.surface = surface_;
    model.slots = slots_;
    model.coordinates = coordinates_;
    model.occupancy = occupancy_;
    model.colors = colors_;
    model.attributes = attributes_;
    model.full_colors = full_colors_;
    return model;
}

void VoxelExport::write_model(const std::filesystem::path& path) const {
    ModelFile file;
    file.header = header_;
    const auto add = [&](const char* name, const auto& values) {
        if (!values.empty()) file.arrays[name] = values;
    };
    add("slots", slots_);
    add("coordinates", coordinates_);
    add("occupancy", occupancy_);
    add("distance", distance_);
    add("attributes", attributes_);
    add("colors", colors_);
    add("normals", normals_);
    add("primitive_first", primitive_first_);
    add("primitives", primitives_);
    add("triangles", triangles_);
    add("triangle_attributes", triangle_attributes_);
    add("triangle_normals", triangle_normals_);
    write_model_file(path, file);
}

void VoxelExport::add_brick(uint32_t slot, Cells& cells) const {
    const glm::ivec3 corner = brick_corner(frame_, coordinates_[slot]);
    const double unit = shortest_edge(frame_) / kDistanceUnitsPerVoxel;
    for (uint32_t number = 0; number < kVoxelsPerBrick; ++number) {
        const size_t index = size_t(slot) * kVoxelsPerBrick + number;
        const glm::ivec3 p = cell_in_brick(number);
        if (stores_distances(surface_)) {
            const double distance = distance_[index];
            if (std::abs(distance) >= kExportBand * kDistanceUnitsPerVoxel) continue;
            cells.values.push_back(float(distance * unit));
        } else {
            const size_t leaf = size_t(slot) * kLeavesPerBrick + leaf_in_brick(p);
            if ((occupancy_[leaf] & bit_in_leaf(p)) == 0) continue;
            cells.values.push_back(colors_.empty() ? 1 : opacity_of(colors_[index]));
        }
        cells.cells.push_back(corner + p);
        if (!colors_.empty()) cells.colors.push_back(linear_color(colors_[index]));
    }
}

/// Adds the bricks wholly inside a solid set. Such bricks at the grid's end are stored anyway.
void VoxelExport::add_full_bricks(Cells& cells) const {
    for (size_t brick = 0; brick < slots_.size(); ++brick) {
        if (slots_[brick] != kBrickInside) continue;
        const glm::ivec3 corner = brick_corner(frame_, brick);
        for (uint32_t number = 0; number < kVoxelsPerBrick; ++number)
            cells.cells.push_back(corner + cell_in_brick(number));
        const bool is_painted = !colors_.empty() && !full_colors_.empty();
        cells.values.resize(cells.cells.size(), is_painted ? opacity_of(full_colors_[brick]) : 1);
        if (!colors_.empty())
            cells.colors.resize(cells.cells.size(),
                                is_painted ? linear_color(full_colors_[brick]) : glm::vec3(1));
    }
}

void VoxelExport::write_vdb(const std::filesystem::path& path) const {
    const bool smooth = stores_distances(surface_);
    Cells cells;
    for (uint32_t slot = 0; slot < coordinates_.size(); ++slot) add_brick(slot, cells);
    if (!smooth) add_full_bricks(cells);
    VdbVolume volume;
    volume.name = smooth ? "surface" : "density";
    volume.grid_class = smooth ? VdbClass::level_set : VdbClass::fog;
    volume.cells = cells.cells;
    volume.values = cells.values;
    volume.colors = cells.colors;
    volume.background = smooth ? float(kExportBand * shortest_edge(frame_)) : 0;
    volume.voxel_edges = frame_.voxel_edge;
    volume.origin = frame_.origin + (smooth ? 0.0 : 0.5) * frame_.voxel_edge;
    volume.metadata = header_;
    voxelume::write_vdb(path, volume);
}

std::vector<std::string> write_cubes(const std::filesystem::path& path, const VoxelExport& voxels) {
    if (const auto write = check_voxel_output(path).write)
        return write(path, cube_list(voxels.cubes()));
    if (ending_of(path) == ".vdb")
        voxels.write_vdb(path);
    else
        voxels.write_model(path);
    return {};
}

}  // namespace voxelume
