// SPDX-License-Identifier: Apache-2.0
// the triangles of emissive objects -> pieces of surface: the sides that emit, and parts small
// enough for light samples.
#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "kernels/shared/voxel.h"
#include "runtime/stages/light/emission_maps.hpp"
#include "runtime/stages/light/emissive_pieces.hpp"

namespace voxelume {
namespace {

/// The maximum area of a triangle's part is its emissive object's area divided by this number and
/// by the number of its light samples.
constexpr double kPartsPerLightSample = 16;
constexpr int kAssumedLightSamples = 128;  ///< used if the scene doesn't say

using Corner = std::array<float, 3>;  ///< voxels
using Corners = std::array<Corner, 3>;

/// All triangles of one emissive object, including those that don't emit.
struct EmissiveMesh {
    std::vector<Corners> triangles;
    std::vector<uint32_t> materials;
    std::vector<size_t> numbers;  ///< indices into the source's triangles
};

std::map<uint32_t, EmissiveMesh> emissive_meshes(const EmissiveSource& source) {
    const std::vector<uint32_t> attributes =
        source.pyramid.triangle_attributes.read(source.first_triangle, source.triangle_count);
    const std::vector<float> corners =
        source.pyramid.triangles.read(size_t(source.first_triangle) * kFloatsPerTriangle,
                                      size_t(source.triangle_count) * kFloatsPerTriangle);
    std::map<uint32_t, EmissiveMesh> meshes;
    for (size_t i = 0; i < attributes.size(); ++i) {
        const uint32_t object = attributes[i] & VXL_OBJECT_MASK;
        if (!source.is_emissive[object]) continue;
        const float* c = &corners[kFloatsPerTriangle * i];
        EmissiveMesh& mesh = meshes[object];
        mesh.triangles.push_back(
            {Corner{c[0], c[1], c[2]}, Corner{c[3], c[4], c[5]}, Corner{c[6], c[7], c[8]}});
        mesh.numbers.push_back(i);
        mesh.materials.push_back(attributes[i] >> VXL_MATERIAL_SHIFT & VXL_MATERIAL_MASK);
    }
    return meshes;
}

/// True if the triangles use every edge as often in one direction as in the other.
bool is_closed(const std::vector<Corners>& triangles) {
    std::map<std::array<Corner, 2>, int> balance;
    for (const Corners& t : triangles)
        for (size_t i = 0; i < 3; ++i) {
            const Corner &a = t[i], &b = t[(i + 1) % 3];
            if (a < b) ++balance[{a, b}];
            if (b < a) --balance[{b, a}];
        }
    return std::ranges::all_of(balance, [](const auto& edge) { return edge.second == 0; });
}

glm::dvec3 to_vector(const Corner& corner) {
    return {corner[0], corner[1], corner[2]};
}

/// Six times the volume inside a closed mesh; negative if its triangles face inwards.
double signed_volume(const std::vector<Corners>& triangles) {
    double sum = 0;
    for (const Corners& t : triangles)
        sum += glm::dot(to_vector(t[0]), glm::cross(to_vector(t[1]), to_vector(t[2])));
    return sum;
}

using Triangle = std::array<glm::dvec3, 3>;  ///< metres

glm::dvec3 area_vector(const Triangle& t) {
    return glm::cross(t[1] - t[0], t[2] - t[0]) * 0.5;
}

/// A triangle to divide, and its UVs on its map.
struct Part {
    Triangle corners;
    EmissionMaps::Uvs uvs;
};

/// The values that all parts of a triangle share.
struct Whole {
    EmissivePiece piece;
    double largest;  ///< maximum area of a part
    const EmissionMaps& maps;
    size_t number;  ///< number of the triangle
};

/// Halves a triangle across its longest edge repeatedly until its parts are small enough.
void add_parts(const Part& part, const Whole& whole, std::vector<EmissivePiece>& pieces) {
    const Triangle& t = part.corners;
    const double area = glm::length(area_vector(t));
    if (area <= whole.largest) {
        EmissivePiece piece = whole.piece;
        piece.emission *= whole.maps.mean(whole.number, part.uvs);
        if (piece.emission == glm::dvec3(0)) return;
        piece.position = (t[0] + t[1] + t[2]) / 3.0;
        piece.area = area;
        pieces.push_back(piece);
        return;
    }
    size_t longest = 0;
    for (size_t i = 1; i < 3; ++i)
        if (glm::distance(t[i], t[(i + 1) % 3]) > glm::distance(t[longest], t[(longest + 1) % 3]))
            longest = i;
    const size_t i = longest, j = (longest + 1) % 3, k = (longest + 2) % 3;
    const EmissionMaps::Uvs& p = part.uvs;
    const glm::dvec3 middle = (t[i] + t[j]) * 0.5;
    const glm::dvec2 middle_uv = (p[i] + p[j]) * 0.5;
    add_parts({{t[i], middle, t[k]}, {p[i], middle_uv, p[k]}}, whole, pieces);
    add_parts({{middle, t[j], t[k]}, {middle_uv, p[j], p[k]}}, whole, pieces);
}

void add_mesh(const EmissiveSource& source, const EmissionMaps& maps, const EmissiveMesh& mesh,
              int light_samples, std::vector<EmissivePiece>& pieces) {
    const glm::dvec3& edge = source.pyramid.frame.voxel_edge;
    const bool closed = is_closed(mesh.triangles);
    const double outwards = closed && signed_volume(mesh.triangles) < 0 ? -1 : 1;
    std::vector<Triangle> triangles;
    double area = 0;
    for (const Corners& t : mesh.triangles) {
        triangles.push_back(
            {to_vector(t[0]) * edge, to_vector(t[1]) * edge, to_vector(t[2]) * edge});
        area += glm::length(area_vector(triangles.back()));
    }
    for (size_t i = 0; i < triangles.size(); ++i) {
        const glm::dvec3 facing = area_vector(triangles[i]);
        Whole whole{{}, area / (kPartsPerLightSample * light_samples), maps, mesh.numbers[i]};
        whole.piece.emission = source.emission[mesh.materials[i]];
        if (!(glm::length(facing) > 0) || whole.piece.emission == glm::dvec3(0)) continue;
        whole.piece.normal = glm::normalize(facing) * outwards;
        const Part part{triangles[i], maps.uvs(mesh.numbers[i])};
        add_parts(part, whole, pieces);
        if (closed) continue;
        whole.piece.normal = -whole.piece.normal;
        add_parts(part, whole, pieces);
    }
}

}  // namespace

void add_emissive_triangles(const EmissiveSource& source, PiecesOfObjects& pieces) {
    const EmissionMaps maps(source);
    for (const auto& [object, mesh] : emissive_meshes(source))
        add_mesh(source, maps, mesh, source.light_samples[object].value_or(kAssumedLightSamples),
                 pieces[object]);
}

}  // namespace voxelume
