// SPDX-License-Identifier: Apache-2.0
// Golden bits of the parts that images are made from: voxel sets, fields, ordered cell lists,
// volumes. They are equal for every device, number of lanes and compiler (tests/CASES.md, D1 and
// D5).
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "runtime/stages/place/place.hpp"
#include "runtime/stages/voxelize/voxelize.hpp"
#include "runtime/stages/voxelize/voxelize_solid.hpp"
#include "runtime/verify/exact/occupancy.hpp"
#include "runtime/verify/stress/device_walks.hpp"
#include "runtime/verify/stress/ray_classes.hpp"
#include "tests/oracles/fnv.hpp"
#include "tests/pictures/golden_hash.hpp"
#include "tests/support/display_fixture.hpp"
#include "tests/support/shared_device.hpp"
#include "tests/support/solid_cases.hpp"

namespace voxelume {
namespace {

using glm::dvec3;

#if defined(__SSE__)
/// With VXL_TEST_FLUSH in the environment, the host treats denormal numbers as zero from before the
/// device's threads start. This is the stress case D4.
[[maybe_unused]] const bool kFlushed = [] {
    if (!std::getenv("VXL_TEST_FLUSH")) return false;
    _mm_setcsr(_mm_getcsr() | 0x8040u);  // flush to zero, denormals are zero
    return true;
}();
#endif

/// A point of the unit circle with rational coordinates, so that no library's sine takes part.
glm::dvec2 on_circle(int i, int quarter) {
    const double t = double(i % quarter) / quarter;
    const glm::dvec2 p = glm::dvec2(1 - t * t, 2 * t) / (1 + t * t);
    const std::array<glm::dvec2, 4> turned = {p, {-p.y, p.x}, -p, {p.y, -p.x}};
    return turned[size_t(i / quarter % 4)];
}

/// A closed ring in three groups, in a space of 61 x 47 x 33 voxels, off their lattice.
Mesh ring_mesh() {
    constexpr int kAround = 7, kAcross = 4;  // a quarter of the points each
    Mesh mesh;
    for (int i = 0; i < 4 * kAround; ++i)
        for (int j = 0; j < 4 * kAcross; ++j) {
            const glm::dvec2 around = on_circle(i, kAround), across = on_circle(j, kAcross);
            const double r = 17.3 + 7.9 * across.x;
            mesh.positions.emplace_back(dvec3(30.2, 23.6, 16.7) +
                                        dvec3(1.1 * r * around.x, 0.8 * r * around.y,
                                              7.1 * across.y + 3.3 * around.x * around.y));
        }
    const auto at = [](int i, int j) {
        return uint32_t(i % (4 * kAround) * (4 * kAcross) + j % (4 * kAcross));
    };
    for (int i = 0; i < 4 * kAround; ++i)
        for (int j = 0; j < 4 * kAcross; ++j) {
            mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    return mesh;
}

GridFrame ring_frame() {
    GridFrame frame;
    frame.size = {61, 47, 33};
    return frame;
}

/// The hash of every voxel's bit, brick after brick, and of the data of stored bricks in the order
/// of slots.
uint64_t hash_of(const BrickGrid& grid) {
    oracle::Fnv hash;
    const ReadOccupancy occupancy(grid);
    const glm::ivec3 bricks = grid.frame.bricks();
    if (!grid.occupancy.empty())
        for (glm::ivec3 b{0}; b.z < bricks.z; ++b.z)
            for (b.y = 0; b.y < bricks.y; ++b.y)
                for (b.x = 0; b.x < bricks.x; ++b.x) {
                    const auto masks = occupancy.masks(b);
                    hash.add(masks.data(), sizeof masks);
                }
    hash.add(grid.coordinates.read());
    hash.add(grid.distance.read());
    hash.add(grid.primitive_first.read());
    hash.add(grid.primitives.read());
    return hash.value();
}

VoxelizeOptions options_of(Surface surface, VoxelSet set = VoxelSet::supercover) {
    VoxelizeOptions options;
    options.surface = surface;
    options.set = set;
    return options;
}

struct Form {
    const char* name;
    VoxelizeOptions options;
};

const std::array kForms = {
    Form{"supercover", options_of(Surface::cubes)},
    Form{"thin", options_of(Surface::cubes, VoxelSet::thin)},
    Form{"solid", options_of(Surface::cubes, VoxelSet::solid)},
    Form{"smooth", options_of(Surface::smooth)},
    Form{"exact", options_of(Surface::exact)},
};

TEST(Golden, VoxelsOfAMesh) {
    Voxelizer voxelizer(shared_device());
    const Mesh mesh = ring_mesh();
    for (const Form& form : kForms)
        expect_golden(std::string("mesh/") + form.name,
                      hash_of(voxelizer.voxelize(mesh, glm::dmat4(1), ring_frame(), form.options)));
}

TEST(Golden, VoxelsOfSolids) {
    GridFrame frame;
    frame.origin = {-14.5, -15.25, -13.75};
    frame.voxel_edge = {0.5, 0.75, 0.625};
    frame.size = {61, 43, 45};
    for (const Form& form : kForms) {
        oracle::Fnv hash;
        for (const std::vector<SolidCase>& cases : {shape_cases(), combination_cases()})
            for (const SolidCase& c : cases) {
                const uint64_t one = hash_of(
                    voxelize_solid(shared_device(), c.solid, glm::dmat4(1), frame, form.options));
                hash.add(&one, sizeof one);
            }
        expect_golden(std::string("solids/") + form.name, hash.value());
    }
}

TEST(Golden, VoxelsOfAPlacedMesh) {
    const Mesh mesh = ring_mesh();
    GridFrame world = ring_frame();
    world.size = {57, 63, 41};
    glm::dmat4 map = rational_rotation(5, 1, -2, 3);
    map[3] = glm::dvec4(dvec3(27.3, 30.1, 19.6) - dvec3(map * glm::dvec4(30.2, 23.6, 16.7, 0)), 1);
    for (const Form& form : {kForms[0], kForms[2], kForms[3]}) {
        const BrickGrid grid =
            voxelize_mesh(shared_device(), mesh, glm::dmat4(1), ring_frame(), form.options);
        const PlacedObject object{
            .grid = &grid, .world_from_object = map, .object = 0, .material_of_group = {0}};
        expect_golden(std::string("placed/") + form.name,
                      hash_of(place(shared_device(), {&object, 1}, world)));
    }
}

/// Digests stand for every cell, axis and t of a walk in order. The walk in exact arithmetic gives
/// the same hash.
TEST(Golden, OrderedCellLists) {
    constexpr uint32_t kMax = 3000;
    DeviceWalks walks(shared_device());
    for (const RayClassName& named : kRayClasses) {
        oracle::Fnv device, exact;
        for (const glm::ivec3 size : {glm::ivec3(64, 61, 37), glm::ivec3(700, 300, 1024)}) {
            const FixedGrid grid = fixed_grid(size);
            std::vector<FixedRay> rays;
            for (uint64_t i = 0; i < 501; ++i)
                rays.push_back(ray_of_class(named.kind, grid, 20261122, i));
            for (const Steps steps : {Steps::cells, Steps::blocks}) {
                walks.start(grid, rays, steps, kMax);
                device.add(walks.digests());
                std::vector<WalkDigest> digests;
                for (const FixedRay& ray : rays)
                    digests.push_back(exact_digest(grid, ray, steps, kMax));
                exact.add(digests);
            }
        }
        expect_golden(std::string("walk/") + named.name, device.value());
        EXPECT_EQ(device.value(), exact.value()) << named.name;
    }
}

struct VolumeCase {
    const char* layout;
    const char* surface;
    const char* world;
};

TEST(Golden, Volumes) {
    constexpr const char* kPointLight =
        R"({"type": "point", "position": [2, 3, -2], "intensity": 20})";
    constexpr const char* kFog =
        R"(, "medium": {"absorption": [0.2, 0.6, 1.1], "color": [0.3, 0.2, 0.1]})";
    const std::array<VolumeCase, 4> cases = {{{"lattice", "smooth", ""},
                                              {"rays", "exact", ""},
                                              {"lattice", "cubes", ""},
                                              {"rays", "smooth", kFog}}};
    for (size_t i = 0; i < cases.size(); ++i) {
        const DisplayCase& shape = kDisplayCases[i];
        const std::string keys = fmt::format(R"({}, "layout": "{}", "voxels": [40, 31, 36])",
                                             shape.keys, cases[i].layout);
        RenderReport report;
        const Volume volume = render_volume(
            shared_device(),
            parsed(display_scene(keys, cases[i].surface, cases[i].world, kPointLight)), report);
        EXPECT_GT(volume.indices.size(), 100u);
        oracle::Fnv hash;
        hash.add(&volume.frame.size, sizeof volume.frame.size);
        hash.add(volume.indices);
        hash.add(volume.colors);
        hash.add(volume.opacities);
        hash.add(volume.depths);
        hash.add(volume.objects);
        hash.add(volume.kinds);
        expect_golden(fmt::format("volume/{}/{}", shape.name, cases[i].layout), hash.value());
    }
}

}  // namespace
}  // namespace voxelume
