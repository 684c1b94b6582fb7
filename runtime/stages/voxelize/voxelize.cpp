// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/voxelize/voxelize.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "kernels/shared/voxel.h"
#include "runtime/base/error.hpp"
#include "runtime/geometry/mesh_normals.hpp"
#include "runtime/geometry/mesh_points.hpp"
#include "runtime/stages/brick_arrays.hpp"
#include "runtime/stages/voxelize/mesh_lattice.hpp"
#include "runtime/stages/voxelize/voxelize_steps.hpp"
#include "runtime/stages/voxelize/voxelize_textures.hpp"

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
    DeviceTriangles d = allocate_triangles(device, mesh.vertices.size(), mesh.triangles.size());
    d.count = static_cast<uint32_t>(mesh.surface_triangles);
    d.vertices.write(std::span(&mesh.vertices.front().x, 3 * mesh.vertices.size()));
    d.triangles.write(std::span(&mesh.triangles.front().x, 3 * mesh.triangles.size()));
    return d;
}

/// The `count` triangles of `all` from number `first` on.
DeviceTriangles part_of(DeviceTriangles all, size_t first, size_t count) {
    all.first = static_cast<uint32_t>(first);
    all.count = static_cast<uint32_t>(count);
    return all;
}

/// Makes the bins with triangles the grid's stored bricks.
void store_bins(VoxelizeJob& job, TriangleBins bins) {
    job.bins = std::move(bins);
    job.grid.brick_count = job.bins.stored;
    job.grid.coordinates = job.bins.coordinates;
    job.grid.slots = allocate_slots(job.device, "brick slots", job.grid.frame);
}

/// True if the options need the inside of a mesh.
bool needs_inside(const VoxelizeOptions& options) {
    return stores_distances(options.surface) ||
           (shows_voxels(options.surface) && options.set == VoxelSet::solid);
}

/// The lattice units by which `exact` voxels are widened: rays meet corners that aren't snapped.
constexpr int kListMargin = 1;

/// The mesh with its triangles' corners in the opposite order. A map that mirrors turns them back.
Mesh turned_over(Mesh mesh) {
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    for (glm::uvec3& t : mesh.triangle_normals) std::swap(t.y, t.z);
    for (glm::uvec3& t : mesh.triangle_colors) std::swap(t.y, t.z);
    for (glm::uvec3& t : mesh.triangle_uvs) std::swap(t.y, t.z);
    return mesh;
}

// The kinds of surfaces fit the bits of a voxel's kind, whose last number is in use.
static_assert(kSurfaceKinds.size() <= VXL_KIND_EXACT_IN_CUBE);

/// The values that the mesh's groups and colours give to voxels; the packed attributes are those of
/// shared/voxel.h.
MeshLabels labels_of(const Mesh& mesh, Surface surface) {
    MeshLabels labels;
    labels.attributes = static_cast<uint32_t>(surface) << VXL_KIND_SHIFT;
    labels.mesh = &mesh;
    const std::vector<uint32_t>& groups = mesh.triangle_group;
    if (std::all_of(groups.begin(), groups.end(), [](uint32_t g) { return g == 0; })) return labels;
    if (*std::max_element(groups.begin(), groups.end()) > VXL_MATERIAL_MASK)
        throw Error(ErrorKind::limit, "the mesh has more than {} face groups",
                    VXL_MATERIAL_MASK + 1);
    for (const uint32_t group : groups)
        labels.triangle_attributes.push_back(labels.attributes | group << VXL_MATERIAL_SHIFT);
    return labels;
}

/// Stores the triangles that `exact` voxels list, for rays: their corners in voxels, not rounded.
void keep_triangles(VoxelizeJob& job, const Mesh& mesh, const glm::dmat4& frame_from_mesh,
                    const MeshLabels& labels) {
    std::vector<glm::vec3> voxels;
    voxels.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions)
        voxels.emplace_back(to_voxels(p, frame_from_mesh, job.grid.frame));
    std::vector<float> corners;
    corners.reserve(9 * mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i)
            corners.insert(corners.end(), {voxels[t[i]].x, voxels[t[i]].y, voxels[t[i]].z});
    job.grid.triangles =
        Buffer<float>(job.device, "source triangles", std::span<const float>(corners));
    std::vector<uint32_t> words = labels.triangle_attributes;
    words.resize(mesh.triangles.size(), labels.attributes);
    job.grid.triangle_attributes =
        Buffer<uint32_t>(job.device, "source attributes", std::span<const uint32_t>(words));
}

/// The normals of the triangles' corners for lighting; empty for a mesh with flat shading.
std::vector<uint32_t> normals_of(const GridFrame& frame, const Mesh& mesh,
                                 const glm::dmat4& frame_from_mesh, const Shading& shading) {
    const std::vector<glm::vec3> normals = corner_normals(mesh, shading);
    if (normals.empty()) return {};
    glm::dmat3 map = glm::inverseTranspose(glm::dmat3(frame_from_mesh));
    for (int column = 0; column < 3; ++column) map[column] *= frame.voxel_edge;
    return packed_normals(mesh, normals, map);
}

}  // namespace

Program Voxelizer::program(const std::string& file, const Defines& defines) const {
    return {device_, file, defines};
}

BrickGrid Voxelizer::voxelize(const Mesh& mesh, const glm::dmat4& frame_from_mesh,
                              const GridFrame& frame, const VoxelizeOptions& options) {
    return glm::determinant(glm::dmat3(frame_from_mesh)) < 0
               ? voxelize_outward(turned_over(mesh), frame_from_mesh, frame, options)
               : voxelize_outward(mesh, frame_from_mesh, frame, options);
}

BrickGrid Voxelizer::voxelize_outward(const Mesh& mesh, const glm::dmat4& frame_from_mesh,
                                      const GridFrame& frame, const VoxelizeOptions& options) {
    check_frame(frame);
    MeshLabels labels = labels_of(mesh, options.surface);
    std::vector<uint32_t> normals;
    if (has_cube_normals(options) || lists_primitives(options.surface))
        normals = normals_of(frame, mesh, frame_from_mesh, options.shading);
    MeshLattice lattice = snap_to_lattice(mesh, frame_from_mesh, frame);
    const bool has_points = has_points_alone(mesh);
    if (needs_inside(options) && !has_points) cap_open_outlines(lattice);
    const DeviceTriangles triangles = upload(device_, lattice);
    VoxelizeJob job{device_,
                    triangles,
                    part_of(triangles, lattice.surface_triangles,
                            lattice.triangles.size() - lattice.surface_triangles),
                    {},
                    glm::ivec4(frame.size, 0),
                    glm::ivec4(frame.bricks(), 0),
                    {},
                    has_points};
    job.grid.frame = frame;
    job.grid.attribute = labels.attributes;
    if (stores_distances(options.surface))
        voxelize_smooth(job, std::min(options.band, 4.0));
    else if (shows_voxels(options.surface))
        voxelize_cubes(job, options.set, 0);
    if (lists_primitives(options.surface)) {
        voxelize_cubes(job, VoxelSet::supercover, kListMargin);
        list_primitives(job, program("voxelize/voxelize_exact.cl", {{"VXL_MARGIN", kListMargin}}));
        keep_triangles(job, mesh, frame_from_mesh, labels);
        if (!normals.empty())
            job.grid.triangle_normals =
                Buffer<uint32_t>(device_, "source normals", std::span<const uint32_t>(normals));
        keep_textures(job, mesh);
    }
    if (has_cube_normals(options)) labels.corner_normals = std::move(normals);
    labels.has_normals = has_cube_normals(options);
    if (!labels.triangle_attributes.empty() || has_paint(mesh) || labels.has_normals)
        label_voxels(job, program("voxelize/voxelize_label.cl", label_defines(device_, labels)),
                     program("voxelize/voxelize_distance.cl", slice_defines(device_)),
                     bin(job, job.triangles, label_reach(frame), kLatticePerBrick), labels);
    return job.grid;
}

TriangleBins Voxelizer::bin(const VoxelizeJob& job, const DeviceTriangles& triangles,
                            const glm::ivec3& reach, int extent) {
    return bin_triangles(device_, program("voxelize/voxelize_bin.cl", {}), triangles,
                         job.grid.frame.bricks(), reach, extent);
}

Buffer<uint16_t> Voxelizer::inside(VoxelizeJob& job, bool centers, const glm::ivec3& reach) {
    const Program& winding = program("voxelize/voxelize_winding.cl", {{"VXL_CENTERS", centers}});
    if (job.caps.count == 0) return find_inside(job, winding);
    Defines defines = slice_defines(device_);
    defines.emplace_back("VXL_CENTERS", centers);
    const DeviceTriangles all = part_of(job.triangles, 0, job.triangles.count + job.caps.count);
    return find_inside_open(job, winding, program("voxelize/voxelize_caps.cl", defines),
                            bin(job, job.caps, glm::ivec3(0), kLatticePerBrick),
                            bin(job, all, reach, kLatticePerBrick));
}

void Voxelizer::voxelize_smooth(VoxelizeJob& job, double band) {
    const ProgramFile files[] = {{"voxelize/voxelize_bin.cl", {}},
                                 {"voxelize/voxelize_winding.cl", {{"VXL_CENTERS", 0}}},
                                 {"voxelize/voxelize_distance.cl", slice_defines(device_)}};
    Program::build_together(device_, files);
    // Only nodes count, and a brick's last node is at 15.
    const glm::ivec3 reach = band_reach(job.grid.frame, band);
    store_bins(job, bin(job, job.triangles, reach, kLatticePerBrick - kLatticePerVoxel));
    const Buffer<uint16_t> rows = inside(job, false, reach);
    measure_distances(job, program("voxelize/voxelize_distance.cl", slice_defines(device_)), rows,
                      band);
}

void Voxelizer::voxelize_cubes(VoxelizeJob& job, VoxelSet set, int margin) {
    Defines defines = slice_defines(device_);
    if (job.has_points) set = VoxelSet::supercover;
    defines.emplace_back("VXL_THIN", set == VoxelSet::thin);
    defines.emplace_back("VXL_MARGIN", margin);
    defines.emplace_back("VXL_POINTS", job.has_points && margin == 0);
    const ProgramFile inside_or_cover =
        set == VoxelSet::solid ? ProgramFile{"voxelize/voxelize_winding.cl", {{"VXL_CENTERS", 1}}}
                               : ProgramFile{"voxelize/voxelize_cover.cl", defines};
    const ProgramFile files[] = {{"voxelize/voxelize_bin.cl", {}}, inside_or_cover};
    Program::build_together(device_, files);
    store_bins(job, bin(job, job.triangles, glm::ivec3(margin), kLatticePerBrick));
    if (set == VoxelSet::solid) {
        const Buffer<uint16_t> rows = inside(job, true, glm::ivec3(0));
        fill_solid(job, program("voxelize/voxelize_winding.cl", {{"VXL_CENTERS", 1}}), rows);
        return;
    }
    cover_bricks(job, program("voxelize/voxelize_cover.cl", defines));
    mark_outside(job, program("voxelize/voxelize_bin.cl", {}));
}

BrickGrid voxelize_mesh(const Device& device, const Mesh& mesh, const glm::dmat4& frame_from_mesh,
                        const GridFrame& frame, const VoxelizeOptions& options) {
    return Voxelizer(device).voxelize(mesh, frame_from_mesh, frame, options);
}

GridFrame frame_around(const Mesh& mesh, const glm::dvec3& voxel_edge, int margin) {
    if (mesh.positions.empty())
        throw Error(ErrorKind::input, "the mesh has no vertices: there is nothing to voxelize");
    glm::dvec3 low(mesh.positions.front()), high(low);
    for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, glm::dvec3(p));
        high = glm::max(high, glm::dvec3(p));
    }
    return frame_around(low, high, voxel_edge, margin);
}

GridFrame frame_around(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& voxel_edge,
                       int margin) {
    const glm::dvec3 size = glm::ceil((high - low) / voxel_edge);
    const int a = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    if (!(size[a] + 2 * margin <= kLatticeReach))
        throw Error(
            ErrorKind::limit,
            "the mesh is {:.4g} m long: if that is wrong, give its model another \"unit\"; if not, "
            "use voxels of at least {:.2g} m, as it would have {:.5g} of {:.4g} m, and at most {} "
            "are possible",
            high[a] - low[a], 1.05 * (high[a] - low[a]) / (kLatticeReach - 2 * margin), size[a],
            voxel_edge[a], kLatticeReach - 2 * margin);
    GridFrame frame;
    frame.voxel_edge = voxel_edge;
    frame.size = glm::max(glm::ivec3(size), glm::ivec3(1)) + 2 * margin;
    frame.origin = low - voxel_edge * double(margin);
    return frame;
}

}  // namespace voxelume
