// SPDX-License-Identifier: Apache-2.0
// triangles of each brick -> the brick's points that are inside, by winding numbers.
#include "runtime/stages/brick_arrays.hpp"
#include "runtime/stages/voxelize/voxelize_steps.hpp"

namespace voxelume {

namespace {

Windings count_windings(VoxelizeJob& job, const Program& winding, const TriangleBins& b) {
    Windings w = allocate_windings(job.device, b.stored, b.count, job.grid.slots.size());
    winding.kernel("count_crossings")
        .launch(WorkItem::heavy, b.count, job.triangles, b, w.numbers, w.row_starts);
    const auto rows = static_cast<uint32_t>(job.bricks.y * job.bricks.z);
    winding.kernel("carry_rows")
        .launch(WorkItem::heavy, rows, rows, b.size, b.number_of_bin, w.row_starts, job.grid.slots,
                w.passing);
    return w;
}

// The states of kernels/voxelize/voxelize_caps.cl.
constexpr uint32_t kStateInside = 1, kStateClosed = 2;

std::vector<uint32_t> classify_bricks(VoxelizeJob& job, const Program& caps,
                                      const TriangleBins& cap_bins, const TriangleBins& all_bins,
                                      const Windings& w, Buffer<uint32_t>& states) {
    const auto count = static_cast<uint32_t>(job.grid.slots.size());
    const auto lanes = static_cast<uint32_t>(job.device.lanes());
    const glm::vec4 scale = edge_scale(job.grid.frame);
    const float radius = 0.5f * kBrickSize * glm::length(glm::vec3(scale));
    states = Buffer<uint32_t>(job.device, "brick states", count);
    caps.kernel("classify_open_bricks")
        .launch(WorkItem::heavy, (count + lanes - 1) / lanes, count, job.bricks, scale, radius,
                job.caps, job.bins.number_of_bin, cap_bins.number_of_bin, all_bins.number_of_bin, w,
                states);
    return states.read();
}

/// The stored bricks by state: those with surface, in their order, and the new ones between them.
struct Restored {
    std::vector<uint32_t> slots, coordinates, first, numbers;
};

Restored restore_bricks(const VoxelizeJob& job, const TriangleBins& all_bins,
                        const std::vector<uint32_t>& states) {
    const std::vector<uint32_t> surface = job.bins.number_of_bin.read(),
                                first = job.bins.first.read(), all = all_bins.number_of_bin.read();
    Restored r;
    uint32_t passed = 0;  // bricks with surface so far
    for (uint32_t brick = 0; brick < states.size(); ++brick) {
        if (states[brick] < kStateClosed) {
            r.slots.push_back(states[brick] == kStateInside ? kBrickInside : kBrickOutside);
            continue;
        }
        const size_t bin = brick + brick / static_cast<uint32_t>(job.bricks.x) + 1;
        r.slots.push_back(static_cast<uint32_t>(r.coordinates.size()));
        r.coordinates.push_back(brick);
        r.first.push_back(first[passed]);
        r.numbers.push_back(all[bin]);
        if (surface[bin] != kBrickOutside) ++passed;
    }
    r.first.push_back(first[passed]);
    return r;
}

Buffer<uint32_t> upload(const VoxelizeJob& job, const char* name,
                        const std::vector<uint32_t>& values) {
    return Buffer<uint32_t>(job.device, name, std::span<const uint32_t>(values));
}

}  // namespace

Windings allocate_windings(const Device& device, size_t stored, size_t bins, size_t frame_bricks) {
    Windings w;
    w.numbers = allocate_distances(device, "winding numbers", stored);
    w.row_starts = Buffer<int16_t>(device, "crossing totals", 256 * bins);
    w.passing = Buffer<int16_t>(device, "passing windings", frame_bricks);
    return w;
}

void bind(KernelArguments& to, const Windings& windings) {
    to.add(windings.numbers, windings.row_starts, windings.passing);
}

Buffer<uint16_t> allocate_inside(const Device& device, size_t stored) {
    return {device, "inside rows", 256 * stored};
}

Buffer<uint16_t> find_inside(VoxelizeJob& job, const Program& winding) {
    const uint32_t stored = job.bins.stored;
    const Windings w = count_windings(job, winding, job.bins);
    Buffer<uint16_t> inside = allocate_inside(job.device, stored);
    winding.kernel("find_inside")
        .launch(WorkItem::heavy, stored, stored, w.numbers, w.row_starts, inside);
    return inside;
}

Buffer<uint16_t> find_inside_open(VoxelizeJob& job, const Program& winding, const Program& caps,
                                  const TriangleBins& cap_bins, const TriangleBins& all_bins) {
    const Windings w = count_windings(job, winding, all_bins);
    Buffer<uint32_t> states;
    const Restored r =
        restore_bricks(job, all_bins, classify_bricks(job, caps, cap_bins, all_bins, w, states));
    job.bins.stored = job.grid.brick_count = static_cast<uint32_t>(r.coordinates.size());
    job.bins.coordinates = job.grid.coordinates = upload(job, "brick coordinates", r.coordinates);
    job.bins.first = upload(job, "bin starts", r.first);
    job.grid.slots = upload(job, "brick slots", r.slots);
    Buffer<uint16_t> inside = allocate_inside(job.device, job.bins.stored);
    caps.kernel("find_inside_open")
        .launch(WorkItem::heavy, job.items(), job.bins.stored, job.bricks,
                edge_scale(job.grid.frame), job.caps, job.bins.coordinates, states,
                upload(job, "bin numbers", r.numbers), w, inside);
    return inside;
}

}  // namespace voxelume
