// SPDX-License-Identifier: Apache-2.0
// mesh groups, colours and normals -> those of voxels.
#include <algorithm>

#include "runtime/image/srgb.hpp"
#include "runtime/stages/brick_arrays.hpp"
#include "runtime/stages/voxelize/voxelize_steps.hpp"
#include "runtime/stages/voxelize/voxelize_textures.hpp"

namespace voxelume {
namespace {

/// The distance, in shortest edges, within which a surface concerns a voxel's centre. A surface
/// concerns a voxel that it meets, and one with a corner within 0.35 voxel of it: the zero of a
/// smooth field can still lie in that voxel.
double label_band(const GridFrame& frame) {
    return 0.35 + 0.5 * double(glm::length(glm::vec3(edge_scale(frame))));
}

/// The indices of corners' attributes: triangles' own, or those of their vertices.
Buffer<uint32_t> corner_indices(const VoxelizeJob& job, const char* name,
                                const std::vector<glm::uvec3>& indices) {
    if (indices.empty()) return job.triangles.triangles;
    return {job.device, name, std::span(&indices.front().x, 3 * indices.size())};
}

template <class Vector>
Buffer<float> floats_of(const Device& device, const char* name,
                        const std::vector<Vector>& vectors) {
    if (vectors.empty()) return {};
    return {device, name, std::span(&vectors.front().x, vectors.size() * size_t(Vector::length()))};
}

/// VXL_NEAREST_PARAMETERS of voxelize_label.cl.
struct NearestTriangles {
    const VoxelizeJob& job;
    const Buffer<uint32_t>& nearest;  ///< of each voxel of the stored bricks
};

void bind(KernelArguments& to, const NearestTriangles& of) {
    to.add(of.job.bricks, edge_scale(of.job.grid.frame), of.job.triangles, of.job.bins.coordinates,
           of.nearest);
}

/// VXL_WORN_PARAMETERS of voxelize_label.cl.
struct WornTextures {
    DeviceTextures textures;
    Buffer<uint32_t> corners;
    Buffer<float> uvs;
};

void bind(KernelArguments& to, const WornTextures& worn) {
    to.add(worn.textures.words, worn.textures.records, worn.textures.texels, worn.corners,
           worn.uvs);
}

WornTextures upload_worn(const VoxelizeJob& job, const Mesh& mesh) {
    const bool has_textures = !mesh.textures.empty();
    return {upload_textures(job, mesh),
            corner_indices(job, kCornerUvs,
                           has_textures ? mesh.triangle_uvs : std::vector<glm::uvec3>()),
            floats_of(job.device, kUvs, has_textures ? mesh.uvs : std::vector<glm::vec2>())};
}

void color_voxels(VoxelizeJob& job, const Program& label, const Mesh& mesh,
                  const Buffer<uint32_t>& nearest) {
    const size_t voxels = size_t(4096) * job.bins.stored;
    const std::vector<float> thresholds = srgb_thresholds(255), levels = srgb_levels();
    const Buffer<float> codes(job.device, "sRGB thresholds", std::span(thresholds)),
        linear(job.device, "linear levels", std::span(levels));
    const WornTextures worn = upload_worn(job, mesh);
    job.grid.colors = allocate_words(job.device, "voxel colors", job.bins.stored);
    label.kernel("color_voxels")
        .launch(WorkItem::light, voxels, static_cast<uint32_t>(voxels),
                NearestTriangles{job, nearest},
                corner_indices(job, "corner colors", mesh.triangle_colors),
                floats_of(job.device, "vertex colors", mesh.vertex_colors), codes, linear, worn,
                job.grid.colors);
}

void give_normals(VoxelizeJob& job, const Program& label, const std::vector<uint32_t>& of_corners,
                  const Buffer<uint32_t>& nearest) {
    const size_t voxels = size_t(4096) * job.bins.stored;
    job.grid.normals = allocate_words(job.device, "voxel normals", job.bins.stored);
    label.kernel("give_normals")
        .launch(WorkItem::light, voxels, static_cast<uint32_t>(voxels),
                NearestTriangles{job, nearest},
                Buffer<uint32_t>(job.device, "corner normals", of_corners), job.grid.normals);
}

}  // namespace

bool has_paint(const Mesh& mesh) {
    return !mesh.vertex_colors.empty() || !mesh.textures.empty();
}

Defines label_defines(const Device& device, const MeshLabels& labels) {
    Defines defines = slice_defines(device);
    defines.emplace_back("VXL_VERTEX_COLORS", !labels.mesh->vertex_colors.empty());
    defines.emplace_back("VXL_MESH_TEXTURES", !labels.mesh->textures.empty());
    defines.emplace_back("VXL_VERTEX_NORMALS", !labels.corner_normals.empty());
    return defines;
}

glm::ivec3 label_reach(const GridFrame& frame) {
    return band_reach(frame, label_band(frame));
}

void label_voxels(VoxelizeJob& job, const Program& label, const Program& distance,
                  const TriangleBins& lists, const MeshLabels& labels) {
    const size_t voxels = size_t(4096) * job.bins.stored;
    const glm::vec4 scale = edge_scale(job.grid.frame);
    Buffer<uint32_t> nearest = allocate_words(job.device, "nearest triangles", job.bins.stored);
    label.kernel("find_nearest")
        .launch(WorkItem::heavy, job.items(), job.bins.stored, job.bricks,
                glm::ivec4(label_reach(job.grid.frame), 0), scale,
                static_cast<float>(label_band(job.grid.frame)), job.triangles, lists,
                job.bins.coordinates, shape_triangles(job, distance), nearest);
    if (!labels.triangle_attributes.empty()) {
        const Buffer<uint32_t> words(job.device, "triangle attributes",
                                     std::span<const uint32_t>(labels.triangle_attributes));
        job.grid.attributes = allocate_words(job.device, "voxel attributes", job.bins.stored);
        label.kernel("label_voxels")
            .launch(WorkItem::light, voxels, static_cast<uint32_t>(voxels), labels.attributes,
                    nearest, words, job.grid.attributes);
    }
    if (has_paint(*labels.mesh)) color_voxels(job, label, *labels.mesh, nearest);
    if (labels.has_normals) give_normals(job, label, labels.corner_normals, nearest);
}

}  // namespace voxelume
