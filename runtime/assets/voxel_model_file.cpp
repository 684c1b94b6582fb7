// SPDX-License-Identifier: Apache-2.0
#include "runtime/assets/voxel_model_file.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <span>
#include <string_view>
#include <utility>

#include "kernels/shared/voxel.h"
#include "runtime/base/files/input_file.hpp"
#include "runtime/base/ranges.hpp"
#include "runtime/base/text.hpp"
#include "runtime/grid/brick_cells.hpp"
#include "runtime/io/vdb/vdb_voxels.hpp"
#include "runtime/io/voxel_file_table.hpp"
#include "runtime/io/voxels/model_file.hpp"
#include "runtime/io/voxels/model_voxels.hpp"
#include "runtime/io/voxels/vox_voxels.hpp"
#include "runtime/io/voxels/voxel_limits.hpp"

namespace voxelume {
namespace {

constexpr double kFarthestCell = 1 << 30;

uint32_t srgb_byte(float linear) {
    const double v = std::clamp(double(linear), 0.0, 1.0);
    const double curved = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    return uint32_t(std::lround(255 * curved));
}

/// Assigns slots, in ascending order, to the bricks of `cells` for which `is_kept` is true.
template <class IsKept>
void number_bricks(const std::vector<glm::ivec3>& cells, const glm::ivec3& first,
                   const IsKept& is_kept, const InputFile& file, VoxelModel& model) {
    model.slots.assign(bricks_of(model.frame), kBrickOutside);
    const glm::ivec3 bricks = model.frame.bricks();
    for (size_t i = 0; i < cells.size(); ++i) {
        if (!is_kept(i)) continue;
        const size_t brick = brick_of(cells[i] - first, bricks);
        if (std::exchange(model.slots[brick], 0) == kBrickOutside)
            model.coordinates.push_back(uint32_t(brick));
    }
    check_stored_bricks(model.coordinates.size(), file);
    std::ranges::sort(model.coordinates);
    for (size_t slot = 0; slot < model.coordinates.size(); ++slot)
        model.slots[model.coordinates[slot]] = uint32_t(slot);
}

/// The index of cell `v` of the model among the voxels of its stored bricks.
size_t index_of(const VoxelModel& model, const glm::ivec3& v) {
    const uint32_t slot = model.slots[brick_of(v, model.frame.bricks())];
    return size_t(slot) * kVoxelsPerBrick + voxel_in_brick(v % kBrickSize);
}

void fill_cubes(const VdbVoxels& voxels, const glm::ivec3& first, const InputFile& file,
                VoxelModel& model) {
    number_bricks(
        voxels.cells, first, [&](size_t i) { return voxels.values[i] > 0; }, file, model);
    model.occupancy.assign(model.coordinates.size() * kLeavesPerBrick, 0);
    const auto covers = [&](size_t i) { return std::min(voxels.values[i], 1.0f); };
    for (size_t i = 0; i < voxels.cells.size(); ++i)
        model.transparent |= voxels.values[i] > 0 && covers(i) < 1;
    if (model.transparent || !voxels.colors.empty())
        model.colors.assign(model.coordinates.size() * kVoxelsPerBrick, 0xFFFFFF);
    for (size_t i = 0; i < voxels.cells.size(); ++i) {
        if (!(voxels.values[i] > 0)) continue;
        const glm::ivec3 v = voxels.cells[i] - first;
        const size_t index = index_of(model, v);
        model
            .occupancy[index / kVoxelsPerBrick * kLeavesPerBrick + leaf_in_brick(v % kBrickSize)] |=
            bit_in_leaf(v);
        if (model.colors.empty()) continue;
        uint32_t word = 0xFFFFFF;
        if (!voxels.colors.empty()) {
            const glm::vec3& c = voxels.colors[i];
            word = srgb_byte(c.r) | srgb_byte(c.g) << 8 | srgb_byte(c.b) << 16;
        }
        const uint32_t transparency = 255 - uint32_t(std::lround(255 * covers(i)));
        model.colors[index] = word | transparency << VXL_TRANSPARENCY_SHIFT;
    }
}

/// Calls `use` with each run of cells at the places first, first + stride, ... of `count` along x:
/// the number of the run's first place, how many it has, and their value.
template <class Use>
void for_runs(const VdbVoxels::Runs& run_at, const glm::ivec3& first, int count, int stride,
              const Use& use) {
    for (int i = 0; i < count;) {
        const ValueRun run = run_at(first + glm::ivec3(i * stride, 0, 0));
        const int places = std::min(count - i, (run.cells + stride - 1) / stride);
        use(i, places, run.value);
        i += places;
    }
}

/// Marks the bricks that aren't stored and lie inside the surface.
void mark_inside(const VdbVoxels& voxels, const glm::ivec3& first, VoxelModel& model) {
    const glm::ivec3 bricks = model.frame.bricks();
    for (int row = 0; row < bricks.y * bricks.z; ++row) {
        const std::span slots(model.slots.data() + size_t(row) * size_t(bricks.x),
                              size_t(bricks.x));
        const glm::ivec3 brick(0, row % bricks.y, row / bricks.y);
        for_runs(voxels.run_at, first + kBrickSize * brick, bricks.x, kBrickSize,
                 [&](int x, int count, float value) {
                     if (value < 0)
                         std::ranges::replace(slots.subspan(size_t(x), size_t(count)),
                                              kBrickOutside, kBrickInside);
                 });
    }
}

void fill_distances(const VdbVoxels& voxels, const glm::ivec3& first, const InputFile& file,
                    VoxelModel& model) {
    number_bricks(
        voxels.cells, first, [](size_t) { return true; }, file, model);
    mark_inside(voxels, first, model);
    model.distance.resize(model.coordinates.size() * kVoxelsPerBrick);
    const auto sign_bricks = [&](int begin, int end) {
        const VdbVoxels::Runs run_at = voxels.run_at;  // of this thread
        for (auto slot = size_t(begin); slot < size_t(end); ++slot) {
            const glm::ivec3 corner = first + brick_corner(model.frame, model.coordinates[slot]);
            for (size_t i = 0; i < kVoxelsPerBrick; i += kBrickSize)
                for_runs(run_at, corner + cell_in_brick(i), kBrickSize, 1,
                         [&](int x, int count, float value) {
                             std::fill_n(&model.distance[slot * kVoxelsPerBrick + i + size_t(x)],
                                         count, int16_t(value < 0 ? -32767 : 32767));
                         });
        }
    };
    for_ranges(int(model.coordinates.size()), model.distance.size(), sign_bricks);
    const glm::dvec3& e = model.frame.voxel_edge;
    const double units = kDistanceUnitsPerVoxel / std::min({e.x, e.y, e.z});
    const auto set_distances = [&](int begin, int end) {
        for (auto i = size_t(begin); i < size_t(end); ++i)
            model.distance[index_of(model, voxels.cells[i] - first)] =
                int16_t(std::lround(std::clamp(voxels.values[i] * units, -32767.0, 32767.0)));
    };
    for_ranges(int(voxels.cells.size()), voxels.cells.size(), set_distances);
}

VoxelModel model_of(const VdbVoxels& voxels, Surface surface, const InputFile& file) {
    if (voxels.cells.empty()) file.refuse("its grid has no voxels");
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (const glm::ivec3& cell : voxels.cells) {
        low = glm::min(low, glm::dvec3(cell));
        high = glm::max(high, glm::dvec3(cell));
    }
    const glm::dvec3 size = high - low + 1.0 + 2.0 * kModelMargin;
    check_listed_span(size, file);
    if (std::max(-std::min({low.x, low.y, low.z}), std::max({high.x, high.y, high.z})) >
        kFarthestCell)
        file.refuse("its voxels lie farther from its origin than can be counted");
    const glm::ivec3 first = glm::ivec3(low) - kModelMargin;
    VoxelModel model;
    model.surface = surface;
    model.frame.size = glm::ivec3(size);
    model.frame.voxel_edge = voxels.voxel_edges;
    // Cubes have their value in the middle; distances are at the voxel's minimum corner.
    const double to_corner = stores_distances(surface) ? 0.0 : 0.5;
    model.frame.origin = voxels.origin + voxels.voxel_edges * (glm::dvec3(first) - to_corner);
    check_reach(model.frame, file);
    check_voxel_edge(model.frame.voxel_edge, model.frame.origin, file);
    if (stores_distances(surface))
        fill_distances(voxels, first, file, model);
    else
        fill_cubes(voxels, first, file, model);
    return model;
}

/// The first eight bytes, or all of a shorter file.
std::string start_of(const InputFile& file) {
    std::string start(std::min<uint64_t>(8, file.size()), '\0');
    file.read(0, start.data(), start.size());
    return start;
}

constexpr std::string_view kModelStart = "\x89VXM\r\n\x1a\n";

}  // namespace

VoxelModel read_vox_model(const VoxFile& vox, Surface surface, int part) {
    if (!shows_voxels(surface))
        InputFile(vox.path).refuse("holds voxels alone: give it \"surface\": \"cubes\"");
    return read_vox_voxels(vox, part);
}

bool is_vox_file(const std::filesystem::path& path) {
    return start_of(InputFile(path)).starts_with("VOX ");
}

std::optional<Surface> surface_of_voxel_model(const std::filesystem::path& path) {
    const std::string start = start_of(InputFile(path));
    if (start.starts_with("VOX ")) return Surface::cubes;
    if (start != kModelStart) return std::nullopt;
    const ModelSummary summary = read_model_summary(path);
    const auto name = summary.header.find("surface");
    for (const SurfaceKind& kind : kSurfaceKinds)
        if (name != summary.header.end() && name->second == kind.name) return kind.surface;
    return std::nullopt;
}

VoxelModel read_voxel_model(const std::filesystem::path& path, Surface surface, int part,
                            const VoxelValues& values) {
    VoxelModel model = read_coded_model(path, surface, part, values);
    model.widen_colors();
    return model;
}

VoxelModel read_coded_model(const std::filesystem::path& path, Surface surface, int part,
                            const VoxelValues& values) {
    const InputFile file(path);
    const std::string start = start_of(file);
    if (part == 0)
        if (const VoxelFileFormat* format = voxel_file_format(path))
            return read_voxel_file(*format, path, surface, values);
    if (values.is_there()) file.refuse("has voxels and no values: leave out \"iso\" and \"label\"");
    const bool is_model = start == kModelStart, is_vdb = start == std::string(" BDV\0\0\0\0", 8);
    // Where the first bytes are unknown, the name decides, and its format's reader refuses the
    // file.
    const std::string ending = is_model || is_vdb ? "" : ending_of(path);
    if (start.starts_with("VOX ") || ending == ".vox")
        return read_vox_model(read_vox_file(path), surface, part);
    if (part != 0) file.refuse("is one model; only .vox files have parts");
    if (is_model || ending == ".vxm") return read_model_voxels(path, surface);
    if (!is_vdb && ending != ".vdb") file.refuse("is of no format of voxels that voxelume reads");
    if (lists_primitives(surface))
        file.refuse("an OpenVDB file has no exact surface: give it \"cubes\" or \"smooth\"");
    return model_of(read_vdb_voxels(path, surface), surface, file);
}

}  // namespace voxelume
