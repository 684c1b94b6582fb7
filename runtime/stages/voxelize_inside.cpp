// triangles of each brick -> which of its points are inside, by winding numbers.
#include "runtime/stages/voxelize_steps.hpp"

namespace voxelume {

Buffer<uint16_t> find_inside(VoxelizeJob& job, const Program& winding) {
    const TriangleBins& b = job.bins;
    Buffer<int16_t> numbers(job.device, "winding numbers", size_t(4096) * b.stored);
    Buffer<int16_t> totals(job.device, "crossing totals", size_t(256) * b.count);
    winding.kernel("count_crossings")
        .launch(WorkItem::heavy, b.count, b.count, b.stored, b.size, job.triangles.vertices,
                job.triangles.triangles, b.occupied, b.first, b.lists, numbers, totals);
    const auto rows = static_cast<uint32_t>(job.bricks.y * job.bricks.z);
    winding.kernel("carry_rows")
        .launch(WorkItem::heavy, rows, rows, b.size, b.number_of_bin, totals, job.grid.slots);
    Buffer<uint16_t> inside(job.device, "inside rows", size_t(256) * b.stored);
    winding.kernel("find_inside")
        .launch(WorkItem::heavy, b.stored, b.stored, numbers, totals, inside);
    return inside;
}

}  // namespace voxelume
