#include "runtime/stages/voxelize.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/error.hpp"
#include "runtime/stages/mesh_lattice.hpp"
#include "runtime/stages/voxelize_bins.hpp"

namespace voxelume {
namespace {

constexpr int kLatticePerBrick = kBrickSize * kLatticePerVoxel;

void check_frame(const GridFrame& frame) {
    for (int a = 0; a < 3; ++a) {
        if (frame.size[a] < 1 || frame.size[a] > kLatticeReach)
            throw Error(ErrorKind::limit,
                        "a grid of {} x {} x {} voxels: each axis must have 1 to {} voxels",
                        frame.size.x, frame.size.y, frame.size.z, kLatticeReach);
        if (!(frame.voxel_edge[a] > 0) || !std::isfinite(frame.voxel_edge[a]))
            throw Error(ErrorKind::input, "a voxel edge of {} m: it must be above 0",
                        frame.voxel_edge[a]);
    }
}

DeviceTriangles upload(const Device& device, const MeshLattice& mesh) {
    DeviceTriangles d;
    d.count = static_cast<uint32_t>(mesh.triangles.size());
    d.vertices = Buffer<int32_t>(
        device, "lattice vertices",
        std::span(&mesh.vertices.front().x, 3 * mesh.vertices.size()));
    d.triangles = Buffer<uint32_t>(
        device, "lattice triangles",
        std::span(&mesh.triangles.front().x, 3 * mesh.triangles.size()));
    return d;
}

/// Slices of a brick that one work-item handles: all where cores are few, else one layer of leaves.
int slices_per_item(const Device& device) {
    return device.is_cpu() ? kBrickSize : kLeafSize;
}

/// Everything that the kernels of one call share.
struct Job {
    const Device& device;
    DeviceTriangles triangles;
    TriangleBins bins;
    glm::ivec4 size, bricks;
    BrickGrid grid;

    size_t items() const { return size_t(bins.stored) * (kBrickSize / slices_per_item(device)); }
};

void use_bins(Job& job, TriangleBins bins) {
    job.bins = std::move(bins);
    job.grid.brick_count = job.bins.stored;
    job.grid.coordinates = job.bins.coordinates;
    const glm::ivec4& b = job.bricks;
    job.grid.slots = Buffer<uint32_t>(job.device, "brick slots", size_t(b.x) * b.y * b.z);
}

void cover_bricks(Job& job, const Program& program) {
    job.grid.occupancy = Buffer<uint64_t>(job.device, "occupancy", size_t(64) * job.bins.stored);
    program.kernel("cover_bricks")
        .launch(WorkItem::heavy, job.items(), job.bins.stored, job.size, job.bricks,
                job.triangles.vertices, job.triangles.triangles, job.bins.coordinates,
                job.bins.first, job.bins.lists, job.grid.occupancy);
}

/// Marks the bricks that are not stored as outside, without looking at winding numbers.
void mark_outside(Job& job, const Program& program) {
    const uint32_t rows = uint32_t(job.bricks.y * job.bricks.z);
    program.kernel("mark_outside")
        .launch(WorkItem::light, rows, rows, job.bins.size, job.bins.number_of_bin, job.grid.slots);
}

/// Finds which points (voxels' centres or corners, as `program` was built) are inside.
Buffer<uint16_t> find_inside(Job& job, const Program& program) {
    Buffer<int16_t> winding(job.device, "winding numbers", size_t(4096) * job.bins.stored);
    Buffer<int16_t> totals(job.device, "crossing totals", size_t(256) * job.bins.count);
    program.kernel("count_crossings")
        .launch(WorkItem::heavy, job.bins.count, job.bins.count, job.bins.stored, job.bins.size,
                job.triangles.vertices, job.triangles.triangles, job.bins.occupied, job.bins.first,
                job.bins.lists, winding, totals);
    const uint32_t rows = uint32_t(job.bricks.y * job.bricks.z);
    program.kernel("carry_rows")
        .launch(WorkItem::heavy, rows, rows, job.bins.size, job.bins.number_of_bin, totals,
                job.grid.slots);
    Buffer<uint16_t> inside(job.device, "inside rows", size_t(256) * job.bins.stored);
    program.kernel("find_inside")
        .launch(WorkItem::heavy, job.bins.stored, job.bins.stored, winding, totals, inside);
    return inside;
}

void fill_solid(Job& job, const Program& program, const Buffer<uint16_t>& inside) {
    job.grid.occupancy = Buffer<uint64_t>(job.device, "occupancy", size_t(64) * job.bins.stored);
    program.kernel("fill_solid")
        .launch(WorkItem::heavy, job.bins.stored, job.bins.stored, job.size, job.bricks,
                job.bins.coordinates, inside, job.grid.occupancy);
}

/// Voxel edges in the shortest one.
glm::vec4 edge_scale(const GridFrame& frame) {
    const glm::dvec3& e = frame.voxel_edge;
    return glm::vec4(e / std::min({e.x, e.y, e.z}), 0);
}

glm::ivec3 band_reach(const GridFrame& frame, double band) {
    const glm::dvec3& e = frame.voxel_edge;
    return glm::ivec3(glm::ceil(band * std::min({e.x, e.y, e.z}) / e * double(kLatticePerVoxel))) + 1;
}

void measure_distances(Job& job, const Program& program, const Buffer<uint16_t>& inside,
                       double band) {
    const glm::vec4 scale = edge_scale(job.grid.frame);
    const glm::ivec4 reach(band_reach(job.grid.frame, band), 0);
    Buffer<float> shapes(job.device, "triangle shapes", size_t(20) * job.triangles.count);
    program.kernel("shape_triangles")
        .launch(WorkItem::light, job.triangles.count, job.triangles.count, scale,
                job.triangles.vertices, job.triangles.triangles, shapes);
    job.grid.distance = Buffer<int16_t>(job.device, "distances", size_t(4096) * job.bins.stored);
    program.kernel("measure_distances")
        .launch(WorkItem::heavy, job.items(), job.bins.stored, job.bricks, reach, scale,
                static_cast<float>(band), job.triangles.vertices, job.triangles.triangles, shapes,
                job.bins.coordinates, job.bins.first, job.bins.lists, inside, job.grid.distance);
}

}  // namespace

const Program& Voxelizer::program(const std::string& file, const Defines& defines) {
    std::string key = file;
    for (const auto& [name, value] : defines) key += fmt::format(" {}={}", name, value);
    const auto found = programs_.find(key);
    if (found != programs_.end()) return found->second;
    return programs_.emplace(key, Program(device_, file, defines)).first->second;
}

BrickGrid Voxelizer::voxelize(const Mesh& mesh, const glm::dmat4& frame_from_mesh,
                              const GridFrame& frame, const VoxelizeOptions& options) {
    check_frame(frame);
    const bool smooth = options.surface == Surface::smooth;
    const double band = std::min(options.band, 4.0);
    const MeshLattice lattice = snap_to_lattice(mesh, frame_from_mesh, frame);
    Job job{device_, upload(device_, lattice), {}, glm::ivec4(frame.size, 0),
            glm::ivec4(frame.bricks(), 0), {}};
    job.grid.frame = frame;
    use_bins(job, bin_triangles(device_, program("voxelize_bin.cl", {}), job.triangles,
                                frame.bricks(), smooth ? band_reach(frame, band) : glm::ivec3(0),
                                smooth ? kLatticePerBrick - kLatticePerVoxel : kLatticePerBrick));
    const Defines slices{{"VXL_SLICES", slices_per_item(device_)}};
    if (smooth) {
        const Buffer<uint16_t> inside =
            find_inside(job, program("voxelize_winding.cl", {{"VXL_CENTERS", 0}}));
        measure_distances(job, program("voxelize_distance.cl", slices), inside, band);
    } else if (options.set == VoxelSet::solid && options.surface == Surface::cubes) {
        const Program& winding = program("voxelize_winding.cl", {{"VXL_CENTERS", 1}});
        fill_solid(job, winding, find_inside(job, winding));
    } else {
        const bool thin = options.set == VoxelSet::thin && options.surface == Surface::cubes;
        cover_bricks(job, program("voxelize_cover.cl",
                                  {{"VXL_SLICES", slices_per_item(device_)}, {"VXL_THIN", thin}}));
        mark_outside(job, program("voxelize_bin.cl", {}));
    }
    return job.grid;
}

GridFrame frame_around(const Mesh& mesh, const glm::dvec3& voxel_edge, int margin) {
    if (mesh.positions.empty())
        throw Error(ErrorKind::input, "the mesh has no vertices: there is nothing to voxelize");
    glm::dvec3 low(mesh.positions.front()), high(low);
    for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, glm::dvec3(p));
        high = glm::max(high, glm::dvec3(p));
    }
    const glm::dvec3 size = glm::ceil((high - low) / voxel_edge);
    for (int a = 0; a < 3; ++a)
        if (!(size[a] + 2 * margin <= kLatticeReach))
            throw Error(ErrorKind::limit,
                        "the mesh is {:.4g} m long, {:.5g} voxels of {:.4g} m: at most {} are "
                        "possible, use voxels of at least {:.2g} m",
                        high[a] - low[a], size[a], voxel_edge[a], kLatticeReach - 2 * margin,
                        1.05 * (high[a] - low[a]) / (kLatticeReach - 2 * margin));
    GridFrame frame;
    frame.voxel_edge = voxel_edge;
    frame.size = glm::max(glm::ivec3(size), glm::ivec3(1)) + 2 * margin;
    frame.origin = low - voxel_edge * double(margin);
    return frame;
}

}  // namespace voxelume
