// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/emissive_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "kernels/shared/light_samples.h"
#include "kernels/shared/voxel.h"
#include "runtime/grid/grid_arguments.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/scene/predicates.hpp"

namespace voxelume {
namespace {

/// A point farther than this from the surface, in voxels, is only used to estimate the area.
constexpr double kOnSurface = 1.0 / 256;

std::vector<uint32_t> emissive_materials_of(const EmissiveSource& source) {
    std::vector<uint32_t> emissive_materials;
    emissive_materials.reserve(source.emission.size());
    for (const glm::vec3& emission : source.emission)
        emissive_materials.push_back(emission != glm::vec3(0));
    return emissive_materials;
}

/// The surface near the middle of a voxel.
struct VoxelSurface {
    glm::dvec3 point{0}, gradient{0};  ///< voxels
    double left = 0;                   ///< distance from the point to the surface, voxels
};

/// The kernels of light_samples.cl.
class PieceFinder {
  public:
    PieceFinder(const Device& device, const Features& features, const EmissiveSource& source)
        : device_(device),
          source_(source),
          defines_(features.defines(device)),
          program_(device, "light_samples.cl", defines_),
          list_(program_.kernel("list_emissive")),
          surface_(program_.kernel("find_surface")),
          emissive_objects_(device, "emissive objects", std::span(source.is_emissive)),
          emissive_materials_(device, "emissive materials", emissive_materials_of(source)) {}

    /// The pieces, sorted by form, z, y and x.
    std::vector<ListedPiece> pieces() {
        std::vector<ListedPiece> pieces = list_all(false);
        std::ranges::sort(pieces, {}, [](const ListedPiece& p) {
            return std::array{p[1], p[0] >> 16, p[0] & 0xFFFFu, p[2]};
        });
        return pieces;
    }

    std::vector<ListedPiece> voxels() {
        std::vector<ListedPiece> voxels = list_all(true);
        std::ranges::sort(voxels, {}, [](const ListedPiece& p) {
            return std::array{p[1] & 0xFFFFu, p[0] >> 16, p[0] & 0xFFFFu, p[2]};
        });
        return voxels;
    }

    std::vector<VoxelSurface> surfaces(const std::vector<ListedPiece>& pieces) {
        const auto count = uint32_t(pieces.size());
        const uint32_t stride = (count + 15) / 16 * 16;
        const Buffer<ListedPiece> listed(device_, "emissive surface", std::span(pieces));
        const Buffer<float> found(device_, "emissive surface", size_t(stride) * 7);
        surface_.launch_packets(count, shape_of(source_.pyramid), count, stride, listed,
                                source_.pyramid.fields, source_.pyramid.solids, found);
        const std::vector<float> values = found.read();
        std::vector<VoxelSurface> surfaces(count);
        for (uint32_t i = 0; i < count; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                surfaces[i].point[axis] = values[size_t(axis) * stride + i];
                surfaces[i].gradient[axis] = values[size_t(3 + axis) * stride + i];
            }
            surfaces[i].left = values[size_t(6) * stride + i];
        }
        return surfaces;
    }

    /// Multiplies the light of smooth objects' pieces by the means of their emission maps.
    void apply_emission_maps(const std::vector<ListedPiece>& listed,
                             std::vector<EmissivePiece>& pieces) {
        const SourceMeshes& sources = source_.pyramid.sources;
        if (!sources.has_maps) return;
        std::vector<size_t> numbers;
        for (size_t i = 0; i < listed.size(); ++i)
            if (listed[i][1] >> 16 == VXL_PIECE_FIELD && pieces[i].area > 0) numbers.push_back(i);
        if (numbers.empty()) return;
        const auto count = uint32_t(numbers.size());
        const uint32_t stride = (count + 15) / 16 * 16;
        std::vector<float> points(size_t(stride) * 7);
        std::vector<uint32_t> objects(stride);
        for (uint32_t i = 0; i < count; ++i) {
            const EmissivePiece& piece = pieces[numbers[i]];
            objects[i] = source_.instance.value_or(listed[numbers[i]][3] & VXL_OBJECT_MASK);
            for (int axis = 0; axis < 3; ++axis) {
                points[size_t(axis) * stride + i] =
                    float(piece.position[axis] / source_.pyramid.frame.voxel_edge[axis]);
                points[size_t(3 + axis) * stride + i] = float(piece.normal[axis]);
            }
            points[size_t(6) * stride + i] = float(std::sqrt(piece.area));
        }
        const Buffer<float> factors(device_, "emissive surface", size_t(stride) * 3);
        Program(device_, "emission_maps.cl", defines_)
            .kernel("mean_emission_maps")
            .launch_packets(count, shape_of(source_.pyramid), count, stride,
                            Buffer<uint32_t>(device_, "emissive surface", std::span(objects)),
                            Buffer<float>(device_, "emissive surface", std::span(points)),
                            sources.objects, sources.words, factors);
        const std::vector<float> found = factors.read();
        for (uint32_t i = 0; i < count; ++i)
            for (int c = 0; c < 3; ++c)
                pieces[numbers[i]].emission[c] *= double(found[size_t(c) * stride + i]);
    }

  private:
    std::vector<ListedPiece> list_all(bool by_voxel) {
        const uint32_t count = list(by_voxel, 0, {});
        if (count == 0) return {};
        const Buffer<ListedPiece> listed(device_, "emissive surface", count);
        list(by_voxel, count, listed);
        return listed.read();
    }

    /// Counts the pieces or voxels, and lists the first `capacity` of them. Returns their number.
    uint32_t list(bool by_voxel, uint32_t capacity, const Buffer<ListedPiece>& listed) {
        const glm::ivec3 sectors = source_.pyramid.frame.sectors();
        const uint32_t bricks = uint32_t(sectors.x * sectors.y * sectors.z) * 64;
        Buffer<uint32_t> found(device_, "emissive surface", 1);
        found.fill(0);
        list_.launch(WorkItem::light, bricks, bricks, source_.pyramid, source_.first_sector,
                     emissive_objects_, emissive_materials_, uint32_t(by_voxel), capacity, found,
                     listed);
        return found.read_one(0);
    }

    Device device_;
    const EmissiveSource& source_;
    Defines defines_;
    Program program_;
    Kernel list_, surface_;
    Buffer<uint32_t> emissive_objects_, emissive_materials_;
};

EmissivePiece face_piece(const glm::dvec3& cell, uint32_t face, const glm::dvec3& edge) {
    const auto axis = int(face >> 1);
    EmissivePiece piece;
    piece.position = cell + 0.5;
    piece.position[axis] = cell[axis] + double(face & 1);
    piece.position *= edge;
    piece.normal[axis] = face & 1 ? 1 : -1;
    piece.area = edge.x * edge.y * edge.z / edge[axis];
    return piece;
}

EmissivePiece voxel_piece(const glm::dvec3& cell, const VoxelSurface& surface,
                          const glm::dvec3& edge) {
    const glm::dvec3 slope = surface.gradient / edge;
    EmissivePiece piece;
    if (!(glm::length(slope) > 0) || !(surface.left < 1)) return piece;
    piece.position = (cell + surface.point) * edge;
    piece.normal = glm::normalize(slope);
    piece.area = area_in_voxel(surface.point, surface.gradient, edge);
    const glm::dvec3 off = glm::abs(surface.point - 0.5);
    piece.is_exact =
        surface.left <= kOnSurface && std::max({off.x, off.y, off.z}) <= 0.5 + kOnSurface;
    return piece;
}

using Polygon = std::vector<glm::dvec3>;

/// The part of a convex polygon on one side of a plane, where side * (p[axis] - plane) <= 0.
Polygon clipped(const Polygon& polygon, int axis, double plane, double side) {
    Polygon result;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double over_a = side * (a[axis] - plane), over_b = side * (b[axis] - plane);
        if (over_a <= 0) result.push_back(a);
        if ((over_a < 0) != (over_b < 0) && over_a != 0 && over_b != 0)
            result.push_back(a + (b - a) * (over_a / (over_a - over_b)));
    }
    return result;
}

}  // namespace

double area_in_voxel(const glm::dvec3& point, const glm::dvec3& gradient, const glm::dvec3& edge) {
    constexpr double kFar = 4;  // more than the diagonal of the unit cube
    const glm::dvec3 n = glm::normalize(gradient);
    const glm::dvec3 minimum = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(n, minimum)) * kFar;
    const glm::dvec3 v = glm::normalize(glm::cross(n, u)) * kFar;
    Polygon polygon = {point - u - v, point + u - v, point + u + v, point - u + v};
    for (int axis = 0; axis < 3; ++axis) {
        polygon = clipped(polygon, axis, 0, -1);
        polygon = clipped(polygon, axis, 1, 1);
    }
    glm::dvec3 twice(0);
    for (size_t i = 2; i < polygon.size(); ++i)
        twice += glm::cross((polygon[i - 1] - polygon[0]) * edge, (polygon[i] - polygon[0]) * edge);
    return glm::length(twice) / 2;
}

PiecesOfObjects pieces_of_source(const Device& device, const Features& features,
                                 const EmissiveSource& source) {
    PiecesOfObjects found;
    PieceFinder finder(device, features, source);
    const std::vector<ListedPiece> listed = finder.pieces();
    const std::vector<VoxelSurface> surfaces =
        listed.empty() ? std::vector<VoxelSurface>() : finder.surfaces(listed);
    const glm::dvec3& edge = source.pyramid.frame.voxel_edge;
    std::vector<EmissivePiece> pieces;
    for (size_t i = 0; i < listed.size(); ++i) {
        const auto& [xy, z_form, number, packed] = listed[i];
        const glm::dvec3 cell(xy & 0xFFFFu, xy >> 16, z_form & 0xFFFFu);
        const uint32_t form = z_form >> 16;
        EmissivePiece piece = form < VXL_PIECE_FIELD ? face_piece(cell, form, edge)
                                                     : voxel_piece(cell, surfaces[i], edge);
        piece.emission = source.emission[packed >> VXL_MATERIAL_SHIFT & VXL_MATERIAL_MASK];
        pieces.push_back(piece);
    }
    finder.apply_emission_maps(listed, pieces);
    for (size_t i = 0; i < listed.size(); ++i)
        if (pieces[i].area > 0 && pieces[i].emission != glm::dvec3(0))
            found[listed[i][3] & VXL_OBJECT_MASK].push_back(pieces[i]);
    if (source.triangle_count > 0) add_emissive_triangles(source, found);
    return found;
}

EmissiveSource world_source(const Scene& scene, const Pyramid& world,
                            const std::vector<uint32_t>& is_emissive) {
    const InstanceSet& instances = world.instances;
    EmissiveSource source{.pyramid = world, .is_emissive = is_emissive};
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        if (is_instanced(scene, object)) source.is_emissive[i] = 0;
        source.light_samples.push_back(object.light_samples);
    }
    for (const Material& material : scene.materials) source.emission.push_back(material.emission);
    // The models of instances follow the world.
    source.triangle_count = instances.models.empty()
                                ? uint32_t(world.triangles.size() / kFloatsPerTriangle)
                                : instances.models.front().first_triangle;
    return source;
}

std::vector<ListedPiece> emissive_voxels(const Device& device, const Features& features,
                                         const EmissiveSource& source) {
    return PieceFinder(device, features, source).voxels();
}

PiecesOfObjects emissive_pieces(const Device& device, const Features& features, const Scene& scene,
                                const Pyramid& world, const std::vector<uint32_t>& is_emissive) {
    PiecesOfObjects found;
    if (world.voxel_count == 0) return found;
    const EmissiveSource source = world_source(scene, world, is_emissive);
    if (std::ranges::any_of(source.is_emissive, [](uint32_t is) { return is != 0; }))
        found = pieces_of_source(device, features, source);
    add_instance_pieces(device, features, scene, world, is_emissive, found);
    return found;
}

}  // namespace voxelume
