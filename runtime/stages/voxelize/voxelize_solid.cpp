// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/voxelize/voxelize_solid.hpp"

#include <CL/cl_platform.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>
#include <vector>

#include "kernels/shared/voxel.h"
#include "runtime/geometry/solid/solid_membership.hpp"
#include "runtime/geometry/solid/solid_program.hpp"
#include "runtime/grid/brick_cells.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/brick_arrays.hpp"

namespace voxelume {
namespace {

constexpr double kBand = 2.8;  // distances within this many voxels of the surface are stored

cl_int4 int4_of(const glm::ivec3& v) {
    return cl_int4{{v.x, v.y, v.z, 0}};
}

/// The state that the steps of one call share.
class SolidVoxelizer {
  public:
    SolidVoxelizer(const Device& device, SolidProgram program, const GridFrame& frame)
        : device_(device),
          code_(device, "voxelize/voxelize_solid.cl", {{"VXL_NATIVE_DIVIDE", device.is_cpu()}}),
          program_(std::move(program)),
          solids_(device, "solids", program_.words()) {
        grid_.frame = frame;
        const glm::dvec3& edge = frame.voxel_edge;
        half_diagonal_ = 0.5 * glm::length(edge) / std::min({edge.x, edge.y, edge.z});
    }

    BrickGrid run(const VoxelizeOptions& options) {
        const bool is_smooth = stores_distances(options.surface);
        const VoxelSet set = shows_voxels(options.surface) ? options.set : VoxelSet::supercover;
        find_bricks(is_smooth, !is_smooth && set == VoxelSet::solid);
        if (is_smooth)
            sample();
        else
            occupy(set);
        if (lists_primitives(options.surface)) list_primitives();
        if (has_cube_normals(options)) give_normals();
        return std::move(grid_);
    }

  private:
    /// `voxels` times half a voxel's diagonal, plus `more`, in shortest edges, rounded up.
    float reach(double voxels, double more) const {
        return std::nextafter(static_cast<float>(voxels * half_diagonal_ + more), INFINITY);
    }

    /// The slot of a brick that no surface passes through, with the grid's end taken into account.
    /// A solid set has no voxels beyond the grid's size, so bricks across the end are stored (0)
    /// and those past it are outside.
    uint32_t state_at_end(uint32_t brick, uint32_t state) const {
        const glm::ivec3 corner = brick_corner(grid_.frame, brick), &size = grid_.frame.size;
        if (glm::any(glm::greaterThanEqual(corner, size))) return kBrickOutside;
        const bool is_cut = glm::any(glm::greaterThan(corner + kBrickSize, size));
        return state == kBrickInside && is_cut ? 0u : state;
    }

    void find_bricks(bool of_nodes, bool is_solid_set) {
        const glm::ivec3 bricks = grid_.frame.bricks();
        const auto count = static_cast<uint32_t>(bricks.x * bricks.y * bricks.z);
        const auto lanes = static_cast<uint32_t>(device_.lanes());
        const uint32_t items = (count + lanes - 1) / lanes;
        const double band = of_nodes ? kBand : 0.0, less = of_nodes ? 1.0 : 0.0;
        Buffer<uint32_t> states(device_, "brick states", items * lanes);
        code_.kernel("classify_solid_bricks")
            .launch(WorkItem::light, items, solids_, int4_of(bricks), count, cl_int{of_nodes},
                    reach(kBrickSize - less, band), reach(kLeafSize - less, band), states);

        std::vector<uint32_t> slots = states.read(0, count), coordinates;
        for (uint32_t brick = 0; brick < count; ++brick) {
            if (!of_nodes && !is_solid_set && slots[brick] == kBrickInside)
                slots[brick] = kBrickOutside;  // a shell is empty inside
            if (!of_nodes && (is_solid_set || slots[brick] == 0))
                slots[brick] = state_at_end(brick, slots[brick]);
            if (slots[brick] != 0) continue;
            slots[brick] = static_cast<uint32_t>(coordinates.size());
            coordinates.push_back(brick);
        }
        grid_.brick_count = static_cast<uint32_t>(coordinates.size());
        grid_.slots = Buffer<uint32_t>(device_, "slots", slots);
        grid_.coordinates = Buffer<uint32_t>(device_, "coordinates", coordinates);
    }

    /// Runs a kernel over all nodes or voxels of the stored bricks.
    template <class T>
    void run_over_bricks(Kernel kernel, const Buffer<T>& values) {
        constexpr uint32_t kBricksPerLaunch = 1u << 16;  // 2^28 nodes: the count fits its type
        for (uint32_t first = 0; first < grid_.brick_count; first += kBricksPerLaunch) {
            const uint32_t bricks = std::min(kBricksPerLaunch, grid_.brick_count - first);
            const auto nodes = static_cast<uint32_t>(bricks * kVoxelsPerBrick);
            kernel.launch(WorkItem::light, nodes / static_cast<uint32_t>(device_.lanes()), solids_,
                          grid_.coordinates, int4_of(grid_.frame.bricks()), first, nodes, values);
        }
    }

    void sample() {
        grid_.distance = allocate_distances(device_, "distance", grid_.brick_count);
        run_over_bricks(code_.kernel("sample_solid"), grid_.distance);
    }

    void give_normals() {
        grid_.normals = allocate_words(device_, "voxel normals", grid_.brick_count);
        const Program code(device_, "voxelize/voxelize_normals.cl",
                           {{"VXL_NATIVE_DIVIDE", device_.is_cpu()}});
        run_over_bricks(code.kernel("normals_of_solid"), grid_.normals);
    }

    void occupy(VoxelSet set) {
        const auto leaves = static_cast<uint32_t>(grid_.brick_count * kLeavesPerBrick);
        grid_.occupancy = allocate_masks(device_, "occupancy", grid_.brick_count);
        Buffer<uint64_t> undecided = allocate_masks(device_, "undecided voxels", grid_.brick_count);
        Buffer<uint32_t> undecided_count(device_, "undecided count", 1);
        undecided_count.fill(0);
        code_.kernel("occupy_solid")
            .launch(WorkItem::light, leaves, solids_, grid_.coordinates,
                    int4_of(grid_.frame.bricks()), int4_of(grid_.frame.size), leaves,
                    static_cast<uint32_t>(set), glm::vec2(reach(kLeafSize, 0.0), reach(1, 0.0)),
                    grid_.occupancy, undecided, undecided_count);
        if (undecided_count.read_one(0) != 0) decide(set, undecided.read());
    }

    /// Decides the voxels in `undecided` exactly and corrects the occupancy masks.
    void decide(VoxelSet set, const std::vector<uint64_t>& undecided) {
        std::vector<uint64_t> occupancy = grid_.occupancy.read();
        const std::vector<uint32_t> coordinates = grid_.coordinates.read();
        for (size_t leaf = 0; leaf < undecided.size(); ++leaf) {
            const glm::ivec3 corner =
                brick_corner(grid_.frame, coordinates[leaf / kLeavesPerBrick]) +
                leaf_corner(leaf % kLeavesPerBrick);
            for (uint64_t left = undecided[leaf]; left != 0; left &= left - 1) {
                const int bit = std::countr_zero(left);
                const glm::ivec3 voxel = corner + cell_in_leaf(bit);
                const uint64_t mask = uint64_t{1} << bit;
                if (belongs(set, voxel))
                    occupancy[leaf] |= mask;
                else
                    occupancy[leaf] &= ~mask;
            }
        }
        grid_.occupancy.write(occupancy);
    }

    bool belongs(VoxelSet set, const glm::ivec3& voxel) const {
        const auto is_inside = [&](const glm::ivec3& half_voxels) {
            return exact_side(program_, half_voxels) <= 0;
        };
        const glm::ivec3 middle = 2 * voxel + 1;
        if (set == VoxelSet::solid) return is_inside(middle);
        const bool inside = is_inside(middle);
        for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 half(0);
            half[axis] = 1;
            if (is_inside(middle - half) != inside || is_inside(middle + half) != inside)
                return true;
        }
        return false;
    }

    void list_primitives() {
        const uint32_t bricks = grid_.brick_count;
        Buffer<uint32_t> counts(device_, "voxels of bricks", bricks);
        code_.kernel("count_solid_voxels")
            .launch(WorkItem::light, bricks, grid_.occupancy, bricks, counts);
        std::vector<uint32_t> firsts = counts.read();
        firsts.push_back(0);
        std::exclusive_scan(firsts.begin(), firsts.end(), firsts.begin(), 0u);
        counts = Buffer<uint32_t>(device_, "first primitives", firsts);

        const size_t voxels = bricks * kVoxelsPerBrick;
        grid_.primitive_first = allocate_list_starts(device_, "primitive_first", bricks);
        code_.kernel("number_voxels")
            .launch(WorkItem::light, bricks, grid_.occupancy, counts, bricks,
                    grid_.primitive_first);
        grid_.primitive_first.write(std::span(&firsts.back(), 1), voxels);
        grid_.primitives = Buffer<uint32_t>(device_, "primitives", firsts.back());
        grid_.primitives.fill(kSolidPrimitive);
        grid_.solids = solids_;
    }

    Device device_;
    Program code_;
    SolidProgram program_;
    Buffer<uint32_t> solids_;
    BrickGrid grid_;
    double half_diagonal_;  // half a voxel's diagonal, in shortest edges
};

}  // namespace

BrickGrid voxelize_solid(const Device& device, const Solid& solid,
                         const glm::dmat4& frame_from_solid, const GridFrame& frame,
                         const VoxelizeOptions& options) {
    SolidProgram program = make_solid_program(solid, frame_from_solid, frame);
    program.shapes.front().attribute = static_cast<uint32_t>(options.surface) << VXL_KIND_SHIFT;
    return SolidVoxelizer(device, std::move(program), frame).run(options);
}

BrickGrid voxelize_part(const Device& device, const Solid& solid, bool is_complement,
                        const glm::dmat4& frame_from_solid, const GridFrame& frame) {
    SolidProgram program = make_solid_program(solid, frame_from_solid, frame, is_complement);
    program.shapes.front().attribute = VXL_KIND_SMOOTH << VXL_KIND_SHIFT;
    return SolidVoxelizer(device, std::move(program), frame).run({.surface = Surface::smooth});
}

}  // namespace voxelume
